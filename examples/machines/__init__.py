# SPDX-License-Identifier: GPL-2.0-only
"""What the examples silo, drum, shear_cell and die share: meshes, tables, runs and pictures."""
