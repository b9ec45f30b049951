# SPDX-License-Identifier: GPL-2.0-only
"""cmake --install into a prefix that is then moved: what is installed runs from there. The Debian packages. And the
version, which stands in one place, and CITATION.cff."""
import ast
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import yaml

from two_particles import SETUP

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("EEPA_BUILD_DIR") or ROOT / "build")
STOCK = os.environ.get("EEPA_STOCK_LMP") or ""
VERSION = (ROOT / "VERSION").read_text().strip()

#: They part, and LAMMPS has the styles after `clear`, too.
IMPACT = SETUP + """run 8000
print "restitution $(v_e:%.3f)"
clear
atom_style sphere
pair_style gran/eepa linear
"""

CONSUMER = {
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.20)
project(consumer LANGUAGES CXX)
find_package(eepa 1.0 REQUIRED)
add_executable(consumer main.cpp)
target_link_libraries(consumer PRIVATE eepa::kernel)
file(WRITE "${CMAKE_BINARY_DIR}/version" "${eepa_VERSION}")
""",
    "main.cpp": """#include <eepa/time_step.h>
#include <cstdio>
int main() { std::printf("%.6f\\n", eepa::largest_time_step(4.0, 1.0)); }
""",
}


def cached(name):
    found = re.search(rf"^{name}:[^=]*=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE)
    return found.group(1) if found else ""


def clean_environment(**more):
    """Of a user who knows nothing of this build folder."""
    forgotten = ("BUILD_DIR", "LAMMPS_PLUGIN_PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "MAKEFLAGS", "DESTDIR")
    kept = {name: value for name, value in os.environ.items()
            if name not in forgotten and not name.startswith("EEPA_")}
    return {**kept, **more}


def call(*words, cwd=None, **environment):
    """Status and output."""
    done = subprocess.run([str(word) for word in words], text=True, cwd=cwd, env=clean_environment(**environment),
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=1000)
    return done.returncode, done.stdout


def cmake():
    return cached("CMAKE_COMMAND") or "cmake"


def links(page):
    """To files, in a page of Markdown or reStructuredText."""
    text = page.read_text(encoding="utf-8")
    if page.suffix == ".md":
        found = re.findall(r"\]\(([^)\s]+)\)", text)
    else:
        found = re.findall(r"(?:image|figure|include)::[ ]+(\S+)", text)
    return [link.split("#")[0] for link in found if not re.match(r"[a-z]+:|#|/", link)]


def broken_links(share):
    """Of all pages below share/, as `page: link`, and how many links there are."""
    pages = [path for name in ("doc/eepa", "eepa") for path in sorted((share / name).rglob("*"))
             if path.suffix in (".md", ".rst")]
    found = [(page, link) for page in pages for link in links(page)]
    return [f"{page}: {link}" for page, link in found if not (page.parent / link).exists()], len(found)


@unittest.skipUnless((BUILD / "CMakeCache.txt").is_file(), "started by hand: EEPA_BUILD_DIR names the build folder")
class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name).resolve()
        status, out = call(cmake(), "--install", BUILD, "--prefix", cls.folder / "first")
        if status != 0:
            raise AssertionError(out)
        cls.prefix = cls.folder / "moved"
        (cls.folder / "first").rename(cls.prefix)
        cls.libraries = cls.prefix / cached("CMAKE_INSTALL_LIBDIR")
        cls.plugins = cls.libraries / "lammps" / "plugins"
        cls.lmp = cls.prefix / "bin" / "lmp-eepa"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = Path(folder.name)
        (self.work / "in.impact").write_text(IMPACT)

    def assert_impact(self, result):
        status, out = result
        self.assertEqual(status, 0, out)
        self.assertIn("restitution 0.500", out)

    def needs_own_lammps(self):
        if cached("LAMMPS_BUILD_DIR") or os.environ.get("EEPA_SANITIZE"):
            self.skipTest("only for the LAMMPS that this project builds, without sanitizers")

    def test_lmp_runs_and_keeps_the_styles_after_clear(self):
        self.needs_own_lammps()
        self.assert_impact(call(self.lmp, "-in", "in.impact", cwd=self.work))

    def test_lmp_runs_on_two_ranks(self):
        self.needs_own_lammps()
        mpiexec = os.environ.get("EEPA_MPIEXEC")
        if not mpiexec:
            self.skipTest("ctest says where mpiexec is")
        self.assert_impact(call(mpiexec, "-n", 2, self.lmp, "-in", "in.impact", cwd=self.work))

    def test_lmp_takes_its_own_liblammps(self):
        self.needs_own_lammps()
        _, out = call("ldd", self.lmp)
        found = re.search(r"liblammps\S* => (\S+)", out)
        self.assertEqual(Path(found.group(1)).resolve().parent, self.libraries / "eepa", out)

    def test_lmp_says_where_the_plugin_must_be(self):
        self.needs_own_lammps()
        hidden = self.plugins / "hidden"
        (self.plugins / "eepaplugin.so").rename(hidden)
        try:
            status, out = call(self.lmp, "-in", "in.impact", cwd=self.work)
        finally:
            hidden.rename(self.plugins / "eepaplugin.so")
        self.assertNotEqual(status, 0)
        self.assertIn(f"eepaplugin.so must lie beside {self.lmp} or in {self.plugins}", out)

    def test_a_stock_lammps_finds_the_plugin(self):
        if not STOCK or os.environ.get("EEPA_SANITIZE"):
            self.skipTest("no stock LAMMPS, or a plugin that it can not load")
        self.assert_impact(call(STOCK, "-in", "in.impact", cwd=self.work, LAMMPS_PLUGIN_PATH=str(self.plugins)))

    def test_folders_for_libraries_are_relative_or_none(self):
        for file in (self.lmp, self.plugins / "eepaplugin.so", *(self.libraries / "eepa").glob("*")):
            if not file.exists():
                continue
            _, out = call("readelf", "-d", file)
            for folders in re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", out):
                for folder in folders.split(":"):
                    # Where MPI is in no folder of the loader's, its folder is named, too.
                    self.assertTrue(folder.startswith("$ORIGIN/") or "mpi" in folder.lower(),
                                    f"{file} looks in '{folder}'")
                    self.assertNotIn(str(BUILD), folder)

    def test_the_plugin_exports_its_entry_and_nothing_else(self):
        _, out = call("nm", "-D", "--defined-only", self.plugins / "eepaplugin.so")
        if os.environ.get("EEPA_SANITIZE"):
            self.skipTest("sanitizers add symbols")
        self.assertEqual([line.split()[-1] for line in out.splitlines()], ["lammpsplugin_init"])

    def test_coarsen_finds_itself_and_lmp(self):
        status, out = call(self.prefix / "bin" / "coarsen", "--version", cwd=self.work)
        self.assertEqual((status, out), (0, f"coarsen of eepa {VERSION}\n"))
        self.needs_own_lammps()
        plan = ("plan", "--diameter", "50e-6", "--density", "2700", "--k1", "150", "--k2", "450", "--kadh", "300",
                "--f0", "-7.5e-7", "--width", "30e-3", "--stress", "5e3", "80e3", "--rate", "0.1", "--want",
                "strain=10", "--diameters", "1e-3")
        # A run of seconds, by the lmp-eepa beside it, measures the speed.
        status, out = call(self.prefix / "bin" / "coarsen", *plan, cwd=self.work)
        self.assertEqual(status, 0, out)
        self.assertIn("Cheapest that may be used: 1 mm", out)
        self.lmp.rename(self.prefix / "bin" / "hidden")
        try:
            status, out = call(self.prefix / "bin" / "coarsen", *plan, cwd=self.work, PATH="/usr/bin:/bin")
        finally:
            (self.prefix / "bin" / "hidden").rename(self.lmp)
        self.assertEqual(status, 1, out)
        self.assertIn(f"no LAMMPS at {self.lmp} or lmp-eepa or lmp", out)
        # Nothing is written into an installation.
        self.assertEqual(list((self.prefix / "share").rglob("__pycache__")), [])

    def test_coarsen_has_what_it_reads(self):
        data = self.prefix / "share" / "eepa"
        for source in (ROOT / "coarsen" / "coarsen").iterdir():
            if source.name != "__pycache__":
                self.assertEqual((data / "coarsen" / "coarsen" / source.name).read_bytes(), source.read_bytes())
        for name in ("coarsen/README.md", "scripts/mpi.env", "examples/scale_collapse/in.confined"):
            self.assertTrue((data / name).is_file(), name)

    def test_an_example_runs_from_its_place(self):
        self.needs_own_lammps()
        infile = self.prefix / "share" / "eepa" / "examples" / "contact_cycle" / "in.contact_cycle"
        status, out = call(self.lmp, "-in", infile, cwd=self.work)
        self.assertEqual(status, 0, out)
        self.assertTrue((self.work / "cycle_linear.csv").is_file())

    def test_scripts_of_examples_take_its_lmp_and_write_into_the_present_folder(self):
        self.needs_own_lammps()
        self.assertTrue(os.access(self.prefix / "share/eepa/examples/silo/run.py", os.X_OK))
        status, out = call(sys.executable, "-B", "-c",
                           "from machines import running\n"
                           "print(running.launcher(running.parser('', 'silo').parse_args([])))",
                           cwd=self.work, PYTHONPATH=self.prefix / "share" / "eepa" / "examples")
        self.assertEqual(status, 0, out)
        self.assertIn(repr(self.lmp), out)
        self.assertIn(repr(self.work.resolve() / "silo"), out)

    def test_documentation_is_complete(self):
        folder = self.prefix / "share" / "doc" / "eepa"
        for source in (ROOT / "lammps_pkg" / "doc").glob("*.rst"):
            self.assertTrue((folder / "lammps_pkg" / "doc" / source.name).is_file(), source.name)
        for name in ("LICENSE", "CHANGELOG.md", "CITATION.cff", "README.md", "docs/installing.md"):
            self.assertTrue((folder / name).is_file(), name)

    def test_links_between_pages_lead_to_what_is_installed(self):
        broken, count = broken_links(self.prefix / "share")
        self.assertEqual(broken, [])
        self.assertGreater(count, 100)

    def test_programs_have_pages_of_the_manual(self):
        pages = {page.stem for page in (self.prefix / "share" / "man" / "man1").iterdir()}
        self.assertEqual(pages, {program.name for program in (self.prefix / "bin").iterdir()})

    def test_the_page_of_coarsen_has_its_commands(self):
        _, out = call(self.prefix / "bin" / "coarsen", "--help")
        commands = re.findall(r"^    (\w+)(?: |$)", out, re.MULTILINE)
        self.assertIn("plan", commands)
        page = (self.prefix / "share" / "man" / "man1" / "coarsen.1").read_text()
        self.assertEqual(re.findall(r"^\.TP\n\.B (\w+)$", page.split(".SH EXIT")[0], re.MULTILINE), commands)

    def test_coarsen_without_libraries_says_what_to_install(self):
        status, out = call(self.prefix / "bin" / "coarsen", "plan", cwd=self.work, PYTHON="/bin/false")
        self.assertEqual(status, 1)
        self.assertRegex(out, "on Debian install eepa-coarsen, .* apt-get install python3-pandas")

    def test_a_component_is_installed_alone(self):
        status, out = call(cmake(), "--install", BUILD, "--prefix", self.work / "alone", "--component", "plugin")
        self.assertEqual(status, 0, out)
        files = [path for path in (self.work / "alone").rglob("*") if path.is_file()]
        self.assertEqual([path.name for path in files], ["eepaplugin.so"])

    def test_find_package_gives_the_kernel(self):
        for name, text in CONSUMER.items():
            (self.work / name).write_text(text)
        out = ""
        for words in ((cmake(), "-S", ".", "-B", "b", "-G", cached("CMAKE_GENERATOR"), "-D",
                       f"CMAKE_PREFIX_PATH={self.prefix}", "-D", f"CMAKE_CXX_COMPILER={cached('CMAKE_CXX_COMPILER')}"),
                      (cmake(), "--build", "b"), ("b/consumer",)):
            status, out = call(*words, cwd=self.work)
            self.assertEqual(status, 0, out)
        self.assertEqual(out, "0.400000\n")
        self.assertEqual((self.work / "b" / "version").read_text(), VERSION)
        # It is found in the prefix and not in this source tree.
        self.assertNotIn(str(ROOT), (self.work / "b" / "CMakeCache.txt").read_text())


@unittest.skipUnless((BUILD / "CPackConfig.cmake").is_file() and all(map(shutil.which, ("dpkg-shlibdeps", "file"))),
                     "no build folder with CPackConfig.cmake, or no dpkg-shlibdeps or file")
class DebianPackages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if cached("LAMMPS_BUILD_DIR") or os.environ.get("EEPA_SANITIZE"):
            raise unittest.SkipTest("only for the LAMMPS that this project builds, without sanitizers")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        folder = Path(folder.name).resolve()
        status, out = call(Path(cmake()).with_name("cpack"), "--config", BUILD / "CPackConfig.cmake", "-B", folder,
                           "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", "-D", "CPACK_PACKAGE_CONTACT=Me <me@here.org>")
        if status != 0:
            raise AssertionError(out)
        cls.fields = {}
        for package in folder.glob("*.deb"):
            _, out = call("dpkg-deb", "--field", package)
            fields = dict(line.split(": ", 1) for line in out.splitlines() if re.match(r"[\w-]+: ", line))
            cls.fields[fields["Package"]] = fields
            call("dpkg-deb", "--extract", package, folder / "root")
        cls.share = folder / "root" / "usr" / "share"

    def needed(self, package):
        return {word.split()[0] for word in self.fields[package]["Depends"].split(",")}

    def test_eepa_comes_without_what_only_coarsen_needs(self):
        self.assertEqual(set(self.fields), {"eepa", "eepa-coarsen"})
        needed = self.needed("eepa")
        self.assertLessEqual({"openmpi-bin", "python3", "python3-numpy", "libc6", "libstdc++6"}, needed)
        self.assertEqual([name for name in needed if name.startswith("python3-")], ["python3-numpy"])
        self.assertNotIn("Recommends", self.fields["eepa"])    # apt installs these, too

    def test_eepa_coarsen_brings_what_coarsen_imports(self):
        modules = set()
        for source in [*(ROOT / "coarsen" / "coarsen").glob("*.py"), ROOT / "coarsen" / "coarsen" / "Snakefile"]:
            for line in source.read_text().splitlines():
                if re.match(r" *(import|from) \w+(\.\w+)*( |$)", line):
                    found = ast.parse(line.strip()).body[0]
                    names = [name.name for name in found.names] if isinstance(found, ast.Import) else [found.module]
                    modules |= {name.split(".")[0] for name in names}
        modules -= {*sys.stdlib_module_names, "coarsen"}
        self.assertLessEqual({"pandas", "statsmodels"}, modules)
        needed = self.needed("eepa-coarsen")
        self.assertLessEqual({f"python3-{module}" for module in modules}, needed)
        self.assertLessEqual({"snakemake", "eepa"}, needed)
        self.assertIn(f"eepa (= {self.fields['eepa']['Version']})", self.fields["eepa-coarsen"]["Depends"])

    def test_the_version_names_the_release_of_debian(self):
        release = Path("/etc/os-release").read_text()
        if not re.search("^ID=debian$", release, re.MULTILINE):
            self.skipTest("this is no Debian")
        name = re.search(r'^VERSION_(?:ID|CODENAME)="?([^"\n]+)', release, re.MULTILINE).group(1)
        self.assertEqual(self.fields["eepa"]["Version"], f"{VERSION}-1~deb{name}")

    def test_changelogs_can_be_read_by_debian(self):
        for package in self.fields:
            status, out = call("dpkg-parsechangelog", "-l", self.share / "doc" / package / "changelog.Debian.gz")
            self.assertEqual(status, 0, out)
            self.assertNotIn("warning", out)
            self.assertIn(f"\nVersion: {self.fields[package]['Version']}\n", out)
            self.assertIn("\nMaintainer: Me <me@here.org>\n", out)

    def test_links_between_pages_lead_to_what_is_installed(self):
        broken, count = broken_links(self.share)
        # The licence is a file of every Debian.
        self.assertEqual([link for link in broken if not link.endswith("/doc/eepa/README.md: LICENSE")], [])
        self.assertGreater(count, 100)
        self.assertEqual(os.readlink(self.share / "doc" / "eepa" / "LICENSE"), "../../common-licenses/GPL-2")

    def test_scripts_start_the_python_of_the_system(self):
        scripts = [path for path in self.share.rglob("*.py") if os.access(path, os.X_OK)]
        self.assertGreater(len(scripts), 10)
        for script in scripts:
            self.assertEqual(script.read_text().splitlines()[0], "#!/usr/bin/python3", script)

    def test_pages_of_the_manual_are_compressed(self):
        self.assertEqual(sorted(page.name for page in (self.share / "man" / "man1").iterdir()),
                         ["coarsen.1.gz", "lmp-eepa.1.gz"])

    def test_libraries_are_stripped(self):
        libraries = list(self.share.parent.glob("lib/**/*.so*"))
        self.assertEqual({library.name for library in libraries}, {"liblammps.so.0", "eepaplugin.so"})
        for library in libraries:
            _, out = call("readelf", "-S", library)
            self.assertNotIn(".symtab", out)


@unittest.skipUnless((BUILD / "CMakeCache.txt").is_file(), "started by hand: EEPA_BUILD_DIR names the build folder")
class Warnings(unittest.TestCase):
    def test_are_errors_where_ci_is_set_and_where_it_is_asked_for(self):
        for ci, words, expected in (("", (), "OFF"), ("false", (), "OFF"), ("true", (), "ON"),
                                    ("", ("-D", "EEPA_WERROR=ON"), "ON")):
            with self.subTest(CI=ci, words=words), tempfile.TemporaryDirectory() as folder:
                status, out = call(cmake(), "-S", ROOT, "-B", folder, "-G", cached("CMAKE_GENERATOR"), "-D",
                                   "EEPA_WITH_LAMMPS=OFF", "-D", "BUILD_TESTING=OFF", *words, CI=ci)
                self.assertEqual(status, 0, out)
                self.assertIn(f"EEPA_WERROR:BOOL={expected}\n", (Path(folder) / "CMakeCache.txt").read_text())
                commands = (Path(folder) / "compile_commands.json").read_text()
                self.assertEqual("-Werror" in commands, expected == "ON")


class Version(unittest.TestCase):
    def test_stands_in_one_place(self):
        self.assertRegex(VERSION, r"^\d+\.\d+\.\d+$")
        changelog = re.findall(r"^## \[(\d\S*)\] - \d{4}-\d\d-\d\d$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
        self.assertEqual(changelog[0], VERSION)
        self.assertEqual(self.citation()["version"], VERSION)

    @staticmethod
    def citation():
        return yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))

    def test_citation_has_what_its_format_asks_for(self):
        # https://github.com/citation-file-format/citation-file-format/blob/main/schema-guide.md
        citation = self.citation()
        self.assertEqual(citation["cff-version"], "1.2.0")
        for key in ("message", "title", "authors"):
            self.assertTrue(citation[key], key)
        self.assertEqual(citation["type"], "software")
        self.assertEqual([author["name"] for author in citation["authors"]], ["the eepa developers"])
        for reference in citation["references"]:
            for key in ("type", "title", "authors"):
                self.assertTrue(reference[key], key)
            self.assertTrue(all(set(author) == {"family-names", "given-names"} for author in reference["authors"]))

    def test_citation_has_the_articles_that_lammps_prints(self):
        printed = " ".join((ROOT / "lammps_pkg" / "citations.cpp").read_text(encoding="utf-8")
                           .replace('"', "").replace("\\n", "").split())
        references = self.citation()["references"]
        self.assertEqual(printed.count("title = "), len(references))
        for reference in references:
            self.assertIn("title = {" + reference["title"] + "}", printed)
            authors = " and ".join(f"{author['given-names']} {author['family-names']}"
                                   for author in reference["authors"])
            self.assertIn("author = {" + authors + "}", printed)
            self.assertIn(f"year = {reference['year']}", printed)
            if "start" in reference:
                self.assertIn(f"journal = {{{reference['journal']}}}, year = {reference['year']}, "
                              f"volume = {reference['volume']}, pages = {{{reference['start']}}}", printed)


if __name__ == "__main__":
    unittest.main()
