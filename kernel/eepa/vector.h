// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_VECTOR_H
#define EEPA_VECTOR_H

#include "macros.h"
#include "real.h"

#include <cmath>

namespace eepa {

/// A vector of three doubles: 24 bytes, no special alignment, never on the heap.
using Vec3 = Vector3<double>;

/// a.b, always summed in this order: Eigen's own order depends on the scalar type.
template <class Real> EEPA_FUNCTION Real dot(const Vector3<Real> &a, const Vector3<Real> &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Real> EEPA_FUNCTION Real squared_length(const Vector3<Real> &a)
{
  return dot(a, a);
}

/// Carries a tangent-plane vector of the last step over to the plane of this step.
///
/// The part along `normal` is removed and the length restored, so that a spring neither
/// gains nor loses energy when its contact rolls around (Luding 2008, section 2.3).
/// \param spring  vector in the old tangent plane, any dimension
/// \param normal  present unit normal
/// \param length  factor by which the restored length is multiplied
/// \return the rotated vector; zero where `spring` is parallel to `normal`
template <class Real>
EEPA_FUNCTION Vector3<Real> rotate_into_plane(const Vector3<Real> &spring,
                                              const Vector3<Real> &normal, const Real &length)
{
  using std::sqrt;
  // a spring below the smallest normal number has no meaningful direction and counts as 0
  constexpr double meaningless = 2.3e-308;
  const Real one(1.0), none(0.0);
  const Real length_squared = squared_length(spring);
  const Real along = dot(spring, normal);
  const Vector3<Real> projected = spring - along * normal;
  const auto there = length_squared > meaningless;
  // The plane turns little in a step, so 1/sqrt(1 - tilt) is taken from a series, exact to the last
  // digit there. It saves a square root on the longest chain of dependent operations of a contact.
  const Real tilt = along * along / select(there, length_squared, one);
  Real factor = 1.0 + tilt * (0.5 + tilt * (0.375 + tilt * 0.3125));
  const auto steep = tilt >= 1e-5;
  if (any(steep)) {
    const Real left = squared_length(projected);
    const auto turned = left > meaningless;
    const Real restored = sqrt(length_squared / select(turned, left, one));
    factor = select(steep, select(turned, restored, none), factor);
  }
  return (select(there, factor, none) * length) * projected;
}
/// Overload for one contact, length kept, so that Eigen expressions can be passed as `spring`.
EEPA_FUNCTION Vec3 rotate_into_plane(const Vec3 &spring, const Vec3 &normal)
{
  return rotate_into_plane<double>(spring, normal, 1.0);
}

}    // namespace eepa

#endif
