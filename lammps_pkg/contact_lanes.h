// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_LANES_H
#define LMP_EEPA_CONTACT_LANES_H

// Gathers as many contacts as the kernel's Lanes hold, and scatters what they do: the same as
// particle_contact.h, side by side.

#include "contact_slice.h"
#include "contact_status.h"
#include "particle_contact.h"

#include <eepa/contact_law.h>

#ifdef EEPA_HAS_LANES

namespace LAMMPS_NS {

/// Some contacts, one in each lane.
class ContactLanes {
 public:
  static constexpr int width = static_cast<int>(eepa::Lanes::size());

  /// \param count  1 .. width; further lanes repeat the last contact, and are not scattered
  ContactLanes(const FoundContact *found, int count) : found_(found), count_(count)
  {
    for (int lane = 0; lane < width; lane++) {
      const FoundContact &contact = found[lane < count ? lane : count - 1];
      i_[lane] = contact.i;
      j_[lane] = contact.j;
      history_[lane] = contact.history;
    }
  }

  /// \tparam WithRolling  whether the law reads the effective radius and the angular velocities
  template <bool WithRolling> void gather(const ParticleArrays &p)
  {
    using eepa::Lanes;
    const Lanes radius_i = numbers(p.radius, i_), radius_j = numbers(p.radius, j_);
    offset = vectors(p.x, i_) - vectors(p.x, j_);
    const Lanes distance = sqrt(eepa::squared_length(offset));
    contact.size = radius_i + radius_j;
    contact.overlap = contact.size - distance;
    contact.normal = (1.0 / distance) * offset;
    contact.effective_mass = eepa::effective_mass(numbers(p.mass, i_), numbers(p.mass, j_));
    contact.velocity = vectors(p.v, i_) - vectors(p.v, j_);
    arm_i = eepa::lever_arm(radius_i, contact.overlap);
    arm_j = eepa::lever_arm(radius_j, contact.overlap);
    const Vector omega_i = vectors(p.omega, i_), omega_j = vectors(p.omega, j_);
    contact.spin = arm_i * omega_i + arm_j * omega_j;
    smaller_radius = eepa::smaller(radius_i, radius_j);
    if constexpr (WithRolling) {
      contact.effective_radius = eepa::effective_radius(radius_i, radius_j);
      contact.angular_velocity = omega_i - omega_j;
    }
  }

  /// Evaluates the law, stores states and statuses and adds the forces.
  /// \param f, torque  3 doubles an atom
  template <class ContactLaw>
  void evaluate(const eepa::Coefficients &c, bool limit_damping, double time_step,
                const ParticleArrays &p, double *f, double *torque, ContactSlice &slice)
  {
    constexpr bool rolling_spring = ContactLaw::Rolling::has_spring;
    gather<ContactLaw::has_rolling>(p);
    if (eepa::any(contact.overlap > smaller_radius)) note_depth(slice);
    eepa::HistoryOf<eepa::Lanes> history = eepa::load_history<rolling_spring>(history_);
    const eepa::ResponseOf<eepa::Lanes> response =
        ContactLaw::evaluate(c, limit_damping, contact, time_step, history);
    eepa::store_history<rolling_spring>(history, history_, count_);
    store_status(response.branch, response.sliding);

    const Vector moment = ContactLaw::tangential_moment(response, contact);
    Vector torque_i = -arm_i * moment, torque_j = -arm_j * moment;
    if constexpr (ContactLaw::has_rolling) {
      torque_i += response.rolling_torque;
      torque_j -= response.rolling_torque;
    }
    scatter(ContactLaw::force_on_i(response, contact), torque_i, torque_j, f, torque, slice);
  }

 private:
  using Vector = eepa::Vector3<eepa::Lanes>;
  using Index = std::ptrdiff_t;

  const FoundContact *found_;
  int count_;
  Index i_[width], j_[width];
  double *history_[width];
  eepa::ContactOf<eepa::Lanes> contact;
  Vector offset;
  eepa::Lanes arm_i, arm_j, smaller_radius;

  static eepa::Lanes numbers(const double *array, const Index *atoms)
  {
    return eepa::Lanes([&](auto lane) { return array[atoms[lane]]; });
  }
  static Vector vectors(const double *array, const Index *atoms)
  {
    const auto component = [&](int k) {
      return eepa::Lanes([&](auto lane) { return array[3 * atoms[lane] + k]; });
    };
    return Vector(component(0), component(1), component(2));
  }

  void note_depth(ContactSlice &slice) const
  {
    for (int lane = 0; lane < count_; lane++)
      slice.note_depth(found_[lane].i, found_[lane].j, contact.overlap[lane],
                       smaller_radius[lane]);
  }

  void store_status(const eepa::Lanes &branch, const eepa::Lanes::mask_type &sliding) const
  {
    for (int lane = 0; lane < count_; lane++)
      *found_[lane].status = ContactStatus::of(
          static_cast<eepa::Branch>(static_cast<int>(branch[lane])), sliding[lane]);
  }

  void scatter(const Vector &force, const Vector &torque_i, const Vector &torque_j, double *f,
               double *torque, ContactSlice &slice) const
  {
    double push[3][width], turn_i[3][width], turn_j[3][width];
    for (int k = 0; k < 3; k++) {
      force[k].copy_to(push[k], std::experimental::element_aligned);
      torque_i[k].copy_to(turn_i[k], std::experimental::element_aligned);
      torque_j[k].copy_to(turn_j[k], std::experimental::element_aligned);
    }
    for (int lane = 0; lane < count_; lane++) {
      double *f_i = f + 3 * i_[lane], *torque_of_i = torque + 3 * i_[lane];
      for (int k = 0; k < 3; k++) f_i[k] += push[k][lane];
      for (int k = 0; k < 3; k++) torque_of_i[k] += turn_i[k][lane];
      const int j = found_[lane].j;
      if (slice.writes(j)) {
        double *f_j = f + 3 * j_[lane], *torque_of_j = torque + 3 * j_[lane];
        for (int k = 0; k < 3; k++) f_j[k] -= push[k][lane];
        for (int k = 0; k < 3; k++) torque_of_j[k] += turn_j[k][lane];
      } else if (slice.defers(j)) {
        slice.deferred.push_back({j, {-push[0][lane], -push[1][lane], -push[2][lane]},
                                  {turn_j[0][lane], turn_j[1][lane], turn_j[2][lane]}});
      }
    }
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
