// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_ROLLING_LAW_H
#define EEPA_ROLLING_LAW_H

#include "coefficients.h"
#include "contact.h"
#include "history.h"
#include "tangential_law.h"

namespace eepa {

// Rolling models are compile-time policies with one function,
//   torque(coefficients, scale, contact, |f_hys|, sqrt(m* k), time step, spring)
// that returns the torque on i; j gets the opposite torque. Only Sds reads and writes `spring`. All
// act on the part of omega_i - omega_j in the tangent plane; twisting_law.h has the part along u.

/// The part of omega_i - omega_j in the tangent plane [1/time]
template <class Real> EEPA_FUNCTION Vector3<Real> rolling_velocity(const ContactOf<Real> &contact)
{
  return contact.angular_velocity - dot(contact.angular_velocity, contact.normal) * contact.normal;
}

/// No rolling resistance.
struct RollingNone {
  static constexpr RollingModel model = RollingModel::none;
  static constexpr bool has_spring = false;
};

/// Directional constant torque, -mu_r |f_hys| R* along the relative rolling velocity
/// (article, section 5; Ai et al., Powder Technology 206 (2011) 269, model A).
///
/// At slow rolling a dashpot, c = 2/5 R*^2 sqrt(m* k1), caps the torque. Below the time-step bound
/// this dashpot does not overshoot even in a particle with a dozen contacts, so the torque neither
/// drives a particle at rest nor makes it chatter. The torque is a function of the state alone, so
/// results converge with the time step.
struct RollingConstant {
  static constexpr RollingModel model = RollingModel::constant;
  static constexpr bool has_spring = false;

  /// The present plane is accurate enough here, because this velocity winds no spring.
  template <class Real> EEPA_FUNCTION static Vector3<Real> velocity(const ContactOf<Real> &contact)
  {
    return rolling_velocity(contact);
  }
  /// c of the dashpot that caps the torque [force length time]
  template <class Real>
  EEPA_FUNCTION static Real dashpot(const Real &effective_radius, const Real &root_mass_stiffness)
  {
    return 0.4 * effective_radius * effective_radius * root_mass_stiffness;
  }
  /// The torque of fast rolling [force length]
  template <class Number, class Real>
  EEPA_FUNCTION static Real bound(const CoefficientsOf<Number> &c, const Real &effective_radius,
                                  const Real &hysteretic)
  {
    return c.mu_r * hysteretic * effective_radius;
  }

  /// \param hysteretic  |f_hys| [force]
  /// \param root_mass_stiffness  sqrt(m* k) [mass/time]
  template <class Number, class Real>
  EEPA_FUNCTION static Vector3<Real>
  torque(const CoefficientsOf<Number> &c, const ScaleOf<Real> &, const ContactOf<Real> &contact,
         const Real &hysteretic, const Real &root_mass_stiffness, double, Vector3<Real> &)
  {
    using std::sqrt;
    const Real &radius = contact.effective_radius;
    const Vector3<Real> rolling = velocity(contact);
    const Real limit = bound(c, radius, hysteretic);
    const Real cap = dashpot(radius, root_mass_stiffness);
    const Real rate_squared = squared_length(rolling);
    const auto limited = cap * cap * rate_squared > limit * limit;
    Real viscous = cap;
    if (any(limited))
      viscous = select(limited, limit / sqrt(select(limited, rate_squared, Real(1.0))), cap);
    return -viscous * rolling;
  }
};

/// Spring-dashpot-slider on the rolling displacement (Luding 2008, section 2.4; as `rolling
/// sds` of LAMMPS's pair_style granular).
///
/// The spring is kept along the spin, theta += R* w dt with w the tangent-plane part of
/// omega_i - omega_j. It changes its sign when i and j change places, as LAMMPS assumes of all
/// history; the customary rolling displacement along w x u does not.
/// Pseudo-force g = -kr theta - gr R* w, bounded by mu_r |f_hys|; torque R* g.
struct RollingSds {
  static constexpr RollingModel model = RollingModel::sds;
  static constexpr bool has_spring = true;

  /// Built with the normal of the middle of the step, see seen_at_mid_step().
  template <class Real> EEPA_FUNCTION static Vector3<Real> velocity(const ContactOf<Real> &contact)
  {
    return rolling_velocity(contact) + dot(contact.angular_velocity, contact.normal) * contact.turn;
  }
  /// B of the pseudo-force, gr of this contact [mass/time]
  template <class Number, class Real>
  EEPA_FUNCTION static Real dashpot(const CoefficientsOf<Number> &c, const ScaleOf<Real> &scale)
  {
    return scale.force() * c.rolling_viscous;
  }
  /// Largest |g| [force]
  template <class Number, class Real>
  EEPA_FUNCTION static Real bound(const CoefficientsOf<Number> &c, const Real &hysteretic)
  {
    return c.mu_r * hysteretic;
  }

  template <class Number, class Real>
  EEPA_FUNCTION static Vector3<Real> torque(const CoefficientsOf<Number> &c,
                                            const ScaleOf<Real> &scale,
                                            const ContactOf<Real> &contact, const Real &hysteretic,
                                            const Real &, double time_step, Vector3<Real> &spring)
  {
    const Real &radius = contact.effective_radius;
    const Vector3<Real> rolled = radius * velocity(contact);
    spring = wind<Real>(spring, rolled, time_step, contact);
    const SliderForce<Real> roll =
        slider_force<Real>(scale.stiffness() * c.kr, scale.inverse_size * c.inverse_kr,
                           dashpot(c, scale), bound(c, hysteretic), rolled, spring);
    return radius * roll.force;
  }
};

}    // namespace eepa

#endif
