#!/usr/bin/env bash
# Builds the site from the pages of this repository, always all of it, because each page has the table of contents of all.
# Any warning is an error.
#
#   docs/build.sh [FOLDER]      FOLDER: where it goes, build/site by default; open its index.html, no server is needed
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
case ${1:-} in
-h | --help)
    sed -n '2,5s/^#\( \|$\)//p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
esac
folder=${1:-${BUILD_DIR:-$root/build}/site}
# Debian's packages belong to the system's Python, which need not be the first one on PATH.
python=${PYTHON:-/usr/bin/python3}
"$python" -B -m sphinx -q -W --keep-going -n -a -E -j auto -b html -c "$root/docs" -d "$folder.doctrees" "$root" "$folder"
echo "$folder/index.html"
