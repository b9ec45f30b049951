# SPDX-License-Identifier: GPL-2.0-only
"""How coarse may the particles of a simulation be? See README.md beside this package."""
