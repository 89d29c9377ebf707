#!/bin/sh
# Runs the commands at the head of an example ("$ command") in a copy of its folder, with the package in PREFIX, and
# checks the last line of the output. Usage: run.sh EXAMPLE_DIR WORK_DIR PREFIX [LINE]
set -eu
example=$1 work=$2 prefix=$3
rm -rf "$work"
cp -r "$example" "$work"
cd "$work"

libdir=$(dirname "$(dirname "$(find "$prefix" -name stripack.pc)")")
export PKG_CONFIG_PATH="$libdir/pkgconfig" LD_LIBRARY_PATH="$libdir" CMAKE_PREFIX_PATH="$prefix"
PYTHONPATH=$(echo "$prefix"/lib*/python3*/*-packages)
export PYTHONPATH
sed -n 's/^[^$]*\$ //p' mesh.* > commands.sh
sh -eux commands.sh > output.log
cat output.log
tail -n 1 output.log | grep -qx "${4:-1000 nodes, 1996 triangles, area 12.566371}"
