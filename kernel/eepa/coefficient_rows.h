// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COEFFICIENT_ROWS_H
#define EEPA_COEFFICIENT_ROWS_H

#include "coefficients.h"
#include "lane_rows.h"

#include <array>
#include <cstddef>
#include <utility>

namespace eepa {

namespace detail {
  /// The numbers of CoefficientsOf that the evaluation in lanes reads, in rows of 4; the last row
  /// may be shorter. Rows of which a law reads nothing are not fetched, so those that every law
  /// reads come first.
  template <class Number>
  constexpr std::array<Number CoefficientsOf<Number>::*, 20> row_members = {
      &CoefficientsOf<Number>::k1,
      &CoefficientsOf<Number>::k2,
      &CoefficientsOf<Number>::k_adh,
      &CoefficientsOf<Number>::f0,

      &CoefficientsOf<Number>::mu,
      &CoefficientsOf<Number>::kt,
      &CoefficientsOf<Number>::inverse_kt,
      &CoefficientsOf<Number>::plastic_fraction,

      &CoefficientsOf<Number>::restitution_damping,
      &CoefficientsOf<Number>::viscous_normal,
      &CoefficientsOf<Number>::viscous_tangential,
      &CoefficientsOf<Number>::adhesive_memory,

      &CoefficientsOf<Number>::tangential_ratio,
      &CoefficientsOf<Number>::contact_bound,
      &CoefficientsOf<Number>::mu_r,
      &CoefficientsOf<Number>::rolling_viscous,

      &CoefficientsOf<Number>::kr,
      &CoefficientsOf<Number>::inverse_kr,
      &CoefficientsOf<Number>::twisting_share,
      &CoefficientsOf<Number>::depth,
  };
}    // namespace detail

/// The coefficients of one pair of types as the lanes gather them: in rows of 4 numbers, which a
/// processor reads at once.
class CoefficientRows {
 public:
  static constexpr std::size_t numbers = detail::row_members<double>.size();
  static constexpr std::size_t rows = (numbers + 3) / 4;

  // made once a run, by the host
  explicit CoefficientRows(const Coefficients &c)
  {
    for (std::size_t k = 0; k < numbers; k++) numbers_[k] = c.*detail::row_members<double>[k];
  }
  EEPA_FUNCTION const double *row(std::size_t which) const { return numbers_ + 4 * which; }

 private:
  static_assert(numbers * sizeof(double) == offsetof(Coefficients, loading_loss),
                "every Number of CoefficientsOf has its place in a row");
  alignas(32) double numbers_[4 * rows] = {};
};

#ifdef EEPA_HAS_LANES
namespace detail {
  template <std::size_t k>
  EEPA_FUNCTION void set_number(CoefficientsOf<Lanes> &c, const Lanes &value)
  {
    if constexpr (k < CoefficientRows::numbers) c.*row_members<Lanes>[k] = value;
  }

  /// Reads one row of all lanes into the members that stand in it.
  template <std::size_t row>
  EEPA_FUNCTION void gather_row(const LanePointers<const CoefficientRows> &at,
                                CoefficientsOf<Lanes> &c)
  {
    LanePointers<const double> numbers;
    for (std::size_t lane = 0; lane < Lanes::size(); lane++) numbers[lane] = at[lane]->row(row);
    const std::array<Lanes, 4> column = gather_rows_of_4(numbers);
    set_number<4 * row>(c, column[0]);
    set_number<4 * row + 1>(c, column[1]);
    set_number<4 * row + 2>(c, column[2]);
    set_number<4 * row + 3>(c, column[3]);
  }

  template <std::size_t... row>
  EEPA_FUNCTION void gather_all(const LanePointers<const CoefficientRows> &at,
                                CoefficientsOf<Lanes> &c, std::index_sequence<row...>)
  {
    (gather_row<row>(at, c), ...);
  }
}    // namespace detail

/// Coefficients of contacts side by side, each with its own pair of types. The compiler leaves out
/// what the law does not read.
/// \param any_pair  coefficients of any pair of types, for what is the same for all of them
EEPA_FUNCTION CoefficientsOf<Lanes>
gather_coefficients(const LanePointers<const CoefficientRows> &at, const Coefficients &any_pair)
{
  CoefficientsOf<Lanes> c;
  detail::gather_all(at, c, std::make_index_sequence<CoefficientRows::rows>{});
  c.loading_loss = c.adhesive_loss = 0.0;
  c.exponent = any_pair.exponent;
  c.inverse_reference_diameter = any_pair.inverse_reference_diameter;
  c.limit_damping = any_pair.limit_damping;
  return c;
}
#endif

}    // namespace eepa

#endif
