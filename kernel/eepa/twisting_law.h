// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TWISTING_LAW_H
#define EEPA_TWISTING_LAW_H

#include "coefficients.h"
#include "contact.h"

namespace eepa {

// Twisting models are compile-time policies, as rolling models are: what resists the part of
// omega_i - omega_j along the normal.

/// (omega_i - omega_j).u, of which the sign is the same when i and j change places, with the u of
/// the middle of the step as all velocities [1/time]
template <class Real> EEPA_FUNCTION Real twisting_velocity(const ContactOf<Real> &contact)
{
  return dot<Real>(contact.angular_velocity, contact.normal - contact.turn);
}

/// Nothing resists.
struct TwistingNone {
  static constexpr TwistingModel model = TwistingModel::none;
  static constexpr bool has_spring = false;
};

/// Spring-dashpot-slider from the tangential coefficients (Marshall, Journal of Computational
/// Physics 228 (2009) 1541, equations 30-32 and 44; `twisting marshall` of LAMMPS's pair_style
/// granular): the tangential spring k_t and dashpot B_t, spread evenly over a circle of the contact
/// radius a = sqrt(R* delta), give k_t a^2/2 and B_t a^2/2, and friction on it 2/3 a times the
/// bound.
///
/// The spring is counted as the way zeta of an arm l = a/sqrt(2): zeta += l w dt,
/// g = -k_t zeta - B_t l w, torque l g. Where a does not change that is Marshall's; where it does,
/// the spring's energy k_t zeta^2/2 is not changed by it, while a spring of k_t a^2/2 on the angle
/// would be given energy by whatever presses the contact together.
struct TwistingMarshall {
  static constexpr TwistingModel model = TwistingModel::marshall;
  static constexpr bool has_spring = true;

  /// l = a/sqrt(2) [length]
  /// \param overlap  0 where the contact has opened
  template <class Real>
  EEPA_FUNCTION static Real arm(const Real &effective_radius, const Real &overlap)
  {
    using std::sqrt;
    return sqrt(0.5 * effective_radius * eepa::max<Real>(overlap, 0.0));
  }
  /// What |g| can not exceed: 2/3 a over the arm, times the friction bound [force]
  template <class Real>
  EEPA_FUNCTION static Real bound(const Coefficients &c, const Real &friction_bound)
  {
    return c.twisting_share * friction_bound;
  }

  /// Torque on i along u; j gets the opposite one.
  /// \param stiffness, inverse_stiffness  k_t of the contact and 1/k_t (0 where k_t = 0)
  /// \param viscous  B_t of the contact
  /// \param[in,out] spring  zeta [length]
  template <class Real>
  EEPA_FUNCTION static Real torque(const Coefficients &c, const ContactOf<Real> &contact,
                                   const Real &stiffness, const Real &inverse_stiffness,
                                   const Real &viscous, const Real &friction_bound,
                                   double time_step, Real &spring)
  {
    using std::abs;
    const Real lever = arm(contact.effective_radius, contact.overlap);
    const Real velocity = lever * twisting_velocity(contact);
    spring += Real(time_step) * velocity;
    const Real limit = bound(c, friction_bound);
    // as slider_force(), of one dimension
    const Real dashpot = -viscous * velocity;
    Real force = dashpot - stiffness * spring;
    const auto sliding = abs(force) > limit;
    const Real limited = select(force < 0.0, -limit, limit);
    const Real held = select(abs(dashpot) < limit, inverse_stiffness, Real(0.0));
    spring = select(sliding, held * (dashpot - limited), spring);
    force = select(sliding, limited, force);
    return lever * force;
  }
};

}    // namespace eepa

#endif
