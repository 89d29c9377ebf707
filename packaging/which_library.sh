# shellcheck shell=sh
# Run by `pstripack-config --which OBJECT|ARCHIVE|PROGRAM`: which of our libraries does a file need that calls TRMESH? The
# file is not run. What is seen, in code for x86-64:
#   arguments  TRMESH has 12 or 8; 6 are in registers, the others are pushed just before the call
#   kinds      the debug information of gfortran -g: its flags, the types of variables; without it, instructions on
#              doubles or singles, and instructions on integers of 32 or 64 bits in memory
# Exit status: 0 one library fits; 1 this cannot be determined; 2 no answer.
set -eu
export LC_ALL=C
subject=$1 libdir=$2

fail() {
  echo "pstripack-config --which: $*" >&2
  exit 2
}
for tool in nm objdump readelf; do
  command -v $tool > /dev/null || fail "needs $tool (Debian: apt-get install binutils)"
done
[ -f "$subject" ] || fail "$subject: no such file"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
objdump -dr --no-show-raw-insn "$subject" > "$work/code" 2> "$work/errors" ||
  fail "$subject: not an object file, archive, library or program"
nm -P "$subject" > "$work/symbols" 2> /dev/null
grep -q 'file format elf64-x86-64' "$work/code" || fail "$subject: --which reads code for x86-64 only; go by the flags of your compiler"

# One line "args doubles singles narrow wide" for each object file that calls TRMESH; args is 0 where calls differ.
awk '
  function told() { if (args != "") print args, doubles, singles, narrow, wide; args = ""; doubles = singles = narrow = wide = 0 }
  function called() { number = last == 6 ? 12 : last == 2 ? 8 : 0; args = args == "" || args == number ? number : 0 }
  / file format / { told() }
  /^[0-9a-f]+ </ { pushed = 0 }
  /\tpush/ { ++pushed }
  /\tsub .*,%rsp/ { pushed = 0 }        # the end of what a function saves at its beginning
  /\tcall/ { last = pushed; pushed = 0 }
  /\tcall .*<trmesh_(@plt)?>/ || /R_X86_64_[A-Z0-9_]+\ttrmesh_(-|\+|$)/ { called() }
  /\tv?[a-z]+sd / { ++doubles }
  /\tv?(add|sub|mul|div|sqrt|ucomi|comi|mov|fm[a-z0-9]+)ss / { ++singles }
  /\t(movslq|cltq)/ || /\t(mov|cmp|add|sub|imul) +[^$%]*\(.*\),%(e[a-ds][xip]|r[0-9]+d)$/ || /\t(cmp|add|sub)l / { ++narrow }
  /\t(cmp|add|sub|mov)q +\$0x.*\)/ { ++wide }
  END { told() }' "$work/code" > "$work/callers"

if grep -q '^trmesh_ [TtWi]' "$work/symbols"; then
  echo "$subject contains a STRIPACK, which comes before ours: see \"From an archive with other routines\" in docs/relink.md"
fi
module=$(sed -n 's/^\(__[a-z0-9_]*_MOD_trmesh\) U.*/\1/p' "$work/symbols" | head -n 1)
if [ -n "$module" ]; then
  echo "$subject calls $module of a module: compile it with \$(pstripack-config --fflags), then ask again"
  exit 1
fi
[ -s "$work/callers" ] || fail "$subject does not call TRMESH; ask for the object file that does"

readelf --debug-dump=info "$subject" 2> /dev/null |
  grep -oE '(real|integer)\(kind=[0-9]+\)|GNU Fortran.*' | tr ' ' '\n' |
  grep -xE '(real|integer)\(kind=[48]\)|Fortran[0-9]*|-f(default-|real-4-|integer-4-)(real|integer)-8' | sort -u > "$work/debug" || true
# bytes KIND SEEN: 4 or 8 by the debug information; if that does not tell, SEEN, what the instructions tell: 4, 8, or 0 if
# they do not tell either
bytes() {
  case $(tr '\n' ' ' < "$work/debug") in
    *-f*"$1-8 "*) echo 8 ;;
    *"$1(kind=4) $1(kind=8) "*) echo "$2" ;;
    *"$1(kind=4) "*) echo 4 ;;
    *"$1(kind=8) "*) echo 8 ;;
    *) echo "$2" ;;
  esac
}
awk '
  NR == 1 { args = $1 } $1 != args { args = 0 }
  { doubles += $2; singles += $3; narrow += $4; wide += $5 }
  END {
    reals = doubles && !singles ? 8 : singles && !doubles ? 4 : 0
    integers = narrow >= 2 && narrow > wide / 3 ? 4 : wide >= 2 && narrow < wide / 6 ? 8 : 0
    print args, reals, integers, doubles, singles, narrow, wide
  }' "$work/callers" > "$work/answer"
read -r args reals integers doubles singles narrow wide < "$work/answer"
reals=$(bytes real "$reals") integers=$(bytes integer "$integers")

or() { if [ "$1" = 0 ]; then echo "$2"; else echo "$1"; fi; }
echo "$subject calls TRMESH with $(or "$args" "8 or 12") arguments, reals of $(or "$reals" "4 or 8") bytes," \
  "integers of $(or "$integers" "4 or 8") bytes"
if [ -s "$work/debug" ]; then echo "  debug information: $(tr '\n' ' ' < "$work/debug")"; fi
echo "  instructions: $doubles on doubles, $singles on singles; $narrow on integers of 32 bits, $wide on integers of 64 bits"
case $args,$reals,$integers in
  12,8,4) abi=r8 ;;
  12,4,4) abi=r4 ;;
  8,8,4) abi=8arg ;;
  12,8,8) abi=i8 ;;
  *0*)
    echo "Which library, these do not tell: compile with -g and ask again, or go by \"Your line\" in docs/relink.md"
    exit 1 ;;
  *)
    echo "There is no library for this combination: copy the arrays to real(8) and 32-bit integers, and call libstripack"
    exit 1 ;;
esac

# Helpers of the Fortran 90 text that the file calls and does not contain.
helpers=$({ nm -P "$libdir/libstripack_f90.a" || nm -DP "$libdir/libstripack_f90.so"; } 2> /dev/null | awk '$2 == "T" { print $1 }')
undefined=$(awk '$2 == "U" { print $1 }' "$work/symbols")
for helper in $helpers; do
  if echo "$undefined" | grep -qx "$helper" && ! grep -q "^$helper [Tt]" "$work/symbols"; then
    abi=f90,$abi
    break
  fi
done
case $abi in
  r8) ask="" ;;
  *) ask="--abi $abi " ;;
esac
echo "Link it with: \$(pstripack-config $ask--libs)"
