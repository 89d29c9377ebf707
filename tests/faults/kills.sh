#!/bin/sh
# Kills a rank of a running job at a random moment, COUNT times. Usage: kills.sh COUNT [SIGNAL [SEED]], with RUN
# (pstripack-run), MPIEXEC (and its flags), JOB_PROGRAM (mpi_job), CALLER (pool_caller) and WORK in the environment.
# LIMIT: seconds within which a job must end [10].
#
# The modes pool, comm and distributed alternate. The victim is one of three ranks, in a pool sometimes the model.
# Prints a line per kill, and a table of the reported phase, the seconds until the job ended and the processes left.
# Fails unless every job ends in time with a nonzero exit code and leaves no process. After kill -9 one line must name
# the lost rank, in a pool with its phase.
# shellcheck disable=SC2086,SC2154
set -u
. "$(dirname "$0")/../mpi/jobs.sh"
count=$1 signal=${2:-KILL} seed=${3:-1} limit=${LIMIT:-10} ranks=3
dir=$WORK/kills_$signal
start_in "$dir"
export OMP_NUM_THREADS=1 PSTRIPACK_POOL_MIN_NODES=100

fail() {
  echo "FAILED: kill $i of $mode, rank $victim_rank: $*"
  cat job.out job.err
  exit 1
}
random() { awk -v seed="$seed$1" -v most="$2" 'BEGIN { srand(seed); rand(); printf "%d", most * rand() }'; }

# Waits for the end of the job; sets $seconds to the time until then. Pauses of this script of more than 2 s, on a loaded
# machine, do not count.
wait_for_end() {
  spent=0 before=$(date +%s%3N)
  while kill -0 $job 2> /dev/null; do
    sleep 0.01
    now=$(date +%s%3N)
    [ $((now - before)) -gt 2000 ] || spent=$((spent + now - before))
    before=$now
    [ $spent -lt 120000 ] || fail "no end"
  done
  seconds=$(awk -v ms=$spent 'BEGIN { printf "%.2f", ms / 1000 }')
}

i=0
: > table
while [ $i -lt "$count" ]; do
  i=$((i + 1))
  export JOB="$dir $i"
  victim_rank=$(random "1$i" $ranks)
  : > job.out
  case $((i % 3)) in
  0) mode=pool program=pstripack-worker
    "$RUN" -n $ranks --oversubscribe -- "$CALLER" calls 200000 100000 > job.out 2> job.err < /dev/null & ;;
  1) mode=comm program=$(basename "$JOB_PROGRAM")
    $MPIEXEC -n $ranks "$JOB_PROGRAM" calls 100000 > job.out 2> job.err & ;;
  2) mode=distributed program=$(basename "$JOB_PROGRAM")
    $MPIEXEC -n $ranks "$JOB_PROGRAM" meshes 100000 > job.out 2> job.err & ;;
  esac
  job=$!
  until_it_says 'call 2'
  victim=$(process_of_rank "$victim_rank" "$program")
  if [ $mode = pool ] && [ "$(random "2$i" 4)" -eq 0 ]; then
    victim_rank=model victim=$(named "$(basename "$CALLER")")
  fi
  [ -n "$victim" ] || fail "no such process"
  sleep "0.$(random "3$i" 1000 | awk '{ printf "%03d", $1 }')"
  kill "-$signal" $victim || fail "the process had ended before"
  wait_for_end
  wait $job
  code=$?
  job=
  [ $code -ne 0 ] || fail "exit code 0"
  sleep 0.1
  left=$(processes)
  [ -z "$left" ] || { sleep 3; left=$(processes); }
  left=$(echo $left | wc -w)
  phase=$(sed -n "s/^pstripack: rank $victim_rank was lost during \(.*\); the job ends\$/\1/p" job.err)
  lines=$(grep -c 'was lost during' job.err)
  if [ $victim_rank = model ]; then
    phase='(the model)'
    [ "$lines" -eq 0 ] || fail "a rank is said to be lost"
  elif [ $mode != pool ]; then
    phase='(named by mpirun)'
    [ "$signal" != KILL ] || grep -q "rank $victim_rank .*exited on signal 9" job.err || fail "mpirun does not name the rank"
  elif [ "$signal" = KILL ]; then
    { [ "$lines" -eq 1 ] && [ -n "$phase" ]; } || fail "no line that names the rank and its phase, or several"
  fi
  echo "$mode	${phase:-(none)}	$seconds	$left" >> table
  echo "kill $i: $mode, rank $victim_rank, phase ${phase:-(none)}: over after $seconds s, exit code $code, $left left"
  [ "$left" -eq 0 ] || fail "processes are left: $(for pid in $(processes); do cat "/proc/$pid/stat"; done)"
done

echo
printf '%-12s %-26s %6s %8s %8s %8s\n' mode 'phase named' kills median maximum orphans
sort -t '	' -k 1,2 -k 3,3n table | awk -F '\t' '
  function row() {
    if (n > 0) printf "%-12s %-26s %6d %8.2f %8.2f %8d\n", mode, phase, n, t[int((n + 1) / 2)], t[n], orphans
  }
  $1 != mode || $2 != phase { row(); n = orphans = 0; mode = $1; phase = $2 }
  { t[++n] = $3; orphans += $4 }
  END { row() }'
awk -F '\t' -v limit="$limit" '
  $3 > limit { late++ }
  $3 > most { most = $3 }
  END {
    printf "\n%d of %d jobs were over within %d s, the last after %.2f s; no process left\n", NR - late, NR, limit, most
    exit late > 0
  }' table
