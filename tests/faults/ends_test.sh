#!/bin/sh
# MPI programs that end in every way after a call in comm mode or of a mesh: the exit code must be that of the program
# without PSTRIPACK, within 60 s, and no process may be left. Usage: ends_test.sh MODE, with MPIEXEC (and its flags),
# PROGRAM (ending_program) and WORK in the environment. The mode `without` must run first: it records the codes.
# shellcheck disable=SC2086,SC2154
set -u
. "$(dirname "$0")/../mpi/jobs.sh"
mode=$1
start_in "$WORK/ends_$mode"
export OMP_NUM_THREADS=1

# run MODE END WHO: runs the program; sets $code to its exit code
run() {
  : > job.out
  $MPIEXEC -n 3 "$PROGRAM" "$@" > job.out 2> job.err &
  job=$!
  has_ended_within 60
  nothing_is_left "$*"
}

# END:CODE if all ranks end so. mpiexec returns 1 if a rank ends without MPI_Finalize.
for end in finalize:0 finalize3:3 stop:1 stop3:3 error_stop:2 exit5:5 abort:134 mpi_abort:7; do
  how=${end%:*}
  for who in all 1; do
    # Like MPI's own collective calls, ours wait forever for a rank that has finalized MPI.
    case $who:$how in 1:finalize*) continue ;; esac
    run "$mode" "$how" $who
    if [ "$mode" = without ]; then
      [ $who != all ] || [ $code -eq "${end#*:}" ] || fail "$how, no call of ours: exit code $code"
      echo $code > "$how.$who"
    else
      alone=$(cat "$WORK/ends_without/$how.$who") || fail "the mode \`without\` has not run"
      [ $code -eq "$alone" ] || fail "$how $who: exit code $code, without a call of ours $alone"
    fi
    echo "$how $who: $code"
  done
done
