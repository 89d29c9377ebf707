#!/bin/sh
# Every tool on a disk that is full or becomes full: it must print one line on stderr that names the file and end with a
# nonzero exit code. The environment has COMPARE, BENCHMARK, SCALING ("" if not built) and WORK. (For the library's own
# files, PSTRIPACK_REPORT and PSTRIPACK_CHECK, see report_test and check_test.)
# shellcheck disable=SC2015,SC2086,SC2154
set -u
dir=$WORK/full_disk
rm -rf "$dir"
mkdir -p "$dir"
cd "$dir" || exit 1
ln -s /dev/full full.svg
export OMP_NUM_THREADS=1

fail() {
  echo "FAILED: $*"
  cat err
  exit 1
}

# refuses FILE COMMAND...: its only line on stderr says that it cannot write FILE
refuses() {
  file=$1
  shift
  "$@" > /dev/null 2> err
  code=$?
  [ $code -ne 0 ] && [ $code -lt 126 ] || fail "exit code $code of $*"
  grep -E 'cannot write|cannot be written' err | grep -qF "$file" || fail "it does not say that it cannot write $file: $*"
  [ "$(grep -c '' err)" -eq 1 ] || fail "not one line of $*"
}
# cannot_print COMMAND...: the same for standard output
cannot_print() {
  "$@" > /dev/full 2> err
  code=$?
  [ $code -ne 0 ] && [ $code -lt 126 ] || fail "exit code $code of $* > /dev/full"
  grep -qE 'stdout: cannot be written|cannot write' err || fail "it does not say that it cannot print: $*"
}

if [ -n "$COMPARE" ]; then
  run="$COMPARE run --points latlon --n 300 --repeats 1"
  for output in csv json junit; do refuses /dev/full $run --$output /dev/full; done
  refuses full.svg $run --plot full.svg
  # A disk of 4 kilobytes that becomes full.
  mkdir small
  on_small_disk() { unshare --map-root-user --mount sh -c 'mount -t tmpfs -o size=4k none small && "$@"' sh "$@"; }
  if on_small_disk true 2> /dev/null; then
    refuses small/json on_small_disk $run --order given,shuffled,sorted --json small/json
    refuses small/junit on_small_disk $run --order given,shuffled,sorted --show 50 --junit small/junit
    refuses small/plot.svg on_small_disk $run --plot small/plot.svg
  else
    echo "cannot mount a file system here: a disk that becomes full is not tested"
  fi
  cannot_print $run
fi
if [ -n "$SCALING" ]; then
  scaling="$SCALING --ranks 1 --sizes 1000 --repeats 1 --modes distributed"
  cannot_print $scaling
fi
if [ -n "$BENCHMARK" ]; then
  curves="$BENCHMARK curves --sizes 100 --repeats 1 --contenders pstripack"
  cannot_print $curves
fi
