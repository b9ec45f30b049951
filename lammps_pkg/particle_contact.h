// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PARTICLE_CONTACT_H
#define LMP_EEPA_PARTICLE_CONTACT_H

#include <eepa/contact.h>

#include <cmath>

namespace LAMMPS_NS {

/// The per-atom arrays that a contact is gathered from, as flat runs of 3 doubles an atom.
struct ParticleArrays {
  const double *x, *v, *omega;    ///< 3 doubles an atom
  const double *radius, *mass;    ///< 1 double an atom

  static Eigen::Map<const eepa::Vec3> at(const double *array, int i)
  {
    return Eigen::Map<const eepa::Vec3>(array + 3 * static_cast<std::ptrdiff_t>(i));
  }
};

/// The arms of a contact's two torques.
struct LeverArms {
  double i, j;    ///< [length]
};

/// Gathers the contact of two overlapping particles.
/// \tparam WithCouple  whether the law reads the effective radius and the angular velocities
/// \param offset  x_i - x_j [length]
/// \param distance_squared  of the centres, in (0, (R_i + R_j)^2)
/// \param time_step  that led here; 0 in a set-up call
template <bool WithCouple>
inline LeverArms gather_contact(const ParticleArrays &p, int i, int j, const eepa::Vec3 &offset,
                                double distance_squared, double time_step, eepa::Contact &contact)
{
  using eepa::Vec3;
  const double radius_i = p.radius[i];
  const double radius_j = p.radius[j];
  const double distance = std::sqrt(distance_squared);
  contact.size = radius_i + radius_j;
  contact.overlap = contact.size - distance;
  const double inverse_distance = 1.0 / distance;    // one division, not three
  contact.normal = inverse_distance * offset;
  contact.effective_mass = eepa::effective_mass(p.mass[i], p.mass[j]);
  contact.velocity = p.at(p.v, i) - p.at(p.v, j);
  const LeverArms arms = {eepa::lever_arm(radius_i, contact.overlap),
                          eepa::lever_arm(radius_j, contact.overlap)};
  const Vec3 omega_i = p.at(p.omega, i), omega_j = p.at(p.omega, j);
  contact.spin = arms.i * omega_i + arms.j * omega_j;
  contact.turn =
      eepa::turn_of_pair<double>(contact.normal, contact.velocity, inverse_distance, time_step);
  contact.twist = eepa::twist_of_pair<double>(contact.normal, omega_i + omega_j, time_step);
  if constexpr (WithCouple) {
    contact.effective_radius = eepa::effective_radius(radius_i, radius_j);
    contact.angular_velocity = omega_i - omega_j;
  }
  return arms;
}

}    // namespace LAMMPS_NS

#endif
