#!/bin/sh
# lintian must report no errors and no warnings of the Debian packages in a folder. Usage: lintian.sh FOLDER
set -eu
cd "$1"

# A build that is not for /usr has neither multiarch folders nor Debian's folder for Python: suppress these tags.
multiarch=$(dpkg-architecture -q DEB_HOST_MULTIARCH)
suppressed=running-as-root
dpkg-deb -c libpstripack-dev_*.deb | grep -q "/usr/lib/$multiarch/pkgconfig/" ||
  suppressed=pkg-config-multi-arch-wrong-dir,pkg-config-unavailable-for-cross-compilation,python-module-in-wrong-location
lintian --allow-root --fail-on error,warning --suppress-tags "$suppressed" ./*.deb
