// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_HISTORY_H
#define EEPA_HISTORY_H

#include "lane_rows.h"
#include "vector.h"

namespace eepa {

/// Where each quantity of a contact's state lies in a driver's flat array of doubles.
/// This list is the only place that knows.
enum HistoryIndex : int {
  MAX_OVERLAP = 0,          ///< overlap where unloading meets loading [length], >= 0
  TANGENTIAL_SPRING = 1,    ///< 1..3: tangential spring of i against j [length]
  ROLLING_SPRING = 4,       ///< 4..6: rolling spring, with RollingModel::sds only [length]
  SIZE_WITHOUT_ROLLING = 4,
  SIZE_WITH_ROLLING = 7
};

/// The state that a contact remembers from step to step.
template <class Real> struct HistoryOf {
  Real max_overlap = 0.0;    ///< [length], >= 0; 0 is a virgin contact
  /// relative displacement of i against j [length]
  Vector3<Real> tangential_spring = Vector3<Real>::Constant(Real(0.0));
  /// rolling of i against j along its spin [length]
  Vector3<Real> rolling_spring = Vector3<Real>::Constant(Real(0.0));
};
using History = HistoryOf<double>;

/// Reads a state from a driver's flat array.
///
/// LAMMPS hands the array over with every sign turned when i and j change places: right for
/// the springs, and harmless for the overlap because its magnitude is read.
/// \tparam WithRolling  whether the array has the rolling spring
/// \param values  SIZE_WITH_ROLLING or SIZE_WITHOUT_ROLLING doubles
template <bool WithRolling> EEPA_FUNCTION History load_history(const double *values)
{
  History history;
  history.max_overlap = std::fabs(values[MAX_OVERLAP]);
  history.tangential_spring = Eigen::Map<const Vec3>(values + TANGENTIAL_SPRING);
  if constexpr (WithRolling)
    history.rolling_spring = Eigen::Map<const Vec3>(values + ROLLING_SPRING);
  return history;
}

#ifdef EEPA_HAS_LANES
/// Reads the states of several contacts.
/// \param values  as for one contact, for each lane
template <bool WithRolling>
EEPA_FUNCTION HistoryOf<Lanes> load_history(const LanePointers<double> &values)
{
  using std::abs;
  static_assert(MAX_OVERLAP == 0 && TANGENTIAL_SPRING == 1, "they are read as one row of 4");
  HistoryOf<Lanes> history;
  const std::array<Lanes, 4> row = gather_rows_of_4(values);
  history.max_overlap = abs(row[MAX_OVERLAP]);
  history.tangential_spring = Vector3<Lanes>(row[TANGENTIAL_SPRING], row[TANGENTIAL_SPRING + 1],
                                             row[TANGENTIAL_SPRING + 2]);
  if constexpr (WithRolling) {
    LanePointers<const double> rolling;
    for (std::size_t lane = 0; lane < Lanes::size(); lane++)
      rolling[lane] = values[lane] + ROLLING_SPRING;
    history.rolling_spring = gather_rows(rolling);
  }
  return history;
}
#endif

/// Writes a state to a driver's flat array; the inverse of load_history.
template <bool WithRolling> EEPA_FUNCTION void store_history(const History &history, double *values)
{
  values[MAX_OVERLAP] = history.max_overlap;
  Eigen::Map<Vec3>(values + TANGENTIAL_SPRING) = history.tangential_spring;
  if constexpr (WithRolling) Eigen::Map<Vec3>(values + ROLLING_SPRING) = history.rolling_spring;
}

#ifdef EEPA_HAS_LANES
/// Writes the states of several contacts.
template <bool WithRolling>
EEPA_FUNCTION void store_history(const HistoryOf<Lanes> &history,
                                 const LanePointers<double> &values)
{
  const Vector3<Lanes> &spring = history.tangential_spring;
  scatter_rows_of_4({history.max_overlap, spring[0], spring[1], spring[2]}, values);
  if constexpr (WithRolling) {
    const LaneRows rolling(history.rolling_spring);
    for (std::size_t lane = 0; lane < Lanes::size(); lane++)
      rolling.store(values[lane] + ROLLING_SPRING, lane);
  }
}
#endif

}    // namespace eepa

#endif
