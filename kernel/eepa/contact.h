// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_CONTACT_H
#define EEPA_CONTACT_H

#include "vector.h"

#include <limits>

namespace eepa {

/// A contact as the law sees it. It does not know whether j is a particle or a wall.
template <class Real> struct ContactOf {
  Vector3<Real> normal;              ///< u, unit vector pointing at i
  Real overlap;                      ///< delta = R_i + R_j - r > 0 [length]
  Real size;                         ///< d: R_i + R_j, at a wall 2 R_i [length]
  Real effective_mass;               ///< m*, see effective_mass()
  Real effective_radius;             ///< R*, see effective_radius()
  Vector3<Real> velocity;            ///< v_i - v_j [length/time]
  Vector3<Real> spin;                ///< a_i omega_i + a_j omega_j [length/time]
  Vector3<Real> angular_velocity;    ///< omega_i - omega_j [1/time], read by rolling models only
};
using Contact = ContactOf<double>;

/// m* = m_i m_j / (m_i + m_j); the other mass when one is infinite (frozen, a wall).
/// \param mass_i, mass_j  > 0, infinity allowed
/// \return m*; 0 when both are infinite: neither can move, and a dashpot has nothing to damp
template <class Real> EEPA_FUNCTION Real effective_mass(const Real &mass_i, const Real &mass_j)
{
  constexpr double largest = std::numeric_limits<double>::max();
  const Real sum = mass_i + mass_j;
  const auto infinite = sum > largest;
  const Real lighter = smaller(mass_i, mass_j);
  return select(infinite, select(lighter > largest, Real(0.0), lighter),
                mass_i * mass_j / select(infinite, Real(1.0), sum));
}

/// R* = R_i R_j / (R_i + R_j); a wall has an infinite radius and leaves R_i.
template <class Real>
EEPA_FUNCTION Real effective_radius(const Real &radius_i, const Real &radius_j)
{
  return effective_mass(radius_i, radius_j);
}

/// a = R - delta/2, from the centre to the middle of the overlap: for two particles the arms
/// add up to their distance, so that forces and torques conserve angular momentum.
/// \return [length]
template <class Real> EEPA_FUNCTION Real lever_arm(const Real &radius, const Real &overlap)
{
  return radius - 0.5 * overlap;
}

/// Relative velocity of the two surfaces in the tangent plane (contract, section 1).
///
/// v_t = (v_i - v_j) - ((v_i - v_j).u) u - (a_i omega_i + a_j omega_j) x u
/// \param normal_velocity  v_n = (v_i - v_j).u
template <class Real>
EEPA_FUNCTION Vector3<Real> tangential_velocity(const ContactOf<Real> &c,
                                                const Real &normal_velocity)
{
  return c.velocity - normal_velocity * c.normal - c.spin.cross(c.normal);
}

}    // namespace eepa

#endif
