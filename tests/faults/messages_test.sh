#!/bin/sh
# Faults of MPI, caused by the interposer. Usage: messages_test.sh CASE MODE, with RUN, MPIEXEC (and its flags),
# INTERPOSER, JOB_PROGRAM (mpi_job), MODEL (pool_model), OPEN_MPI (TRUE: not Hydra) and WORK in the environment.
#   late      messages are late and in another order, with $SEEDS seeds: the results must be the same
#   stopped   each rank stops at every $EVERY-th call of MPI for $MILLISECONDS: the results must be the same
#   killed    each rank is killed at every $EVERY-th call of MPI: the job must end, and mpirun name the rank
# MODE: pool, comm, distributed.
# shellcheck disable=SC2015,SC2086,SC2154
set -u
. "$(dirname "$0")/../mpi/jobs.sh"
case=$1 mode=$2 ranks=3
start_in "$WORK/messages_${case}_$mode"
export OMP_NUM_THREADS=1 PSTRIPACK_POOL_MIN_NODES=100

# run FAULT...: runs the job with these variables for the interposer; sets $code to its exit code
run() {
  options=
  for variable in LD_PRELOAD="$INTERPOSER${LD_PRELOAD:+:$LD_PRELOAD}" "$@"; do
    [ "$OPEN_MPI" = TRUE ] && option="-x $variable" || option="-genv ${variable%%=*} ${variable#*=}"
    options="$options $option"
  done
  : > job.out
  case $mode in
  pool) "$RUN" -n $ranks --oversubscribe $options -- "$MODEL" lists pool.bin > job.out 2> job.err < /dev/null & ;;
  *) $MPIEXEC $options -n $ranks "$JOB_PROGRAM" "$mode" > job.out 2> job.err & ;;
  esac
  job=$!
  has_ended_within 60  # the machine may be loaded
  nothing_is_left "$*" # ranks of a pool end after the model
}

# The program checks its own results; those of the model are compared with its results without a pool.
is_right() {
  [ $code -eq 0 ] || fail "exit code $code with $*"
  [ $mode != pool ] || cmp alone.bin pool.bin || fail "the lists differ with $*"
}
[ $mode != pool ] || "$MODEL" lists alone.bin 2> /dev/null || fail "alone"

# each_call BODY: runs BODY for every $EVERY-th call of MPI of each rank
each_call() {
  run FAULT_COUNT=calls
  is_right FAULT_COUNT
  for rank in 0 1 2; do
    [ -s calls.$rank ] || fail "rank $rank has not counted its calls"
    call=1
    while [ $call -le "$(cat calls.$rank)" ]; do
      "$@"
      call=$((call + EVERY))
    done
  done
}

stop() {
  run FAULT_STOP=$rank:$call:$MILLISECONDS
  is_right FAULT_STOP=$rank:$call:$MILLISECONDS
  stops=$((stops + 1))
}

kill_at() {
  run FAULT_KILL=$rank:$call
  [ $code -ne 0 ] || fail "exit code 0 with FAULT_KILL=$rank:$call"
  # Hydra kills all ranks at once, and says so on stdout.
  [ "$OPEN_MPI" = TRUE ] && line="rank $rank .*exited on signal 9" || line='BAD TERMINATION'
  grep -q "$line" job.out job.err || fail "mpirun does not name the rank with FAULT_KILL=$rank:$call"
  echo "rank $rank, call $call"
}

case $case in
late)
  seed=0
  while [ $seed -lt "$SEEDS" ]; do
    seed=$((seed + 1))
    run FAULT_SEED=$seed
    is_right FAULT_SEED=$seed
  done
  echo "$seed runs"
  ;;
stopped)
  stops=0
  each_call stop
  echo "$stops stops"
  ;;
killed)
  each_call kill_at
  ;;
*)
  fail "no such case"
  ;;
esac
