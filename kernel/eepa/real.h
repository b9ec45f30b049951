// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_REAL_H
#define EEPA_REAL_H

// `Real` in this kernel is double, one contact at a time, or Lanes, as many contacts at once as a
// register of the processor holds. A law is written once for both. Results that depend on a
// comparison are chosen with select(), so that lanes may decide differently, and work that few
// contacts need is skipped with any(). A lane performs the operations of a double in the same
// order, so it gets the same bits.

#include "eigen.h"
#include "lanes.h"
#include "macros.h"

#include <cmath>
#include <type_traits>
#include <utility>

namespace eepa {

/// Three numbers along x, y, z.
template <class Real> using Vector3 = Eigen::Matrix<Real, 3, 1>;

/// Whether a Real stands for several contacts, with a number in each lane.
template <class Real> inline constexpr bool is_lanes = false;
#ifdef EEPA_HAS_LANES
template <> inline constexpr bool is_lanes<Lanes> = true;
#endif

/// Whether a condition holds for any contact.
EEPA_FUNCTION bool any(bool condition)
{
  return condition;
}

/// `a` where the condition holds, else `b`.
template <class T> EEPA_FUNCTION T select(bool condition, const T &a, const T &b)
{
  return condition ? a : b;
}

#ifdef EEPA_HAS_LANES
EEPA_FUNCTION bool any(const Lanes::mask_type &condition)
{
  return std::experimental::any_of(condition);
}

EEPA_FUNCTION Lanes select(const Lanes::mask_type &condition, const Lanes &a, const Lanes &b)
{
  Lanes chosen = b;
  where(condition, chosen) = a;
  return chosen;
}

EEPA_FUNCTION Vector3<Lanes> select(const Lanes::mask_type &condition, const Vector3<Lanes> &a,
                                    const Vector3<Lanes> &b)
{
  return Vector3<Lanes>(select(condition, a[0], b[0]), select(condition, a[1], b[1]),
                        select(condition, a[2], b[2]));
}
#endif

/// base^exponent; each lane gets the number that the C library gives for a double.
template <class Real> EEPA_FUNCTION Real pow(const Real &base, double exponent)
{
  // of Hertz's law: as exact, many times as fast, and the same bits on every processor
  using std::sqrt;
  if (exponent == 0.5) return sqrt(base);
  if constexpr (is_lanes<Real>)
    return Real([&](auto lane) EEPA_LAMBDA {
      return std::pow(base[lane], exponent);
    });
  else
    return std::pow(base, exponent);
}

/// What a comparison of two Real gives: bool, or one for each lane.
template <class Real> using MaskOf = decltype(std::declval<Real>() < std::declval<Real>());

// Calls are qualified, eepa::min(a, b): argument-dependent lookup would also find functions of
// these names in other libraries.
template <class Real> EEPA_FUNCTION Real min(const Real &a, const Real &b)
{
  return select(b < a, b, a);
}
template <class Real> EEPA_FUNCTION Real max(const Real &a, const Real &b)
{
  return select(a < b, b, a);
}

}    // namespace eepa

#endif
