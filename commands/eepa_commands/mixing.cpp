// SPDX-License-Identifier: GPL-2.0-only
#include "mixing.h"

#include "parameter_table.h"

#include <algorithm>
#include <cmath>

namespace eepa {

namespace {

  double mean_of(Mean mean, double a, double b)
  {
    // equal values are kept, without rounding
    if (a == b) return a;
    if (mean == Mean::harmonic) return (a > 0.0 && b > 0.0) ? 2.0 / (1.0 / a + 1.0 / b) : 0.0;
    if (mean == Mean::geometric_product) return std::sqrt(a * b);
    const double magnitude = std::sqrt(std::fabs(a)) * std::sqrt(std::fabs(b));
    return a < 0.0 && b < 0.0 ? -magnitude : magnitude;
  }

  /// The alternative of the mixed contact, or -1 where the types can not be mixed.
  int merged(Merge merge, int a, int b)
  {
    if (a == b) return a;
    if (merge == Merge::either) return std::max(a, b);
    return merge == Merge::weaker && std::min(a, b) == 0 ? 0 : -1;
  }

}    // namespace

bool mix(const Parameters &a, const Parameters &b, Parameters &mixed, std::string &why)
{
  Parameters made;
  bool can = true;
  for_each_choice([&](const Choice &choice) {
    const int of_a = choice.get(a), of_b = choice.get(b);
    const int of_both = merged(choice.merge, of_a, of_b);
    if (of_both >= 0) {
      choice.set(made, of_both);
    } else if (can) {
      const Alternative &first = choice.alternatives[std::min(of_a, of_b)];
      const Alternative &second = choice.alternatives[std::max(of_a, of_b)];
      why = choice.keyword
          ? "one has " + name_of(choice, first) + " and the other " + name_of(choice, second)
          : std::string("one has ") + first.word + " and the other " + name_of(choice, second);
      can = false;
    }
  });
  if (!can) return false;
  for_each_number([&](const Number &number) {
    if (is_read(number, made))
      made.*number.member = mean_of(number.mean, value_of(number, a), value_of(number, b));
  });
  mixed = made;
  return true;
}

}    // namespace eepa
