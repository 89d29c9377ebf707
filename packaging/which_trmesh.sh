# shellcheck shell=sh
# Run by `pstripack-config --check PROGRAM|PID`: whose TRMESH, TRLIST, CRLIST, TRFIND, GETNP does a program call? The
# program is not run. Three sources:
#   nm           symbols that the program defines; if it is stripped, only those that shared libraries may call
#   the loader   symbols from shared libraries: as for ldd, the loader binds all symbols, reports each, and ends
#   a text       "@(#)PSTRIPACK library ROUTINE" is in every file that contains this routine of ours, also after strip
# Also named: module procedures TRMESH, which are another STRIPACK unless they call trmesh_; calls of our C interface.
# Exit status: 0 all called routines are ours; 1 they are not, or it cannot be determined; 2 no answer.
set -eu
export LC_ALL=C
subject=$1
routines="trmesh trlist crlist trfind getnp"
symbols='^((trmesh|trlist|crlist|trfind|getnp)_|__[a-z0-9_]+_MOD_trmesh)$'

fail() {
  echo "pstripack-config --check: $*" >&2
  exit 2
}
[ "$(uname)" != Darwin ] || fail "works for Linux; on macOS see otool -L $subject"
for tool in nm objdump readelf; do
  command -v $tool > /dev/null || fail "needs $tool (Debian: apt-get install binutils)"
done
# Without the plugins of compilers, whose loading takes longer than all the rest.
nm="nm --plugin=/dev/null"
$nm --version > /dev/null 2>&1 || nm=nm
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
: > "$work/found"     # lines: symbol and defining file; "?": unknown, "-": undefined
: > "$work/examined"  # files examined as part of a program or library
: > "$work/misled"    # planar libraries that LD_PRELOAD makes call another TRMESH, and whose

is_elf() { [ "$(head -c 4 "$1" | tail -c 3)" = ELF ]; }
# Lines "library ROUTINE"
texts_of() { grep -aoE '@\(#\)PSTRIPACK [a-z0-9_]+ [A-Z]+' "$1" | cut -d ' ' -f 2-; }
interpreter_of() { readelf -lW "$1" | sed -n 's/.*program interpreter: \(.*\)]/\1/p'; }

# has TYPES [nm's option]: of the files that stdin names, lines for $work/found, one per symbol whose type in nm is one of
# TYPES. One nm for all files, because its start takes longest; with /dev/null it names each file.
has() {
  xargs -r -d '\n' $nm ${2:+"$2"} -P /dev/null 2> /dev/null | awk -v symbols="$symbols" -v types="^[$1]\$" '
    /:$/ { file = substr($0, 1, length($0) - 1) }
    $1 ~ symbols && $2 ~ types { print $1, file }'
}

# Routines of the planar TRIPACK that STRIPACK does not have.
is_planar() { { $nm -P "$1"; $nm -DP "$1"; } 2> /dev/null | grep -qE '^(addcst|trmshr)_ [TtWi] '; }

# bindings FILE: prints the loader's report
bindings() {
  loader=$(interpreter_of "$1")
  [ -n "$loader" ] || loader=$(interpreter_of "$(readlink -f /bin/sh)")  # a shared library names no loader
  env -u LD_DEBUG_OUTPUT LD_TRACE_LOADED_OBJECTS=1 LD_WARN=yes LD_BIND_NOW=yes LD_DEBUG=bindings "$loader" "$1" 2>&1
}

# ask_loader FILE: writes the loader's report to $work/loader
ask_loader() {
  bindings "$1" > "$work/loader" || fail "$1 cannot be loaded: $(grep -v 'binding file' "$work/loader" | tail -n 1)"
  grep -q 'binding file' "$work/loader" || fail "$loader does not report bindings; the GNU C library's loader does"
}

# examine FILE: adds a program, or a library loaded at run time, to $work/found
examine() {
  readelf -hldSW "$1" > "$work/header" 2> "$work/errors" || true
  if grep -q 'Error:' "$work/errors"; then fail "$1 is damaged: $(head -n 1 "$work/errors")"; fi
  : > "$work/loader"
  if grep -q '(NEEDED)' "$work/header"; then ask_loader "$1"; fi
  sed -n 's/^\t\(.* => \)\{0,1\}\(.*\) (0x[0-9a-f]*)$/\2/p' "$work/loader" |
    { xargs -r -d '\n' readlink -e || true; } > "$work/loaded"
  { echo "$1"; cat "$work/loaded"; } >> "$work/examined"
  sed -n 's/^\t\(.*\) => not found$/\1/p' "$work/loader" | sort -u | while read -r library; do
    echo "pstripack-config --check: $1 needs $library, which is not found" >&2
  done

  # Calls from one file to another.
  sed -n "s/.*binding file .* to \(.*\) \[[0-9]*\]: normal symbol \`\([^']*\)'.*/\2 \1/p
          s/.*undefined symbol: \([^[:space:]]*\).*/\1 -/p" "$work/loader" |
    awk -v symbols="$symbols" '$1 ~ symbols' | while read -r symbol file; do
      [ "$file" = - ] || file=$(readlink -f "$file")
      echo "$symbol $file"
    done >> "$work/found"

  # The loader has just taken the file for the program itself, whose routines come first. Where a planar library is
  # loaded, those of LD_PRELOAD come before its own. Paths in LD_PRELOAD must not contain blanks.
  if [ -n "${LD_PRELOAD:-}" ] && is_planar "$1"; then
    ln -sf "$1" "$work/planar.so"
    LD_PRELOAD=$LD_PRELOAD:$work/planar.so bindings "$(readlink -f /bin/sh)" |
      sed -n "s|.*binding file $work/planar.so \[[0-9]*\] to \(.*\) \[[0-9]*\]: normal symbol \`trmesh_'.*|\1|p" |
      while read -r file; do is_planar "$file" || echo "$1 calls TRMESH of $file"; done >> "$work/misled"
  fi

  # Calls within a file: a library may call its hidden symbols, a program all of its symbols.
  has t < "$work/loaded" >> "$work/found"
  if ! grep -qE 'program interpreter|Type: *EXEC|Flags:.*PIE' "$work/header"; then
    { echo "$1" | has t; echo "$1" | has TWi -D; } >> "$work/found"
    return
  fi
  {
    echo "$1" | has TtWwi
    echo "$1" | has TWi -D
    texts_of "$1" | awk -v file="$1" '{ print tolower($2) "_", file }'
  } >> "$work/found"

  # A stripped program shows only symbols that a library it was linked with defines as well.
  if grep -q ' SYMTAB ' "$work/header"; then return; fi
  has TWi -D < "$work/loaded" > "$work/shown"
  for routine in $routines; do
    grep -q "^${routine}_ " "$work/found" "$work/shown" || echo "${routine}_ ?" >> "$work/found"
  done
}

if [ ! -e "$subject" ] && [ -d "/proc/$subject" ] && [ "${subject#*[!0-9]}" = "$subject" ]; then
  name="process $subject"
  program=$(readlink "/proc/$subject/exe") || fail "$name: belongs to somebody else, or has no program"
  [ -f "$program" ] || fail "$name: its program is not there any more: $program"
  sed -n 's/^[^ ]* [^ ]* [^ ]* [^ ]* [^ ]* *\(\/.*\)/\1/p' "/proc/$subject/maps" | sort -u > "$work/mapped"
  cd "/proc/$subject/cwd" || fail "$name: belongs to somebody else"
  unset LD_LIBRARY_PATH LD_PRELOAD
  for variable in LD_LIBRARY_PATH LD_PRELOAD; do
    value=$(tr '\0' '\n' < "/proc/$subject/environ" | sed -n "s/^$variable=//p")
    [ -z "$value" ] || export "$variable=$value"
  done
  examine "$program"
  # Libraries loaded at run time, as Python does: first those that call others, so that each is examined with those that
  # it needs.
  for types in U TWi; do
    while read -r file; do
      if [ ! -f "$file" ] || grep -qxF "$file" "$work/examined" || ! is_elf "$file"; then continue; fi
      if [ -n "$(echo "$file" | has $types -D)$(echo "$file" | has t)" ]; then examine "$file"; fi
    done < "$work/mapped"
  done
  while read -r _ file; do
    case $file in /*) grep -qxF "$file" "$work/mapped" || fail "$name has not loaded $file: what it began with has changed" ;; esac
  done < "$work/found"
else
  name=$subject
  [ -e "$subject" ] || fail "$subject: no such file, and no such process"
  if [ ! -f "$subject" ] || [ ! -r "$subject" ]; then fail "$subject: not a file that can be read"; fi
  is_elf "$subject" || fail "$subject is not a program but a script or data; ask for the program that it starts, or for a process"
  program=$(readlink -f "$subject")
  if readelf -hW "$program" 2> /dev/null | grep -q 'Type: *REL'; then fail "$subject is not linked yet"; fi
  examine "$program"
fi

# Flags of gfortran in the debug information that make default reals and integers 64 bits wide.
wide=$(grep -aoE 'GNU Fortran[^[:cntrl:]]*' "$program" | tr ' ' '\n' |
  grep -E '^-f(default-|real-4-|integer-4-)(real|integer)-8$' | sort -u || true)

# compare_kinds LIBRARY: fails with a line if the program was compiled for another of our libraries
compare_kinds() {
  needs=$1
  case $1:$wide in
    libstripack_i8:*) ;;
    *integer-8*) needs=libstripack_i8 ;;
    libstripack_r4:*real-8*) needs=libstripack ;;
  esac
  [ "$needs" != "$1" ] || return 0
  echo "pstripack-config --check: $name is compiled with $(echo "$wide" | tr '\n' ' ')and needs $needs, not $1" >&2
  return 1
}

status=0
sort -u "$work/found" -o "$work/found"
# Few processes: their starts are what takes time.
awk -v routines="$routines" '
  { found[$1] = found[$1] $0 "\n" }
  END {
    for (k = 1; k <= split(routines, name, " "); ++k) {
      lines = found[name[k] "_"] ? found[name[k] "_"] : name[k] "_ \n"
      for (i = 1; i < split(lines, line, "\n"); ++i) print toupper(name[k]), line[i]
    }
  }' "$work/found" | {
  asked=
  while read -r routine symbol file; do
    where=$file
    [ "$file" != "$program" ] || where="in the program itself"
    case $file in
      "") answer="not called" ;;
      "?")
        if grep -q "^$symbol [/-]" "$work/found"; then continue; fi
        answer="not seen; the program is stripped"
        # A program that contains any of the routines contains TRMESH: it suffices to know whose that is.
        grep -q '^trmesh_ /' "$work/found" || status=1 ;;
      -) status=1 answer="nobody's: the symbol is undefined" ;;
      *)
        [ "$file" = "$asked" ] || asked=$file texts=" $(texts_of "$file" | tr '\n' ' ')"
        library=${texts%% "$routine "*}
        if [ "$library" = "$texts" ]; then library=; else library=${library##* }; fi
        if [ -n "$library" ]; then answer="ours ($library): $where"; else status=1 answer="NOT OURS: $where"; fi
        if [ "$routine" = TRMESH ] && [ -n "$library" ]; then compare_kinds "$library" || status=1; fi
        if [ "$routine" = TRMESH ] && [ -z "$library" ] && is_planar "$file"; then
          echo "pstripack-config --check: $file is the planar TRIPACK: remove it from the link line" >&2
        fi ;;
    esac
    printf '%-6s  %s\n' "$routine" "$answer"
  done
  grep '^__' "$work/found" > "$work/modules" || true
  while read -r symbol file; do
    where=$file
    [ "$file" != "$program" ] || where="in the program itself"
    if [ -f "$file" ] && objdump -d --disassemble="$symbol" "$file" | grep -q '<trmesh_[@>]'; then
      printf 'TRMESH  %s calls trmesh_: %s\n' "$symbol" "$where"
    else
      status=1
      printf 'TRMESH  NOT OURS: %s: %s\n' "$symbol" "$where"
    fi
  done < "$work/modules"
  sort -u "$work/misled" | while read -r line; do
    echo "pstripack-config --check: the planar TRIPACK $line; LD_PRELOAD causes this: unset it" >&2
  done
  c_calls=$({ $nm -P "$program"; $nm -DP "$program"; } 2> /dev/null | awk '$1 ~ /^pstripack_/ && $2 ~ /^[UT]$/ { print $1 }' |
    sort -u | head -n 3 | tr '\n' ' ')
  if ! [ -s "$work/found" ] && [ -n "$c_calls" ]; then
    echo "ours: $name calls the C interface: $c_calls"
  elif ! [ -s "$work/found" ]; then
    echo "pstripack-config --check: $name calls none of them; of what it loads while it runs, ask by its process" >&2
    status=1
  fi
  exit $status
}
