// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_HISTORY_H
#define EEPA_HISTORY_H

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
EEPA_FUNCTION HistoryOf<Lanes> load_history(const double *const *values)
{
  using std::abs;
  const auto gather = [values](int index) {
    return Lanes([values, index](auto lane) { return values[lane][index]; });
  };
  const auto gather_spring = [&gather](int index) {
    return Vector3<Lanes>(gather(index), gather(index + 1), gather(index + 2));
  };
  HistoryOf<Lanes> history;
  history.max_overlap = abs(gather(MAX_OVERLAP));
  history.tangential_spring = gather_spring(TANGENTIAL_SPRING);
  if constexpr (WithRolling) history.rolling_spring = gather_spring(ROLLING_SPRING);
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
/// Writes the states of the first `count` lanes.
template <bool WithRolling>
EEPA_FUNCTION void store_history(const HistoryOf<Lanes> &history, double *const *values, int count)
{
  const auto scatter = [values, count](const Lanes &numbers, int index) {
    double lane[Lanes::size()];
    numbers.copy_to(lane, std::experimental::element_aligned);
    for (int l = 0; l < count; l++) values[l][index] = lane[l];
  };
  const auto scatter_spring = [&scatter](const Vector3<Lanes> &spring, int index) {
    for (int k = 0; k < 3; k++) scatter(spring[k], index + k);
  };
  scatter(history.max_overlap, MAX_OVERLAP);
  scatter_spring(history.tangential_spring, TANGENTIAL_SPRING);
  if constexpr (WithRolling) scatter_spring(history.rolling_spring, ROLLING_SPRING);
}
#endif

}    // namespace eepa

#endif
