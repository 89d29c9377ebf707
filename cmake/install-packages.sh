#!/bin/sh
# Installs packages on Debian 12 by what they are for, and those named as arguments. Needs no root rights if all are
# installed. Called by quickstart.sh, test.sh, and scripts in tests.
# Usage: install-packages.sh [main|mpi] [package...]
#   main     to build the libraries and compare them with the original
#   mpi      these, and Open MPI
#   neither  all that the build, the tests and the comparisons use
set -eu

main="
  g++ gfortran cmake ninja-build
  libboost-dev
  libcli11-dev nlohmann-json3-dev libfmt-dev
"
mpi="
  libopenmpi-dev openmpi-bin
"
tests="
  ccache pkg-config dpkg-dev
  libnetcdf-dev libncarg-dev
  libgtest-dev libcgal-dev libgmp-dev libmpfr-dev libqhull-dev
  abigail-tools lintian environment-modules iproute2
  netcdf-bin python3-netcdf4 python3-xarray python3-meshio
  python3-dev pybind11-dev python3-pybind11
  python3-pandas python3-geopandas python3-matplotlib python3-cartopy
  python3-scipy python3-mpmath python3-pytest python3-mypy python3-pip python3-setuptools python3-wheel
  python3 python3-numpy python3-yaml doxygen ghostscript
"
case ${1:-} in
  main) shift; packages="$main $*" ;;
  mpi) shift; packages="$main $mpi $*" ;;
  *) packages="$main $mpi $tests $*" ;;
esac

missing=""
for package in $packages; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if ! command -v apt-get >/dev/null; then
  echo "install-packages: this is not Debian; please install by hand:$missing" >&2
  exit 1
fi
sudo=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install-packages: run this once as root:  apt-get install$missing" >&2
    exit 1
  fi
  sudo=sudo
fi
echo "Installing:$missing" >&2
$sudo apt-get update -q
# shellcheck disable=SC2086  # a list of words on purpose
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing
