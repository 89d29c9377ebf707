#!/bin/sh
# Sets up, builds and passes all tests. May be repeated. Usage: ./test.sh [ctest options]
set -eu
cd "$(dirname "$0")"
build=build
. tests/stages.sh

configure() {
  [ -f $build/CMakeCache.txt ] || generator="-G Ninja"
  # shellcheck disable=SC2086  # two words on purpose
  cmake -S . -B $build ${generator:-} -DCMAKE_BUILD_TYPE=Release -DPSTRIPACK_UNITY=ON
}

stage "install packages" sh cmake/install-packages.sh
stage configure configure
stage build cmake --build $build --parallel "$(nproc)"
# More tests than processors: some wait.
stage tests run_ctest $build --test-dir $build --output-on-failure --parallel $(($(nproc) * 2)) "$@"
