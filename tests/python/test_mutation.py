# SPDX-License-Identifier: GPL-2.0-only
"""The mutation tool itself, on a kernel of a few lines: what its tests check is killed, what they do
not is found. Needs clang++, Ninja and a minute; left out, and said so, where one is missing."""
from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[1] / "mutation" / "mutate.py"
MISSING = [name for name in ("clang++", "ninja", "cmake") if not shutil.which(name)]

HEADER = """\
#ifndef TOY_H
#define TOY_H
#include <Eigen/Core>
#include <cmath>
#define TOY_LIMIT 3.0
namespace eepa {
struct Toy { static constexpr int size = 3; };
template <class Real> Real force(const Real &stiffness, const Real &overlap)
{
  Real result = stiffness * overlap;
  if (overlap > TOY_LIMIT) result += 1.0;
  return result;
}
inline Eigen::Vector3d along(double length, const Eigen::Vector3d &normal)
{
  constexpr double half = 0.5;
  return half * length * normal;
}
inline bool deep(double overlap) { return overlap >= 2.0; }
inline double never_called(double x) { return -x; }
}
#endif
"""

TESTS = """\
#include <eepa/toy.h>
#include <gtest/gtest.h>
TEST(Toy, Force)
{
  EXPECT_EQ(eepa::force(2.0, 1.5), 3.0);
  EXPECT_EQ(eepa::force(2.0, 3.0), 6.0);
  EXPECT_EQ(eepa::force(2.0, 4.0), 9.0);
}
TEST(Toy, Vector)
{
  EXPECT_EQ(eepa::along(4.0, {0, 0, 3}), Eigen::Vector3d(0, 0, 6));
  EXPECT_EQ(eepa::Toy::size, 3);
}
TEST(Toy, Deep)
{
  EXPECT_TRUE(eepa::deep(3.0));
  EXPECT_FALSE(eepa::deep(1.0));
}
"""

BUILD = """\
cmake_minimum_required(VERSION 3.20)
project(toy LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(GTest REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
add_executable(test_kernel tests/kernel/toy.cpp)
target_include_directories(test_kernel PRIVATE kernel)
target_link_libraries(test_kernel PRIVATE Eigen3::Eigen GTest::gtest GTest::gtest_main)
"""

KILLED = ("Toy::size: 3 -> 2", "along: * -> /", "along: * -> / #2", "along: 0.5 -> 0.0",
          "along: 0.5 + 1%", "force: * -> /", "force: += -> -=", "force: += dropped",
          "force: > -> >=", "force: > -> <=", "force: if -> true", "force: if -> false",
          "force: 1.0 -> 0.0", "force: 1.0 + 1%", "deep: >= -> <", "deep: 2.0 -> 0.0")
SURVIVED = ("deep: >= -> >", "deep: 2.0 + 1%")
UNREACHED = ("never_called: - taken away",)


@unittest.skipIf(MISSING, f"{', '.join(MISSING)} not installed: apt-get install clang ninja-build")
class Tool(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = Path(folder.name)
        for name, text in (("CMakeLists.txt", BUILD), ("kernel/eepa/toy.h", HEADER),
                           ("tests/kernel/toy.cpp", TESTS)):
            path = cls.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)

    def run_tool(self, *options, survivors=""):
        listed = self.root / "survivors.txt"
        listed.write_text(survivors)
        done = subprocess.run(
            [sys.executable, "-B", str(TOOL), "--root", str(self.root), "--survivors", str(listed),
             "--work", str(self.root / "work"), *options],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=900)
        return done.returncode, done.stdout

    def test_finds_what_tests_do_not_notice(self):
        status, out = self.run_tool("--verbose")
        self.assertEqual(status, 1, out)
        for word, keys in (("killed", KILLED), ("survived", SURVIVED), ("unreached", UNREACHED)):
            found = set(re.findall(rf"^{word} [^:\n]*: (.*)$", out, re.M))
            self.assertEqual(found, set(keys), out)
        # explained, it is well
        listed = "# nobody asks there\n" + "\n".join(SURVIVED + UNREACHED)
        status, out = self.run_tool(survivors=listed)
        self.assertEqual(status, 0, out)
        self.assertIn("19 mutants: 16 killed, 0 do not compile, 3 explained, 0 survived", out)
        # but neither what is killed may be explained, nor what there is not
        status, out = self.run_tool("--match", "deep", survivors=listed + "\ndeep: >= -> <\n")
        self.assertEqual(status, 1, out)
        self.assertIn("but in the list of survivors: deep: >= -> <", out)
        status, out = self.run_tool("--match", "deep", survivors=listed + "\ndeep: >= -> ==\n")
        self.assertEqual(status, 1, out)
        self.assertIn("no such mutant: deep: >= -> ==", out)

    def test_refuses_a_project_that_fails_without_a_mutant(self):
        tests = self.root / "tests/kernel/toy.cpp"
        tests.write_text(TESTS.replace("EXPECT_TRUE(eepa::deep(3.0))", "EXPECT_TRUE(false)"))
        self.addCleanup(tests.write_text, TESTS)
        status, out = self.run_tool("--match", "deep")
        self.assertEqual(status, 2, out)
        self.assertIn("fails without a mutant", out)

    def test_keys_do_not_hang_on_wording_or_place(self):
        status, before = self.run_tool("--list")
        self.assertEqual(status, 0, before)
        header = self.root / "kernel/eepa/toy.h"
        header.write_text("// more\n\n" + HEADER.replace("overlap", "depth").replace(
            "depth > TOY_LIMIT", "depth  // deep\n      > TOY_LIMIT"))
        self.addCleanup(header.write_text, HEADER)
        status, after = self.run_tool("--list")
        self.assertEqual(status, 0, after)

        def keys(text):
            return [line for line in text.splitlines() if line and not line.startswith("    ")]
        self.assertEqual(keys(before), keys(after))
        self.assertEqual(set(keys(before)[:-1]), set(KILLED + SURVIVED + UNREACHED))

    def test_sample_is_the_same_for_a_seed(self):
        first, again, other = (self.run_tool("--list", "--sample", "5", "--seed", seed)[1]
                               for seed in ("1", "1", "2"))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)
        self.assertIn("5 mutants in", first)

    @unittest.skipUnless((TOOL.parents[2] / "CMakeLists.txt").is_file(), "not in the source tree")
    def test_copy_of_this_project_can_be_configured(self):
        sys.path.insert(0, str(TOOL.parent))
        self.addCleanup(sys.path.remove, str(TOOL.parent))
        import bench
        copy = self.root / "copy"
        bench.copy_project(str(TOOL.parents[2]), str(copy))
        done = subprocess.run(["cmake", "-S", copy, "-B", copy / "build", "-G", "Ninja", "-D", "EEPA_WITH_LAMMPS=OFF"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    unittest.main()
