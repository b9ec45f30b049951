// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_CONTACT_LANES_H
#define LMP_EEPA_CONTACT_LANES_H

// Gathers the bodies of as many contacts as the kernel's Lanes hold, and scatters their wrenches.

#include "coefficient_classes.h"
#include "contact_slice.h"
#include "particle_arrays.h"

#include <eepa/status.h>

#ifdef EEPA_HAS_LANES

namespace LAMMPS_NS {

/// Coefficients of a run in which all contacts have the same.
class SameCoefficients {
 public:
  explicit SameCoefficients(const CoefficientClasses &classes) : all_(classes.first()) {}

  template <class Atoms>
  EEPA_FUNCTION const eepa::Coefficients &of(const ParticleArrays &, const Atoms &,
                                             const Atoms &) const
  {
    return all_;
  }

 private:
  eepa::Coefficients all_;
};

/// Coefficients that are gathered for each contact by the types of its particles.
class OwnCoefficients {
 public:
  explicit OwnCoefficients(const CoefficientClasses &classes) :
      some_(classes.first()), table_(classes.table())
  {
  }

  template <class Atoms>
  EEPA_FUNCTION eepa::CoefficientsOf<eepa::Lanes> of(const ParticleArrays &p, const Atoms &i,
                                                     const Atoms &j) const
  {
    eepa::LanePointers<const eepa::CoefficientRows> rows;
    for (std::size_t lane = 0; lane < eepa::Lanes::size(); lane++)
      rows[lane] = table_(p.type[i[lane]], p.type[j[lane]]);
    return eepa::gather_coefficients(rows, some_);
  }

 private:
  eepa::Coefficients some_;
  CoefficientClasses::Table table_;
};

/// As many contacts as there are lanes.
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
  /// \tparam CoefficientSource  SameCoefficients or OwnCoefficients
  template <class ContactLaw, class CoefficientSource>
  EEPA_FUNCTION void evaluate(const CoefficientSource &source, double time_step,
                              const ParticleArrays &p, const ForceArrays &forces,
                              ContactSlice &slice)
  {
    using eepa::Lanes;
    using Layout = typename ContactLaw::Layout;
    const eepa::Body<Lanes> i = bodies(p, i_), j = bodies(p, j_);
    const eepa::ContactOf<Lanes> contact = eepa::contact_of<ContactLaw>(i, j, time_step);
    note_depth(contact, eepa::min(i.radius, j.radius), slice);
    eepa::HistoryOf<Lanes> history = eepa::load_history<Layout>(history_);
    const eepa::ResponseOf<Lanes> response =
        ContactLaw::evaluate(source.of(p, i_, j_), contact, time_step, history);
    eepa::store_history<Layout>(history, history_);
    // looked up only here, because there are too few registers to keep them from the start
    eepa::LanePointers<int> status;
    for (int lane = 0; lane < width; lane++) status[lane] = found_[lane].status;
    eepa::ContactStatus::store(response, status);
    scatter(ContactLaw::wrench(response, contact), forces, slice);
  }

 private:
  using Vector = eepa::Vector3<eepa::Lanes>;
  using Index = std::ptrdiff_t;

  const FoundContact *found_;
  Index i_[width], j_[width];
  eepa::LanePointers<double> history_;

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
  EEPA_FUNCTION static eepa::Body<eepa::Lanes> bodies(const ParticleArrays &p,
                                                      const Index (&atoms)[width])
  {
    return {rows(p.x, atoms), rows(p.v, atoms), rows(p.omega, atoms), numbers(p.radius, atoms),
            numbers(p.mass, atoms)};
  }

  EEPA_FUNCTION void note_depth(const eepa::ContactOf<eepa::Lanes> &contact,
                                const eepa::Lanes &smaller_radius, ContactSlice &slice) const
  {
    const auto deep = eepa::too_deep(contact.overlap, smaller_radius);
    if (!eepa::any(deep)) return;
    for (int lane = 0; lane < width; lane++)
      if (deep[lane]) slice.note_too_deep(found_[lane].i, found_[lane].j);
  }

  EEPA_FUNCTION void scatter(const eepa::Wrench<eepa::Lanes> &wrench, const ForceArrays &forces,
                             ContactSlice &slice) const
  {
    double *f = forces.f, *torque = forces.torque;
    const eepa::LaneRows force(wrench.force), turn_i(wrench.torque_i), turn_j(wrench.torque_j);
    for (int lane = 0; lane < width; lane++) {
      force.add_to(f + 3 * i_[lane], lane);
      turn_i.add_to(torque + 3 * i_[lane], lane);
      const int j = static_cast<int>(j_[lane]);
      if (slice.writes(j)) {
        force.subtract_from(f + 3 * j_[lane], lane);
        turn_j.add_to(torque + 3 * j_[lane], lane);
      } else if (slice.defers(j)) {
        slice.deferred.push_back({j, -force[lane], turn_j[lane]});
      }
    }
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
