#!/usr/bin/env bash
# From a bare machine to a built project: installs what is missing (Debian, Ubuntu),
# obtains and builds LAMMPS once, configures and builds. Safe to run again.
#
#   scripts/setup.sh [--yes] [more arguments for cmake, such as -D EEPA_ARCH=native]
#
# On a terminal it asks before it installs packages, unless --yes is the first argument or the environment has
# CI. Where nobody can answer it installs them, as its caller wants a built project.
#
# BUILD_DIR names another build folder; TARGETS what to build (everything); EEPA_CACHE another place for LAMMPS.
set -euo pipefail

case ${1:-} in
-h | --help)
    sed -n '2,10s/^#\( \|$\)//p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
esac
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${BUILD_DIR:-$root/build}
ask=no
if [ -t 0 ]; then
    case ${CI:-} in '' | 0 | false | no) ask=yes ;; esac
fi
if [ "${1:-}" = --yes ]; then
    ask=no
    shift
fi

packages=(cmake ninja-build g++ libopenmpi-dev openmpi-bin libeigen3-dev libgtest-dev
    libbenchmark-dev libpng-dev python3 python3-numpy python3-scipy
    python3-matplotlib python3-meshio python3-pandas python3-statsmodels python3-yaml python3-jinja2
    python3-plotly snakemake
    python3-sphinx furo python3-myst-parser libjs-katex duktape
    dpkg-dev file xz-utils
    ca-certificates)

installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing=()
if command -v apt-get >/dev/null && command -v dpkg-query >/dev/null; then
    for package in "${packages[@]}"; do
        installed "$package" || missing+=("$package")
    done
    if [ ${#missing[@]} -gt 0 ]; then
        if [ $ask = yes ]; then
            echo "These packages are missing and will be installed with apt-get: ${missing[*]}"
            read -r -p "Go on? [Y/n] " answer || answer=n
            case $answer in
                '' | [Yy] | [Yy]es) ;;
                *)
                    echo "Nothing was installed. To install them yourself:" >&2
                    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
                    exit 1
                    ;;
            esac
        fi
        echo "Installing ${missing[*]}"
        as_root=()
        if [ "$(id -u)" -ne 0 ]; then
            if ! command -v sudo >/dev/null; then
                echo "Neither root nor sudo: have an administrator run" >&2
                echo "  apt-get install ${missing[*]}" >&2
                exit 1
            fi
            as_root=(sudo)
        fi
        "${as_root[@]}" apt-get update -q
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -q -y --no-install-recommends "${missing[@]}"
    fi
else
    for tool in cmake ninja c++ mpicxx mpirun tar; do
        command -v "$tool" >/dev/null || missing+=("$tool")
    done
    sh "$root/scripts/find_python.sh" >/dev/null 2>&1 || missing+=("python3 with NumPy, SciPy, Matplotlib, pandas, statsmodels and PyYAML")
    if [ ${#missing[@]} -gt 0 ]; then
        printf 'Missing: %s\n' "${missing[@]}" >&2
        cat >&2 <<'NEEDED'
This is no Debian or Ubuntu, so nothing is installed here. Needed are: CMake 3.20 or newer, Ninja,
a C++17 compiler (GCC or Clang) with OpenMP, an MPI with its compiler wrappers, Eigen 3.3 or newer,
GoogleTest, Google Benchmark, and Python 3 with NumPy, SciPy, Matplotlib, pandas, statsmodels and PyYAML.
NEEDED
        exit 1
    fi
fi

# The generator of an existing build folder can not be changed.
generator=(-G Ninja)
[ ! -f "$build/CMakeCache.txt" ] || generator=()
cmake -S "$root" -B "$build" "${generator[@]}" "$@"
# TARGETS: what to build, everything if empty; a study needs no tests.
# shellcheck disable=SC2086
cmake --build "$build" ${TARGETS:+--target $TARGETS}
