# SPDX-License-Identifier: GPL-2.0-only
"""Contacts of particles with bonds of LAMMPS's package BPM: a bonded pair has no contact, or both with overlay/pair; when
the bond breaks, contact begins anew. Three particles with prescribed motion, the first two of them bonded; forces
without bonds are those of pair_style gran/eepa."""

import math
import unittest

import numpy as np

from sub_model_runs import IN_LAMMPS, LAWS, NO_FRICTION, forces, run

# The bond is made where its particles overlap by 0.03. They are pressed to 0.04 and drawn apart; the bond breaks while
# they still overlap. Then the overlap goes up and down, and ends for a while. So does that of particles 2 and 3.
LENGTH, STRAIN, STIFFNESS, STEP = 0.97, 0.0125, 2e4, 1e-3
HEAD = """units lj
atom_style bpm/sphere
atom_modify map array
newton {newton} off
boundary p p f
comm_modify vel yes cutoff 3
special_bonds {special}
region box block -5 5 -2 2 -2 2
create_box 1 box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 4
create_atoms 1 single -2 0 0
create_atoms 1 single -1.03 0 0
create_atoms 1 single -0.03 0 0
set group all diameter 1 density 1.9
reset_timestep {first}
neighbor 0.05 bin
neigh_modify every 5 delay 0 check no
timestep 1e-3
"""
RUN = """variable t equal step*dt
variable x1 equal 2*v_t
variable v1 equal 2
variable grown equal 0.008+0.05*v_t
variable x2 equal v_x1+0.01*v_t-v_grown*sin(30*v_t)
variable v2 equal v_v1+0.01-0.05*sin(30*v_t)-30*v_grown*cos(30*v_t)
variable x3 equal v_x2-0.012-0.010*sin(30*v_t)-0.006*sin(83*v_t)
variable v3 equal v_v2-0.30*cos(30*v_t)-0.498*cos(83*v_t)
group p1 id 1
group p2 id 2
group p3 id 3
fix m1 p1 move variable v_x1 NULL NULL v_v1 NULL NULL
fix m2 p2 move variable v_x2 NULL NULL v_v2 NULL NULL
fix m3 p3 move variable v_x3 NULL NULL v_v3 NULL NULL
variable f1 equal fx[1]
variable f2 equal fx[2]
variable f3 equal fx[3]
thermo 1
thermo_style custom step v_f1 v_f2 v_f3
thermo_modify format float %.17g norm no
"""
BONDED, OVERLAID = "lj 0 1 1 coul 1 1 1", "lj 1 1 1 coul 1 1 1"
BREAKING = STIFFNESS * LENGTH * STRAIN
BONDS = {
    "bpm/spring": f"{STIFFNESS} {STRAIN} 0",
    "bpm/rotational": f"{STIFFNESS} 1e3 1e3 1e3 {BREAKING} 1e9 1e9 1e9 0 0 0 0",
}
STEPS = 700


def stretches():
    t = STEP * np.arange(STEPS + 1)
    return 0.01 * t - (0.008 + 0.05 * t) * np.sin(30 * t)


def styles(law):
    model, name, numbers = LAWS[law]
    own = f"pair_style gran/eepa {name} dtcheck off\npair_coeff * * {numbers} kt 0\n"
    sub = f"pair_style granular\npair_coeff * * {model} 0 NULL damping velocity {NO_FRICTION}\n"
    return own, sub


def script(pair, bond=None, overlay=False, newton="on", first=0, made=0):
    """From step `first` on; the bond is there from step `made` on."""
    text = HEAD.format(newton=newton, special=OVERLAID if overlay else BONDED, first=first) + pair
    make = ""
    if bond:
        text += f"bond_style {bond} smooth no overlay/pair {'yes' if overlay else 'no'}\nbond_coeff 1 {BONDS[bond]}\n"
        make = "create_bonds single/bond 1 1 2 special yes\n"
        if made:
            make = f"run {made}\n{make}"
    return text + RUN + make + f"run {STEPS - first - made}\n"


class Bonds(unittest.TestCase):
    def setUp(self):
        found = run("atom_style bpm/sphere\n")
        if "package which is not enabled" in found.stdout + found.stderr:
            self.skipTest("this LAMMPS was built without its package BPM")

    def assert_same(self, found, expected, tolerance=1e-11):
        """Positions pass through the periodic box, so that overlaps of 0.01 have the rounding of 1."""
        self.assertEqual(found.shape, expected.shape)
        largest = np.abs(expected).max()
        self.assertGreater(largest, 10)
        self.assertLessEqual(np.abs(found - expected).max() / largest, tolerance)

    def pairs(self):
        for law in LAWS:
            for style in styles(law)[:2 if IN_LAMMPS else 1]:
                yield law, style

    def test_contact_begins_anew_when_a_bond_breaks(self):
        broken = int(np.argmax(stretches() > LENGTH * STRAIN))
        self.assertGreater(0.03 - stretches()[broken], 0.01)
        self.assertGreater(0.03 - stretches()[:broken].min(), 0.039)
        for law, pair in self.pairs():
            free = forces(script(styles(law)[0]))
            # the step of the set-up does not count as one of a contact
            anew = forces(script(styles(law)[0], first=broken))
            for bond in BONDS:
                for newton, ranks in (("on", 1), ("off", 2)):
                    with self.subTest(law=law, pair=pair.split("\n")[0], bond=bond, newton=newton):
                        text = script(pair, bond, newton=newton)
                        if ranks > 1:
                            text = text.replace("create_box", "processors 2 1 1\ncreate_box")
                        found = forces(text, ranks)
                        self.assert_same(found[:, 3], free[:, 3])
                        self.assert_same(found[:broken, 1], STIFFNESS * stretches()[:broken])
                        self.assertEqual(found[broken, 1], 0)
                        self.assert_same(found[broken + 1:, 1], anew[1:, 1])
                        self.assert_same(found[:, 2], -found[:, 1] - found[:, 3])
            # contacts that had gone on since the beginning would be another thing
            self.assertGreater(np.abs(free[broken + 1:broken + 20, 1] - anew[1:20, 1]).max(), 50)
            self.assertTrue((anew[1:, 1] == 0).any() and (anew[1:, 1] > 20).any() and (anew[1:, 1] < -20).any())

    def test_overlaid_contacts_act_beside_the_bond(self):
        broken = int(np.argmax(stretches() > LENGTH * STRAIN))
        of_bond = np.where(np.arange(STEPS + 1) < broken, STIFFNESS * stretches(), 0)
        for law, pair in self.pairs():
            free = forces(script(styles(law)[0]))
            for bond in BONDS:
                with self.subTest(law=law, pair=pair.split("\n")[0], bond=bond):
                    found = forces(script(pair, bond, overlay=True))
                    self.assert_same(found[:, 1], free[:, 1] + of_bond)
                    self.assert_same(found[:, 3], free[:, 3])

    def test_a_bond_keeps_what_its_contact_remembers(self):
        """A bond made between particles that touch: the contact rests, and goes on when the bond breaks."""
        made = 75    # after the largest overlap
        lengths = LENGTH + stretches()
        broken = made + int(np.argmax(lengths[made:] > lengths[made] * (1 + STRAIN)))
        self.assertGreater(lengths[made:broken].min(), lengths[:made].min() + 1e-3)
        for law, pair in self.pairs():
            free = forces(script(styles(law)[0]))
            with self.subTest(law=law, pair=pair.split("\n")[0]):
                found = forces(script(pair, "bpm/spring", made=made))
                found = np.delete(found, made, 0)    # both runs print the step in which the first ends
                self.assert_same(found[made:broken, 1], STIFFNESS * (lengths - lengths[made])[made:broken])
                self.assertEqual(found[broken, 1], 0)
                self.assert_same(found[broken + 1:, 1], free[broken + 1:, 1])


if __name__ == "__main__":
    unittest.main()
