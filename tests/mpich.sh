#!/bin/sh
# Builds with Debian's MPICH instead of Open MPI and runs the tests of MPI: preset `mpich`. May be repeated. mpicc and
# mpirun remain those of Open MPI. Slow if ranks share processors, since MPICH's waiting ranks keep processors busy.
# Usage: tests/mpich.sh [short]      short: no more than 4 ranks, and no faults
set -eu
cd "$(dirname "$0")/.."
case ${1:-} in
  "") choice= ;;
  short) choice='_np([5-9]|[1-9][0-9])|^faults' ;;
  *) sed -n '2,5s/^# //p' "$0" >&2; exit 2 ;;
esac
sh cmake/install-packages.sh mpich libmpich-dev
cmake --preset mpich
cmake --build --preset mpich --parallel "$(nproc)"
if [ -n "$choice" ]; then set -- --exclude-regex "$choice"; fi
ctest --preset mpich "$@"
