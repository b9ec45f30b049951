#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-only
# Checks that take too long, or tools too many, for ctest. Each ends with one line of figures.
#
#   hardening.sh fuzz [SECONDS]   libFuzzer on parser, kernel and walls, SECONDS each (300)
#   hardening.sh sanitizers       every test with address and undefined-behaviour sanitizers
#   hardening.sh valgrind         memcheck on tests/fuzz/in.valgrind
#   hardening.sh differential [COUNT]  random scripts in ways that must not matter, on 1, 2 and 4 ranks (100)
#   hardening.sh dispatch         a build with EEPA_ARCH=dispatch: its bits, its code, a processor without AVX
#   hardening.sh fpe              the same in-file with floating-point exceptions trapped
#   hardening.sh mutation [OPTION...]  small faults in kernel and commands, see tests/mutation/mutate.py
#   hardening.sh intree [LAMMPS]  install into a copy of this LAMMPS source, build it, run the tests against it, remove
#
# EEPA_LMP: the lmp to use (build/lmp). EEPA_HARDENING_DIR: working folder (build-hardening). EEPA_INTREE_ARGS: more
# arguments for CMake in `intree`, such as "-D EEPA_KOKKOS=on". CMake's own variables are obeyed, such as
# CMAKE_CXX_COMPILER_LAUNCHER=ccache, CMAKE_GENERATOR=Ninja and CMAKE_BUILD_PARALLEL_LEVEL=2.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
work=${EEPA_HARDENING_DIR:-$root/build-hardening}
lmp=${EEPA_LMP:-$root/build/lmp}
input=$root/tests/fuzz/in.valgrind
export OMP_NUM_THREADS=1
mkdir -p "$work"

die() {
    echo "hardening.sh: $*" >&2
    exit 2
}
need() {
    command -v "$1" >/dev/null || die "$1 is missing: apt-get install $2"
}
need_lmp() {
    [ -x "$lmp" ] || die "$lmp does not exist: build first, or set EEPA_LMP"
}

fuzz() {
    seconds=${1:-300}
    need clang++ "clang libclang-rt-14-dev"
    cmake -S "$root" -B "$work/fuzz" -D CMAKE_CXX_COMPILER=clang++ -D EEPA_WITH_LAMMPS=OFF \
        -D EEPA_FUZZ=ON -D CMAKE_BUILD_TYPE=RelWithDebInfo >"$work/fuzz.configure.log"
    cmake --build "$work/fuzz" --target fuzz_parser fuzz_kernel fuzz_walls >"$work/fuzz.build.log" ||
        die "see $work/fuzz.build.log"
    line="fuzz:" status=0
    for name in parser kernel walls; do
        mkdir -p "$work/corpus_$name"
        log=$work/fuzz_$name.log
        "$work/fuzz/fuzz_$name" -max_total_time="$seconds" -max_len=1500 -print_final_stats=1 \
            -artifact_prefix="$work/$name-" "$work/corpus_$name" \
            "$root/tests/fuzz/corpus_$name" >"$log" 2>&1 && found=0 || found=1
        if [ $found -ne 0 ]; then
            status=1
            grep -E 'violated|runtime error|ERROR|Test unit' "$log" >&2 || tail "$log" >&2
        fi
        runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
        edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
        line="$line $name ${runs:-?} executions, ${edges:-?} edges, $found findings;"
    done
    echo "$line"
    return $status
}

sanitizers() {
    cmake -S "$root" --preset sanitize -B "$work/sanitize" >"$work/sanitize.configure.log"
    cmake --build "$work/sanitize" >"$work/sanitize.build.log" ||
        die "see $work/sanitize.build.log"
    status=0
    # the study's quick mode is hundreds of runs: what it runs is tested by the others
    ctest --test-dir "$work/sanitize" --output-on-failure -E 'python.strength_study' \
        >"$work/sanitize.log" 2>&1 || status=1
    [ $status -eq 0 ] || grep -E 'runtime error|ERROR: |Failed|Timeout' "$work/sanitize.log" >&2 || true
    reports=$(grep -cE 'runtime error:|ERROR: (Address|Leak)Sanitizer' "$work/sanitize.log" || true)
    echo "sanitizers: $reports reports; $(grep 'tests passed' "$work/sanitize.log" || echo 'no summary')"
    return $status
}

valgrind_() {
    need valgrind valgrind
    need_lmp
    supp=
    for prefix in /usr /usr/local /opt/homebrew; do
        if [ -f "$prefix/share/openmpi/openmpi-valgrind.supp" ]; then
            supp=--suppressions=$prefix/share/openmpi/openmpi-valgrind.supp
        fi
    done
    xml=$work/valgrind.xml
    rm -f "$xml"
    status=0
    # --error-exitcode would count what LAMMPS and MPI do; the frames below tell whose it is
    # shellcheck disable=SC2086  # no suppression file is no argument
    valgrind --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
        --num-callers=40 --child-silent-after-fork=yes --xml=yes --xml-file="$xml" $supp \
        "$lmp" -in "$input" -var steps 60 -log none >"$work/valgrind.log" 2>&1 || status=1
    [ $status -eq 0 ] || tail -n 5 "$work/valgrind.log" >&2
    python3 - "$xml" <<'PYTHON' || status=1
import sys
import xml.etree.ElementTree as tree
errors = tree.parse(sys.argv[1]).getroot().findall("error")
def ours(frame):
    text = " ".join(filter(None, (frame.findtext(k) for k in ("obj", "fn", "file"))))
    function = (frame.findtext("fn") or "").lower()
    return "eepaplugin" in text or "eepa" in function or "contacthistory" in function
mine = [e for e in errors if any(ours(f) for f in e.iter("frame"))]
for e in mine:
    what = e.findtext("what") or e.findtext("xwhat/text")
    print(what, "<-", [f.findtext("fn") for f in e.iter("frame")][:6], file=sys.stderr)
print(f"valgrind: {len(mine)} errors with frames of this package, {len(errors) - len(mine)} of others")
sys.exit(bool(mine))
PYTHON
    return $status
}

fpe() {
    need_lmp
    cat >"$work/fpe.c" <<'C'
#define _GNU_SOURCE
#include <fenv.h>
__attribute__((constructor)) static void trap(void)
{
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
}
C
    cc -shared -fPIC -o "$work/fpe.so" "$work/fpe.c" -lm
    passed=0 runs=0
    for rolling in none "constant 0.1" "sds 1e6 1e3 0.1"; do
        runs=$((runs + 1))
        if LD_PRELOAD=$work/fpe.so "$lmp" -in "$input" -var steps 2000 -var rolling "$rolling" \
            -log none >"$work/fpe.$runs.log" 2>&1; then
            passed=$((passed + 1))
        else
            tail -n 15 "$work/fpe.$runs.log" >&2
        fi
    done
    echo "fpe: $passed of $runs runs of 2000 steps raised no division by zero, invalid or overflow"
    [ $passed -eq $runs ]
}

differential() {
    test=$root/build/test_lammps status=0
    [ -x "$test" ] || die "$test does not exist: build first"
    for ranks in 1 2 4; do
        # shellcheck disable=SC2046  # each line is an argument
        env $(grep -v '^#' "$root/scripts/mpi.env") OMP_WAIT_POLICY=passive \
            EEPA_RANDOM_SCRIPTS="$((1000 * ranks)) ${1:-100}" mpirun -np $ranks "$test" \
            --gtest_filter='ParallelRandomScripts.*' >"$work/differential.$ranks.log" 2>&1 || status=1
        echo "$ranks ranks: $(grep 'random scripts' "$work/differential.$ranks.log" ||
            echo "see $work/differential.$ranks.log")"
    done
    return $status
}

dispatch() {
    need qemu-x86_64 qemu-user
    cmake -S "$root" --preset dispatch -B "$work/dispatch" >"$work/dispatch.configure.log" ||
        die "see $work/dispatch.configure.log"
    cmake --build "$work/dispatch" --target lmp >"$work/dispatch.build.log" ||
        die "see $work/dispatch.build.log"
    status=0
    ctest --test-dir "$work/dispatch" --verbose -R '^python.dispatch$' >"$work/dispatch.log" 2>&1 ||
        status=1
    [ $status -eq 0 ] || grep -E 'Error|FAIL' "$work/dispatch.log" >&2 || true
    echo "dispatch: $(grep -c '\.\.\. ok$' "$work/dispatch.log" || true) tests passed," \
        "$(grep -o 'skipped=[0-9]*' "$work/dispatch.log" || echo skipped=0)"
    return $status
}

mutation() {
    need clang++ clang
    need ninja ninja-build
    python3 "$root/tests/mutation/mutate.py" --work "$work/mutation" "$@"
}

intree() {
    source=${1:-${EEPA_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/eepa}/source/lammps-4Feb2025}
    tree=$work/intree/lammps
    need git git
    [ -f "$source/src/version.h" ] || die "$source is no LAMMPS source tree: give one"
    # a copy that an earlier run left clean is used again, and so is what was built of it
    if [ "$(cat "$tree/copied_from" 2>/dev/null)" != "$source" ]; then
        rm -rf "$tree"
        mkdir -p "$tree"
        (cd "$source" && tar -cf - --exclude=.git .) | tar -xf - -C "$tree"
        echo "$source" >"$tree/copied_from"
        git -C "$tree" init -q
        git -C "$tree" add -A -f
        git -C "$tree" -c user.name=eepa -c user.email=eepa@localhost commit -qm "as it was"
    fi
    "$root/scripts/install_in_lammps.sh" "$tree"
    # shellcheck disable=SC2086
    cmake -S "$root" -B "$work/intree/build" -D LAMMPS_SOURCE_DIR="$tree" -D EEPA_STYLES=in_lammps \
        -D EEPA_CACHE_DIR="$work/intree/cache" -D CMAKE_CXX_FLAGS_RELEASE= ${EEPA_INTREE_ARGS:-} >"$work/intree/configure.log" ||
        die "see $work/intree/configure.log"
    # without optimization, in two thirds of the time, because only tests are compiled here
    cmake --build "$work/intree/build" --target test_lammps >"$work/intree/build.log" || die "see $work/intree/build.log"
    status=0
    ctest --test-dir "$work/intree/build" --output-on-failure \
        -R '^(lammps|python.(contact_cycle|granular|impacts|site|steady_contacts|wear))' >"$work/intree/test.log" 2>&1 || status=1
    "$root/scripts/install_in_lammps.sh" --remove "$tree"
    left=$(git -C "$tree" status --porcelain --ignored | wc -l)
    [ "$left" -eq 0 ] || status=1
    echo "intree: $(grep 'tests passed' "$work/intree/test.log" || echo "see $work/intree/test.log");" \
        "$left files differ after removal"
    return $status
}

case ${1:-} in
differential) differential "${2:-100}" ;;
dispatch) dispatch ;;
fuzz) fuzz "${2:-300}" ;;
sanitizers) sanitizers ;;
valgrind) valgrind_ ;;
intree) intree "${2:-}" ;;
fpe) fpe ;;
mutation)
    shift
    mutation "$@"
    ;;
*)
    sed -n '3,17s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
