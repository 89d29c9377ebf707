#!/bin/bash
# Fails unless a shell (bash, zsh or fish) offers exactly the commands and options on a tool's man page.
# Usage: completion.sh SHELL COMPLETION MAN1_DIR TOOL...
set -eu
shell=$1 completion=$2 pages=$3
shift 3
kind=$(basename "$shell")
# shellcheck disable=SC1090
[ "$kind" != bash ] || source "$completion"

# offered WORD...: the completions of the last word of a command line
offered() {
  case $kind in
    bash)
      COMP_WORDS=("$@")
      COMP_CWORD=$(($# - 1))
      COMPREPLY=()
      _pstripack_completion "$1" "${!#}" "${@:$#-1:1}"
      printf '%s\n' "${COMPREPLY[@]}" ;;
    # These shells select the words with the right beginning themselves.
    zsh) "$shell" -f -c 'source "$1"; shift; _pstripack_words "$@"' zsh "$completion" "$@" | beginning_with "${!#}" ;;
    fish) "$shell" --no-config -c 'source $argv[1]; __pstripack_words $argv[2..-1]' "$completion" "$@" |
      beginning_with "${!#}" ;;
  esac | sort -u
}
beginning_with() { awk -v begin="$1" 'index($0, begin) == 1'; }
# is EXPECTED WORD...: fails unless these words are offered
is() {
  expected=$1
  shift
  found=$(offered "$@" | grep . | paste -s -d ' ' || true)
  [ "$found" = "$expected" ] || { echo "$*: offered '$found', expected '$expected'" >&2; exit 1; }
}

for tool in "$@"; do
  name=$(basename "$tool")
  commands=$(offered "$tool" "" | grep -v '^-' || true)
  for command in "" $commands; do
    # shellcheck disable=SC2086  # none, or a word
    offered "$tool" $command -
  done | sort -u | grep . > "offered_by_${kind}_$name"
  sed 's/\\-/-/g; s/\\f[A-Z]//g' "$pages/$name.1" | grep -oE -e '(^|[][ ,"])--?[a-z][a-z0-9-]*' |
    grep -oE -e '--?[a-z][a-z0-9-]*' | sort -u > "on_the_page_of_${kind}_$name"
  diff "offered_by_${kind}_$name" "on_the_page_of_${kind}_$name"

  case $name in
    pstripack)
      is 'plot points' "$tool" p
      is '--help --quiet --serial --threads --units --version' "$tool" --  # not those of examples
      is '--density --density-file' "$tool" scvt -o mesh.nc --dens
      is '' "$tool" plot mesh
      if [ "$kind" = fish ]; then  # complete as at the prompt
        found=$("$shell" --no-config -c 'source $argv[1]; complete -C $argv[2]' "$completion" "$tool triang")
        [ "$found" = triangulate ] || { echo "fish completes '$found'" >&2; exit 1; }
      fi ;;
    stripack-compare)
      is 'record replay run' "$tool" r
      is '--original --original-abi' "$tool" replay calls.rec --orig ;;
    pstripack-config)
      is 'i8' "$tool" --abi i
      is '--static --switch-dir' "$tool" --s ;;
  esac
  echo "$name: $(wc -l < "offered_by_${kind}_$name") options, commands: ${commands//$'\n'/ }"
done
