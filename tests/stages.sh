# shellcheck shell=sh
# For scripts that build and test: measures their stages. Each stage is printed when it ends, and appended to the file
# named by STAGES, if set.

# stage NAME COMMAND...: runs it; the script ends if it fails
stage() {
  stage_name=$1 stage_start=$(date +%s)
  shift
  times > "${TMPDIR:-/tmp}/times.$$"
  stage_code=0
  "$@" || stage_code=$?
  times >> "${TMPDIR:-/tmp}/times.$$"
  # The times of the shell and of its children, before and after.
  stage_line=$(awk -v name="$stage_name" -v seconds=$(($(date +%s) - stage_start)) '
    { for (i = 1; i <= 2; ++i) { split($i, part, /[ms]/); sum[int((NR - 1) / 2)] += 60 * part[1] + part[2] } }
    END { printf "%-32s %6d s, %6d processor seconds", name, seconds, sum[1] - sum[0] }' "${TMPDIR:-/tmp}/times.$$")
  rm -f "${TMPDIR:-/tmp}/times.$$"
  echo "stage: $stage_line" >&2
  [ -z "${STAGES:-}" ] || echo "$stage_line" >> "$STAGES"
  [ $stage_code -eq 0 ] || exit $stage_code
}

# slowest FILE: the twenty slowest tests of a JUnit file, in seconds
slowest() {
  echo "The slowest tests of $1:"
  sed -n 's/.*<testcase name="\([^"]*\)".* time="\([0-9.e+-]*\)".*/\2 \1/p' "$1" | sort -rg | head -n 20 |
    awk '{ time = $1; sub(/^[^ ]* /, ""); printf "%8.1f  %s\n", time, $0 }'
}
