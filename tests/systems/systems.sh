#!/bin/sh
# Builds the project as other systems do and in unusual ways, and runs programs with each build.
# Usage: systems.sh CASE SOURCE_DIR WORK_DIR      CASE is one of
#   old     g++ 11, Make, folders with spaces in their names, sources that the build does not write to
#   bare    no Fortran compiler, no MPI, no OpenMP, archives only; cross-compiled: nothing that is built can run meanwhile
#   part    part of a project with other flags, language standards and defaults, by FetchContent (add_subdirectory)
#   posix   without anything that only Linux and its linkers have (PSTRIPACK_ONLY_POSIX): all tests
#   musl    the libraries' sources are compiled, not linked, with musl and libc++ instead of glibc and libstdc++; and then as
#           on macOS, where int64_t is long long, without anything that only Linux has
set -eu
case=$1 source=$2 work=$3
consumer=$source/tests/install/consumer
rm -rf "$work"
mkdir -p "$work"
jobs=$(nproc)
fail() { echo "systems.sh $case: $*" >&2; exit 1; }
install() { sh "$source/cmake/install-packages.sh" main "$@"; }
build() {  # build FOLDER OPTION...: of the project
  folder=$1
  shift
  { cmake -S "$source" -B "$folder" "$@" && cmake --build "$folder" --parallel "$jobs"; } > "$work/log" 2>&1 ||
    { tail -n 50 "$work/log"; fail "not built"; }
  if grep 'warning:' "$work/log"; then fail "warnings"; fi
}
# Compiled in half the time that Release takes.
only_libraries="-DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DPSTRIPACK_TESTS=OFF -DPSTRIPACK_EXAMPLES=OFF -DPSTRIPACK_PYTHON=OFF -DPSTRIPACK_WITH_MPI=OFF"

# shellcheck disable=SC2046,SC2086  # lists of words on purpose
case $case in
  old)
    install g++-11 make
    mkdir "$work/a folder"
    (cd "$source" && tar -c --exclude='./build*' --exclude=./.git .) | tar -x -C "$work/a folder"
    sums() { (cd "$work/a folder" && find . -type f -exec sha256sum {} + | sort); }
    sums > "$work/before"
    source="$work/a folder"
    build "$work/the build" -G "Unix Makefiles" -DCMAKE_CXX_COMPILER=g++-11 $only_libraries -DPSTRIPACK_TOOLS=OFF
    cmake --install "$work/the build" --prefix "$work/the prefix" > "$work/log"
    sums | diff "$work/before" - || fail "the build has written into the sources"
    cmake -S "$consumer" -B "$work/consumer build" -DCMAKE_PREFIX_PATH="$work/the prefix" -G "Unix Makefiles" > "$work/log"
    cmake --build "$work/consumer build" --parallel "$jobs" >> "$work/log" 2>&1 || { cat "$work/log"; fail "no consumer"; }
    for program in legacy_stripack legacy_stripack_static legacy_stripack_i8 fortran90 c_pstripack c_pstripack_archive; do
      "$work/consumer build/$program"
    done ;;

  bare)
    printf 'set(CMAKE_SYSTEM_NAME Linux)\nset(CMAKE_SYSTEM_PROCESSOR %s)\nset(CMAKE_Fortran_COMPILER NOTFOUND)\n' "$(uname -m)" \
      > "$work/toolchain.cmake"
    build "$work/build" -DCMAKE_TOOLCHAIN_FILE="$work/toolchain.cmake" -DPSTRIPACK_WITH_FORTRAN=OFF $only_libraries \
      -DPSTRIPACK_SHARED=OFF -DCMAKE_DISABLE_FIND_PACKAGE_OpenMP=ON -DCMAKE_INSTALL_LIBDIR=lib
    cmake --install "$work/build" --prefix "$work/prefix" > "$work/log"
    if find "$work" -name '*.so*' | grep .; then fail "shared libraries"; fi
    export PKG_CONFIG_PATH="$work/prefix/lib/pkgconfig"
    cc $(pkg-config --cflags pstripack) "$consumer/c_api.c" -o "$work/c_api" $(pkg-config --static --libs pstripack)
    "$work/c_api"
    cc $("$work/prefix/bin/pstripack-config" --abi c --static --cflags) "$consumer/c_api.c" -o "$work/c_api" \
      $("$work/prefix/bin/pstripack-config" --abi c --static --libs)
    "$work/c_api"
    "$work/prefix/bin/pstripack" -q points random 100 | "$work/prefix/bin/pstripack" -q info - | grep '^triangles *196$' ;;

  part)
    cat > "$work/CMakeLists.txt" << END
cmake_minimum_required(VERSION 3.20)
project(whole LANGUAGES C CXX Fortran)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_EXTENSIONS ON)
set(BUILD_SHARED_LIBS ON)
set(PSTRIPACK_WITH_MPI OFF CACHE BOOL "")
include(FetchContent)
FetchContent_Declare(pstripack SOURCE_DIR "$source")
FetchContent_MakeAvailable(pstripack)
add_executable(c_api "$consumer/c_api.c")
target_link_libraries(c_api PRIVATE pstripack::pstripack)
add_executable(legacy "$consumer/legacy.F90")
target_link_libraries(legacy PRIVATE pstripack::stripack_static)
if(NOT CMAKE_BUILD_TYPE STREQUAL "")
  message(FATAL_ERROR "CMAKE_BUILD_TYPE is \${CMAKE_BUILD_TYPE}")
endif()
END
    source=$work
    build "$work/build" -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_CXX_FLAGS="-Ofast -march=native -funsigned-char" -DCMAKE_Fortran_FLAGS="-Ofast -march=native" \
      -DCMAKE_UNITY_BUILD=ON
    "$work/build/c_api"
    "$work/build/legacy"
    if find "$work/build" -name '*_test' -o -name pstripack-benchmark | grep .; then fail "tests of a part are built"; fi ;;

  posix)
    build "$work/build" -G Ninja -DPSTRIPACK_ONLY_POSIX=ON
    [ ! -e "$work/build/src/cxx/pool" ] || fail "there is a pool"
    # Packages are those of Linux.
    ctest --test-dir "$work/build" --parallel "$((2 * jobs))" --output-on-failure -E '^packages|^privileges_test' ;;

  musl)
    install musl-dev libc++-dev
    clang=$(clang++ -print-resource-dir)
    libcxx=$(dirname "$(dirname "$(dirname "$clang")")")/include/c++/v1
    mkdir "$work/boost"
    ln -s /usr/include/boost "$work/boost/boost"
    cmake -S "$source" -B "$work/build" $only_libraries -DPSTRIPACK_TOOLS=OFF -DPSTRIPACK_WITH_FORTRAN=OFF > "$work/log"
    compile() {  # compile OPTION...
      xargs -P "$jobs" -n 1 clang++ -std=c++17 -fsyntax-only -w -nostdinc -isystem "$libcxx" \
        -D_LIBCPP_HAS_MUSL_LIBC -D_GNU_SOURCE -isystem "$clang/include" -isystem "$work/musl" -isystem "$work/boost" \
        -I"$source/src/cxx" -I"$work/build/src/cxx/capi" "$@"
    }
    sources() { find "$source/src/cxx" -name '*.cpp' ! -path '*/mpi/*' ! -name 'pstripack_mpi.cpp' "$@"; }
    cp -r /usr/include/x86_64-linux-musl "$work/musl"
    sources ! -name steward.cpp ! -name worker_main.cpp |
      compile -DPSTRIPACK_WITH_POOL '-DPSTRIPACK_MPIRUN="mpirun"' '-DPSTRIPACK_VERSION="0"'
    sed -i -E 's/^typedef (signed|unsigned) _Int64 +(u?int64_t|u?intmax_t);/typedef \1 long long \2;/' "$work/musl/bits/alltypes.h"
    grep -q 'long long int64_t;' "$work/musl/bits/alltypes.h"
    sources ! -path '*/pool/*' | compile -DPSTRIPACK_ONLY_POSIX ;;
  *) fail "no such case" ;;
esac
echo "systems.sh $case: all programs ran"
