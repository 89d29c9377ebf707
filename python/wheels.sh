#!/bin/sh
# Makes a source distribution, and of it a wheel for each Python, in a folder. auditwheel, where it is installed, makes the
# wheels run on other systems; python/tests/wheel_tag.py tells on which. Without network: PIP_NO_BUILD_ISOLATION=0.
# Usage: wheels.sh FOLDER [PYTHON...]      PYTHON: all python3.* in PATH that have pip
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
shift
if [ $# -eq 0 ]; then
  for minor in 8 9 10 11 12 13 14; do
    if "python3.$minor" -m pip --version > /dev/null 2>&1; then set -- "$@" "python3.$minor"; fi
  done
fi
[ $# -gt 0 ] || { echo "wheels.sh: no Python with pip" >&2; exit 1; }
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
archive=$(cd "$here" && "$1" -c "import sys, setuptools.build_meta as b; print(b.build_sdist(sys.argv[1]))" "$folder" | tail -n 1)
for python; do
  "$python" -m pip wheel --no-deps --no-cache-dir --wheel-dir "$folder" "$folder/$archive"
done
for wheel in "$folder"/pstripack-*.whl; do
  "$1" "$here/tests/wheel_tag.py" "$wheel"
  if command -v auditwheel > /dev/null; then auditwheel repair --wheel-dir "$folder" "$wheel"; fi
done
