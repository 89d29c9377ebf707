#!/bin/sh
# abi.sh check LIBRARY BASELINE [HEADER...]   fails where a program that was built with the library of the baseline might
#                                             not run with this one: functions removed, arguments or soname changed
# abi.sh accept LIBRARY BASELINE [HEADER...]  makes this library the baseline
# With headers only the functions that they declare count.
set -eu
action=$1 library=$2 baseline=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

printf '[suppress_type]\n  name = pstripack_mesh\n  drop = yes\n' > "$work/suppressions"  # its fields are not public
if [ $# -gt 0 ]; then
  functions=$(sed -n 's/^PSTRIPACK_API [^(]*[ *]\(pstripack_[a-z0-9_]*\)(.*/\1/p' "$@" | paste -sd'|')
  for name in name symbol_name; do
    printf '[suppress_function]\n  %s_not_regexp = ^(%s)$\n  drop = yes\n' $name "$functions"
  done >> "$work/suppressions"
fi

if [ "$action" = accept ]; then
  abidw --suppressions "$work/suppressions" --exported-interfaces-only --no-architecture --no-corpus-path \
    --no-show-locs --no-comp-dir-path --no-elf-needed --no-write-default-sizes "$library" > "$work/described"
  [ -s "$work/described" ]  # abidw ends with 0 where there is no library
  sed -E "s/ path='([^']*\/)?/ path='/" "$work/described" > "$baseline"
else
  # abidiff calls a baseline that it cannot read the same as the library.
  if ! abidiff --suppressions "$work/suppressions" --no-architecture --no-added-syms "$baseline" "$library" \
       2> "$work/errors" || [ -s "$work/errors" ]; then
    cat "$work/errors" >&2
    echo "$library: the ABI is not that of $baseline. If that is intended: a new MAJOR version (CONTRIBUTING.md, Releases)" >&2
    exit 1
  fi
fi
