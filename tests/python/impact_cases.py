# SPDX-License-Identifier: GPL-2.0-only
"""Laws, tolerances and checks of test_impacts.py and test_steady_contacts.py."""

import math
import os
import sys
import tempfile
import unittest

from impact_theory import integrate
from impacts import PAIR, SUB_MODEL_PAIR, SUB_MODEL_WALL, WALL, oracle, run

LMP = os.environ.get("EEPA_LMP", "")
STYLES = [PAIR, WALL]
if os.environ.get("EEPA_STYLES") == "in_lammps":
    STYLES += [SUB_MODEL_PAIR, SUB_MODEL_WALL]

# Steps in half a period of the stiffest branch. Velocity Verlet is off by the square of pi/STEPS. A force that steps where
# a contact opens or closes, as dashpots and f0 have it, acts up to half a step too long or too short.
STEPS = 5000
SMOOTH = 20 * (math.pi / STEPS) ** 2
STEPPED = 0.5 * math.pi / STEPS
# Of velocities after contacts with friction, which begin and end to slide up to a step late, with speeds of 1.
AS_INTEGRATED = math.pi / STEPS


def law(**given):
    return oracle.parameters(**{"k1": 1e5, "k2": 1e5, "mu": 0.0, **given})


ELASTIC = law()
DASHPOT = law(restitution=0.6)
HYSTERETIC = law(k2=2e5)
ADHESIVE = law(k2=2e5, k_adh=3e4)
PULLED = law(k2=2e5, k_adh=1e4, f0=-5.0)
GROWING = law(law="luding", k2=5e5, k_adh=2e4, depth=0.02)       # stays below its limit overlap
LIMITED = law(law="luding", k2=5e5, k_adh=2e4, depth=2e-3)       # goes beyond
PLATEAU = law(law="plateau", k2=2e5, k_adh=5e4)


def with_friction(parameters, mu=0.5):
    return {**parameters, "mu": mu}


def elastic(parameters):
    return parameters["k1"] == parameters["k2"] and parameters["restitution"] is None


def has_steps(parameters):
    return bool(parameters["restitution"] or parameters["B_n"] or parameters["f0"] or parameters["law"] == "plateau")


def duration(case):
    """More than the time of contact: that of the softest branch, and what an adhesive one adds at its end."""
    softest = min(case.law["k1"], case.law["k_adh"] or case.law["k1"])
    return 3 * math.pi * math.sqrt(case.reduced_mass / softest)


class Impacts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shares, cls.names = [], set()

    @classmethod
    def tearDownClass(cls):
        if cls.shares:
            print(f"{cls.__name__}: {len(cls.names)} runs, {len(cls.shares)} numbers, the worst one "
                  f"{max(cls.shares):.2g} of its tolerance away", file=sys.stderr)

    def run_cases(self, cases):
        self.assertTrue(cases)
        self.names.update(case.name for case in cases)
        with tempfile.TemporaryDirectory() as folder:
            return list(zip(cases, run(cases, folder, LMP)))

    def near(self, found, expected, tolerance):
        self.shares.append(abs(found - expected) / tolerance)
        self.assertAlmostEqual(found, expected, delta=tolerance)

    def assert_state(self, found, velocity, spin, radius, tolerance):
        """Velocity along t and n and surface velocity of the spin, and nothing out of the plane."""
        for got, expected in ((found.v[0], velocity[0]), (found.v[1], velocity[1]), (found.spin * radius, spin * radius)):
            self.near(got, expected, tolerance)
        self.assertLess(found.aside, 1e-9)

    def assert_as_integrated(self, case, states):
        expected = integrate(case)
        for body, found, should in zip((case.sphere, case.partner), states, expected):
            if body and not body.frozen:
                self.assert_state(found, should.v, should.spin, body.radius, AS_INTEGRATED)
