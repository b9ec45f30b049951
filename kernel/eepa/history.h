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
struct History {
  double max_overlap = 0.0;                 ///< [length], >= 0; 0 is a virgin contact
  Vec3 tangential_spring = Vec3::Zero();    ///< relative displacement of i against j [length]
  Vec3 rolling_spring = Vec3::Zero();       ///< rolling of i against j along its spin [length]
};

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

/// Writes a state to a driver's flat array; the inverse of load_history.
template <bool WithRolling> EEPA_FUNCTION void store_history(const History &history, double *values)
{
  values[MAX_OVERLAP] = history.max_overlap;
  Eigen::Map<Vec3>(values + TANGENTIAL_SPRING) = history.tangential_spring;
  if constexpr (WithRolling) Eigen::Map<Vec3>(values + ROLLING_SPRING) = history.rolling_spring;
}

}    // namespace eepa

#endif
