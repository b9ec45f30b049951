# SPDX-License-Identifier: GPL-2.0-only
"""The conversion tables of docs/compare/moving_from_*.rst.

The formulas of the other codes are written here from their sources, which the pages name. The files
examples/moving/law.* are converted inputs. A test converts the other code's input by the page's formula
and finds the number of the file; where the environment names a LAMMPS (EEPA_LMP) it runs the file and compares
force and overlap, step by step, with the other code's formula. Where the laws differ it holds the page to
the size of the difference.
"""
from __future__ import annotations

import csv
import math
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "moving"
PAGES = ROOT / "docs" / "compare"
LMP = os.environ.get("EEPA_LMP")
ADHESIVE = 3

# The two bodies of in.two_bodies
R1, R2, DENSITY, UNIT = 0.5e-3, 0.8e-3, 2000.0, 2.0e-5
R_EFFECTIVE = R1 * R2 / (R1 + R2)
M1, M2 = (4.0 / 3.0 * math.pi * DENSITY * r ** 3 for r in (R1, R2))
M_EFFECTIVE = M1 * M2 / (M1 + M2)


# ---------------------------------------------------------------------- what the other codes compute


def epsd(k1, mu_r, damping):
    """LIGGGHTS's rolling_friction epsd: torque over angle, torque over angular velocity (src/rolling_model_epsd.h)."""
    stiffness = 2.25 * k1 * (mu_r * R_EFFECTIVE) ** 2
    first, second = M1 * R1 ** 2, M2 * R2 ** 2
    inertia = 1.4 * first * second / (first + second)
    return stiffness, 2.0 * damping * math.sqrt(inertia * stiffness)


def log_damping(stiffness, mass, restitution):
    """LIGGGHTS: gamman of edinburgh, edinburgh/stiffness and luding."""
    return math.sqrt(4.0 * mass * stiffness / (1.0 + (math.pi / math.log(restitution)) ** 2))


class LiggghtsFixedAdhesion:
    """edinburgh and edinburgh/stiffness with fixKc on (src/normal_model_edinburgh.h)."""

    def __init__(self, k1, k2, kc, f0, exponent=1.0):
        self.k1, self.k2, self.kc, self.f0, self.n = k1, k2, kc, f0, exponent
        self.largest = 0.0

    def force(self, overlap):
        self.largest = max(self.largest, overlap)
        here, there = overlap ** self.n, self.largest ** self.n
        line = self.k2 * (here - there) + self.k1 * there
        pull = -self.kc * here
        if line >= self.k1 * here:
            return self.f0 + self.k1 * here
        if line > pull:
            return self.f0 + line
        # no root of the ratio, whatever the exponent
        self.largest = overlap * (self.k2 + self.kc) / (self.k2 - self.k1)
        return self.f0 + pull


class SurfaceEnergyAdhesion:
    """EEPA whose adhesive stiffness follows from a surface energy and the plastic overlap so far.

    With the radius of the circle in which the spheres cut each other at the plastic overlap this is
    edinburgh/stiffness with fixKc off (LIGGGHTS-INL, src/normal_model_edinburgh_stiffness.h), with sqrt(2 R* delta_p)
    it is `eepa` of Lokisphere/LIGGGHTS-EEPA (src/normal_model_eepa.h). Both have a pull-off force of
    1.5 pi gamma a beside f0, at most half of k2 delta_p^n.
    """

    def __init__(self, k1, k2, gamma, f0, radius, exponent=1.0):
        self.k1, self.k2, self.gamma, self.f0, self.n = k1, k2, gamma, f0, exponent
        self.radius = radius
        self.plastic = self.before = 0.0

    def adhesion(self):
        power = self.plastic ** self.n
        pull = min(1.5 * math.pi * self.gamma * self.radius(self.plastic), 0.5 * self.k2 * power)
        return pull / (power - pull / self.k2)

    def force(self, overlap):
        here = overlap ** self.n
        self.plastic = max(self.plastic, overlap * (1.0 - self.k1 / self.k2) ** (1.0 / self.n))
        while True:
            line = self.k2 * (here - self.plastic ** self.n)
            if line >= (1.0 - 1e-12) * self.k1 * here:
                spring = self.k1 * here
                break
            kc = self.adhesion()
            spring = max(line, -kc * here)
            if line > -kc * here or overlap <= self.before:
                break
            # it was on the adhesive branch and is pressed again
            self.plastic = (self.before ** self.n * (1.0 + kc / self.k2)) ** (1.0 / self.n)
        self.before = overlap
        return self.f0 + spring


def lens_radius(plastic):
    d = R1 + R2 - plastic
    return math.sqrt(4.0 * d * d * R1 * R1 - (d * d - R2 * R2 + R1 * R1) ** 2) / (2.0 * d)


def flat_radius(plastic):
    return math.sqrt(2.0 * R_EFFECTIVE * plastic)


class Luding:
    """What the three codes with Luding's law have in common: the stiffness of a step is that of the largest overlap
    at its beginning."""

    def __init__(self, k1, k2, kc, depth, radius, f0=0.0):
        self.k1, self.k2, self.kc, self.f0 = k1, k2, kc, f0
        self.limit = k2 / (k2 - k1) * depth * 2.0 * radius
        self.depth = depth * 2.0 * radius
        self.largest = 0.0

    def stiffness(self):
        return self.k1 + (self.k2 - self.k1) * min(self.largest / self.limit, 1.0)


class LiggghtsLuding(Luding):
    """LIGGGHTS-INL, src/normal_model_luding.h"""

    def force(self, overlap):
        self.largest = max(self.largest, overlap)
        k = self.stiffness()
        start = min(self.largest, self.limit)
        line = k * (overlap - start) + self.k1 * start
        pull = -self.kc * overlap
        if self.largest < self.limit and line >= self.k1 * overlap:
            return self.f0 + self.k1 * overlap
        if line > pull:
            return self.f0 + line
        self.largest = overlap * (k + self.kc) / (k - self.k1)
        return self.f0 + pull


class Mercury(Luding):
    """MercuryDPM, Kernel/Interactions/NormalForceInteractions/LinearPlasticViscoelasticInteraction.cc"""

    def force(self, overlap):
        if overlap > self.largest:
            self.largest = min(self.limit, overlap)
        k = self.stiffness()
        line = k * overlap - (k - self.k1) * self.largest
        if line < -self.kc * overlap:
            self.largest = overlap * (k + self.kc) / (k - self.k1)
            line = -self.kc * overlap
        return line


class Yade(Luding):
    """Yade, pkg/dem/LudingPM.cpp"""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.free = self.before = 0.0

    def lower(self, k):
        self.free = min((1.0 - self.k1 / k) * self.largest, self.depth)

    def force(self, overlap):
        k = self.stiffness()
        if overlap > self.largest:
            self.largest = overlap
            self.lower(k)
        line = k * (overlap - self.free)
        if line >= self.k1 * overlap:
            line = self.k1 * overlap if overlap < self.limit else line
        elif line <= -self.kc * overlap and overlap < self.before:
            self.largest = overlap * (k + self.kc) / (k - self.k1)
            self.lower(k)
            line = -self.kc * overlap
        self.before = overlap
        return line


# ---------------------------------------------------------------------- running and comparing


def numbers(law):
    """k1 k2 k_adh f0 mu and the numbers of the keywords in a law file's pair_coeff."""
    line = next(l for l in law_lines(law) if l.startswith("pair_coeff"))
    words = line.split()[3:]
    found = dict(zip(("k1", "k2", "k_adh", "f0", "mu"), map(float, words[:5])))
    for keyword, *names in (("depth", "depth"), ("kt", "kt"), ("restitution", "e"), ("viscous", "Bn", "Bt"),
                            ("sds", "kr", "gr", "mu_r")):
        if keyword in words:
            at = words.index(keyword)
            found.update(zip(names, map(float, words[at + 1:])))
    return found


def law_lines(law):
    text = (EXAMPLE / f"law.{law}").read_text(encoding="utf-8")
    return [line for line in text.splitlines() if line and not line.startswith("#")]


def lammps(in_file, **variables):
    command = [LMP, "-in", in_file, "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name] + [str(v) for v in (value if isinstance(value, (list, tuple)) else [value])]
    # no daemon of Open MPI 4 for each of many short runs on one process
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_MCA_ess_singleton_isolated": "1"}
    done = subprocess.run(command, cwd=EXAMPLE, capture_output=True, text=True, timeout=100, env=environment)
    if done.returncode:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-2000:])
    return done.stdout


class Run:
    """Overlap, normal velocity (positive closes) and force of every step of in.two_bodies."""

    def __init__(self, law, target, partner="sphere", radii=(R1, R2), **variables):
        variables.update(r1=radii[0], r2=radii[1])
        with tempfile.TemporaryDirectory() as folder:
            lammps("in.two_bodies", law=law, partner=partner, target=target, out=folder, **variables)
            rows = np.genfromtxt(Path(folder) / f"moving_{law}.csv", delimiter=",", names=True)
        _, first = np.unique(rows["step"], return_index=True)
        rows = rows[first]
        if partner == "wall":
            self.normal = np.array([np.ones(len(rows)), np.zeros(len(rows))])
            self.overlap = radii[0] - rows["x"]
        else:
            distance = np.hypot(rows["x"], rows["y"])
            self.normal = np.array([rows["x"], rows["y"]]) / distance
            self.overlap = sum(radii) - distance
        velocity = np.array([rows["vx"], rows["vy"]])
        force = np.array([rows["fx"], rows["fy"]])
        self.closing = -np.sum(velocity * self.normal, axis=0)
        self.force = np.sum(force * self.normal, axis=0)
        self.tangential = force[1] * self.normal[0] - force[0] * self.normal[1]
        self.slid, self.speed = rows["y"], rows["vy"]
        self.branch = rows["branch"]

    def against(self, other, damping=0.0):
        """Difference in every step of a contact, as a fraction of the largest force."""
        theirs = np.zeros(len(self.overlap))
        for i, (overlap, closing) in enumerate(zip(self.overlap, self.closing)):
            if overlap > 0.0:
                theirs[i] = other.force(overlap) + damping * closing
        self.theirs = theirs
        apart = np.where(self.overlap > 0.0, np.abs(self.force - theirs), 0.0)
        return apart / np.max(np.abs(theirs))


# pressed, partly freed and pressed further; onto the adhesive branch, and from there pressed again; freed
CYCLE = [1.0, 0.8, 1.3, 0.3, 1.5]


class Files(unittest.TestCase):
    def test_pages_print_the_lines_of_the_files(self):
        text = "\n".join(page.read_text(encoding="utf-8") for page in sorted(PAGES.glob("moving_from_*.rst")))
        text = re.sub(r"&\n\s*", "", text)
        for path in sorted(EXAMPLE.glob("law.*")):
            for line in law_lines(path.name[4:]):
                self.assertIn(line, text, path.name)


class Conversion(unittest.TestCase):
    """Each number in a law file is what the page's formula makes of the other code's input."""

    def close(self, law, **expected):
        found = numbers(law)
        for name, value in expected.items():
            self.assertAlmostEqual(found[name], value, delta=1e-6 * abs(value), msg=f"{law} {name}")

    def test_liggghts_hertz(self):
        young, poisson = 5e7, 0.3
        effective = 1.0 / (2.0 * (1.0 - poisson ** 2) / young)
        k1 = 4.0 / 3.0 * effective * math.sqrt(R_EFFECTIVE)
        self.close("liggghts_hertz", k1=k1, k2=3.0 * k1, k_adh=0.5 * k1,
                   Bn=log_damping(k1, M_EFFECTIVE, 0.5), Bt=log_damping(k1, M_EFFECTIVE, 0.5))
        shear = 1.0 / (4.0 * (2.0 - poisson) * (1.0 + poisson) / young)
        self.assertAlmostEqual(8.0 * shear * math.sqrt(R_EFFECTIVE * UNIT), 3550.0, delta=1.0)

    def test_liggghts_surface_energy(self):
        theirs = SurfaceEnergyAdhesion(5e3, 1.5e4, 10.0, 0.0, lens_radius)
        theirs.plastic = UNIT * (1.0 - 5e3 / 1.5e4)
        self.close("liggghts_surface_energy", k_adh=theirs.adhesion())

    def test_liggghts_luding(self):
        damping = log_damping(5e3, M_EFFECTIVE, 0.5)
        self.close("liggghts_luding", Bn=damping, Bt=damping, kt=0.2 * 5e3)

    def test_liggghts_epsd(self):
        stiffness, damping = epsd(5e3, 0.1, 0.05)
        self.close("liggghts_epsd", kr=stiffness / R_EFFECTIVE ** 2, gr=damping / R_EFFECTIVE ** 2, mu_r=0.1)

    def test_mercury_dashpot(self):
        """setRestitutionCoefficient(e, 2 m*) is our restitution e."""
        mass, e = 2.0 * M_EFFECTIVE, 0.5
        theirs = -math.sqrt(2.0 * mass * 5e3 / (math.pi ** 2 + math.log(e) ** 2)) * math.log(e)
        self.assertAlmostEqual(theirs, log_damping(5e3, M_EFFECTIVE, e), places=12)

    def test_eepa_hertz(self):
        shear, poisson, ratio = 1e7, 0.25, 0.5
        effective = 2.0 * shear * (1.0 + poisson) / (2.0 * (1.0 - poisson ** 2))
        k1 = 4.0 / 3.0 * effective * math.sqrt(R_EFFECTIVE)
        k2 = k1 / (1.0 - ratio)
        theirs = SurfaceEnergyAdhesion(k1, k2, 10.0, 0.0, flat_radius, 1.5)
        theirs.plastic = UNIT * ratio ** (1.0 / 1.5)
        self.close("eepa_hertz", k1=k1, k2=k2, k_adh=theirs.adhesion())
        self.assertAlmostEqual(8.0 * shear / (2.0 * (2.0 - poisson)) * math.sqrt(R_EFFECTIVE * UNIT), 1793.0,
                               delta=1.0)

    def test_yade_example(self):
        k1, r = 105.0, 0.2
        self.close("yade_example", k1=k1, k2=5.0 * k1, k_adh=k1, mu=math.tan(0.5),
                   depth=0.031 * (5.0 * k1 - k1) * 2.0 * r / (5.0 * k1 * 2.0 * r * r))
        self.assertAlmostEqual(math.tan(0.4636476), numbers("yade")["mu"], places=7)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Liggghts(unittest.TestCase):
    def test_stiffness_coincides_on_every_branch_with_dashpot(self):
        run = Run("liggghts_stiffness", CYCLE)
        theirs = LiggghtsFixedAdhesion(5e3, 1.5e4, 2.5e3, -1e-3)
        apart = run.against(theirs, log_damping(5e3, M_EFFECTIVE, 0.5))
        self.assertLess(np.max(apart), 1e-12)
        self.assertLessEqual({1.0, 2.0, 3.0}, set(run.branch))

    def test_hertz_coincides_until_pressed_again_from_the_adhesive_branch(self):
        run = Run("liggghts_hertz", CYCLE)
        theirs = LiggghtsFixedAdhesion(6.425333e5, 1.9276e6, 3.212667e5, -1e-3, 1.5)
        apart = run.against(theirs, 0.3168922)
        first = np.flatnonzero(run.branch == ADHESIVE)[0]
        turned = first + np.flatnonzero(run.closing[first:] > 0.0)[0]
        self.assertLess(np.max(apart[:turned]), 1e-12)
        # Theirs stays on the adhesive branch, so that it attracts the more the deeper it is pressed.
        deepest = turned + np.argmax(run.overlap[turned:])
        spring = run.theirs[deepest] - 0.3168922 * run.closing[deepest] + 1e-3
        self.assertAlmostEqual(spring, -3.212667e5 * run.overlap[deepest] ** 1.5, delta=1e-9)
        self.assertGreater(run.force[deepest], 0.1)

    def test_surface_energy_coincides_in_the_first_cycle(self):
        theirs = SurfaceEnergyAdhesion(5e3, 1.5e4, 10.0, -1e-3, lens_radius)
        run = Run("liggghts_surface_energy", [1.0, 0.8, 1.0, 0.3])
        first = np.flatnonzero(run.branch == ADHESIVE)[0]
        apart = run.against(theirs, log_damping(5e3, M_EFFECTIVE, 0.5))
        # k_adh has seven digits in the file
        self.assertLess(np.max(apart), 1e-7)
        self.assertGreater(len(apart) - first, 100)

    def test_surface_energy_pulls_off_otherwise_at_other_overlaps(self):
        # the figures of the page
        for reached, ours, theirs in ((0.5, 2.13e-3, 3.01e-3), (2.0, 8.51e-3, 6.00e-3)):
            law = SurfaceEnergyAdhesion(5e3, 1.5e4, 10.0, 0.0, lens_radius)
            law.force(reached * UNIT)
            self.assertAlmostEqual(1.5 * math.pi * 10.0 * lens_radius(law.plastic), theirs, delta=1e-5)
            k = numbers("liggghts_surface_energy")
            self.assertAlmostEqual(k["k_adh"] * law.plastic / (1.0 + k["k_adh"] / k["k2"]), ours, delta=1e-5)

    def test_sliding(self):
        run = Run("liggghts_stiffness", [1.0], drag=1.0)
        dragged = np.flatnonzero(run.slid > 0.0)[1:40]
        # spring and, with the same coefficient as along the normal, dashpot
        dashpot = log_damping(5e3, M_EFFECTIVE, 0.5) * run.speed[dragged]
        theirs = 5e3 * run.slid[dragged] + dashpot
        self.assertLess(np.max(np.abs(-run.tangential[dragged] / theirs - 1.0)), 0.01)
        # theirs: mu |F_n|, with the dashpot, which is small at the end
        self.assertAlmostEqual(-run.tangential[-1], 0.5 * abs(run.force[-1]), delta=2e-3 * run.force[-1])

    def test_nothing_slides_against_friction_in_tension(self):
        run = Run("liggghts_stiffness", [1.0, 0.62], drag=0.1)
        self.assertLess(run.force[-1], -1e-2)          # theirs: mu |F_n|
        self.assertNotEqual(run.branch[-1], ADHESIVE)  # where bound adhesive would have friction
        self.assertAlmostEqual(run.tangential[-1], 0.0, delta=1e-15)


class LiggghtsItself(unittest.TestCase):
    """The formulas above against what LIGGGHTS-INL 4.0.0 wrote: examples/moving/liggghts."""

    UNIT, STRIDE, TARGETS = 2.0e-5, 0.005, (1.0, 0.8, 1.3, 0.3, 1.5, -0.1)

    def follow(self, law, theirs, damping):
        """Largest difference of forces, over the largest one."""
        with (ROOT / "examples" / "moving" / "liggghts" / f"moving_{law}.csv").open() as file:
            rows = {int(row["step"]): row for row in csv.DictReader(file)}
        step, overlap, apart, largest, compared = 0, 0.0, 0.0, 0.0, 0
        at = 0.0
        for target in self.TARGETS:
            count = round(abs(target - at) / self.STRIDE)
            for k in range(1, count + 1):
                step += 1
                overlap = self.UNIT * (at + (target - at) * k / count)
                if overlap <= 1e-9 * self.UNIT:
                    continue
                spring = theirs.force(overlap)
                if step in rows:
                    row = rows[step]
                    self.assertAlmostEqual(R1 + R2 - float(row["x"]), overlap, delta=1e-12 * R1)
                    force = spring - damping * float(row["vx"])
                    apart = max(apart, abs(force - float(row["fx"])))
                    largest = max(largest, abs(force))
                    compared += 1
            at = target
        self.assertEqual(compared, 53)
        return apart / largest

    def test_fixed_adhesion(self):
        theirs = LiggghtsFixedAdhesion(5e3, 1.5e4, 2.5e3, -1e-3)
        self.assertLess(self.follow("stiffness", theirs, log_damping(5e3, M_EFFECTIVE, 0.5)), 1e-12)

    def test_surface_energy(self):
        theirs = SurfaceEnergyAdhesion(5e3, 1.5e4, 10.0, -1e-3, lens_radius)
        self.assertLess(self.follow("surface_energy", theirs, log_damping(5e3, M_EFFECTIVE, 0.5)), 1e-12)

    def test_exponent(self):
        k1 = 4.0 / 3.0 * 5e7 / (1.0 - 0.3 ** 2) / 2.0 * math.sqrt(R_EFFECTIVE)
        theirs = LiggghtsFixedAdhesion(k1, 3.0 * k1, 0.5 * k1, -1e-3, 1.5)
        self.assertLess(self.follow("hertz", theirs, log_damping(k1, M_EFFECTIVE, 0.5)), 1e-12)

    def test_luding(self):
        theirs = LiggghtsLuding(5e3, 2.5e4, 5e3, 0.03, R_EFFECTIVE, -1e-3)
        self.assertLess(self.follow("luding", theirs, log_damping(5e3, M_EFFECTIVE, 0.5)), 1e-12)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Eepa(unittest.TestCase):
    def test_hertz_coincides_in_the_first_cycle(self):
        run = Run("eepa_hertz", [1.0, 0.8, 1.0, 0.2])
        theirs = SurfaceEnergyAdhesion(3.118429e5, 6.236857e5, 10.0, -1e-3, flat_radius, 1.5)
        apart = run.against(theirs)
        first = np.flatnonzero(run.branch == ADHESIVE)[0]
        self.assertLess(np.max(apart[:first]), 1e-12)
        self.assertLess(np.max(apart), 1e-7)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class LudingLaws(unittest.TestCase):
    """The other codes use the stiffness of the step before, so the difference is of first order in the step."""

    def follow(self, law, make, partner="sphere", damping=0.01, **variables):
        found = []
        for stride in (0.01, 0.005):
            run = Run(law, CYCLE, partner, stride=stride, **variables)
            apart = run.against(make(), damping)
            found.append(np.max(apart))
        self.assertLess(found[1], 0.005)
        self.assertAlmostEqual(found[0] / found[1], 2.0, delta=0.1)
        return run, apart

    def unequal_at(self, apart):
        return np.flatnonzero(apart > 1e-12)[0]

    def adheres_at(self, run):
        """The first step on the adhesive branch, and the first after it that closes."""
        first = np.flatnonzero(run.branch == ADHESIVE)[0]
        return first, first + np.flatnonzero(run.closing[first:] > 0.0)[0]

    def test_liggghts(self):
        run, apart = self.follow("liggghts_luding", lambda: LiggghtsLuding(5e3, 2.5e4, 5e3, 0.03, R_EFFECTIVE, -1e-3),
                                 damping=2.795430e-2)
        self.assertGreaterEqual(self.unequal_at(apart), self.adheres_at(run)[0])

    def test_mercury(self):
        run, apart = self.follow("mercury", lambda: Mercury(5e3, 2.5e4, 5e3, 0.03, R_EFFECTIVE))
        self.assertGreaterEqual(self.unequal_at(apart), self.adheres_at(run)[0])
        limit = Mercury(5e3, 2.5e4, 5e3, 0.03, R_EFFECTIVE).limit
        self.assertLess(limit, np.max(run.overlap))  # the limit branch was reached

    def test_mercury_wall(self):
        self.follow("mercury_wall", lambda: Mercury(5e3, 2.5e4, 5e3, 0.03, R1), "wall")

    def test_mercury_constant(self):
        theirs = Mercury(5e3, 2.5e4, 5e3, 0.1, R_EFFECTIVE)
        theirs.stiffness = lambda: 2.5e4
        run = Run("mercury_constant", CYCLE)
        self.assertLess(np.max(run.against(theirs, 0.01)), 1e-12)
        self.assertIn(ADHESIVE, run.branch)

    def test_yade(self):
        self.follow("yade", lambda: Yade(5e3, 2.5e4, 5e3, 0.03, R_EFFECTIVE))

    def test_yade_example(self):
        self.follow("yade_example", lambda: Yade(105.0, 525.0, 105.0, 0.124, 0.1), damping=0.0, radii=(0.2, 0.2),
                    unit=0.02)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class Rolling(unittest.TestCase):
    OMEGA, NORMAL = 1000.0, 5e3 * UNIT

    def roll(self, law):
        with tempfile.TemporaryDirectory() as folder:
            lammps("in.rolling", law=law, out=folder, omega=self.OMEGA)
            rows = np.genfromtxt(Path(folder) / f"rolling_{law}.csv", delimiter=",", names=True)
        return rows["time"], np.abs(rows["torque"])

    def test_mercury(self):
        # a pseudo-force of 2 R* times the spin, at the arm 2 R*, at most mu |f_n|
        time, torque = self.roll("mercury_rolling")
        arm = 2.0 * R_EFFECTIVE
        rolled = arm * self.OMEGA
        theirs = arm * np.minimum(50.0 * rolled * time + 1e-3 * rolled, 0.05 * self.NORMAL)
        self.assertLess(np.max(np.abs(torque - theirs)), 1e-9 * np.max(theirs))
        self.assertLess(torque[5], 0.5 * torque[-1])

    def test_liggghts_epsd(self):
        time, torque = self.roll("liggghts_epsd")
        stiffness, damping = epsd(5e3, 0.1, 0.05)
        spring = stiffness * self.OMEGA * time
        bound = 0.1 * self.NORMAL * R_EFFECTIVE
        sticking = spring + damping * self.OMEGA < bound
        self.assertGreater(np.sum(sticking), 100)
        self.assertLess(np.max(np.abs(torque - spring - damping * self.OMEGA)[sticking]), 1e-6 * bound)
        self.assertAlmostEqual(torque[-1], bound, delta=1e-9 * bound)


@unittest.skipUnless(LMP, "EEPA_LMP names no LAMMPS")
class MercuryUnitTest(unittest.TestCase):
    """Positions and velocities that MercuryDPM's own test expects (Drivers/UnitTests/PlasticForceUnitTest.cpp)."""

    def impact(self, chi):
        limit = 500.0 / (500.0 - 100.0) * 0.05 * 0.5
        speed = 0.5 * math.sqrt(2.0 * 100.0) * chi * limit
        time_step = 2.0 * 0.02 * math.pi / math.sqrt(500.0 / 0.5)
        said = lammps("in.impact", law="mercury_unit_test", speed=speed, dt=time_step)
        x, v = map(float, re.search(r"^left (\S+) (\S+)$", said, re.M).groups())
        return x + 1.5, v

    def test_rebound(self):
        for chi, position, velocity in ((0.34, 0.995546292935715, -0.032721738352012),
                                        (1.37, 0.969386085767181, -0.163049415300304)):
            x, v = self.impact(chi)
            self.assertAlmostEqual(x, position, delta=1e-13)
            self.assertAlmostEqual(v, velocity, delta=1e-13)

    def test_sticking(self):
        # on the adhesive branch the stiffness lags by a step
        for chi, position, velocity in ((0.69, 1.00695193269955, -0.0138683231953154),
                                        (1.1, 1.00840467123501, -0.0204655358555405)):
            x, v = self.impact(chi)
            self.assertAlmostEqual(x, position, delta=1e-5)
            self.assertAlmostEqual(v, velocity, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
