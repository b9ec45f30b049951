# SPDX-License-Identifier: GPL-2.0-only
"""The parts of run_benchmarks.py, a module each."""
