# SPDX-License-Identifier: GPL-2.0-only
"""scripts/wear_to_vtk.py: a run's wear as it comes out in the files for ParaView."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(os.environ["EEPA_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "scripts"))

try:
    import meshio
    import wear_to_vtk
except ImportError:
    meshio = None

# a plate of two triangles, one without area between them
STL = """solid plate
facet normal 0 0 1
outer loop
vertex -2 -2 0
vertex 2 -2 0
vertex 2 2 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 1 0
vertex 2 2 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex -2 -2 0
vertex 2 2 0
vertex -2 2 0
endloop
endfacet
endsolid plate
"""

# a sphere slides over the second half of the plate
IN_FILE = """units lj
atom_style sphere
boundary f f f
comm_modify vel yes
region box block -3 3 -3 3 -1 3
create_box 1 box
create_atoms 1 single -1 0.5 0.49
set group all diameter 1 density 1.9098593
velocity all set 1 0 0
pair_style zero 1.0
pair_coeff * *
neighbor 0.3 bin
fix w all wall/gran/eepa linear coeff 1e4 1e4 0 0 0.5 wall mesh plate.stl faces 50
# behind the wall: nothing changes the motion
fix hold all setforce 0 0 0
fix move all nve
timestep 1e-3
dump wear all local 50 wear.dump f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] f_w[6]
run 100
"""


@unittest.skipUnless(meshio, "meshio is not installed")
class Wear(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "plate.stl").write_text(STL)

    def test_of_a_sliding_sphere_is_drawn(self):
        (self.folder / "in.slide").write_text(IN_FILE)
        subprocess.run([os.environ["EEPA_LMP"], "-in", "in.slide", "-log", "none"],
                       cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        out = str(self.folder / "wear")
        subprocess.run([sys.executable, ROOT / "scripts/wear_to_vtk.py", self.folder / "plate.stl",
                        self.folder / "wear.dump", out, "--offset", "0", "0", "5"], check=True,
                       stdout=subprocess.DEVNULL)
        mesh = meshio.read(f"{out}_100.vtu")
        self.assertEqual(mesh.points[:, 2].tolist(), [5.0] * len(mesh.points))
        data = {name: values[0] for name, values in mesh.cell_data.items()}
        # an overlap of 0.01 presses with 100 over an area of 8, and slides by 0.1 in all
        np.testing.assert_allclose(data["area"], [8, np.nan, 8])
        np.testing.assert_allclose(data["pressure"], [0, np.nan, 100 / 8], rtol=1e-12)
        np.testing.assert_allclose(data["sliding"], [0, np.nan, 100 * 0.1 / 8], rtol=1e-9)
        np.testing.assert_allclose(data["impact"], [0, np.nan, 0])
        self.assertLessEqual(data["shear"][2], 0.5 * 100 / 8 * (1 + 1e-12))
        self.assertGreater(data["shear"][2], 0)
        self.assertIn('timestep="50"', (self.folder / "wear.pvd").read_text())

    def test_names_what_does_not_fit(self):
        dump = self.folder / "wear.dump"
        head = "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS ff ff ff\n" \
            "0 1\n0 1\n0 1\nITEM: ENTRIES "
        for text, message in ((head + "a b\n1 2\n", "step 7 has 2 columns, 6 are needed"),
                              (head + "a b c d e f\n4 1 1 1 1 1\n", "has 3"),
                              ("", "no step in this file")):
            dump.write_text(text)
            with self.assertRaisesRegex(ValueError, message):
                wear_to_vtk.write(str(self.folder / "plate.stl"), str(dump),
                                  str(self.folder / "out"))

    def test_points_are_placed_as_the_fix_does(self):
        points = wear_to_vtk.transformed(np.array([[1.0, 2.0, 3.0]]), 2.0, (0, 0, 5, 90), (1, 1, 1))
        np.testing.assert_allclose(points, [[-3, 3, 7]], atol=1e-14)


if __name__ == "__main__":
    unittest.main()
