# SPDX-License-Identifier: GPL-2.0-only
"""Sub-models eepa and luding of pair_style granular and fix wall/gran against pair_style gran/eepa and fix
wall/gran/eepa, with prescribed motion, so that all see the same positions and velocities. Needs a LAMMPS with
package EEPA in it."""

import tempfile
import unittest

import numpy as np
from sub_model_runs import IN_LAMMPS, LAWS, NO_FRICTION, forces, run

# The overlap goes up and down through all branches, opens and closes. The pair drifts through the box and so
# from one process to the other.
HEAD = """units lj
atom_style sphere
atom_modify map array
newton {newton}
boundary p p f
comm_modify vel yes
region box block -5 5 -2 2 -2 2
create_box 2 box
"""
SPHERES = """create_atoms {types[0]} single -1.5 0 {z}
create_atoms {types[1]} single {x2} 0 {z}
set atom 1 diameter {d[0]}
set atom 2 diameter {d[1]}
set atom * density 1.9
"""
RUN = """neighbor 0.05 bin
neigh_modify every 5 delay 0 check no
variable t equal step*dt
variable drift equal 2*v_t
variable vdrift equal 2
variable s equal {size}
variable gap equal -v_s*(0.012+0.010*sin(30*v_t)+0.006*sin(83*v_t))
variable vgap equal -v_s*(0.30*cos(30*v_t)+0.498*cos(83*v_t))
variable x2 equal v_gap+v_drift
variable vx2 equal v_vgap+v_vdrift
variable y2 equal {slide}*v_t
variable vy2 equal {slide}
{move}
variable fx equal fx[{watched}]
variable fy equal fy[{watched}]
variable fz equal fz[{watched}]
timestep 1e-3
thermo 1
thermo_style custom step v_fx v_fy v_fz
thermo_modify format float %.17g norm no
"""
MOVE_PAIR = """group one id 1
group two id 2
fix m1 one move variable v_drift NULL NULL v_vdrift NULL NULL
fix m2 two move variable v_x2 v_y2 NULL v_vx2 v_vy2 NULL
"""
MOVE_AT_WALL = "fix m all move variable NULL NULL v_gap NULL NULL v_vgap\n"


def pair_script(style, d=(1.0, 1.0), types=(1, 1), newton="on", slide=0, swap=False, steps=900, after=""):
    z, size = 0.3, 0.5 * sum(d)
    head = HEAD.format(newton=newton) + SPHERES.format(types=types, d=d, z=z, x2=repr(-1.5 + size))
    move = MOVE_PAIR
    if swap:    # the second particle to the left of the first
        head = HEAD.format(newton=newton) + SPHERES.format(types=types, d=d, z=z, x2=repr(-1.5 - size))
        move = move.replace("v_x2 ", "v_x3 ").replace("v_vx2 ", "v_vx3 ")
        move = "variable x3 equal -v_gap+v_drift\nvariable vx3 equal -v_vgap+v_vdrift\n" + move
    return head + style + "\n" + RUN.format(size=size, slide=slide, move=move, watched=2) + f"run {steps}\n" + after


def wall_script(fix, d=1.0, steps=900):
    head = HEAD.format(newton="on") + f"create_atoms 1 single 0 0 {-2 + 0.5 * d!r}\nset atom 1 diameter {d} density 1.9\n"
    return (head + "pair_style zero 2.0\npair_coeff * *\n" + RUN.format(size=d, slide=0, move=MOVE_AT_WALL, watched=1) +
            fix + f"\nrun {steps}\n")


@unittest.skipUnless(IN_LAMMPS, "sub-models are only in a LAMMPS that has package EEPA in its source tree")
class SubModels(unittest.TestCase):
    def assert_same(self, found, expected, tolerance=1e-14):
        self.assertEqual(found.shape, expected.shape)
        largest = np.abs(expected[:, 1:]).max()
        self.assertGreater(largest, 10)
        self.assertLessEqual(np.abs(found - expected).max() / largest, tolerance)

    def branches(self, expected, column=1):
        """The motion is a test only if it pushes, pulls and opens."""
        force = expected[:, column]
        self.assertTrue((force > 20).any() and (force < -20).any() and (force == 0).any())

    def both(self, law, d=(1.0, 1.0), scale="NULL", damping=0, **options):
        model, name, numbers = LAWS[law]
        sub = pair_script(f"pair_style granular\npair_coeff * * {model} {damping} {scale} damping velocity {NO_FRICTION}",
                          d, **options)
        scaled = "" if scale == "NULL" else f"scale {scale}"
        own = pair_script(f"pair_style gran/eepa {name} {scaled} dtcheck off\npair_coeff * * {numbers} kt 0 "
                          f"viscous {damping} 0", d, **options)
        return sub, own

    def test_pair_has_the_forces_of_gran_eepa(self):
        for law in LAWS:
            for d in ((1.0, 1.0), (1.0, 0.5)):
                for scale in ("NULL", 0.75):
                    for damping in ((0, 3) if scale == "NULL" else (0,)):
                        with self.subTest(law=law, d=d, scale=scale, damping=damping):
                            sub, own = (forces(s) for s in self.both(law, d, scale, damping))
                            self.branches(own)
                            self.assert_same(sub, own)

    def test_pair_may_exchange_its_particles_and_change_processes(self):
        for law in LAWS:
            expected = forces(self.both(law)[1])
            for swap in (False, True):
                for newton in ("on", "off"):
                    with self.subTest(law=law, swap=swap, newton=newton):
                        sub, own = self.both(law, swap=swap, newton=newton)
                        found = forces(sub.replace("create_box", "processors 2 1 1\ncreate_box"), ranks=2)
                        if swap:
                            found[:, 1] *= -1
                        # the positions of periodic images and of a pair turned round are rounded otherwise
                        self.assert_same(found, expected, 1e-10)

    def test_restart_in_mid_cycle_goes_on(self):
        for law in LAWS:
            with self.subTest(law=law), tempfile.TemporaryDirectory() as folder:
                sub = self.both(law)[0]
                whole = forces(sub)
                # a step in which the pair remembers more than its overlap
                stop, file = 290, f"{folder}/half.restart"
                first = sub.replace("run 900", f"run {stop}\nwrite_restart {file}")
                forces(first)
                begin, end = sub.index("units lj"), sub.index("neighbor 0.05")
                second = (sub[:begin] + f"read_restart {file}\ncomm_modify vel yes\n" + sub[end:]).replace("run 900", f"run {900 - stop}")
                self.assert_same(forces(second)[1:], whole[stop + 1:], 1e-13)

    def test_wall_has_the_forces_of_wall_gran_eepa(self):
        for law, (model, name, numbers) in LAWS.items():
            for d in (1.0, 0.5):
                for scale in ("NULL", 0.75):
                    with self.subTest(law=law, d=d, scale=scale):
                        scaled = "" if scale == "NULL" else f"scale {scale}"
                        sub = forces(wall_script(f"fix w all wall/gran granular {model} 0 {scale} damping velocity "
                                                 f"{NO_FRICTION} zplane -2 NULL", d))
                        own = forces(wall_script(f"fix w all wall/gran/eepa {name} {scaled} dtcheck off coeff {numbers} "
                                                 "kt 0 wall zplane -2 NULL", d))
                        self.branches(own, 3)
                        self.assert_same(sub, own)

    def test_types_are_mixed_as_those_of_gran_eepa(self):
        other = {"eepa": ("eepa 2e4 3e4 0.5e4 -2", "2e4 3e4 0.5e4 -2 0"),
                 "luding": ("luding 2e4 3e4 0.5e4 -2 0.05", "2e4 3e4 0.5e4 -2 0 depth 0.05")}
        for law, (model, name, numbers) in LAWS.items():
            with self.subTest(law=law):
                end = f"0 NULL damping velocity {NO_FRICTION}"
                sub = f"pair_style granular\npair_coeff 1 1 {model} {end}\npair_coeff 2 2 {other[law][0]} {end}"
                own = (f"pair_style gran/eepa {name} dtcheck off\npair_coeff 1 1 {numbers} kt 0\n"
                       f"pair_coeff 2 2 {other[law][1]} kt 0")
                self.assert_same(*(forces(pair_script(style, types=(1, 2))) for style in (sub, own)))

    def test_friction_has_the_bound_of_gran_eepa(self):
        """Steady sliding at a rising and falling overlap: the tangential force is at its bound."""
        for law, (model, name, numbers) in LAWS.items():
            with self.subTest(law=law):
                sub = f"pair_style granular\npair_coeff * * {model} 0 NULL damping velocity tangential linear_history 1e7 0 0.5"
                own = f"pair_style gran/eepa {name} dtcheck off\npair_coeff * * {numbers.replace('-5 0', '-5 0.5')} kt 1e7"
                sub, own = (forces(pair_script(style, slide=0.01, steps=100)) for style in (sub, own))
                self.assertGreater(np.abs(own[20:, 2]).min(), 5)
                self.assert_same(sub[20:], own[20:], 1e-6)

    def test_heat_and_other_models_of_granular_go_with_them(self):
        for law, (model, _, _) in LAWS.items():
            with self.subTest(law=law):
                script = pair_script(f"pair_style granular\npair_coeff * * {model} 0 NULL damping velocity tangential "
                                     "linear_history 1e4 0 0.5 rolling sds 10 0.1 0.2 twisting marshall heat area 10",
                                     steps=100)
                script = script.replace("create_atoms", "fix p all property/atom temperature heatflow ghost yes\n"
                                        "create_atoms", 1)
                script = script.replace("group two", "set atom 1 temperature 100\nset atom 2 temperature 0\n"
                                        "fix h all heat/flow constant 1\ncompute t all property/atom temperature\n"
                                        "compute s all reduce sum c_t\ncompute m all reduce max c_t\ngroup two")
                script = script.replace("v_fx v_fy v_fz", "v_fx c_s c_m")
                rows = forces(script)
                self.assertTrue((np.abs(rows[:, 2] - 100) < 1e-10).all())
                self.assertTrue((np.diff(rows[:, 3]) <= 0).all())
                self.assertLess(rows[-1, 3], 99.9)

    def refused(self, style, words):
        done = run(pair_script("pair_style granular\npair_coeff * * " + style, steps=0))
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stdout + done.stderr, words)

    def test_wrong_numbers_are_refused_by_name(self):
        end = f"damping velocity {NO_FRICTION}"
        self.refused(f"eepa 1e4 5e3 0 0 0 NULL {end}", "model eepa: k2 = 5000.* >= k1")
        self.refused(f"eepa 1e4 2e4 -3 0 0 NULL {end}", "model eepa: k_adh = -3")
        self.refused(f"eepa 1e4 2e4 0 3 0 NULL {end}", "model eepa: f0 = 3")
        self.refused(f"eepa 1e4 2e4 0 0 -3 NULL {end}", "model eepa: damping = -3.*>= 0")
        self.refused(f"eepa 1e4 2e4 0 0 0 0 {end}", "model eepa: scale d_ref = 0")
        self.refused(f"luding 1e4 2e4 0 0 1.5 0 NULL {end}", "model luding: depth = 1.5.*<= 1")
        self.refused(f"luding 1e4 1e4 0 0 0.1 0 NULL {end}", "model luding: .*k2")

    def test_dampings_of_elastic_contacts_are_refused(self):
        self.refused(f"eepa 1e4 2e4 0 0 0.5 NULL damping coeff_restitution {NO_FRICTION}", "cohesive normal model, eepa")
        self.refused(f"eepa 1e4 2e4 0 0 0.5 NULL damping tsuji {NO_FRICTION}", "cohesive normal model, eepa")
        self.refused(f"eepa 1e4 2e4 0 0 0.5 NULL limit_damping {NO_FRICTION}", "cohesive normal model, eepa")


if __name__ == "__main__":
    unittest.main()
