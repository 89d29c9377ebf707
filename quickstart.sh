#!/bin/sh
# From a bare Debian 12 machine to the main job: a legacy SCVT program linked with the original STRIPACK and
# with PSTRIPACK, the two meshes compared; stripack-compare on 100,000 random points. With `mpi` also: the same
# program with four MPI ranks behind it, and the distributed one, against the run without.
# May be repeated. Usage: ./quickstart.sh [mpi]
set -eu
cd "$(dirname "$0")"
mpi=OFF build=build-quickstart
case ${1:-} in
  "") lists=main ;;
  mpi) lists=mpi mpi=ON build=build-quickstart-mpi ;;
  *) echo "usage: ./quickstart.sh [mpi]" >&2; exit 2 ;;
esac
work=$build/meshes

sh cmake/install-packages.sh $lists
mkdir -p $build $work

# The original. Of libncarg-dev it takes one file, and none of the 110 packages that libncarg-dev depends on.
find_ngmath() { find /usr/lib "$build/ncarg" -name libngmath.a 2> /dev/null | head -n 1; }
if [ -z "$(find_ngmath)" ]; then
  (cd $build && apt-get download -q libncarg-dev && dpkg-deb -x libncarg-dev_*.deb ncarg)
fi

echo "Building in $build ..."
[ -f $build/CMakeCache.txt ] || generator="-G Ninja"
# shellcheck disable=SC2086  # two words on purpose
cmake -S . -B $build ${generator:-} -DCMAKE_BUILD_TYPE=Release -DSTRIPACK_NGMATH="$(realpath "$(find_ngmath)")" \
  -DPSTRIPACK_TESTS=OFF -DPSTRIPACK_PYTHON=OFF -DPSTRIPACK_UNITY=ON -DPSTRIPACK_WITH_MPI=$mpi
# shellcheck disable=SC2046  # three words or one
cmake --build $build --parallel "$(nproc)" --target scvt_original scvt_pstripack stripack-compare \
  $([ $mpi = OFF ] || echo scvt_mpi pstripack_run)

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

if [ $mpi = OFF ]; then
  echo
  echo "The same with MPI ranks: ./quickstart.sh mpi"
  exit 0
fi

# As root, and with more ranks than cores, Open MPI runs only if told to.
if [ "$(id -u)" -eq 0 ]; then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi
echo
echo "MPI ranks on the $(nproc) cores of one machine: the same mesh; how fast, only more cores can tell"
export OMP_NUM_THREADS=1  # of each rank
model=$build/examples/scvt_legacy/scvt_pstripack
# run NAME COMMAND...: with as many generators as it takes for the pool to serve the calls (50,000)
run() {
  name=$1
  shift
  echo
  echo "$*"
  "$@" -n 60000 -i 3 -d bump -o "$work/$name"
}
run alone $model
run pool $build/src/cxx/pool/pstripack-run -n 4 --oversubscribe -- $model
$build/compare/stripack-compare mesh $work/alone $work/pool
run distributed mpirun -n 2 --oversubscribe --bind-to none $build/examples/scvt_mpi/scvt_mpi
$build/compare/stripack-compare mesh $work/alone $work/distributed
