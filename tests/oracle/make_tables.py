#!/usr/bin/env python3
"""Write the tables that tests/kernel/test_oracle.cpp replays through the kernel.

    /usr/bin/python3 tests/oracle/make_tables.py [folder]

Long random loading paths through reference_law.py: normal_*.csv (overlap alone) and full_*.csv
(normal, overlap, velocities and spins at random). Same seed, same tables. Inputs are rounded to
short decimals and written so that they read back exactly; results with 17 digits. A row whose
overlap is not positive ends the contact: its history is forgotten and nothing is compared.
"""

import os
import sys

import numpy as np

import reference_law as law

NORMAL_ROWS = 110
FULL_ROWS = 38

# The article's parameters, then ones chosen to reach every branch.
ARTICLE = dict(k1=5e3, k2=1e4, k_adh=5e3)
NORMAL = [
    dict(law="plateau", **ARTICLE),
    dict(law="plateau", **ARTICLE, f0=-0.05),
    dict(law="plateau", k1=700.0, k2=3100.0, k_adh=900.0, f0=-0.013, mu=0.3),
    dict(law="plateau", k1=700.0, k2=3100.0, k_adh=0.0, d_ref=7e-4),
    dict(law="linear", **ARTICLE),
    dict(law="linear", **ARTICLE, f0=-0.05, d_ref=2e-3),
    dict(law="linear", k1=800.0, k2=1000.0, k_adh=4000.0, f0=-0.02, mu=0.25),
    dict(law="linear", k1=800.0, k2=800.0, k_adh=100.0),
    dict(law="linear", k1=800.0, k2=9000.0, k_adh=0.0),
    dict(law="linear", n=1.5, k1=2e5, k2=5e5, k_adh=3e5, f0=-0.03, kt=3e3),
    dict(law="linear", n=1.5, k1=2e5, k2=5e5, k_adh=3e5, f0=-0.03, kt=3e3, d_ref=5e-4),
    dict(law="linear", n=1.25, k1=4e4, k2=1e5, k_adh=5e4, kt=3e3),
    dict(law="linear", n=2.0, k1=3e7, k2=5e7, k_adh=2e7, f0=-0.01, kt=3e3),
    dict(law="luding", k1=800.0, k2=9000.0, k_adh=0.0, depth=0.08, f0=-0.03),
    dict(law="luding", **ARTICLE, depth=0.05),
    dict(law="luding", k1=800.0, k2=3000.0, k_adh=1500.0, f0=-0.02, mu=0.25, depth=0.1, d_ref=2e-3),
    dict(law="luding", k1=500.0, k2=2e4, k_adh=1500.0, f0=-0.013, depth=0.08, d_ref=5e-4,
         bound="contact"),
    dict(law="linear", **ARTICLE, f0=-0.05, bound="contact"),
    dict(law="plateau", **ARTICLE, f0=-0.05, bound="contact", d_ref=2e-3),
]
FULL = [
    dict(law="plateau", **ARTICLE, f0=-0.05, restitution=0.4, rolling="constant", mu_r=0.05),
    dict(law="plateau", **ARTICLE, f0=-0.05, restitution=0.4, rolling="constant", mu_r=0.05,
         d_ref=3e-4),
    dict(law="plateau", k1=700.0, k2=3100.0, k_adh=900.0, B_n=0.02, B_t=0.01, mu=0.3,
         rolling="sds", k_r=300.0, g_r=0.002, mu_r=0.1, limit_damping=True),
    dict(law="linear", **ARTICLE, restitution=0.7),
    dict(law="linear", **ARTICLE, f0=-0.05, restitution=0.0, rolling="sds", k_r=400.0, g_r=0.003,
         mu_r=0.2, d_ref=2e-3, kt=900.0),
    dict(law="linear", k1=800.0, k2=1000.0, k_adh=4000.0, f0=-0.02, mu=0.25, B_n=0.03, B_t=0.02,
         d_ref=5e-4, rolling="constant", mu_r=0.01, limit_damping=True),
    dict(law="linear", k1=800.0, k2=800.0, mu=0.1, restitution=1.0),
    dict(law="linear", n=1.5, k1=2e5, k2=5e5, k_adh=3e5, f0=-0.03, kt=3e3, restitution=0.3,
         rolling="constant", mu_r=0.02),
    dict(law="linear", n=1.5, k1=2e5, k2=5e5, k_adh=3e5, f0=-0.03, kt=3e3, restitution=0.3,
         rolling="sds", k_r=500.0, g_r=0.004, mu_r=0.15, d_ref=7e-4, limit_damping=True),
    dict(law="linear", n=1.25, k1=4e4, k2=1e5, k_adh=5e4, kt=3e3, B_n=0.02, B_t=0.01, mu=0.0),
    dict(law="luding", **ARTICLE, f0=-0.05, restitution=0.4, rolling="constant", mu_r=0.05,
         depth=0.05),
    dict(law="luding", k1=700.0, k2=8e3, k_adh=3e3, B_n=0.02, B_t=0.01, mu=0.3, depth=0.04,
         d_ref=7e-4, rolling="sds", k_r=300.0, g_r=0.002, mu_r=0.1, bound="contact",
         limit_damping=True),
    dict(law="linear", **ARTICLE, f0=-0.05, restitution=0.4, rolling="sds", k_r=400.0, g_r=0.003,
         mu_r=0.2, bound="contact"),
    dict(law="plateau", **ARTICLE, f0=-0.05, restitution=0.6, d_ref=5e-4, bound="contact"),
]


def short(x):
    """Rounded to 6 digits, so that the inputs stay short and still read back exactly."""
    return float("%.6g" % x)


def exact(x):
    return repr(float(x))


def overlaps(rng, rows, size):
    """A random walk with long runs up and down; now and then the contact opens."""
    delta, target, rate = 0.0, 0.02 * size, 0.01
    for _ in range(rows):
        if abs(delta - target) < rate * size:
            target = size * rng.choice([rng.uniform(0.0, 0.1), rng.uniform(0.0, 0.03),
                                        rng.uniform(-0.004, 0.006)], p=[0.5, 0.3, 0.2])
            rate = 10.0 ** rng.uniform(-3.0, -1.7)
        delta += np.sign(target - delta) * rate * size * rng.uniform(0.2, 1.0)
        # Sometimes exactly the same overlap twice: delta = delta_max is `loading`.
        yield short(delta)
        if rng.uniform() < 0.05:
            yield short(delta)


def header(p, **geometry):
    # Parameters at their defaults are left out, so that the older tables do not change.
    pairs = {name: v for name, v in {**p, **geometry}.items()
             if name not in ("depth", "bound") or v != law.DEFAULTS[name]}
    pairs["kt"] = p["kt"] if p["kt"] is not None else "default"
    return "".join(
        f"# {name} {exact(v) if isinstance(v, float) else ('none' if v is None else v)}\n"
        for name, v in pairs.items())


def g17(*values):
    return ",".join("%.17g" % x for x in values)


def write_normal(path, p, rng):
    R_i, R_j = short(rng.uniform(3e-4, 9e-4)), short(rng.uniform(3e-4, 9e-4))
    q = law.scaled(p, R_i, R_j)
    delta_max = 0.0
    with open(path, "w") as out:
        out.write(header(p, R_i=R_i, R_j=R_j))
        out.write("delta,branch,f_hys,delta_max,bound,energy\n")
        for delta in overlaps(rng, NORMAL_ROWS, R_i + R_j):
            if delta <= 0.0:
                delta_max = 0.0
                out.write(f"{exact(delta)},open\n")
                continue
            f, branch, delta_max = law.hysteretic(q, delta, delta_max)
            out.write(f"{exact(delta)},{branch},"
                      + g17(f, delta_max, law.friction_bound(q, f, delta, delta_max),
                            law.elastic_energy(q, delta, delta_max)) + "\n")


def random_vector(rng, size):
    return np.array([short(x) for x in size * rng.normal(size=3)])


def write_full(path, p, rng, wall):
    R_i, m_i = short(rng.uniform(3e-4, 9e-4)), short(10.0 ** rng.uniform(-7.0, -5.5))
    R_j, m_j = (None, None) if wall else (short(rng.uniform(3e-4, 9e-4)),
                                          short(10.0 ** rng.uniform(-7.0, -5.5)))
    state = law.fresh()
    direction = rng.normal(size=3)
    v = rng.normal(size=3)
    size = 2.0 * R_i if wall else R_i + R_j
    with open(path, "w") as out:
        out.write(header(p, R_i=R_i, R_j=R_j, m_i=m_i, m_j=m_j))
        out.write("dt,nx,ny,nz,delta,vix,viy,viz,vjx,vjy,vjz,wix,wiy,wiz,wjx,wjy,wjz,branch,f_hys,"
                  "fx,fy,fz,tix,tiy,tiz,tjx,tjy,tjz,delta_max,xix,xiy,xiz,xrx,xry,xrz,"
                  "energy_n,energy_t,energy_r\n")
        for delta in overlaps(rng, FULL_ROWS, size):
            # The normal turns a little each step, sometimes by a quarter turn or more.
            turn = 1.5 if rng.uniform() < 0.05 else 0.1
            direction = direction / law.norm(direction) + turn * rng.normal(size=3)
            n = np.array([short(x) for x in direction])
            u = n / law.norm(n)
            dt = short(10.0 ** rng.uniform(-6.5, -4.5))
            v = 0.8 * v + 0.3 * rng.normal(size=3)
            v_i, v_j = np.array([short(x) for x in 0.2 * v]), random_vector(rng, 0.02)
            spin = 10.0 ** rng.uniform(-1.0, 2.3)
            w_i, w_j = random_vector(rng, spin), random_vector(rng, spin)
            if wall:
                w_j = np.zeros(3)
            inputs = ",".join(exact(x) for x in [dt, *n, delta, *v_i, *v_j, *w_i, *w_j])
            if delta <= 0.0:
                state = law.fresh()
                out.write(inputs + ",open\n")
                continue
            r = law.step(p, state, dt, u, delta, R_i, R_j, m_i, m_j, v_i, v_j, w_i, w_j)
            out.write(inputs + "," + r["branch"] + ","
                      + g17(r["f_hys"], *r["force"], *r["torque_i"], *r["torque_j"],
                            state["delta_max"], *state["xi"], *state["xi_r"], r["energy_n"],
                            r["energy_t"], r["energy_r"]) + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "tables")
    os.makedirs(folder, exist_ok=True)
    for number, case in enumerate(NORMAL):
        rng = np.random.default_rng(20260101 + number)
        write_normal(os.path.join(folder, f"normal_{number:02d}.csv"), law.parameters(**case), rng)
    number = 0
    for case in FULL:
        for wall in (False, True):
            rng = np.random.default_rng(20260501 + number)
            write_full(os.path.join(folder, f"full_{number:02d}.csv"), law.parameters(**case), rng,
                       wall)
            number += 1


if __name__ == "__main__":
    main()
