// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COUNTED_H
#define EEPA_COUNTED_H

#include <Eigen/Core>

#include <cmath>

namespace eepa_bench {

/// How often each operation was done. A change of sign counts as none: it costs a bit, if that.
struct Operations {
  long additions = 0, multiplications = 0, divisions = 0, roots = 0, powers = 0, comparisons = 0;
};

/// A double that keeps count.
class Counted {
 public:
  static inline Operations count;
  decltype(0.0) value;

  constexpr Counted() : value(0.0) {}
  constexpr Counted(decltype(0.0) x) : value(x) {}    // implicit, as from a literal
  constexpr Counted(int x) : value(x) {}

  friend Counted operator+(Counted a, Counted b) { return count.additions++, a.value + b.value; }
  friend Counted operator-(Counted a, Counted b) { return count.additions++, a.value - b.value; }
  friend Counted operator*(Counted a, Counted b)
  {
    return count.multiplications++, a.value * b.value;
  }
  friend Counted operator/(Counted a, Counted b) { return count.divisions++, a.value / b.value; }
  friend Counted operator-(Counted a) { return -a.value; }
  Counted &operator+=(Counted b) { return *this = *this + b; }
  Counted &operator-=(Counted b) { return *this = *this - b; }
  Counted &operator*=(Counted b) { return *this = *this * b; }
  Counted &operator/=(Counted b) { return *this = *this / b; }

  friend bool operator<(Counted a, Counted b) { return count.comparisons++, a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return count.comparisons++, a.value > b.value; }
  friend bool operator<=(Counted a, Counted b) { return count.comparisons++, a.value <= b.value; }
  friend bool operator>=(Counted a, Counted b) { return count.comparisons++, a.value >= b.value; }
  friend bool operator==(Counted a, Counted b) { return count.comparisons++, a.value == b.value; }
  friend bool operator!=(Counted a, Counted b) { return count.comparisons++, a.value != b.value; }
};

}    // namespace eepa_bench

// The kernel calls these by their full names, so that they must be found there. The standard
// forbids a program that it ships to do so; this one only counts.
namespace std {
inline eepa_bench::Counted sqrt(eepa_bench::Counted x)
{
  return eepa_bench::Counted::count.roots++, sqrt(x.value);
}
inline eepa_bench::Counted pow(eepa_bench::Counted x, eepa_bench::Counted y)
{
  return eepa_bench::Counted::count.powers++, pow(x.value, y.value);
}
inline eepa_bench::Counted log(eepa_bench::Counted x)
{
  return log(x.value);
}
inline eepa_bench::Counted fabs(eepa_bench::Counted x)
{
  return fabs(x.value);
}
inline bool isinf(eepa_bench::Counted x)
{
  return isinf(x.value);
}
inline bool isfinite(eepa_bench::Counted x)
{
  return isfinite(x.value);
}
}    // namespace std

namespace Eigen {
template <> struct NumTraits<eepa_bench::Counted> : NumTraits<double> {
  using Real = eepa_bench::Counted;
  using NonInteger = eepa_bench::Counted;
  using Nested = eepa_bench::Counted;
  enum { RequireInitialization = 1 };
};
// a literal times a vector
template <class Operation> struct ScalarBinaryOpTraits<double, eepa_bench::Counted, Operation> {
  using ReturnType = eepa_bench::Counted;
};
}    // namespace Eigen

#endif
