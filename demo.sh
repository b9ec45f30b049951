#!/usr/bin/env bash
# Sets up, then runs the study this project is about: the same cohesive column, from one input
# file, with particles of several diameters. Arguments go to run_study.py.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export BUILD_DIR=${BUILD_DIR:-$root/build}
TARGETS=lmp "$root/scripts/setup.sh"
python=$(sh "$root/scripts/find_python.sh")
exec "$python" "$root/examples/scale_collapse/run_study.py" "$@"
