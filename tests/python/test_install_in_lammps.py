# SPDX-License-Identifier: GPL-2.0-only
"""scripts/install_in_lammps.sh, in a tree of those files of LAMMPS that it reads. No LAMMPS is built: see
tests/hardening.sh intree."""

import os
import re
import shutil
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

if os.environ.get("EEPA_STYLES") == "in_lammps":
    raise unittest.SkipTest("the package is in the LAMMPS of this build")
ROOT = Path(os.environ["EEPA_SOURCE_DIR"])
LAMMPS = Path(os.environ["EEPA_LAMMPS_SOURCE"])
SCRIPT = "scripts/install_in_lammps.sh"

# The lists of LAMMPS's documentation as in its repository: Debian's source package does not have them.
DOC = {
    "Commands_pair": "   * :doc:`gayberne (gio) <pair_gayberne>`\n   * :doc:`gran/hertz/history (o) <pair_gran>`\n",
    "Commands_fix": "   * :doc:`wall/gran (k) <fix_wall_gran>`\n   * :doc:`wall/gran/region <fix_wall_gran_region>`\n",
    "Commands_compute": "   * :doc:`global/atom <compute_global_atom>`\n   * :doc:`group/group <compute_group_group>`\n",
    "pair_style": "* :doc:`granular <pair_granular>` - g\n* :doc:`gran/hertz/history <pair_gran>` - h\n",
    "fix": "* :doc:`wall/gran <fix_wall_gran>` - w\n* :doc:`wall/gran/region <fix_wall_gran_region>` -\n",
    "compute": "* :doc:`global/atom <compute_global_atom>` -\n* :doc:`group/group <compute_group_group>` - g\n",
}


def contents(tree):
    """Every file and folder with its permissions and bytes."""
    found = {}
    for path in sorted(tree.rglob("*")):
        mode = stat.S_IMODE(path.lstat().st_mode)
        found[str(path.relative_to(tree))] = (mode, path.read_bytes() if path.is_file() else None)
    return found


class InTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.tree = self.folder / "lammps tree"
        for name in ("cmake/CMakeLists.txt", "cmake/Modules/Packages/OPENMP.cmake", "src/version.h",
                     "src/fix_neigh_history.h", "src/GRANULAR/granular_model.h", "src/OPENMP/thr_omp.h"):
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(LAMMPS / name, self.tree / name)
        (self.tree / "lib").mkdir()
        self.before = contents(self.tree)

    def script(self, *arguments, root=ROOT, **environment):
        return subprocess.run([root / SCRIPT, *arguments], text=True, capture_output=True,
                              env={**os.environ, **environment})

    def install(self, **options):
        run = self.script(self.tree, **options)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def remove(self, **options):
        run = self.script("--remove", self.tree, **options)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(contents(self.tree), self.before)

    def refused(self, words, *arguments):
        before = contents(self.tree)
        run = self.script(*arguments, self.tree)
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertRegex(run.stderr, words)
        self.assertEqual(contents(self.tree), before)

    def add_documentation(self):
        for name, text in DOC.items():
            path = self.tree / f"doc/src/{name}.rst"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("A list\n\n" + text + "\nMore\n")
        self.before = contents(self.tree)


class Install(InTree):
    def test_puts_all_where_lammps_finds_it_and_remove_takes_all_away(self):
        self.install()
        there = contents(self.tree)
        for file in (*ROOT.glob("lammps_pkg/*.h"), *ROOT.glob("lammps_pkg/*.cpp")):
            folder = "OPENMP" if "_omp." in file.name else "EEPA"
            if not re.match(r"eepaplugin|lmp_main|eepa_styles", file.name):
                self.assertEqual(there.pop(f"src/{folder}/{file.name}")[1], file.read_bytes())
        for folder in ("kernel/eepa", "commands/eepa_commands", "walls/eepa_walls"):
            for file in (ROOT / folder).iterdir():
                self.assertEqual(there.pop(f"lib/eepa/{Path(folder).name}/{file.name}")[1], file.read_bytes())
        for file in ROOT.glob("lammps_pkg/in_tree/gran_sub_mod_*"):
            self.assertEqual(there.pop(f"src/EEPA/{file.name}")[1], file.read_bytes())
        more = {"cmake/Modules/Packages/EEPA.cmake", "lib/eepa/README", "lib/eepa/INSTALLED"}
        new = {name for name, (_, data) in there.items() if data is not None and name not in self.before}
        self.assertEqual(new, more)
        changed = {name for name in self.before if there[name] != self.before[name]}
        self.assertEqual(changed, {"cmake/CMakeLists.txt"})
        self.remove()
        self.remove()

    def test_names_the_package_in_lammps_build(self):
        self.install()
        text = (self.tree / "cmake/CMakeLists.txt").read_text()
        packages = re.search(r"set\(STANDARD_PACKAGES\n(.*?)\)", text, re.S).group(1)
        packages = re.sub("#.*", "", packages).split()
        self.assertEqual(packages, sorted(packages))
        self.assertIn("EEPA", packages)
        include = text.index("  include(Packages/EEPA)")
        self.assertLess(text.index("\nadd_library(lammps "), include)
        self.assertLess(include, text.index("# add sources of enabled packages"))

    def test_has_styles_for_kokkos_in_the_version_that_they_are_for(self):
        (self.tree / "src/KOKKOS").mkdir()
        self.add_documentation()
        self.install()
        listed = self.tree / "doc/src/Commands_pair.rst"
        self.assertIn(":doc:`gran/eepa (ko) <pair_gran_eepa>`", listed.read_text())
        self.assertTrue((self.tree / "src/KOKKOS/pair_gran_eepa_kokkos.h").exists())
        self.assertTrue((self.tree / "src/KOKKOS/fix_wall_gran_eepa_kokkos.cpp").exists())
        ours = {path.name for path in (ROOT / "lammps_pkg/kokkos").glob("*.*") if path.suffix in (".h", ".cpp")}
        theirs = {path.name for folder in ("src/KOKKOS", "lib/eepa/kokkos") for path in (self.tree / folder).iterdir()}
        self.assertEqual(theirs, ours)
        version = (self.tree / "src/version.h").read_text()
        self.assertIn("4 Feb 2025", version)
        (self.tree / "src/version.h").write_text(version.replace("4 Feb 2025", "4 Jul 2026"))
        self.install()
        self.assertIn(":doc:`gran/eepa (o) <pair_gran_eepa>`", listed.read_text())
        self.assertEqual(list((self.tree / "src/KOKKOS").iterdir()), [])
        self.assertFalse((self.tree / "lib/eepa/kokkos").exists())
        (self.tree / "src/version.h").write_text(version)
        self.install()
        self.remove()

    def test_changes_nothing_the_second_time(self):
        self.install()
        times = {path: path.stat().st_mtime_ns for path in self.tree.rglob("*") if path.is_file()}
        self.assertIn("(0 files changed)", self.install())
        self.assertEqual(times, {path: path.stat().st_mtime_ns for path in self.tree.rglob("*") if path.is_file()})

    def test_brings_up_to_date_what_another_version_installed(self):
        other = self.folder / "eepa"
        for folder in ("lammps_pkg", "kernel", "commands", "walls", "scripts"):
            shutil.copytree(ROOT / folder, other / folder)
        (other / "kernel/eepa/body.h").write_text("// older\n")
        (other / "kernel/eepa/dropped_since.h").write_text("\n")
        (other / "lammps_pkg/platen.h").unlink()
        script = (other / SCRIPT).read_text()
        self.assertIn("EEPA # project eepa", script)
        (other / SCRIPT).write_text(script.replace("EEPA # project eepa", "EEPA # the project eepa"))
        self.install(root=other)
        self.install()
        updated = contents(self.tree)
        self.remove()
        self.install()
        self.assertEqual(contents(self.tree), updated)
        self.install(root=other)
        self.remove()

    def test_adds_pages_and_entries_of_lists_where_there_is_documentation(self):
        self.add_documentation()
        self.assertNotIn("note", self.install())
        for name, text in DOC.items():
            lines = text.splitlines()
            found = (self.tree / f"doc/src/{name}.rst").read_text().splitlines()
            ours = found[found.index(lines[0]) + 1:found.index(lines[1])]
            self.assertTrue(ours)
            for line in ours:
                page = re.search("<(.*)>", line).group(1)
                self.assertTrue((self.tree / f"doc/src/{page}.rst").exists(), page)
        for page in self.tree.glob("doc/src/*eepa*.rst"):
            for image in re.findall(r"\.\. image:: (.*)", page.read_text()):
                self.assertTrue((page.parent / image).exists(), image)
        self.remove()

    def test_tells_where_a_list_of_the_documentation_is_another(self):
        self.add_documentation()
        (self.tree / "doc/src/fix.rst").write_text("another\n")
        self.before = contents(self.tree)
        self.assertRegex(self.install(), r"note: .*doc/src/fix\.rst")
        self.remove()

    def test_does_not_write_through_hard_links(self):
        names = ("cmake/CMakeLists.txt", "src/version.h")
        for name in names:
            os.link(self.tree / name, self.folder / Path(name).name)
        self.install()
        for name in names:
            self.assertEqual((self.folder / Path(name).name).read_bytes(), self.before[name][1])

    def test_takes_a_file_with_line_ends_of_windows(self):
        path = self.tree / "cmake/CMakeLists.txt"
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
        self.before = contents(self.tree)
        self.install()
        self.remove()


class Refused(InTree):
    def test_is_a_folder_that_is_no_lammps(self):
        (self.tree / "src/version.h").unlink()
        self.refused(r"lammps tree is no LAMMPS source tree: it has no src/version\.h")

    def test_is_an_older_version(self):
        (self.tree / "src/version.h").write_text('#define LAMMPS_VERSION "19 Nov 2024"\n')
        self.refused("LAMMPS 19 Nov 2024 .* too old: 4 Feb 2025")
        (self.tree / "src/version.h").write_text('#define LAMMPS_VERSION "yesterday"\n')
        self.refused('names no version .*"yesterday"')

    def test_is_a_build_that_does_not_have_the_expected_lines(self):
        path = self.tree / "cmake/CMakeLists.txt"
        path.write_text(path.read_text().replace("foreach(PKG_WITH_INCL ", "foreach(PACKAGE "))
        self.refused(r"cmake/CMakeLists\.txt has no place for the line .*EEPA")

    def test_is_a_file_that_could_not_be_restored(self):
        path = self.tree / "cmake/CMakeLists.txt"
        path.write_text(path.read_text().rstrip("\n"))
        self.refused("could not be restored to the byte")

    def test_is_a_tree_with_other_files_in_our_places(self):
        for name in ("src/EEPA/pair_mine.cpp", "src/EEPA/platen.h", "lib/eepa/mine.h", "src/OPENMP/pair_gran_eepa_omp.h",
                     "cmake/Modules/Packages/EEPA.cmake"):
            with self.subTest(name):
                (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
                (self.tree / name).write_text("\n")
                self.refused(re.escape(name) + " is not of this package")
                (self.tree / name).unlink()

    def test_is_a_header_of_the_same_name(self):
        (self.tree / "src/GRANULAR/platen.h").write_text("\n")
        self.refused(r"src/GRANULAR/platen\.h has the name of a file of this package")

    def test_is_a_line_with_our_name_that_we_did_not_write(self):
        path = self.tree / "cmake/CMakeLists.txt"
        path.write_text(path.read_text() + "# EEPA\n")
        self.refused(r'cmake/CMakeLists\.txt.* "eepa"')

    def test_is_an_edited_line_or_file_or_a_lost_one(self):
        self.install()
        lists = self.tree / "cmake/CMakeLists.txt"
        header = self.tree / "src/EEPA/platen.h"
        lines, text = lists.read_text(), header.read_text()
        for arguments in ((), ("--remove",)):
            lists.write_text(lines.replace("  include(Packages/EEPA)", " include(Packages/EEPA)"))
            self.refused(r'cmake/CMakeLists\.txt: lines with "eepa" are not as', *arguments)
            lists.write_text(lines.replace("  EEPA # project eepa\n", ""))
            self.refused(r'cmake/CMakeLists\.txt: lines with "eepa" are not as', *arguments)
            lists.write_text(lines)
            header.write_text(text + "\n")
            self.refused(r"src/EEPA/platen\.h was edited", *arguments)
            header.unlink()
            self.refused(r"src/EEPA/platen\.h is gone", *arguments)
            header.write_text(text)
            (self.tree / "src/EEPA/mine.h").write_text("\n")
            self.refused(r"src/EEPA/mine\.h is not of this package", *arguments)
            (self.tree / "src/EEPA/mine.h").unlink()
        self.remove()


class CutOff(InTree):
    """A run that ends when half of the files are in their places."""

    def setUp(self):
        super().setUp()
        self.end_of_script = self.folder / "bin"
        self.end_of_script.mkdir()
        tar = self.end_of_script / "tar"
        tar.write_text(f'#!/bin/sh\n[ "$*" = "-xf -" ] || exec {shutil.which("tar")} "$@"\n'
                       f'{shutil.which("tar")} -xf -\nrm -f src/EEPA/platen.h\n$EEPA_END\n')
        tar.chmod(0o755)

    def cut_off(self, how, *arguments):
        path = f"{self.end_of_script}:{os.environ['PATH']}"
        run = self.script(*arguments, self.tree, PATH=path, EEPA_END=how)
        self.assertNotEqual(run.returncode, 0)

    def test_undoes_itself(self):
        self.cut_off("false")
        self.assertEqual(contents(self.tree), self.before)
        self.install()
        installed = contents(self.tree)
        self.cut_off("false", "--remove")
        self.assertEqual(contents(self.tree), installed)

    def test_is_undone_by_the_next_one_when_it_was_killed(self):
        kill = self.folder / "kill"
        kill.write_text("#!/bin/sh\nkill -9 $(ps -o ppid= $PPID)\nsleep 1\n")
        kill.chmod(0o755)
        self.cut_off(str(kill))
        self.assertNotEqual(contents(self.tree), self.before)
        self.remove()


class Package(unittest.TestCase):
    """What LAMMPS's own build expects of the sources."""

    def test_has_all_styles_in_headers_where_lammps_looks_for_them(self):
        styles = (ROOT / "lammps_pkg/eepa_styles.cpp").read_text()
        kokkos = "".join(re.findall(r"#ifdef EEPA_KOKKOS\n(.*?)#endif", styles, flags=re.S))
        kokkos = re.findall(r'\{"(pair|fix)", "([^"]+)"', kokkos)
        self.assertEqual(len(kokkos), 6)
        styles = re.sub(r"#ifdef EEPA_KOKKOS.*?#endif", "", styles, flags=re.S)
        listed = re.findall(r'\{"(pair|fix|compute)", "([^"]+)".*?maker<(?:\w+, )?(\w+)>', styles, re.S)
        self.assertGreater(len(listed), 5)
        self.assertEqual(sorted(self.styles_of_headers("lammps_pkg")), sorted(listed))
        found = self.styles_of_headers("lammps_pkg/kokkos", suffix="_kokkos")
        self.assertEqual(sorted(style[:2] for style in found), sorted(kokkos))

    def styles_of_headers(self, folder, suffix=""):
        found = []
        for file in (ROOT / folder).glob("*.h"):
            text = file.read_text()
            blocks = re.findall(r"#ifdef (\w+)_CLASS\n", text)
            for category, name, class_ in re.findall(r"^(\w+)Style\(([^,]+),([\w<>]+)\);", text, re.M):
                self.assertEqual(blocks, [category.upper()], file.name)
                # LAMMPS looks for <style of the processor>_kokkos.h
                own = name.split("/kk")[0] if suffix else name
                self.assertTrue(not suffix or file.name == f"{category.lower()}_{own.replace('/', '_')}{suffix}.h")
                self.assertTrue(file.name.startswith(category.lower() + "_"), file.name)
                found.append((category.lower(), name, class_))
            self.assertEqual(bool(blocks), "Style(" in text, file.name)
        return found

    def test_is_compiled_with_the_options_of_the_projects_own_build(self):
        ours = set()
        for name in ("CMakeLists.txt", "lammps_pkg/CMakeLists.txt", "lammps_pkg/kokkos/CMakeLists.txt"):
            text = re.sub(r"if\(EEPA_SANITIZE\).*?endif\(\)", "", (ROOT / name).read_text(), flags=re.S)
            ours |= set(re.findall(r"(?<![\w-])-f[a-z-]+(?:=off)?", re.sub("#.*", "", text)))
        ours -= {"-fmacro-prefix-map"}    # shortens paths in messages
        theirs = re.sub("#.*", "", (ROOT / "lammps_pkg/in_tree/EEPA.cmake").read_text())
        self.assertEqual(ours, set(re.findall(r"(?<![\w-])-f[a-z-]+(?:=off)?", theirs)))

    def test_has_no_header_of_a_name_that_lammps_has(self):
        theirs = {path.name for path in LAMMPS.glob("src/*.h")} | {path.name for path in LAMMPS.glob("src/*/*.h")}
        self.assertGreater(len(theirs), 100)
        ours = [path.name for folder in ("lammps_pkg", "lammps_pkg/kokkos") for path in (ROOT / folder).glob("*.h")]
        self.assertFalse(theirs & set(ours))
        self.assertEqual(len(ours), len(set(ours)))


if __name__ == "__main__":
    unittest.main()
