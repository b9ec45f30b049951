#!/usr/bin/env bash
# Runs Python with LAMMPS's module, its library and the plugin of this project's build folder.
#
#   ./run.sh                                  # compress.py
#   ./run.sh jupyter notebook compress.ipynb  # any other program
#
# BUILD_DIR names another build folder, PYTHON another Python.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${EEPA_BUILD_DIR:-${BUILD_DIR:-$root/build}}
if [ ! -f "$build/eepaplugin.so" ] || [ ! -x "$build/lmp" ]; then
    echo "run.sh: $build has no eepaplugin.so and lmp: run scripts/setup.sh in the source tree, or set BUILD_DIR" >&2
    exit 1
fi

# The LAMMPS that the plugin was compiled for is the one that build/lmp is linked with.
library=$(ldd "$build/lmp" | sed -n 's/.*liblammps[^ ]* => \([^ ]*\)\/liblammps.*/\1/p')
source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=\(.*\)\/cmake$/\1/p' "$library/CMakeCache.txt")
export LAMMPS_PLUGIN_PATH=$build
export LD_LIBRARY_PATH=$library${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export PYTHONPATH=$source/python${PYTHONPATH:+:$PYTHONPATH}
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
while IFS= read -r setting; do
    [[ $setting =~ ^[A-Z] ]] && export "${setting?}"
done < "$root/scripts/mpi.env"

if [ $# -gt 0 ]; then
    exec "$@"
fi
exec "$(sh "$root/scripts/find_python.sh")" "$here/compress.py"
