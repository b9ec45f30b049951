# SPDX-License-Identifier: GPL-2.0-only
"""Sliding, rolling and pull-off for which LAMMPS tests its own granular models (its unittest/granular), with the laws of
this package, as in test_impacts.py."""

import math
import unittest
from dataclasses import replace

import numpy as np

from impact_cases import ADHESIVE, GROWING, LIMITED, PLATEAU, PULLED, STYLES, Impacts, law, with_friction
from impact_theory import loading_energy, reach_of, unloading
from impacts import Body, Case, oracle, say


class OnAFloor(Impacts):
    """Pressed with a constant force F on a floor, or on a frozen sphere of the same size."""

    F, K1, STEP = 10.0, 1e4, 2e-5
    LAWS = {"elastic": law(k1=K1, k2=K1, B_t=40.0, B_n=40.0), "hysteretic": law(k1=K1, k2=2 * K1, B_t=40.0, B_n=40.0),
            "growing": law(law="luding", k1=K1, k2=3 * K1, depth=0.05, B_t=40.0, B_n=40.0)}

    def pressed(self, case):
        """The same with the force, which on a sphere points at its centre and bears the centrifugal force."""
        down, length = -case.axes @ [0.0, 0.0, 1.0], 2 * case.sphere.radius - self.F / self.K1
        more = f"fix weight all gravity {self.F!r} vector 0 0 -1"
        if case.partner:
            centre = case.sphere.radius * down
            more = "\n".join(f"variable d{a} atom {a}-({float(c)!r})" for a, c in zip("xyz", centre))
            more += ("\nvariable far atom sqrt(v_dx^2+v_dy^2+v_dz^2)"
                     f"\nvariable pull atom ({self.F!r}+(vx^2+vy^2+vz^2)/{length!r})/v_far\n")
            more += "\n".join(f"variable p{a} atom -v_pull*v_d{a}" for a in "xyz")
            more += "\nfix weight moves addforce v_px v_py v_pz"
        return replace(case, overlap=self.F / self.K1, time_step=self.STEP, more=more + "\nfix move moves nve/sphere")

    def speed(self, case, state):
        """Along the floor, whatever its direction there is."""
        if not case.partner:
            return state.v[0]
        n = np.array([state.x[0], state.x[1] + case.partner.radius])
        n /= np.hypot(*n)
        return state.v[0] * n[1] - state.v[1] * n[0]

    def sliders(self, stops):
        for name, parameters in self.LAWS.items():
            for style in STYLES:
                if style.takes(parameters):
                    case = Case(name, with_friction(parameters, 0.3), Body(v=(1.0, 0.0))).of(style)
                    yield replace(self.pressed(case), stops=stops)

    # u falls with mu F/m and omega grows with mu F a/I, a the arm of the torque, until u = a' omega, a' that of the surface
    # velocity. I omega + m a u is kept throughout.
    def test_a_sphere_that_slides_comes_to_roll(self):
        gains = 0.3 * self.F
        ends = 2.0 / 7.0 / gains
        stops = (0.3 * ends, 0.8 * ends, 4 * ends)
        for case, (states, _) in self.run_cases(list(self.sliders(stops))):
            with self.subTest(case.name):
                body, (early, late, end) = case.sphere, (state[0] for state in states)
                surface, arm = case.style.arms(body, self.F / self.K1)
                # 1e-4: the centrifugal force is that of velocities half a step old
                slower = self.speed(case, early) - self.speed(case, late)
                time = (round(stops[1] / self.STEP) - round(stops[0] / self.STEP)) * self.STEP
                self.near(slower, gains * time, 1e-4 * gains * time)
                turns = gains * time * arm / body.inertia
                self.near(late.spin - early.spin, turns, 1e-4 * turns)
                self.assertGreater(self.speed(case, late) - late.spin * body.radius, 0.1)
                rolls = 1.0 / (1.0 + body.inertia / (body.mass * arm * surface))
                self.near(self.speed(case, end), rolls, 1e-5)
                self.near(end.spin * surface, rolls, 1e-5)
                self.assertLess(end.aside, 1e-9)

    # Rolling resistance alone, without friction: the torque mu_r F R* slows the spin down at a constant rate. `constant`
    # ends as a dashpot; `sds` begins and ends as a spring, which vibrates at Omega = R* sqrt(kr/I).
    def test_rolling_resistance_takes_the_spin_at_a_constant_rate(self):
        mu_r, k_r, spin = 0.4, 400.0, 10.0
        cases = []
        for rolling in ("constant", "sds"):
            for name, parameters in self.LAWS.items():
                parameters = {**parameters, "B_n": 0.0, "B_t": 0.0}
                parameters.update(rolling=rolling, mu_r=mu_r, k_r=k_r)
                for style in STYLES:
                    if style.takes(parameters):
                        case = self.pressed(Case(f"{name}, {rolling}", parameters, Body(spin=spin)).of(style))
                        stops = 0.5 if style.wall else 1.0    # until it stands still, R* = R or R/2
                        cases.append(replace(case, stops=(0.3 * stops, 0.8 * stops, 1.5 * stops)))
        for case, (states, _) in self.run_cases(cases):
            with self.subTest(case.name):
                early, late, end = (state[0] for state in states)
                first, second, _ = (round(stop / self.STEP) * self.STEP for stop in case.stops)
                reduced = oracle.effective_radius(0.5, 0.5 if case.partner else None)
                rate = mu_r * self.F * reduced / case.sphere.inertia
                left, begin, vibrates = spin, 0.0, 0.0
                if case.law["rolling"] == "sds":
                    omega, most = reduced * math.sqrt(k_r / case.sphere.inertia), mu_r * self.F / k_r
                    vibrates = omega * most / reduced
                    begin = math.asin(vibrates / spin) / omega
                    left = spin * math.cos(omega * begin)
                self.near(early.spin - late.spin, rate * (second - first), 1e-9 * spin)
                # up to a step late at the bound
                self.near(early.spin, left - rate * (first - begin), rate * self.STEP)
                self.assertLess(abs(end.spin), vibrates + rate * self.STEP if vibrates else 1e-6)
                for state in (early, late, end):
                    self.assertLess(max(*np.abs(state.v), state.aside), 1e-9)


class PullOff(Impacts):
    """The largest force that holds a contact together."""

    LAWS = {"adhesive": ADHESIVE, "pulled": PULLED, "f0": law(f0=-5.0), "growing": GROWING, "limited": LIMITED,
            "plateau": PLATEAU}

    def test_pull_and_work_of_separation_are_those_of_the_closed_form(self):
        """Pressed and drawn apart with a prescribed motion, overlap A sin(2 pi t/T)."""
        depth, steps = 4e-3, 20000
        cases = []
        for name, parameters in self.LAWS.items():
            for style in STYLES:
                if style.takes(parameters):
                    case = Case(name, parameters, Body()).of(style, time_step=5e-5)
                    away = say(-depth * case.axes[:, 2])
                    case = replace(case, stops=((steps - 1) * case.time_step,), every=1,
                                   more=f"fix move moves move wiggle {away} {2 * steps * case.time_step!r}")
                    cases.append(case)
        for case, (_, rows) in self.run_cases(cases):
            with self.subTest(case.name):
                p, reach = case.law, reach_of(case)
                pull, back = unloading(p, depth, reach)
                overlap = depth * np.sin(math.pi * np.arange(1, steps) / steps)
                force = rows[1:, -3:] @ case.axes[:, 2]
                self.assertEqual(len(force), steps - 1)
                # within a step the force changes by k2 v dt
                change = p["k2"] * depth * math.pi / steps
                self.near(force.min(), -pull, 1.5 * change)
                work = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(overlap))
                self.near(work, loading_energy(p, depth, reach) - back, 2 * change * depth)
                self.assertGreater(-force.min(), 4)

    def test_a_weight_below_f0_hangs_and_one_above_falls(self):
        weight, cases = 10.0, []
        for share in (1.02, 0.98):
            for style in STYLES:
                parameters = law(k1=1e4, k2=1e4, f0=-share * weight, restitution=0.3)
                case = Case(f"{share}", parameters, Body()).of(style, overlap=1e-6, time_step=1e-5, stops=(0.5,))
                up = say(weight * case.axes[:, 2])
                cases.append(replace(case, more=f"fix weight moves addforce {up}\nfix move moves nve/sphere"))
        for case, (states, _) in self.run_cases(cases):
            with self.subTest(case.name):
                state, gap = states[0][0], states[0][0].x[1] - case.sphere.radius
                if case.law["f0"] < -weight:    # at rest where f0 + k1 delta bears it
                    self.near(gap, (case.law["f0"] + weight) / case.law["k1"], 1e-8)
                    self.assertLess(np.abs(state.v).max(), 1e-6)
                else:
                    # it parts with what f0 leaves of the weight, at once, and then falls freely
                    self.near(state.v[1], weight * 0.5, 0.02 * weight * 0.5)


if __name__ == "__main__":
    unittest.main()
