#!/bin/bash
# In bash every command and option on a tool's man page is offered, and no other.
# Usage: completion.sh COMPLETION MAN1_DIR TOOL...
set -eu
# shellcheck disable=SC1090
source "$1"
pages=$2
shift 2

# offered WORD...: what completes the last of the words of a command line
offered() {
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _pstripack_completion "$1" "${!#}" "${@:$#-1:1}"
  printf '%s\n' "${COMPREPLY[@]}" | sort -u
}
# is EXPECTED WORD...
is() {
  expected=$1
  shift
  found=$(offered "$@" | tr '\n' ' ')
  [ "$found" = "$expected " ] || { echo "$*: offered '$found', expected '$expected '" >&2; exit 1; }
}

for tool in "$@"; do
  name=$(basename "$tool")
  commands=$(offered "$tool" "" | grep -v '^-' || true)
  for command in "" $commands; do
    # shellcheck disable=SC2086  # none, or a word
    offered "$tool" $command -
  done | sort -u | grep . > "offered_by_$name"
  sed 's/\\-/-/g; s/\\f[A-Z]//g' "$pages/$name.1" | grep -oE -e '(^|[][ ,"])--?[a-z][a-z0-9-]*' |
    grep -oE -e '--?[a-z][a-z0-9-]*' | sort -u > "on_the_page_of_$name"
  diff "offered_by_$name" "on_the_page_of_$name"

  case $name in
    pstripack)
      is 'plot points' "$tool" p
      is '--density --density-file' "$tool" scvt -o mesh.nc --dens
      is '' "$tool" plot mesh ;;
    stripack-compare)
      is 'record replay run' "$tool" r
      is '--original --original-abi' "$tool" replay calls.rec --orig ;;
    pstripack-config)
      is 'i8' "$tool" --abi i
      is '--static --switch-dir' "$tool" --s ;;
  esac
  echo "$name: $(wc -l < "offered_by_$name") options, commands: ${commands//$'\n'/ }"
done
