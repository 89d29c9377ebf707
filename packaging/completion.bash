# Completion in bash for pstripack, stripack-compare, pstripack-config and pstripack-run: commands and options
# come from the program's own --help, without its examples, so they always fit its version.

_pstripack_completion() {
  local program=$1 current=$2 previous=$3 command="" commands word
  commands=$("$program" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if [[ " ${commands//$'\n'/ } " == *" $word "* ]]; then
      command=$word
      break
    fi
  done
  local words=""
  if [[ ${program##*/} == pstripack-config && $previous == --abi ]]; then
    words=$("$program" --abi 2>/dev/null | cut -d ' ' -f 1)
  elif [[ $current == -* || ${program##*/} == pstripack-config ]]; then
    # shellcheck disable=SC2086  # none, or a word
    words=$("$program" $command --help 2>/dev/null | sed '/^ *\(example: \)*p*stripack[a-z-]* /d' |
      grep -oE -e '(^|[][ ,"])--?[a-z][a-z0-9-]*' | grep -oE -e '--?[a-z][a-z0-9-]*' | sort -u)
  elif [[ -z $command ]]; then
    words=$commands
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}

# Without a match, complete file names.
complete -o bashdefault -o default -F _pstripack_completion pstripack stripack-compare pstripack-config pstripack-run
