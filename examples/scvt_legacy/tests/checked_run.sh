#!/bin/sh
# Runs the legacy program with and without a check against the original: mesh and output must be the same, and every
# difference explained. Usage: checked_run.sh SCVT STRIPACK_COMPARE
set -u
scvt=$1
export PSTRIPACK_COMPARE="$2"
fail() {
  echo "FAILED: $*"
  cat log
  exit 1
}

# 20 iterations from a longitude-latitude grid, which has many exact ties.
awk 'BEGIN {
  for (row = 1; row < 12; ++row)
    for (column = 0; column < 24; ++column) {
      lat = (row / 12 - 0.5) * 3.14159265358979; lon = column / 12 * 3.14159265358979
      printf "%.17g %.17g %.17g\n", cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)
    }
  print "0 0 -1\n0 0 1"
}' > generators.txt
rm -f log
for name in alone checked; do
  "$scvt" -f generators.txt -i 20 -o $name > $name.out 2> $name.err || fail "$name: exit code"
  [ ! -s $name.err ] || fail "$name: something on stderr"
  grep -v -e '^seconds' -e '^wrote' $name.out > $name.text
  export PSTRIPACK_CHECK=lib:,log=log
done
cmp alone.text checked.text || fail "stdout differs"
cmp alone_points.txt checked_points.txt || fail "the points differ"
cmp alone_triangles.txt checked_triangles.txt || fail "the triangles differ"
grep -q ']: 21 calls, ' log || fail "not all calls were checked"
grep -q ', [0-9]* explained$' log || fail "no difference, or one that is not explained"
