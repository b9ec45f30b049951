// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WEAR_H
#define EEPA_WEAR_H

#include "body.h"

namespace eepa {

/// What a contact does to the surface of a wall in a step.
struct SurfaceLoad {
  double normal_force;    ///< presses the surface; < 0 where it pulls [force]
  Vec3 shear;             ///< on the surface, in its plane [force]
  /// Work of the pressing force along the sliding distance, |v_t| dt, to which Archard's law
  /// (J. Appl. Phys. 24 (1953) 981) makes the worn volume proportional. [force length]
  double sliding_work;
  double impact_work;    ///< work of the pressing force along the approach [force length]
};

/// The load of a contact. A force that pulls does not wear.
/// \param wrench  of the contact, on the particle
/// \param time_step  the step that led to the present positions [time]
EEPA_FUNCTION SurfaceLoad load_on_surface(const Contact &contact, const Wrench<double> &wrench,
                                          double time_step)
{
  SurfaceLoad load;
  load.normal_force = dot(wrench.force, contact.normal);
  load.shear = load.normal_force * contact.normal - wrench.force;
  const double normal_velocity = dot(contact.velocity, contact.normal);
  const double pressing = eepa::max(load.normal_force, 0.0) * time_step;
  load.sliding_work = pressing * tangential_velocity(contact, normal_velocity).norm();
  load.impact_work = pressing * eepa::max(-normal_velocity, 0.0);
  return load;
}

}    // namespace eepa

#endif
