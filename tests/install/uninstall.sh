#!/bin/sh
# The target `uninstall` must remove all installed files and our folders, and nothing else.
# Usage: uninstall.sh BUILD_DIR WORK_DIR
set -eu
build=$1 work=$2
rm -rf "$work"
mkdir -p "$work/prefix/lib/pkgconfig" "$work/prefix/share/man/man3" "$work/kept"
prefix=$work/prefix
fail() { echo "$*" >&2; exit 1; }

# Restore the build folder's own lists of installed files at the end.
find "$build" -maxdepth 1 -name 'install_manifest*.txt' -exec mv {} "$work/kept" \;
trap 'rm -f "$build"/install_manifest*.txt; find "$work/kept" -name "install_manifest*" -exec mv {} "$build" \;' EXIT

if cmake --build "$build" --target uninstall > "$work/nothing.log" 2>&1; then fail "nothing installed, and no error"; fi
grep -q 'uninstall: nothing was installed' "$work/nothing.log" || { cat "$work/nothing.log"; exit 1; }

echo a stranger | tee "$prefix/lib/libstranger.so" "$prefix/share/man/man3/stranger.3" > "$prefix/lib/pkgconfig/stranger.pc"
find "$prefix" -type f | sort > "$work/before"
cmake --install "$build" --prefix "$prefix" > "$work/install.log"
[ "$(find "$prefix" -name '*stripack*' | wc -l)" -gt 50 ] || fail "not installed"
echo mine > "$prefix/share/pstripack/mine"

cmake --build "$build" --target uninstall > "$work/uninstall.log"
tail -n 1 "$work/uninstall.log"
echo "$prefix/share/pstripack/mine" | sort - "$work/before" > "$work/expected"
find "$prefix" ! -type d | sort | diff "$work/expected" - || fail "not as before"
left=$(find "$prefix" -type d -name '*stripack*')
[ "$left" = "$prefix/share/pstripack" ] || fail "folders left: $left"
if cmake --build "$build" --target uninstall > "$work/again.log" 2>&1; then fail "uninstalled twice"; fi
