#!/usr/bin/env bash
# Makes the Debian packages of this Debian release, for every x86-64: sets up what is missing, builds, makes the site, packs.
#
#   scripts/package.sh [--yes] [more arguments for cmake, such as -D EEPA_ARCH=baseline]
#
# --yes: install what is missing without asking, see scripts/setup.sh.
# BUILD_DIR names another build folder than build-package. DEBEMAIL and DEBFULLNAME say who makes the packages.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export BUILD_DIR=${BUILD_DIR:-$root/build-package}
case ${1:-} in
-h | --help)
    sed -n '2,9s/^#\( \|$\)//p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
esac
answer=()
if [ "${1:-}" = --yes ]; then
    answer=(--yes)
    shift
fi
# With this prefix the libraries are in Debian's folder for them.
TARGETS=eepa_installed "$root/scripts/setup.sh" "${answer[@]}" -D CMAKE_INSTALL_PREFIX=/usr -D BUILD_TESTING=OFF -D EEPA_ARCH=dispatch "$@"
"$root/docs/build.sh"
cd "$BUILD_DIR"
rm -f ./*.deb
cpack
ls -l -- *.deb
