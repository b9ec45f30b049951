// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_BODY_H
#define EEPA_BODY_H

#include "contact.h"

namespace eepa {

// A driver gathers a Body and scatters a Wrench. Everything between the two is in the kernel.

/// A particle as its contacts see it.
template <class Real> struct Body {
  Vector3<Real> x;        ///< centre [length]
  Vector3<Real> v;        ///< velocity half a step ago [length/time]
  Vector3<Real> omega;    ///< angular velocity half a step ago [1/time]
  Real radius;            ///< > 0 [length]
  Real mass;              ///< > 0, infinity where the particle can not move [mass]
};

/// The point of a wall that is nearest to a particle. The wall is a partner of infinite mass and
/// radius.
template <class Real> struct WallPoint {
  Vector3<Real> normal;      ///< unit vector from the wall to the particle's centre
  Real overlap;              ///< radius less distance [length]
  Vector3<Real> velocity;    ///< of the wall in the middle of the overlap [length/time]
  /// du/dt while particle and wall move; 0 at a plane that does not turn [1/time]
  Vector3<Real> normal_rate;
  /// of the wall; its surface may move without it, as a conveyor belt does [1/time]
  Vector3<Real> angular_velocity = Vector3<Real>::Zero();
};

/// Force and torques of a contact on its partners.
template <class Real> struct Wrench {
  Vector3<Real> force;       ///< on i; j gets the opposite force [force]
  Vector3<Real> torque_i;    ///< [force length]
  Vector3<Real> torque_j;    ///< [force length]; unset at a wall
};

/// Asks contact_of() for everything that any law reads.
struct AnyLaw {
  static constexpr bool has_couple = true;
  static constexpr bool reads_effective_radius = true;
};

/// The contact of two particles whose centres do not coincide.
/// \tparam ContactLaw  members of the contact that this law does not read are left unset
/// \param time_step  the step that led to the present positions; 0 in a set-up call [time]
template <class ContactLaw = AnyLaw, class Real>
EEPA_FUNCTION ContactOf<Real> contact_of(const Body<Real> &i, const Body<Real> &j, double time_step)
{
  using std::sqrt;
  ContactOf<Real> contact;
  const Vector3<Real> offset = i.x - j.x;
  const Real distance = sqrt(squared_length(offset));
  contact.size = size_of_pair(i.radius, j.radius);
  contact.overlap = contact.size - distance;
  const Real inverse_distance = 1.0 / distance;    // one division, not three
  contact.normal = inverse_distance * offset;
  contact.effective_mass = effective_mass(i.mass, j.mass);
  contact.velocity = i.v - j.v;
  contact.arm_i = lever_arm(i.radius, contact.overlap);
  contact.arm_j = lever_arm(j.radius, contact.overlap);
  contact.spin = contact.arm_i * i.omega + contact.arm_j * j.omega;
  contact.turn = turn_of_pair<Real>(contact.normal, contact.velocity, inverse_distance, time_step);
  contact.twist = twist_of_pair<Real>(contact.normal, i.omega + j.omega, time_step);
  if constexpr (ContactLaw::reads_effective_radius)
    contact.effective_radius = i.radius * j.radius / contact.size;    // both are finite
  if constexpr (ContactLaw::has_couple) contact.angular_velocity = i.omega - j.omega;
  return contact;
}

/// The middle of a particle's overlap with a wall, where their force acts. [length]
EEPA_FUNCTION Vec3 middle_of_overlap(const Body<double> &i, const Vec3 &normal, double overlap)
{
  return i.x - lever_arm(i.radius, overlap) * normal;
}

/// The contact of a particle and a wall.
/// \param time_step  as in contact_of()
template <class Real>
EEPA_FUNCTION ContactOf<Real> contact_at_wall(const Body<Real> &i, const WallPoint<Real> &wall,
                                              double time_step)
{
  ContactOf<Real> contact;
  const Real infinite(HUGE_VAL);
  contact.normal = wall.normal;
  contact.overlap = wall.overlap;
  contact.size = size_at_wall(i.radius);
  contact.effective_mass = effective_mass(i.mass, infinite);
  contact.effective_radius = effective_radius(i.radius, infinite);
  contact.velocity = i.v - wall.velocity;
  contact.arm_i = lever_arm(i.radius, wall.overlap);
  contact.arm_j = 0.0;
  contact.spin = contact.arm_i * i.omega;
  contact.angular_velocity = i.omega - wall.angular_velocity;
  contact.turn = Real(0.5 * time_step) * wall.normal_rate;
  contact.twist = twist_of_pair<Real>(wall.normal, i.omega + wall.angular_velocity, time_step);
  return contact;
}

/// Work per time that a moving wall does on a particle [force length/time]
EEPA_FUNCTION double power_of_wall(const Wrench<double> &wrench, const Contact &contact,
                                   const WallPoint<double> &wall)
{
  const Vec3 couple = wrench.torque_i + contact.arm_i * contact.normal.cross(wrench.force);
  return dot(wrench.force, wall.velocity) + dot(couple, wall.angular_velocity);
}

/// Moment of a contact on the wall about a point. Particle and wall together keep their angular
/// momentum. [force length]
EEPA_FUNCTION Vec3 moment_on_wall(const Wrench<double> &wrench, const Vec3 &centre,
                                  const Vec3 &about)
{
  const Vec3 arm = centre - about;
  return -(arm.cross(wrench.force) + wrench.torque_i);
}

/// Whether an overlap exceeds a radius. The centre of one particle then lies within the other, and
/// the run has no physical meaning from there on.
/// \param radius  the smaller one of the two [length]
template <class Real> EEPA_FUNCTION MaskOf<Real> too_deep(const Real &overlap, const Real &radius)
{
  return overlap > radius;
}

}    // namespace eepa

#endif
