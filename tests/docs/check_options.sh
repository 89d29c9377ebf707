#!/bin/sh
# Fails unless the man page of a tool has exactly the options in the --help of the tool and its subcommands.
# Usage: check_options.sh TOOL MAN1_DIR
set -eu
tool=$1
name=$(basename "$tool")
page=$2/$name.1

# The options in a text, one per line: -x and --word.
options() { grep -oE -e '(^|[][ ,"])--?[a-z][a-z0-9-]*' | grep -oE -e '--?[a-z][a-z0-9-]*' | sort -u; }
subcommands=$("$tool" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
for subcommand in "" $subcommands; do
  # shellcheck disable=SC2086  # none, or a word
  "$tool" $subcommand --help
done | options > "told_by_$name"
sed 's/\\-/-/g; s/\\f[A-Z]//g' "$page" | options > "on_the_page_of_$name"
diff "told_by_$name" "on_the_page_of_$name"
