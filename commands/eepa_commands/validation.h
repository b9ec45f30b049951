// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_VALIDATION_H
#define EEPA_COMMANDS_VALIDATION_H

#include <eepa/parameters.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

// What the kernel asks of its input before a run.

namespace eepa {

/// The findings on a set of parameters: errors forbid a run, warnings deserve one line.
struct Findings {
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};

namespace detail {
  inline std::string text(double value)
  {
    std::ostringstream out;
    out.precision(10);
    out << value;
    return out.str();
  }

  /// Demands a finite value that fulfils `allowed`; says name, value and what is allowed.
  inline void demand(std::vector<std::string> &errors, bool allowed, const char *name, double value,
                     const std::string &range)
  {
    if (!std::isfinite(value))
      errors.push_back(std::string(name) + " = " + text(value) + " is not a finite number");
    else if (!allowed)
      errors.push_back(std::string(name) + " = " + text(value) + " is not allowed: it must be " +
                       range);
  }
}    // namespace detail

/// Checks the settings of a pair style or wall.
inline Findings validate(const LawSettings &s)
{
  Findings found;
  auto &errors = found.errors;
  detail::demand(errors, s.exponent >= 1.0 && s.exponent <= 2.0, "exponent", s.exponent,
                 "between 1 and 2");
  if (s.law == Law::plateau && s.exponent != 1.0)
    errors.push_back("exponent = " + detail::text(s.exponent) +
                     " is not allowed with plateau: only linear has an exponent");
  if (s.scaled)
    detail::demand(errors, s.reference_diameter > 0.0, "scale d_ref", s.reference_diameter, "> 0");
  return found;
}

/// Checks the parameters of one pair of types against a law.
inline Findings validate(const Parameters &p, const LawSettings &s)
{
  using detail::demand;
  using detail::text;
  Findings found;
  auto &errors = found.errors;

  demand(errors, p.k1 > 0.0, "k1", p.k1, "> 0");
  demand(errors, p.k2 >= p.k1, "k2", p.k2, ">= k1 = " + text(p.k1));
  demand(errors, p.k_adh >= 0.0, "k_adh", p.k_adh, ">= 0");
  demand(errors, p.f0 <= 0.0, "f0", p.f0, "<= 0 (a negative pull-off force attracts)");
  demand(errors, p.mu >= 0.0, "mu", p.mu, ">= 0");
  if (p.kt_given) demand(errors, p.kt >= 0.0, "kt", p.kt, ">= 0");
  if (s.exponent != 1.0 && !p.kt_given)
    errors.push_back("kt must be given (force/length) when the exponent is " + text(s.exponent) +
                     ": 2/7 k1 is a stiffness only for exponent 1");

  if (p.damping == Damping::restitution) {
    demand(errors, p.restitution >= 0.0 && p.restitution <= 1.0, "restitution", p.restitution,
           "between 0 (critical damping) and 1 (none)");
  } else {
    demand(errors, p.viscous_normal >= 0.0, "viscous Bn", p.viscous_normal, ">= 0");
    demand(errors, p.viscous_tangential >= 0.0, "viscous Bt", p.viscous_tangential, ">= 0");
  }

  if (p.rolling != RollingModel::none)
    demand(errors, p.mu_r >= 0.0, "rolling mu_r", p.mu_r, ">= 0");
  if (p.rolling == RollingModel::sds) {
    demand(errors, p.kr >= 0.0, "rolling sds kr", p.kr, ">= 0");
    demand(errors, p.rolling_viscous >= 0.0, "rolling sds gr", p.rolling_viscous, ">= 0");
  }

  if (s.law == Law::plateau && errors.empty()) {
    if (p.k2 < 2.0 * p.k1) {
      errors.push_back("k2 = " + text(p.k2) +
                       " is not allowed with plateau: it must be >= 2 k1 = " + text(2.0 * p.k1) +
                       ", or a virgin contact never loads; use linear, which takes any k2 >= k1");
    } else if (p.k2 > 2.0 * p.k1) {
      found.warnings.push_back("plateau with k2 = " + text(p.k2) + " > 2 k1 = " + text(2.0 * p.k1) +
                               ": unloading keeps to the loading branch down to an overlap of " +
                               text(p.k1 / (p.k2 - p.k1)) +
                               " of the largest one, where the k2 line meets it");
    }
  }
  return found;
}

}    // namespace eepa

#endif
