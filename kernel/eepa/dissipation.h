// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_DISSIPATION_H
#define EEPA_DISSIPATION_H

#include "contact_law.h"

namespace eepa {

/// Energy that contacts dissipated, by mechanism [force length]. No term ever decreases, except
/// hysteresis of `plateau` with f0 != 0 (see PlateauLaw::opening_loss).
struct Dissipation {
  double hysteresis = 0.0;
  double normal_dashpot = 0.0;
  double tangential_dashpot = 0.0;
  double sliding = 0.0;
  double rolling = 0.0;
  double twisting = 0.0;

  /// The losses side by side, in the order of their declaration.
  struct Kinds {
    static constexpr int count = 6;
    double value[count];
  };
  EEPA_FUNCTION Kinds by_kind() const
  {
    return {{hysteresis, normal_dashpot, tangential_dashpot, sliding, rolling, twisting}};
  }
  EEPA_FUNCTION double total() const
  {
    return hysteresis + normal_dashpot + tangential_dashpot + sliding + rolling + twisting;
  }
  EEPA_FUNCTION void add(const Dissipation &other, double share)
  {
    hysteresis += share * other.hysteresis;
    normal_dashpot += share * other.normal_dashpot;
    tangential_dashpot += share * other.tangential_dashpot;
    sliding += share * other.sliding;
    rolling += share * other.rolling;
    twisting += share * other.twisting;
  }
};

// Velocity Verlet turns the trapezoid work (f_n-1 + f_n)/2 . v_n-1/2 dt into kinetic energy:
// springs are booked by their state, dashpots by that work with the last force estimated from the
// present velocity. Derivation and order of the error: tests/kernel/DISSIPATION.md.

namespace detail {
  /// Power that a step books for the present force of a dashpot.
  /// \param force, speed  |f| and |v|
  /// \param power  -f.v. It is |f| |v| unless the slider has just let go of a spring: f then has
  ///        that spring's force, and the power is negative where that force drives the motion
  EEPA_FUNCTION double dashpot_now(double viscous, double force, double speed, double power)
  {
    if (!(viscous > 0.0)) return 0.0;
    return power + (0.25 * force / viscous - 0.5 * speed) * force;
  }
  /// Power that a step books for the dashpot's force in the step before, which was at most `bound`.
  /// \param booked  whether dashpot_now() has booked that force; it does not book a set-up's
  EEPA_FUNCTION double dashpot_before(double viscous, double bound, double speed, bool booked)
  {
    if (!(viscous > 0.0)) return 0.0;
    const double force = viscous * speed < bound ? viscous * speed : bound;
    return (0.5 * speed - (booked ? 0.25 * force / viscous : 0.0)) * force;
  }

  /// Loss of a slider over one step: the spring's trapezoid work less what the spring stores of it.
  /// \param before, after  the spring at the beginning of the step, carried over, and at its end
  /// \param trial  the spring as wound, before the slider: exactly `after` where nothing slid
  EEPA_FUNCTION double slip_loss(double stiffness, const Vec3 &before, const Vec3 &after,
                                 const Vec3 &trial)
  {
    return 0.5 * stiffness * (before + after).dot(trial - after);
  }
  /// The same for a spring of one dimension.
  EEPA_FUNCTION double slip_loss(double stiffness, double before, double after, double trial)
  {
    return 0.5 * stiffness * (before + after) * (trial - after);
  }

  /// Loss of a spring that is let go in a step: what it stored and its trapezoid work. The sum is
  /// negative only where the spring is shorter than the displacement, and counts as 0 there.
  EEPA_FUNCTION double release_loss(double stiffness, const Vec3 &spring, const Vec3 &displacement)
  {
    const double loss = 0.5 * stiffness * spring.dot(spring + displacement);
    return loss > 0.0 ? loss : 0.0;
  }

  /// The bound on a dashpot's force, by the spring beside it: only where the slider left that
  /// spring empty was the dashpot cut at the bound.
  EEPA_FUNCTION double dashpot_bound(const Vec3 &spring, double bound)
  {
    return spring.squaredNorm() > 0.0 ? HUGE_VAL : bound;
  }

  /// Adds to `lost` what the dashpots' forces of the step before dissipate in this step.
  /// \param last  state after the step before
  template <class ContactLaw>
  EEPA_FUNCTION void book_step_before(const Coefficients &c, const Scale &scale,
                                      const Contact &contact, double time_step, const History &last,
                                      bool booked, Dissipation &lost)
  {
    using Normal = typename ContactLaw::Normal;
    const double normal_velocity = dot(contact.velocity, contact.normal);
    const double overlap = eepa::max(overlap_before(contact, time_step), 0.0);
    const NormalForce normal = Normal::force(c, scale, overlap, last.max_overlap);
    const Dashpots<double> viscous = dashpots<Normal>(c, scale, contact.effective_mass, overlap);

    const bool limited = c.limit_damping && normal_velocity > 0.0;
    const double tension_free = normal.force > 0.0 ? normal.force : 0.0;
    lost.normal_dashpot += time_step *
        dashpot_before(viscous.normal, limited ? tension_free : HUGE_VAL,
                       std::fabs(normal_velocity), booked);
    lost.tangential_dashpot += time_step *
        dashpot_before(viscous.tangential,
                       dashpot_bound(last.tangential_spring, friction_bound(c, normal)),
                       tangential_velocity(contact, normal_velocity).norm(), booked);
    if constexpr (ContactLaw::has_rolling) {
      using Rolling = typename ContactLaw::Rolling;
      const double hysteretic = std::fabs(normal.force), radius = contact.effective_radius;
      const double rate = Rolling::velocity(contact).norm();
      if constexpr (Rolling::has_spring)
        lost.rolling += time_step *
            dashpot_before(Rolling::dashpot(c, scale),
                           dashpot_bound(last.rolling_spring, Rolling::bound(c, hysteretic)),
                           radius * rate, booked);
      else
        lost.rolling += time_step *
            dashpot_before(Rolling::dashpot(radius, viscous.root_mass_stiffness),
                           Rolling::bound(c, radius, hysteretic), rate, booked);
    }
    if constexpr (ContactLaw::has_twisting) {
      using Twisting = typename ContactLaw::Twisting;
      const double speed =
          std::fabs(Twisting::arm(contact.effective_radius, overlap) * twisting_velocity(contact));
      const double limit =
          last.twisting_spring != 0.0 ? HUGE_VAL : Twisting::bound(c, friction_bound(c, normal));
      lost.twisting += time_step * dashpot_before(viscous.tangential, limit, speed, booked);
    }
  }
}    // namespace detail

/// Dissipation of a contact over the step that evaluate() has just made.
/// \param before, after  its state before and after evaluate()
/// \param first  whether the contact formed in this step
/// \param booked  whether the step before was booked too; false where the ledger starts. A contact
///        that is not new but has no state had its force in a set-up, which books nothing.
template <class ContactLaw>
EEPA_FUNCTION Dissipation dissipation_of_step(const Coefficients &c, const Contact &contact,
                                              const Response &response, double time_step,
                                              bool first, const History &before,
                                              const History &after, bool booked = true)
{
  Dissipation lost;
  const Scale scale = ContactLaw::scale_of(c, contact);
  const double normal_velocity = dot(contact.velocity, contact.normal);
  // a contact that starts with an overlap (first step of a packing) was not loaded up to it
  double loaded = before.max_overlap;
  if (loaded == 0.0)
    loaded = eepa::min(eepa::max(overlap_before(contact, time_step), 0.0), contact.overlap);
  lost.hysteresis = ContactLaw::Normal::loss(c, scale, loaded, after.max_overlap);
  if (!first)
    detail::book_step_before<ContactLaw>(c, scale, contact, time_step, before,
                                         booked && before.max_overlap != 0.0, lost);

  const Dashpots<double> viscous =
      dashpots<typename ContactLaw::Normal>(c, scale, contact.effective_mass, contact.overlap);
  const double damping = std::fabs(response.normal_force - response.hysteretic_force);
  const double speed = std::fabs(normal_velocity);
  lost.normal_dashpot +=
      time_step * detail::dashpot_now(viscous.normal, damping, speed, damping * speed);

  const double stiffness = scale.stiffness() * c.kt;
  const Vec3 velocity = tangential_velocity(contact, normal_velocity);
  const Vec3 dashpot = response.tangential_force + stiffness * after.tangential_spring;
  const double taken = time_step *
      detail::dashpot_now(viscous.tangential, dashpot.norm(), velocity.norm(),
                          -dashpot.dot(velocity));
  lost.sliding = detail::slip_loss(
      stiffness, carry_over(before.tangential_spring, contact), after.tangential_spring,
      wind<double>(before.tangential_spring, velocity, time_step, contact));
  // negative where a spring was let go and drives: that is part of the slip
  (taken < 0.0 ? lost.sliding : lost.tangential_dashpot) += taken;

  if constexpr (ContactLaw::has_rolling) {
    using Rolling = typename ContactLaw::Rolling;
    // torque . (omega_i - omega_j) is the power of either model
    const Vec3 rate = Rolling::velocity(contact);
    const double radius = contact.effective_radius;
    if constexpr (Rolling::has_spring) {
      const double kr = scale.stiffness() * c.kr;
      const Vec3 rolled = radius * rate;
      const Vec3 viscous_part = response.rolling_torque / radius + kr * after.rolling_spring;
      lost.rolling += time_step *
              detail::dashpot_now(Rolling::dashpot(c, scale), viscous_part.norm(), rolled.norm(),
                                  -viscous_part.dot(rolled)) +
          detail::slip_loss(kr, carry_over(before.rolling_spring, contact), after.rolling_spring,
                            wind<double>(before.rolling_spring, rolled, time_step, contact));
    } else {
      const double torque = response.rolling_torque.norm(), spin = rate.norm();
      lost.rolling += time_step *
          detail::dashpot_now(Rolling::dashpot(radius, viscous.root_mass_stiffness), torque, spin,
                              torque * spin);
    }
  }
  if constexpr (ContactLaw::has_twisting) {
    const double arm = ContactLaw::Twisting::arm(contact.effective_radius, contact.overlap);
    const double twisted = arm * twisting_velocity(contact);
    const double viscous_part = response.twisting_torque / arm + stiffness * after.twisting_spring;
    lost.twisting += time_step *
            detail::dashpot_now(viscous.tangential, std::fabs(viscous_part), std::fabs(twisted),
                                -viscous_part * twisted) +
        detail::slip_loss(stiffness, before.twisting_spring, after.twisting_spring,
                          before.twisting_spring + time_step * twisted);
  }
  return lost;
}

/// Dissipation of a contact that has opened: what it still stored, and the last part of dashpots.
/// \param contact  at present, overlap <= 0; > 0 where it was taken away, by a group for instance
/// \param last  its state after its last step
/// \param booked  as in dissipation_of_step()
template <class ContactLaw>
EEPA_FUNCTION Dissipation dissipation_of_opening(const Coefficients &c, const Contact &contact,
                                                 double time_step, const History &last,
                                                 bool booked = true)
{
  using Normal = typename ContactLaw::Normal;
  Dissipation lost;
  const Scale scale = ContactLaw::scale_of(c, contact);
  const double normal_velocity = dot(contact.velocity, contact.normal);
  if (contact.overlap > 0.0) {
    // what it stored one step ago, less the trapezoid work of the force then
    const double overlap = eepa::max(overlap_before(contact, time_step), 0.0);
    lost.hysteresis = Normal::elastic_energy(c, scale, overlap, last.max_overlap) -
        0.5 * time_step * normal_velocity *
            Normal::force(c, scale, overlap, last.max_overlap).force;
  } else {
    lost.hysteresis = Normal::opening_loss(c, scale, last.max_overlap);
  }
  const Vec3 slip = time_step * tangential_velocity(contact, normal_velocity);
  lost.sliding = detail::release_loss(scale.stiffness() * c.kt, last.tangential_spring, slip);
  if constexpr (ContactLaw::Rolling::has_spring)
    lost.rolling = detail::release_loss(scale.stiffness() * c.kr, last.rolling_spring,
                                        time_step * contact.effective_radius *
                                            ContactLaw::Rolling::velocity(contact));
  // the arm is 0 at opening, so this spring did no work in the step
  if constexpr (ContactLaw::Twisting::has_spring)
    lost.twisting = 0.5 * scale.stiffness() * c.kt * last.twisting_spring * last.twisting_spring;
  detail::book_step_before<ContactLaw>(c, scale, contact, time_step, last,
                                       booked && last.max_overlap != 0.0, lost);
  return lost;
}

}    // namespace eepa

#endif
