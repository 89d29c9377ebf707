#!/bin/sh
# From a bare Debian 12 to running programs: makes a new root folder by debootstrap, installs the packages in it by apt
# and builds the examples by their own commands. Measures the time until the first example has run. Needs root rights,
# debootstrap, network, and some minutes.
# Usage: tests/packages/bare-root.sh PACKAGES_DIR|--build [ROOT_DIR]
#        cmake --workflow --preset packages && tests/packages/bare-root.sh build-packages/packages
#        --build: runs the first block of docs/relink.md instead, which builds the packages from a copy of HEAD
#        ROOT_DIR: an existing bare root, which is copied
set -eu
if [ "${1:-}" != --in-namespace ]; then  # mounts end with this script
  exec unshare --mount --propagation private sh "$0" --in-namespace "$@"
fi
shift
packages=$1 bare=${2:-}
source=$(cd "$(dirname "$0")/../.." && pwd)
root=$(mktemp -d)
trap 'umount -R "$root/proc" "$root/dev/shm" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT

if [ -n "$bare" ]; then
  cp -a "$bare/." "$root"
else
  debootstrap --variant=minbase bookworm "$root" > /dev/null
fi
chmod 755 "$root"
cp /etc/resolv.conf "$root/etc"
mount -t proc proc "$root/proc"
mkdir -p "$root/dev/shm"
mount -t tmpfs tmpfs "$root/dev/shm"
mkdir "$root/work"
if [ "$packages" = --build ]; then
  git -C "$source" archive HEAD | tar -x -C "$root/work"
else
  cp "$packages"/*.deb "$root/work"
  cp -r "$source/examples" "$root/work"
fi

# inside COMMAND: runs the command in the new system
inside() {
  echo
  echo "\$ $1"
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 \
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
    chroot "$root" sh -euc "cd /work && { $1
}" > "$root/output" 2>&1 || { cat "$root/output"; exit 1; }
  tail -n 3 "$root/output"
}
# output_has TEXT: fails unless the last command printed this line
output_has() { grep -qxF -e "$1" "$root/output" || { echo "expected: $1" >&2; exit 1; }; }
answer='1000 nodes, 1996 triangles, area 12.566371'
example() {
  inside "cd examples/$1 && sed -n 's/^[^\$]*\\$ //p' mesh.* | sh -eux"
  output_has "$answer"
}

if [ "$packages" = --build ]; then
  inside "$(awk '/^```/ { if (inside) exit; inside = /^```sh$/; next } inside' "$source/docs/relink.md" | sed 's/^sudo //')"
  output_has "$answer"
  inside "stripack-compare --version && ls /usr/share/doc/pstripack/docs/relink.md"
  echo
  echo "bare root: the block of docs/relink.md ran"
  exit
fi
inside "apt-get update -q"
start=$(date +%s)
inside "apt-get install -y -q ./libpstripack1_*.deb ./libpstripack-dev_*.deb"
inside "gfortran examples/fortran77/mesh.f -o mesh \$(pkg-config --libs stripack) && ./mesh"
output_has "$answer"
echo
echo "bare root: from the first command to the example's last line: $(($(date +%s) - start)) s"

inside "readelf -d mesh; PSTRIPACK_REPORT=1 ./mesh 2>&1 | cut -d ' ' -f 1-3"
output_has 'pstripack: threads n=1000'
for example in fortran77 fortran90 modern_fortran c; do example $example; done
inside "apt-get install -y -q --no-install-recommends cmake g++ make"
inside "gfortran examples/fortran90/mesh.f90 -o mesh \$(pstripack-config --fflags --static --libs) && ./mesh"
output_has "$answer"
if ldd "$root/work/mesh" | grep pstripack; then echo "not static" >&2; exit 1; fi
example cxx
inside "apt-get install -y -q --no-install-recommends ./*.deb"
example mpi_f08
inside "gfortran examples/fortran77/mesh.f -o mesh \$(pkg-config --libs stripack) && pstripack-run -n 2 -- ./mesh"
output_has "$answer"
inside "pstripack points random 100 > nodes.txt && pstripack info nodes.txt | tr -s ' '"
output_has 'triangles 196'
inside "stripack-compare --version && stripack-compare --help > /dev/null"
inside "python3 -c 'import pstripack as p; print(p.Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1]]).simplices)'"
output_has '[[0 1 2]]'
inside "apt-get purge -y -q '*pstripack*' && ! find / -xdev -path /work -prune -o -name '*stripack*' -print | grep ."
echo
echo "bare root: all ran"
