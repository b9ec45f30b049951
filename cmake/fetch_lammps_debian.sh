#!/bin/sh
# Fetches LAMMPS's source as Debian's source package, with apt and so with
# apt's signature check, and leaves it unpacked in TARGET.
#
#   fetch_lammps_debian.sh TARGET SUITE VERSION
#
# Needs no root and changes nothing of the machine's own apt state: the release
# of Debian that this machine runs need not be the one that has this LAMMPS, so
# apt gets a private configuration, with the machine's own archive and another suite.
#
# Exit status: 0 done; 2 this machine has no Debian archive configured;
# 3 the archive no longer has that version; 1 anything else.
set -eu

target=$1 suite=$2 version=$3

# Next to the target, so that the closing rename stays within one file system:
# an interrupted fetch then leaves no half tree under the final name.
parent=$(dirname "$target")
mkdir -p "$parent"
work=$(mktemp -d "$parent/.fetch.$(basename "$target").XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/unpacked"

archive_of() {
    # The label must be "Debian", too: the security archive has the same origin but not this package.
    # $(...) is apt's own syntax here, not the shell's.
    # shellcheck disable=SC2016
    apt-get "$@" indextargets --format '$(ORIGIN)|$(LABEL)|$(COMPONENT)|$(REPO_URI)|$(SIGNED_BY)' \
        'Identifier: Packages' 2>/dev/null |
        awk -F'|' '$1 == "Debian" && $2 == "Debian" && $3 == "main" { print $4 "|" $5; exit }'
}

archive=$(archive_of) || archive=
if [ -z "$archive" ]; then
    # A minimal image has sources but no lists; fetch them privately.
    echo "reading the package lists of this machine's apt sources ..."
    apt-get -o "Dir::State::lists=$work/lists" -o "Dir::Cache=$work/cache" \
        -o APT::Sandbox::User="$(id -un)" -q update || true
    archive=$(archive_of -o "Dir::State::lists=$work/lists") || archive=
    rm -rf "$work/lists"
    mkdir -p "$work/lists/partial"
fi
if [ -z "$archive" ]; then
    echo "no Debian archive among this machine's apt sources" >&2
    exit 2
fi
uri=${archive%%|*}
key=${archive#*|}
# The machine's own key entry, when it has a plain file name; else Debian's usual keyring.
case $key in
/*) ;;
*) key=/usr/share/keyrings/debian-archive-keyring.gpg ;;
esac

echo "deb-src [signed-by=$key] $uri $suite main" >"$work/sources.list"

# The sandbox user could not read a private folder; apt would warn and carry on without it.
set -- -q \
    -o "Dir::Etc::sourcelist=$work/sources.list" \
    -o Dir::Etc::sourceparts=/dev/null \
    -o "Dir::State::lists=$work/lists" \
    -o "Dir::Cache=$work/cache" \
    -o Acquire::Languages=none \
    -o APT::Sandbox::User="$(id -un)"

apt-get "$@" update
if ! apt-cache "$@" showsrc --only-source lammps 2>/dev/null | grep -Fqx "Version: $version"; then
    echo "Debian's suite '$suite' has no lammps $version (any more); it has:" >&2
    apt-cache "$@" showsrc --only-source lammps 2>/dev/null | sed -n 's/^Version:/   /p' >&2
    exit 3
fi
(cd "$work" && apt-get "$@" source --only-source --tar-only --download-only "lammps=$version")

tarball=
for file in "$work"/lammps_*.orig.tar.*; do
    case $file in
    *.asc) ;;
    *) tarball=$file ;;
    esac
done
if [ ! -f "$tarball" ]; then
    echo "apt reported success but left no lammps_*.orig.tar.* behind" >&2
    exit 1
fi

# Most of the tree is manuals, examples and tables of force fields that no build needs.
# Some of the tarballs have a top folder and some have none.
echo "unpacking $(basename "$tarball") ..."
set --
for folder in doc examples potentials unittest tools; do
    set -- "$@" "--exclude=$folder" "--exclude=./$folder" "--exclude=*/$folder"
done
tar -x -f "$tarball" -C "$work/unpacked" --no-same-owner --anchored --no-wildcards-match-slash "$@"

tree=
for folder in "$work/unpacked" "$work/unpacked"/*; do
    if [ -f "$folder/cmake/CMakeLists.txt" ] && [ -f "$folder/src/version.h" ]; then
        tree=$folder
        break
    fi
done
if [ -z "$tree" ]; then
    echo "$(basename "$tarball") holds no LAMMPS source tree" >&2
    exit 1
fi
chmod 755 "$tree"
# -T: never move into a folder that another process has made at this path meanwhile.
mv -T "$tree" "$target"
