#!/usr/bin/env python3
"""Break a copy of the kernel in every small way that a parser finds, and see whether tests notice.

    tests/mutation/mutate.py [--commands] [--file WORD] [--match WORD] [--sample N [--seed S]]
                             [--list] [--jobs N] [--baseline]

clang's syntax tree gives the places: operators, comparisons, conditions, constants, arguments of
calls, statements. One program has all of these mutants, and an environment variable says which one
lives. The tests that reach it are run until one fails: it is killed. What survives must stand in
survivors.txt, with the reason why no test can or need notice it.

Exit status: 0 when all mutants are killed or explained, 1 when one is not, or when survivors.txt
names one that is killed or does not exist, 2 when the untouched project fails.
"""

import argparse
import glob
import os
import random
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import bench
import clang_tree
from find_mutants import Finder, name_all
from schemata import number_all

# Headers, sources and the programs of tests, test_NAME of the folder tests/NAME, in this order.
KERNEL = ("kernel/eepa/*.h", None, ("test_kernel",))
COMMANDS = ("commands/eepa_commands/*.h", "commands/eepa_commands/*.cpp",
            ("test_kernel", "test_parser"))
INCLUDES = ("kernel", "commands")
NAMESPACE = "eepa"


def arguments():
    root = os.path.dirname(os.path.dirname(HERE))
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--commands", dest="what", action="store_const", const=COMMANDS,
                        default=KERNEL, help="mutants of the commands, not of the kernel")
    parser.add_argument("--file", default="", help="files whose name has this in it")
    parser.add_argument("--match", default="", help="mutants whose key has this in it")
    parser.add_argument("--sample", type=int, help="so many of these, chosen at random")
    parser.add_argument("--seed", type=int, default=1, help="of the sample (1)")
    parser.add_argument("--list", action="store_true", help="the mutants' keys, and run nothing")
    parser.add_argument("--jobs", type=int, default=1, help="compilers at a time (1)")
    parser.add_argument("--baseline", action="store_true",
                        help="compile for any processor, without AVX")
    parser.add_argument("--verbose", action="store_true", help="say what kills each mutant")
    parser.add_argument("--root", default=root, help="the project (this one)")
    parser.add_argument("--survivors", help="file of those that are explained")
    parser.add_argument("--work", help="working folder (build-hardening/mutation)")
    return parser.parse_args()


def architecture(baseline):
    """Flags for the processor that the project is built for, see EEPA_ARCH."""
    with open("/proc/cpuinfo") as cpu:
        can = " avx2 " in cpu.read()
    return ["-march=x86-64-v3"] if can and not baseline else []


def eigen():
    done = subprocess.run(["pkg-config", "--cflags-only-I", "eigen3"], capture_output=True,
                          text=True)
    paths = [flag[2:] for flag in done.stdout.split()] or ["/usr/include/eigen3"]
    return [part for path in paths for part in ("-isystem", path)]


def find(options):
    """Sources, sites and softened constants of the project."""
    root = os.path.realpath(options.root)

    def files(pattern):
        return sorted(glob.glob(os.path.join(root, pattern))) if pattern else []

    headers, others, _ = options.what
    units = [files(headers), *([source] for source in files(others))]
    sources = {path: bench.read(path) for unit in units for path in unit}
    flags = ["-std=c++17", "-DEEPA_PLAIN_INLINE", *architecture(options.baseline), *eigen(),
             *("-I" + os.path.join(root, folder) for folder in INCLUDES)]
    finder = Finder(sources)
    for unit in units:
        for tree in clang_tree.parse(os.environ.get("EEPA_CLANG", "clang++"), flags, unit,
                                     NAMESPACE):
            finder.visit(tree)
    sites = finder.sites
    name_all(sites)
    return sources, sites, finder.softened


def explained(path):
    """{key: reason} of survivors.txt: a reason in comments, then the keys that it is for."""
    reasons, reason, fresh = {}, [], True
    for line in bench.read(path).splitlines() if os.path.exists(path) else ():
        if line.startswith("#"):
            reason = reason + [line[1:].strip()] if not fresh else [line[1:].strip()]
            fresh = False
        elif line.strip():
            reasons[line.strip()] = " ".join(reason)
            fresh = True
        else:
            reason, fresh = [], True
    return reasons


def choose(options, sites):
    mutants = [m for site in sites for m in site.mutants
               if options.file in os.path.basename(site.path) and options.match in m.key]
    if options.sample is not None and options.sample < len(mutants):
        chosen = set(random.Random(options.seed).sample(range(len(mutants)), options.sample))
        mutants = [m for k, m in enumerate(mutants) if k in chosen]
    return mutants


def describe(mutant):
    site = mutant.site
    original, text = (" ".join(t.split()) for t in (site.original(), mutant.text))
    return (f"{mutant.key}\n    {os.path.basename(site.path)}:{site.line()}: "
            f"{original[:90]}  ->  {text[:90] or '(nothing)'}")


def judge_all(chosen, tools, reasons, verbose):
    """{status: mutants}; those that survive and are explained are 'explained'."""
    result = {}
    for mutant in chosen:
        verdict = tools.judge(mutant)
        status = verdict.status
        if status in ("survived", "unreached") and mutant.key in reasons:
            status = "explained"
        elif status == "killed" and mutant.key in reasons:
            print(f"killed by {verdict.by}, but in the list of survivors: {mutant.key}")
            status = "stale"
        elif status in ("survived", "unreached"):
            print(f"{status}: {describe(mutant)}", flush=True)
        if verbose:
            print(f"{verdict.status} {verdict.by}: {mutant.key}", flush=True)
        result.setdefault(status, []).append(mutant)
    return result


def main():
    options = arguments()
    work = os.path.join(
        os.path.abspath(options.work or os.path.join(options.root, "build-hardening/mutation")),
        ("commands" if options.what is COMMANDS else "kernel") + "_baseline" * options.baseline)
    start = time.time()
    try:
        sources, sites, softened = find(options)
    except clang_tree.ParseError as error:
        print(f"mutate: clang does not take the sources:\n{error}", file=sys.stderr)
        return 2
    chosen = choose(options, sites)
    if options.list:
        print("\n".join(describe(m) for m in chosen))
        print(f"{len(chosen)} mutants in {len(sites)} places")
        return 0
    name = "survivors" + "_commands" * (options.what is COMMANDS) + "_baseline" * options.baseline
    reasons = explained(options.survivors or os.path.join(HERE, name + ".txt"))
    every = {m.key for site in sites for m in site.mutants}
    missing = [key for key in reasons if key not in every]
    for key in missing:
        print(f"in the list of survivors, but no such mutant: {key}")
    os.makedirs(work, exist_ok=True)
    memory = bench.Memory(os.path.join(work, "memory.json"))
    cmake = ["-D", "EEPA_ARCH=baseline"] if options.baseline else []
    tools = bench.Bench(os.path.realpath(options.root), work, options.what[2], cmake, options.jobs,
                        memory)
    try:
        tools.build(sources, sites, softened, number_all, print)
        tests, seconds = tools.survey()
    except bench.BenchError as error:
        print(f"mutate: {error}", file=sys.stderr)
        return 2
    print(f"{len(every)} mutants in {len(sites)} places, {tests} tests of {seconds:.1f} s, "
          f"built in {time.time() - start:.0f} s", flush=True)
    begun = time.time()
    chosen.sort(key=lambda m: m.site.frozen)    # what takes longest comes last
    try:
        result = judge_all(chosen, tools, reasons, options.verbose)
    finally:
        memory.save()
    count = {status: len(found) for status, found in result.items()}
    bad = sum(count.get(s, 0) for s in ("survived", "unreached", "stale")) + len(missing)
    print(f"{len(chosen)} mutants: {count.get('killed', 0)} killed, "
          f"{count.get('stillborn', 0)} do not compile, {count.get('explained', 0)} explained, "
          f"{count.get('survived', 0)} survived, {count.get('unreached', 0)} not reached, "
          f"{count.get('stale', 0) + len(missing)} wrongly listed; "
          f"{time.time() - begun:.0f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
