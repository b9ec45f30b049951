#!/bin/sh
# Reads the output of ninja or make, keeps all of it in LOG, shows a line for each tenth
# of the work: hundreds of lines of compiler commands would bury what the user has to know.
#
#   build_progress.sh LOG
set -eu
shown=0
start=$(date +%s)
: >"$1"
while IFS= read -r line; do
    printf '%s\n' "$line" >>"$1"
    case $line in
    \[*/*\]*) # ninja: [12/345] ...
        count=${line%%]*}
        count=${count#[}
        total=${count#*/}
        count=${count%%/*}
        ;;
    \[*%\]*) # make: [ 12%] ...
        count=${line%%\%*}
        count=${count#[}
        count=${count##* }
        total=100
        ;;
    *) continue ;;
    esac
    case $count$total in
    *[!0-9]*) continue ;;
    esac
    [ "$total" -ge 20 ] || continue
    tenth=$((count * 10 / total))
    if [ "$tenth" -gt "$shown" ]; then
        shown=$tenth
        printf '   LAMMPS: %3d %%  (%d s)\n' $((tenth * 10)) $(($(date +%s) - start))
    fi
done
