#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-only
# Puts this package into a LAMMPS source tree, so that LAMMPS's own build has it with -D PKG_EEPA=on.
#
#   scripts/install_in_lammps.sh TREE             install it, or bring it up to date
#   scripts/install_in_lammps.sh --remove TREE    take it out: the tree is as before, to the byte
#
# TREE is the folder with cmake/ and src/ of LAMMPS 4 Feb 2025 or newer. What goes where: docs/in_lammps.md.
# All or nothing: a run that fails or is interrupted undoes what it did; one that was killed, the next run undoes.
set -euo pipefail
export LC_ALL=C # one order of sorting

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Paths in the tree, which is the working folder of all below.
manifest=lib/eepa/INSTALLED # what was installed: "file" or "lines", their cksum, the path
stage=.eepa-install         # in the tree, so that files are put into place by renaming

usage() { sed -n '3,9s/^# \{0,1\}//p' "$0"; }
die() {
    echo "install_in_lammps.sh: $*" >&2
    exit 1
}

# What is inserted into files of LAMMPS: path|how the line begins before which it comes|new line. Each new line
# has "eepa" in it, which no other line of these files has.
lines() {
    { if has_kokkos; then cat; else sed 's/ (ko) / (o) /; s/ (k) / /'; fi; } <<'LINES'
cmake/CMakeLists.txt|  EFF|  EEPA # project eepa
cmake/CMakeLists.txt|foreach(PKG_WITH_INCL |if(PKG_EEPA) # project eepa
cmake/CMakeLists.txt|foreach(PKG_WITH_INCL |  include(Packages/EEPA) # project eepa
cmake/CMakeLists.txt|foreach(PKG_WITH_INCL |endif() # project eepa
doc/src/Commands_pair.rst|   * :doc:`gran/hertz/history|   * :doc:`gran/eepa (ko) <pair_gran_eepa>`
doc/src/Commands_fix.rst|   * :doc:`wall/gran/region|   * :doc:`wall/gran/eepa (k) <fix_wall_gran_eepa>`
doc/src/Commands_compute.rst|   * :doc:`group/group|   * :doc:`gran/eepa/contacts <compute_gran_eepa_contacts>`
doc/src/Commands_compute.rst|   * :doc:`group/group|   * :doc:`gran/eepa/dt <compute_gran_eepa_dt>`
doc/src/Commands_compute.rst|   * :doc:`group/group|   * :doc:`gran/eepa/energy <compute_gran_eepa_energy>`
doc/src/Commands_compute.rst|   * :doc:`group/group|   * :doc:`gran/eepa/energy/atom <compute_gran_eepa_energy_atom>`
doc/src/pair_style.rst|* :doc:`gran/hertz/history|* :doc:`gran/eepa <pair_gran_eepa>` - elasto-plastic adhesive contact law
doc/src/fix.rst|* :doc:`wall/gran/region|* :doc:`wall/gran/eepa <fix_wall_gran_eepa>` - walls of pair style gran/eepa
doc/src/compute.rst|* :doc:`group/group|* :doc:`gran/eepa/contacts <compute_gran_eepa_contacts>` - contacts of pair style gran/eepa by branch
doc/src/compute.rst|* :doc:`group/group|* :doc:`gran/eepa/dt <compute_gran_eepa_dt>` - largest stable time step of pair style gran/eepa
doc/src/compute.rst|* :doc:`group/group|* :doc:`gran/eepa/energy <compute_gran_eepa_energy>` - stored and dissipated energies of pair style gran/eepa
doc/src/compute.rst|* :doc:`group/group|* :doc:`gran/eepa/energy/atom <compute_gran_eepa_energy_atom>` - dissipated energies of each particle
LINES
}
# The files of LAMMPS that get such lines, as far as this tree has them.
edited() { lines | cut -d '|' -f 1 | uniq | while read -r path; do [ ! -f "$path" ] || echo "$path"; done; }
our_lines() { grep -i eepa "$1" || true; }
other_lines() { grep -v -i eepa "$1" || true; }
# Paths of all files below a folder, sorted.
paths_below() { (cd "$1" && find . ! -type d | sed 's|^\./||' | sort); }
# Paths in the manifest, sorted.
installed() { sed -n "s/^$1 [0-9]* [0-9]* //p" $stage/installed | sort; }

require_lammps() {
    local file version # and date, for has_kokkos()
    for file in cmake/CMakeLists.txt src/version.h src/fix_neigh_history.h; do
        [ -f "$file" ] || die "$tree is no LAMMPS source tree: it has no $file"
    done
    version=$(sed -n 's/.*LAMMPS_VERSION "\(.*\)".*/\1/p' src/version.h)
    date=$(awk '{ month = index("JanFebMarAprMayJunJulAugSepOctNovDec", substr($2, 1, 3)) }
        NF == 3 && month % 3 == 1 { printf "%d%02d%02d", $3, (month + 2) / 3, $1 }' <<<"$version")
    [ -n "$date" ] || die "$tree/src/version.h names no version such as \"4 Feb 2025\": \"$version\""
    [ "$date" -ge 20250204 ] ||
        die "LAMMPS $version in $tree is too old: 4 Feb 2025 is the oldest that will do"
}

# Whether the tree gets the styles for KOKKOS, whose classes differ between versions. docs/kokkos.md says so, too.
has_kokkos() { [ "$date" -eq 20250204 ] && [ -d src/KOKKOS ]; }

# Writes all files as they shall be to $stage/new, and their manifest.
prepare() {
    mkdir $stage/new
    [ ! -f $manifest ] || cp $manifest $stage/installed
    touch $stage/installed $stage/manifest
    if [ "$action" = install ]; then put_files; fi
    edited | while read -r path; do edit "$path"; done
    [ "$action" = remove ] || mv $stage/manifest $stage/new/$manifest
}

put_files() {
    local file styles=()
    for file in "$root"/lammps_pkg/*.{h,cpp}; do
        case ${file##*/} in
        eepaplugin.cpp | lmp_main.cpp | eepa_styles.* | *_omp.*) ;; # the first three are for the plugin only
        *) styles+=("$file") ;;
        esac
    done
    put src/EEPA "${styles[@]}" "$root"/lammps_pkg/in_tree/*.{h,cpp}
    put src/OPENMP "$root"/lammps_pkg/*_omp.{h,cpp} # where LAMMPS looks for styles with threads
    if has_kokkos; then
        for file in "$root"/lammps_pkg/kokkos/*.{h,cpp}; do
            case ${file##*/} in
            pair_* | fix_*) put src/KOKKOS "$file" ;; # where LAMMPS looks for them
            *) put lib/eepa/kokkos "$file" ;;
            esac
        done
    fi
    put lib/eepa/eepa "$root"/kernel/eepa/*.h
    put lib/eepa/eepa_commands "$root"/commands/eepa_commands/*.{h,cpp}
    put lib/eepa/eepa_walls "$root"/walls/eepa_walls/*.{h,cpp}
    put lib/eepa "$root"/lammps_pkg/in_tree/README
    put cmake/Modules/Packages "$root"/lammps_pkg/in_tree/EEPA.cmake
    if [ -d doc/src ]; then # Debian's source package has none
        put doc/src "$root"/lammps_pkg/doc/*.rst
        put doc/src/figures "$root"/lammps_pkg/doc/figures/*.png
    fi
    (cd $stage/new && find . -type f | sed 's|^\./||' | sort | xargs cksum | sed 's/^/file /') >>$stage/manifest
}
put() {
    mkdir -p "$stage/new/$1"
    cp "${@:2}" "$stage/new/$1"
}

# Inserts this package's lines into $1, or leaves them out.
edit() {
    local missing new=$stage/new/$1
    mkdir -p "${new%/*}"
    cp -p "$1" "$new" # for its permissions
    other_lines "$1" >$stage/plain
    if [ "$action" = remove ]; then
        cat $stage/plain >"$new"
        return
    fi
    lines | grep "^$1|" >$stage/lines
    awk -F '|' 'FILENAME == ARGV[1] { begin[++n] = $2; line[n] = $3; next }
        { for (i = 1; i <= n; i++) if (!done[i] && index($0, begin[i]) == 1) { print line[i]; done[i] = 1 }
          print }' $stage/lines $stage/plain >"$new"
    missing=$(cut -d '|' -f 3 $stage/lines | grep -vxF -f "$new" | head -n 1 || true)
    case $1 in
    doc/*) [ -z "$missing" ] || echo "note: $tree/$1 has no such list as expected, so the styles are not in it" ;;
    *) [ -z "$missing" ] || die "$tree/$1 has no place for the line \"$missing\"" ;;
    esac
    other_lines "$new" | cmp -s - $stage/plain && { [ -s $stage/installed ] || cmp -s $stage/plain "$1"; } ||
        die "$tree/$1 could not be restored to the byte: does it have lines with \"eepa\", or an unfinished last line?"
    echo "lines $(our_lines "$new" | cksum) $1" >>$stage/manifest
}

# Refuses a tree in which what this script put there was changed, or something else has its place.
require_untouched() {
    local path sum
    installed file | while read -r path; do
        [ -f "$path" ] || die "$tree/$path is gone since it was installed: put it back"
    done
    path=$(installed file | xargs cksum | sed 's/^/file /' | grep -vxF -f $stage/installed | head -n 1 || true)
    [ -z "$path" ] || [ ! -s $stage/installed ] ||
        die "$tree/${path##* } was edited since it was installed: undo the change first"
    edited | while read -r path; do
        sum="lines $(our_lines "$path" | cksum) $path"
        grep -qxF "$sum" $stage/installed || { [ ! -s $stage/installed ] && [ -z "$(our_lines "$path")" ]; } ||
            die "$tree/$path: lines with \"eepa\" are not as this script writes them: undo the change first"
    done
    { paths_below $stage/new; find src/EEPA lib/eepa ! -type d 2>/dev/null || true; } | sort -u |
        comm -23 - <({ installed file; installed lines; edited; echo $manifest; } | sort -u) |
        while read -r path; do
            [ ! -e "$path" ] || die "$tree/$path is not of this package: move it away"
        done
    # LAMMPS finds headers by their names alone.
    paths_below $stage/new | sed -n '/^src\//p' | while read -r path; do
        for other in src/"${path##*/}" src/*/"${path##*/}"; do
            [ ! -e "$other" ] || [ "$other" = "$path" ] || die "$tree/$other has the name of a file of this package"
        done
    done
}

# Puts $stage/new into place. While $stage/changes is there, roll_back() has something to restore from $stage/old.
apply() {
    local path
    { paths_below $stage/new; installed file; [ ! -f $manifest ] || echo $manifest; } | sort -u |
        while read -r path; do [ ! -e "$path" ] || echo "$path"; done >$stage/present
    mkdir $stage/old
    tar -cf - -T $stage/present | tar -xf - -C $stage/old
    {
        comm -3 $stage/present <(paths_below $stage/new) | tr -d '\t'
        { diff -qr $stage/old $stage/new || [ $? -eq 1 ]; } | sed -n "s|^Files $stage/old/\(.*\) and .* differ\$|\1|p"
    } | sort >$stage/differs
    mv $stage/differs $stage/changes
    while read -r path; do rm -f "$path"; done <$stage/changes
    paths_below $stage/new | comm -12 - $stage/changes | tar -C $stage/new -cf - -T - | tar -xf -
    changes=$(wc -l <$stage/changes)
    rm $stage/changes
    remove_empty_folders
}

remove_empty_folders() {
    rmdir src/EEPA lib/eepa/eepa lib/eepa/eepa_commands lib/eepa/eepa_walls lib/eepa/kokkos lib/eepa doc/src/figures 2>/dev/null || true
}

# After success there is nothing to undo: $stage/changes is gone.
roll_back() {
    local path
    if [ -f $stage/changes ]; then
        while read -r path; do
            rm -f "$path"
            [ ! -e "$stage/old/$path" ] || cp -p "$stage/old/$path" "$path"
        done <$stage/changes
        remove_empty_folders
        echo "install_in_lammps.sh: $tree is as it was before the change that was cut off" >&2
    fi
    rm -rf $stage
}

action=install
case ${1:-} in
-h | --help)
    usage
    exit 0
    ;;
esac
if [ "${1:-}" = --remove ]; then
    action=remove
    shift
fi
[ $# -eq 1 ] || { usage >&2; exit 2; }
[ -d "$1" ] || die "$1 is no folder"
tree=$(cd "$1" && pwd)
cd "$tree"
require_lammps
if ! mkdir $stage 2>/dev/null; then
    [ -d $stage ] || die "$tree can not be written to"
    # shellcheck disable=SC2046
    ! kill -0 $(cat $stage/process 2>/dev/null) 2>/dev/null || die "another run of this script is at work in $tree"
    roll_back
    mkdir $stage
fi
trap roll_back EXIT
trap 'exit 1' HUP INT TERM
echo $$ >$stage/process

prepare
require_untouched
apply
if [ "$action" = install ]; then
    echo "$tree: package EEPA is there ($changes files changed); cmake -D PKG_EEPA=on builds it"
else
    echo "$tree: package EEPA is not there ($changes files changed)"
fi
