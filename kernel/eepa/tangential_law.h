// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TANGENTIAL_LAW_H
#define EEPA_TANGENTIAL_LAW_H

#include "vector.h"

namespace eepa {

/// Result of a spring-dashpot-slider.
template <class Real> struct SliderForce {
  Vector3<Real> force;     ///< on i, of spring and dashpot together, of length <= bound [force]
  MaskOf<Real> sliding;    ///< whether the bound was reached
};

/// Spring, dashpot and slider in the tangent plane, for friction and for rolling sds.
///
/// f = -k xi - B v. Where |f| exceeds the bound, f is scaled back onto it and xi is reset so
/// that -k xi - B v is f again: the next step starts on the bound (contract, section 1;
/// Luding 2008, section 2.3). Where the dashpot alone exceeds the bound, xi is reset to 0: a spring
/// that balanced the dashpot would hold energy that no motion put in, and later drive the contact.
/// \param stiffness, inverse_stiffness  k >= 0 and 1/k (0 where k = 0)
/// \param viscous  B >= 0
/// \param bound  >= 0 [force]
/// \param velocity  v in the tangent plane [length/time]
/// \param[in,out] spring  xi, rotated and incremented already [length]
template <class Real>
EEPA_FUNCTION SliderForce<Real> slider_force(const Real &stiffness, const Real &inverse_stiffness,
                                             const Real &viscous, const Real &bound,
                                             const Vector3<Real> &velocity, Vector3<Real> &spring)
{
  using std::sqrt;
  SliderForce<Real> result;
  const Vector3<Real> dashpot = -viscous * velocity;
  result.force = dashpot - stiffness * spring;
  const Real length_squared = squared_length(result.force);
  const Real bound_squared = bound * bound;
  result.sliding = length_squared > bound_squared;
  if (any(result.sliding)) {
    const Real length = sqrt(select(result.sliding, length_squared, Real(1.0)));
    const Vector3<Real> limited = bound / length * result.force;
    const Real held = select(squared_length(dashpot) < bound_squared, inverse_stiffness, Real(0.0));
    const Vector3<Real> left = held * (dashpot - limited);
    spring = select(result.sliding, left, spring);
    result.force = select(result.sliding, limited, result.force);
  }
  return result;
}

/// Overload for one contact, so that Eigen expressions can be passed as `velocity`.
EEPA_FUNCTION SliderForce<double> slider_force(double stiffness, double inverse_stiffness,
                                               double viscous, double bound, const Vec3 &velocity,
                                               Vec3 &spring)
{
  return slider_force<double>(stiffness, inverse_stiffness, viscous, bound, velocity, spring);
}

/// Recoverable energy of a spring, k xi^2 / 2 [force length]
EEPA_FUNCTION double spring_energy(double stiffness, const Vec3 &spring)
{
  return 0.5 * stiffness * squared_length(spring);
}

}    // namespace eepa

#endif
