#!/bin/sh
# The reports and the ends of whole MPI jobs. Usage: job_test.sh CASE RANKS, with MPIEXEC (and its flags), PROGRAM,
# OPEN_MPI (TRUE: not Hydra), COMPARE and WORK in the environment.
# shellcheck disable=SC2015,SC2016,SC2086,SC2154
set -u
. "$(dirname "$0")/jobs.sh"
case=$1 ranks=$2
start_in "$WORK/job_${case}_np$ranks"

# run ARGUMENT...: runs the program; PSTRIPACK_REPORT is set on rank $asking only, or on all ranks
run() {
  $MPIEXEC -n "$ranks" sh -c '
    asking=$1
    shift
    if [ "$asking" = all ] || [ "$asking" = "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" ]; then
      PSTRIPACK_REPORT=report
      export PSTRIPACK_REPORT
    fi
    exec "$@"' sh "$asking" "$PROGRAM" "$@" > run.out 2> run.err || fail "exit code"
  [ ! -s run.out ] || fail "something on stdout"
  [ ! -s run.err ] || fail "something on stderr"
}

phases='seconds=.* gather=.* rounds=[0-9]+ halo=[0-9]+ bytes=[0-9]+'
# line NUMBER TEXT: fails unless this line of the report has TEXT before the phases
line() {
  case $2 in distributed-gather*) end= ;; *) end=" start=cold" ;; esac
  sed -n "$1p" report | grep -qE "^pstripack: $2 $phases$end\$" || fail "line $1 is not: $2"
}
row() { sed -n "$1p" report | grep -qE "^pstripack: $2 +$3( +[0-9.]+){7}\$" || fail "line $1 is not: row $2"; }

# start ARGUMENT...: starts the program as $job
start() {
  : > job.out
  $MPIEXEC -n "$ranks" sh -c 'echo $$ > rank.${OMPI_COMM_WORLD_RANK:-$PMI_RANK}; exec "$@"' sh "$PROGRAM" "$@" \
    > job.out 2> job.err &
  job=$!
}
# The job must end within 10 s with an error.
ends() {
  has_ended_within 10
  [ "$code" -ne 0 ] || fail "exit code 0"
}

case $case in
comm | distributed)
  for asking in all 0; do
    rm -f report
    run "$case"
    if [ "$case" = comm ]; then
      [ "$(wc -l < report)" -eq 4 ] || fail "not four lines"
      line 1 "comm n=1000 ranks=$ranks threads=1 of=[0-9]+ limit=[a-z]+ triangles=1996 boundary=0 ier=0"
      line 2 "comm n=1000 ranks=$ranks threads=1 of=[0-9]+ limit=[a-z]+ triangles=136 boundary=0 ier=31"
      row 4 comm 2
    else
      [ "$(wc -l < report)" -eq 5 ] || fail "not five lines"
      line 1 "distributed n=500 ranks=$ranks threads=1 of=[0-9]+ limit=[a-z]+ triangles=[0-9]+ boundary=[1-9][0-9]* ier=0"
      line 2 "distributed-gather n=500 ranks=$ranks threads=1 of=[0-9]+ limit=[a-z]+ triangles=[0-9]+ boundary=[1-9][0-9]* ier=0"
      row 4 distributed 1
      row 5 distributed-gather 1
    fi
    [ "$ranks" -eq 1 ] || grep -q 'bytes=[1-9]' report || fail "nothing was sent"
  done
  # PSTRIPACK_REPORT on another rank than 0 has no effect.
  if [ "$ranks" -gt 1 ]; then
    rm -f report
    asking=1
    run "$case"
    [ ! -e report ] || fail "a report of rank 1"
  fi
  ;;
check)
  # In comm mode rank 0 records the calls of all ranks.
  asking=none
  export PSTRIPACK_CHECK=calls.rec
  run comm
  "$COMPARE" lists calls.rec calls.rec > lists.out || fail "the recording"
  grep -q '^2 calls: 2 same bytes' lists.out || fail "not two calls"
  ;;
kill_calls | kill_meshes)
  start "${case#kill_}" 100000
  until_it_says 'call 2'
  kill -9 "$(cat rank.1)"
  ends
  # Hydra kills all ranks at once, and says so.
  [ "$OPEN_MPI" = TRUE ] || { grep -q 'BAD TERMINATION' job.out || fail "nobody says it" && exit; }
  grep -q 'rank 1 .*exited on signal 9' job.err || fail "mpirun does not name the rank"
  ! grep -q '^pstripack' job.err || fail "a line of ours"
  ;;
messages)
  start messages 2000
  wait "$job" || fail "exit code"
  job=
  # A vote of two messages on the width, and one to each neighbour.
  grep -q '^exchange: [34] messages on 3 ranks' job.out || fail "more messages in an exchange"
  ;;
null_mesh)
  start null_mesh 1000
  ends
  grep -q '^pstripack: mesh_triangulate: the mesh is NULL on this rank' job.err || fail "no line"
  ;;
error_calls | error_meshes)
  start "${case#error_}" 100000 error
  until_it_says 'call 2'
  : > fail
  ends
  [ "$(grep -c '^pstripack: rank 1: MPI error: [A-Z]' job.err)" -eq 1 ] || fail "no line, or several"
  ;;
*)
  fail "no such case"
  ;;
esac
