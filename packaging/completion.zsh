#compdef pstripack stripack-compare pstripack-config pstripack-run
# Completion in zsh for pstripack, stripack-compare, pstripack-config and pstripack-run: commands and options come from
# the program's own --help, without its examples, so they always fit its version.

# _pstripack_words PROGRAM WORD...: the possible last words
_pstripack_words() {
  local program=$1 current=${@[-1]} previous=${@[-2]} command="" word
  local -a commands
  commands=(${(f)"$("$program" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')"})
  for word in "${@[2,-2]}"; do
    if (( ${commands[(Ie)$word]} )); then
      command=$word
      break
    fi
  done
  if [[ ${program:t} == pstripack-config && $previous == --abi ]]; then
    "$program" --abi 2>/dev/null | cut -d ' ' -f 1
  elif [[ $current == -* || ${program:t} == pstripack-config ]]; then
    "$program" ${command:+$command} --help 2>/dev/null | sed '/^ *\(example: \)*p*stripack[a-z-]* /d' |
      grep -oE -e '(^|[][ ,"])--?[a-z][a-z0-9-]*' | grep -oE -e '--?[a-z][a-z0-9-]*' | sort -u
  elif [[ -z $command ]]; then
    print -l -- $commands
  fi
}

_pstripack() {
  local -a offered
  offered=(${(f)"$(_pstripack_words "${(@)words[1,CURRENT]}")"})
  if (( $#offered )); then
    compadd -- $offered
  else
    _files
  fi
}

# zsh loads this file as a function; its name may be that of any of the programs.
if [[ $funcstack[1] == _(pstripack|stripack-compare)* ]]; then
  _pstripack "$@"
fi
