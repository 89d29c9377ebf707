#!/bin/sh
# The release's tarball has the checksum beside it, and configures by itself. Without a publisher there is none.
# Usage: dist.sh SOURCE_DIR WORK_DIR VERSION
set -eu
source=$1 work=$2 version=$3
rm -rf "$work"
mkdir -p "$work"
dist() { cmake -DSOURCE_DIR="$source" -DOUTPUT_DIR="$work" -DVERSION="$version" "$@" -P "$source/cmake/dist.cmake"; }
if grep -q 'no-address\.invalid"' "$source/cmake/project-address.cmake" && dist 2> "$work/errors"; then
  echo "a tarball without a publisher" >&2
  exit 1
fi
dist -DTRIAL=ON
cd "$work"
sha256sum -c "pstripack-$version.tar.gz.sha256"
tar xzf "pstripack-$version.tar.gz"
cmake -S "pstripack-$version" -B build -DPSTRIPACK_WITH_MPI=OFF -DPSTRIPACK_TESTS=OFF -DPSTRIPACK_TOOLS=OFF \
  -DPSTRIPACK_EXAMPLES=OFF -DPSTRIPACK_PYTHON=OFF
