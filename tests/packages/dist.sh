#!/bin/sh
# The release's tarball has the checksum beside it, and configures by itself.
# Usage: dist.sh SOURCE_DIR WORK_DIR VERSION
set -eu
source=$1 work=$2 version=$3
rm -rf "$work"
mkdir -p "$work"
cmake -DSOURCE_DIR="$source" -DOUTPUT_DIR="$work" -DVERSION="$version" -P "$source/cmake/dist.cmake"
cd "$work"
sha256sum -c "pstripack-$version.tar.gz.sha256"
tar xzf "pstripack-$version.tar.gz"
cmake -S "pstripack-$version" -B build -DPSTRIPACK_WITH_MPI=OFF -DPSTRIPACK_TESTS=OFF -DPSTRIPACK_TOOLS=OFF \
  -DPSTRIPACK_EXAMPLES=OFF -DPSTRIPACK_PYTHON=OFF
