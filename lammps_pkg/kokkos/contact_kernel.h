// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_KERNEL_H
#define LMP_EEPA_CONTACT_KERNEL_H

#include "contact_step.h"

#include <eepa/step.h>

namespace LAMMPS_NS {

/// The contacts of one particle of a neighbour list, which one thread evaluates.
/// \tparam tallies  whether the step asks for more than forces: a set-up, energies, virial or losses
template <class DeviceType, class ContactLaw, bool tallies> class ContactKernel {
  using Vec3 = eepa::Vec3;
  static constexpr auto wanted = tallies ? eepa::Wanted::losses : eepa::Wanted::forces;

 public:
  using value_type = StepSums;

  explicit ContactKernel(const ContactStep<DeviceType> &step) : s(step) {}

  KOKKOS_INLINE_FUNCTION void operator()(int ii) const
  {
    StepSums none;
    evaluate_particle(s.ilist(ii), none);
  }
  KOKKOS_INLINE_FUNCTION void operator()(int ii, StepSums &sums) const
  {
    evaluate_particle(s.ilist(ii), sums);
  }
  KOKKOS_INLINE_FUNCTION void init(StepSums &sums) const { sums = StepSums(); }
  KOKKOS_INLINE_FUNCTION void join(StepSums &sums, const StepSums &others) const
  {
    sums.add(others);
  }

 private:
  ContactStep<DeviceType> s;

  KOKKOS_INLINE_FUNCTION void evaluate_particle(int i, StepSums &sums) const
  {
    const int count = s.numneigh(i);
    const bigint first = s.rows.first(i);
    const double x = s.x(i, 0), y = s.x(i, 1), z = s.x(i, 2), radius = s.radius(i);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    const bool several_write = s.on_gpu || s.several_write;
    if (!several_write) {
      // forces are added in the order of the host's style
      for (int k = 0; k < 3; k++) {
        force[k] = s.f(i, k);
        torque[k] = s.torque(i, k);
      }
    }
    bool touches_some = false;
    for (int jj = 0; jj < count; jj++) {
      const int neighbor = s.neighbors(i, jj), j = neighbor & NEIGHMASK;
      const double dx = x - s.x(j, 0), dy = y - s.x(j, 1), dz = z - s.x(j, 2);
      const double reach = radius + s.radius(j);
      if (!(dx * dx + dy * dy + dz * dz < reach * reach)) {
        if (s.rows.status(first + jj) != eepa::ContactStatus::none)
          open(i, neighbor, first + jj, sums);
        continue;
      }
      if (s.hold_together(i, j)) continue;
      const double factor = s.factor_of(neighbor);
      if (factor == 0.0) continue;
      touches_some = true;
      evaluate(i, j, factor, first + jj, force, torque, sums);
    }
    if (!touches_some) return;
    if (several_write) {
      s.add_wrench(i, force, torque);
    } else {
      for (int k = 0; k < 3; k++) {
        s.f(i, k) = force[k];
        s.torque(i, k) = torque[k];
      }
    }
  }

  KOKKOS_INLINE_FUNCTION void open(int i, int neighbor, bigint slot, StepSums &sums) const
  {
    if constexpr (tallies) {
      if (s.request.wants_losses) {
        const int j = neighbor & NEIGHMASK;
        const eepa::Contact contact =
            eepa::contact_of(s.body_of(i), s.body_of(j), s.request.time_step);
        s.book(i, j,
               eepa::open_contact<ContactLaw>(s.coefficients_of(i, j), s.request, contact,
                                              s.rows.history(slot)),
               s.factor_of(neighbor), sums);
      }
    }
    s.rows.clear(slot);
  }

  KOKKOS_INLINE_FUNCTION void evaluate(int i, int j, double factor, bigint slot, Vec3 &force,
                                       Vec3 &torque, StepSums &sums) const
  {
    const eepa::Coefficients &c = s.coefficients_of(i, j);
    const eepa::Contact contact =
        eepa::contact_of<ContactLaw>(s.body_of(i), s.body_of(j), s.request.time_step);
    if (eepa::too_deep(contact.overlap, eepa::min(double(s.radius(i)), double(s.radius(j)))))
      s.note_too_deep(i, j);

    const int last = s.rows.status(slot);
    const auto outcome = eepa::step_contact<ContactLaw, wanted>(
        c, s.request, contact, last == eepa::ContactStatus::none, s.rows.history(slot));
    if (outcome.status != last) s.rows.status(slot) = outcome.status;

    const eepa::Wrench<double> &wrench = outcome.wrench;
    const Vec3 pair_force = factor * wrench.force;
    force += pair_force;
    torque += factor * wrench.torque_i;
    if (j < s.written) s.add_wrench(j, -pair_force, factor * wrench.torque_j);

    if constexpr (tallies) {
      if (s.tallies.ledger) sums.elastic.add(outcome.energy, factor * s.share_of(j));
      if (s.request.wants_losses) s.book(i, j, outcome.lost, factor, sums);
      if (s.tallies.any_of_lammps())
        s.tally(i, j, factor * outcome.energy.total(), pair_force,
                Vec3(s.x(i, 0) - s.x(j, 0), s.x(i, 1) - s.x(j, 1), s.x(i, 2) - s.x(j, 2)), sums);
    }
  }
};

}    // namespace LAMMPS_NS

#endif
