# pstripack-config --check PROGRAM|PID: whose TRMESH, TRLIST, CRLIST, TRFIND, GETNP a program calls.
#
# Three questions to three witnesses, none of which runs the program:
#   what the program has itself           its symbols (nm); a program that is stripped has none left
#   what it takes from shared libraries   the loader, which relocates the program, says each binding, and ends
#   which of those routines are ours      the text "@(#)PSTRIPACK library ROUTINE", which is in each of ours, linked
#                                         statically or not, stripped or not
# Exit status: 0 all are ours, 1 not all, 2 no answer.
# shellcheck shell=sh
set -eu
subject=$1
routines="TRMESH TRLIST CRLIST TRFIND GETNP"
symbols='^(trmesh|trlist|crlist|trfind|getnp)_$'

fail() {
  echo "pstripack-config --check: $*" >&2
  exit 2
}
for tool in nm readelf; do
  command -v $tool > /dev/null || fail "needs $tool; Debian: apt-get install binutils"
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
: > "$work/found"      # lines: symbol, object that has it; "?" for an object: cannot be told, "-": nobody has it
: > "$work/libraries"  # what the loader loads for the objects so far

is_elf() { [ "$(head -c 4 "$1" | tail -c 3)" = ELF ]; }
ours() { LC_ALL=C grep -aoE '@\(#\)PSTRIPACK [a-z0-9_]+ [A-Z]+' "$1" || true; }
lower() { echo "$1" | tr '[:upper:]' '[:lower:]'; }

# has OBJECT TYPES [nm's option]: which of the symbols are defined in it, with one of these types
has() {
  nm ${3:+"$3"} -P "$1" 2> /dev/null | awk -v symbols="$symbols" -v types="[$2]" '$1 ~ symbols && $2 ~ types { print $1 }'
}

# loader_says OBJECT: bindings and libraries, in $work/loader
loader_says() {
  loader=$(readelf -lW "$1" | sed -n 's/.*program interpreter: \(.*\)]/\1/p')
  [ -n "$loader" ] || loader=$(readelf -lW "$(readlink -f /bin/sh)" | sed -n 's/.*program interpreter: \(.*\)]/\1/p')
  env -u LD_DEBUG_OUTPUT LD_TRACE_LOADED_OBJECTS=1 LD_WARN=yes LD_BIND_NOW=yes LD_DEBUG=bindings \
    "$loader" "$1" > "$work/loader" 2>&1 || { cat "$work/loader" >&2; fail "$1 cannot be loaded"; }
  grep -q 'binding file' "$work/loader" || fail "$loader does not tell its bindings: glibc's loader does"
}

# examine OBJECT: adds to $work/found who has what it calls, and what the libraries call that it is linked with
examine() {
  object=$1
  : > "$work/loader"
  header=$(readelf -hldSW "$object")
  is_program=no
  case $header in *"program interpreter"* | *"Type:"*"EXEC "* | *"Flags:"*PIE*) is_program=yes ;; esac
  case $header in *"(NEEDED)"*) loader_says "$object" ;; esac
  awk '$2 == "=>" && $3 ~ /^\// { print $3 }' "$work/loader" > "$work/loaded"
  cat "$work/loaded" >> "$work/libraries"
  awk '$2 == "=>" && $3 == "not" { print $1 }' "$work/loader" | sort -u | while read -r missing; do
    echo "pstripack-config --check: $object: $missing is not found" >&2
  done

  # Calls between objects.
  sed -n "s/.*binding file .* to \(.*\) \[0\]: normal symbol \`\([^']*\)'.*/\2 \1/p; s/.*undefined symbol: \([^ \t]*\).*/\1 -/p" \
    "$work/loader" | awk -v symbols="$symbols" '$1 ~ symbols' >> "$work/found"

  # Calls within an object: of a program to what it has; of a library to what it does not show to others.
  if [ $is_program = yes ]; then types=TtWwi; else types=t; fi
  { has "$object" "$types"; if [ $is_program = yes ]; then has "$object" TWi -D; fi; } | sed "s|\$| $object|" >> "$work/found"
  while read -r library; do
    has "$library" t | sed "s|\$| $library|"
  done < "$work/loaded" >> "$work/found"
  [ $is_program = yes ] || return 0
  ours "$object" | while read -r _ _ routine; do echo "$(lower "$routine")_ $object"; done >> "$work/found"

  # Stripped: what is linked in is seen only if a library has the same name, as the linker then keeps it.
  case $header in *" SYMTAB "*) return 0 ;; esac
  while read -r library; do has "$library" TWi -D; done < "$work/loaded" > "$work/shown"
  for routine in $routines; do
    symbol=$(lower "$routine")_
    grep -q "^$symbol " "$work/found" || grep -qx "$symbol" "$work/shown" || echo "$symbol ?" >> "$work/found"
  done
}

if [ ! -e "$subject" ] && [ -d "/proc/$subject" ] && [ "${subject#*[!0-9]}" = "$subject" ]; then
  # A process: its program with its environment, then what it has loaded later, each by itself.
  name="process $subject"
  program=$(readlink "/proc/$subject/exe") && [ -r "/proc/$subject/maps" ] && [ -r "/proc/$subject/environ" ] ||
    fail "$name: not yours to look at, or without a program"
  [ -e "$program" ] || fail "$name: its program is not there: $program"
  awk '$6 ~ /^\// { sub(/^([^ ]+ +){5}/, ""); print }' "/proc/$subject/maps" | sort -u > "$work/mapped"
  unset LD_LIBRARY_PATH LD_PRELOAD
  for variable in LD_LIBRARY_PATH LD_PRELOAD; do
    if value=$(tr '\0' '\n' < "/proc/$subject/environ" | sed -n "s/^$variable=//p") && [ -n "$value" ]; then
      export "$variable=$value"
    fi
  done
  cd "/proc/$subject/cwd"
  examine "$program"
  while read -r object; do
    [ -e "$object" ] && is_elf "$object" || continue
    while read -r known; do readlink -f "$known"; done < "$work/libraries" | grep -qxF "$object" && continue
    [ "$object" = "$program" ] && continue
    nm -DP "$object" 2> /dev/null | awk -v symbols="$symbols" '$1 ~ symbols' | grep -q . || [ -n "$(has "$object" t)" ] ||
      continue
    examine "$object"
  done < "$work/mapped"
  while read -r symbol object; do
    case $object in
      /*) grep -qxF "$(readlink -f "$object")" "$work/mapped" || fail "$name has not loaded $object: something has changed since it began" ;;
    esac
  done < "$work/found"
else
  name=$subject
  [ -e "$subject" ] || fail "$subject: no such file or process"
  [ -f "$subject" ] && [ -r "$subject" ] || fail "$subject: not a file that can be read"
  is_elf "$subject" || fail "$subject is a script or data, not a program: name the program that it starts, or a process by its number"
  program=$(readlink -f "$subject")
  examine "$program"
fi

status=0 called=0
sort -u "$work/found" -o "$work/found"
for routine in $routines; do
  symbol=$(lower "$routine")_
  if ! grep -q "^$symbol " "$work/found"; then
    echo "$routine  not called"
    continue
  fi
  called=1
  while read -r found object; do
    [ "$found" = "$symbol" ] || continue
    where=$object
    [ "$object" != "$program" ] || where="the program itself"
    case $object in
      "?") status=1 text="cannot tell: the program is stripped; ask before it is" ;;
      -) status=1 text="NOBODY'S: no library has it" ;;
      *)
        library=$(ours "$object" | sed -n "s/.*PSTRIPACK \(.*\) $routine\$/\1/p" | head -n 1)
        if [ -n "$library" ]; then
          text="ours, of $library: $where"
        else
          status=1 text="NOT OURS: $where"
        fi ;;
    esac
    echo "$routine  $text"
  done < "$work/found"
done
if [ $called = 0 ]; then
  echo "$name calls none of these. What it loads while it runs is seen in its process: --check PID" >&2
  status=1
fi
exit $status
