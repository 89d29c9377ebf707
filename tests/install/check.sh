#!/bin/sh
# Programs for the Fortran 90 text link with libstripack_f90 before the library. `pstripack-config --check` tells whose
# TRMESH a program or process calls, linked in every right and wrong way; an old library is made here. `--which` tells
# which library an object file needs.
# Usage: check.sh PREFIX CONSUMER_DIR WORK_DIR
# shellcheck disable=SC2046,SC2086  # lists of words on purpose
set -eu
prefix=$1 consumer=$2 work=$3
rm -rf "$work"
mkdir -p "$work/a folder"
cd "$work/a folder"
config=$prefix/bin/pstripack-config
switch=$($config --switch-dir)
libdir=${switch%/pstripack/switch/r8}
ours_r8=$(readlink -f "$libdir/libstripack.so")
fail() { echo "$*" >&2; exit 1; }

# answers STATUS "ROUTINE  answer..." COMMAND...: fails unless the command ends with STATUS and prints exactly this answer;
# lines with "not called" are ignored
answers() {
  expected_status=$1 expected=$2
  shift 2
  status=0
  "$@" > "$work/answer" 2> "$work/errors" || status=$?
  found=$(grep -v ' not called$' "$work/answer" | tr '\n' ';')
  if [ $status != "$expected_status" ] || [ "$found" != "$expected" ]; then
    cat "$work/errors"
    fail "$*: status $status: $found; expected $expected_status: $expected"
  fi
  echo "$expected_status $*"
}
check() { answers "$1" "$2" "$config" --check "$3"; }
each() { for routine in $1; do printf '%-6s  %s;' "$routine" "$2"; done; }
some="TRMESH TRLIST" all="TRMESH TRLIST CRLIST TRFIND GETNP"

# The old library has everything in one object, as the original's text is one file.
cat > old.f90 << 'END'
subroutine trmesh
  call trfind
end subroutine
subroutine trlist
end subroutine
subroutine crlist
end subroutine
subroutine trfind
end subroutine
subroutine getnp
end subroutine
subroutine timestamp
end subroutine
END
cat > model.f90 << 'END'
call trmesh
call trlist
call timestamp
end
END
gfortran -fPIC -c old.f90
ar rc libold.a old.o
mkdir old
gfortran -shared old.o -o old/libstripack.so
gfortran -fPIC -c model.f90

# A program that calls the helpers, and one that has its own.
for kind in "" --static; do
  gfortran "$consumer/fortran90.f90" -o fortran90 $($config --abi f90,r8 $kind --libs)
  LD_LIBRARY_PATH=$libdir ./fortran90 > output
  tail -n 1 output | grep -qx 'fortran90: right' || fail "fortran90 $kind"
  head -n 1 output | grep -qxE '[ 1-3][0-9] [A-Z][a-z]+ [0-9]{4}  [ 1][0-9]:[0-5][0-9]:[0-5][0-9]\.[0-9]{3} (AM|PM|Noon|Midnight)' ||
    fail "timestamp: $(head -n 1 output)"
done
# Without any shared library: as docs/relink.md says.
gfortran -static-pie "$consumer/fortran90.f90" -o static_pie $($config --abi f90,r8 --static --libs)
./static_pie > output || fail "static_pie ends with status $?"
tail -n 1 output | grep -qx 'fortran90: right' || fail "static_pie"
check 0 "$(each TRMESH "ours (libstripack): in the program itself")" static_pie
gfortran "$consumer/fortran90.f90" -o fortran90 $(PKG_CONFIG_PATH="$libdir/pkgconfig" pkg-config --libs stripack_f90 stripack)
for half in AM PM; do  # in a time zone where it is now 0:30, or 12:30
  if [ $half = AM ]; then local_minute=30; else local_minute=750; fi
  west=$((($(date +%s) / 60 - local_minute) % 1440))
  TZ=$(printf 'XYZ%02d:%02d' $((west / 60)) $((west % 60))) LD_LIBRARY_PATH=$libdir ./fortran90 | head -n 1 > output
  grep -qE " 12:3[01]:.* $half\$" output || fail "timestamp half an hour after 0 or 12 o'clock: $(cat output)"
done
cat > own.f90 << 'END'
call timestamp
end
subroutine timestamp
  print '(a)', 'my own'
end subroutine
END
gfortran own.f90 -o own $($config --abi f90,r8 --libs)
[ "$(./own)" = 'my own' ] || fail "the program's own timestamp"

# Linked rightly: the helpers' archive before our library.
gfortran model.o -o right $($config --abi f90,r8 --libs) -Wl,-rpath,"$libdir"
check 0 "$(each "$some" "ours (libstripack): $ours_r8")" right
strip -o right_stripped right
check 0 "$(each "$some" "ours (libstripack): $ours_r8")" right_stripped
gfortran model.o -o right_r4 $($config --abi f90,r4 --libs) -Wl,-rpath,"$libdir"
check 0 "$(each "$some" "ours (libstripack_r4): $(readlink -f "$libdir/libstripack_r4.so")")" right_r4
gfortran -Wl,--gc-sections model.o -o right_static $($config --abi f90,r8 --static --libs)
check 0 "$(each "$some" "ours (libstripack): in the program itself")" right_static
strip right_static
check 0 "$(each "$some" "ours (libstripack): in the program itself")$(each "CRLIST TRFIND GETNP" "not seen; the program is stripped")" \
  right_static

# The old library linked after ours for its timestamp: as an archive it adds its TRMESH to the program.
gfortran model.o -o wrong $($config --libs) libold.a -Wl,-rpath,"$libdir"
check 1 "$(each "$all" "NOT OURS: in the program itself")" wrong
strip wrong
check 1 "$(each "$all" "NOT OURS: in the program itself")" wrong
gfortran model.o -o wrong_static libold.a
check 1 "$(each "$all" "NOT OURS: in the program itself")" wrong_static
strip wrong_static
check 1 "$(each "$all" "not seen; the program is stripped")" wrong_static

# A module procedure of the old text beside calls of ours is named; one that calls ours is none of the old text.
for body in '' 'call ours'; do
  cat > module.f90 << END
module old_module
  interface
    subroutine ours() bind(c, name="trmesh_")
    end subroutine
  end interface
contains
  subroutine trmesh
    $body
  end subroutine
end module
END
  printf '%s\n' 'subroutine second' 'use old_module' 'call trmesh' end > second.f90
  gfortran module.f90 second.f90 model.o -o both $($config --abi f90,r8 --libs) -Wl,-rpath,"$libdir"
  if [ -z "$body" ]; then
    check 1 "$(each "$some" "ours (libstripack): $ours_r8")TRMESH  NOT OURS: __old_module_MOD_trmesh: in the program itself;" both
  else
    check 0 "$(each "$some" "ours (libstripack): $ours_r8")TRMESH  __old_module_MOD_trmesh calls trmesh_: in the program itself;" both
  fi
done
cc $($config --abi c --cflags) "$consumer/c_api.c" -o c_api $($config --abi c --libs) -Wl,-rpath,"$libdir"
"$config" --check c_api | grep -q '^ours: c_api calls the C interface: pstripack_' || fail "a program of the C interface"

# Compiled with kinds that another of our libraries has; the planar TRIPACK.
says() { grep -qF -e "$1" "$work/errors" || { cat "$work/errors"; fail "expected '$1'"; }; }
for flags in -fdefault-integer-8 -finteger-4-integer-8; do
  gfortran -g $flags -c model.f90 -o wide.o
  gfortran wide.o -o wide $($config --abi f90,r8 --libs) -Wl,-rpath,"$libdir"
  check 1 "$(each "$some" "ours (libstripack): $ours_r8")" wide
  says "wide is compiled with $flags and needs libstripack_i8, not libstripack"
  gfortran wide.o -o wide $($config --abi f90,i8 --libs) -Wl,-rpath,"$libdir"
  check 0 "$(each "$some" "ours (libstripack_i8): $(readlink -f "$libdir/libstripack_i8.so")")" wide
done
gfortran -g -fdefault-real-8 -c model.f90 -o wide.o
gfortran wide.o -o wide $($config --abi f90,r4 --libs) -Wl,-rpath,"$libdir"
check 1 "$(each "$some" "ours (libstripack_r4): $(readlink -f "$libdir/libstripack_r4.so")")" wide
says "wide is compiled with -fdefault-real-8 and needs libstripack, not libstripack_r4"
gfortran wide.o -o wide $($config --abi f90,r8 --libs) -Wl,-rpath,"$libdir"
check 0 "$(each "$some" "ours (libstripack): $ours_r8")" wide
{ cat old.f90; echo 'subroutine addcst'; echo 'end subroutine'; } > tripack.f90
gfortran model.f90 tripack.f90 -o planar
check 1 "$(each "$all" "NOT OURS: in the program itself")" planar
says "planar is the planar TRIPACK: remove it from the link line"
gfortran -shared -fPIC model.f90 tripack.f90 -o _tripack.so
answers 1 "$(each "$all" "NOT OURS: in the program itself")" env LD_PRELOAD="$switch/libstripack.so" "$config" --check _tripack.so
says "the planar TRIPACK $PWD/_tripack.so calls TRMESH of $switch/libstripack.so"

# As a shared library: the first one found is used; the environment decides.
gfortran model.o -o first "$PWD/old/libstripack.so" $($config --libs) -Wl,-rpath,"$libdir"
old=$PWD/old/libstripack.so
check 1 "$(each "$some" "NOT OURS: $old")$(each TRFIND "NOT OURS: $old")" first
gfortran model.o -o behind $($config --libs) "$old" -Wl,-rpath,"$libdir"
check 0 "$(each "$some" "ours (libstripack): $ours_r8")$(each TRFIND "ours (libstripack): $ours_r8")" behind
answers 0 "$(each "$some" "ours (libstripack): $ours_r8")$(each TRFIND "ours (libstripack): $ours_r8")" \
  env LD_PRELOAD="$switch/libstripack.so" "$config" --check first
gfortran model.o -o switched -Lold -lstripack
answers 1 "$(each "$some" "NOT OURS: $old")$(each TRFIND "NOT OURS: $old")" env LD_LIBRARY_PATH=old "$config" --check switched
gfortran model.f90 -shared -fPIC -o libmodel.so $($config --abi f90,r8 --libs) -Wl,-rpath,"$libdir"
check 0 "$(each "$some" "ours (libstripack): $ours_r8")" libmodel.so
answers 1 "$(each "$some" "nobody's: the symbol is undefined")" env -u LD_LIBRARY_PATH "$config" --check switched
grep -q 'needs libstripack.so, which is not found' "$work/errors" || fail "the library that is missing is not named"

# A library of the program that contains the old one, with visible or hidden symbols.
echo 'end' > nothing.f90
echo '{ global: sub_; local: *; };' > hidden.map
echo 'subroutine sub
call trmesh
end' > sub.f90
gfortran -shared -fPIC sub.f90 old.o -o libshown.so
gfortran -shared -fPIC sub.f90 old.o -o libhidden.so -Wl,--version-script=hidden.map
gfortran -Wl,--no-as-needed nothing.f90 -o inside_hidden "$PWD/libhidden.so"
check 1 "$(each "$all" "NOT OURS: $PWD/libhidden.so")" inside_hidden
gfortran -shared -fPIC sub.f90 -o libsub.so $($config --libs) -Wl,-rpath,"$libdir"

# A process: libraries from its start, and libraries loaded later.
cat > host.c << 'END'
#include <dlfcn.h>
#include <stdio.h>
#ifdef CALLS
void trmesh_(void);
void (*call)(void) = trmesh_;
#endif
int main(int count, char** paths) {
  for (int i = 1; i < count; ++i)
    if (!dlopen(paths[i], RTLD_NOW)) return puts(dlerror());
  puts("ready");
  fflush(stdout);
  return getchar() != EOF;
}
END
cc host.c -o host -ldl
cc -DCALLS host.c -o calling_host -ldl -Lold -lstripack
mkfifo to_host from_host
# process STATUS ANSWER COMMAND...
process() {
  expected_status=$1 expected=$2
  shift 2
  "$@" < to_host > from_host &
  host=$!
  exec 3> to_host
  read -r ready < from_host
  [ "$ready" = ready ] || fail "$*: $ready"
  (cd / && check "$expected_status" "$expected" $host)
  exec 3>&-
  wait $host
}
process 0 "$(each TRMESH "ours (libstripack): $ours_r8")" ./host ./libsub.so
process 1 "$(each "$all" "NOT OURS: $PWD/libshown.so")" ./host ./libshown.so
process 1 "$(each "$all" "NOT OURS: $PWD/libhidden.so")" ./host ./libhidden.so
process 1 "$(each "TRMESH TRFIND" "NOT OURS: $old")" env LD_LIBRARY_PATH=old ./calling_host
process 0 "$(each TRMESH "ours (libstripack): $ours_r8")" env LD_LIBRARY_PATH="$switch" ./calling_host
process 1 "" ./host
process 1 "$(each "$all" "NOT OURS: $PWD/_tripack.so")" env LD_PRELOAD="$switch/libstripack.so" ./host ./_tripack.so
says "the planar TRIPACK $PWD/_tripack.so calls TRMESH of $switch/libstripack.so; LD_PRELOAD causes this: unset it"

# refused TEXT QUESTION...
refused() {
  text=$1
  shift
  answers 2 "" "$config" "$@"
  grep -qF -e "$text" "$work/errors" || { cat "$work/errors"; fail "refused, but not because '$text': $*"; }
}
echo '#!/bin/sh' > script
head -c 1000 right > half
refused "script is not a program but a script" --check script
refused "model.o is not linked yet" --check model.o
refused "half is damaged" --check half
refused "no such file, and no such process" --check "$work/nowhere"
refused "not a file that can be read" --check "$work"
refused "takes a program, or the number of a process, and nothing else" --check
refused "takes a program, or the number of a process, and nothing else" --check right wrong
answers 1 "" "$config" --check host
grep -q 'calls none of them' "$work/errors" || fail "a program that calls none of them"

# Which library an object file needs: with debug information always told, without it told rightly or not at all.
# which ABI ARGUMENTS KIND FLAGS...
which() {
  abi=$1 arguments=$2 kind=$3
  shift 3
  cat > which.f << TEXT
      SUBROUTINE MODEL(N, X, Y, Z, LIST, LPTR, LEND, NEAR, NEXT, D)
      INTEGER N, LIST(*), LPTR(*), LEND(*), NEAR(*), NEXT(*)
      INTEGER LNEW, IER, I
      $kind X(*), Y(*), Z(*), D(*)
      CALL TRMESH($arguments)
      IF (IER .NE. 0) CALL TIMESTAMP
      DO 10 I = 1, N
        D(1) = D(1) + X(LIST(I))*Y(LPTR(I))
 10   CONTINUE
      END
TEXT
  for flags in "-O2 -g" -O2; do
    gfortran $flags "$@" -c which.f
    status=0
    "$config" --which which.o > "$work/answer" || status=$?
    case "$status $flags $(tail -n 1 "$work/answer")" in
      "0 "*"Link it with: \$(pstripack-config --abi f90,$abi --libs)") ;;
      "1 -O"?" Which library, these do not tell"*) ;;
      *) cat "$work/answer"; fail "--which: expected $abi with $flags $*" ;;
    esac
  done
}
twelve="N,X,Y,Z,LIST,LPTR,LEND,LNEW,NEAR,NEXT,D,IER"
which r8 $twelve REAL*8
which r8 $twelve REAL -fdefault-real-8
which r4 $twelve REAL
which 8arg N,X,Y,Z,LIST,LPTR,LEND,IER REAL*8
which i8 $twelve REAL*8 -fdefault-integer-8
sed -i 's/REAL\*8/REAL*4/' which.f && gfortran -g -fdefault-integer-8 -c which.f
answers 1 "$("$config" --which which.o | tr '\n' ';')" "$config" --which which.o
grep -q 'no library for this combination' "$work/answer" || fail "--which: real(4) with 64-bit integers"
ar rc libwhich.a which.o old.o
"$config" --which libwhich.a | grep -q '^libwhich.a contains a STRIPACK' || fail "--which: an archive with a STRIPACK"
refused "does not call TRMESH" --which host
refused "no such file" --which "$work/nowhere"
refused "not an object file" --which script
refused "takes an object file, archive or program, and nothing else" --which
echo "pstripack-config --check, --which: all answers are right"
