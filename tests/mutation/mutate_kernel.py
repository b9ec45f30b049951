#!/usr/bin/env python3
"""Break a copy of the kernel in many small ways and show that the kernel tests notice each.

    /usr/bin/python3 tests/mutation/mutate_kernel.py [--only WORD] [--jobs N] [--match] [--keep]
                                                     [--optimise LEVEL]

Each mutant is an exact text replacement (line breaks and indents aside) that must match once in its
file; --match looks at that alone. The tests of tests/kernel are compiled against the broken copy in
a temporary folder, first the likeliest, then all of them, and run; a mutant is caught when a test
fails. Exit status 1 when a mutant survives, does not apply or does not compile, 2 when the untouched
kernel fails its tests. Tests named KnownFault* are left out.

Tests are compiled as the project compiles them, for x86-64-v3 where this machine runs it. Mutants of
what other processors run are compiled for those, against the tests of lanes; what this machine can
not run is left out and counted.
"""

import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))

# (file, what is broken, the exact text, its replacement[, the only processor that runs it])
MUTANTS = [
    # normal law: plateau
    ("normal_law.h", "plateau: loading condition dropped",
     "const auto loads = virgin || unloading >= loading;\n"
     "    const auto adheres = !loads && unloading <= -pull;",
     "const auto loads = virgin;\n    const auto adheres = !loads && unloading <= -pull;"),
    ("normal_law.h", "plateau: plateau's sign",
     "select(adheres, -pull, f0 + unloading)", "select(adheres, pull, f0 + unloading)"),
    ("normal_law.h", "plateau: f0 on the plateau",
     "select(adheres, -pull, f0 + unloading)", "select(adheres, f0 - pull, f0 + unloading)"),
    ("normal_law.h", "plateau: f0 missing when unloading",
     "select(adheres, -pull, f0 + unloading)", "select(adheres, -pull, unloading)"),
    ("normal_law.h", "plateau: f0 missing when loading",
     "select(loads, f0 + loading,", "select(loads, loading,"),
    ("normal_law.h", "plateau: boundary of the plateau excluded",
     "unloading <= -pull;", "unloading < -pull;"),
    ("normal_law.h", "plateau: plateau depth from delta, not delta_p",
     "const Real pull = s * c.k_adh * plastic_overlap;",
     "const Real pull = s * c.k_adh * overlap;"),
    ("normal_law.h", "plateau: bound without adhesion",
     "result.coulomb_force = result.force + pull;", "result.coulomb_force = result.force;"),
    ("normal_law.h", "plateau: sign of f0 in the bound",
     "result.coulomb_offset = -f0;", "result.coulomb_offset = f0;"),
    ("normal_law.h", "plateau: delta_max forgets",
     "result.max_overlap = select(virgin, overlap, max_overlap);", "result.max_overlap = overlap;"),
    ("normal_law.h", "plateau: k2 not scaled",
     "const Real unloading = s * c.k2 * (overlap - plastic_overlap);",
     "const Real unloading = c.k2 * (overlap - plastic_overlap);"),
    ("normal_law.h", "plateau energy: parting overlap",
     "const double parting_overlap = c.k1 / (c.k2 - c.k1) * peak;",
     "const double parting_overlap = peak;"),
    ("normal_law.h", "plateau energy: sign of the plateau's work",
     "c.k_adh * plastic * (plateau_overlap - overlap)",
     "c.k_adh * plastic * (overlap - plateau_overlap)"),
    ("normal_law.h", "plateau energy: f0 all along the plateau",
     "scale.force() * c.f0 * plateau_overlap;", "scale.force() * c.f0 * overlap;"),
    ("normal_law.h", "plateau energy: loading part's half",
     "energy += 0.5 * c.k1 *", "energy += 1.0 * c.k1 *"),
    ("normal_law.h", "plateau loss: not a difference of squares",
     "c.loading_loss * (after - before) * (after + before);",
     "c.loading_loss * (after - before) * (after - before);"),
    # normal law: linear (for plateau the comparison is redundant: k2 >= 2 k1 makes the same of it)
    ("normal_law.h", "linear: virgin compares strictly",
     "const auto virgin = overlap >= max_overlap;\n    const Real s = scale.stiffness();",
     "const auto virgin = overlap > max_overlap;\n    const Real s = scale.stiffness();"),
    ("normal_law.h", "linear: adhesive branch does not lower delta_p",
     "const Real remembered = select(adheres, c.adhesive_memory * overlap, max_overlap);",
     "const Real remembered = max_overlap;"),
    ("normal_law.h", "linear: adhesive sign",
     "select(adheres, -pull, unloading)", "select(adheres, pull, unloading)"),
    ("normal_law.h", "linear: f0 dropped", "result.force = f0 + spring;", "result.force = spring;"),
    ("normal_law.h", "linear: f0 in the bound", "result.coulomb_force = spring + pull;",
     "result.coulomb_force = result.force + pull;"),
    ("normal_law.h", "linear: bound without adhesion", "result.coulomb_force = spring + pull;",
     "result.coulomb_force = spring;"),
    ("normal_law.h", "linear: loading condition",
     "const auto loads = virgin || unloading >= loading;\n"
     "    const auto adheres = !loads && unloading <= rounding - pull;",
     "const auto loads = virgin;\n"
     "    const auto adheres = !loads && unloading <= rounding - pull;"),
    ("normal_law.h", "linear: adhesive condition",
     "unloading <= rounding - pull;", "unloading <= rounding;"),
    ("normal_law.h", "adhesive branch flickers at rest",
     "!loads && unloading <= rounding - pull;", "!loads && unloading <= 0.0 - pull;"),
    ("normal_law.h", "linear: remembers the present overlap when unloading",
     "select(adheres, c.adhesive_memory * overlap, max_overlap)",
     "select(adheres, c.adhesive_memory * overlap, overlap)"),
    ("normal_law.h", "linear energy: half", "energy = 0.5 * (overlap - plastic)",
     "energy = (overlap - plastic)"),
    ("normal_law.h", "linear energy: exponent's denominator", "/ (c.exponent + 1.0) -",
     "/ (c.exponent) -"),
    ("normal_law.h", "linear energy: f0's part",
     "return scale.stiffness() * c.k2 * energy + scale.force() * c.f0 * overlap;",
     "return scale.stiffness() * c.k2 * energy;"),
    ("normal_law.h", "linear opening loss: onset", "const double onset = max_overlap / c.adhesive_memory;",
     "const double onset = max_overlap;"),
    ("normal_law.h", "exponent: n - 1 becomes n",
     "return overlap * raise<Real>(overlap * scale.inverse_size, c.exponent - 1.0);",
     "return overlap * raise<Real>(overlap * scale.inverse_size, c.exponent);"),
    ("normal_law.h", "exponent: power not scaled",
     "return overlap * raise<Real>(overlap * scale.inverse_size, c.exponent - 1.0);",
     "return overlap * raise<Real>(overlap, c.exponent - 1.0);"),
    ("normal_law.h", "exponent: slope without n",
     "return c.exponent * raise<Real>(overlap * scale.inverse_size, c.exponent - 1.0);",
     "return raise<Real>(overlap * scale.inverse_size, c.exponent - 1.0);"),
    ("normal_law.h", "exponent: root of the plastic fraction",
     "return overlap * std::pow(fraction, 1.0 / c.exponent);", "return overlap * fraction;"),
    ("normal_law.h", "plateau: branch's name",
     "branch_of<Real>(Branch::adhesive), branch_of<Real>(Branch::unloading)));\n"
     "    result.force = select(",
     "branch_of<Real>(Branch::unloading), branch_of<Real>(Branch::adhesive)));\n"
     "    result.force = select("),
    ("normal_law.h", "linear: branch's name",
     "branch_of<Real>(Branch::adhesive), branch_of<Real>(Branch::unloading)));\n"
     "    result.force = f0 + spring;",
     "branch_of<Real>(Branch::unloading), branch_of<Real>(Branch::adhesive)));\n"
     "    result.force = f0 + spring;"),
    ("normal_law.h", "lanes: branch's number",
     "static_cast<double>(static_cast<int>(branch))", "static_cast<double>(0)"),
    # coefficients
    ("coefficients.h", "plateau: delta_p as linear's",
     "c.plastic_fraction = p.k1 / p.k2;", "c.plastic_fraction = 1.0 - p.k1 / p.k2;"),
    ("coefficients.h", "linear: delta_p as plateau's",
     "c.plastic_fraction = (p.k2 - p.k1) / p.k2;", "c.plastic_fraction = p.k1 / p.k2;"),
    ("coefficients.h", "linear: adhesive memory without k_adh",
     "std::pow((p.k2 + p.k_adh) / (p.k2 - p.k1), 1.0 / s.exponent)",
     "std::pow(p.k2 / (p.k2 - p.k1), 1.0 / s.exponent)"),
    ("coefficients.h", "linear: adhesive memory without the root",
     "std::pow((p.k2 + p.k_adh) / (p.k2 - p.k1), 1.0 / s.exponent)",
     "(p.k2 + p.k_adh) / (p.k2 - p.k1)"),
    ("coefficients.h", "restitution: 1 + becomes 1 -",
     "return 2.0 / std::sqrt(1.0 + ratio * ratio);",
     "return 2.0 / std::sqrt(std::fabs(1.0 - ratio * ratio));"),
    ("coefficients.h", "restitution: 4 becomes 1", "return 2.0 / std::sqrt(1.0 + ratio * ratio);",
     "return 1.0 / std::sqrt(1.0 + ratio * ratio);"),
    ("coefficients.h", "restitution: e = 0 undamped", "if (restitution <= 0.0) return 2.0;",
     "if (restitution <= 0.0) return 0.0;"),
    ("coefficients.h", "tangential dashpot: kt/k1 without root",
     "c.tangential_ratio = std::sqrt(c.kt / c.k1);", "c.tangential_ratio = c.kt / c.k1;"),
    ("coefficients.h", "scaling: force goes with d",
     "return size * size;", "return size;"),
    ("coefficients.h", "scaling: inverse", "scale.size = size * c.inverse_reference_diameter;",
     "scale.size = 1.0 / (size * c.inverse_reference_diameter);"),
    ("coefficients.h", "plateau loading loss", "c.loading_loss = 0.5 * p.k1 *",
     "c.loading_loss = p.k1 *"),
    ("coefficients.h", "linear adhesive loss: sign", "c.adhesive_loss = p.k_adh / (n + 1.0) +",
     "c.adhesive_loss = p.k_adh / (n + 1.0) -"),
    ("coefficients.h", "viscous B_t taken from B_n", "c.viscous_tangential = p.viscous_tangential;",
     "c.viscous_tangential = p.viscous_normal;"),
    # the composition
    ("contact_law.h", "normal dashpot's sign",
     "response.normal_force = normal.force - viscous.normal * normal_velocity;",
     "response.normal_force = normal.force + viscous.normal * normal_velocity;"),
    ("contact_law.h", "limit_damping: least 0 always",
     "larger(response.normal_force, smaller(normal.force, none));",
     "larger(response.normal_force, none);"),
    ("contact_law.h", "limit_damping ignored", "if (limit_damping)", "if (false)"),
    ("contact_law.h", "bound: f0 inside of mu",
     "return larger<Real>(c.mu * normal.coulomb_force + normal.coulomb_offset, 0.0);",
     "return larger<Real>(c.mu * (normal.coulomb_force + normal.coulomb_offset), 0.0);"),
    ("contact_law.h", "bound not clamped",
     "return larger<Real>(c.mu * normal.coulomb_force + normal.coulomb_offset, 0.0);",
     "using std::abs; return abs(c.mu * normal.coulomb_force + normal.coulomb_offset);"),
    ("contact_law.h", "spring not wound",
     "spring = wind<Real>(spring, velocity, time_step, contact);",
     "spring = wind<Real>(spring, velocity, 0.0, contact);"),
    ("contact_law.h", "spring not carried over",
     "spring = wind<Real>(spring, velocity, time_step, contact);",
     "spring += Real(time_step) * velocity;"),
    ("contact_law.h", "twisting torque left out of the torque on j",
     "torque_j -= twisting;", ""),
    ("contact_law.h", "twisting: kt not scaled",
     "contact, scale.stiffness() * c.kt,", "contact, Real(c.kt),"),
    ("contact_law.h", "twisting energy not scaled",
     "0.5 * scale.stiffness() * c.kt * history.twisting_spring", "0.5 * c.kt * history.twisting_spring"),
    ("contact_law.h", "twisting energy not in the sum",
     "return normal + tangential + rolling + twisting;", "return normal + tangential + rolling;"),
    ("contact_law.h", "delta_max not remembered", "history.max_overlap = normal.max_overlap;",
     "history.max_overlap = history.max_overlap;"),
    ("contact_law.h", "given dashpots scale with d",
     "result.normal = normal_part + scale.force() * c.viscous_normal;",
     "result.normal = normal_part + scale.stiffness() * c.viscous_normal;"),
    ("contact_law.h", "kt not scaled",
     "slider_force<Real>(scale.stiffness() * c.kt,", "slider_force<Real>(c.kt,"),
    ("contact_law.h", "dashpot of n != 1 from k1 alone",
     "stiffness *= NormalLaw::Exponent::slope(overlap, c, scale);", "stiffness *= 1.0;"),
    ("contact_law.h", "dashpots: stiffness not scaled",
     "Real stiffness = scale.stiffness() * c.k1;", "Real stiffness = c.k1;"),
    ("contact_law.h", "dashpots: mass left out of the root",
     "result.root_mass_stiffness = sqrt(effective_mass * stiffness);",
     "result.root_mass_stiffness = effective_mass * sqrt(stiffness);"),
    ("contact_law.h", "dashpots: tangential as normal",
     "Real tangential_part = normal_part * c.tangential_ratio;",
     "Real tangential_part = normal_part;"),
    ("contact_law.h", "dashpots: tangential of n != 1 not scaled",
     "c.restitution_damping * sqrt(effective_mass * scale.stiffness() * c.kt);",
     "c.restitution_damping * sqrt(effective_mass * c.kt);"),
    ("contact_law.h", "dashpots: tangential of n != 1 from k1 and its slope",
     "c.restitution_damping * sqrt(effective_mass * scale.stiffness() * c.kt);",
     "normal_part * c.tangential_ratio;"),
    ("contact_law.h", "dashpots: given B_t not scaled",
     "tangential_part + scale.force() * c.viscous_tangential;",
     "tangential_part + c.viscous_tangential;"),
    ("contact_law.h", "bound: offset dropped",
     "return larger<Real>(c.mu * normal.coulomb_force + normal.coulomb_offset, 0.0);",
     "return larger<Real>(c.mu * normal.coulomb_force, 0.0);"),
    ("contact_law.h", "rolling of f_hys with its sign",
     "Real(abs(normal.force))", "Real(normal.force)"),
    # tangential and rolling
    ("tangential_law.h", "spring reset forgets the dashpot",
     "held * (dashpot - limited);", "-held * limited;"),
    ("tangential_law.h", "spring's sign", "result.force = dashpot - stiffness * spring;",
     "result.force = dashpot + stiffness * spring;"),
    ("tangential_law.h", "spring wound up behind the dashpot",
     "select(squared_length(dashpot) < bound_squared,", "select(bound > 0.0,"),
    ("tangential_law.h", "scaled back by the square",
     "bound / length * result.force;", "bound_squared / (length * length) * result.force;"),
    ("tangential_law.h", "spring energy's half", "return 0.5 * stiffness * squared_length(spring);",
     "return stiffness * squared_length(spring);"),
    ("tangential_law.h", "sliding not cut", "result.force = select(result.sliding, limited,",
     "result.force = select(result.sliding, result.force,"),
    ("tangential_law.h", "sticking cut too", "result.force = select(result.sliding, limited,",
     "result.force = select(bound > 0.0, limited,"),
    ("tangential_law.h", "sticking spring reset too",
     "spring = select(result.sliding, left, spring);", "spring = left;"),
    ("tangential_law.h", "sliding spring kept",
     "spring = select(result.sliding, left, spring);", "(void) left;"),
    ("tangential_law.h", "force on the bound slides",
     "result.sliding = length_squared > bound_squared;",
     "result.sliding = length_squared >= bound_squared;"),
    ("vector.h", "rotation loses length",
     "return (select(there, factor, none) * length) * projected;",
     "return (select(there, one, none) * length) * projected;"),
    ("vector.h", "rotation: small tilt's half", "1.0 + tilt * (0.5 +", "1.0 + tilt * (0.25 +"),
    ("vector.h", "rotation: small tilt's square", "(0.375 +", "(0.0 +"),
    ("vector.h", "rotation: large tilt by the series", "tilt >= 1e-5;", "tilt >= 2.0;"),
    ("vector.h", "rotation: large tilt's square",
     "sqrt(length_squared / select(turned, left, one));",
     "length_squared / select(turned, left, one);"),
    ("vector.h", "rotation: nothing left, length restored",
     "const auto turned = left > meaningless;", "const auto turned = left >= 0.0;"),
    ("vector.h", "rotation: no spring has a tilt",
     "const auto there = length_squared > meaningless;",
     "const auto there = length_squared >= 0.0;"),
    ("vector.h", "product of vectors without z", "a[0] * b[0] + a[1] * b[1] + a[2] * b[2];",
     "a[0] * b[0] + a[1] * b[1];"),
    ("contact.h", "lever arm R", "return radius - 0.5 * overlap;", "return radius;"),
    ("contact.h", "spin's sign", "- seen_at_mid_step(c, c.spin).cross(c.normal);",
     "+ seen_at_mid_step(c, c.spin).cross(c.normal);"),
    ("contact.h", "normal part of the velocity kept",
     "return c.velocity - normal_velocity * c.normal - seen", "return c.velocity - seen"),
    ("contact.h", "spin with the normal of the step's end",
     "return vector + dot(vector, c.normal) * c.turn;", "return vector;"),
    ("contact.h", "turn's sign", "return vector + dot(vector, c.normal) * c.turn;",
     "return vector - dot(vector, c.normal) * c.turn;"),
    ("contact.h", "turn of a whole step", "return (Real(0.5 * time_step) * inverse_distance) * across;",
     "return (Real(time_step) * inverse_distance) * across;"),
    ("contact.h", "turn with the velocity along u",
     "const Vector3<Real> across = velocity - dot(velocity, normal) * normal;",
     "const Vector3<Real> across = velocity;"),
    ("contact.h", "twist doubled", "return Real(0.5 * time_step) * dot(angular_sum, normal);",
     "return Real(time_step) * dot(angular_sum, normal);"),
    ("contact.h", "springs do not turn about u",
     "return turning + half_way + c.twist * c.normal.cross(turning);", "return turning + half_way;"),
    ("contact.h", "springs turn the other way",
     "return turning + half_way + c.twist * c.normal.cross(turning);",
     "return turning + half_way - c.twist * c.normal.cross(turning);"),
    ("contact.h", "way turns as the spring", "c.twist * c.normal.cross(turning);",
     "c.twist * c.normal.cross(turning + half_way);"),
    ("contact.h", "way does not turn", "c.twist * c.normal.cross(turning);",
     "c.twist * c.normal.cross(turning - half_way);"),
    ("contact.h", "turning lengthens a spring",
     "1.0 - squared * (0.5 - 0.375 * squared));", "Real(1.0));"),
    ("contact.h", "length of turning: second term", "(0.5 - 0.375 * squared)", "Real(0.5)"),
    ("contact.h", "reduced mass halved",
     "mass_i * mass_j / select(infinite,", "0.5 * mass_i * mass_j / select(infinite,"),
    ("contact.h", "two infinite masses damp",
     "select(lighter > largest, Real(0.0), lighter)", "lighter"),
    ("contact.h", "frozen partner weighs", "const Real lighter = smaller(mass_i, mass_j);",
     "const Real lighter = larger(mass_i, mass_j);"),
    ("rolling_law.h", "constant: cap's factor", "return 0.4 * effective_radius",
     "return 0.5 * effective_radius"),
    ("rolling_law.h", "constant: twisting not removed",
     "return contact.angular_velocity - dot(contact.angular_velocity, contact.normal) * "
     "contact.normal;",
     "return contact.angular_velocity;"),
    ("rolling_law.h", "constant: drives",
     "select(limited, limit / sqrt(", "select(limited, -limit / sqrt("),
    ("rolling_law.h", "constant: slow rolling drives", "return -viscous * rolling;",
     "return select(limited, -viscous, viscous) * rolling;"),
    ("rolling_law.h", "constant: never capped",
     "const auto limited = cap * cap * rate_squared > limit * limit;",
     "const auto limited = rate_squared > 0.0;"),
    ("rolling_law.h", "sds: spring not rotated",
     "spring = wind<Real>(spring, rolled, time_step, contact);",
     "spring += Real(time_step) * rolled;"),
    ("rolling_law.h", "sds: winds with the normal of the step's end",
     "dot(contact.angular_velocity, contact.normal) * contact.turn;",
     "0.0 * contact.turn;"),
    ("rolling_law.h", "sds: kr not scaled", "slider_force<Real>(scale.stiffness() * c.kr,",
     "slider_force<Real>(c.kr,"),
    ("dispatch.h", "every exponent as 1", "if (settings.exponent == 1.0)",
     "if (settings.exponent >= 1.0)"),
    ("dispatch.h", "constant as sds", "ContactLaw<NormalLaw, RollingConstant, TwistingLaw>",
     "ContactLaw<NormalLaw, RollingSds, TwistingLaw>"),
    ("dispatch.h", "twisting left out", "return with_rolling<NormalLaw, TwistingMarshall>",
     "return with_rolling<NormalLaw, TwistingNone>"),
    # twisting
    ("twisting_law.h", "velocity with the normal of the step's end",
     "dot<Real>(contact.angular_velocity, contact.normal - contact.turn)",
     "dot<Real>(contact.angular_velocity, contact.normal)"),
    ("twisting_law.h", "arm a", "return sqrt(0.5 * effective_radius *", "return sqrt(effective_radius *"),
    ("twisting_law.h", "arm of a contact that has opened", "larger<Real>(overlap, 0.0)", "overlap"),
    ("twisting_law.h", "bound without its share", "return c.twisting_share * friction_bound;",
     "return friction_bound;"),
    ("twisting_law.h", "spring not wound", "spring += Real(time_step) * velocity;", ""),
    ("twisting_law.h", "dashpot drives", "const Real dashpot = -viscous * velocity;",
     "const Real dashpot = viscous * velocity;"),
    ("twisting_law.h", "spring drives", "Real force = dashpot - stiffness * spring;",
     "Real force = dashpot + stiffness * spring;"),
    ("twisting_law.h", "bound of one sign", "select(force < 0.0, -limit, limit)", "limit"),
    ("twisting_law.h", "never slides", "abs(force) > limit;", "abs(force) < -limit;"),
    ("twisting_law.h", "spring behind a dashpot at the bound",
     "select(abs(dashpot) < limit, inverse_stiffness, Real(0.0));", "inverse_stiffness;"),
    ("twisting_law.h", "spring not reset", "select(sliding, held * (dashpot - limited), spring);",
     "spring;"),
    ("twisting_law.h", "torque without the arm", "return lever * force;", "return force;"),
    ("coefficients.h", "twisting: bound of a", "2.0 / 3.0 * std::sqrt(2.0);", "2.0 / 3.0;"),
    ("mixing.h", "twisting of either",
     "if (a.twisting == b.twisting) mixed.twisting = a.twisting;",
     "mixed.twisting = a.twisting == TwistingModel::none ? b.twisting : a.twisting;"),
    ("history.h", "swap turns a twist", "return select(max_overlap < 0.0, -stored, stored);",
     "return stored;"),
    ("history.h", "twist where the rolling spring is", "N_ALWAYS + (Rolling ? 3 : 0);", "N_ALWAYS;"),
    ("history.h", "size without the twist", "+ (twisting == TwistingModel::marshall ? 1 : 0);", ";"),
    ("history.h", "lanes, load: twist of the first", "more[lane] = values[lane] + Layout::twisting_spring;",
     "more[lane] = values[0] + Layout::twisting_spring;"),
    ("history.h", "lanes, store: twist of the first",
     "values[lane][Layout::twisting_spring] = history.twisting_spring[lane];",
     "values[lane][Layout::twisting_spring] = history.twisting_spring[0];"),
    ("dissipation.h", "twisting: slip not booked",
     "detail::slip_loss(stiffness, before.twisting_spring,",
     "0.0 * detail::slip_loss(stiffness, before.twisting_spring,"),
    ("dissipation.h", "twisting: dashpot takes the spring's force",
     "response.twisting_torque / arm + stiffness * after.twisting_spring;",
     "response.twisting_torque / arm;"),
    ("dissipation.h", "twisting: dashpot of the step before not booked",
     "lost.twisting += time_step * dashpot_before(viscous.tangential, limit, speed);", ""),
    ("dissipation.h", "opening forgets the twisting spring",
     "lost.twisting = 0.5 * scale.stiffness() * c.kt * last.twisting_spring * last.twisting_spring;",
     ""),
    ("dissipation.h", "trial spring of the ledger not wound",
     "wind<double>(before.tangential_spring, velocity, time_step, contact)",
     "wind<double>(before.tangential_spring, velocity, 0.0, contact)"),
    ("rolling_law.h", "sds: given dashpot scales with d", "scale.force() * c.rolling_viscous",
     "scale.stiffness() * c.rolling_viscous"),
    ("rolling_law.h", "sds: bound without mu_r", "return c.mu_r * hysteretic; }",
     "return hysteretic; }"),
    ("history.h", "swap turns delta_max",
     "history.max_overlap = std::fabs(values[MAX_OVERLAP]);",
     "history.max_overlap = values[MAX_OVERLAP];"),
    ("history.h", "load: tangential spring from delta_max on",
     "Eigen::Map<const Vec3>(values + TANGENTIAL_SPRING);",
     "Eigen::Map<const Vec3>(values + MAX_OVERLAP);"),
    ("history.h", "load: rolling spring left out",
     "if constexpr (Layout::rolling) history.rolling_spring = Eigen::Map<const Vec3>",
     "if constexpr (false) history.rolling_spring = Eigen::Map<const Vec3>"),
    ("history.h", "store: rolling spring left out",
     "if constexpr (Layout::rolling) Eigen::Map<Vec3>(values", "if (false) Eigen::Map<Vec3>(values"),
    ("history.h", "store: delta_max left out", "values[MAX_OVERLAP] = history.max_overlap;", ""),
    # what laws choose with, for a double and for lanes
    ("real.h", "select: swapped", "return condition ? a : b;", "return condition ? b : a;"),
    ("real.h", "select: swapped in lanes",
     "Lanes chosen = b; where(condition, chosen) = a;",
     "Lanes chosen = a; where(condition, chosen) = b;"),
    ("real.h", "select: all lanes as one", "where(condition, chosen) = a;",
     "if (any(condition)) chosen = a;"),
    ("real.h", "select: y of vectors swapped", "select(condition, a[1], b[1])",
     "select(condition, b[1], a[1])"),
    ("real.h", "select: z of vectors is y", "select(condition, a[2], b[2])",
     "select(condition, a[1], b[1])"),
    ("real.h", "any: never", "return condition; }", "return false; }"),
    ("real.h", "any: all lanes", "std::experimental::any_of(condition)",
     "std::experimental::all_of(condition)"),
    ("real.h", "any: no lane", "std::experimental::any_of(condition)",
     "std::experimental::none_of(condition)"),
    ("real.h", "raise: not", "return std::pow(base, exponent);", "return base;"),
    ("real.h", "raise: by the first lane", "std::pow(base[lane], exponent)",
     "std::pow(base[0], exponent)"),
    ("real.h", "smaller is the larger", "return select(b < a, b, a);",
     "return select(b < a, a, b);"),
    ("real.h", "larger is the smaller", "return select(a < b, b, a);",
     "return select(a < b, a, b);"),
    # lanes' histories
    ("history.h", "lanes, swap turns delta_max", "abs(row[MAX_OVERLAP]);", "row[MAX_OVERLAP];"),
    ("history.h", "lanes, load: spring's y and z",
     "row[TANGENTIAL_SPRING + 1], row[TANGENTIAL_SPRING + 2]);",
     "row[TANGENTIAL_SPRING + 2], row[TANGENTIAL_SPRING + 1]);"),
    ("history.h", "lanes, load: rolling spring of the first",
     "more[lane] = values[lane] + ROLLING_SPRING;",
     "more[lane] = values[0] + ROLLING_SPRING;"),
    ("history.h", "lanes, load: rolling spring from the tangential one",
     "more[lane] = values[lane] + ROLLING_SPRING;",
     "more[lane] = values[lane] + TANGENTIAL_SPRING;"),
    ("history.h", "lanes, load: rolling spring though there is none",
     "if constexpr (Layout::rolling) { for (std::size_t lane = 0; lane < Lanes::size(); lane++) more",
     "{ for (std::size_t lane = 0; lane < Lanes::size(); lane++) more"),
    ("history.h", "lanes, store: spring's x and y",
     "{history.max_overlap, spring[0], spring[1], spring[2]}",
     "{history.max_overlap, spring[1], spring[0], spring[2]}"),
    ("history.h", "lanes, store: rolling spring of the first",
     "rolling.store(values[lane] + ROLLING_SPRING, lane);",
     "rolling.store(values[lane] + ROLLING_SPRING, 0);"),
    ("history.h", "lanes, store: rolling spring though there is none",
     "if constexpr (Layout::rolling) { const LaneRows", "{ const LaneRows"),
    ("history.h", "lanes, store: last lane's rolling spring left out",
     "for (std::size_t lane = 0; lane < Lanes::size(); lane++) rolling.store(",
     "for (std::size_t lane = 0; lane + 1 < Lanes::size(); lane++) rolling.store("),
    # rows and lanes, whatever the processor
    ("lane_rows.h", "numbers of the first lane", "return *at[lane];", "return *at[0];"),
    ("lane_rows.h", "rows: add subtracts", "{ return a + b; }", "{ return a - b; }"),
    ("lane_rows.h", "rows: subtract from the wrong side", "{ return a - b; }",
     "{ return b - a; }"),
    ("lane_rows.h", "rows: store keeps", "[](auto, auto b) EEPA_LAMBDA { return b; }",
     "[](auto a, auto) EEPA_LAMBDA { return a; }"),
    ("lane_rows.h", "rows: every row is the first", "store(row.data(), lane);",
     "store(row.data(), 0);"),
    # four lanes with AVX
    ("lane_rows.h", "AVX, gather: row of another lane", "_mm_loadu_pd(at[2]), 1);",
     "_mm_loadu_pd(at[3]), 1);", "avx2"),
    ("lane_rows.h", "AVX, gather: even and odd swapped",
     "Lanes(_mm256_unpacklo_pd(even, odd)), Lanes(_mm256_unpackhi_pd(even, odd)), "
     "Lanes(_mm256_insertf128_pd(",
     "Lanes(_mm256_unpacklo_pd(odd, even)), Lanes(_mm256_unpackhi_pd(odd, even)), "
     "Lanes(_mm256_insertf128_pd(", "avx2"),
    ("lane_rows.h", "AVX, gather: x and y swapped",
     "Lanes(_mm256_unpacklo_pd(even, odd)), Lanes(_mm256_unpackhi_pd(even, odd)), "
     "Lanes(_mm256_insertf128_pd(",
     "Lanes(_mm256_unpackhi_pd(even, odd)), Lanes(_mm256_unpacklo_pd(even, odd)), "
     "Lanes(_mm256_insertf128_pd(", "avx2"),
    ("lane_rows.h", "AVX, gather: z of another lane", "_mm_load_sd(at[0] + 2), at[1] + 2)",
     "_mm_load_sd(at[0] + 2), at[0] + 2)", "avx2"),
    ("lane_rows.h", "AVX, gather: y for z", "_mm_load_sd(at[2] + 2), at[3] + 2)",
     "_mm_load_sd(at[2] + 2), at[3] + 1)", "avx2"),
    ("lane_rows.h", "AVX, gather: z's halves swapped",
     "_mm256_castpd128_pd256(low), high, 1)", "_mm256_castpd128_pd256(high), low, 1)", "avx2"),
    ("lane_rows.h", "AVX, transpose: half of a row",
     "c = _mm256_permute2f128_pd(row[0], row[2], 0x31)",
     "c = _mm256_permute2f128_pd(row[0], row[2], 0x30)", "avx2"),
    ("lane_rows.h", "AVX, transpose: row of another lane",
     "b = _mm256_permute2f128_pd(row[1], row[3], 0x20)",
     "b = _mm256_permute2f128_pd(row[1], row[2], 0x20)", "avx2"),
    ("lane_rows.h", "AVX, transpose: columns swapped",
     "Lanes(_mm256_unpacklo_pd(c, d)), Lanes(_mm256_unpackhi_pd(c, d))",
     "Lanes(_mm256_unpackhi_pd(c, d)), Lanes(_mm256_unpacklo_pd(c, d))", "avx2"),
    ("lane_rows.h", "AVX, transpose: lanes swapped", "Lanes(_mm256_unpacklo_pd(a, b))",
     "Lanes(_mm256_unpacklo_pd(b, a))", "avx2"),
    ("lane_rows.h", "AVX, gather of 4: row of another lane",
     "_mm256_loadu_pd(at[0]), _mm256_loadu_pd(at[1]),",
     "_mm256_loadu_pd(at[0]), _mm256_loadu_pd(at[0]),", "avx2"),
    ("lane_rows.h", "AVX, scatter: columns swapped",
     "static_cast<__m256d>(column[0]), static_cast<__m256d>(column[1]),",
     "static_cast<__m256d>(column[1]), static_cast<__m256d>(column[0]),", "avx2"),
    ("lane_rows.h", "AVX, scatter: last lane left out",
     "for (int lane = 0; lane < 4; lane++)", "for (int lane = 0; lane < 3; lane++)", "avx2"),
    ("lane_rows.h", "AVX, scatter: row of another lane", "static_cast<__m256d>(row[lane])",
     "static_cast<__m256d>(row[3 - lane])", "avx2"),
    ("lane_rows.h", "AVX, rows: x and y of another lane",
     "xy_[1] = _mm256_castpd256_pd128(odd);", "xy_[1] = _mm256_castpd256_pd128(even);", "avx2"),
    ("lane_rows.h", "AVX, rows: lower half for the upper",
     "xy_[2] = _mm256_extractf128_pd(even, 1);", "xy_[2] = _mm256_extractf128_pd(even, 0);",
     "avx2"),
    ("lane_rows.h", "AVX, rows: x and y swapped", "odd = _mm256_unpackhi_pd(x, y);",
     "odd = _mm256_unpackhi_pd(y, x);", "avx2"),
    ("lane_rows.h", "AVX, rows: z of the lane before", "z_[1] = _mm_unpackhi_pd(z_[0], z_[0]);",
     "z_[1] = z_[0];", "avx2"),
    ("lane_rows.h", "AVX, rows: z of the lower half", "z_[2] = _mm256_extractf128_pd(z, 1);",
     "z_[2] = _mm256_castpd256_pd128(z);", "avx2"),
    ("lane_rows.h", "AVX, rows: last z", "z_[3] = _mm_unpackhi_pd(z_[2], z_[2]);",
     "z_[3] = _mm_unpackhi_pd(z_[0], z_[0]);", "avx2"),
    ("lane_rows.h", "AVX, rows: z stored, not combined",
     "row[2] = operation(row[2], _mm_cvtsd_f64(z_[lane]));",
     "row[2] = _mm_cvtsd_f64(z_[lane]);", "avx2"),
    ("lane_rows.h", "AVX, rows: writes beyond its row",
     "row[2] = operation(row[2], _mm_cvtsd_f64(z_[lane]));",
     "_mm_storeu_pd(row + 2, operation(_mm_loadu_pd(row + 2), z_[lane]));", "avx2"),
    ("lane_rows.h", "AVX, rows: x and y of the first lane", "_mm_loadu_pd(row), xy_[lane])",
     "_mm_loadu_pd(row), xy_[0])", "avx2"),
    # without AVX
    ("lane_rows.h", "plain, gather: x for y", "return at[lane][1];", "return at[lane][0];",
     "baseline"),
    ("lane_rows.h", "plain, gather: z of the first lane", "return at[lane][2];",
     "return at[0][2];", "baseline"),
    ("lane_rows.h", "plain, gather of 4: row of the first lane", "return at[lane][k];",
     "return at[0][k];", "baseline"),
    ("lane_rows.h", "plain, gather of 4: columns swapped",
     "{column(0), column(1), column(2), column(3)}",
     "{column(0), column(2), column(1), column(3)}", "baseline"),
    ("lane_rows.h", "plain, scatter: columns of the first lane",
     "at[lane][k] = column[k][lane];", "at[lane][k] = column[k][0];", "baseline"),
    ("lane_rows.h", "plain, scatter: the fourth left out",
     "for (int k = 0; k < 4; k++) at[lane][k]", "for (int k = 0; k < 3; k++) at[lane][k]",
     "baseline"),
    ("lane_rows.h", "plain, rows: all of the first lane", "set(lane, k, vector[k][lane]);",
     "set(lane, k, vector[k][0]);", "baseline"),
    ("lane_rows.h", "plain, rows: z left out", "for (int k = 0; k < 3; k++) set(lane,",
     "for (int k = 0; k < 2; k++) set(lane,", "baseline"),
    ("lane_rows.h", "plain, rows: all in the first", "rows_[lane][k] = value;",
     "rows_[0][k] = value;", "baseline"),
    ("lane_rows.h", "plain, rows: combined with the first",
     "row[k] = operation(row[k], rows_[lane][k]);", "row[k] = operation(row[k], rows_[0][k]);",
     "baseline"),
    # time step, mixing, validation
    ("time_step.h", "time step's factor", "return 0.2 * std::sqrt(mass / stiffness);",
     "return 0.25 * std::sqrt(mass / stiffness);"),
    ("time_step.h", "k_adh left out", "(c.k2 > c.k_adh ? c.k2 : c.k_adh) * slope",
     "c.k2 * slope"),
    ("time_step.h", "not scaled", "return scale.stiffness() * (normal > largest ? normal : largest);",
     "return (normal > largest ? normal : largest);"),
    ("mixing.h", "series of half", "2.0 / (1.0 / a + 1.0 / b)", "1.0 / (1.0 / a + 1.0 / b)"),
    ("mixing.h", "f0's sign", "mixed.f0 = -(", "mixed.f0 = ("),
    ("mixing.h", "given kt lost", "mixed.kt_given = a.kt_given || b.kt_given;",
     "mixed.kt_given = a.kt_given && b.kt_given;"),
    ("mixing.h", "one restitution alone", "std::sqrt(a.restitution * b.restitution)",
     "a.restitution"),
    ("validation.h", "k2 = k1 refused", "demand(errors, p.k2 >= p.k1,",
     "demand(errors, p.k2 > p.k1,"),
    ("validation.h", "NaN accepted", "if (!std::isfinite(value))", "if (std::isinf(value))"),
    ("validation.h", "plateau takes k2 < 2 k1", "if (p.k2 < 2.0 * p.k1) {",
     "if (p.k2 < 1.0 * p.k1) {"),
    ("validation.h", "warning for k2 = 2 k1", "} else if (p.k2 > 2.0 * p.k1) {",
     "} else if (p.k2 >= 2.0 * p.k1) {"),
    # dissipation
    ("dissipation.h", "dashpot's power",
     "return power + (0.25 * force / viscous - 0.5 * speed) * force;",
     "return (0.25 * force / viscous + 0.5 * speed) * force;"),
    ("dissipation.h", "dashpot's quarter, now",
     "return power + (0.25 * force / viscous - 0.5 * speed) * force;",
     "return power - 0.5 * speed * force;"),
    ("dissipation.h", "dashpot's quarter, before",
     "return (0.5 * speed - 0.25 * force / viscous) * force;",
     "return 0.25 * speed * force;"),
    ("dissipation.h", "dashpot before not cut at the bound",
     "const double force = viscous * speed < bound ? viscous * speed : bound;",
     "const double force = viscous * speed;"),
    ("dissipation.h", "dashpot before cut though a spring held it",
     "return spring.squaredNorm() > 0.0 ? HUGE_VAL : bound;", "return bound;"),
    ("dissipation.h", "limit_damping forgotten",
     "const bool limited = c.limit_damping && normal_velocity > 0.0;",
     "const bool limited = false;"),
    ("dissipation.h", "limit_damping of approach",
     "const bool limited = c.limit_damping && normal_velocity > 0.0;",
     "const bool limited = c.limit_damping;"),
    ("dissipation.h", "dashpot before at the present overlap",
     "dashpots<Normal>(c, scale, contact.effective_mass, overlap);",
     "dashpots<Normal>(c, scale, contact.effective_mass, contact.overlap);"),
    ("dissipation.h", "overlap before on the wrong side",
     "double overlap = contact.overlap + normal_velocity * time_step; if (overlap < 0.0)",
     "double overlap = contact.overlap - normal_velocity * time_step; if (overlap < 0.0)"),
    ("dissipation.h", "released spring without its trapezoid",
     "0.5 * stiffness * spring.dot(spring + displacement);",
     "0.5 * stiffness * spring.dot(spring);"),
    ("dissipation.h", "dashpot that drives stays with dashpots",
     "(taken < 0.0 ? lost.sliding : lost.tangential_dashpot) += taken;",
     "lost.tangential_dashpot += taken;"),
    ("dissipation.h", "slip loss without the trapezoid", "(before + after).dot(",
     "(after + after).dot("),
    ("dissipation.h", "initial overlap booked as lost", "if (loaded == 0.0) {",
     "if (loaded < 0.0) {"),
    ("dissipation.h", "first step booked like others", "if (!first) detail::book", "detail::book"),
    ("dissipation.h", "opening forgets the tangential spring",
     "lost.sliding = detail::release_loss(scale.stiffness() * c.kt, last.tangential_spring, slip);",
     "lost.sliding = 0.0;"),
    ("dissipation.h", "released spring gives back", "return loss > 0.0 ? loss : 0.0; }",
     "return loss; }"),
    ("dissipation.h", "limited dashpot not cut", "limited ? tension_free : HUGE_VAL", "HUGE_VAL"),
    ("dissipation.h", "limited dashpot's force cut to nothing",
     "limited ? tension_free : HUGE_VAL", "limited ? 0.0 : HUGE_VAL"),
    ("dissipation.h", "dashpot before at the loading state",
     "Normal::force(c, scale, overlap, last.max_overlap);",
     "Normal::force(c, scale, overlap, overlap);"),
    ("dissipation.h", "rolling before not cut, sds",
     "dashpot_bound(last.rolling_spring, Rolling::bound(c, hysteretic))", "HUGE_VAL"),
    ("dissipation.h", "rolling before cut though a spring held it",
     "dashpot_bound(last.rolling_spring, Rolling::bound(c, hysteretic))",
     "Rolling::bound(c, hysteretic)"),
    ("dissipation.h", "rolling before without the radius, sds", "radius * rate);", "rate);"),
    ("dissipation.h", "rolling before not cut, constant",
     "Rolling::bound(c, radius, hysteretic), rate);", "HUGE_VAL, rate);"),
    ("dissipation.h", "rolling now as fast rolling, constant", "torque, spin, torque * spin);",
     "torque, spin, 0.5 * torque * spin);"),
    ("dissipation.h", "rolling: slip of sds not booked",
     "detail::slip_loss(kr,", "0.0 * detail::slip_loss(kr,"),
    ("dissipation.h", "rolling: dashpot of sds takes the spring's force",
     "response.rolling_torque / radius + kr * after.rolling_spring;",
     "response.rolling_torque / radius;"),
    ("dissipation.h", "spring before not rotated",
     "stiffness, carry_over(before.tangential_spring, contact),",
     "stiffness, before.tangential_spring,"),
    ("dissipation.h", "rolling spring before not rotated",
     "detail::slip_loss(kr, carry_over(before.rolling_spring, contact),",
     "detail::slip_loss(kr, before.rolling_spring,"),
    ("dissipation.h", "start: separating contact was loaded deeper",
     "if (loaded > contact.overlap) loaded = contact.overlap;", ""),
    ("dissipation.h", "start: loaded from below 0", "if (loaded < 0.0) loaded = 0.0;", ""),
    ("dissipation.h", "opening forgets the rolling spring",
     "detail::release_loss(scale.stiffness() * c.kr,", "0.0 * detail::release_loss(c.kr,"),
    ("dissipation.h", "opening forgets the last dashpots",
     "detail::book_step_before<ContactLaw>(c, scale, contact, time_step, last, lost);", ""),
    ("dissipation.h", "opening forgets hysteresis",
     "lost.hysteresis = ContactLaw::Normal::opening_loss(c, scale, last.max_overlap);", ""),
    ("dissipation.h", "sum without a share", "sliding += share * other.sliding;",
     "sliding += other.sliding;"),
]


# The tests that most likely notice a mutant of a file are compiled and run first, all of them only
# when those do not.
FIRST = {
    "normal_law.h": ("normal_plateau", "normal_linear", "energy"),
    "coefficients.h": ("normal_linear", "damping", "oracle"),
    "contact_law.h": ("damping", "oracle", "friction"),
    "tangential_law.h": ("friction",), "vector.h": ("friction",), "contact.h": ("time_levels", "friction"),
    "twisting_law.h": ("twisting",),
    "rolling_law.h": ("rolling",), "time_step.h": ("time_step",), "mixing.h": ("mixing",),
    "validation.h": ("validation",), "dissipation.h": ("energy",), "dispatch.h": ("properties",),
    "history.h": ("symmetry", "lane_rows"), "real.h": ("lane_rows",),
    "lane_rows.h": ("lane_rows",),
}

# Name, the compiler's flag and what the processor must have, the usual one first.
PROCESSORS = {
    "avx2": ("-march=x86-64-v3", ("avx2", "fma", "bmi2")),
    "baseline": (None, ()),
}
TESTS_OF_LANES = ("lanes", "lane_rows")


def run(command, **keywords):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **keywords)


def eigen_include():
    found = run(["pkg-config", "--cflags-only-I", "eigen3"])
    flags = found.stdout.split() if found.returncode == 0 else ["-I/usr/include/eigen3"]
    return [part for flag in flags for part in ("-isystem", flag[2:])]


class Toolchain:
    """Flags, and for each processor that this machine can be the headers that never change."""

    def __init__(self, folder, optimise):
        self.folder = folder
        self.compiler = os.environ.get("CXX", "g++")
        self.flags = ["-std=c++17", f"-O{optimise}", "-w", "-fno-math-errno",
                      "-fno-trapping-math", "-ffp-contract=off",
                      "-I" + os.path.join(ROOT, "tests/kernel"), *eigen_include()]
        self.available = [name for name in PROCESSORS if self.runs(name)]
        self.usual = self.available[0]

    def runs(self, processor):
        flag, features = PROCESSORS[processor]
        if not features:
            return True
        program = os.path.join(self.folder, "supports")
        tests = " && ".join(f'__builtin_cpu_supports("{name}")' for name in features)
        built = run([self.compiler, flag, "-x", "c++", "-", "-o", program],
                    input=f"int main() {{ return {tests} ? 0 : 1; }}")
        return built.returncode == 0 and run([program]).returncode == 0

    def flags_for(self, processor):
        flag = PROCESSORS[processor][0]
        return self.flags + ([flag] if flag else [])

    def prepare(self, processor):
        """Parses once what never changes."""
        folder = os.path.join(self.folder, processor)
        os.makedirs(folder)
        header = os.path.join(folder, "common.h")
        with open(header, "w") as out:
            for name in ("gtest/gtest.h", "Eigen/Core", "Eigen/Geometry", "random", "fstream",
                         "sstream", "map", "vector", "string", "limits", "algorithm", "cmath"):
                out.write(f"#include <{name}>\n")
            for name in ("experimental/simd", "immintrin.h"):
                out.write(f"#if __has_include(<{name}>)\n#include <{name}>\n#endif\n")
        check(run([self.compiler, *self.flags_for(processor), "-x", "c++-header", header]))


def check(result):
    if result.returncode:
        sys.exit("mutate_kernel: the untouched kernel does not compile:\n" + result.stdout)


class Bench:
    """A copy of the kernel and a program of its tests."""

    def __init__(self, tools, name):
        self.tools = tools
        self.folder = os.path.join(tools.folder, name)
        os.makedirs(self.folder)
        self.kernel = os.path.join(self.folder, "kernel")
        self.sources = sorted(glob.glob(os.path.join(ROOT, "tests/kernel/*.cpp")))
        self.program = os.path.join(self.folder, "tests")
        self.environment = {**os.environ, "EEPA_SOURCE_DIR": ROOT}

    def fresh_kernel(self):
        shutil.rmtree(self.kernel, ignore_errors=True)
        shutil.copytree(os.path.join(ROOT, "kernel"), self.kernel)

    def compile(self, processor, names=None):
        """One program of the test files with these names, or of all."""
        unity = os.path.join(self.folder, "unity.cpp")
        with open(unity, "w") as out:
            out.write('#include "common.h"\n')
            for source in self.sources:
                if names is None or os.path.basename(source)[:-4] in ("support", *names):
                    out.write(f'#include "{source}"\n')
        return run([self.tools.compiler, *self.tools.flags_for(processor), "-I" + self.kernel,
                    "-I" + os.path.join(self.tools.folder, processor), unity,
                    "-lgtest", "-lgtest_main", "-lpthread", "-o", self.program])

    def tests(self):
        try:
            return run([self.program, "--gtest_filter=-*KnownFault*", "--gtest_fail_fast",
                        "--gtest_brief=1"], env=self.environment, timeout=300)
        except subprocess.TimeoutExpired as late:
            return subprocess.CompletedProcess(late.cmd, 124, "[  FAILED  ] (does not end)")

    def untouched(self, processor):
        """What the tests say of the untouched kernel; all of them on the usual processor."""
        self.fresh_kernel()
        check(self.compile(processor,
                           None if processor == self.tools.usual else TESTS_OF_LANES))
        return self.tests()

    def judge(self, mutant):
        """What becomes of a mutant: 'caught by ...', 'SURVIVED' or 'ERROR: ...'."""
        name, _, old, new = mutant[:4]
        processor = mutant[4] if len(mutant) > 4 else self.tools.usual
        self.fresh_kernel()
        path = os.path.join(self.kernel, "eepa", name)
        text = read(path)
        if matches(old, text) != 1:
            return f"ERROR: matches {matches(old, text)} times"
        with open(path, "w") as target:
            target.write(re.sub(pattern(old), lambda _: new, text))
        rest = None if processor == self.tools.usual else TESTS_OF_LANES
        for names in (FIRST.get(name, ()), rest):
            if self.compile(processor, names).returncode:
                return "ERROR: does not compile"
            result = self.tests()
            if result.returncode:
                return "caught by " + first_failure(result.stdout)
        return "SURVIVED"


def read(path):
    with open(path) as source:
        return source.read()


def pattern(old):
    return r"\s+".join(re.escape(word) for word in old.split())


def matches(old, text):
    return len(re.findall(pattern(old), text))


def first_failure(text):
    for line in text.splitlines():
        if line.startswith("[  FAILED  ]"):
            return line[12:].split("(")[0].split(",")[0].strip() or "does not end"
    return "crash"


def check_matches(chosen):
    bad = 0
    for mutant in chosen:
        times = matches(mutant[2], read(os.path.join(ROOT, "kernel/eepa", mutant[0])))
        if times != 1:
            print(f"{mutant[0]}: {mutant[1]}: matches {times} times")
            bad += 1
    print(f"{len(chosen)} mutants, {bad} do not match once")
    return 1 if bad else 0


def judge_all(tools, chosen, jobs):
    """Judges the mutants on `jobs` benches at once; returns those that are not caught."""
    bad = []
    left = list(enumerate(chosen, 1))
    lock = threading.Lock()
    width = max(len(m[1]) for m in chosen)

    def work(bench):
        while True:
            with lock:
                if not left:
                    return
                count, mutant = left.pop(0)
            verdict = bench.judge(mutant)
            with lock:
                if not verdict.startswith("caught"):
                    bad.append(mutant[1])
                print(f"{count:3d}/{len(chosen)}  {mutant[0]:18s} {mutant[1]:{width}s}  {verdict}",
                      flush=True)

    threads = [threading.Thread(target=work, args=(Bench(tools, f"bench{k}"),))
               for k in range(jobs)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="mutants whose description has this word")
    parser.add_argument("--jobs", type=int, default=1, help="mutants at a time")
    parser.add_argument("--match", action="store_true", help="only see whether each matches once")
    parser.add_argument("--keep", action="store_true", help="keep the temporary folder")
    parser.add_argument("--optimise", default="1", help="compiler's optimisation level")
    options = parser.parse_args()

    chosen = [m for m in MUTANTS if options.only in m[0] + " " + m[1]]
    if options.match or not chosen:
        return check_matches(chosen)
    folder = tempfile.mkdtemp(prefix="eepa_mutation_")
    start = time.time()
    try:
        tools = Toolchain(folder, options.optimise)
        left_out = [m for m in chosen if len(m) > 4 and m[4] not in tools.available]
        chosen = [m for m in chosen if m not in left_out]
        bench = Bench(tools, "untouched")
        for processor in {tools.usual} | {m[4] for m in chosen if len(m) > 4}:
            tools.prepare(processor)
            untouched = bench.untouched(processor)
            if untouched.returncode:
                print("mutate_kernel: the untouched kernel fails its tests:\n" + untouched.stdout)
                return 2
        bad = judge_all(tools, chosen, options.jobs) if chosen else []
    finally:
        if options.keep:
            print("kept", folder)
        else:
            shutil.rmtree(folder)
    if left_out:
        print(f"{len(left_out)} mutants left out: this machine can not run them")
    print(f"{len(chosen)} mutants, {len(chosen) - len(bad)} caught, {len(bad)} not, "
          f"{time.time() - start:.0f} s")
    for what in bad:
        print("not caught:", what)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
