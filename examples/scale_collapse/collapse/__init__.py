# SPDX-License-Identifier: GPL-2.0-only
"""The study of scale_collapse: its runs, the curves that they leave and the report on them."""
