#!/usr/bin/env python3
"""Break a copy of the kernel in many small ways and show that the kernel tests notice each.

    /usr/bin/python3 tests/mutation/mutate_kernel.py [--only WORD] [--keep] [--optimise LEVEL]

Each mutant is an exact text replacement (line breaks and indents aside) that must match once in its
file. The tests of tests/kernel are compiled against the broken copy in a temporary folder, first the
likeliest, then all of them, and run; a mutant is caught when a test fails. Exit status 1 when a
mutant survives, does not apply or does not compile, 2 when the untouched kernel fails its tests.
Tests named KnownFault* are left out.
"""

import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))

# (file, what is broken, the exact text, its replacement)
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
    ("contact_law.h", "spring not rotated",
     "spring = rotate_into_plane(spring, contact.normal) + Real(time_step) * velocity;",
     "spring = spring + Real(time_step) * velocity;"),
    ("contact_law.h", "spring not wound",
     "spring = rotate_into_plane(spring, contact.normal) + Real(time_step) * velocity;",
     "spring = rotate_into_plane(spring, contact.normal);"),
    ("contact_law.h", "spring wound, then rotated",
     "spring = rotate_into_plane(spring, contact.normal) + Real(time_step) * velocity;",
     "spring = rotate_into_plane<Real>(spring + Real(time_step) * velocity, contact.normal);"),
    ("contact_law.h", "delta_max not remembered", "history.max_overlap = normal.max_overlap;",
     "history.max_overlap = history.max_overlap;"),
    ("contact_law.h", "given dashpots scale with d",
     "result.normal = normal_part + scale.force() * c.viscous_normal;",
     "result.normal = normal_part + scale.stiffness() * c.viscous_normal;"),
    ("contact_law.h", "kt not scaled",
     "slider_force<Real>(scale.stiffness() * c.kt,", "slider_force<Real>(c.kt,"),
    ("contact_law.h", "dashpot of n != 1 from k1 alone",
     "stiffness *= NormalLaw::Exponent::slope(overlap, c, scale);", "stiffness *= 1.0;"),
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
    ("vector.h", "rotation loses length", "return select(there, factor, none) * projected;",
     "return select(there, one, none) * projected;"),
    ("contact.h", "lever arm R", "return radius - 0.5 * overlap;", "return radius;"),
    ("contact.h", "spin's sign", "- c.spin.cross(c.normal);", "+ c.spin.cross(c.normal);"),
    ("contact.h", "normal part of the velocity kept",
     "return c.velocity - normal_velocity * c.normal - c.spin", "return c.velocity - c.spin"),
    ("contact.h", "reduced mass halved",
     "mass_i * mass_j / select(infinite,", "0.5 * mass_i * mass_j / select(infinite,"),
    ("rolling_law.h", "constant: cap's factor", "return 0.4 * effective_radius",
     "return 0.5 * effective_radius"),
    ("rolling_law.h", "constant: twisting not removed",
     "return contact.angular_velocity - dot(contact.angular_velocity, contact.normal) * "
     "contact.normal;",
     "return contact.angular_velocity;"),
    ("rolling_law.h", "constant: drives",
     "select(limited, limit / sqrt(", "select(limited, -limit / sqrt("),
    ("rolling_law.h", "sds: given dashpot scales with d", "scale.force() * c.rolling_viscous",
     "scale.stiffness() * c.rolling_viscous"),
    ("rolling_law.h", "sds: bound without mu_r", "return c.mu_r * hysteretic; }",
     "return hysteretic; }"),
    ("history.h", "swap turns delta_max",
     "history.max_overlap = std::fabs(values[MAX_OVERLAP]);",
     "history.max_overlap = values[MAX_OVERLAP];"),
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
]


# The tests that most likely notice a mutant of a file are compiled and run first, all of them only
# when those do not.
FIRST = {
    "normal_law.h": ("normal_plateau", "normal_linear", "energy"),
    "coefficients.h": ("normal_linear", "damping", "oracle"),
    "contact_law.h": ("damping", "oracle", "friction"),
    "tangential_law.h": ("friction",), "vector.h": ("friction",), "contact.h": ("friction",),
    "rolling_law.h": ("rolling",), "history.h": ("symmetry",), "time_step.h": ("time_step",),
    "mixing.h": ("mixing",), "validation.h": ("validation",), "dissipation.h": ("energy",),
}


def run(command, **keywords):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **keywords)


def eigen_include():
    found = run(["pkg-config", "--cflags-only-I", "eigen3"])
    flags = found.stdout.split() if found.returncode == 0 else ["-I/usr/include/eigen3"]
    return [part for flag in flags for part in ("-isystem", flag[2:])]


class Bench:
    def __init__(self, folder, optimise):
        self.folder = folder
        self.kernel = os.path.join(folder, "kernel")
        self.flags = ["-std=c++17", f"-O{optimise}", "-w", "-I" + os.path.join(ROOT, "tests/kernel"),
                      *eigen_include()]
        self.compiler = os.environ.get("CXX", "g++")
        self.environment = {**os.environ, "EEPA_SOURCE_DIR": ROOT}
        # What never changes is parsed once.
        header = os.path.join(folder, "common.h")
        with open(header, "w") as out:
            for name in ("gtest/gtest.h", "Eigen/Core", "Eigen/Geometry", "random", "fstream",
                         "sstream", "map", "vector", "string", "limits", "algorithm", "cmath"):
                out.write(f"#include <{name}>\n")
        self.check(run([self.compiler, *self.flags, "-x", "c++-header", header]))
        self.sources = sorted(glob.glob(os.path.join(ROOT, "tests/kernel/*.cpp")))
        self.program = os.path.join(folder, "tests")

    @staticmethod
    def check(result):
        if result.returncode:
            sys.exit("mutate_kernel: the untouched kernel does not compile:\n" + result.stdout)

    def fresh_kernel(self):
        shutil.rmtree(self.kernel, ignore_errors=True)
        shutil.copytree(os.path.join(ROOT, "kernel"), self.kernel)

    def compile(self, names=None):
        """One program of the test files with these names, or of all."""
        unity = os.path.join(self.folder, "unity.cpp")
        with open(unity, "w") as out:
            out.write('#include "common.h"\n')
            for source in self.sources:
                if names is None or os.path.basename(source)[:-4] in names:
                    out.write(f'#include "{source}"\n')
        return run([self.compiler, *self.flags, "-I" + self.kernel, "-I" + self.folder, unity,
                    "-lgtest", "-lgtest_main", "-lpthread", "-o", self.program])

    def tests(self):
        try:
            return run([self.program, "--gtest_filter=-*KnownFault*", "--gtest_fail_fast",
                        "--gtest_brief=1"], env=self.environment, timeout=300)
        except subprocess.TimeoutExpired as late:
            return subprocess.CompletedProcess(late.cmd, 124, "[  FAILED  ] (does not end)")


def first_failure(text):
    for line in text.splitlines():
        if line.startswith("[  FAILED  ]"):
            return line[12:].split("(")[0].split(",")[0].strip() or "does not end"
    return "crash"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="mutants whose description has this word")
    parser.add_argument("--keep", action="store_true", help="keep the temporary folder")
    parser.add_argument("--optimise", default="1", help="compiler's optimisation level")
    options = parser.parse_args()

    folder = tempfile.mkdtemp(prefix="eepa_mutation_")
    bad = []
    start = time.time()
    try:
        bench = Bench(folder, options.optimise)
        bench.fresh_kernel()
        Bench.check(bench.compile())
        untouched = bench.tests()
        if untouched.returncode:
            print("mutate_kernel: the untouched kernel fails its tests:\n" + untouched.stdout)
            return 2
        chosen = [m for m in MUTANTS if options.only in m[0] + " " + m[1]]
        width = max(len(m[1]) for m in chosen)
        for count, (name, what, old, new) in enumerate(chosen, 1):
            bench.fresh_kernel()
            path = os.path.join(bench.kernel, "eepa", name)
            with open(path) as source:
                text = source.read()
            pattern = r"\s+".join(re.escape(word) for word in old.split())
            matches = len(re.findall(pattern, text))
            if matches != 1:
                verdict = f"ERROR: matches {matches} times"
                bad.append(what)
            else:
                with open(path, "w") as target:
                    target.write(re.sub(pattern, lambda _: new, text))
                verdict = "SURVIVED"
                for names in (FIRST.get(name, ()), None):
                    built = bench.compile(names)
                    if built.returncode:
                        verdict = "ERROR: does not compile"
                        break
                    result = bench.tests()
                    if result.returncode:
                        verdict = "caught by " + first_failure(result.stdout)
                        break
                if not verdict.startswith("caught"):
                    bad.append(what)
            print(f"{count:3d}/{len(chosen)}  {name:18s} {what:{width}s}  {verdict}", flush=True)
    finally:
        if options.keep:
            print("kept", folder)
        else:
            shutil.rmtree(folder)
    print(f"{len(chosen)} mutants, {len(chosen) - len(bad)} caught, {len(bad)} not, "
          f"{time.time() - start:.0f} s")
    for what in bad:
        print("not caught:", what)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
