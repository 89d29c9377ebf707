# For scripts that start a job in the background, as $job, with its output in job.out. They have a function fail.
# shellcheck disable=SC2154

# until_it_says TEXT
until_it_says() {
  waited=0
  until grep -q "$1" job.out; do
    sleep 0.1
    waited=$((waited + 1))
    [ $waited -lt 200 ] || fail "it has not begun"
  done
}

# has_ended_within SECONDS: $code is then its exit code
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
