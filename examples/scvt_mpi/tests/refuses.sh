#!/bin/sh
# refuses.sh MESSAGE RANKS PROGRAM ARGUMENT...: every rank must end with exit code 1, and stderr must have one line with
# MESSAGE. The environment variable MPIEXEC has the command that starts ranks.
set -u
message=$1 ranks=$2
shift 2
errors=$(mktemp)
trap 'rm -f "$errors"' EXIT
# shellcheck disable=SC2016,SC2086  # $0 and $@ are those of each rank; MPIEXEC is words on purpose
output=$($MPIEXEC -n "$ranks" sh -c '"$0" "$@"; echo "exit code $?"' "$@" 2> "$errors")
echo "$output"
cat "$errors"
[ "$(echo "$output" | grep -c '^exit code 1$')" -eq "$ranks" ] || { echo "FAILED: exit codes"; exit 1; }
[ "$(grep -vc '^pstripack: mesh_' "$errors")" -eq 1 ] || { echo "FAILED: not one line"; exit 1; }
grep -q "^scvt_mpi: .*$message" "$errors" || { echo "FAILED: another message"; exit 1; }
