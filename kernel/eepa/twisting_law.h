// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TWISTING_LAW_H
#define EEPA_TWISTING_LAW_H

#include "coefficients.h"
#include "contact.h"

namespace eepa {

// Twisting models are compile-time policies, as rolling models are. They resist the part of
// omega_i - omega_j along the normal.

/// (omega_i - omega_j).u with the u of the middle of the step, the time of the velocities [1/time].
/// Its sign stays the same when i and j change places.
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
/// The spring is the displacement zeta at the end of an arm l = a/sqrt(2): zeta += l w dt,
/// g = -k_t zeta - B_t l w, torque l g. For constant a this is Marshall's model. A change of a does
/// not change the spring's energy k_t zeta^2/2, while it would change that of a spring k_t a^2/2 on
/// the angle: pressing the contact together would put energy into it.
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
  /// Largest |g|: the friction bound times 2/3 a over the arm [force]
  template <class Number, class Real>
  EEPA_FUNCTION static Real bound(const CoefficientsOf<Number> &c, const Real &friction_bound)
  {
    return c.twisting_share * friction_bound;
  }

  /// Torque on i along u; j gets the opposite torque.
  /// \param stiffness, inverse_stiffness  k_t of the contact and 1/k_t (0 where k_t = 0)
  /// \param viscous  B_t of the contact
  /// \param[in,out] spring  zeta [length]
  template <class Number, class Real>
  EEPA_FUNCTION static Real torque(const CoefficientsOf<Number> &c, const ContactOf<Real> &contact,
                                   const Real &stiffness, const Real &inverse_stiffness,
                                   const Real &viscous, const Real &friction_bound,
                                   double time_step, Real &spring)
  {
    using std::abs;
    const Real lever = arm(contact.effective_radius, contact.overlap);
    const Real velocity = lever * twisting_velocity(contact);
    spring += Real(time_step) * velocity;
    const Real limit = bound(c, friction_bound);
    // slider_force() in one dimension
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
