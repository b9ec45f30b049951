// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_RANDOM_PARAMETERS_H
#define EEPA_TESTS_RANDOM_PARAMETERS_H

#include <eepa_commands/parameter_table.h>

#include <algorithm>
#include <cmath>

// Parameters drawn at random, every one that there is: a new entry of the table is drawn without a change
// here. `draw` is a source of random numbers, called for one from 0 to 1.

namespace eepa_test {

/// From where numbers are drawn.
struct Spread {
  double k1_low, k1_high;    ///< log10 of the loading stiffness
  /// log10 of all other stiffnesses, forces and dashpots over those that k1, `overlap` and `mass` make
  double low = -2.0, high = 0.0;
  double overlap = 1.0;    ///< [length]
  double mass = 1.0;
  double largest_ratio = 1.0;    ///< of numbers without a unit and without an upper bound
  double ends = 0.2;             ///< how often a number is the end of its range, where there is one
};

/// The size that a number of this dimension has in a contact of stiffness k1.
inline double natural_size(const eepa::Dimension &d, const Spread &spread, double k1, double n)
{
  const double force = k1 * std::pow(spread.overlap, n);
  const double time = std::sqrt(spread.mass / (k1 * std::pow(spread.overlap, n - 1.0)));
  return std::pow(force, d.force) * std::pow(time, d.time) *
      std::pow(spread.overlap, d.length + n * d.length_n);
}

/// A value of `number` in its range. The numbers before it in the table are drawn already.
template <class Draw>
double random_number(Draw &&draw, const Spread &spread, const eepa::Number &number,
                     const eepa::Parameters &p, const eepa::LawSettings &s)
{
  const eepa::Range &range = number.range;
  const auto between = [&](double low, double high) {
    return low + (high - low) * draw();
  };
  const bool at_the_end = draw() < spread.ends;
  if (number.member == &eepa::Parameters::k1)
    return std::pow(10.0, between(spread.k1_low, spread.k1_high));
  if (range.least) {
    const eepa::LawEntry &law = eepa::entry_of(s.law);
    const double least = p.*range.least * law.least_ratio;
    return at_the_end && !law.least_is_excluded
        ? least
        : least * (1.0 + std::pow(10.0, between(spread.low, spread.high)));
  }
  if (std::isfinite(range.low) && std::isfinite(range.high)) {
    // a fraction of any order of magnitude
    if (!at_the_end && range.low_is_excluded)
      return range.high * std::pow(10.0, between(-3.0, 0.0));
    if (!at_the_end) return range.high - (range.high - range.low) * 0.999 * draw();
    return range.low_is_excluded || draw() < 0.5 ? range.high : range.low;
  }
  if (at_the_end && !range.low_is_excluded) return 0.0;
  const bool has_unit = number.dimension.force != 0 || number.dimension.time != 0 ||
      number.dimension.length != 0;
  const double size = has_unit
      ? natural_size(number.dimension, spread, p.k1, s.exponent) *
          std::pow(10.0, between(spread.low, spread.high))
      : std::max(between(0.0, spread.largest_ratio), 1e-3 * spread.largest_ratio);
  return range.high == 0.0 ? -size : size;
}

/// Draws which alternatives hold.
template <class Draw>
void draw_choices(Draw &&draw, const eepa::LawSettings &s, eepa::Parameters &p)
{
  eepa::for_each_choice([&](const eepa::Choice &choice) {
    choice.set(p, std::min(static_cast<int>(draw() * choice.count), choice.count - 1));
  });
  if (s.exponent != 1.0) p.kt_given = true;
}

/// Draws all numbers that the law reads; the others get their defaults.
template <class Draw>
void draw_numbers(Draw &&draw, const Spread &spread, const eepa::LawSettings &s,
                  eepa::Parameters &p)
{
  const eepa::Parameters defaults;
  eepa::for_each_number([&](const eepa::Number &number) {
    const bool wanted = eepa::is_read(number, p) && (!number.law || *number.law == s.law);
    p.*number.member = wanted ? random_number(draw, spread, number, p, s) : defaults.*number.member;
  });
}

}    // namespace eepa_test

#endif
