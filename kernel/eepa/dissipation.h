// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_DISSIPATION_H
#define EEPA_DISSIPATION_H

#include "contact_law.h"

namespace eepa {

/// Where the energy of a contact went [force length]. No term ever decreases, but hysteresis of
/// `plateau` with f0 != 0 (see PlateauLaw::opening_loss).
struct Dissipation {
  double hysteresis = 0.0;
  double normal_dashpot = 0.0;
  double tangential_dashpot = 0.0;
  double sliding = 0.0;
  double rolling = 0.0;

  EEPA_FUNCTION double total() const
  {
    return hysteresis + normal_dashpot + tangential_dashpot + sliding + rolling;
  }
  EEPA_FUNCTION void add(const Dissipation &other, double share)
  {
    hysteresis += share * other.hysteresis;
    normal_dashpot += share * other.normal_dashpot;
    tangential_dashpot += share * other.tangential_dashpot;
    sliding += share * other.sliding;
    rolling += share * other.rolling;
  }
};

// Velocity Verlet turns the work (f_n-1 + f_n)/2 . v_n-1/2 dt into kinetic energy, and a force
// call sees x_n and v_n-1/2. Springs are therefore booked by their state, which is that
// trapezoid. For a dashpot f = -B v the trapezoid summed over a contact's life is the sum of
// B v^2 dt, less B v^2 dt/4 at its first step, plus B v^2 dt/4 after its last: booked so, every
// term is >= 0 and nothing of the step before needs to be remembered.

namespace detail {
  /// Loss of a slider over one step: the spring's trapezoid work less what it stores of it.
  EEPA_FUNCTION double slip_loss(double stiffness, const Vec3 &before, const Vec3 &after,
                                 const Vec3 &displacement)
  {
    return 0.5 * stiffness * (before + after).dot(before + displacement - after);
  }
}    // namespace detail

/// Dissipation of a contact over the step that evaluate() has just made.
/// \param before, after  its state before and after evaluate()
/// \param first  whether the contact formed in this step
template <class ContactLaw>
EEPA_FUNCTION Dissipation dissipation_of_step(const Coefficients &c, const Contact &contact,
                                              const Response &response, double time_step,
                                              bool first, const History &before,
                                              const History &after)
{
  Dissipation lost;
  const Scale scale = contact_scale(c, contact.size);
  const double share = first ? 0.75 : 1.0;
  const double normal_velocity = dot(contact.velocity, contact.normal);
  // a contact that starts with an overlap (a packing's first step) was not loaded up to it
  double loaded = before.max_overlap;
  if (loaded == 0.0) {
    loaded = contact.overlap + normal_velocity * time_step;
    if (loaded < 0.0) loaded = 0.0;
    if (loaded > contact.overlap) loaded = contact.overlap;
  }
  lost.hysteresis = ContactLaw::Normal::loss(c, scale, loaded, after.max_overlap);

  lost.normal_dashpot =
      -share * time_step * normal_velocity * (response.normal_force - response.hysteretic_force);

  const double stiffness = scale.stiffness() * c.kt;
  const Vec3 velocity = tangential_velocity(contact, normal_velocity);
  const Vec3 dashpot = response.tangential_force + stiffness * after.tangential_spring;
  lost.tangential_dashpot = -share * time_step * dashpot.dot(velocity);
  lost.sliding =
      detail::slip_loss(stiffness, rotate_into_plane(before.tangential_spring, contact.normal),
                        after.tangential_spring, time_step * velocity);
  if (lost.tangential_dashpot < 0.0) {
    // the slider let go of a spring that outweighed the dashpot: its part of the slip
    lost.sliding += lost.tangential_dashpot;
    lost.tangential_dashpot = 0.0;
  }

  if constexpr (ContactLaw::has_rolling) {
    // torque . (omega_i - omega_j) is the power of either model
    const double work = time_step * response.rolling_torque.dot(contact.angular_velocity);
    lost.rolling = -share * work;
    if constexpr (ContactLaw::Rolling::has_spring) {
      const double kr = scale.stiffness() * c.kr;
      const Vec3 rolled = contact.effective_radius *
          (contact.angular_velocity -
           contact.angular_velocity.dot(contact.normal) * contact.normal);
      const Vec3 earlier = rotate_into_plane(before.rolling_spring, contact.normal);
      lost.rolling = detail::slip_loss(kr, earlier, after.rolling_spring, time_step * rolled) -
          share * (work + kr * time_step * after.rolling_spring.dot(rolled));
    }
  }
  return lost;
}

/// Dissipation of a contact that has opened: what it still stored, and the dashpot's last part.
/// \param contact  as it is now, overlap <= 0
/// \param last  its state after its last step
template <class ContactLaw>
EEPA_FUNCTION Dissipation dissipation_of_opening(const Coefficients &c, const Contact &contact,
                                                 double time_step, const History &last)
{
  Dissipation lost;
  const Scale scale = contact_scale(c, contact.size);
  lost.hysteresis = ContactLaw::Normal::opening_loss(c, scale, last.max_overlap);
  lost.sliding = spring_energy(scale.stiffness() * c.kt, last.tangential_spring);
  if constexpr (ContactLaw::Rolling::has_spring)
    lost.rolling = spring_energy(scale.stiffness() * c.kr, last.rolling_spring);
  if constexpr (ContactLaw::Normal::Exponent::is_unit) {
    // for n != 1 the dashpot fades out with the overlap
    const double normal_velocity = dot(contact.velocity, contact.normal);
    const double viscous =
        c.restitution_damping * std::sqrt(contact.effective_mass * scale.stiffness() * c.k1) +
        scale.force() * c.viscous_normal;
    lost.normal_dashpot = 0.25 * viscous * normal_velocity * normal_velocity * time_step;
  }
  return lost;
}

}    // namespace eepa

#endif
