// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_KERNEL_H
#define LMP_EEPA_WALL_KERNEL_H

#include "wall_step.h"

#include <eepa/contact_law.h>
#include <eepa_walls/touched_wall.h>

#include <Kokkos_BitManipulation.hpp>

namespace LAMMPS_NS {

/// The contacts of one particle with a wall, which one thread evaluates where WallSurfaceKokkos has found them.
/// \tparam tallies  whether the step asks for more than forces
template <class DeviceType, class ContactLaw, bool tallies> class WallKernel {
  using Layout = typename ContactLaw::Layout;
  using Vec3 = eepa::Vec3;

 public:
  using value_type = std::conditional_t<tallies, WallTallies, WallSums>;

  explicit WallKernel(const WallStep<DeviceType> &step) : s(step) {}

  KOKKOS_INLINE_FUNCTION void init(value_type &sums) const { sums = value_type(); }
  KOKKOS_INLINE_FUNCTION void join(value_type &sums, const value_type &others) const
  {
    sums.add(others);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c, value_type &sums) const
  {
    const int i = s.rows.particle(c), found = s.found(c), had = s.rows.count(c);
    if (found < 0) {
      note_stop(static_cast<WallStop::Reason>(found - s.stops), i, sums);
      return;
    }
    if constexpr (tallies)
      if (s.table)
        for (int k = 0; k < WallTable::COLUMNS; k++) s.table_rows(i, k) = 0.0;
    const int parted = s.parted(c);
    if (found == 0 && had == 0 && parted == 0) return;
    const eepa::Body<double> body = s.body_of(i);
    if constexpr (tallies)
      for (int k = 0; k < parted; k++) open(c, body, s.partings(2 * s.rows.first(c) + k), sums);
    int contacts = drop_parted(c, had);
    if (found > 0) {
      Vec3 force(s.f(i, 0), s.f(i, 1), s.f(i, 2));
      Vec3 torque(s.torque(i, 0), s.torque(i, 1), s.torque(i, 2));
      for (int k = 0; k < found; k++) evaluate(c, k, body, contacts, force, torque, sums);
      for (int k = 0; k < 3; k++) {
        s.f(i, k) = force[k];
        s.torque(i, k) = torque[k];
      }
    }
    s.rows.count(c) = contacts;
  }

 private:
  WallStep<DeviceType> s;

  KOKKOS_INLINE_FUNCTION static void note_stop(WallStop::Reason reason, int i, value_type &sums)
  {
    sums.stop = eepa::max(sums.stop, WallStop::of(reason, i));
  }

  /// Moves the histories of contacts that go on to the first slots, in their order.
  /// \return their number
  KOKKOS_INLINE_FUNCTION int drop_parted(int c, int had) const
  {
    const bigint first = s.rows.first(c);
    const unsigned kept = s.kept(c);
    int number = 0;
    for (int m = 0; m < had; m++)
      if (kept >> m & 1U) s.rows.copy(first + m, first + number++);
    return number;
  }

  KOKKOS_INLINE_FUNCTION void evaluate(int c, int k, const eepa::Body<double> &body, int &contacts,
                                       Vec3 &force, Vec3 &torque, value_type &sums) const
  {
    const bigint first = s.rows.first(c);
    const int i = s.rows.particle(c);
    const WallTouch touch = s.touches(first + k);
    if (eepa::too_deep(touch.wall.overlap, body.radius)) {
      note_stop(WallStop::too_deep, i, sums);
      return;
    }
    const bool fresh = touch.history < 0;
    if (fresh && contacts >= s.room(c)) {
      note_stop(WallStop::too_many, i, sums);
      return;
    }
    // the history is where drop_parted() has put it
    const bigint slot =
        first + (fresh ? contacts : Kokkos::popcount(s.kept(c) & ((1U << touch.history) - 1U)));
    const double time_step = s.request.time_step;
    const eepa::Contact contact = eepa::contact_at_wall(body, touch.wall, time_step);
    eepa::History history;
    if (!fresh) history = eepa::load_history<Layout>(s.rows.history(slot));
    [[maybe_unused]] const eepa::History before = history;
    const eepa::Response response =
        ContactLaw::evaluate(s.coefficients, contact, time_step, history);
    if (!tallies || s.request.advance) {
      eepa::store_history<Layout>(history, s.rows.history(slot));
      s.rows.face(slot) = touch.face;
      s.rows.place(slot) =
          eepa::Quad{{touch.normal[0], touch.normal[1], touch.normal[2], touch.distance}};
      if (fresh) contacts++;
    }

    const eepa::Wrench<double> wrench = ContactLaw::wrench(response, contact);
    force += wrench.force;
    torque += wrench.torque_i;
    const Vec3 moment = eepa::moment_on_wall(wrench, body.x, s.about);
    const eepa::StoredEnergy energy = ContactLaw::stored_energy(s.coefficients, contact, history);
    double *on_wall = sums.force[s.two_planes ? touch.face : 0];
    for (int d = 0; d < 3; d++) {
      on_wall[d] -= wrench.force[d];
      sums.moment[d] += moment[d];
    }
    sums.contacts += 1.0;
    sums.energy += energy.total();

    if constexpr (tallies) {
      if (s.ledger) {
        sums.of_contacts.store(energy, 1.0);
        if (s.request.wants_losses)
          book(i,
               eepa::dissipation_of_step<ContactLaw>(s.coefficients, contact, response, time_step,
                                                     fresh && !touched_in_setup(touch, contact),
                                                     before, history, s.request.booked),
               sums);
        sums.power += eepa::power_of_wall(
            wrench, contact, eepa::at_end_of_step(touch.wall, body, s.motion, time_step));
      }
      if (s.table) tabulate(i, body, touch, wrench, history, eepa::ContactStatus::of(response));
      if (s.virial || s.virial_of_atoms) tally(i, touch, wrench.force, sums);
    }
  }

  /// As FixWallGranEepa::books_setup() says: a set-up leaves no history.
  KOKKOS_INLINE_FUNCTION bool touched_in_setup(const WallTouch &touch,
                                               const eepa::Contact &contact) const
  {
    return s.books_setup &&
        touch.wall.overlap + contact.velocity.dot(contact.normal) * s.request.time_step > 0.0;
  }

  /// A contact of the step before that is none any more.
  KOKKOS_INLINE_FUNCTION void open(int c, const eepa::Body<double> &body, const WallTouch &touch,
                                   value_type &sums) const
  {
    const double time_step = s.request.time_step;
    const eepa::Contact contact = eepa::contact_at_wall(body, touch.wall, time_step);
    eepa::History history;
    if (touch.history >= 0)
      history = eepa::load_history<Layout>(s.rows.history(s.rows.first(c) + touch.history));
    else if (!touched_in_setup(touch, contact))
      return;
    book(s.rows.particle(c),
         eepa::dissipation_of_opening<ContactLaw>(s.coefficients, contact, time_step, history,
                                                  s.request.booked),
         sums);
  }

  KOKKOS_INLINE_FUNCTION void book(int i, const eepa::Dissipation &lost, value_type &sums) const
  {
    sums.of_contacts.dissipated.add(lost, 1.0);
    if (!s.losses_of_atoms) return;
    const double kinds[] = {lost.hysteresis, lost.normal_dashpot, lost.tangential_dashpot,
                            lost.sliding,    lost.rolling,        lost.twisting};
    for (int k = 0; k < 6; k++) s.atom_losses(i, k) += kinds[k];
  }

  KOKKOS_INLINE_FUNCTION void tabulate(int i, const eepa::Body<double> &body,
                                       const WallTouch &touch, const eepa::Wrench<double> &wrench,
                                       const eepa::History &history, int status) const
  {
    const auto &row = s.table_rows;
    row(i, WallTable::CONTACTS) += 1.0;
    for (int k = 0; k < 3; k++) row(i, WallTable::FORCE + k) += wrench.force[k];
    const eepa::WallPoint<double> &wall = touch.wall;
    if (wall.overlap <= row(i, WallTable::OVERLAP)) return;
    const double reach = body.radius - wall.overlap;
    for (int k = 0; k < 3; k++) row(i, WallTable::POINT + k) = body.x[k] - reach * wall.normal[k];
    row(i, WallTable::OVERLAP) = wall.overlap;
    row(i, WallTable::MAX_OVERLAP) = history.max_overlap;
    row(i, WallTable::BRANCH) = static_cast<int>(eepa::ContactStatus::branch(status));
    row(i, WallTable::SLIP) = eepa::ContactStatus::slides(status) ? 1.0 : 0.0;
  }

  KOKKOS_INLINE_FUNCTION void tally(int i, const WallTouch &touch, const Vec3 &f,
                                    value_type &sums) const
  {
    const Vec3 arm = touch.distance * touch.wall.normal;
    const double moments[6] = {arm[0] * f[0], arm[1] * f[1], arm[2] * f[2],
                               arm[0] * f[1], arm[0] * f[2], arm[1] * f[2]};
    for (int k = 0; k < 6; k++) {
      if (s.virial) sums.of_contacts.virial[k] += moments[k];
      if (s.virial_of_atoms) s.atom_virial(i, k) += moments[k];
    }
  }
};

}    // namespace LAMMPS_NS

#endif
