// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_MUTANT_H
#define EEPA_MUTANT_H

// Included before everything else in what schemata.py has filled with mutants. The environment
// variable EEPA_MUTANT says which of them lives, none where it is not set. Where
// EEPA_MUTANTS_REACHED names a file, the numbers of the sites that were reached are written to it.

#include <Eigen/Core>

#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

namespace eepa_mutant {

constexpr int most = 1 << 15;

inline int chosen()
{
  const char *text = std::getenv("EEPA_MUTANT");
  return text ? std::atoi(text) : -1;
}
inline const int alive = chosen();

struct Reached {
  bool site[most] = {};
  ~Reached()
  {
    const char *path = std::getenv("EEPA_MUTANTS_REACHED");
    std::FILE *out = path ? std::fopen(path, "w") : nullptr;
    if (!out) return;
    for (int number = 0; number < most; number++)
      if (site[number]) std::fprintf(out, "%d\n", number);
    std::fclose(out);
  }
};
inline Reached reached;

/// Notes that a site is reached, of which the first mutant has this number.
template <int Number> inline void reach()
{
  static_assert(Number < most, "more mutants than EEPA_MUTANT can tell apart");
  reached.site[Number] = true;
}

/// A value that outlives the expression that it comes from: Eigen's expressions are evaluated.
template <class T> inline auto value(T &&it)
{
  if constexpr (std::is_base_of_v<Eigen::EigenBase<std::decay_t<T>>, std::decay_t<T>>)
    return it.eval();
  else
    return std::decay_t<T>(std::forward<T>(it));
}

/// a / b, or b / a where only that is defined: a number times a vector.
template <class A, class B, class = decltype(std::declval<A>() / std::declval<B>())>
inline auto divide(int, const A &a, const B &b)
{
  return value(a / b);
}
template <class A, class B> inline auto divide(long, const A &a, const B &b)
{
  return value(b / a);
}
template <class A, class B> inline auto divided(const A &a, const B &b)
{
  return divide(0, a, b);
}

/// In the place of an assignment: the compiler must not conclude from a variable that was never set
/// that the assignment was made.
template <class T> inline void as_it_was(T &&variable)
{
  asm volatile("" : "+m"(variable));
}

template <int Number> inline bool lives()
{
  return __builtin_expect(alive == Number, false);
}

template <int Number, class Result, class Last> inline Result other(const Last &last)
{
  return static_cast<Result>(last());
}
template <int Number, class Result, class First, class... More>
inline Result other(const First &first, const More &...more)
{
  if (lives<Number>()) return static_cast<Result>(first());
  return other<Number + 1, Result>(more...);
}

/// The original's value, or that of the mutant that lives, numbered from First on.
template <int First, class Original, class... Others>
inline auto expression(const Original &original, const Others &...others)
{
  reach<First>();
  if (__builtin_expect(unsigned(alive - First) < sizeof...(Others), false))
    return other<First, decltype(original())>(others...);
  return original();
}

/// The same of literals.
template <int First, class T, class... Others>
inline T constant(T original, Others... others)
{
  reach<First>();
  if (__builtin_expect(unsigned(alive - First) < sizeof...(Others), false)) {
    const T values[] = {static_cast<T>(others)...};
    return values[alive - First];
  }
  return original;
}

/// Whether mutant Number lives, in a statement of which the first mutant is First.
template <int First, int Number = First> inline bool statement()
{
  reach<First>();
  return lives<Number>();
}

}    // namespace eepa_mutant

#endif
