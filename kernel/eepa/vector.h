// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_VECTOR_H
#define EEPA_VECTOR_H

#include "macros.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace eepa {

/// A vector of three doubles: 24 bytes, no alignment demand, never on the heap.
using Vec3 = Eigen::Vector3d;

/// Carries a tangent-plane vector of the last step over to the plane of this step.
///
/// The part along `normal` is removed and the length restored, so that a spring neither
/// gains nor loses energy when its contact rolls around (Luding 2008, section 2.3).
/// \param spring  vector in the old tangent plane, any dimension
/// \param normal  present unit normal
/// \return the rotated vector; zero where `spring` is parallel to `normal`
EEPA_FUNCTION Vec3 rotate_into_plane(const Vec3 &spring, const Vec3 &normal)
{
  const double length_squared = spring.squaredNorm();
  // below the smallest normal number a direction is meaningless, and so is the spring
  if (!(length_squared > 2.3e-308)) return Vec3::Zero();
  const double along = spring.dot(normal);
  const Vec3 projected = spring - along * normal;
  // from one step to the next the plane turns by next to nothing: 1/sqrt(1 - tilt) as a series,
  // exact to the last digit there, is worth a square root on the longest chain of a contact
  const double tilt = along * along / length_squared;
  if (tilt < 1e-5) return (1.0 + tilt * (0.5 + tilt * (0.375 + tilt * 0.3125))) * projected;
  const double projected_squared = projected.squaredNorm();
  if (!(projected_squared > 2.3e-308)) return Vec3::Zero();
  return std::sqrt(length_squared / projected_squared) * projected;
}

}    // namespace eepa

#endif
