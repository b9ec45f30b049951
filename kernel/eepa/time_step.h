// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TIME_STEP_H
#define EEPA_TIME_STEP_H

#include "coefficients.h"

#include <cmath>

namespace eepa {

/// Overlap over the contact's size at which the time-step bound takes the tangent stiffness of an
/// exponent n != 1. That stiffness grows with overlap, and 5% is the largest overlap of a sound
/// simulation of stiff particles.
constexpr double time_step_overlap_fraction = 0.05;

/// Largest stiffness of a contact of size d, over its branches and directions [force/length].
///
/// Springs that also turn a particle count more than those that only move it. For a solid sphere
/// the tangential stiffness counts 7/2 times, so that the default of 2/7 k1 counts as k1, and the
/// rolling stiffness 5/2 times. The twisting spring counts 5/4 delta/R times the tangential
/// stiffness, which is never the largest while the overlap is less than a radius.
/// \param c  coefficients of its pair of types
/// \param size  d, as in Contact [length]
EEPA_FUNCTION double largest_stiffness(const Coefficients &c, double size)
{
  const Scale scale = contact_scale(c, size);
  const double slope = c.exponent *
      std::pow(time_step_overlap_fraction * size * scale.inverse_size, c.exponent - 1.0);
  const double normal = (c.k2 > c.k_adh ? c.k2 : c.k_adh) * slope;
  const double tangential = 3.5 * c.kt;
  const double rolling = 2.5 * c.kr;
  const double largest = tangential > rolling ? tangential : rolling;
  return scale.stiffness() * (normal > largest ? normal : largest);
}

/// Mass of a solid sphere.
/// \param diameter  [length], > 0
/// \param density  [mass/length^3], > 0
EEPA_FUNCTION double sphere_mass(double diameter, double density)
{
  constexpr double pi = 3.14159265358979323846;
  return pi / 6.0 * density * diameter * diameter * diameter;
}

/// Largest stable time step of a contact, 0.2 sqrt(m/k) (article, section 6).
/// \param mass  the lighter partner's mass, > 0
/// \param stiffness  largest_stiffness() of the contact [force/length], > 0
EEPA_FUNCTION double largest_time_step(double mass, double stiffness)
{
  return 0.2 * std::sqrt(mass / stiffness);
}

}    // namespace eepa

#endif
