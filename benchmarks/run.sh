#!/usr/bin/env bash
# Sets up, builds and runs the benchmarks. Arguments go to run_benchmarks.py: --quick, --only PART.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export BUILD_DIR=${BUILD_DIR:-$root/build}
TARGETS="lmp benchmarks" "$root/scripts/setup.sh"
python=$(sh "$root/scripts/find_python.sh")
exec "$python" "$root/benchmarks/run_benchmarks.py" "$@"
