// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_LANES_H
#define LMP_EEPA_WALL_LANES_H

// Gathers as many contacts with a wall as the kernel's Lanes hold, and hands their outcomes back.

#include "contact_engine.h"

#include <eepa/lane_rows.h>

#ifdef EEPA_HAS_LANES

namespace LAMMPS_NS {

/// As many contacts with a wall as there are lanes.
class WallLanes {
 public:
  static constexpr int width = static_cast<int>(eepa::Lanes::size());

  /// \param contacts  `width` of them
  EEPA_FUNCTION explicit WallLanes(const WallContact *contacts) : contacts_(contacts) {}

  /// Evaluates the law and stores states.
  template <class ContactLaw>
  EEPA_FUNCTION void evaluate(const eepa::Coefficients &c, double time_step,
                              ContactOutcome *outcomes) const
  {
    using eepa::Lanes;
    using Layout = typename ContactLaw::Layout;
    eepa::LanePointers<double> histories;
    for (int lane = 0; lane < width; lane++) histories[lane] = contacts_[lane].history;
    const eepa::ContactOf<Lanes> contact = eepa::contact_at_wall(bodies(), walls(), time_step);
    eepa::HistoryOf<Lanes> history = eepa::load_history<Layout>(histories);
    const eepa::ResponseOf<Lanes> response = ContactLaw::evaluate(c, contact, time_step, history);
    eepa::store_history<Layout>(history, histories);
    const eepa::Wrench<Lanes> wrench = ContactLaw::wrench(response, contact);
    const eepa::LaneRows force(wrench.force), torque(wrench.torque_i);
    for (int lane = 0; lane < width; lane++) {
      outcomes[lane].wrench.force = force[lane];
      outcomes[lane].wrench.torque_i = torque[lane];
      outcomes[lane].max_overlap = history.max_overlap[lane];
      outcomes[lane].energy = energy_of<ContactLaw>(c, contacts_[lane]);
    }
  }

 private:
  const WallContact *contacts_;

  /// \param row  of a contact: a pointer to 3 numbers
  template <class Row> EEPA_FUNCTION eepa::Vector3<eepa::Lanes> rows(const Row &row) const
  {
    eepa::LanePointers<const double> at;
    for (int lane = 0; lane < width; lane++) at[lane] = row(contacts_[lane]);
    return eepa::gather_rows(at);
  }
  /// \param number  of a contact
  template <class Number> EEPA_FUNCTION eepa::Lanes numbers(const Number &number) const
  {
    return eepa::Lanes([&](auto lane) EEPA_LAMBDA {
      return number(contacts_[lane]);
    });
  }

  EEPA_FUNCTION eepa::Body<eepa::Lanes> bodies() const
  {
    return {rows([](const WallContact &w) EEPA_LAMBDA {
              return w.body.x.data();
            }),
            rows([](const WallContact &w) EEPA_LAMBDA {
              return w.body.v.data();
            }),
            rows([](const WallContact &w) EEPA_LAMBDA {
              return w.body.omega.data();
            }),
            numbers([](const WallContact &w) EEPA_LAMBDA {
              return w.body.radius;
            }),
            numbers([](const WallContact &w) EEPA_LAMBDA {
              return w.body.mass;
            })};
  }
  EEPA_FUNCTION eepa::WallPoint<eepa::Lanes> walls() const
  {
    return {rows([](const WallContact &w) EEPA_LAMBDA {
              return w.wall.normal.data();
            }),
            numbers([](const WallContact &w) EEPA_LAMBDA {
              return w.wall.overlap;
            }),
            rows([](const WallContact &w) EEPA_LAMBDA {
              return w.wall.velocity.data();
            }),
            rows([](const WallContact &w) EEPA_LAMBDA {
              return w.wall.normal_rate.data();
            }),
            rows([](const WallContact &w) EEPA_LAMBDA {
              return w.wall.angular_velocity.data();
            })};
  }

  /// Energies are sums over branches that the lanes need not share.
  template <class ContactLaw>
  EEPA_FUNCTION static eepa::StoredEnergy energy_of(const eepa::Coefficients &c,
                                                    const WallContact &w)
  {
    return ContactLaw::stored_energy(
        c, eepa::contact_at_wall(w.body, w.wall, 0.0),
        eepa::load_history<typename ContactLaw::Layout>(static_cast<const double *>(w.history)));
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
