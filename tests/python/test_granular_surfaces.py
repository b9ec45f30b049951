# SPDX-License-Identifier: GPL-2.0-only
"""Sub-models eepa and luding with fix surface/global of LAMMPS's package GRANSURF, whose triangles are read from an STL
file: a sphere with prescribed motion on a plane, which fix wall/gran/eepa has as a plane or a mesh, and over a ridge."""

import math
import tempfile
import unittest

import numpy as np

from sub_model_runs import IN_LAMMPS, LAWS, NO_FRICTION, forces, run

FLOOR = -1.5
HEAD = """units lj
atom_style sphere
atom_modify map array
boundary p p f
comm_modify vel yes
region box block -5 5 -5 5 -2 2
create_box 2 box
create_atoms {type} single -1.5 {y} {z}
set atom 1 diameter {d} density 1.9
"""
# Within each rebuild of the neighbour list the sphere comes over other triangles.
RUN = """pair_style zero 2.0
pair_coeff * *
neighbor 0.1 bin
neigh_modify every 5 delay 0 check no
timestep 1e-3
variable t equal step*dt
variable along equal 2*v_t
variable valong equal 2
variable across equal {drift}*v_t
variable vacross equal {drift}
variable up equal {up}
variable vup equal {vup}
fix m all move variable v_along v_across v_up v_valong v_vacross v_vup
variable fx equal fx[1]
variable fy equal fy[1]
variable fz equal fz[1]
thermo 1
thermo_style custom step v_fx v_fy v_fz
thermo_modify format float %.17g norm no
"""
# The overlap goes up and down through all branches, opens and closes.
CYCLES = {"up": "-{d}*(0.012+0.010*sin(30*v_t)+0.006*sin(83*v_t))", "vup": "-{d}*(0.30*cos(30*v_t)+0.498*cos(83*v_t))"}


def stl(triangles):
    lines = ["solid"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x!r} {y!r} {z!r}" for x, y, z in triangle),
                  "endloop", "endfacet"]
    return "\n".join([*lines, "endsolid", ""])


def sheet(height, side=0.7, cells=12):
    """Squares of two triangles each over the box; height(x) in lines along y."""
    places = [side * (i - 0.5 * cells) for i in range(cells + 1)]
    triangles = []
    for x0, x1 in zip(places, places[1:]):
        for y0, y1 in zip(places, places[1:]):
            a, b, c, e = ((x, y, height(x)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)))
            triangles += [(a, b, c), (a, c, e)]
    return stl(triangles)


# The sphere is pressed to 0.029 before it comes over the ridge, where it is drawn back to 0.009, and released after it.
RIDGE, SLOPE = -0.7, math.tan(math.radians(2.5))
OVER = {"up": f"-{SLOPE!r}*sqrt((v_along-1.5-({RIDGE}))^2)-0.03*sin(6*v_t)+0.011*exp(0-((v_t-0.4)/0.1)^2)", "vup": "0"}
FLAT = {"floor.stl": sheet(lambda x: FLOOR)}
BENT = {"floor.stl": sheet(lambda x: FLOOR - SLOPE * abs(x - RIDGE))}


def surface(law, scale="NULL", damping=0, more=""):
    """The fix; all types of particles and surfaces."""
    return (f"fix w all surface/global input stl 1 1 floor.stl model * * granular {LAWS[law][0]} {damping} {scale} "
            f"damping velocity {NO_FRICTION} {more}\n")


def wall(law, scale="NULL", damping=0, shape=f"zplane {FLOOR} NULL"):
    _, name, numbers = LAWS[law]
    scaled = "" if scale == "NULL" else f"scale {scale}"
    return f"fix w all wall/gran/eepa {name} {scaled} dtcheck off coeff {numbers} kt 0 viscous {damping} 0 wall {shape}\n"


def script(fix, d=1.0, y=0.13, drift=0.3, steps=900, motion=CYCLES, type=1):
    size = {name: text.format(d=d) for name, text in motion.items()}
    return (HEAD.format(d=d, y=y, z=repr(FLOOR + 0.5 * d), type=type) + RUN.format(drift=drift, **size) + fix +
            f"run {steps}\n")


@unittest.skipUnless(IN_LAMMPS, "sub-models are only in a LAMMPS that has package EEPA in its source tree")
class Surfaces(unittest.TestCase):
    def setUp(self):
        found = run("units lj\natom_style sphere\nregion r block 0 1 0 1 0 1\ncreate_box 1 r\nfix w all surface/global\n")
        words = found.stdout + found.stderr
        if "Unrecognized fix style" in words:
            self.skipTest("this LAMMPS has no fix surface/global: it came after 4 Feb 2025, in package GRANSURF")
        self.assertIn("surface/global", words)

    def assert_same(self, found, expected, tolerance=1e-12):
        self.assertEqual(found.shape, expected.shape)
        largest = np.abs(expected[:, 1:]).max()
        self.assertGreater(largest, 10)
        self.assertLessEqual(np.abs(found - expected).max() / largest, tolerance)

    def branches(self, force):
        """The motion is a test only if it pushes, pulls and opens."""
        self.assertTrue((force > 20).any() and (force < -20).any() and (force == 0).any())

    def test_flat_surface_has_the_forces_of_a_plane(self):
        for law in LAWS:
            for d in (1.0, 0.5):
                for scale, damping in (("NULL", 0), ("NULL", 3), (0.75, 0)):
                    with self.subTest(law=law, d=d, scale=scale, damping=damping):
                        own = forces(script(wall(law, scale, damping), d))
                        self.branches(own[:, 3])
                        self.assert_same(forces(script(surface(law, scale, damping), d), files=FLAT), own)

    def test_contact_goes_on_across_edges_corners_and_processes(self):
        own = forces(script(wall("eepa")))
        for y, drift in ((0.0, 0.0), (0.35, 0.0), (-0.2, 1.1), (0.6, 2.0)):
            for ranks in (1, 2):
                with self.subTest(y=y, drift=drift, ranks=ranks):
                    text = script(surface("eepa"), y=y, drift=drift)
                    if ranks > 1:
                        text = text.replace("create_box", "processors 2 1 1\ncreate_box")
                    self.assert_same(forces(text, ranks, FLAT), own)

    def test_contact_goes_on_across_edges_within_keyword_flat(self):
        """As on a wall of the same file, whose keyword is smooth."""
        for law in LAWS:
            with self.subTest(law=law):
                own = forces(script(wall(law, shape="mesh floor.stl smooth 10"), motion=OVER, steps=600), files=BENT)
                found = forces(script(surface(law, more="flat 10"), motion=OVER, steps=600), files=BENT)
                self.assertGreater(own[250, 3], 200)
                self.assertLess(own[400, 3], 0)
                normal = [np.copysign(np.hypot(rows[:, 1], rows[:, 3]), rows[:, 3]) for rows in (found, own)]
                self.assert_same(*(np.column_stack([own[:, 0], force]) for force in normal))

    def test_restart_in_mid_cycle_goes_on(self):
        whole = forces(script(surface("eepa")), files=FLAT)
        stop = 290
        with tempfile.TemporaryDirectory() as folder:
            file = f"{folder}/half.restart"
            text = script(surface("eepa"))
            forces(text.replace("run 900", f"run {stop}\nwrite_restart {file}"), files=FLAT)
            begin, end = text.index("units lj"), text.index("pair_style")
            text = text[:begin] + f"read_restart {file}\ncomm_modify vel yes\n" + text[end:]
            found = forces(text.replace("run 900", f"run {900 - stop}"), files=FLAT)
        self.assert_same(found[1:], whole[stop + 1:])


if __name__ == "__main__":
    unittest.main()
