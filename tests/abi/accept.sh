#!/bin/sh
# Makes the symbols of a build's libraries the expected ones; for a release also the libraries the baselines of the ABI.
# Usage: accept.sh BUILD_DIR [release]      BUILD_DIR: of g++, gfortran, Open MPI
set -eu
build=$1
here=$(dirname "$0")
source=$here/../../src/cxx/capi
if [ "${2:-}" = release ]; then
  for library in stripack stripack_r4 stripack_8arg stripack_i8; do
    "$here/abi.sh" accept "$build/src/fortran/lib$library.so" "$here/lib$library.abi"
  done
  "$here/abi.sh" accept "$build/src/cxx/capi/libpstripack.so" "$here/libpstripack.abi" "$source/pstripack.h"
  "$here/abi.sh" accept "$build/src/cxx/capi/libpstripack_mpi.so" "$here/libpstripack_mpi.abi" "$source/pstripack_mpi.h"
fi
for library in pstripack pstripack_mpi; do
  nm -D --defined-only -P "$build/src/cxx/capi/lib$library.so" | cut -d ' ' -f 1 | LC_ALL=C sort > "$here/lib$library.txt"
done
