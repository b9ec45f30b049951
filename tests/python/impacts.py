# SPDX-License-Identifier: GPL-2.0-only
"""One sphere that meets another one or a plane, as an in-file for every style that has the laws.

All happens in a plane. t is the direction of sliding, n that from the partner to the sphere at first touch,
and spins are about n x t, so that a wheel that rolls to +t turns with spin > 0."""

import math
import subprocess
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "oracle"))
import reference_law as oracle  # noqa: E402


@dataclass(frozen=True)
class Body:
    radius: float = 0.5
    mass: float = 1.0
    v: tuple = (0.0, 0.0)    # along t, along n
    spin: float = 0.0
    frozen: bool = False

    @property
    def inertia(self):
        return 0.4 * self.mass * self.radius ** 2


@dataclass(frozen=True)
class Style:
    """What computes the contact: a style, at a wall or between particles."""
    name: str
    wall: bool
    sub_model: bool = False    # eepa and luding of pair_style granular and fix wall/gran

    def takes(self, law):
        return not self.sub_model or (law["law"] != "plateau" and law["n"] == 1 and law["rolling"] in ("none", "sds"))

    def arms(self, body, overlap):
        """Of the surface velocity, of the torque."""
        middle = body.radius - 0.5 * overlap
        if not self.sub_model:
            return middle, middle
        return body.radius, body.radius if self.wall else middle

    def commands(self, law, mass):
        words = self.granular(law, mass) if self.sub_model else self.own(law)
        return {
            (False, False): "pair_style gran/eepa {0} dtcheck error\npair_coeff * * {1}",
            (False, True): "pair_style zero 2.0\npair_coeff * *\n"
                           "fix wall all wall/gran/eepa {0} dtcheck error coeff {1} wall zplane 0 NULL",
            (True, False): "pair_style granular\npair_coeff * * {1}",
            (True, True): "pair_style zero 2.0\npair_coeff * *\n"
                          "fix wall all wall/gran granular {1} zplane 0 NULL",
        }[self.sub_model, self.wall].format(*words)

    @staticmethod
    def own(law):
        words = "{k1!r} {k2!r} {k_adh!r} {f0!r} {mu!r}".format(**law)
        if law["kt"] is not None:
            words += f" kt {law['kt']!r}"
        if law["depth"] is not None:
            words += f" depth {law['depth']!r}"
        if law["restitution"] is not None:
            words += f" restitution {law['restitution']!r}"
        elif law["B_n"] or law["B_t"]:
            words += f" viscous {law['B_n']!r} {law['B_t']!r}"
        words += {"none": "", "constant": f" rolling constant {law['mu_r']!r}",
                  "sds": f" rolling sds {law['k_r']!r} {law['g_r']!r} {law['mu_r']!r}"}[law["rolling"]]
        return (law["law"] if law["n"] == 1 else f"{law['law']} exponent {law['n']!r}"), words

    @staticmethod
    def granular(law, mass):
        normal, tangential = oracle.damping({**law, "kt": stiffness(law)}, 1.0, mass)
        words = "{k1!r} {k2!r} {k_adh!r} {f0!r}".format(**law)
        words = f"luding {words} {law['depth']!r}" if law["law"] == "luding" else f"eepa {words}"
        words += f" {normal!r} NULL damping velocity "
        words += (f"tangential linear_history {stiffness(law)!r} {tangential / normal if normal else 0.0!r} {law['mu']!r}"
                  if law["mu"] else "tangential linear_nohistory 0 0")
        if law["rolling"] == "sds":
            words += f" rolling sds {law['k_r']!r} {law['g_r']!r} {law['mu_r']!r}"
        return None, words


PAIR, WALL = Style("gran/eepa", False), Style("wall/gran/eepa", True)
SUB_MODEL_PAIR, SUB_MODEL_WALL = Style("granular", False, True), Style("wall/gran granular", True, True)


def stiffness(law):
    return 2.0 / 7.0 * law["k1"] if law["kt"] is None else law["kt"]


@dataclass(frozen=True)
class Case:
    name: str
    law: dict                       # parameters of tests/oracle
    sphere: Body
    partner: Body = None            # None: a wall
    time_step: float = None
    stops: tuple = ()               # times at which the state is wanted
    every: int = 0                  # steps from one row of kinetic, stored and lost energy and force to the next
    overlap: float = 0.0            # at the start
    more: str = ""                  # more lines of the in-file
    style: Style = PAIR

    @property
    def reduced_mass(self):
        free = self.partner is not None and not self.partner.frozen
        return oracle.effective_mass(self.sphere.mass, self.partner.mass if free else None)

    @property
    def half_period(self):
        """Of the stiffest branch: what time steps are measured with."""
        return math.pi * math.sqrt(self.reduced_mass / self.law["k2"])

    def of(self, style, **changes):
        """The same at a wall or on a sphere: a frozen one, where `partner` does not say what else."""
        partner = None if style.wall else self.partner or replace(self.sphere, v=(0.0, 0.0), spin=0.0, frozen=True)
        case = replace(self, style=style, partner=partner, **changes)
        return replace(case, name=f"{self.name}, {style.name}")

    # Axes t, n x t, n as columns. A wall is a z plane; a pair lies askew.
    @property
    def axes(self):
        turn, tilt = 0.5, 0.0 if self.partner is None else 0.8
        about_z = np.array([[math.cos(turn), -math.sin(turn), 0], [math.sin(turn), math.cos(turn), 0], [0, 0, 1]])
        about_x = np.array([[1, 0, 0], [0, math.cos(tilt), -math.sin(tilt)], [0, math.sin(tilt), math.cos(tilt)]])
        return about_x @ about_z


@dataclass
class State:
    x: np.ndarray       # along t, n
    v: np.ndarray
    spin: float
    aside: float        # largest component that should be 0: out of the plane
    force: np.ndarray = field(default_factory=lambda: np.zeros(2))


def say(numbers):
    return " ".join(repr(float(a)) for a in numbers)


def in_file(number, case):
    steps = [round(stop / case.time_step) for stop in case.stops]
    lines = ["clear", "units si", "atom_style sphere", "atom_modify map array", "boundary f f f", "comm_modify vel yes",
             "region box block -10 10 -10 10 -10 10", "create_box 1 box"]
    bodies = [case.sphere] + ([case.partner] if case.partner else [])
    for i, body in enumerate(bodies):
        height = (body.radius - case.overlap if i == 0 else -body.radius)
        density = body.mass / (4.0 / 3.0 * math.pi * body.radius ** 3)
        v = case.axes @ [body.v[0], 0.0, body.v[1]]
        x = case.axes @ [0.0, 0.0, height]
        spin = case.axes @ [0.0, body.spin, 0.0]
        lines += [f"create_atoms 1 single {say(x)}",
                  f"set atom {i + 1} diameter {2 * body.radius!r} density {density!r}",
                  "set atom {} vx {} vy {} vz {}".format(i + 1, *say(v).split()),
                  f"set atom {i + 1} omega {say(spin)}"]
    frozen = len(bodies) == 2 and bodies[1].frozen
    lines += ["group moves id 1" + ("" if frozen or len(bodies) == 1 else " 2"),
              case.style.commands(case.law, case.reduced_mass)]
    lines += ["group stays id 2", "fix stays stays freeze"] if frozen else []
    # case.more before the integrator, so that it may bring its own
    lines += [case.more or "fix move moves nve/sphere", "neighbor 0.05 bin", f"timestep {case.time_step!r}",
              "thermo_modify norm no", "thermo 1000000000"]
    if case.every:
        lines += ["compute kinetic all ke", "compute turning all erotate/sphere",
                  "variable kinetic equal c_kinetic+c_turning"]
        lines += [f"variable f{a} equal f{a}[1]" for a in "xyz"]
        columns = "${kinetic}"
        if not case.style.sub_model:
            lines += ["compute ledger all gran/eepa/energy"]
            for name, terms in (("stored", (1, 2, 3, 10)), ("lost", (4, 5, 6, 7, 8, 11))):
                lines += [f"variable {name} equal " + "+".join(f"c_ledger[{k}]" for k in terms)]
                columns += f" ${{{name}}}"
        columns += " ${fx} ${fy} ${fz}"
        lines += [f'fix energies all print {case.every} "{columns}" file energies.{number} screen no']
    reached = 0
    for k, step in enumerate(steps):
        lines += [f"run {step - reached}",
                  f"write_dump all custom state.{number}.{k} id x y z vx vy vz omegax omegay omegaz fx fy fz "
                  "modify sort id format float %.17g"]
        reached = step
    return "\n".join(lines) + "\n"


def run(cases, folder, lmp):
    """All cases in one process. Of each the states of its bodies at each stop, and the rows of its energies."""
    script = "".join(in_file(i, case) for i, case in enumerate(cases))
    Path(folder, "in.impacts").write_text(script)
    done = subprocess.run([lmp, "-in", "in.impacts", "-log", "none"], cwd=folder, text=True, capture_output=True,
                          timeout=1200)
    if done.returncode:
        raise AssertionError(done.stdout[-2000:] + done.stderr)
    found = []
    for i, case in enumerate(cases):
        states = []
        for k in range(len(case.stops)):
            rows = np.loadtxt(Path(folder, f"state.{i}.{k}"), skiprows=9, ndmin=2)[:, 1:].reshape(-1, 4, 3) @ case.axes
            states.append([State(x[::2], v[::2], w[1], max(abs(a) for a in (x[1], v[1], w[0], w[2])), f[::2])
                           for x, v, w, f in rows])
        energies = np.loadtxt(Path(folder, f"energies.{i}"), ndmin=2) if case.every else None
        found.append((states, energies))
    return found
