// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TANGENTIAL_LAW_H
#define EEPA_TANGENTIAL_LAW_H

#include "vector.h"

namespace eepa {

/// What a spring-dashpot-slider gives.
struct SliderForce {
  Vec3 force;      ///< on i, spring and dashpot together, at most `bound` long [force]
  bool sliding;    ///< whether the bound was reached
};

/// Spring, dashpot and slider in the tangent plane: friction, and rolling sds alike.
///
/// f = -k xi - B v. Where |f| exceeds the bound, f is scaled back onto it and xi is reset so
/// that -k xi - B v is f again: the next step starts on the bound (contract, section 1;
/// Luding 2008, section 2.3). Where the dashpot alone exceeds the bound, no spring is left: one
/// that held the dashpot back would be wound up by nobody and later drive the contact.
/// \param stiffness, inverse_stiffness  k >= 0 and 1/k (0 where k = 0)
/// \param viscous  B >= 0
/// \param bound  >= 0 [force]
/// \param velocity  v in the tangent plane [length/time]
/// \param[in,out] spring  xi, rotated and incremented already [length]
EEPA_FUNCTION SliderForce slider_force(double stiffness, double inverse_stiffness, double viscous,
                                       double bound, const Vec3 &velocity, Vec3 &spring)
{
  SliderForce result;
  const Vec3 dashpot = -viscous * velocity;
  result.force = dashpot - stiffness * spring;
  result.sliding = false;
  const double length_squared = result.force.squaredNorm();
  if (length_squared > bound * bound) {
    result.sliding = true;
    result.force *= bound / std::sqrt(length_squared);
    if (dashpot.squaredNorm() < bound * bound)
      spring = inverse_stiffness * (dashpot - result.force);
    else
      spring.setZero();
  }
  return result;
}

/// Recoverable energy of a spring, k xi^2 / 2 [force length]
EEPA_FUNCTION double spring_energy(double stiffness, const Vec3 &spring)
{
  return 0.5 * stiffness * spring.squaredNorm();
}

}    // namespace eepa

#endif
