# SPDX-License-Identifier: GPL-2.0-only
"""Two particles that meet and part with sqrt(k1/k2) of their speed, for tests of how a LAMMPS gets its styles."""

SETUP = """units si
atom_style sphere
atom_modify map array
boundary f f f
region box block -2 2 -2 2 -2 2
create_box 1 box
comm_modify vel yes
create_atoms 1 single -0.505 0 0
create_atoms 1 single 0.505 0 0
set group all diameter 1 density 1.9098593171027440
set atom 1 vx 1
pair_style gran/eepa linear
pair_coeff 1 1 1e4 4e4 0 0 0
fix integrate all nve/sphere
timestep 1e-5
variable e equal vx[2]-vx[1]
"""
