# SPDX-License-Identifier: GPL-2.0-only
"""What a single contact does: equations of motion, integrated with the law of tests/oracle, and closed forms. Nothing here
calls the kernel."""

import math

import numpy as np

from impacts import State, oracle


def integrate(case, steps=600):
    """Fourth-order Runge-Kutta, `steps` of them in case.half_period, to the end of the contact: states of the
    bodies. History changes between steps; the slider also bounds the force within one."""
    style, sphere, partner = case.style, case.sphere, case.partner
    q = oracle.scaled(case.law, sphere.radius, partner.radius if partner else None)
    b_n, b_t = oracle.damping(q, 1.0, case.reduced_mass)
    assert case.law["n"] == 1 and not case.law["limit_damping"]
    own_inverse = (1.0 / sphere.mass, 1.0 / sphere.inertia)
    other_inverse = (1.0 / partner.mass, 1.0 / partner.inertia) if partner and not partner.frozen else (0.0, 0.0)
    size = sphere.radius + (partner.radius if partner else 0.0)

    def contact(y):
        xi, zi, uxi, uzi, xj, zj, uxj, uzj, spin_i, spin_j, spring = y.tolist()
        distance = math.hypot(xi - xj, zi - zj) if partner else zi
        nx, nz = ((xi - xj) / distance, (zi - zj) / distance) if partner else (0.0, 1.0)
        overlap = max(size - distance, 0.0)
        arm_v, arm = style.arms(sphere, overlap)
        other_v, other_arm = style.arms(partner, overlap) if partner else (0.0, 0.0)
        vx, vz = uxi - uxj, uzi - uzj
        v_t = vx * nz - vz * nx - arm_v * spin_i - other_v * spin_j
        return size - distance, overlap, (nx, nz), vx * nx + vz * nz, v_t, (arm, other_arm), spring

    def forces(overlap, v_n, v_t, spring, memory):
        f_hys, _, memory = oracle.hysteretic(q, overlap, memory)
        bound = oracle.friction_bound(q, f_hys, overlap, memory)
        f_t = -q["kt"] * spring - b_t * v_t
        return f_hys - b_n * v_n, math.copysign(min(abs(f_t), bound), f_t), abs(f_t) > bound, bound, memory

    def rates(y, memory):
        _, overlap, (nx, nz), v_n, v_t, (arm, other_arm), spring = contact(y)
        f_n, f_t = forces(overlap, v_n, v_t, spring, memory)[:2]
        fx, fz = f_n * nx + f_t * nz, f_n * nz - f_t * nx
        (im, ii), (jm, ji) = own_inverse, other_inverse
        return np.array([y[2], y[3], fx * im, fz * im, y[6], y[7], -fx * jm, -fz * jm,
                         -arm * f_t * ii, -other_arm * f_t * ji, v_t])

    def advanced(y, h, memory):
        a = rates(y, memory)
        b = rates(y + 0.5 * h * a, memory)
        c = rates(y + 0.5 * h * b, memory)
        return y + h / 6.0 * (a + 2.0 * b + 2.0 * c + rates(y + h * c, memory))

    v_j, spin_j, z_j = (partner.v, partner.spin, -partner.radius) if partner else ((0.0, 0.0), 0.0, 0.0)
    y = np.array([0.0, sphere.radius, *sphere.v, 0.0, z_j, *v_j, sphere.spin, spin_j, 0.0])
    memory, gap = 0.0, 0.0
    h = case.half_period / steps
    for _ in range(20 * steps):
        after = advanced(y, h, memory)
        now, overlap, _, v_n, v_t, _, spring = contact(after)
        if now <= 0.0:    # the contact ends within this step
            y = advanced(y, h * gap / (gap - now), memory)
            return [State(y[0:2], y[2:4], y[8], 0.0), State(y[4:6], y[6:8], y[9], 0.0)]
        y, gap = after, now
        _, f_t, sliding, bound, memory = forces(overlap, v_n, v_t, spring, memory)
        if sliding:
            behind = abs(b_t * v_t) >= bound and not style.sub_model
            y[10] = 0.0 if behind else -(f_t + b_t * v_t) / q["kt"]
    raise AssertionError(f"{case.name}: the contact does not end")


# ---------------------------------------------------------------- closed forms, without dashpots

def reach_of(case):
    """2 R*, by which the depth of `luding` is multiplied."""
    sphere, partner = case.sphere, case.partner
    return 2 * oracle.effective_radius(sphere.radius, partner.radius if partner else None)


def limit_overlap(p, reach):
    return p["k2"] / (p["k2"] - p["k1"]) * p["depth"] * reach if p["law"] == "luding" else math.inf


def loading_energy(p, d, reach):
    """Work of loading from 0 to the overlap d."""
    soft = min(d, limit_overlap(p, reach))
    beyond = d - soft
    return (p["k1"] * soft ** (p["n"] + 1) / (p["n"] + 1) + beyond * (p["k1"] * soft + 0.5 * p["k2"] * beyond) +
            p["f0"] * d)


def largest_overlap(p, energy, reach):
    """Where loading has used up the energy. With n = 1, or f0 = 0; with luding f0 = 0."""
    limit = limit_overlap(p, reach)
    if limit < math.inf and energy > loading_energy(p, limit, reach):
        force = p["k1"] * limit
        rest = energy - loading_energy(p, limit, reach)
        return limit + (math.sqrt(force ** 2 + 2 * p["k2"] * rest) - force) / p["k2"]
    if p["f0"] == 0:
        return ((p["n"] + 1) * energy / p["k1"]) ** (1 / (p["n"] + 1))
    return (-p["f0"] + math.sqrt(p["f0"] ** 2 + 2 * p["k1"] * energy)) / p["k1"]


def unloading(p, d, reach):
    """Largest pull, and work given back, on the way from the overlap d to 0; n = 1. tests/kernel/IMPACT.md and LUDING.md
    derive it. For plateau k2 = 2 k1 and f0 = 0."""
    k1, k2, k_adh, f0 = p["k1"], p["k2"], p["k_adh"], p["f0"]
    top = min(d, limit_overlap(p, reach))
    back = loading_energy(p, d, reach) - loading_energy(p, top, reach)
    if p["law"] == "luding":
        k2 = k1 + (k2 - k1) * top / limit_overlap(p, reach)
    if p["law"] == "plateau":
        plastic = k1 / k2 * top
        onset = plastic * (1 - k_adh / k2)
        pull = k_adh * plastic
        back -= pull * onset
    else:
        plastic = top * (1 - k1 / k2)
        onset = k2 * plastic / (k2 + k_adh)
        pull = k_adh * onset - f0
        back += f0 * top - 0.5 * k_adh * onset ** 2
    return pull, back + 0.5 * k2 * ((top - plastic) ** 2 - (onset - plastic) ** 2)


def restitution(p, energy, reach):
    """Of a head-on impact; with a dashpot for k2 = k1 only, where it is the one that was asked for."""
    if p["restitution"] is not None:
        return p["restitution"]
    return math.sqrt(unloading(p, largest_overlap(p, energy, reach), reach)[1] / energy)
