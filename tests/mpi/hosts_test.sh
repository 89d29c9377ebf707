#!/bin/sh
# Jobs on three machines, with Open MPI. Usage: hosts_test.sh CASE, with RUN, MPIEXEC (and its flags), JOB_PROGRAM
# (mpi_job), MODEL, CALLER and WORK in the environment.
#
# The machines are namespaces: h1, where jobs start, h2 and h3 each have their own host name, network, processes and
# shared memory; a virtual switch connects them. A stand-in for ssh enters the namespaces, which end with the test. Exit
# code 77 if namespaces cannot be created.
# shellcheck disable=SC2015,SC2016,SC2086,SC2153,SC2154
set -u
case=$1
dir=$WORK/hosts_$case
if [ "${2:-}" != inside ]; then
  rm -rf "$dir"
  mkdir -p "$dir"
  [ "$(id -u)" -eq 0 ] && user= || user=--map-root-user
  namespaces="--net --mount --uts --ipc --pid --fork --mount-proc"
  unshare $user $namespaces sh -c 'ip link add one type veth peer name other && ip link add switch type bridge &&
      mount -t tmpfs none /dev/shm && unshare "$@" true' sh $namespaces > "$dir/refusal" 2>&1 || {
    echo "skipped: no namespaces here: $(cat "$dir/refusal")"
    exit 77
  }
  exec unshare $user $namespaces --kill-child sh "$0" "$case" inside
fi

. "$(dirname "$0")/jobs.sh"
start_in "$dir"

# ---- the machines
# this_machine_is NAME: sets up a machine, within its namespaces
cat > this_machine_is << 'EOF'
hostname "$1"
mount -t tmpfs none /dev/shm
mount -t sysfs none /sys
ip link set lo up
EOF
sh this_machine_is h1
printf '127.0.0.1 localhost\n10.0.0.1 h1\n10.0.0.2 h2\n10.0.0.3 h3\n' > addresses
mount --bind addresses /etc/hosts
ip link add switch type bridge
ip addr add 10.0.0.1/24 dev switch
ip link set switch up
# make_machines: makes h2 and h3, after killing older ones
make_machines() {
  for host in h2 h3; do
    [ ! -e $host.pid ] || kill -9 "$(cat $host.pid)" 2> /dev/null
    ip link del to_$host 2> /dev/null
    rm -f $host.is_up
    unshare --net --mount --uts --ipc --pid --fork --mount-proc sh -c '
      sh this_machine_is $1
      : > $1.is_up
      exec sleep 1000' sh $host 2> $host.err &
    until [ -e $host.is_up ]; do sleep 0.02; done
    read -r pid < /proc/$!/task/$!/children
    echo $pid > $host.pid
    ip link add to_$host type veth peer name eth0 netns $pid
    ip link set to_$host master switch up
    nsenter -t $pid -n sh -c "ip addr add 10.0.0.${host#h}/24 dev eth0 && ip link set eth0 up" || fail "no machine $host"
  done
}
make_machines

# Stand-in for ssh: passes no variables on, and does not notice if the other machine loses its power.
cat > ssh << EOF
#!/bin/sh
while :; do case \$1 in -*) shift ;; *) break ;; esac; done
read -r pid < "$dir/\$1.pid"
shift
nsenter -t \$pid -m -u -i -n -p env -i PATH="$PATH" HOME="$HOME" LD_PRELOAD="${LD_PRELOAD:-}" TMPDIR=/dev/shm sh -c "cd; \$*"
code=\$?
[ \$code -eq 137 ] && exec sleep 1000
exit \$code
EOF
chmod +x ssh

# ---- the jobs
export OMP_NUM_THREADS=1 PSTRIPACK_POOL_MIN_NODES=100
export TMPDIR=/dev/shm  # not shared with other machines
printf 'h1 slots=2\nh2 slots=2\nh3 slots=2\n' > machines
export OMPI_MCA_plm_rsh_agent="$dir/ssh"
# Lets Open MPI notice within seconds that a machine is gone.
export OMPI_MCA_oob_tcp_keepalive_time=2 OMPI_MCA_oob_tcp_keepalive_intvl=1 OMPI_MCA_oob_tcp_keepalive_probes=3
pool() { "$RUN" -n 6 --hostfile machines -- "$@"; }
ranks() { $MPIEXEC -n 6 --hostfile machines "$@"; }

# All processes except those of this script and of the machines.
processes() {
  for stat in /proc/[0-9]*/stat; do
    read -r pid name state _ < "$stat" || continue
    case $name:$state in *:Z | *:X | '(sleep):'* | '(unshare):'* | '(sh):'* | '(ssh):'*) continue ;; esac
    [ "$(readlink "/proc/$pid/exe")" = "$(readlink /proc/self/exe)" ] || echo "$pid"
  done 2> /dev/null
}

# start MODE: starts $job, which calls forever; returns when calls have begun
start() {
  : > job.out
  case $1 in
  idle) pool "$CALLER" pause 5000 1000 ;;
  pool) pool "$CALLER" calls 400000 10000 ;;
  *) ranks "$JOB_PROGRAM" "$1" 100000 ;;
  esac > job.out 2> job.err < /dev/null &
  job=$!
  until_it_says 'call 2\|pid'
}

# ends MODE SECONDS: the job must end within this time, with an error, and leave no process on any machine
ends() {
  has_ended_within "$2"
  [ $code -ne 0 ] || fail "$1: exit code 0"
  nothing_is_left "$1"
}

case $case in
same_bytes)
  ranks hostname > names || fail "three machines"
  [ "$(sort names | tr '\n' ' ')" = 'h1 h1 h2 h2 h3 h3 ' ] || fail "not two ranks on each machine: $(cat names)"
  "$MODEL" lists alone.bin 2> alone.err
  pool "$MODEL" lists pool.bin > job.out 2> job.err || fail "pool: exit code"
  cmp alone.bin pool.bin || fail "pool: the lists differ"
  # Open MPI sometimes warns that it is late to move ssh into a process group.
  grep -v 'plm:rsh: Warning: setpgid' job.err | cmp alone.err - || fail "pool: stderr differs"
  PSTRIPACK_REPORT=report pool "$CALLER" calls 5000 4 > job.out 2> job.err || fail "four calls: exit code"
  # The caller validates the first call; the others have the same nodes.
  [ "$(grep -c 'start=warm flips=0$' report)" -eq 2 ] || fail "not two calls that begin with the last rings: $(cat report)"
  for mode in comm distributed; do  # the program checks the lists
    ranks "$JOB_PROGRAM" $mode > job.out 2> job.err || fail "$mode: exit code"
  done
  ;;
killed)
  # A rank on another machine.
  for mode in idle pool calls meshes; do
    start $mode
    case $mode in idle | pool) program=pstripack-worker ;; *) program=$(basename "$JOB_PROGRAM") ;; esac
    kill -9 "$(process_of_rank 2 $program)" || fail "$mode: no such rank"
    ends $mode 30
    [ "$(grep -c 'rank 2 .*exited on signal 9' job.err)" -eq 1 ] || fail "$mode: no line that names the rank, or several"
  done
  ;;
vanished)
  # A machine loses its network, its power or all its processes.
  for how_and_mode in network:meshes power:idle power:calls processes:pool; do
    how=${how_and_mode%:*} mode=${how_and_mode#*:}
    make_machines
    start $mode
    [ $how = processes ] || ip link set to_h2 down
    [ $how = network ] || kill -9 "$(cat h2.pid)"
    ends $how_and_mode 30
    [ "$(grep -c '^ORTE has lost communication with a remote daemon' job.err)" -eq 1 ] || fail "$how_and_mode: no line that says it, or several"
  done
  ;;
*)
  fail "no such case"
  ;;
esac
