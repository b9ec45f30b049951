// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_HISTORY_H
#define EEPA_HISTORY_H

#include "lane_rows.h"
#include "parameters.h"
#include "vector.h"

#include <cmath>
#include <cstddef>

namespace eepa {

/// Index of each quantity of a contact's state in a driver's flat array of doubles. Only this list
/// and HistoryLayout define these indices.
enum HistoryIndex : int {
  MAX_OVERLAP = 0,          ///< overlap where unloading meets loading [length], >= 0
  TANGENTIAL_SPRING = 1,    ///< 1..3: tangential spring of i against j [length]
  N_ALWAYS = 4,
  ROLLING_SPRING = 4    ///< 4..6: rolling spring, with RollingModel::sds only [length]
};

/// Layout of the quantities that follow those of every law.
/// \tparam Rolling, Twisting  whether the law has a spring for rolling, for twisting
template <bool Rolling, bool Twisting> struct HistoryLayout {
  static constexpr bool rolling = Rolling, twisting = Twisting;
  static constexpr int twisting_spring = N_ALWAYS + (Rolling ? 3 : 0);    ///< its index; [length]
  static constexpr int size = twisting_spring + (Twisting ? 1 : 0);
};

/// Number of values of the largest layout.
constexpr int max_history_size = HistoryLayout<true, true>::size;

/// Number of values of a contact's state, for models chosen at run time.
EEPA_FUNCTION int history_size(RollingModel rolling, TwistingModel twisting)
{
  return N_ALWAYS + (rolling == RollingModel::sds ? 3 : 0) +
      (twisting == TwistingModel::marshall ? 1 : 0);
}

/// The state that a contact remembers from step to step.
template <class Real> struct HistoryOf {
  Real max_overlap = 0.0;    ///< [length], >= 0; 0 is a virgin contact
  /// relative displacement of i against j [length]
  Vector3<Real> tangential_spring = Vector3<Real>::Constant(Real(0.0));
  /// rolling of i against j along its spin [length]
  Vector3<Real> rolling_spring = Vector3<Real>::Constant(Real(0.0));
  /// twisting of i against j about the normal, times an arm [length]
  Real twisting_spring = 0.0;
};
using History = HistoryOf<double>;

namespace detail {
  /// LAMMPS changes the sign of every stored value when i and j change places, but a twist must
  /// keep its own. The overlap stored beside it is negative exactly where LAMMPS has done so.
  template <class Real> EEPA_FUNCTION Real twist_of(const Real &stored, const Real &max_overlap)
  {
    return select(max_overlap < 0.0, -stored, stored);
  }
}    // namespace detail

// A driver's row is anything with row[k], k a HistoryIndex: a pointer to consecutive values, as in
// LAMMPS, or one of the following two, for drivers on a GPU.

/// Values of a contact that lie `stride` apart, as where each quantity has its own array.
template <class T> struct StridedRow {
  T *first;
  std::ptrdiff_t stride;

  EEPA_FUNCTION T &operator[](int k) const { return first[k * stride]; }
};

/// Four values that a processor reads or writes at once.
struct alignas(32) Quad {
  double value[4];
};

/// Values of a contact in quads `stride` quads apart: one quad where Layout::size <= 4, else two.
template <class T> struct QuadRow {    // T: Quad or const Quad
  T *first;
  std::ptrdiff_t stride;

  EEPA_FUNCTION auto &operator[](int k) const { return first[k / 4 * stride].value[k % 4]; }
};

namespace detail {
  /// Reads values first .. first + count - 1 of a row, first a multiple of 4 and count at most 4.
  template <int count, class Row> EEPA_FUNCTION Quad read_row(Row row, int first)
  {
    Quad quad{};
    for (int k = 0; k < count; k++) quad.value[k] = row[first + k];
    return quad;
  }
  template <int, class T> EEPA_FUNCTION Quad read_row(QuadRow<T> row, int first)
  {
    return row.first[first / 4 * row.stride];
  }
  template <int count, class Row>
  EEPA_FUNCTION void write_row(const Quad &quad, Row row, int first)
  {
    for (int k = 0; k < count; k++) row[first + k] = quad.value[k];
  }
  template <int> EEPA_FUNCTION void write_row(const Quad &quad, QuadRow<Quad> row, int first)
  {
    row.first[first / 4 * row.stride] = quad;
  }
}    // namespace detail

/// Reads a state from a driver's row.
///
/// LAMMPS changes all signs of a row when i and j change places. That is right for springs that are
/// vectors, and harmless for the overlap, of which the magnitude is read.
/// \tparam Layout  a HistoryLayout
/// \param row  Layout::size doubles
template <class Layout, class Row> EEPA_FUNCTION History load_history(Row row)
{
  static_assert(MAX_OVERLAP == 0 && TANGENTIAL_SPRING == 1 && N_ALWAYS == 4, "the first quad");
  const Quad always = detail::read_row<N_ALWAYS>(row, 0);
  History history;
  history.max_overlap = std::fabs(always.value[MAX_OVERLAP]);
  for (int k = 0; k < 3; k++) history.tangential_spring[k] = always.value[TANGENTIAL_SPRING + k];
  if constexpr (Layout::size > N_ALWAYS) {
    const Quad more = detail::read_row<Layout::size - N_ALWAYS>(row, N_ALWAYS);
    if constexpr (Layout::rolling)
      for (int k = 0; k < 3; k++) history.rolling_spring[k] = more.value[k];
    if constexpr (Layout::twisting)
      history.twisting_spring = detail::twist_of(more.value[Layout::twisting_spring - N_ALWAYS],
                                                 always.value[MAX_OVERLAP]);
  }
  return history;
}

#ifdef EEPA_HAS_LANES
/// Reads the states of several contacts.
/// \param values  as for one contact, for each lane
template <class Layout>
EEPA_FUNCTION HistoryOf<Lanes> load_history(const LanePointers<double> &values)
{
  using std::abs;
  static_assert(MAX_OVERLAP == 0 && TANGENTIAL_SPRING == 1, "they are read as one row of 4");
  HistoryOf<Lanes> history;
  const std::array<Lanes, 4> row = gather_rows_of_4(values);
  history.max_overlap = abs(row[MAX_OVERLAP]);
  history.tangential_spring = Vector3<Lanes>(row[TANGENTIAL_SPRING], row[TANGENTIAL_SPRING + 1],
                                             row[TANGENTIAL_SPRING + 2]);
  LanePointers<const double> more;
  if constexpr (Layout::rolling) {
    for (std::size_t lane = 0; lane < Lanes::size(); lane++)
      more[lane] = values[lane] + ROLLING_SPRING;
    history.rolling_spring = gather_rows(more);
  }
  if constexpr (Layout::twisting) {
    for (std::size_t lane = 0; lane < Lanes::size(); lane++)
      more[lane] = values[lane] + Layout::twisting_spring;
    history.twisting_spring = detail::twist_of(gather_numbers(more), row[MAX_OVERLAP]);
  }
  return history;
}
#endif

/// Writes a state to a driver's row; the inverse of load_history.
template <class Layout, class Row>
EEPA_FUNCTION void store_history(const History &history, Row row)
{
  const Vec3 &spring = history.tangential_spring;
  detail::write_row<N_ALWAYS>({{history.max_overlap, spring[0], spring[1], spring[2]}}, row, 0);
  if constexpr (Layout::size > N_ALWAYS) {
    Quad more{};
    if constexpr (Layout::rolling)
      for (int k = 0; k < 3; k++) more.value[k] = history.rolling_spring[k];
    if constexpr (Layout::twisting)
      more.value[Layout::twisting_spring - N_ALWAYS] = history.twisting_spring;
    detail::write_row<Layout::size - N_ALWAYS>(more, row, N_ALWAYS);
  }
}

#ifdef EEPA_HAS_LANES
/// Writes the states of several contacts.
template <class Layout>
EEPA_FUNCTION void store_history(const HistoryOf<Lanes> &history,
                                 const LanePointers<double> &values)
{
  const Vector3<Lanes> &spring = history.tangential_spring;
  scatter_rows_of_4({history.max_overlap, spring[0], spring[1], spring[2]}, values);
  if constexpr (Layout::rolling) {
    const LaneRows rolling(history.rolling_spring);
    for (std::size_t lane = 0; lane < Lanes::size(); lane++)
      rolling.store(values[lane] + ROLLING_SPRING, lane);
  }
  if constexpr (Layout::twisting)
    for (std::size_t lane = 0; lane < Lanes::size(); lane++)
      values[lane][Layout::twisting_spring] = history.twisting_spring[lane];
}
#endif

}    // namespace eepa

#endif
