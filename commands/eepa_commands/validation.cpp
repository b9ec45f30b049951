// SPDX-License-Identifier: GPL-2.0-only
#include "validation.h"

#include "parameter_table.h"
#include "words.h"

#include <cmath>
#include <sstream>

namespace eepa {

namespace {

  using Lines = std::vector<std::string>;

  std::string text(double value)
  {
    std::ostringstream out;
    out.precision(10);
    out << value;
    return out.str();
  }

  /// Requires a finite value that fulfils `allowed`; the message has name, value and what is
  /// allowed.
  void demand(Lines &errors, bool allowed, const std::string &name, double value,
              const std::string &range)
  {
    if (!std::isfinite(value))
      errors.push_back(name + " = " + text(value) + " is not a finite number");
    else if (!allowed)
      errors.push_back(name + " = " + text(value) + " is not allowed: it must be " + range);
  }

  std::string laws_with_exponent()
  {
    Words names;
    for (const LawEntry &law : law_table)
      if (law.has_exponent) names.push_back(law.name);
    return listed(names, "and") + (names.size() == 1 ? " has" : " have");
  }

  void check(Lines &errors, const Number &number, const Parameters &p, const LawSettings &s)
  {
    const double value = p.*number.member;
    const bool given = value != Parameters().*number.member;
    const std::string name = name_of(number);
    if (number.law && *number.law != s.law) {
      if (given)
        errors.push_back(name + " is not allowed with " + entry_of(s.law).name + ": only " +
                         entry_of(*number.law).name + " has it");
    } else if (number.law && !given) {
      errors.push_back(name + " must be given with " + entry_of(s.law).name + "; it must be " +
                       number.range.words);
    } else {
      std::string range = number.range.words;
      if (number.range.least) range += " = " + text(p.*number.range.least);
      demand(errors, number.range.holds(value, p), name, value, range);
    }
  }

  /// k2 < 2 k1: the loading condition never holds on a virgin contact. k2 > 2 k1: the k2 line meets
  /// the loading branch below the largest overlap.
  void check_plateau(Findings &found, const Parameters &p)
  {
    const double least = entry_of(Law::plateau).least_ratio * p.k1;
    if (p.k2 < least) {
      found.errors.push_back(
          "k2 = " + text(p.k2) + " is not allowed with plateau: it must be >= 2 k1 = " +
          text(least) + ", or a virgin contact never loads; use linear, which takes any k2 >= k1");
    } else if (p.k2 > least) {
      found.warnings.push_back("plateau with k2 = " + text(p.k2) + " > 2 k1 = " + text(least) +
                               ": unloading keeps to the loading branch down to an overlap of " +
                               text(p.k1 / (p.k2 - p.k1)) +
                               " of the largest one, where the k2 line meets it");
    }
  }

  /// luding needs k2 > k1: with k2 = k1 the limit overlap delta* does not exist.
  void check_luding(Findings &found, const Parameters &p)
  {
    if (p.k2 == p.k1)
      found.errors.push_back("k2 = " + text(p.k2) +
                             " is not allowed with luding: it must be > k1 = " + text(p.k1) +
                             "; use linear, which takes k2 = k1");
  }

}    // namespace

Findings validate(const LawSettings &s)
{
  Findings found;
  auto &errors = found.errors;
  demand(errors, s.exponent >= 1.0 && s.exponent <= 2.0, "exponent", s.exponent, "between 1 and 2");
  if (!entry_of(s.law).has_exponent && s.exponent != 1.0)
    errors.push_back("exponent = " + text(s.exponent) + " is not allowed with " +
                     entry_of(s.law).name + ": only " + laws_with_exponent() + " an exponent");
  if (s.scaled)
    demand(errors, s.reference_diameter > 0.0, "scale d_ref", s.reference_diameter, "> 0");
  return found;
}

Findings validate(const Parameters &p, const LawSettings &s)
{
  Findings found;
  for_each_number([&](const Number &number) {
    if (is_read(number, p)) check(found.errors, number, p, s);
  });
  if (s.exponent != 1.0 && !p.kt_given)
    found.errors.push_back("kt must be given (force/length) when the exponent is " +
                           text(s.exponent) + ": 2/7 k1 is a stiffness only for exponent 1");
  if (s.law == Law::plateau && found.errors.empty()) check_plateau(found, p);
  if (s.law == Law::luding && found.errors.empty()) check_luding(found, p);
  return found;
}

}    // namespace eepa
