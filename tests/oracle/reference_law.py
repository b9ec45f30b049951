"""The contact law a second time, plainly, as an oracle for the kernel.

Written from the contract (../../../shared/DESIGN.md, sections 1 and 2) alone, before its author had
read the kernel: nothing here is shared with kernel/eepa, and nothing should be. `luding` and `bound`
stood here before the kernel had them. Slow and obvious is the aim. Plain Python floats; vectors are
NumPy arrays of 3.

Names: delta overlap, delta_p plastic overlap, u unit normal that points at i, xi tangential spring.
"""

import math

import numpy as np

DEFAULTS = dict(
    law="linear",          # plateau | linear | luding
    n=1.0,                 # exponent, `linear` only
    k1=1.0, k2=2.0, k_adh=0.0, f0=0.0, mu=0.5,
    kt=None,               # None: 2/7 k1
    restitution=None,      # None: B_n and B_t as given
    B_n=0.0, B_t=0.0,
    rolling="none",        # none | constant | sds
    mu_r=0.0, k_r=0.0, g_r=0.0,
    depth=None,            # phi_f, `luding` only
    bound="adhesive",      # adhesive | contact: the bound of friction
    d_ref=None,            # None: no scaling
    limit_damping=False,
)


def parameters(**given):
    unknown = set(given) - set(DEFAULTS)
    if unknown:
        raise KeyError(f"unknown parameters {sorted(unknown)}")
    return {**DEFAULTS, **given}


# ---------------------------------------------------------------- section 2: scaling

def scaled(p, R_i, R_j):
    """Coefficients of one contact. R_j None: a wall, whose contact has the size 2 R_i."""
    q = dict(p)
    if q["kt"] is None:
        q["kt"] = 2.0 / 7.0 * q["k1"]
    if p["depth"] is not None:
        # A length of the contact itself: k2/k1 does not scale, and neither does the depth.
        reach = 2.0 * R_i if R_j is None else 2.0 * R_i * R_j / (R_i + R_j)
        q["delta_star"] = q["k2"] / (q["k2"] - q["k1"]) * p["depth"] * reach
    if p["d_ref"] is None:
        return q
    d = 2.0 * R_i if R_j is None else R_i + R_j
    s = d / p["d_ref"]
    for name in ("k1", "k2", "k_adh"):
        q[name] *= s ** (2.0 - p["n"])
    for name in ("kt", "k_r"):                 # force/length whatever n is
        q[name] *= s
    for name in ("f0", "B_n", "B_t", "g_r"):
        q[name] *= s ** 2
    return q


def effective_mass(m_i, m_j):
    """m_j None: a wall, a frozen or an infinitely heavy partner."""
    return m_i if m_j is None else m_i * m_j / (m_i + m_j)


def effective_radius(R_i, R_j):
    return R_i if R_j is None else R_i * R_j / (R_i + R_j)


# ---------------------------------------------------------------- section 1: normal force

def plastic_overlap(q, delta_max):
    """delta_p from delta_max."""
    if q["law"] == "plateau":
        return q["k1"] / q["k2"] * delta_max
    if q["law"] == "luding":
        return (1.0 - q["k1"] / unloading_stiffness(q, delta_max)) * delta_max
    return ((1.0 - q["k1"] / q["k2"]) * delta_max ** q["n"]) ** (1.0 / q["n"])


def unloading_stiffness(q, delta_max):
    """`luding`: grows from k1 to its limit k2, which it has from delta_star on."""
    if delta_max >= q["delta_star"]:
        return q["k2"]
    return q["k1"] + (q["k2"] - q["k1"]) * delta_max / q["delta_star"]


def luding_line(q, delta, delta_max):
    """The unloading line of a contact that remembers delta_max <= delta_star."""
    return unloading_stiffness(q, delta_max) * (delta - plastic_overlap(q, delta_max))


def luding_memory(q, delta, delta_max):
    """The delta_max whose unloading line meets the adhesive branch at delta, by bisection: it lies
    between delta (where the line is at k1 delta) and the present one (where it is below)."""
    low, high = delta, delta_max
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            return middle
        if luding_line(q, delta, middle) > -q["k_adh"] * delta:
            low = middle
        else:
            high = middle


def luding(q, delta, delta_max):
    """f_hys of `luding`. What is remembered is never beyond delta_star, where the loading branch
    turns into the limit branch: a k2 line, the same up and down."""
    k1, k_adh, f0 = q["k1"], q["k_adh"], q["f0"]
    remembered = min(delta_max, q["delta_star"])
    if delta >= remembered:
        if delta <= q["delta_star"]:
            return f0 + k1 * delta, "loading", delta
        return f0 + luding_line(q, delta, q["delta_star"]), "loading", q["delta_star"]
    line = luding_line(q, delta, remembered)
    if line <= -k_adh * delta:
        return f0 - k_adh * delta, "adhesive", luding_memory(q, delta, remembered)
    return f0 + line, "unloading", remembered


def hysteretic(q, delta, delta_max):
    """f_hys, branch and the (possibly new) delta_max at an overlap delta > 0."""
    k1, k2, k_adh, f0, n = q["k1"], q["k2"], q["k_adh"], q["f0"], q["n"]
    if q["law"] == "luding":
        return luding(q, delta, delta_max)
    virgin = delta >= delta_max
    delta_max = max(delta, delta_max)
    if q["law"] == "plateau":
        delta_p = k1 / k2 * delta_max
        line = k2 * (delta - delta_p)
        if virgin or line >= k1 * delta:
            return f0 + k1 * delta, "loading", delta_max
        if line <= -k_adh * delta_p:
            return -k_adh * delta_p, "adhesive", delta_max
        return f0 + line, "unloading", delta_max
    y = delta ** n
    y_p = (1.0 - k1 / k2) * delta_max ** n
    line = k2 * (y - y_p)
    if virgin or line >= k1 * y:
        return f0 + k1 * y, "loading", delta_max
    if line <= -k_adh * y:
        y_p = (1.0 + k_adh / k2) * y
        return f0 - k_adh * y, "adhesive", (y_p / (1.0 - k1 / k2)) ** (1.0 / n)
    return f0 + line, "unloading", delta_max


def frozen_force(q, delta, delta_max):
    """f_hys on the path of the present history: what the contact gives back when it moves
    without going beyond delta_max and without lowering delta_p."""
    if q["law"] == "plateau":
        return hysteretic(q, delta, delta_max)[0]
    if q["law"] == "luding":
        return q["f0"] + luding_line(q, delta, delta_max)
    y_p = (1.0 - q["k1"] / q["k2"]) * delta_max ** q["n"]
    return q["f0"] + q["k2"] * (delta ** q["n"] - y_p)


def elastic_energy(q, delta, delta_max):
    """Work on the frozen path from the stress-free overlap (delta_p), plus f0 delta, so that its
    slope is f_hys everywhere on that path."""
    k1, k2, k_adh, f0, n = q["k1"], q["k2"], q["k_adh"], q["f0"], q["n"]
    delta_p = plastic_overlap(q, delta_max)
    if q["law"] == "plateau":
        # The k2 line from delta_p upwards ends where it meets k1 delta; for k2 > 2 k1 that is
        # before delta_max, and the rest is on the k1 line.
        x = k2 * delta_p / (k2 - k1)
        a = delta_p * (1.0 - k_adh / k2)
        if delta >= min(x, delta_max):
            x = min(x, delta_max)
            w = 0.5 * k2 * (x - delta_p) ** 2 + 0.5 * k1 * (delta ** 2 - x ** 2)
        elif delta > a:
            w = 0.5 * k2 * (delta - delta_p) ** 2
        else:
            w = 0.5 * k2 * (a - delta_p) ** 2 + (-k_adh * delta_p - f0) * (delta - a)
        return w + f0 * delta
    if q["law"] == "luding":
        return 0.5 * unloading_stiffness(q, delta_max) * (delta - delta_p) ** 2 + f0 * delta
    y_p = delta_p ** n
    w = k2 * ((delta ** (n + 1) - delta_p ** (n + 1)) / (n + 1) - y_p * (delta - delta_p))
    return w + f0 * delta


def friction_bound(q, f_hys, delta, delta_max):
    """Coulomb bound; delta_max is the one after the update. Never negative."""
    if q["bound"] == "contact":
        return q["mu"] * max(f_hys, 0.0)
    if q["law"] == "plateau":
        delta_p = plastic_overlap(q, delta_max)
        # -f0 is outside mu, exactly as printed in the article.
        bound = q["mu"] * (f_hys + q["k_adh"] * delta_p) - q["f0"]
    else:
        bound = q["mu"] * (f_hys + q["k_adh"] * delta ** q["n"] - q["f0"])
    return max(bound, 0.0)


def damping(q, delta, m_eff):
    """B_n, B_t."""
    e = q["restitution"]
    if e is None:
        return q["B_n"], q["B_t"]
    if e == 1.0:
        return 0.0, 0.0
    denominator = 1.0 if e == 0.0 else 1.0 + (math.pi / math.log(e)) ** 2
    k_n = loading_stiffness(q, delta)
    return (math.sqrt(4.0 * m_eff * k_n / denominator),
            math.sqrt(4.0 * m_eff * q["kt"] / denominator))


def loading_stiffness(q, delta):
    return q["n"] * q["k1"] * delta ** (q["n"] - 1.0)


# ---------------------------------------------------------------- springs and the whole contact

def norm(v):
    return math.sqrt(float(v[0]) ** 2 + float(v[1]) ** 2 + float(v[2]) ** 2)


def tangent_part(v, u):
    return v - np.dot(v, u) * u


def rotated(xi, u):
    """Into the plane across u, length kept."""
    flat = tangent_part(xi, u)
    length = norm(flat)
    return flat * (norm(xi) / length) if length > 0.0 else np.zeros(3)


# Time levels (the page of the pair style, "Time levels"): velocities and spins are those of the
# middle of the step, and so is the normal that takes their tangential part.

def half_turn(u, v, distance, dt):
    """By how much u has turned since the middle of the step; u dot = (v - v_n u) / r."""
    return 0.5 * dt * tangent_part(v, u) / distance


def at_mid_step(w, u, turn):
    """w . u is a spin about the normal of then, u - turn: seen in the plane of now, turned with it,
    it has a part along `turn`."""
    return w + np.dot(w, u) * turn


def twisted(xi, u, w_sum, dt):
    """xi turned about u with the pair's mean spin, by the angle of a step (its arc tangent)."""
    angle = math.atan(0.5 * dt * float(np.dot(w_sum, u)))
    return math.cos(angle) * xi + math.sin(angle) * np.cross(u, xi)


def wound(xi, v, u, w_sum, dt):
    """xi of the step before, wound by v of the middle of the step: that way turns by half the
    angle, to first order."""
    way = dt * v
    half = 0.25 * dt * float(np.dot(w_sum, u))
    return twisted(rotated(xi, u), u, w_sum, dt) + way + half * np.cross(u, way)


# Where the dashpot alone exceeds the bound, the contract read literally ("reset so that the next step
# starts on the bound") winds a spring in the direction of sliding, against the dashpot, which later
# drives the contact. The first replay of these tables found that the kernel leaves no spring there
# (reason in tangential_law.h): the dissipation of sliding is then never negative, as the energy ledger
# requires, and the next force has the length of the bound all the same. That was adopted here after the
# comparison; this and the direction of the rolling spring are the only changes made to this file with
# knowledge of the kernel.
SPRING_BEHIND_DASHPOT = False


# The spring of sds lies along the relative spin: v_r = R* (omega_i - omega_j) x u, the customary
# choice, keeps its sign when i and j change places, while LAMMPS turns the sign of all history. The
# tests found that in the kernel, which now does as here; the torque is the same.


def slider(k, B, xi, v, bound):
    """Spring, dashpot and slider: force and the spring after scaling back."""
    f = -k * xi - B * v
    length = norm(f)
    if length <= bound:
        return f, xi, False
    if bound == 0.0:
        return np.zeros(3), np.zeros(3), True
    f = f * (bound / length)
    if not SPRING_BEHIND_DASHPOT and norm(B * v) >= bound:
        return f, np.zeros(3), True
    return f, -(f + B * v) / k, True


def fresh():
    return dict(delta_max=0.0, xi=np.zeros(3), xi_r=np.zeros(3))


def step(p, state, dt, u, delta, R_i, R_j, m_i, m_j, v_i, v_j, w_i, w_j):
    """One real step of a contact with delta > 0; changes state. R_j, m_j None: a wall."""
    q = scaled(p, R_i, R_j)
    m_eff = effective_mass(m_i, m_j)
    R_eff = effective_radius(R_i, R_j)
    B_n, B_t = damping(q, delta, m_eff)

    # Normal.
    f_hys, branch, delta_max = hysteretic(q, delta, state["delta_max"])
    v = v_i - v_j
    v_n = float(np.dot(v, u))
    f_n = f_hys - B_n * v_n
    if p["limit_damping"]:
        f_n = max(f_n, min(f_hys, 0.0))

    # Tangential. A wall does not spin in these tables, so its infinite lever arm drops out; it is
    # flat, so that its normal does not turn.
    a_i = R_i - 0.5 * delta
    a_j = 0.0 if R_j is None else R_j - 0.5 * delta
    turn = np.zeros(3) if R_j is None else half_turn(u, v, R_i + R_j - delta, dt)
    spin = at_mid_step(a_i * w_i + a_j * w_j, u, turn)
    v_t = tangent_part(v - np.cross(spin, u), u)
    bound = friction_bound(q, f_hys, delta, delta_max)
    xi = wound(state["xi"], v_t, u, w_i + w_j, dt)
    f_t, xi, sliding = slider(q["kt"], B_t, xi, v_t, bound)

    # Rolling.
    w = w_i - w_j
    xi_r = state["xi_r"]
    limit = q["mu_r"] * abs(f_hys)
    torque = np.zeros(3)
    if p["rolling"] == "constant":
        flat = tangent_part(w, u)
        length = norm(flat)
        c = 0.4 * R_eff ** 2 * math.sqrt(m_eff * loading_stiffness(q, delta))
        if length > 0.0:
            torque = -min(limit * R_eff, c * length) * flat / length
    elif p["rolling"] == "sds":
        v_r = R_eff * tangent_part(at_mid_step(w, u, turn), u)
        xi_r = wound(xi_r, v_r, u, w_i + w_j, dt)
        f_r, xi_r, _ = slider(q["k_r"], q["g_r"], xi_r, v_r, limit)
        torque = R_eff * f_r

    state.update(delta_max=delta_max, xi=xi, xi_r=xi_r)
    return dict(
        branch=branch, f_hys=f_hys, f_n=f_n, bound=bound, sliding=sliding,
        force=f_n * u + f_t,                                   # on i; on j its negative
        torque_i=np.cross(-a_i * u, f_t) + torque,
        torque_j=np.cross(a_j * u, -f_t) - torque,
        energy_n=elastic_energy(q, delta, delta_max),
        energy_t=0.5 * q["kt"] * norm(xi) ** 2,
        energy_r=0.5 * q["k_r"] * norm(xi_r) ** 2 if p["rolling"] == "sds" else 0.0,
    )
