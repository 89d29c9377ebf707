#!/bin/sh
# From a bare Debian 12 machine to the main job: a legacy SCVT program linked with the original STRIPACK and
# with PSTRIPACK, the two meshes compared, and stripack-compare on 100,000 random points.
# May be run again and again. Usage: ./quickstart.sh
set -eu
cd "$(dirname "$0")"
build=build
work=$build/quickstart

sh cmake/install-packages.sh

echo "Building in $build ..."
[ -f $build/CMakeCache.txt ] || generator="-G Ninja"
# shellcheck disable=SC2086  # two words on purpose
cmake -S . -B $build ${generator:-} -DCMAKE_BUILD_TYPE=Release
cmake --build $build --parallel "$(nproc)" --target scvt_original scvt_pstripack stripack-compare

mkdir -p $work
for library in original pstripack; do
  echo
  echo "scvt_legacy, 10,242 generators, ten iterations, linked with $library"
  $build/examples/scvt_legacy/scvt_$library -n 10242 -i 10 -o $work/$library | tee $work/$library.log
done
seconds() { awk '/^seconds in trmesh/ { print $4 }' "$work/$1.log"; }

echo
echo "The two final meshes"
$build/compare/stripack-compare mesh $work/original $work/pstripack \
  --seconds "$(seconds original)" "$(seconds pstripack)"

echo
echo "stripack-compare on 100,000 random points"
$build/compare/stripack-compare --points random --n 100000 --seed 1 --threads "1,$(nproc)"
