# For scripts that start a job in the background as $job, with its output in job.out and job.err.
# shellcheck disable=SC2154

# start_in FOLDER: changes to this folder, $dir, after emptying it; kills the job when the script ends. JOB, a text that no
# other job has, is in the environment of all processes of the job: it identifies them.
start_in() {
  dir=$1
  rm -rf "$dir"
  mkdir -p "$dir"
  cd "$dir" || exit 1
  job=
  export JOB="$dir"
  # shellcheck disable=SC2086  # several processes
  trap 'status=$?; [ -z "$job" ] || kill -9 $job $(processes) 2> /dev/null; exit $status' EXIT
}

# fail TEXT: ends the script with what was printed
fail() {
  echo "FAILED: $*"
  for file in *.out *.err report; do
    [ -s "$file" ] && [ "$(wc -c < "$file")" -lt 20000 ] && { echo "--- $file"; cat "$file"; }
  done
  exit 1
}

# The processes of the job, without zombies.
processes() {
  for environment in $(grep -lzxF "JOB=$JOB" /proc/[0-9]*/environ 2> /dev/null); do
    pid=${environment#/proc/}
    pid=${pid%/environ}
    case $(cat "/proc/$pid/stat" 2> /dev/null) in '' | *") Z "* | *") X "*) continue ;; esac
    [ "$pid" = $$ ] || echo "$pid"
  done
}

# named NAME: the processes of the job that run this program
named() {
  for pid in $(processes); do
    [ "$(cat "/proc/$pid/comm" 2> /dev/null)" = "$(echo "$1" | cut -c1-15)" ] && echo "$pid"
  done
}

# process_of_rank RANK PROGRAM: the process of this rank
process_of_rank() {
  for pid in $(named "$2"); do
    grep -qzxF -e "OMPI_COMM_WORLD_RANK=$1" -e "PMI_RANK=$1" "/proc/$pid/environ" 2> /dev/null && echo "$pid"
  done
}

# nothing_is_left TEXT: fails with this text unless all processes of the job end within 5 s
nothing_is_left() {
  for _ in 1 2 3 4 5 6 7 8 9 10; do
    left=$(processes)
    [ -n "$left" ] || return 0
    sleep 0.5
  done
  for pid in $left; do cat "/proc/$pid/stat"; done
  fail "$*: processes are left"
}

# until_it_says TEXT: waits until job.out contains TEXT, at most 20 s
until_it_says() {
  waited=0
  until grep -q "$1" job.out; do
    sleep 0.1
    waited=$((waited + 1))
    [ $waited -lt 200 ] || fail "it has not begun"
  done
}

# has_ended_within SECONDS: waits for the end of the job; sets $code to its exit code
has_ended_within() {
  waited=0
  while kill -0 "$job" 2> /dev/null; do
    sleep 0.1
    waited=$((waited + 1))
    [ $waited -lt $(($1 * 10)) ] || fail "no end within $1 s"
  done
  wait "$job"
  code=$?
  job=
}
