// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_CLOSED_FORMS_H
#define EEPA_TESTS_CLOSED_FORMS_H

#include <algorithm>
#include <cmath>

namespace eepa_test {

// Head-on impact without dashpots, as an energy balance along the branches.
//
// The contact starts at delta = 0 with energy E = m* v^2/2 and ends at delta = 0. Loading takes
// f = f0 + k1 delta^n up to delta_max = D, where all of E has been used up:
//   E = k1 D^(n+1)/(n+1) + f0 D                                                            (1)
// Unloading returns W, the integral of the contact's force from 0 to D. Past the point of zero
// force that force only attracts, so that the particles separate if and only if W is positive, and
// then e^2 = W/E.
//
// linear: with P = D^n (1 - k1/k2) = delta_p^n, the k2 line from D down to
// delta_a^n = k2 P/(k2 + k_adh), the adhesive branch from there to 0; f0 acts all the way:
//   W = k2 [(D^(n+1) - delta_a^(n+1))/(n+1) - P (D - delta_a)] - k_adh delta_a^(n+1)/(n+1) + f0 D
// For n = 1, f0 = 0 that is W/E = k1/k2 - (k_adh/k1) (k2 - k1)^2/(k2 (k2 + k_adh)).
//
// plateau: with p = delta_p = k1 D/k2, the loading line itself from D down to
// S = k2 p/(k2 - k1), where the k2 line through (p, f0) meets it (S = D for k2 = 2 k1); the k2
// line from S down to A = p (1 - k_adh/k2), or to 0 where that is negative; the plateau -k_adh p,
// which has no f0, from A to 0:
//   W = k1 (D^2 - S^2)/2 + k2 [(S - p)^2 - (A - p)^2]/2 + f0 (D - A) - k_adh p A
// For k2 = 2 k1, f0 = 0, k_adh < k2: W/E = 1/2 - (k_adh/k1) (1 - k_adh/(2 k2))/2. With f0 < 0 the
// plateau lacks the work of f0 over A: the energy |f0| A is created, by the article's jump of the
// force.
//
// luding: as linear with n = 1 and the stiffness k that D leaves in the place of k2, k = k1 +
// (k2 - k1) D/L up to the limit overlap L = k2/(k2 - k1) depth 2 R*; pressed beyond L, it stores the
// rest of E and gives it back.

struct HeadOn {
  double max_overlap;        ///< D
  double returned_energy;    ///< W
  double restitution;        ///< sqrt(W/E), 0 where the particles stick
  bool sticks;
};

/// D of equation (1): for n = 1 the root of a quadratic, else by Newton from above.
inline double largest_overlap(double energy, double k1, double f0, double n)
{
  if (n == 1.0) return (-f0 + std::sqrt(f0 * f0 + 2.0 * k1 * energy)) / k1;
  double d =
      std::pow((n + 1.0) * energy / k1, 1.0 / (n + 1.0)) + std::pow(-f0 * (n + 1.0) / k1, 1.0 / n);
  for (int k = 0; k < 100; k++)
    d -= (k1 * std::pow(d, n + 1.0) / (n + 1.0) + f0 * d - energy) / (k1 * std::pow(d, n) + f0);
  return d;
}

inline HeadOn finish(double energy, double d, double returned)
{
  const bool sticks = returned <= 0.0;
  return {d, returned, sticks ? 0.0 : std::sqrt(returned / energy), sticks};
}

inline HeadOn linear_impact(double energy, double k1, double k2, double k_adh, double f0,
                            double n = 1.0)
{
  const double d = largest_overlap(energy, k1, f0, n);
  const double power = std::pow(d, n) * (1.0 - k1 / k2);
  const double a = std::pow(k2 * power / (k2 + k_adh), 1.0 / n);
  const double returned =
      k2 * ((std::pow(d, n + 1.0) - std::pow(a, n + 1.0)) / (n + 1.0) - power * (d - a)) -
      k_adh * std::pow(a, n + 1.0) / (n + 1.0) + f0 * d;
  return finish(energy, d, returned);
}

/// \param limit  L, delta* of the law
inline HeadOn luding_impact(double energy, double k1, double k2, double k_adh, double f0,
                            double limit)
{
  const double d = largest_overlap(energy, k1, f0, 1.0);
  if (d <= limit) return linear_impact(energy, k1, k1 + (k2 - k1) * d / limit, k_adh, f0);
  const double at_limit = 0.5 * k1 * limit * limit + f0 * limit;
  const HeadOn plastic = linear_impact(at_limit, k1, k2, k_adh, f0);
  // k2 x^2/2 + (k1 L + f0) x is what is left to store beyond
  const double force = k1 * limit + f0;
  const double x = (std::sqrt(force * force + 2.0 * k2 * (energy - at_limit)) - force) / k2;
  return finish(energy, limit + x, plastic.returned_energy + energy - at_limit);
}

inline HeadOn plateau_impact(double energy, double k1, double k2, double k_adh, double f0)
{
  const double d = largest_overlap(energy, k1, f0, 1.0);
  const double p = k1 / k2 * d;
  const double s = k2 * p / (k2 - k1);
  const double a = std::max(0.0, p * (1.0 - k_adh / k2));
  const double returned = 0.5 * k1 * (d * d - s * s) +
      0.5 * k2 * ((s - p) * (s - p) - (a - p) * (a - p)) + f0 * (d - a) - k_adh * p * a;
  return finish(energy, d, returned);
}

/// Restitution of the linear spring-dashpot whose force never attracts (Schwager and Poschel,
/// Granular Matter 9 (2007) 465, equation 21): the contact is over when the force has come down
/// to 0, still compressed.
/// \param mass  m*
inline double restitution_without_tension(double mass, double k, double b)
{
  const double beta = 0.5 * b / mass;
  const double omega0_squared = k / mass;
  const double omega = std::sqrt(omega0_squared - beta * beta);
  // atan2 carries both of the cases of the paper
  const double phase = std::atan2(2.0 * beta * omega, omega * omega - beta * beta);
  const double duration = (3.14159265358979323846 - phase) / omega;
  return std::exp(-beta * duration);
}

}    // namespace eepa_test

#endif
