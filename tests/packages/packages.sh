#!/bin/sh
# The Debian packages that cpack makes of a build: each package must have its files and dependencies, MPI only if needed,
# and together they must have every installed file exactly once.
# Usage: packages.sh BUILD_DIR WORK_DIR VERSION SOVERSION PREFIX CONSUMER_DIR    PREFIX: what `cmake --install` installs
set -eu
build=$1 work=$2 version=$3 soname=$4 prefix=$5 consumer=$6
rm -rf "$work"
mkdir -p "$work/all"
fail() { echo "$*" >&2; exit 1; }

cp "$build"/install_manifest*.txt "$work" 2>/dev/null || true
(cd "$build" && cpack -G DEB -B "$work/packages") > "$work/cpack.log" || { cat "$work/cpack.log"; exit 1; }
for manifest in "$build"/install_manifest_*.txt; do  # the target `uninstall` would remove the files in it
  [ ! -e "$manifest" ] || [ -e "$work/${manifest##*/}" ] || fail "cpack has left $manifest"
done
cd "$work/packages"
rm -rf _CPack_Packages

multiarch=$(dpkg-architecture -q DEB_HOST_MULTIARCH)

# has PACKAGE DEPENDS_ON NOT_ON PATH...
has() {
  file=$(echo "$1"_*.deb) on=$2 not_on=$3
  shift 3
  [ -e "$file" ] || fail "no package $file"
  [ "$(dpkg-deb -f "$file" Version | cut -d- -f1)" = "$version" ] || fail "$file: version"
  depends=$(dpkg-deb -f "$file" Depends)
  echo "$depends" | grep -qE "$on" || fail "$file does not depend on $on: $depends"
  if echo "$depends" | grep -qE "$not_on"; then fail "$file depends on $not_on: $depends"; fi
  dpkg-deb -c "$file" | awk '{ print $6 }' > contents
  for path in "$@"; do
    grep -qE "^\./usr/$path\$" contents || fail "$file has no $path"
  done
  rm contents
}
lib="lib(/$multiarch)?"
for library in libpstripack libpstripack_fortran libstripack libstripack_r4 libstripack_8arg libstripack_i8; do
  has "libpstripack$soname" libgomp 'mpi|netcdf|fmt|python' "$lib/$library.so.$soname"
  has libpstripack-dev "libpstripack$soname \(= $version" 'mpi|netcdf|fmt' "$lib/$library.so" "$lib/$library.a" \
    "$lib/pkgconfig/${library#lib}.pc"
done
for abi in r8 r4 8arg i8; do
  has "libpstripack$soname" libgfortran mpi "$lib/pstripack/switch/$abi/libstripack.so"
done
has libpstripack-dev "libpstripack$soname" mpi include/pstripack.h include/pstripack/stripack/stripack.mod \
  "$lib/libstripack_f90.a" "$lib/pkgconfig/stripack_f90.pc" share/pstripack/which_trmesh.sh share/pstripack/which_library.sh \
  share/pstripack/stripack_module.F90 "$lib/cmake/pstripack/pstripackConfig.cmake" bin/pstripack-config \
  share/man/man3/trmesh.3.gz share/man/man1/pstripack-config.1.gz
if grep -q '^PSTRIPACK_WITH_MPI:BOOL=ON' "$build/CMakeCache.txt"; then
  has "libpstripack-mpi$soname" "mpi.*|libpstripack$soname \(= $version" 'netcdf|-dev' "$lib/libpstripack_mpi.so.$soname" \
    "$lib/libpstripack_mpi_fortran.so.$soname"
  has libpstripack-mpi-dev "libpstripack-mpi$soname.*libpstripack-dev.*-dev" netcdf include/pstripack_mpi.h \
    "$lib/libpstripack_mpi.so" "$lib/libpstripack_mpi.a" "$lib/pkgconfig/pstripack_mpi.pc" share/man/man3/pstripack_mpi.3.gz
  has pstripack-mpi "libpstripack$soname .*mpi" python bin/pstripack-run bin/pstripack-worker bin/pstripack-mpi \
    share/man/man1/pstripack-run.1.gz share/bash-completion/completions/pstripack-run
fi
has pstripack "libpstripack$soname \(= $version" mpi bin/pstripack bin/stripack-compare share/man/man1/pstripack.1.gz
if [ -e "$build/python/pstripack" ]; then
  has python3-pstripack "libpstripack$soname \(= $version.*python3-numpy" 'mpi|scipy' \
    'lib/python3[^/]*/(dist|site)-packages/pstripack/_core\..*\.so' 'lib/python3[^/]*/(dist|site)-packages/pstripack/py\.typed' \
    'lib/python3[^/]*/(dist|site)-packages/pstripack-[0-9a-z.]*\.dist-info/METADATA'
fi
has pstripack-doc '^$' . share/doc/pstripack/README.md share/doc/pstripack/docs/relink.md \
  share/doc/pstripack/docs/clients/mpas.md share/doc/pstripack/examples/fortran77/mesh.f
completions=share/bash-completion/completions
fish=share/fish/vendor_completions.d zsh='share/zsh/(vendor-completions|site-functions)'  # a build for /usr, any other
has libpstripack-dev . mpi "$completions/pstripack-config" "$fish/pstripack-config.fish" "$zsh/_pstripack-config"
has pstripack libpstripack mpi "$completions/pstripack" "$completions/stripack-compare" "$fish/pstripack.fish" "$zsh/_pstripack"

# Every file of `cmake --install` except the modulefile, exactly once.
for file in ./*.deb; do
  dpkg-deb -x "$file" "$work/all"
  dpkg-deb -c "$file" | awk '$1 !~ /^d/ { print $6 }'
done | sed 's/\.gz$//; s|^\./usr||' | grep -vE '^/share/(doc/[^/]*/(copyright|changelog|changelog.Debian)$|lintian/)' | sort > "$work/packed"
(cd "$prefix" && find . ! -type d | sed 's/^\.//' | grep -v '^/share/pstripack/modulefiles/' | sort) > "$work/installed"
diff "$work/installed" "$work/packed" || fail "what is installed (<) is not what is packed (>)"

# A CMake project finds the packages without MPI, also where MPI is installed.
for file in libpstripack"$soname"_*.deb libpstripack-dev_*.deb; do dpkg-deb -x "$file" "$work/without_mpi"; done
{
  cmake -S "$consumer" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$work/without_mpi/usr"
  cmake --build "$work/consumer" --target legacy_stripack
} > "$work/consumer.log" 2>&1 || { cat "$work/consumer.log"; exit 1; }
"$work/consumer/legacy_stripack"

find "$work/all" -name '*.so.*' -type f -o -path '*/bin/*' -type f | while read -r file; do
  if readelf -SW "$file" 2>/dev/null | grep -q '\.debug_info'; then fail "$file is not stripped"; fi
done
echo "packages: $(find . -name '*.deb' | wc -l), with $(wc -l < "$work/packed") files"
