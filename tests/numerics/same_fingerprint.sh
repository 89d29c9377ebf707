#!/bin/sh
# Usage: same_fingerprint.sh PLAIN FAST_MATH
# Two programs of fingerprint.cpp print the same, although the second was started with flush-to-zero.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" >"$folder/plain" 2>"$folder/plain.err"
"$2" >"$folder/fast" 2>"$folder/fast.err"
grep 'started with MXCSR' "$folder/plain.err" "$folder/fast.err"
if [ "$(uname -m)" = x86_64 ]; then
  grep -q 'MXCSR = 1f80' "$folder/plain.err"
  grep -q 'MXCSR = 9fc0' "$folder/fast.err"
fi
diff "$folder/plain" "$folder/fast"
