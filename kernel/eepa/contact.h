// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_CONTACT_H
#define EEPA_CONTACT_H

#include "vector.h"

namespace eepa {

/// A contact as the law sees it. It does not know whether j is a particle or a wall.
template <class Real> struct ContactOf {
  Vector3<Real> normal;              ///< u, unit vector pointing at i
  Real overlap;                      ///< delta = R_i + R_j - r > 0 [length]
  Real size;                         ///< d, see size_of_pair(), size_at_wall() [length]
  Real effective_mass;               ///< m*, see effective_mass()
  Real effective_radius;             ///< R*, see effective_radius(); for laws that read it
  Vector3<Real> velocity;            ///< v_i - v_j [length/time]
  Real arm_i, arm_j;                 ///< a_i, a_j: see lever_arm(); a_j is 0 at a wall [length]
  Vector3<Real> spin;                ///< a_i omega_i + a_j omega_j [length/time]
  Vector3<Real> turn;                ///< change of u since mid-step, see turn_of_pair()
  Real twist;                        ///< angle about u in this step, see twist_of_pair()
  Vector3<Real> angular_velocity;    ///< omega_i - omega_j [1/time], for rolling and twisting only
};
using Contact = ContactOf<double>;

// A force call at the end of a step sees the present positions and the velocities of half a step
// ago. A tangential displacement needs velocity and normal of the same time, so it is built with
// the normal of the middle of the step. With the present normal, a pair that spins about its normal
// while the normal turns would wind its springs by dt/2 (spin.u) |du/dt| a step, always in the same
// direction.

/// Change of u since the middle of the step, u(t) - u(t - dt/2), for two particles.
/// \param velocity  v_i - v_j [length/time]
/// \param inverse_distance  of their centres [1/length]
/// \param time_step  the step that led to the present positions; 0 in a set-up call [time]
template <class Real>
EEPA_FUNCTION Vector3<Real> turn_of_pair(const Vector3<Real> &normal, const Vector3<Real> &velocity,
                                         const Real &inverse_distance, double time_step)
{
  const Vector3<Real> across = velocity - dot(velocity, normal) * normal;
  return (Real(0.5 * time_step) * inverse_distance) * across;
}

/// Angle by which the pair turns about u in a step, with its mean angular velocity. Its springs
/// turn with it, so that a pair that rotates rigidly keeps them unchanged relative to itself.
/// \param angular_sum  omega_i + omega_j [1/time]
template <class Real>
EEPA_FUNCTION Real twist_of_pair(const Vector3<Real> &normal, const Vector3<Real> &angular_sum,
                                 double time_step)
{
  return Real(0.5 * time_step) * dot(angular_sum, normal);
}

/// Overlap of two spheres; negative where they do not touch [length]
EEPA_FUNCTION double overlap_of_spheres(const Vec3 &centre_i, double radius_i, const Vec3 &centre_j,
                                        double radius_j)
{
  return radius_i + radius_j - std::sqrt(squared_length<double>(centre_i - centre_j));
}

/// Overlap one step ago; negative where the partners did not touch [length]
EEPA_FUNCTION double overlap_before(const Contact &c, double time_step)
{
  return c.overlap + dot(c.velocity, c.normal) * time_step;
}

/// Size d of a contact, to which its coefficients scale: R_i + R_j between particles [length]
template <class Real> EEPA_FUNCTION Real size_of_pair(const Real &radius_i, const Real &radius_j)
{
  return radius_i + radius_j;
}
/// The same at a wall: 2 R_i.
template <class Real> EEPA_FUNCTION Real size_at_wall(const Real &radius)
{
  return 2.0 * radius;
}

/// m* = m_i m_j / (m_i + m_j); where one mass is infinite (frozen particle, wall), the other mass.
/// \param mass_i, mass_j  > 0, infinity allowed
/// \return m*; 0 when both are infinite: neither can move, and a dashpot has nothing to damp
template <class Real> EEPA_FUNCTION Real effective_mass(const Real &mass_i, const Real &mass_j)
{
  // a literal, because std::numeric_limits has no device functions
  constexpr double largest = 1.7976931348623157e308;
  const Real sum = mass_i + mass_j;
  const auto infinite = sum > largest;
  const Real lighter = eepa::min(mass_i, mass_j);
  return select(infinite, select(lighter > largest, Real(0.0), lighter),
                mass_i * mass_j / select(infinite, Real(1.0), sum));
}

/// R* = R_i R_j / (R_i + R_j); R_i at a wall, whose radius is infinite.
template <class Real>
EEPA_FUNCTION Real effective_radius(const Real &radius_i, const Real &radius_j)
{
  return effective_mass(radius_i, radius_j);
}

/// Lever arm a = R - delta/2, from the centre to the middle of the overlap. The arms of two
/// particles add up to their distance, so that forces and torques conserve angular momentum.
/// \return [length]
template <class Real> EEPA_FUNCTION Real lever_arm(const Real &radius, const Real &overlap)
{
  return radius - 0.5 * overlap;
}

/// A vector of the middle of the step: its tangent-plane part at that time, carried over to the
/// present plane, to first order in the turn. The result also has a part along u, which callers
/// remove.
template <class Real>
EEPA_FUNCTION Vector3<Real> seen_at_mid_step(const ContactOf<Real> &c, const Vector3<Real> &vector)
{
  return vector + dot(vector, c.normal) * c.turn;
}

/// Relative velocity of the two surfaces in the tangent plane (contract, section 1).
///
/// v_t = (v_i - v_j) - ((v_i - v_j).u) u - (a_i omega_i + a_j omega_j) x u
///
/// with the u of the middle of the step, the time of the velocities, carried over to the present
/// plane. The spin needs this correction, because its part along u depends on the direction of u.
/// The velocity of the centres would need one of order v_n, which cancels over approach and
/// separation and is left out.
/// \param normal_velocity  v_n = (v_i - v_j).u
template <class Real>
EEPA_FUNCTION Vector3<Real> tangential_velocity(const ContactOf<Real> &c,
                                                const Real &normal_velocity)
{
  return c.velocity - normal_velocity * c.normal - seen_at_mid_step(c, c.spin).cross(c.normal);
}

// Winding a spring: the spring is rotated into the present plane and turned about u by the twist of
// the step, as the pair was (as in Yade's ScGeom::rotate). The displacement of the step belongs to
// its middle and turns by half the twist. The angle turned is atan(twist), smaller by twist^3/3.

namespace detail {
  /// The spring in the present plane, shortened by 1/sqrt(1 + twist^2), so that adding twist u x
  /// spring turns it at its full length. The series is exact for a twist of 1e-3, of a fast
  /// particle.
  template <class Real>
  EEPA_FUNCTION Vector3<Real> before_turning(const Vector3<Real> &spring, const ContactOf<Real> &c)
  {
    const Real squared = c.twist * c.twist;
    return rotate_into_plane<Real>(spring, c.normal, 1.0 - squared * (0.5 - 0.375 * squared));
  }
}    // namespace detail

/// A spring after a step: carried over, plus the displacement of the step [length]
/// \param spring  in the tangent plane of the step before [length]
/// \param velocity  in the present tangent plane [length/time]
template <class Real>
EEPA_FUNCTION Vector3<Real> wind(const Vector3<Real> &spring, const Vector3<Real> &velocity,
                                 double time_step, const ContactOf<Real> &c)
{
  const Vector3<Real> half_way = Real(0.5 * time_step) * velocity;
  const Vector3<Real> turning = detail::before_turning(spring, c) + half_way;
  return turning + half_way + c.twist * c.normal.cross(turning);
}

/// The part of wind() that is the spring of the step before, without the displacement [length]
template <class Real>
EEPA_FUNCTION Vector3<Real> carry_over(const Vector3<Real> &spring, const ContactOf<Real> &c)
{
  const Vector3<Real> carried = detail::before_turning(spring, c);
  return carried + c.twist * c.normal.cross(carried);
}

}    // namespace eepa

#endif
