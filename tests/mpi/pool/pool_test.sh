#!/bin/sh
# Tests of the pool. Usage: pool_test.sh CASE RANKS, with RUN, MODEL, MODEL_R4, MODEL_I8, CALLER, CALLER_MPI, SCVT,
# COMPARE, LIBRARY, MPIEXEC, OPEN_MPI (TRUE: not Hydra) and WORK in the environment. Each case compares with the same
# program without pstripack-run.
# shellcheck disable=SC2015,SC2016,SC2002,SC2086,SC2094,SC2153,SC2154
set -u
. "$(dirname "$0")/../jobs.sh"
case=$1 ranks=$2
start_in "$WORK/${case}_np$ranks"
export PSTRIPACK_POOL_MIN_NODES=100

# Allows more ranks than processors.
pool() { "$RUN" -n "$ranks" --oversubscribe -- "$@"; }

# as_without NAME COMMAND...: fails unless stdout, stderr and exit code are the same with and without the pool
as_without() {
  name=$1
  shift
  "$@" < /dev/null > "$name.alone.out" 2> "$name.alone.err"
  alone=$?
  pool "$@" < /dev/null > "$name.out" 2> "$name.err"
  code=$?
  [ $code -eq $alone ] || fail "$name: exit code $code, alone $alone"
  cmp "$name.alone.out" "$name.out" || fail "$name: stdout differs"
  # Crashing programs print addresses, which differ.
  for file in "$name.alone.err" "$name.err"; do grep -v '^#' "$file" > "$file.text"; done
  cmp "$name.alone.err.text" "$name.err.text" || fail "$name: stderr differs"
}

# start TEXT COMMAND...: starts the command as $job and waits until it prints TEXT
start() {
  begun=$1
  shift
  : > job.out
  "$RUN" -n "$ranks" --oversubscribe -- "$@" < /dev/null > job.out 2> job.err &
  job=$!
  until_it_says "$begun"
}

# ends_within SECONDS: waits for the end of $job; sets $code to its exit code
ends_within() {
  has_ended_within "$1"
  nothing_is_left "$case"
}

case $case in
same_bytes)
  for model in "$MODEL" "$MODEL_R4" "$MODEL_I8"; do
    "$model" lists alone.bin 2> alone.err || fail "$model alone"
    for partition in bisection stripes; do
      PSTRIPACK_PARTITION=$partition pool "$model" lists pool.bin > model.out 2> model.err
      code=$?
      [ $code -eq 0 ] || fail "$model: exit code $code"
      cmp alone.bin pool.bin || fail "$model: the lists differ"
      cmp alone.err model.err || fail "$model: stderr differs"
    done
  done
  [ ! -s model.out ] || fail "something was written to stdout"
  ;;
scvt)
  for by in alone pool; do
    [ $by = alone ] && run= || run=pool
    $run "$SCVT" -n 2562 -i 4 -d bump -o $by | grep -v -e seconds -e wrote > $by.out || fail "scvt $by"
  done
  cmp alone_points.txt pool_points.txt || fail "the points differ"
  cmp alone_triangles.txt pool_triangles.txt || fail "the triangles differ"
  cmp alone.out pool.out || fail "stdout differs"
  ;;
input)
  seq -f 'line %g of the input' 0 2999 > input.txt
  # The model can read the file from its beginning, and the position in the file stays where the model has left it.
  { pool sh -c 'read a; read b; echo "$b"'; read -r c; echo "$c"; } < input.txt > rest.out
  printf 'line 1 of the input\nline 2 of the input\n' | cmp - rest.out || fail "the position in the file"
  # No file of ours takes the place of a closed descriptor.
  pool sh -c 'cat; find /proc/$$/fd -name "[012]" -fprintf files "%f %l\n"' <&- 2> closed.err >&-
  printf '0 /dev/null\n1 /dev/null\n2 %s\n' "$PWD/closed.err" > expected
  sort files | cmp - expected || fail "closed descriptors"
  head -c 3000000 /dev/urandom > bytes
  pool cat < bytes | cmp - bytes || fail "bytes of a file"
  cat bytes | pool cat | cmp - bytes || fail "bytes of a pipe"
  ;;
end_by_*)
  as_without "${case#end_by_}" "$MODEL" "${case#end_by_}"
  ;;
never)
  as_without never "$MODEL" never stop3
  as_without not_ours sh -c 'echo "$PWD"; exit 7'
  as_without at_once true
  pool ./missing > missing.out 2> missing.err
  [ $? -eq 127 ] || fail "a missing program: exit code"
  grep -q 'missing: No such file' missing.err || fail "a missing program: message"
  if [ "$OPEN_MPI" = TRUE ]; then
    OMPI_MCA_rmaps_base_oversubscribe=0 "$RUN" -n 999 true > many.out 2> many.err && fail "999 ranks have slots"
    grep -q -e --oversubscribe many.err || fail "too many ranks: message"
  fi
  ;;
signal)
  as_without kill9 "$CALLER" kill 9
  as_without segv "$CALLER" kill 11
  ;;
script)
  # A script that starts one model after another: each uses the pool.
  cat > script.sh << EOF
"$MODEL" lists one.bin || exit 1
"$CALLER" calls 5000 2 2> /dev/null || exit 2
"$MODEL" lists two.bin || exit 3
exit 4
EOF
  pool sh script.sh > script.out 2> script.err
  [ $? -eq 4 ] || fail "exit code"
  "$MODEL" lists alone.bin 2> /dev/null
  cmp alone.bin one.bin && cmp alone.bin two.bin || fail "the lists differ"
  grep -q '^pool$' script.out || fail "the pool was not used"
  ;;
other_machine)
  # Rank 0 cannot reach pstripack-run, as if it were on another machine.
  cp "$RUN" pstripack-run
  cat > pstripack-worker << EOF
#!/bin/sh
PSTRIPACK_POOL=nobody exec "$(dirname "$RUN")/pstripack-worker"
EOF
  chmod +x pstripack-worker
  ./pstripack-run -n "$ranks" --oversubscribe -- echo begun > far.out 2> far.err && fail "exit code 0"
  grep -q begun far.out && fail "the program has begun"
  cat far.out far.err | grep -q 'rank 0 is not on the machine of pstripack-run' || fail "it does not say why"
  ;;
environment)
  # The model's environment is the same as without the pool; the workers get PSTRIPACK's variables.
  export OMP_NUM_THREADS=2 PSTRIPACK_PARTITION=stripes
  env | grep -v '^_=' | sort > alone.out
  pool env | grep -v -e '^_=' -e '^PSTRIPACK_POOL=' | sort > pool.out
  cmp alone.out pool.out || fail "the environments differ"
  start pid "$CALLER" pause 5000 3
  tr '\0' '\n' < "/proc/$(process_of_rank 1 pstripack-worker)/environ" > rank_1.environment
  for variable in OMP_NUM_THREADS=2 PSTRIPACK_PARTITION=stripes; do
    grep -q "^$variable\$" rank_1.environment ||
      fail "$variable does not reach rank 1"
  done
  ends_within 20
  [ $code -eq 0 ] || fail "exit code $code"
  ;;
other_launcher)
  # A launcher other than Open MPI's, here like Intel MPI's, must get no option that it does not know.
  cat > mpiexec << EOF
#!/bin/sh
[ "\$1" = --version ] && { echo 'Intel(R) MPI Library for Linux* OS, Version 2021.8 Build 20221129'; exit; }
printf '%s\n' "\$*" > words
exec $MPIEXEC "\$@"
EOF
  chmod +x mpiexec
  export PSTRIPACK_MPIRUN="$dir/mpiexec"
  as_without calls "$MODEL" stop3
  [ "$(cat words)" = "-n $ranks $(dirname "$RUN")/pstripack-worker" ] || fail "options: $(cat words)"
  pool "$CALLER" calls 5000 1 < /dev/null > calls.out 2> calls.err || fail "exit code"
  grep -q '^pool' calls.out || fail "the pool was not used"
  "$RUN" -n "$ranks" --bind-to none -- true || fail "an option of ours"
  [ "$(cat words)" = "-n $ranks --bind-to none $(dirname "$RUN")/pstripack-worker" ] || fail "options: $(cat words)"
  ;;
own_mpi)
  pool "$CALLER_MPI" mpi > mpi.out 2> mpi.err || fail "exit code"
  printf 'size 1\nno pool MPI\n' | cmp - mpi.out || fail "stdout"
  [ "$(grep -c 'pool: this program uses MPI itself' mpi.err)" -eq 1 ] || fail "it does not say so once"
  ;;
no_mpi)
  # A program that does not use MPI must not load it, with or without pstripack-run.
  "$CALLER" dlopen "$LIBRARY" > alone.out 2> alone.err || fail "dlopen alone"
  printf 'no pool\n' | cmp - alone.out || fail "dlopen alone"
  pool "$CALLER" dlopen "$LIBRARY" > dlopen.out 2> dlopen.err || fail "dlopen"
  printf 'pool\n' | cmp - dlopen.out || fail "dlopen"
  ;;
fork | threads)
  pool "$CALLER" "$case" > model.out 2> model.err || fail "exit code"
  printf 'pool\n' | cmp - model.out || fail "stdout"
  ;;
small)
  # A small call stays on the model's threads.
  unset PSTRIPACK_POOL_MIN_NODES
  pool "$CALLER" calls 10000 2 > small.out 2> small.err || fail "exit code"
  grep -q '^no pool$' small.out || fail "it went to the pool"
  ;;
idle)
  # Starting also takes processor time, on a busy machine for some seconds.
  start pid "$CALLER" pause 5000 8
  ticks() { awk '{ print $14 + $15 }' "/proc/$1/stat"; }
  worker_ticks=99 steward_ticks=99
  for attempt in 1 2 3; do
    sleep 1
    worker=$(process_of_rank 1 pstripack-worker || true) steward=$(process_of_rank 0 pstripack-worker || true)
    [ -n "$worker" ] && [ -n "$steward" ] || continue
    worker_before=$(ticks "$worker") steward_before=$(ticks "$steward")
    sleep 1
    worker_ticks=$(($(ticks "$worker") - worker_before)) steward_ticks=$(($(ticks "$steward") - steward_before))
    echo "in one second: worker $worker_ticks ticks, rank 0 $steward_ticks ticks of 0.01 s"
    [ $worker_ticks -gt 5 ] || [ $steward_ticks -gt 5 ] || break
  done
  [ $worker_ticks -le 5 ] && [ $steward_ticks -le 5 ] || fail "an idle rank uses more than 5 % of a core"
  ends_within 20
  [ $code -eq 0 ] || fail "exit code $code"
  ;;
kill_idle | kill_rank_0)
  [ "$case" = kill_idle ] && rank=$((ranks - 1)) || rank=0
  start pid "$CALLER" pause 5000 60
  sleep 0.5
  victim=$(process_of_rank $rank pstripack-worker)
  kill -9 "$victim" || fail "rank $rank not killed"
  ends_within 10
  [ $code -ne 0 ] || fail "exit code 0"
  # Hydra kills all ranks at once, and says so.
  [ "$OPEN_MPI" = TRUE ] || { grep -q 'BAD TERMINATION' job.out && exit || fail "nobody says it"; }
  grep -q "rank $rank .*exited on signal 9" job.err || fail "mpirun does not name the rank"
  ;;
kill_mpirun | kill_run)
  start pid "$CALLER" pause 5000 60
  victim=$job expected=137
  [ "$case" = kill_run ] || victim=$(named "$(basename "${MPIEXEC%% *}")") expected=143
  kill -9 $victim
  ends_within 10
  [ $code -eq $expected ] || fail "exit code $code"
  ;;
kill_model)
  start 'call 2' "$CALLER" calls 400000 400
  kill -9 "$(named "$(basename "$CALLER")")"
  ends_within 10
  [ $code -eq 137 ] || fail "exit code $code"
  [ ! -s job.err ] || fail "stderr is not empty"
  # The ranks also end if nobody waits for the model.
  sh -c '"$@" < /dev/null > unwaited.out & exec sleep 60' - "$RUN" -n "$ranks" --oversubscribe -- "$CALLER" calls 5000 1 &
  job=$!
  until grep -q '^pool' unwaited.out; do sleep 0.1; done
  for _ in 1 2 3 4 5 6 7 8 9 10; do [ -z "$(named pstripack-worker)" ] || sleep 0.5; done
  [ -z "$(named pstripack-worker)" ] || fail "ranks are left"
  ;;
terminate)
  # The model has the two seconds that it takes to save. TERM_group: as from a terminal; all: as from a batch system, to
  # all processes of the job.
  runs="TERM_group INT_group HUP_group QUIT_group TERM_alone TERM_all"
  for run in $runs; do
    : > "$run.out"
    JOB=$dir/$run setsid "$RUN" -n "$ranks" --oversubscribe -- "$CALLER" save < /dev/null > "$run.out" 2> "$run.err" &
    echo $! > "$run.job"
  done
  for run in $runs; do
    until grep -q waiting "$run.out"; do sleep 0.1; done
    job=$(cat "$run.job") signal=${run%_*}
    case $run in
    *_group) kill "-$signal" "-$job" ;;
    *_alone) kill "-$signal" "$job" ;;
    *_all) JOB=$dir/$run && kill "-$signal" $(processes) ;;
    esac
  done
  for run in $runs; do
    job=$(cat "$run.job")
    wait "$job"
    code=$?
    job=
    [ $code -eq 5 ] || fail "$run: exit code $code"
    printf 'waiting\nsaved, 1 signal\n' | cmp - "$run.out" || fail "$run: the model did not save"
    [ ! -s "$run.err" ] || fail "$run: stderr is not empty"
    JOB=$dir/$run && nothing_is_left "$run"
  done
  ;;
terminal)
  # The model reads what is typed, and Ctrl-C reaches it alone.
  cat > model.sh << 'EOF'
trap 'echo saving; "$CALLER" calls 5000 1; exit 5' INT
echo waiting
read -r line
echo "line: $line"
while :; do sleep 0.1; done
EOF
  : > job.out
  {
    until_it_says waiting
    echo 'some words'
    until_it_says 'line: some words'
    printf '\003'
    sleep 5
  } | script -qec "exec '$RUN' -n $ranks --oversubscribe -- sh model.sh" /dev/null > job.out
  code=$?
  [ $code -eq 5 ] || fail "exit code $code"
  [ "$(grep -c saving job.out)" -eq 1 ] || fail "not one signal"
  grep -q '^pool' job.out || fail "the signal has ended the pool"
  nothing_is_left terminal
  ;;
own_processes)
  # Ranks with process numbers of their own, as in containers, have no memory but what is passed to them: /proc names
  # other files. Here a file of the user has all descriptors of rank 1.
  unshare --pid --fork --mount-proc true || exit 77
  cp "$RUN" pstripack-run
  head -c 1000000 /dev/zero > data
  cat > pstripack-worker << EOF
#!/bin/bash
[ "\$OMPI_COMM_WORLD_RANK" != 1 ] || for i in {3..60}; do eval "exec \$i<>data"; done
exec unshare --pid --fork --mount-proc "$(dirname "$RUN")/pstripack-worker" "\$@"
EOF
  chmod +x pstripack-worker
  export OMPI_MCA_btl=tcp,self PSTRIPACK_REPORT=report
  ./pstripack-run -n "$ranks" --oversubscribe -- "$CALLER" calls 5000 2 > calls.out 2> calls.err || fail "exit code"
  grep -q '^pool$' calls.out || fail "the pool was not used"
  head -c 1000000 /dev/zero | cmp - data || fail "a file of the user has changed"
  ;;
stuck)
  # An mpirun that does not end after SIGTERM.
  cat > mpirun << 'EOF'
#!/bin/sh
[ "$1" = --version ] && { echo 'mpirun (Open MPI) 4.1.4'; exit; }
trap '' TERM
echo waiting
while :; do sleep 0.1; done
EOF
  chmod +x mpirun
  export PSTRIPACK_MPIRUN=./mpirun
  start waiting true
  kill "$job"
  ends_within 10
  [ $code -eq 143 ] || fail "exit code $code"
  ;;
report)
  # The model writes the lines for its calls by the pool and on its own threads.
  sh -c '"$CALLER" calls 5000 1; "$CALLER" calls 50 1' > alone.out 2> alone.err || fail "alone"
  export OMP_NUM_THREADS=1
  for where in report 1; do
    export PSTRIPACK_REPORT=$where
    pool sh -c '"$CALLER" calls 5000 1; "$CALLER" calls 50 1' > pool.out 2> pool.err || fail "exit code"
    [ $where = 1 ] && grep '^pstripack: ' pool.err > report
    [ "$(wc -l < report)" -eq 6 ] || fail "not six lines"
    for line in 'pool n=5000 ranks=2 threads=1 .* triangles=9996 boundary=0 ier=0 .* halo=[1-9][0-9]* bytes=[1-9][0-9]* start=cold' \
      'pool +1( +[0-9.]+){7}'; do
      grep -qE "^pstripack: $line\$" report || fail "no line: $line"
    done
    grep -qE "^pstripack: threads n=50 ranks=1 threads=1 of=[0-9]+ limit=[a-z]+ triangles=96 boundary=0 ier=0 " report ||
      fail "the line of the threads"
    rm report
  done
  grep -v pool alone.out > alone.text
  grep -v pool pool.out | cmp - alone.text || fail "stdout differs"
  ;;
bitwise)
  # The model makes the original's lists on its own thread; exit code 9 shows that it did not use the pool.
  "$MODEL" lists canonical || fail "canonical"
  export PSTRIPACK_ORDER=bitwise
  "$MODEL" lists alone || fail "alone"
  cmp -s canonical alone && fail "canonical lists"
  pool "$MODEL" lists pool > pool.out 2> pool.err
  [ $? -eq 9 ] || fail "exit code"
  cmp alone pool || fail "the lists differ"
  ;;
check)
  # Only the model records its calls, with the same bytes as without a pool.
  export PSTRIPACK_CHECK=alone.rec PSTRIPACK_REPORT=report
  "$SCVT" -n 642 -i 3 -o alone > alone.out 2> alone.err || fail "alone"
  export PSTRIPACK_CHECK=pool.rec
  pool "$SCVT" -n 642 -i 3 -o pool > pool.out 2> pool.err || fail "exit code"
  [ "$(grep -c '^pstripack: pool n=642' report)" -eq 4 ] || fail "not by the pool"
  "$COMPARE" lists alone.rec pool.rec --bytes > lists.out || fail "the recorded calls differ"
  grep -q '^4 calls: 4 same bytes' lists.out || fail "not four calls"
  ;;
out_of_memory)
  # Rank 1 has only enough memory for the small call.
  cp "$RUN" pstripack-run
  cat > pstripack-worker << EOF
#!/bin/sh
[ "\${OMPI_COMM_WORLD_RANK:-\$PMI_RANK}" = 1 ] && ulimit -v 450000
exec "$(dirname "$RUN")/pstripack-worker" "\$@"
EOF
  chmod +x pstripack-worker
  export OMP_NUM_THREADS=1
  ./pstripack-run -n "$ranks" --oversubscribe -- "$CALLER" codes 4000000 20000 > codes.out 2> codes.err ||
    fail "exit code"
  printf 'codes -6 0\npool\n' | cmp - codes.out || fail "codes"
  [ "$(grep -c 'out of memory (IER = -6)' codes.err)" -eq 1 ] || fail "it does not say so once"
  ;;
options)
  "$RUN" --help > help.out || fail "--help"
  grep -q '^usage: pstripack-run -n P' help.out || fail "--help: text"
  "$RUN" --version | grep -q '^pstripack-run [0-9]' || fail "--version"
  refuse() {
    expected=$1
    shift
    "$RUN" "$@" > refuse.out 2> refuse.err
    [ $? -eq 2 ] || fail "$*: exit code"
    grep -q -e "$expected" refuse.err || fail "$*: message"
  }
  refuse 'no number of ranks' true
  refuse 'no program' -n 2
  refuse 'needs a number of ranks' -n two true
  refuse 'needs a number of ranks' -n 0 true
  refuse 'end with --' -n 2 --oversubscribe true
  refuse 'must come before' --oversubscribe -n 2 -- true
  "$(dirname "$RUN")/pstripack-worker" > worker.out 2>&1 && fail "the worker alone"
  grep -q 'only pstripack-run starts this program' worker.out || fail "the worker alone: message"
  # One rank: the program itself.
  "$RUN" -n 1 "$CALLER" calls 5000 1 > one.out 2> one.err || fail "-n 1"
  grep -q '^no pool$' one.out || fail "-n 1: a pool"
  # Arguments of the program that look like ours; mpirun's options.
  [ "$OPEN_MPI" = TRUE ] && machine="$(hostname) slots=2" options="--map-by slot" || machine=$(hostname):2 options=
  echo "$machine" > hosts
  "$RUN" -np 2 --hostfile hosts $options -- echo -n 3 -- --help > arguments.out 2> arguments.err ||
    fail "arguments"
  [ "$(cat arguments.out)" = "3 -- --help" ] || fail "arguments: $(cat arguments.out)"
  # Open MPI is configured to notice soon that a machine is lost, unless the user has set these variables.
  cat > mpirun << 'EOF'
#!/bin/sh
[ "$1" = --version ] && echo 'mpirun (Open MPI) 4.1.4' || env > "$0.environment"
EOF
  chmod +x mpirun
  OMPI_MCA_oob_tcp_keepalive_intvl=7 PSTRIPACK_MPIRUN=./mpirun "$RUN" -n 2 true || fail "an mpirun of ours"
  for setting in time=20 intvl=7 probes=4; do
    grep -q "^OMPI_MCA_oob_tcp_keepalive_$setting\$" mpirun.environment || fail "keepalive: $setting"
  done
  PSTRIPACK_MPIRUN=/no/mpirun "$RUN" -n 2 true 2> mpirun.err && fail "no mpirun"
  grep -q '/no/mpirun: not found' mpirun.err || fail "no mpirun: message"
  printf '#!/bin/sh\necho cannot >&2; exit 3\n' > mpirun
  PSTRIPACK_MPIRUN=./mpirun "$RUN" -n 2 true 2> mpirun.err
  [ $? -eq 3 ] || fail "an mpirun that fails: exit code"
  printf 'cannot\npstripack-run: ./mpirun --version: exit code 3: name another in PSTRIPACK_MPIRUN\n' | cmp - mpirun.err || fail "an mpirun that fails: message"
  if unshare --mount mount -t tmpfs none /proc; then
    unshare --mount sh -c 'mount -t tmpfs none /proc && exec "$RUN" -n 2 true' 2> proc.err && fail "no /proc"
    grep -q 'mount /proc' proc.err || fail "no /proc: message"
  fi
  ;;
*)
  fail "no such case"
  ;;
esac
