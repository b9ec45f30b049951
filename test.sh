#!/usr/bin/env bash
# Sets up, builds and runs every test; arguments go to ctest, such as -R kernel or -j 2.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=${BUILD_DIR:-$root/build}
BUILD_DIR=$build "$root/scripts/setup.sh"
ctest --test-dir "$build" --output-on-failure --no-tests=error "$@"
