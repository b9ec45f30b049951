# SPDX-License-Identifier: GPL-2.0-only
"""LAMMPS_BUILD_DIR: the plugin for a LAMMPS that somebody has built, from its compile_commands.json.

The folder of the LAMMPS that this project was built with stands for that of a user's. The plugin is not compiled a
second time: what the compiler would be told is compared."""
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("EEPA_BUILD_DIR") or ROOT / "build")
LAMMPS = Path(os.environ.get("EEPA_STOCK_LMP") or "lmp").parent


def cached(name):
    """A value of this project's build, or nothing."""
    found = re.search(rf"^{name}:[^=]*=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE)
    return found.group(1) if found else ""


def commands(folder):
    """How a build compiles each source of lammps_pkg, without the names of its own folder."""
    return {entry["file"]: entry["command"].replace(str(folder), "BUILD")
            for entry in json.loads((folder / "compile_commands.json").read_text())
            if "/lammps_pkg/" in entry["file"] and "eepa_styles.dir" in entry["command"]}


@unittest.skipUnless((BUILD / "CMakeCache.txt").is_file() and (LAMMPS / "compile_commands.json").is_file(),
                     "started by hand: ctest says where the builds are")
class LammpsBuildDir(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()

    def configure(self, lammps, *more):
        """Status and output; the cache is a folder in which nothing may be made."""
        kept = {name: value for name, value in os.environ.items() if name not in ("CXXFLAGS", "LDFLAGS")}
        words = [cached("CMAKE_COMMAND") or "cmake", "-S", str(ROOT), "-B", str(self.folder / "build"), "-G",
                 cached("CMAKE_GENERATOR"), "-D", f"LAMMPS_BUILD_DIR={lammps}",
                 "-D", f"EEPA_CACHE_DIR={self.folder / 'cache'}"]
        for name in ("CMAKE_MAKE_PROGRAM", "CMAKE_CXX_COMPILER", "CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_BUILD_TYPE",
                     "EEPA_ARCH", "EEPA_WERROR", "EEPA_SANITIZE"):
            if cached(name):
                words += ["-D", f"{name}={cached(name)}"]
        done = subprocess.run([*words, *more], text=True, env=kept, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
        self.assertFalse((self.folder / "cache").exists(), done.stdout)
        return done.returncode, re.sub(r"\s+", " ", done.stdout)

    def lammps(self, definitions="-DLMP_PLUGIN", version="4 Feb 2025", flags=""):
        """A folder with what is read of a LAMMPS build."""
        source, build = self.folder / "lammps" / "src", self.folder / "lammps" / "build"
        for folder in (source, build):
            folder.mkdir(parents=True)
        (source / "version.h").write_text(f'#define LAMMPS_VERSION "{version}"\n')
        compiler = cached("CMAKE_CXX_COMPILER")
        # A line each, as CMake writes it.
        (build / "compile_commands.json").write_text(
            f'[\n{{\n  "directory": "{build}",\n  "command": "{compiler} {definitions} -I{source} {flags} -o lammps.o '
            f'-c {source}/lammps.cpp",\n  "file": "{source}/lammps.cpp"\n}}\n]\n')
        return build

    def refused(self, lammps, words, *more):
        status, out = self.configure(lammps, *more)
        self.assertNotEqual(status, 0)
        self.assertIn(words, out)

    def test_compiles_as_this_project_does(self):
        status, out = self.configure(LAMMPS, "-D", "BUILD_TESTING=OFF")
        self.assertEqual(status, 0, out)
        mine, theirs = commands(BUILD), commands(self.folder / "build")
        self.assertIn(str(ROOT / "lammps_pkg" / "pair_gran_eepa.cpp"), theirs)
        self.assertEqual(mine, theirs)

    def test_a_library_that_is_not_shared_gives_the_plugin_alone(self):
        # Open MPI's folders are not the option of OpenMP.
        status, out = self.configure(self.lammps(flags="-isystem /opt/openmpi/include -I/opt/openmp/include"))
        self.assertEqual(status, 0, out)
        self.assertIn("has no shared library with MPI: the plugin is built, and neither lmp nor the tests", out)
        text = (self.folder / "build" / "compile_commands.json").read_text()
        self.assertIn("eepaplugin.cpp", text)
        self.assertNotIn("lmp_main.cpp", text)
        self.assertNotIn("pair_gran_eepa_omp.cpp", text)  # this LAMMPS was compiled without OpenMP
        self.assertNotIn("-fopenmp", text)

    def test_refuses_by_name(self):
        empty = self.folder / "empty"
        empty.mkdir()
        self.refused(empty, f"LAMMPS_BUILD_DIR={empty} is no folder in which LAMMPS was built with CMake")
        self.refused(self.folder / "none", "there is no such folder")
        (empty / "CMakeCache.txt").touch()
        self.refused(empty, f"cmake -D CMAKE_EXPORT_COMPILE_COMMANDS=on {empty}")
        self.refused(LAMMPS, "are both given", "-D", f"LAMMPS_SOURCE_DIR={ROOT}")
        (empty / "compile_commands.json").write_text("[]\n")
        self.refused(empty, "says nothing about src/lammps.cpp", "-D", "LAMMPS_SOURCE_DIR=")

    def test_refuses_an_old_lammps(self):
        self.refused(self.lammps(version="29 Aug 2024"),
                     f"LAMMPS 29 Aug 2024 in {self.folder}/lammps is too old: 4 Feb 2025 is the oldest that will do")

    def test_refuses_a_lammps_without_plugins(self):
        self.refused(self.lammps(definitions="-DLAMMPS_SMALLBIG"), "has no PLUGIN package and can load no plugin")


if __name__ == "__main__":
    unittest.main()
