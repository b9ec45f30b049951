// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_CONTACT_H
#define EEPA_CONTACT_H

#include "vector.h"

namespace eepa {

/// A contact as the law sees it. It does not know whether j is a particle or a wall.
struct Contact {
  Vec3 normal;                ///< u, unit vector pointing at i
  double overlap;             ///< delta = R_i + R_j - r > 0 [length]
  double size;                ///< d: R_i + R_j, at a wall 2 R_i [length]
  double effective_mass;      ///< m*, see effective_mass()
  double effective_radius;    ///< R*, see effective_radius()
  Vec3 velocity;              ///< v_i - v_j [length/time]
  Vec3 spin;                  ///< a_i omega_i + a_j omega_j [length/time]
  Vec3 angular_velocity;      ///< omega_i - omega_j [1/time], read by rolling models only
};

/// m* = m_i m_j / (m_i + m_j); the other mass when one is infinite (frozen, a wall).
/// \param mass_i, mass_j  > 0, infinity allowed
/// \return m*; 0 when both are infinite: neither can move, and a dashpot has nothing to damp
EEPA_FUNCTION double effective_mass(double mass_i, double mass_j)
{
  const double sum = mass_i + mass_j;
  if (std::isinf(sum)) {
    const double lighter = mass_i < mass_j ? mass_i : mass_j;
    return std::isinf(lighter) ? 0.0 : lighter;
  }
  return mass_i * mass_j / sum;
}

/// R* = R_i R_j / (R_i + R_j); a wall has an infinite radius and leaves R_i.
EEPA_FUNCTION double effective_radius(double radius_i, double radius_j)
{
  return effective_mass(radius_i, radius_j);
}

/// a = R - delta/2, from the centre to the middle of the overlap: for two particles the arms
/// add up to their distance, so that forces and torques conserve angular momentum.
/// \return [length]
EEPA_FUNCTION double lever_arm(double radius, double overlap)
{
  return radius - 0.5 * overlap;
}

/// Relative velocity of the two surfaces in the tangent plane (contract, section 1).
///
/// v_t = (v_i - v_j) - ((v_i - v_j).u) u - (a_i omega_i + a_j omega_j) x u
/// \param normal_velocity  v_n = (v_i - v_j).u
EEPA_FUNCTION Vec3 tangential_velocity(const Contact &c, double normal_velocity)
{
  return c.velocity - normal_velocity * c.normal - c.spin.cross(c.normal);
}

}    // namespace eepa

#endif
