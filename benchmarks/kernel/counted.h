// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COUNTED_H
#define EEPA_COUNTED_H

#include <eepa/real.h>

#include <Eigen/Core>

#include <cmath>

namespace eepa_bench {

/// Number of each operation. A change of sign is not counted: it is almost free.
struct Operations {
  long additions = 0, multiplications = 0, divisions = 0, roots = 0, powers = 0, comparisons = 0;
};

/// A double that counts operations: another `Real` for the kernel.
class Counted {
 public:
  static inline Operations count;
  double value = 0.0;

  constexpr Counted() = default;
  constexpr Counted(double x) : value(x) {}    // implicit, as from a coefficient

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

  friend Counted sqrt(Counted x) { return count.roots++, std::sqrt(x.value); }
  friend Counted abs(Counted x) { return std::fabs(x.value); }
};

}    // namespace eepa_bench

namespace eepa {
template <>
inline eepa_bench::Counted pow<eepa_bench::Counted>(const eepa_bench::Counted &base,
                                                      double exponent)
{
  return eepa_bench::Counted::count.powers++, std::pow(base.value, exponent);
}
}    // namespace eepa

namespace Eigen {
template <> struct NumTraits<eepa_bench::Counted> : NumTraits<double> {
  using Real = eepa_bench::Counted;
  using NonInteger = eepa_bench::Counted;
  using Nested = eepa_bench::Counted;
  enum { RequireInitialization = 1 };
};
// a coefficient times a vector
template <class Operation> struct ScalarBinaryOpTraits<double, eepa_bench::Counted, Operation> {
  using ReturnType = eepa_bench::Counted;
};
}    // namespace Eigen

#endif
