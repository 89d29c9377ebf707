#!/bin/sh
# Environment Modules load the modulefile from its own place and through a link: the package must be found. After
# unloading the environment must be as before. Usage: modulefile.sh MODULECMD PREFIX CONSUMER_DIR WORK_DIR VERSION
set -eu
modulecmd=$1 consumer=$3 work=$4 version=$5
prefix=$(cd "$2" && pwd)
rm -rf "$work"
mkdir -p "$work/site/pstripack"
ln -s "$prefix/share/pstripack/modulefiles/pstripack/$version" "$work/site/pstripack/$version"
fail() { echo "$*" >&2; exit 1; }
module() { eval "$("$modulecmd" sh "$@")"; }
unset LD_LIBRARY_PATH LIBRARY_PATH PKG_CONFIG_PATH CMAKE_PREFIX_PATH MANPATH MODULEPATH LOADEDMODULES _LMFILES_
path=$PATH

for folder in "$prefix/share/pstripack/modulefiles" "$work/site"; do
  MODULEPATH=$folder
  export MODULEPATH
  module load pstripack
  # shellcheck disable=SC2046  # lists of words on purpose
  gfortran $(pkg-config --cflags stripack) "$consumer/legacy.F90" -o "$work/by_pkg_config" $(pkg-config --libs stripack)
  # shellcheck disable=SC2046
  gfortran $(pstripack-config --fflags) "$consumer/legacy.F90" -o "$work/by_variables" -lstripack
  "$work/by_pkg_config"
  "$work/by_variables"
  [ "$(pstripack-config --prefix)" = "$prefix" ] || fail "PATH: $PATH"
  [ "$CMAKE_PREFIX_PATH" = "$prefix" ] || fail "CMAKE_PREFIX_PATH: $CMAKE_PREFIX_PATH"
  [ -z "${MANPATH:-}" ] || fail "MANPATH: $MANPATH"
  module unload pstripack
  [ "$PATH" = "$path" ] || fail "PATH after unloading: $PATH"
  [ -z "${LD_LIBRARY_PATH:-}${LIBRARY_PATH:-}${PKG_CONFIG_PATH:-}${CMAKE_PREFIX_PATH:-}" ] || fail "something is left"
done
MANPATH=/somewhere
export MANPATH
module load pstripack
[ "$MANPATH" = "$prefix/share/man:/somewhere" ] || fail "MANPATH: $MANPATH"
"$modulecmd" sh help pstripack 2>&1 | grep "PSTRIPACK $version"
