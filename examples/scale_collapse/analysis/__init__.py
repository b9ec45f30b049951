# SPDX-License-Identifier: GPL-2.0-only
"""What the studies of this folder make of their tables of runs: means, deviations, fits, figures."""
