// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_CONTACT_LAW_H
#define EEPA_CONTACT_LAW_H

#include "coefficients.h"
#include "contact.h"
#include "history.h"
#include "normal_law.h"
#include "rolling_law.h"
#include "tangential_law.h"
#include "twisting_law.h"

namespace eepa {

/// What a contact does to its partners. Forces and rolling torque act on i, their opposites
/// on j; the tangential force also turns both, see tangential_moment().
template <class Real> struct ResponseOf {
  Real normal_force;                 ///< f_hys + f_nd along u [force]
  Real hysteretic_force;             ///< f_hys [force]
  Vector3<Real> tangential_force;    ///< on i [force]
  Vector3<Real> rolling_torque;      ///< on i [force length]; unset when the model is RollingNone
  Real twisting_torque;              ///< on i along u [force length]; unset with TwistingNone
  Real friction_bound;               ///< what |f_t| can not exceed, >= 0 [force]
  BranchOf<Real> branch;
  MaskOf<Real> sliding;
};
using Response = ResponseOf<double>;

/// Recoverable energies of a contact [force length]
struct StoredEnergy {
  double normal = 0.0;        ///< of the hysteretic spring and the pull-off force
  double tangential = 0.0;    ///< of the tangential spring
  double rolling = 0.0;       ///< of the rolling spring
  double twisting = 0.0;      ///< of the twisting spring
  EEPA_FUNCTION double total() const { return normal + tangential + rolling + twisting; }
};

/// Coefficients of the dashpots of a contact [mass/time]
template <class Real> struct Dashpots {
  Real root_mass_stiffness;    ///< sqrt(m* k), k the loading branch's tangent stiffness
  Real normal, tangential;     ///< B_n and B_t
};

template <class NormalLaw, class Real>
EEPA_FUNCTION Dashpots<Real> dashpots(const Coefficients &c, const ScaleOf<Real> &scale,
                                      const Real &effective_mass, const Real &overlap)
{
  using std::sqrt;
  Dashpots<Real> result;
  Real stiffness = scale.stiffness() * c.k1;
  if constexpr (!NormalLaw::Exponent::is_unit)
    stiffness *= NormalLaw::Exponent::slope(overlap, c, scale);
  result.root_mass_stiffness = sqrt(effective_mass * stiffness);
  const Real normal_part = c.restitution_damping * result.root_mass_stiffness;
  Real tangential_part = normal_part * c.tangential_ratio;
  if constexpr (!NormalLaw::Exponent::is_unit)
    tangential_part = c.restitution_damping * sqrt(effective_mass * scale.stiffness() * c.kt);
  result.normal = normal_part + scale.force() * c.viscous_normal;
  result.tangential = tangential_part + scale.force() * c.viscous_tangential;
  return result;
}

/// What |f_t| can not exceed: it has f_hys, never the dashpot. [force]
template <class Real>
EEPA_FUNCTION Real friction_bound(const Coefficients &c, const NormalForceOf<Real> &normal)
{
  return larger<Real>(c.mu * normal.coulomb_force + normal.coulomb_offset, 0.0);
}

/// The law of one contact: normal, tangential, damping, rolling and twisting composed.
/// \tparam NormalLaw  PlateauLaw, LinearLaw<UnitExponent> or LinearLaw<GeneralExponent>
/// \tparam RollingLaw  RollingNone, RollingConstant or RollingSds
/// \tparam TwistingLaw  TwistingNone or TwistingMarshall
template <class NormalLaw, class RollingLaw, class TwistingLaw = TwistingNone> struct ContactLaw {
  using Normal = NormalLaw;
  using Rolling = RollingLaw;
  using Twisting = TwistingLaw;
  using Layout = HistoryLayout<RollingLaw::has_spring, TwistingLaw::has_spring>;
  static constexpr bool has_rolling = RollingLaw::model != RollingModel::none;
  static constexpr bool has_twisting = TwistingLaw::model != TwistingModel::none;
  /// whether it gives a couple beside the torques of friction, from the relative angular velocity
  static constexpr bool has_couple = has_rolling || has_twisting;
  static constexpr int history_size = Layout::size;

  /// Forces of a contact and its state after this step.
  ///
  /// \param c  coefficients of its pair of types
  /// \param limit_damping  the normal dashpot adds no tension: f_n >= min(f_hys, 0)
  /// \param contact  geometry and motion, overlap > 0
  /// \param time_step  by which the springs are wound [time]; 0 in a set-up call, after which
  ///        the caller must throw the returned history away
  /// \param[in,out] history  the state before and after
  template <class Real>
  EEPA_FUNCTION static ResponseOf<Real> evaluate(const Coefficients &c, bool limit_damping,
                                                 const ContactOf<Real> &contact, double time_step,
                                                 HistoryOf<Real> &history)
  {
    using std::abs;
    ResponseOf<Real> response;
    const Real none(0.0);
    const ScaleOf<Real> scale = contact_scale(c, contact.size);
    const NormalForceOf<Real> normal =
        NormalLaw::force(c, scale, contact.overlap, history.max_overlap);
    history.max_overlap = normal.max_overlap;
    response.branch = normal.branch;
    response.hysteretic_force = normal.force;

    const Dashpots<Real> viscous =
        dashpots<NormalLaw>(c, scale, contact.effective_mass, contact.overlap);
    const Real normal_velocity = dot(contact.velocity, contact.normal);
    response.normal_force = normal.force - viscous.normal * normal_velocity;
    if (limit_damping)
      response.normal_force = larger(response.normal_force, smaller(normal.force, none));

    response.friction_bound = friction_bound(c, normal);
    const Vector3<Real> velocity = tangential_velocity(contact, normal_velocity);
    Vector3<Real> &spring = history.tangential_spring;
    spring = wind<Real>(spring, velocity, time_step, contact);
    const SliderForce<Real> friction =
        slider_force<Real>(scale.stiffness() * c.kt, scale.inverse_size * c.inverse_kt,
                           viscous.tangential, response.friction_bound, velocity, spring);
    response.tangential_force = friction.force;
    response.sliding = friction.sliding;

    if constexpr (has_rolling)
      response.rolling_torque =
          RollingLaw::torque(c, scale, contact, Real(abs(normal.force)),
                             viscous.root_mass_stiffness, time_step, history.rolling_spring);
    if constexpr (has_twisting)
      response.twisting_torque = TwistingLaw::torque(
          c, contact, scale.stiffness() * c.kt, scale.inverse_size * c.inverse_kt,
          viscous.tangential, response.friction_bound, time_step, history.twisting_spring);
    return response;
  }

  /// Recoverable energy of a contact.
  /// \param size, overlap  as in Contact
  /// \param history  the state that evaluate() left for this overlap
  EEPA_FUNCTION static StoredEnergy stored_energy(const Coefficients &c, double size,
                                                  double overlap, const History &history)
  {
    const Scale scale = contact_scale(c, size);
    StoredEnergy energy;
    energy.normal = NormalLaw::elastic_energy(c, scale, overlap, history.max_overlap);
    energy.tangential = spring_energy(scale.stiffness() * c.kt, history.tangential_spring);
    if constexpr (RollingLaw::has_spring)
      energy.rolling = spring_energy(scale.stiffness() * c.kr, history.rolling_spring);
    if constexpr (TwistingLaw::has_spring)
      energy.twisting =
          0.5 * scale.stiffness() * c.kt * history.twisting_spring * history.twisting_spring;
    return energy;
  }

  /// Force on i.
  template <class Real>
  EEPA_FUNCTION static Vector3<Real> force_on_i(const ResponseOf<Real> &response,
                                                const ContactOf<Real> &contact)
  {
    return response.normal_force * contact.normal + response.tangential_force;
  }

  /// Adds the couple of rolling and twisting to the torques of both partners.
  template <class Real>
  EEPA_FUNCTION static void add_couple(const ResponseOf<Real> &response,
                                       const ContactOf<Real> &contact, Vector3<Real> &torque_i,
                                       Vector3<Real> &torque_j)
  {
    if constexpr (has_rolling) {
      torque_i += response.rolling_torque;
      torque_j -= response.rolling_torque;
    }
    if constexpr (has_twisting) {
      const Vector3<Real> twisting = response.twisting_torque * contact.normal;
      torque_i += twisting;
      torque_j -= twisting;
    }
  }

  /// u x f_t: times -lever_arm() it is the tangential force's torque on either partner.
  template <class Real>
  EEPA_FUNCTION static Vector3<Real> tangential_moment(const ResponseOf<Real> &response,
                                                       const ContactOf<Real> &contact)
  {
    return contact.normal.cross(response.tangential_force);
  }
};

}    // namespace eepa

#endif
