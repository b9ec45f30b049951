#!/usr/bin/env bash
# Runs a command of this project on a bare Debian, as a newcomer would: a minimal system in a folder, a clean clone
# of what is committed, nothing else installed. Needs root and debootstrap.
#
#   scripts/fresh_debian.sh SUITE FOLDER COMMAND...    scripts/fresh_debian.sh trixie /var/tmp/trixie ./test.sh
#
# SUITE: bookworm (Debian 12), trixie (13). The first call makes FOLDER; later ones find there what was installed and
# built, and clone anew. Delete FOLDER to begin with a bare system again. MIRROR: another archive for debootstrap.
set -euo pipefail
if [ $# -lt 3 ]; then
    sed -n '2,8s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
suite=$1 folder=$2
shift 2
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Only a complete system is reused.
if [ ! -e "$folder/.complete" ]; then
    debootstrap --variant=minbase "$suite" "$folder" ${MIRROR:+"$MIRROR"}
    touch "$folder/.complete"
fi
rm -rf "$folder/root/project"
git clone -q "$project" "$folder/root/project"

# A private mount namespace, so that nothing stays mounted, however this ends. MPI's ranks share memory through
# /dev/shm.
export folder
exec unshare --mount bash -c '
    mount -t proc proc "$folder/proc"
    mount -t sysfs -o ro sysfs "$folder/sys"
    mkdir -p "$folder/dev/shm"
    mount -t tmpfs tmpfs "$folder/dev/shm"
    exec chroot "$folder" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        TERM="${TERM:-dumb}" BUILD_DIR=/root/build sh -c "cd /root/project && exec \"\$@\"" sh "$@"' bash "$@"
