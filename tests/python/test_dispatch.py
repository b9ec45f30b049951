# SPDX-License-Identifier: GPL-2.0-only
"""EEPA_ARCH=dispatch: the loops for x86-64-v3 have the bits of those for any x86-64, and no other code needs such a
processor. Where the build is another one, only that it says so. `tests/hardening.sh dispatch` makes the build."""

import itertools
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

LMP = os.environ.get("EEPA_LMP")
BUILD = Path(os.environ.get("EEPA_BUILD_DIR", "build"))
QEMU = shutil.which("qemu-x86_64")
SETS = {"baseline": 2, "x86-64-v3": 4}  # contacts side by side


def cached(name: str) -> str:
    """What the build was configured with."""
    found = re.search(f"^{name}:[A-Z]*=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE)
    return found.group(1) if found else ""


DISPATCHES = bool(LMP) and cached("EEPA_ARCH") == "dispatch"


def has_avx2() -> bool:
    return bool(re.search(r"^flags.* avx2\b", Path("/proc/cpuinfo").read_text(), re.MULTILINE))


def run(folder: Path, script: str, loops: str | None, start=()) -> subprocess.CompletedProcess:
    """One lmp. \\param loops  EEPA_LOOPS; None: not set. \\param start  what starts the program"""
    (folder / "in.lmp").write_text(script)
    environment = {key: value for key, value in os.environ.items() if key != "EEPA_LOOPS"}
    if loops is not None:
        environment["EEPA_LOOPS"] = loops
    return subprocess.run([*start, LMP, "-in", "in.lmp", "-log", "none"], cwd=folder, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=1000)


NORMAL = {
    "plateau": ("plateau", ""),
    "linear": ("linear", ""),
    "hertz": ("linear exponent 1.5", " kt 3e3"),
    "luding": ("luding", " depth 0.05"),
}
ROLLING = {"none": "", "constant": " rolling constant 0.01", "sds": " rolling sds 1e3 0.1 0.1"}
TWISTING = {"free": "", "twisting": " twisting marshall"}
LAWS = {"_".join(names): (NORMAL[names[0]][0], NORMAL[names[0]][1] + ROLLING[names[1]] + TWISTING[names[2]])
        for names in itertools.product(NORMAL, ROLLING, TWISTING)}

# The lid of a tube, as a plate under the uppermost layer of particles would see it.
LID = """solid lid
facet normal 0 0 -1
outer loop
vertex -5 -5 0.95
vertex 5 5 0.95
vertex 5 -5 0.95
endloop
endfacet
facet normal 0 0 -1
outer loop
vertex -5 -5 0.95
vertex -5 5 0.95
vertex 5 5 0.95
endloop
endfacet
endsolid lid
"""


def script(name: str, types: int, steps: int) -> str:
    """A tube of particles on a floor that shakes, under a lid that turns; what came out is in files."""
    style, options = LAWS[name]
    stem = f"{name}.{types}"
    coefficients = f"1e4 2e4 5e3 -0.1 0.5 restitution 0.7{options}"
    wall = f"all wall/gran/eepa {style} coeff {coefficients} wall"
    unlike = f"pair_coeff 2 2 2e4 5e4 4e3 -0.2 0.3 restitution 0.5{options}" if types == 2 else ""
    return f"""
clear
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary f f f
region box block -6 6 -6 6 -4 4
create_box {types} box
lattice sc 1.1303 origin 0.5 0.5 0.5
region tube cylinder z 0 0 3.0 -2.7 0.6 units box
create_atoms 1 region tube
set group all density 1.9
set type 1 diameter 0.98
set type 1 type/fraction {types} 0.4 12345
velocity all create 0.3 4711 dist gaussian
pair_style gran/eepa {style} dtcheck off
pair_coeff * * {coefficients}
{unlike}
fix floor {wall} zplane -2.88 NULL wiggle z 0.05 0.2
fix tube {wall} zcylinder 3.25 shear z 0.3
fix lid {wall} mesh lid.stl rotate 0 0 0 0 0 1 2
fix move all nve/sphere
fix gravity all gravity 10 vector 0.2 0.1 -1
timestep 2e-4
neighbor 0.1 bin
compute ids all property/local patom1 patom2
compute contacts all pair/local dist force p1 p2 p3 p4 p5 p6 p7 p8 p9 p15 p16 p17 p18
run {steps} post no
dump particles all custom 1 {stem}.particles id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify particles sort id format float %.17g
dump contacts all local 1 {stem}.contacts c_ids[*] c_contacts[*]
dump_modify contacts format float %.17g
run 1 post no
print "touching: $(f_floor[6]) $(f_tube[6]) $(f_lid[6])" append {stem}.walls
print "$(f_floor[1]:%.17g) $(f_floor[3]:%.17g) $(f_tube[1]:%.17g) $(f_tube[6]:%.17g)" append {stem}.walls
print "$(f_lid[1]:%.17g) $(f_lid[3]:%.17g) $(f_lid[4]:%.17g)" append {stem}.walls
write_restart {stem}.restart
"""


def outcome(loops, laws, types, steps, start=()) -> tuple[str, dict[str, bytes]]:
    """What the program says, and the files that it writes, the histories' restart files among them."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "lid.stl").write_text(LID)
        done = run(folder, "".join(script(law, count, steps) for law in laws for count in types), loops, start)
        if done.returncode != 0:
            raise AssertionError("\n".join(done.stdout.splitlines()[-30:]))
        files = {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix not in (".stl", ".lmp")}
    return done.stdout, files


class Choice(unittest.TestCase):
    def refused(self, loops, start=()):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "lid.stl").write_text(LID)
            done = run(folder, script("linear_none_free", 1, 1), loops, start)
        self.assertNotEqual(done.returncode, 0, done.stdout)
        return done.stdout

    @unittest.skipUnless(LMP and not DISPATCHES, "this build has a choice")
    def test_a_build_for_one_instruction_set_refuses_a_choice(self):
        self.assertIn("environment variable EEPA_LOOPS=baseline is not allowed: only a build with EEPA_ARCH=dispatch",
                      self.refused("baseline"))

    @unittest.skipUnless(DISPATCHES, "this build has no choice")
    def test_an_unknown_name_is_refused(self):
        self.assertIn("environment variable EEPA_LOOPS=avx2 is unknown: it must be x86-64-v3 or baseline",
                      self.refused("avx2"))

    @unittest.skipUnless(DISPATCHES and QEMU, "needs EEPA_ARCH=dispatch and qemu-x86_64")
    def test_a_processor_without_avx_runs_everything_else_and_refuses_v3(self):
        old = (QEMU, "-cpu", "Nehalem")
        laws = ("linear_sds_twisting", "luding_constant_free")
        said, files = outcome(None, laws, (2,), 100, old)
        self.assertIn("instructions of baseline, 2 side by side", said)
        self.assertEqual(files, outcome(None, laws, (2,), 100)[1])
        self.assertIn("environment variable EEPA_LOOPS=x86-64-v3: this processor does not run it",
                      self.refused("x86-64-v3", old))


@unittest.skipUnless(DISPATCHES and has_avx2(), "needs EEPA_ARCH=dispatch and a processor with AVX2")
class Bits(unittest.TestCase):
    def test_the_best_instruction_set_is_taken(self):
        said, _ = outcome(None, ["linear_none_free"], (1,), 1)
        self.assertIn("instructions of x86-64-v3, 4 side by side", said)

    def test_all_laws_have_the_same_bits(self):
        files = {}
        for loops, lanes in SETS.items():
            said, files[loops] = outcome(loops, LAWS, (1, 2), 600)
            self.assertEqual(said.count(f"instructions of {loops}, {lanes} side by side"), 2 * len(LAWS))
        self.assertEqual(len(files["baseline"]), 2 * 4 * len(LAWS))
        for name, content in files["baseline"].items():
            with self.subTest(name):
                self.assertTrue(content == files["x86-64-v3"][name])
        self.look_at_what_was_compared(files["baseline"])

    def look_at_what_was_compared(self, files):
        """Whether contacts were on all branches, slid and did not slide, and walls were touched."""
        branches, slips, walls = set(), set(), [0.0, 0.0, 0.0]
        for name, content in files.items():
            if name.endswith(".contacts"):
                rows = [line.split() for line in content.decode().split("ITEM: ENTRIES")[-1].splitlines()[1:]]
                self.assertGreater(len(rows), 100, name)
                branches |= {row[8] for row in rows}
                slips |= {row[12] for row in rows}
            elif name.endswith(".walls"):
                touching = content.decode().split("touching:")[1].split()[:3]
                walls = [max(most, float(now)) for most, now in zip(walls, touching)]
        self.assertLessEqual({"1", "2", "3"}, branches)
        self.assertEqual(slips, {"0", "1"})
        self.assertTrue(all(most >= 8 for most in walls), walls)


@unittest.skipUnless(DISPATCHES, "needs EEPA_ARCH=dispatch")
class Separation(unittest.TestCase):
    ENTRY = "eepa_make_engine_x86_64_v3"
    SECTION = ".text_x86_64_v3"
    # Instructions with VEX prefix: names that begin with v, and those of BMI; movbe and lzcnt.
    LATER = re.compile(r"\t(?:v[a-z]|(?:andn|bextr|bls[ir]|blsmsk|bzhi|mulx|pdep|pext|rorx|s(?:ar|hl|hr)x|movbe|lzcnt)[lq]?\b)")

    @staticmethod
    def said(*command) -> str:
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout

    def test_the_object_has_one_symbol_for_the_linker_and_no_groups(self):
        made = BUILD / "lammps_pkg" / "x86_64_v3.o"
        self.assertEqual(self.said("nm", "--defined-only", "--extern-only", "-P", made).split()[0::4], [self.ENTRY])
        self.assertIn("There are no section groups", self.said("readelf", "-g", made))

    def test_later_instructions_are_in_their_own_section_and_others_enter_it_at_one_place(self):
        plugin = BUILD / "eepaplugin.so"
        symbols = [line for line in self.said("objdump", "-t", plugin).splitlines() if line.endswith(" " + self.ENTRY)]
        self.assertEqual(len(symbols), 1)
        entry = int(symbols[0].split()[0], 16)
        header = re.search(rf"{re.escape(self.SECTION)}\s+(\w+)\s+(\w+)", self.said("objdump", "-h", plugin))
        size, begin = (int(word, 16) for word in header.groups()) if header else (0, 0)
        section, later, entered = None, {}, set()
        for line in self.said("objdump", "-d", "--no-show-raw-insn", plugin).splitlines():
            if line.startswith("Disassembly of section "):
                section = line.split()[-1].rstrip(":")
            elif self.LATER.search(line):
                later.setdefault(section, []).append(line)
            if section != self.SECTION and (branch := re.search(r"\t(?:call|j[a-z]+) +([0-9a-f]+) ", line)):
                if begin <= int(branch.group(1), 16) < begin + size:
                    entered.add(int(branch.group(1), 16))
        self.assertEqual({where: lines[:5] for where, lines in later.items() if where != self.SECTION}, {})
        self.assertGreater(len(later[self.SECTION]), 10000)
        self.assertLessEqual(entered, {entry})


if __name__ == "__main__":
    unittest.main()
