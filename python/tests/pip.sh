#!/bin/sh
# pip installs the package of a checkout, without network, into a new environment. The module must need no libpstripack.
# Usage: pip.sh SOURCE_DIR WORK_DIR PYTHON
set -eu
source=$1 work=$2 python=$3
rm -rf "$work"
mkdir -p "$work/source"
(cd "$source" && tar -c --exclude='./build*' --exclude=./python/build --exclude=./.git .) | tar -x -C "$work/source"

"$python" -m venv --system-site-packages --without-pip "$work/env"
cd "$work"
env/bin/python -m pip install --no-build-isolation --no-index --no-deps ./source/python > pip.log 2>&1 ||
  { cat pip.log; exit 1; }
env/bin/python -c 'import pstripack; print(pstripack.__file__); assert len(pstripack.Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1]]).simplices) == 1' |
  grep "^$work/env/"
if ldd env/lib/python3*/site-packages/pstripack/_core*.so | grep pstripack; then echo "not alone" >&2; exit 1; fi
