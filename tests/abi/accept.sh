#!/bin/sh
# For a release: makes the libraries of a build the baselines of the ABI.
# Usage: accept.sh BUILD_DIR      BUILD_DIR: of g++, gfortran, Open MPI
set -eu
build=$1
here=$(dirname "$0")
source=$here/../../src/cxx/capi
for library in stripack stripack_r4 stripack_8arg stripack_i8; do
  "$here/abi.sh" accept "$build/src/fortran/lib$library.so" "$here/lib$library.abi"
done
"$here/abi.sh" accept "$build/src/cxx/capi/libpstripack.so" "$here/libpstripack.abi" "$source/pstripack.h"
"$here/abi.sh" accept "$build/src/cxx/capi/libpstripack_mpi.so" "$here/libpstripack_mpi.abi" "$source/pstripack_mpi.h"
