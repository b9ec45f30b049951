#!/usr/bin/env bash
# Makes the Debian packages of this Debian release, for every x86-64: sets up what is missing, builds, makes the site, packs.
#
#   scripts/package.sh [more arguments for cmake, such as -D EEPA_ARCH=baseline]
#
# BUILD_DIR names another build folder than build-package. DEBEMAIL and DEBFULLNAME say who makes the packages.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export BUILD_DIR=${BUILD_DIR:-$root/build-package}
# With this prefix the libraries are in Debian's folder for them.
TARGETS=eepa_installed "$root/scripts/setup.sh" -D CMAKE_INSTALL_PREFIX=/usr -D BUILD_TESTING=OFF -D EEPA_ARCH=dispatch "$@"
"$root/docs/build.sh"
cd "$BUILD_DIR"
rm -f ./*.deb
cpack
ls -l -- *.deb
