#!/bin/sh
# Runs the first block of docs/relink.md word for word, in a folder like a checkout. Stand-ins replace two commands: cmake
# copies existing packages, and apt-get unpacks them into a folder. The block must install all Debian packages that CMake
# looks for. bare-root.sh --build runs the block without stand-ins.
# Usage: relink_block.sh SOURCE_DIR PACKAGES_DIR WORK_DIR
set -eu
source=$1 packages=$2 work=$3
system=$work/system/usr
rm -rf "$work"
mkdir -p "$work/bin" "$work/checkout"
fail() { echo "FAILED: $*" >&2; exit 1; }

awk '/^```/ { if (inside) exit; inside = /^```sh$/; next } inside' "$source/docs/relink.md" > "$work/block"
# shellcheck disable=SC2016  # quotes of Markdown, and CMake's variable below
expected=$(sed -n 's/^The last line of what it prints is `\(.*\)`\.$/\1/p' "$source/docs/relink.md")
if [ ! -s "$work/block" ] || [ -z "$expected" ]; then fail "docs/relink.md does not begin with a block and what it prints"; fi

# What CMake looks for, by Debian's names.
for name in $(cd "$source" && grep -hoE '(find_package|pkg_check_modules)\([A-Za-z0-9_]+' CMakeLists.txt src/cxx/CMakeLists.txt \
  tools/CMakeLists.txt compare/CMakeLists.txt | cut -d '(' -f 2 | sort -u); do
  case $name in
    Boost) needed=libboost-dev ;;
    MPI) needed='libopenmpi-dev openmpi-bin' ;;
    CLI11) needed=libcli11-dev ;;
    nlohmann_json) needed=nlohmann-json3-dev ;;
    fmt) needed=libfmt-dev ;;
    PkgConfig) needed=pkg-config ;;
    NETCDF) needed=libnetcdf-dev ;;
    OpenMP | Threads) needed=g++ ;;
    *) fail "CMake looks for $name; which package of Debian is that?" ;;
  esac
  for package in $needed; do
    tr ' ' '\n' < "$work/block" | grep -qxF -e "$package" || fail "docs/relink.md does not install $package, for $name"
  done
done

cat > "$work/bin/sudo" << 'E2'
#!/bin/sh
exec "$@"
E2
cat > "$work/bin/apt-get" << E2
#!/bin/sh
set -eu
[ "\$*" != update ] || exit 0
[ "\$1 \$2" = "install -y" ]
shift 2
for package in "\$@"; do
  case \$package in
    ./*) dpkg-deb -x "\$package" "$work/system" ;;
    *) tr ' ' '\n' < cmake/install-packages.sh | grep -qxF -e "\$package" || { echo "no package \$package" >&2; exit 1; } ;;
  esac
done
E2
cat > "$work/bin/cmake" << E2
#!/usr/bin/env python3
import json, shutil, sys
from pathlib import Path
option, asked, name = sys.argv[1:]
assert (option, asked) == ("--workflow", "--preset"), sys.argv
presets = json.loads(Path("CMakePresets.json").read_text())
steps = next(one for one in presets["workflowPresets"] if one["name"] == name)["steps"]
assert steps[-1]["type"] == "package"
build = next(one for one in presets["configurePresets"] if one["name"] == steps[0]["name"])["binaryDir"]
folder = Path(build.replace("\${sourceDir}", ".")) / "packages"  # CPACK_PACKAGE_DIRECTORY
folder.mkdir(parents=True)
for package in Path("$packages").glob("*.deb"):
    shutil.copy(package, folder)
E2
chmod +x "$work"/bin/*

cd "$work/checkout"
for part in CMakePresets.json cmake docs examples; do ln -s "$source/$part" .; done
lib=$system/lib multiarch=$system/lib/$(dpkg-architecture -q DEB_HOST_MULTIARCH)
env PATH="$work/bin:$PATH" PKG_CONFIG_PATH="$lib/pkgconfig:$multiarch/pkgconfig" LD_LIBRARY_PATH="$lib:$multiarch" \
  sh -eu "$work/block" > "$work/out"
[ "$(tail -n 1 "$work/out")" = "$expected" ] || { cat "$work/out"; fail "expected '$expected'"; }
# shellcheck disable=SC2016
grep -q 'CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)' "$source/cmake/packages.cmake" || fail "packages go elsewhere"
[ -e "$system/share/doc/pstripack/docs/relink.md" ] || fail "the documents are not installed"
python3 "$source/tests/docs/check_links.py" "$system/share/doc/pstripack"
echo "relink block: $expected"
