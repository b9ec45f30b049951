#!/bin/sh
# Prints the first Python 3 that has what the studies need: $PYTHON alone where it is set, else
# the system's own before the one on PATH, since apt installs the libraries for the former.
if [ -n "${PYTHON:-}" ]; then
    set -- "$PYTHON"
else
    set -- /usr/bin/python3 python3
fi
for python; do
    path=$(command -v "$python") || continue
    if "$path" -c 'import numpy, scipy, matplotlib, pandas, statsmodels, yaml' 2>/dev/null; then
        printf '%s\n' "$path"
        exit 0
    fi
done
echo "no Python 3 with NumPy, SciPy, Matplotlib, pandas, statsmodels and PyYAML among: $*" >&2
exit 1
