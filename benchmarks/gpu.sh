#!/usr/bin/env bash
# Measures gran/eepa/kk beside LAMMPS's gran/hooke/history/kk. Arguments go to run_gpu.py: --help tells them.
# Nothing is built: LAMMPS must have been built with KOKKOS as docs/kokkos.md says.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
exec "${PYTHON:-python3}" "$root/benchmarks/run_gpu.py" "$@"
