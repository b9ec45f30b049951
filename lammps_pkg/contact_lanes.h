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

/// A contact in each lane.
class ContactLanes {
 public:
  static constexpr int width = static_cast<int>(eepa::Lanes::size());

  /// \param found  `width` contacts
  EEPA_FUNCTION explicit ContactLanes(const FoundContact *found) : found_(found)
  {
    for (int lane = 0; lane < width; lane++) {
      i_[lane] = found[lane].i;
      j_[lane] = found[lane].j;
      history_[lane] = found[lane].history;
    }
  }

  /// Evaluates the law, stores states and statuses and adds the forces.
  /// \param f, torque  3 doubles an atom
  template <class ContactLaw>
  EEPA_FUNCTION void evaluate(const eepa::Coefficients &c, bool limit_damping, double time_step,
                              const ParticleArrays &p, double *f, double *torque,
                              ContactSlice &slice)
  {
    using Layout = typename ContactLaw::Layout;
    gather<ContactLaw::has_couple>(p, time_step, slice);
    eepa::HistoryOf<eepa::Lanes> history = eepa::load_history<Layout>(history_);
    const eepa::ResponseOf<eepa::Lanes> response =
        ContactLaw::evaluate(c, limit_damping, contact_, time_step, history);
    eepa::store_history<Layout>(history, history_);
    store_status(response);

    const Vector moment = ContactLaw::tangential_moment(response, contact_);
    Vector torque_i = -arm_i_ * moment, torque_j = -arm_j_ * moment;
    ContactLaw::add_couple(response, contact_, torque_i, torque_j);
    scatter(ContactLaw::force_on_i(response, contact_), torque_i, torque_j, f, torque, slice);
  }

 private:
  using Vector = eepa::Vector3<eepa::Lanes>;
  using Index = std::ptrdiff_t;

  const FoundContact *found_;
  Index i_[width], j_[width];
  eepa::LanePointers<double> history_;
  eepa::ContactOf<eepa::Lanes> contact_;
  eepa::Lanes arm_i_, arm_j_;

  EEPA_FUNCTION static eepa::Lanes numbers(const double *array, const Index (&atoms)[width])
  {
    eepa::LanePointers<const double> at;
    for (int lane = 0; lane < width; lane++) at[lane] = array + atoms[lane];
    return eepa::gather_numbers(at);
  }
  EEPA_FUNCTION static Vector rows(const double *array, const Index (&atoms)[width])
  {
    eepa::LanePointers<const double> at;
    for (int lane = 0; lane < width; lane++) at[lane] = array + 3 * atoms[lane];
    return eepa::gather_rows(at);
  }

  /// As gather_contact().
  template <bool WithCouple>
  EEPA_FUNCTION void gather(const ParticleArrays &p, double time_step, ContactSlice &slice)
  {
    using eepa::Lanes;
    const Lanes radius_i = numbers(p.radius, i_), radius_j = numbers(p.radius, j_);
    const Vector offset = rows(p.x, i_) - rows(p.x, j_);
    const Lanes distance = sqrt(eepa::squared_length(offset));
    contact_.size = radius_i + radius_j;
    contact_.overlap = contact_.size - distance;
    const Lanes inverse_distance = 1.0 / distance;
    contact_.normal = inverse_distance * offset;
    contact_.effective_mass = eepa::effective_mass(numbers(p.mass, i_), numbers(p.mass, j_));
    contact_.velocity = rows(p.v, i_) - rows(p.v, j_);
    arm_i_ = eepa::lever_arm(radius_i, contact_.overlap);
    arm_j_ = eepa::lever_arm(radius_j, contact_.overlap);
    const Vector omega_i = rows(p.omega, i_), omega_j = rows(p.omega, j_);
    contact_.spin = arm_i_ * omega_i + arm_j_ * omega_j;
    contact_.turn = eepa::turn_of_pair<Lanes>(contact_.normal, contact_.velocity, inverse_distance,
                                              time_step);
    contact_.twist = eepa::twist_of_pair<Lanes>(contact_.normal, omega_i + omega_j, time_step);
    if constexpr (WithCouple) {
      contact_.effective_radius = eepa::effective_radius(radius_i, radius_j);
      contact_.angular_velocity = omega_i - omega_j;
    }
    const Lanes smaller_radius = eepa::smaller(radius_i, radius_j);
    if (eepa::any(contact_.overlap > smaller_radius))
      for (int lane = 0; lane < width; lane++)
        slice.note_depth(found_[lane].i, found_[lane].j, contact_.overlap[lane],
                         smaller_radius[lane]);
  }

  /// ContactStatus::of() of every lane; a branch is a double there, and its bits are added.
  EEPA_FUNCTION void store_status(const eepa::ResponseOf<eepa::Lanes> &response) const
  {
    using eepa::Lanes;
    namespace simd = std::experimental;
    Lanes status = Lanes(ContactStatus::touching) +
        Lanes(1 << ContactStatus::branch_shift) * response.branch;
    where(response.sliding, status) += Lanes(ContactStatus::sliding);
    const auto whole = simd::static_simd_cast<simd::rebind_simd_t<int, Lanes>>(status);
    for (int lane = 0; lane < width; lane++) *found_[lane].status = whole[lane];
  }

  EEPA_FUNCTION void scatter(const Vector &force, const Vector &torque_i, const Vector &torque_j,
                             double *f, double *torque, ContactSlice &slice) const
  {
    const eepa::LaneRows push(force), turn_i(torque_i), turn_j(torque_j);
    for (int lane = 0; lane < width; lane++) {
      push.add_to(f + 3 * i_[lane], lane);
      turn_i.add_to(torque + 3 * i_[lane], lane);
      const int j = static_cast<int>(j_[lane]);
      if (slice.writes(j)) {
        push.subtract_from(f + 3 * j_[lane], lane);
        turn_j.add_to(torque + 3 * j_[lane], lane);
      } else if (slice.defers(j)) {
        slice.deferred.push_back({j, -push[lane], turn_j[lane]});
      }
    }
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
