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

# run_ctest BUILD OPTION...: runs the tests. Leaves out what GoogleTest prints of cases that pass. Prints the cases of
# GoogleTest that were skipped, and the slowest tests and cases, in seconds.
run_ctest() {
  run_build=$1
  shift
  { ctest "$@" --output-junit tests.xml && echo passed > "$run_build/passed" || rm -f "$run_build/passed"; } |
    sed '/^\[ RUN  /{N;/\n\[       OK \]/d;}'
  sed -n 's/^\[  SKIPPED \] \(.*\) ([0-9]* ms)$/skipped: \1/p' "$run_build/Testing/Temporary/LastTest.log"
  echo "The slowest tests and cases:"
  { sed -n 's/.*<testcase name="\([^"]*\)".* time="\([0-9.e+-]*\)".*/\2 \1/p' "$run_build/tests.xml" | sort -rg | head -n 20
    sed -n 's/^\[       OK \] \(.*\) (\([0-9]*\) ms)$/\2e-3 \1/p' "$run_build/Testing/Temporary/LastTest.log" |
      sort -rg | head -n 20; } |
    awk '{ time = $1; sub(/^[^ ]* /, ""); printf "%8.1f  %s\n", time, $0 }'
  [ -f "$run_build/passed" ]
}
