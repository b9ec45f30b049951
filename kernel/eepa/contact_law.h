// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_CONTACT_LAW_H
#define EEPA_CONTACT_LAW_H

#include "body.h"
#include "coefficients.h"
#include "contact.h"
#include "history.h"
#include "normal_law.h"
#include "rolling_law.h"
#include "tangential_law.h"
#include "twisting_law.h"

namespace eepa {

/// Result of the law. Forces and rolling torque act on i, their opposites on j;
/// ContactLaw::wrench() turns them into the force and torques on each partner.
template <class Real> struct ResponseOf {
  Real normal_force;                 ///< f_hys + f_nd along u [force]
  Real hysteretic_force;             ///< f_hys [force]
  Vector3<Real> tangential_force;    ///< on i [force]
  Vector3<Real> rolling_torque;      ///< on i [force length]; unset when the model is RollingNone
  Real twisting_torque;              ///< on i along u [force length]; unset with TwistingNone
  Real friction_bound;               ///< largest |f_t|, >= 0 [force]
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
  EEPA_FUNCTION void add(const StoredEnergy &other, double share)
  {
    normal += share * other.normal;
    tangential += share * other.tangential;
    rolling += share * other.rolling;
    twisting += share * other.twisting;
  }
};

/// Coefficients of the dashpots of a contact [mass/time]
template <class Real> struct Dashpots {
  Real root_mass_stiffness;    ///< sqrt(m* k), k the loading branch's tangent stiffness
  Real normal, tangential;     ///< B_n and B_t
};

template <class NormalLaw, class Number, class Real>
EEPA_FUNCTION Dashpots<Real> dashpots(const CoefficientsOf<Number> &c, const ScaleOf<Real> &scale,
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

/// Largest |f_t| [force]. It depends on f_hys, never on the normal dashpot.
template <class Number, class Real>
EEPA_FUNCTION Real friction_bound(const CoefficientsOf<Number> &c,
                                  const NormalForceOf<Real> &normal)
{
  const Real adhesive = eepa::max<Real>(c.mu * normal.coulomb_force + normal.coulomb_offset, 0.0);
  const auto by_contact = c.contact_bound > 0.0;
  if (!any(by_contact)) return adhesive;
  return select(by_contact, Real(c.mu * eepa::max<Real>(normal.force, 0.0)), adhesive);
}

/// The law of one contact: normal, tangential, damping, rolling and twisting composed.
/// \tparam NormalLaw  of dispatch.h
/// \tparam RollingLaw  RollingNone, RollingConstant or RollingSds
/// \tparam TwistingLaw  TwistingNone or TwistingMarshall
template <class NormalLaw, class RollingLaw, class TwistingLaw = TwistingNone> struct ContactLaw {
  using Normal = NormalLaw;
  using Rolling = RollingLaw;
  using Twisting = TwistingLaw;
  using Layout = HistoryLayout<RollingLaw::has_spring, TwistingLaw::has_spring>;
  static constexpr bool has_rolling = RollingLaw::model != RollingModel::none;
  static constexpr bool has_twisting = TwistingLaw::model != TwistingModel::none;
  /// whether the law gives a couple from the relative angular velocity, beside friction's torques
  static constexpr bool has_couple = has_rolling || has_twisting;
  /// whether a contact needs its effective radius
  static constexpr bool reads_effective_radius = has_couple || NormalLaw::reads_effective_radius;
  static constexpr int history_size = Layout::size;

  /// Relation of the coefficients of a contact to those at d_ref.
  template <class Number, class Real>
  EEPA_FUNCTION static ScaleOf<Real> scale_of(const CoefficientsOf<Number> &c,
                                              const ContactOf<Real> &contact)
  {
    ScaleOf<Real> scale = contact_scale(c, contact.size);
    if constexpr (NormalLaw::reads_effective_radius)
      scale.effective_radius = contact.effective_radius;
    return scale;
  }

  /// Forces of a contact and its state after this step.
  ///
  /// \tparam Number  double: the coefficients of all contacts; or Real: each contact has its own
  /// \param c  coefficients of its pair of types
  /// \param contact  geometry and motion, overlap > 0
  /// \param time_step  over which the springs are wound [time]; 0 in a set-up call, after which
  ///        the caller must discard the returned history
  /// \param[in,out] history  the state before and after
  template <class Number, class Real>
  EEPA_FUNCTION static ResponseOf<Real> evaluate(const CoefficientsOf<Number> &c,
                                                 const ContactOf<Real> &contact, double time_step,
                                                 HistoryOf<Real> &history)
  {
    using std::abs;
    ResponseOf<Real> response;
    const Real none(0.0);
    const ScaleOf<Real> scale = scale_of(c, contact);
    const NormalForceOf<Real> normal =
        NormalLaw::force(c, scale, contact.overlap, history.max_overlap);
    history.max_overlap = normal.max_overlap;
    response.branch = normal.branch;
    response.hysteretic_force = normal.force;

    const Dashpots<Real> viscous =
        dashpots<NormalLaw>(c, scale, contact.effective_mass, contact.overlap);
    const Real normal_velocity = dot(contact.velocity, contact.normal);
    response.normal_force = normal.force - viscous.normal * normal_velocity;
    if (c.limit_damping)
      response.normal_force = eepa::max(response.normal_force, eepa::min(normal.force, none));

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
  /// \param history  the state that evaluate() left for this overlap
  EEPA_FUNCTION static StoredEnergy stored_energy(const Coefficients &c, const Contact &contact,
                                                  const History &history)
  {
    const Scale scale = scale_of(c, contact);
    StoredEnergy energy;
    energy.normal = NormalLaw::elastic_energy(c, scale, contact.overlap, history.max_overlap);
    energy.tangential = spring_energy(scale.stiffness() * c.kt, history.tangential_spring);
    if constexpr (RollingLaw::has_spring)
      energy.rolling = spring_energy(scale.stiffness() * c.kr, history.rolling_spring);
    if constexpr (TwistingLaw::has_spring)
      energy.twisting =
          0.5 * scale.stiffness() * c.kt * history.twisting_spring * history.twisting_spring;
    return energy;
  }

  /// Force and torques on each partner.
  template <class Real>
  EEPA_FUNCTION static Wrench<Real> wrench(const ResponseOf<Real> &response,
                                           const ContactOf<Real> &contact)
  {
    Wrench<Real> result;
    result.force = response.normal_force * contact.normal + response.tangential_force;
    const Vector3<Real> moment = contact.normal.cross(response.tangential_force);
    result.torque_i = -contact.arm_i * moment;
    result.torque_j = -contact.arm_j * moment;
    if constexpr (has_rolling) {
      result.torque_i += response.rolling_torque;
      result.torque_j -= response.rolling_torque;
    }
    if constexpr (has_twisting) {
      const Vector3<Real> twisting = response.twisting_torque * contact.normal;
      result.torque_i += twisting;
      result.torque_j -= twisting;
    }
    return result;
  }
};

}    // namespace eepa

#endif
