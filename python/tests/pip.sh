#!/bin/sh
# wheels.sh makes a source distribution of a checkout and a wheel of it, without network. pip installs the wheel into a new
# environment. The module must need no libpstripack and no Fortran, and the wheel must have its licences and metadata.
# Where something is missing pip says so in one line. Usage: pip.sh SOURCE_DIR WORK_DIR PYTHON
set -eu
source=$1 work=$2 python=$3
fail() { echo "pip.sh: $*" >&2; exit 1; }
rm -rf "$work"
mkdir -p "$work/source" "$work/wheels"
(cd "$source" && tar -c --exclude='./build*' --exclude=./python/build --exclude=./.git .) | tar -x -C "$work/source"
export PIP_NO_BUILD_ISOLATION=0 PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1

"$work/source/python/wheels.sh" "$work/wheels" "$python" > "$work/log" 2>&1 || { tail -n 50 "$work/log"; fail "no wheel"; }
grep '\.whl: needs ' "$work/log" > "$work/tag"
cat "$work/tag"
grep -qE ': manylinux_2_[0-9]+; to copy: (libgomp.so.1|libomp.so.5|nothing)$' "$work/tag" || fail "the wheel needs other libraries"

cd "$work"
"$python" -m venv --system-site-packages --without-pip env
env/bin/python -m pip install --no-deps wheels/pstripack-*.whl > pip.log 2>&1 || { cat pip.log; exit 1; }
env/bin/python - << 'END' | grep "^$work/env/"
import importlib.metadata, os, pstripack
print(pstripack.__file__)
assert len(pstripack.Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1]]).simplices) == 1
about = importlib.metadata.metadata("pstripack")
assert about["Version"] == importlib.metadata.version("pstripack") and "Delaunay(octahedron)" in about.get_payload()
assert about["License"] and about["Summary"] and about.get_all("Classifier") and about.get_all("Project-URL")
files = [file.name for file in importlib.metadata.files("pstripack")]
assert "LICENSE" in files and "LICENSE-third-party.txt" in files and "py.typed" in files, files
assert ("three.min.js" in files) == os.path.exists("/usr/share/javascript/three/three.min.js"), files
END
if ldd env/lib/python3*/site-packages/pstripack/_core*.so | grep -E 'pstripack|fortran'; then fail "not alone"; fi

# Something is missing: one line. A PATH with Python's own needs only.
mkdir bin
for tool in sh uname make; do ln -s "$(command -v $tool)" bin; done
lacks() {  # lacks WHAT COMMAND...: pip fails and says in one line what is needed
  what=$1
  shift
  if "$@" "$work/env/bin/python" -m pip wheel --no-deps --wheel-dir none "$work"/wheels/pstripack-*.tar.gz > lacks.log 2>&1; then
    fail "built without $what"
  fi
  grep "pstripack: to build it, .*$what" lacks.log || { cat lacks.log; fail "does not say that $what is needed"; }
  if grep -q Traceback lacks.log; then cat lacks.log; fail "$what: a traceback"; fi
}
lacks "CMake 3.20" env PATH="$work/bin"
ln -s "$(command -v cmake)" bin
lacks "a C++ compiler" env PATH="$work/bin" CMAKE_GENERATOR="Unix Makefiles"
lacks "Boost's headers" env CMAKE_ARGS="-DBoost_NO_BOOST_CMAKE=ON -DBoost_NO_SYSTEM_PATHS=ON -DBOOST_ROOT=$work/none"
echo "pip: all checks passed"
