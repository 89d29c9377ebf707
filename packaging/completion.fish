# Completion in fish for pstripack, stripack-compare, pstripack-config and pstripack-run: commands and options come from
# the program's own --help, without its examples, so they always fit its version.

# __pstripack_words PROGRAM WORD...: the possible last words
function __pstripack_words
    set -l program $argv[1]
    set -l current $argv[-1]
    set -l previous $argv[-2]
    set -l commands ($program --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
    set -l command
    if test (count $argv) -gt 2
        for word in $argv[2..-2]
            if contains -- $word $commands
                set command $word
                break
            end
        end
    end
    set -l name (string replace -r '.*/' '' -- $program)
    if test $name = pstripack-config; and test "$previous" = --abi
        $program --abi 2>/dev/null | cut -d ' ' -f 1
    else if string match -q -- '-*' "$current"; or test $name = pstripack-config
        $program $command --help 2>/dev/null | sed '/^ *\(example: \)*p*stripack[a-z-]* /d' |
            grep -oE -e '(^|[][ ,"])--?[a-z][a-z0-9-]*' | grep -oE -e '--?[a-z][a-z0-9-]*' | sort -u
    else if test -z "$command"
        printf '%s\n' $commands
    end
end

# fish also offers file names.
for program in pstripack stripack-compare pstripack-config pstripack-run
    complete -c $program -a '(__pstripack_words (commandline -opc) (commandline -ct))'
end
