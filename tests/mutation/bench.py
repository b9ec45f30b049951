"""Builds and runs the tests with mutants.

Two copies of the project are kept in the working folder: one with all mutants that can be chosen
when the program runs, and a plain one for those that have to be compiled one by one.
"""

import filecmp
import json
import os
import re
import resource
import shutil
import subprocess
import time

from schemata import Schemata, with_one

HERE = os.path.dirname(os.path.abspath(__file__))
# what configuring the project reads
COPIED = ("CMakeLists.txt", "VERSION", "LICENSE", "cmake", "kernel", "commands", "walls", "lammps_pkg", "scripts",
          "tests", "benchmarks", "coarsen")
FLAGS = ("-w -DEEPA_PLAIN_INLINE"
         # what a dropped assignment leaves behind is the same garbage every time; left undefined,
         # the compiler may take for granted that the statement was not dropped
         " -ftrivial-auto-var-init=pattern"
         # likewise the end of a function that has to return something
         " -fsanitize=return -fsanitize-undefined-trap-on-error")
UNCHANGED = ("gtest/gtest.h", "Eigen/Core", "Eigen/Geometry", "experimental/simd", "immintrin.h",
             "random", "fstream", "sstream", "map")
PASSED = re.compile(r"^\[       OK \] (\S+?),? .*?\((\d+) ms\)$", re.M)
FAILED = re.compile(r"^\[ RUN      \] (\S+)$", re.M)


class BenchError(Exception):
    """The untouched project does not build or does not pass its tests."""


def write(path, text):
    """Writes a file where it has changed, so that no more is compiled than must be."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    try:
        with open(path) as old:
            if old.read() == text:
                return
    except FileNotFoundError:
        pass
    with open(path, "w") as out:
        out.write(text)


def copy_project(root, to, but=()):
    """Copies what the tests are built from, where it has changed, and not the files in `but`."""
    for name in COPIED:
        top = os.path.join(root, name)
        folders = os.walk(top) if os.path.isdir(top) else [(root, [], [name])]
        for folder, _, files in folders if os.path.exists(top) else ():
            for source in (os.path.join(folder, file) for file in files):
                copy = os.path.join(to, os.path.relpath(source, root))
                if source in but or os.path.exists(copy) and filecmp.cmp(source, copy, False):
                    continue
                os.makedirs(os.path.dirname(copy), exist_ok=True)
                shutil.copy(source, copy)
        for folder, _, files in os.walk(os.path.join(to, name)):
            for copy in (os.path.join(folder, file) for file in files if file[-2:] != ".o"):
                if not os.path.exists(os.path.join(root, os.path.relpath(copy, to))):
                    os.remove(copy)    # has gone


class Verdict:
    """What became of a mutant: killed, survived, unreached or stillborn (does not compile)."""

    def __init__(self, status, by=""):
        self.status, self.by = status, by


class Memory:
    """What is worth knowing next time: which test killed a mutant, what does not compile."""

    def __init__(self, path):
        self.path = path
        content = json.loads(read(path)) if os.path.exists(path) else {}
        self.killers = content.get("killers", {})
        self.refused = set(content.get("refused", ()))

    def save(self):
        write(self.path, json.dumps({"killers": self.killers, "refused": sorted(self.refused)},
                                    indent=0, sort_keys=True))


class Bench:
    """root: the project; work: the working folder; programs: targets of its tests."""

    def __init__(self, root, work, programs, options, jobs, memory):
        self.root, self.work, self.programs = root, work, programs
        self.options, self.jobs, self.memory = list(options), jobs, memory
        self.reaching = {}    # number of a site's first mutant: tests, the fastest first
        self.schemata = {}

    # the program with all mutants

    def build(self, sources, sites, softened, number_all, say):
        """Builds it. A site that does not compile as a choice becomes frozen."""
        tree = os.path.join(self.work, "all")
        copy_project(self.root, tree, but=sources)
        write(os.path.join(tree, "mutant.h"), read(os.path.join(HERE, "mutant.h")))
        head = f'#include "{tree}/mutant.h"\n'
        for site in sites:
            site.frozen = site.frozen or site.mutants[0].key in self.memory.refused
        for attempt in range(10):
            number_all(sites)
            self.schemata = {}
            for path, text in sources.items():
                copy = os.path.join(tree, os.path.relpath(path, self.root))
                self.schemata[copy] = Schemata(path, text, sites, softened, head)
                write(copy, self.schemata[copy].text)
            if attempt == 0:
                self._configure(tree, "-O1 " + FLAGS, "-D",
                                "CMAKE_PROJECT_INCLUDE=" + os.path.join(HERE, "together.cmake"))
            done = run(["cmake", "--build", os.path.join(tree, "build"), "--parallel",
                        str(self.jobs), "--target", *self.programs, "--", "-k", "0"])
            if done.returncode == 0:
                return
            refused = self._refused(done.stdout)
            if not refused:
                break
            say(f"{len(refused)} sites can not be chosen at run time: compiled one by one")
            for site in refused:
                site.frozen = True
                self.memory.refused.add(site.mutants[0].key)
            self.memory.save()
        raise BenchError("the program with all mutants does not build:\n" + done.stdout[-4000:])

    def _configure(self, tree, flags, *more):
        done = run(["cmake", "-S", tree, "-B", os.path.join(tree, "build"), "-G", "Ninja",
                    "-D", "EEPA_WITH_LAMMPS=OFF", "-D", "EEPA_WERROR=OFF",
                    "-D", "CMAKE_BUILD_TYPE=None", "-D", "CMAKE_CXX_FLAGS=" + flags,
                    "-D", "CMAKE_EXPORT_COMPILE_COMMANDS=ON", *more, *self.options])
        if done.returncode:
            raise BenchError("cmake:\n" + done.stdout[-4000:])

    def _refused(self, text):
        """The sites that a compiler's messages are about."""
        for pattern in (r"^(/[^:\n]+):(\d+):(\d+): (?:fatal )?error:",
                        r"^(/[^:\n]+):(\d+):(\d+): "):
            found = set()
            for path, line, column in re.findall(pattern, text, re.M):
                schema = self.schemata.get(path)
                site = schema and schema.site_at(int(line), int(column))
                if site:
                    found.add(site)
            if found:
                return found
        return set()

    def survey(self):
        """Runs the tests without a mutant: they must pass; notes which reach what, and how fast."""
        durations, reached = {}, {}
        record = os.path.join(self.work, "reached")
        for program in self.programs:
            done = self._run(program, "*", None, 600)
            if done.returncode:
                raise BenchError(f"{program} fails without a mutant:\n" + done.stdout[-4000:])
            for test, spent in PASSED.findall(done.stdout):
                if os.path.exists(record):
                    os.remove(record)
                start = time.time()
                self._run(program, test, None, 600, {"EEPA_MUTANTS_REACHED": record})
                durations[program, test] = max(time.time() - start, int(spent) / 1000)
                for number in read(record).split() if os.path.exists(record) else ():
                    reached.setdefault(int(number), []).append((program, test))
        self.durations = durations
        self.reaching = {number: sorted(tests, key=durations.get)
                         for number, tests in reached.items()}
        return len(durations), sum(durations.values())

    def _run(self, program, tests, mutant, limit, environment=()):
        command = [os.path.join(self.work, "all/build", program), "--gtest_filter=" + tests,
                   "--gtest_color=no"]
        if mutant:
            command.append("--gtest_break_on_failure")
        return run(command, timeout=limit, env={
            **os.environ, "EEPA_SOURCE_DIR": self.root,
            **({"EEPA_MUTANT": str(mutant)} if mutant else {}), **dict(environment)})

    def judge(self, mutant):
        if mutant.site.frozen:
            return self._judge_frozen(mutant)
        tests = self.reaching.get(mutant.site.mutants[0].number, [])
        if not tests:
            return Verdict("unreached")
        last = self.memory.killers.get(mutant.key)
        first = [t for t in tests if t[1] == last]
        quick = [t for t in tests if self.durations[t] < 0.05 and t not in first]
        slow = [t for t in tests if t not in first and t not in quick]
        for group in (first, quick, slow):
            for program in self.programs:
                own = [test for p, test in group if p == program]
                if not own:
                    continue
                spent = sum(self.durations[program, test] for test in own)
                done = self._run(program, ":".join(own), mutant.number, 5 + 10 * spent)
                if done.returncode:
                    return self._killed(mutant, done.stdout)
        return Verdict("survived")

    def _killed(self, mutant, output):
        tests = FAILED.findall(output)
        by = tests[-1] if tests else "start"
        self.memory.killers[mutant.key] = by
        return Verdict("killed", by)

    # one mutant compiled by itself

    def _judge_frozen(self, mutant):
        tree = os.path.join(self.work, "one")
        if not hasattr(self, "commands"):
            copy_project(self.root, tree)
            self._configure(tree, "-O1 " + FLAGS)
            self.commands = {}
            for entry in json.loads(read(os.path.join(tree, "build/compile_commands.json"))):
                self.commands[entry["file"]] = entry["command"]
            self._parse_once(tree)
            # the commands do not read what a frozen mutant of the kernel is in
            self.command_objects = [file + ".o" for file in self.commands
                                    if os.path.relpath(file, tree).startswith("commands")
                                    and self._object(file, tree)]
        path = os.path.join(tree, os.path.relpath(mutant.site.path, self.root))
        write(path, with_one(mutant.site.source, mutant))
        try:
            return self._judge_alone(mutant, tree)
        finally:
            write(path, mutant.site.source)

    def _parse_once(self, tree):
        """Has the compiler read once what no mutant is in, and all tests include."""
        header = os.path.join(tree, "unchanged.h")
        write(header, "".join(
            f"#if __has_include(<{name}>)\n#include <{name}>\n#endif\n" for name in UNCHANGED))
        tests = [f for f in self.commands if f.startswith(os.path.join(tree, "tests"))]
        command = self._compile(tests[0]) if tests else []
        if command:
            at = command.index("-c")
            run([*command[:at], "-x", "c++-header", header, "-o", header + ".gch"], cwd=tree)

    def _judge_alone(self, mutant, tree):
        """Compiles the tests file by file, the most promising first, until one of them fails."""
        last = self.memory.killers.get(mutant.key, "")
        in_library = os.path.relpath(mutant.site.path, self.root).startswith("commands")
        library = [f for f in self.commands if os.path.relpath(f, tree).startswith("commands")]
        for program in self.programs:
            folder = os.path.join(tree, "tests", program.replace("test_", "", 1))
            files = [f for f in self.commands if f.startswith(folder + os.sep)]
            with_tests = {f for f in files if re.search(r"^(TYPED_)?TEST", read(f), re.M)}
            support = [f for f in files if f not in with_tests] + library * in_library
            if not all(self._object(file, tree) for file in support):
                return Verdict("stillborn")
            objects = [file + ".o" for file in support] + self.command_objects * (not in_library)
            for file in sorted(with_tests, key=lambda f: _promise(f, last, mutant.function)):
                alone = os.path.join(tree, "alone")
                if not self._object(file, tree) or run(
                        [self._compile(file)[0], file + ".o", *objects, "-o", alone,
                         "-lgtest_main", "-lgtest", "-pthread"]).returncode:
                    return Verdict("stillborn")
                done = run([alone, "--gtest_break_on_failure", "--gtest_color=no"], timeout=900,
                           env={**os.environ, "EEPA_SOURCE_DIR": self.root})
                if done.returncode:
                    return self._killed(mutant, done.stdout)
        return Verdict("survived")

    def _object(self, file, tree):
        """Compiles a file; says whether it could."""
        return run([*self._compile(file), "-include", os.path.join(tree, "unchanged.h"),
                    "-o", file + ".o"], cwd=tree).returncode == 0

    def _compile(self, file):
        command = self.commands[file].split()
        at = command.index("-o")
        return command[:at] + command[at + 2:]


def _promise(file, last, function):
    """Sorts files: with the test that killed last time, that name what is broken, short ones."""
    text = read(file)
    suite = max(last.split(".")[0].split("/"), key=len)    # Laws/SideBySide, HistoryRows/0
    named = sum(bool(re.search(rf"\b{word}\b", text)) for word in function.split("::"))
    return not (suite and re.search(rf"\b{re.escape(suite)}\b", text)), -named, len(text)


def read(path):
    with open(path) as source:
        return source.read()


def _limits():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))


def run(command, timeout=None, **keywords):
    """Runs a command; one that does not end in time counts as failed."""
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", timeout=timeout, stdin=subprocess.DEVNULL,
                              preexec_fn=_limits if timeout else None, **keywords)
    except subprocess.TimeoutExpired as late:
        output = (late.stdout or b"").decode(errors="replace")
        return subprocess.CompletedProcess(command, 124, output)
