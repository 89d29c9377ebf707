#!/bin/sh
# A program linked with an original libstripack.so runs with ours without relinking: by LD_LIBRARY_PATH if it searches
# for libstripack.so, by LD_PRELOAD always. PSTRIPACK_REPORT=1 shows which library ran.
# Usage: switch.sh PREFIX CONSUMER_DIR WORK_DIR ABI ORIGINAL     ABI: r8, r4, 8arg; ORIGINAL: a library of that ABI
set -eu
prefix=$1 consumer=$2 work=$3 abi=$4 original=$5
rm -rf "$work"
mkdir -p "$work/original"
cp "$original" "$work/original/libstripack.so"
switch=$("$prefix/bin/pstripack-config" --abi "$abi" --switch-dir)
fail() { echo "$*" >&2; exit 1; }

case $abi in
  r8) definitions="" ;;
  r4) definitions=-DSINGLE_PRECISION ;;
  8arg) definitions=-DEIGHT_ARGUMENTS ;;
esac
# shellcheck disable=SC2086  # none, or a word
gfortran $definitions -c "$consumer/switched.F90" -o "$work/legacy.o"
gfortran "$work/legacy.o" -o "$work/legacy" -L"$work/original" -lstripack
gfortran "$work/legacy.o" -o "$work/bound" -L"$work/original" -lstripack -Wl,--disable-new-dtags,-rpath,"$work/original"
for program in legacy bound; do
  readelf -d "$work/$program" | grep -q 'NEEDED.*\[libstripack.so\]' || fail "$program is not linked with libstripack.so"
done

# runs_with original|ours PROGRAM VARIABLE=VALUE...
runs_with() {
  which=$1 program=$2
  shift 2
  env "$@" PSTRIPACK_REPORT=1 "$work/$program" > "$work/output" 2> "$work/report" ||
    { cat "$work/output" "$work/report"; fail "$program with $* fails"; }
  grep -qx 'switched: right' "$work/output" || fail "$program with $*: another result"
  found=original
  if grep -q '^pstripack: threads n=6 ' "$work/report"; then found=ours; fi
  [ "$found" = "$which" ] || fail "$program with $* ran with $found"
  echo "$abi: $program runs with $found: $*"
}
runs_with original legacy LD_LIBRARY_PATH="$work/original"
runs_with ours legacy LD_LIBRARY_PATH="$switch"
runs_with ours legacy LD_LIBRARY_PATH="$work/original" LD_PRELOAD="$switch/libstripack.so"
# DT_RPATH is stronger than LD_LIBRARY_PATH.
runs_with original bound LD_LIBRARY_PATH="$switch"
runs_with ours bound LD_PRELOAD="$switch/libstripack.so"

# Switched, it is compared with the library that it was linked with.
if [ -x "$prefix/bin/stripack-compare" ] && [ "$abi" = r8 ]; then
  LD_LIBRARY_PATH=$switch PSTRIPACK_CHECK="lib:$work/original/libstripack.so,log=$work/check.log" "$work/legacy"
  grep ' equal$' "$work/check.log"
fi
