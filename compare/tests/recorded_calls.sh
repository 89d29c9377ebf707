#!/bin/sh
# Tests of lists, record and replay, and of the check beside a model: recorded_calls.sh CASE, with COMPARE,
# CALLER and WORK in the environment; ORIGINAL, ORIGINAL_8ARG, ORIGINAL_R4, ORIGINAL_CS, HANGS, CRASHES, STOPS,
# LIBRARY, LIBRARY_R4, LIBRARY_8ARG and LIBRARY_I8 where there are such libraries.
# shellcheck disable=SC2153,SC2154
set -u
case=$1
dir=$WORK/$case
rm -rf "$dir"
mkdir -p "$dir"
cd "$dir" || exit 1

fail() {
  echo "FAILED: $*"
  for file in out err; do [ -s $file ] && { echo "--- $file"; cat $file; }; done
  exit 1
}
# expect CODE COMMAND...: fails unless the command ends with this exit code; its output is in the files out and err
expect() {
  expected=$1
  shift
  "$@" > out 2> err
  code=$?
  [ $code -eq "$expected" ] || fail "exit code $code of: $*"
}
# prints FILE LINE: the file has exactly this line; says FILE TEXT: it contains the text
prints() { grep -qxF -- "$2" "$1" || fail "$1 lacks the line: $2"; }
says() { grep -qF -- "$2" "$1" || fail "$1 does not say: $2"; }
recorded() {
  file=$1
  shift
  PSTRIPACK_CHECK=$file "$CALLER" "$@" > /dev/null 2>&1
}

case $case in
record)
  expect 5 "$COMPARE" record -- "$CALLER" random 100 3 5
  printf 'IER 0\nIER 0\nIER 0\n' | cmp - out || fail "the stdout of the model"
  prints err "stripack-compare: 3 calls of TRMESH in calls.rec, n = 100"
  expect 0 "$COMPARE" record -o calls.rec -- "$CALLER" latlon 200
  prints err "stripack-compare: 1 call of TRMESH in calls.rec, n = 202"
  expect 0 "$COMPARE" record -- true
  says err "no call of TRMESH was recorded"
  expect 139 "$COMPARE" record -- "$CALLER" crash
  says err "n = 100; 1 did not return"
  ;;
record_refuses)
  echo "a model" > model.f90
  expect 2 "$COMPARE" record -o model.f90 -- true
  says err "model.f90 exists and is no recording"
  [ "$(cat model.f90)" = "a model" ] || fail "written over"
  expect 2 "$COMPARE" record
  expect 2 "$COMPARE" record -o /no/such/folder/calls.rec -- true
  says err "cannot write /no/such/folder/calls.rec"
  # A command that cannot be started leaves no file, and an older recording as it was.
  expect 127 "$COMPARE" record -o new.rec -- ./missing
  expect 127 "$COMPARE" record -o new.rec -- no-such-program
  printf '#!/no/such/interpreter\n' > script
  chmod +x script
  expect 127 "$COMPARE" record -o new.rec -- ./script
  [ ! -e new.rec ] || fail "new.rec was left"
  recorded old.rec random 100
  cp old.rec copy.rec
  expect 127 "$COMPARE" record -o old.rec -- ./missing
  cmp old.rec copy.rec
  says err "./missing: No such file"
  ;;
lists)
  recorded a.rec latlon 200 2
  recorded b.rec latlon 200 2
  recorded other.rec random 202
  expect 0 "$COMPARE" lists a.rec b.rec --bytes
  prints out "call 2: n = 202: same bytes"
  expect 1 "$COMPARE" lists a.rec other.rec
  says out "OTHER NODES, the first is 1"
  prints out "call 2: only in A"
  prints out "2 calls: 0 same bytes, 0 same triangles in other lists, 1 different, 1 only in one file"
  ;;
lists_of_text)
  echo "3 7  2 -3 3 -1 1 -2  2 1 4 3 6 5  2 4 6" > a.txt
  echo "3 7  -3 2 3 -1 1 -2  2 1 4 3 6 5  1 4 6" > slots.txt    # node 1 in other slots
  echo "3 7  3 -2 1 -3 2 -1  2 1 4 3 6 5  2 4 6" > reverse.txt  # the other orientation
  echo "3 7  2 -3 3 -1 1 -2  2 1 4 3 6 6  2 4 6" > broken.txt
  expect 0 "$COMPARE" lists a.txt slots.txt
  prints out "call 1: n = 3: 3 entries differ, first LIST(1): 2 and -3; the same triangles"
  expect 1 "$COMPARE" lists a.txt slots.txt --bytes
  expect 1 "$COMPARE" lists a.txt reverse.txt
  says out "triangles: 1 only in A (1 2 3), 1 only in B (1 3 2)"
  expect 1 "$COMPARE" lists a.txt broken.txt
  says out "B is no triangulation: "
  ;;
unreadable)
  recorded a.rec latlon 200 2
  head -c 20000 a.rec > short.rec
  : > empty.rec
  expect 2 "$COMPARE" lists a.rec short.rec
  says err "short.rec, byte 20000: the file ends within"
  prints out "call 1: n = 202: same bytes"
  expect 2 "$COMPARE" lists a.rec missing.rec
  says err "cannot read missing.rec: No such file"
  expect 2 "$COMPARE" lists empty.rec empty.rec
  expect 2 "$COMPARE" lists a.rec
  [ -n "$ORIGINAL" ] || exit 0
  expect 2 "$COMPARE" replay short.rec
  says err "short.rec, byte 20000: the file ends within"
  prints out "1 call, 1 explained"
  expect 2 "$COMPARE" replay empty.rec
  says err "empty.rec: no call is recorded in it"
  expect 2 "$COMPARE" replay .
  says err "cannot read .: Is a directory"
  ;;
replay)
  for set in "random 500" "latlon 500" "cap 300" "two 2" "duplicate 100" "collinear 100" "r4 latlon 200"; do
    # shellcheck disable=SC2086
    recorded calls.rec $set
  done
  expect 0 "$COMPARE" replay calls.rec --show 1 --json calls.json
  says out "n = 500: equal"
  says out ": n = 514: every difference is explained: exact tie "
  says out "  exact tie: arc "
  says out ": n = 2: IER = -1"
  prints out "7 calls, 5 equal, 2 explained"
  says calls.json '"exit_code": 0'
  says calls.json '"exact_tie"'
  expect 0 "$COMPARE" replay - < calls.rec
  says out "]: 7 calls, 5 equal, 2 explained"
  recorded crash.rec crash
  expect 0 "$COMPARE" replay crash.rec
  prints out "call 2: n = 100: no result on record, run again: equal"
  ;;
original_order)
  # Lists in the original's order are compared slot by slot. Under bitwise their mesh may be wrong.
  for set in "random 500" "latlon 500" "latlon 1000" "collinear 100"; do
    # shellcheck disable=SC2086
    PSTRIPACK_ORDER=bitwise-ngmath recorded calls.rec $set
  done
  expect 0 "$COMPARE" replay calls.rec
  [ "$(grep -c ': same bytes$' out)" -eq 3 ] || fail "not three of the same bytes"
  prints out "4 calls, 4 equal"
  # No false alarm in any order, for any family, by our library, by the original, or by ours in place of the original.
  without_alarm() {
    # shellcheck disable=SC2086
    PSTRIPACK_ORDER=$1 recorded "$1.rec" $2 all $3
    shift 3
    for way in "$@"; do
      # shellcheck disable=SC2086
      expect 0 "$COMPARE" replay $way --timeout 0.1 --show 1
      ! grep -q "WE ARE WRONG" out || fail "a false alarm: $way"
    done
  }
  for order in original bitwise ngmath bitwise-ngmath; do
    without_alarm $order "" 40 "$order.rec --library $LIBRARY" "$order.rec --original $ORIGINAL"
  done
  says out "a mesh of rounded tests, as bitwise-ngmath asks for ("
  without_alarm canonical delaunay 100 "canonical.rec --original $ORIGINAL" "canonical.rec --library $LIBRARY"
  rm bitwise.rec
  without_alarm bitwise r4 200 "bitwise.rec --library $LIBRARY_R4" "bitwise.rec --original $ORIGINAL_R4" \
    "bitwise.rec --original $LIBRARY"
  # LIST(1), at byte 104 + 2400 + 104, is changed.
  PSTRIPACK_ORDER=bitwise-ngmath recorded other.rec random 100
  printf '\377' | dd of=other.rec bs=1 seek=2608 conv=notrunc 2> dd.err
  expect 1 "$COMPARE" replay other.rec
  prints out "1 call, 1 WE ARE WRONG"
  ;;
against_us)
  # LIST(1) of the first result, at byte 104 + 2400 + 104, is changed.
  recorded calls.rec random 100
  printf '\377' | dd of=calls.rec bs=1 seek=2608 conv=notrunc 2> dd.err
  expect 1 "$COMPARE" replay calls.rec
  prints out "1 call, 1 WE ARE WRONG"
  says out "  WE ARE WRONG: our mesh is wrong: "
  ;;
library)
  recorded calls.rec latlon 500
  recorded calls.rec duplicate 100
  expect 0 "$COMPARE" replay calls.rec --library "$LIBRARY"
  prints out "call 1: n = 514: same bytes"
  prints out "2 calls, 2 equal"
  expect 1 "$COMPARE" replay calls.rec --library "$ORIGINAL"
  says out "call 1: n = 514: OTHER BYTES: "
  says out "2 OTHER RESULTS"
  expect 2 "$COMPARE" replay calls.rec --library "$LIBRARY" --original "$ORIGINAL"
  ;;
faulty_originals)
  recorded calls.rec random 100 2
  expect 0 "$COMPARE" replay calls.rec --timeout 0.2 --original "$HANGS"
  prints out "call 2: n = 100: the original did not return within 0.2 s; ours passes every exact check"
  prints out "2 calls, 2 no result of the original"
  expect 0 "$COMPARE" replay calls.rec --original "$CRASHES"
  says out "the original crashed (signal 11"
  expect 0 "$COMPARE" replay calls.rec --original "$STOPS"
  says out "the original stopped the program"
  ;;
other_abi)
  recorded r8.rec random 100
  recorded r4.rec r4 random 100
  # finds RECORDING LIBRARY ABI: replay detects the ABI
  finds() {
    expect 0 "$COMPARE" replay "$1" --original "$2"
    prints out "original: $2 ($3)"
    prints out "1 call, 1 equal"
    [ ! -s err ] || fail "says something on stderr"
  }
  for recording in r8.rec r4.rec; do
    for library in "$ORIGINAL" "$ORIGINAL_CS" "$LIBRARY"; do
      finds $recording "$library" "r8: REAL*8, INTEGER*4, TRMESH with 12 arguments"
    done
    for library in "$ORIGINAL_8ARG" "$LIBRARY_8ARG"; do
      finds $recording "$library" "8arg: REAL*8, INTEGER*4, TRMESH with 8 arguments"
    done
    finds $recording "$LIBRARY_I8" "i8: REAL*8, INTEGER*8, TRMESH with 12 arguments"
  done
  for library in "$ORIGINAL_R4" "$LIBRARY_R4"; do
    finds r4.rec "$library" "r4: REAL*4, INTEGER*4, TRMESH with 12 arguments"
    expect 2 "$COMPARE" replay r8.rec --original "$library"
    says err "a library in REAL*4 would get other nodes"
  done
  expect 0 "$COMPARE" replay r8.rec --library "$LIBRARY_I8"
  prints out "call 1: n = 100: same bytes"
  # A chosen ABI that the library does not have, and one that does not exist.
  expect 2 "$COMPARE" replay r8.rec --original "$ORIGINAL_8ARG" --original-abi r8
  prints err "stripack-compare: $ORIGINAL_8ARG: its TRMESH answers to ABI 8arg: REAL*8, INTEGER*4, TRMESH with 8 arguments, not to r8: REAL*8, INTEGER*4, TRMESH with 12 arguments"
  expect 2 "$COMPARE" replay r8.rec --original "$ORIGINAL" --original-abi r16
  says err "unknown ABI 'r16'"
  # No ABI detected: that of the recording, or the chosen one, is used.
  expect 0 "$COMPARE" replay r4.rec --original "$CRASHES"
  says err "$CRASHES: its ABI cannot be detected, since TRMESH does not triangulate six nodes: with REAL*4 it crashed (signal 11"
  says err "It is called as r4: REAL*4, INTEGER*4, TRMESH with 12 arguments, which --original-abi, or abi= in PSTRIPACK_CHECK, overrides"
  expect 0 "$COMPARE" replay r4.rec --original "$CRASHES" --original-abi i8-8arg
  prints out "original: $CRASHES (i8-8arg: REAL*8, INTEGER*8, TRMESH with 8 arguments)"
  ;;
beside)
  export PSTRIPACK_COMPARE="$COMPARE"
  PSTRIPACK_CHECK=lib: expect 3 "$CALLER" latlon 500 2 3
  printf 'IER 0\nIER 0\n' | cmp - out || fail "the stdout of the model"
  says err "]: call 2: n = 514: every difference is explained: exact tie "
  says err "]: 2 calls, 2 explained"
  PSTRIPACK_CHECK="lib:$HANGS,timeout=0.05,log=log" expect 0 "$CALLER" random 500 2
  [ ! -s err ] || fail "not to the log"
  says log "its ABI cannot be detected"
  says log "]: 2 calls, 2 no result of the original"
  for library in "$ORIGINAL_8ARG" "$ORIGINAL_CS" "$LIBRARY_I8"; do
    PSTRIPACK_CHECK="lib:$library" expect 0 "$CALLER" random 500 2
    says err "]: original: $library ("
    says err "]: 2 calls, 2 equal"
  done
  PSTRIPACK_CHECK="lib:$ORIGINAL_8ARG,abi=r8" expect 0 "$CALLER" random 50000 3
  says err "its TRMESH answers to ABI 8arg"
  says err "stripack-compare has ended; calls are not checked from here on"
  # The model is killed: the check of the calls it has sent still ends.
  PSTRIPACK_CHECK=lib:,log=killed.log "$CALLER" crash > out 2> err
  waited=0
  until grep -q "2 calls, 2 equal" killed.log; do
    sleep 0.1
    waited=$((waited + 1))
    [ $waited -lt 300 ] || fail "no end of the log: $(cat killed.log)"
  done
  says killed.log "call 2: n = 100: no result on record, run again: equal"
  ;;
*) fail "no such case" ;;
esac
