# SPDX-License-Identifier: GPL-2.0-only
"""The compact formulas of docs/theory, written here as the pages have them, against the tables that the kernel
is held to (tests/oracle), and against each other where a page derives one from another."""
import csv
import math
import unittest
from pathlib import Path

import numpy as np

TABLES = sorted((Path(__file__).resolve().parents[1] / "oracle" / "tables").glob("normal_*.csv"))


def read(path):
    """Parameters of a table, scaled to its contact as docs/theory/scaling.rst has it, and its rows."""
    lines = path.read_text(encoding="utf-8").splitlines()
    given = dict(line[2:].split() for line in lines if line.startswith("#"))
    p = {name: float(given[name]) for name in ("n", "k1", "k2", "k_adh", "f0", "mu")}
    p.update(law=given["law"], bound=given.get("bound", "adhesive"), depth=float(given.get("depth", "0")
                                                                                 .replace("none", "0")))
    radii = float(given["R_i"]), float(given["R_j"])
    s = 1.0 if given["d_ref"] == "none" else sum(radii) / float(given["d_ref"])
    for name in ("k1", "k2", "k_adh"):
        p[name] *= s**(2.0 - p["n"])
    p["f0"] *= s**2
    p["R*"] = radii[0] * radii[1] / sum(radii)
    return p, list(csv.DictReader(line for line in lines if not line.startswith("#")))


def normal(p, delta, m):
    """Force and what the contact then remembers (normal.rst)."""
    n, k1, k2, k_adh, f0 = (p[name] for name in ("n", "k1", "k2", "k_adh", "f0"))
    if p["law"] == "plateau":
        m = max(m, delta)
        line, pull = k2 * (delta - k1 / k2 * m), -k_adh * k1 / k2 * m
        return (pull if line <= pull else f0 + min(k1 * delta, line)), m
    if p["law"] == "luding":
        limit = k2 / (k2 - k1) * p["depth"] * 2.0 * p["R*"]
        h = (k2 - k1) / limit
        m = max(m, min(delta, limit))
        line = k1 * delta + h * m * (delta - m)
        if line <= -k_adh * delta:
            m = max(np.roots([h, -h * delta, -(k1 + k_adh) * delta]))
        return f0 + max(-k_adh * delta, line), m
    m = max(m, delta)
    line = k2 * (delta**n - (1.0 - k1 / k2) * m**n)
    if line <= -k_adh * delta**n * (1.0 - 1e-12) and k2 > k1:
        m = ((k2 + k_adh) / (k2 - k1))**(1.0 / n) * delta
    return f0 + max(-k_adh * delta**n, min(k1 * delta**n, line)), m


def bound(p, force, delta, m):
    """Largest friction (contact.rst)."""
    if p["bound"] == "contact":
        return p["mu"] * max(force, 0.0)
    if p["law"] == "plateau":
        return max(p["mu"] * (force + p["k_adh"] * p["k1"] / p["k2"] * m) - p["f0"], 0.0)
    return max(p["mu"] * (force + p["k_adh"] * delta**p["n"] - p["f0"]), 0.0)


def stored(p, delta, m):
    """Energy of linear and luding (energy.rst)."""
    n, k1, k2 = p["n"], p["k1"], p["k2"]
    if p["law"] == "luding":
        kappa = k1 + (k2 - k1) * m / (k2 / (k2 - k1) * p["depth"] * 2.0 * p["R*"])
        return 0.5 * kappa * (delta - (1.0 - k1 / kappa) * m)**2 + p["f0"] * delta
    plastic = (1.0 - k1 / k2)**(1.0 / n) * m
    return k2 * ((delta**(n + 1) - plastic**(n + 1)) / (n + 1) - plastic**n * (delta - plastic)) + p["f0"] * delta


class Theory(unittest.TestCase):
    def test_normal_force_friction_bound_and_energy(self):
        self.assertGreater(len(TABLES), 10)
        for path in TABLES:
            p, rows = read(path)
            m = 0.0
            largest = {name: max(abs(float(row[name])) for row in rows if float(row["delta"]) > 0.0)
                       for name in ("f_hys", "delta_max", "bound", "energy")}
            for number, row in enumerate(rows):
                delta = float(row["delta"])
                if delta <= 0.0:
                    m = 0.0
                    continue
                force, m = normal(p, delta, m)
                found = {"f_hys": force, "delta_max": m, "bound": bound(p, force, delta, m)}
                if p["law"] != "plateau":
                    found["energy"] = stored(p, delta, m)
                for name, value in found.items():
                    with self.subTest(table=path.name, row=number, quantity=name):
                        self.assertAlmostEqual(value / (largest[name] or 1.0), float(row[name]) / (largest[name] or 1.0),
                                               delta=1e-10)

    def test_loss_is_restitution(self):
        k1, k2, k_adh, d = 5e3, 1.1e4, 2e3, 1.0
        onset = d * (k2 - k1) / (k2 + k_adh)
        loading = 0.5 * k1 * (1.0 - k1 / k2) * d**2
        adhesive = 0.5 * k_adh * (1.0 + k_adh / k2) * onset**2
        published = k1 / k2 - k_adh / k1 * (k2 - k1)**2 / (k2 * (k2 + k_adh))
        self.assertAlmostEqual(1.0 - (loading + adhesive) / (0.5 * k1 * d**2), published, places=14)

    def test_dashpot(self):
        for e in (0.1, 0.5, 0.9):
            b = math.sqrt(4.0 / (1.0 + (math.pi / math.log(e))**2))
            zeta = b / 2.0
            self.assertAlmostEqual(math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2)), e, places=13)


if __name__ == "__main__":
    unittest.main()
