// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_PARAMETER_TABLE_H
#define EEPA_COMMANDS_PARAMETER_TABLE_H

#include <eepa/parameters.h>

#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

// The list of laws and the list of the parameters that a user gives for a pair of types. The
// parser, validation, mixing, the words of data files, the numbers of restart files, the random
// generators of the tests and the tables in lammps_pkg/doc/pair_gran_eepa.rst use these lists.
//
// A new parameter is a member of eepa::Parameters (its initializer is the default) and one entry
// here, anywhere in the table, with .since(format), the first restart format that has it: the
// present restart_format plus 1. Files of older formats are still read and leave the parameter at
// its default. Then it needs its use in the kernel and its sentence in the documentation, whose
// tables `EEPA_WRITE_DOCUMENTATION=1 build/test_parser --gtest_filter='*Documentation*'` writes.
// docs/adding_a_law.md has all places, those of the kernel too.
//
// An entry is one of two:
//
//   Number   a double. It is typed in one of three ways: right after `pair_coeff I J`, in the
//            table's order (the default); after its own keyword, .with_keyword("depth"); or as a
//            value of a Choice, which then names its member. A number of one law only has
//            .only_with(Law::x): it must be given with that law and is an error with others. Its
//            default must be outside its range, so that "not given" can be recognized.
//   Choice   an enumeration or a bool. It is typed as a keyword and the word of an alternative
//            ("rolling sds"), or as the alternatives' words alone, which then exclude each other
//            ("restitution" or "viscous", keyword nullptr). The word is followed by the numbers of
//            the alternative, in its order. Alternatives are in the order of the enumerators'
//            values.
//
// Conditions between parameters and settings (kt with an exponent, k2 >= 2 k1 of plateau) are in
// validation.cpp. A new law is an enumerator of eepa::Law, an entry of law_table and a line in the
// kernel's dispatch.h.

namespace eepa {

/* ---------------------------------------------------------------------- laws */

/// Properties of a law that the commands need.
struct LawEntry {
  const char *name;
  bool has_exponent;     ///< else the exponent is 1
  double least_ratio;    ///< of k2 to k1 that the law allows
  bool least_is_excluded = false;
};

/// All laws, in the order of the enumerators of eepa::Law.
constexpr LawEntry law_table[] = {
    {"plateau", false, 2.0},
    {"linear", true, 1.0},
    {"luding", false, 1.0, true},
};
constexpr int law_count = sizeof(law_table) / sizeof(law_table[0]);

constexpr const LawEntry &entry_of(Law law)
{
  return law_table[static_cast<int>(law)];
}

/* ---------------------------------------------------------------------- columns of the table */

/// Dimension of a number: force^a time^b length^(c + d n), n being the exponent.
struct Dimension {
  const char *units;    ///< in the words of LAMMPS's documentation
  int force = 0, time = 0, length = 0, length_n = 0;

  /// The power of s = d/d_ref with which the number scales: systems are similar where lengths and
  /// times scale with s and forces with s^2 (article, section 3).
  constexpr double power(double n) const { return 2.0 * force + time + length + length_n * n; }
};

namespace dimension {
  constexpr Dimension none{"unitless"};
  constexpr Dimension force{"force", 1};
  constexpr Dimension stiffness{"force/distance", 1, 0, -1};
  constexpr Dimension stiffness_n{"force/distance^n", 1, 0, 0, -1};
  constexpr Dimension dashpot{"force/velocity", 1, 1, -1};
}    // namespace dimension

/// Values that a number may have. It must also be finite.
struct Range {
  const char *words;    ///< for messages: "it must be ..."
  double low, high;
  bool low_is_excluded = false;
  double Parameters::*least = nullptr;    ///< another parameter that is a lower bound

  bool holds(double value, const Parameters &p) const
  {
    return value >= low && value <= high && !(low_is_excluded && value == low) &&
        (!least || value >= p.*least);
  }
};

namespace range {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr Range positive{"> 0", 0.0, infinity, true};
  constexpr Range not_negative{">= 0", 0.0, infinity};
  constexpr Range not_positive{"<= 0 (a negative pull-off force attracts)", -infinity, 0.0};
  constexpr Range restitution{"between 0 (critical damping) and 1 (none)", 0.0, 1.0};
  constexpr Range fraction{"> 0 and <= 1", 0.0, 1.0, true};
  constexpr Range from_k1{">= k1", -infinity, infinity, false, &Parameters::k1};
}    // namespace range

/// Mean of the numbers of two types for their contact. Equal numbers are kept, to the bit.
enum class Mean {
  harmonic,             ///< 2/(1/a + 1/b), 0 if either is 0: springs or dashpots in series
  geometric,            ///< sqrt(a) sqrt(b), with their sign; no product, which could underflow
  geometric_product,    ///< sqrt(a b)
};

/// Rule for the choices of two types at their contact.
enum class Merge {
  same,      ///< types can be mixed only if their alternatives are the same
  weaker,    ///< the first alternative if either type has it; else both must be the same
  either,    ///< the second of two alternatives if either type has it
};

/* ---------------------------------------------------------------------- entries */

constexpr int oldest_restart_format = 2;

struct Number {
  double Parameters::*member;
  const char *name;       ///< name in the syntax of the command
  const char *meaning;    ///< for the documentation
  Dimension dimension;
  Range range;
  Mean mean;
  const char *keyword = nullptr;    ///< its own keyword, if it has one
  std::optional<Law> law = {};      ///< the only law with this number; empty: all laws
  int format = oldest_restart_format;
  double (*otherwise)(const Parameters &) = nullptr;    ///< its value where it was not given
  const char *otherwise_words = nullptr;

  constexpr Number with_keyword(const char *word) const
  {
    Number n = *this;
    n.keyword = word;
    return n;
  }
  constexpr Number only_with(Law only) const
  {
    Number n = *this;
    n.law = only;
    return n;
  }
  constexpr Number since(int restart_format) const
  {
    Number n = *this;
    n.format = restart_format;
    return n;
  }
  constexpr Number or_else(double (*value)(const Parameters &), const char *words) const
  {
    Number n = *this;
    n.otherwise = value;
    n.otherwise_words = words;
    return n;
  }
};

struct Alternative {
  static constexpr int most_numbers = 4;
  const char *word;    ///< nullptr: the alternative where nothing is typed
  double Parameters::*numbers[most_numbers] = {};

  constexpr int count() const
  {
    int n = 0;
    while (n < most_numbers && numbers[n]) n++;
    return n;
  }
  constexpr bool has(double Parameters::*member) const
  {
    for (int k = 0; k < count(); k++)
      if (numbers[k] == member) return true;
    return false;
  }
};

struct Choice {
  static constexpr int most_alternatives = 4;
  int (*get)(const Parameters &);
  void (*set)(Parameters &, int);
  const char *name;       ///< name in messages
  const char *keyword;    ///< nullptr: the words of the alternatives are keywords
  Merge merge;
  Alternative alternatives[most_alternatives];
  int count;
  int format = oldest_restart_format;

  constexpr Choice since(int restart_format) const
  {
    Choice c = *this;
    c.format = restart_format;
    return c;
  }
  const Alternative &chosen(const Parameters &p) const { return alternatives[get(p)]; }
};

/// An entry for the enumeration or bool `member`.
template <auto member, int N>
constexpr Choice choice(const char *name, const char *keyword, Merge merge,
                        const Alternative (&alternatives)[N])
{
  using Value = std::decay_t<decltype(Parameters().*member)>;
  static_assert(N <= Choice::most_alternatives);
  Choice made{[](const Parameters &p) {
                return static_cast<int>(p.*member);
              },
              [](Parameters &p, int value) {
                p.*member = static_cast<Value>(value);
              },
              name,
              keyword,
              merge,
              {},
              N};
  for (int k = 0; k < N; k++) made.alternatives[k] = alternatives[k];
  return made;
}

using Entry = std::variant<Number, Choice>;

/* ---------------------------------------------------------------------- the table */

/// All parameters, in the order of restart files.
constexpr Entry parameter_table[] = {
    Number{&Parameters::k1, "k1", "stiffness of loading", dimension::stiffness_n, range::positive,
           Mean::harmonic},
    Number{&Parameters::k2, "k2", "stiffness of unloading and reloading", dimension::stiffness_n,
           range::from_k1, Mean::harmonic},
    Number{&Parameters::k_adh, "k_adh", "adhesive stiffness", dimension::stiffness_n,
           range::not_negative, Mean::harmonic},
    Number{&Parameters::f0, "f0", "constant pull-off force, negative attracts", dimension::force,
           range::not_positive, Mean::geometric},
    Number{&Parameters::mu, "mu", "coefficient of sliding friction", dimension::none,
           range::not_negative, Mean::geometric},
    Number{&Parameters::depth, "phi_f", "largest plastic overlap over 2 R*", dimension::none,
           range::fraction, Mean::geometric}
        .with_keyword("depth")
        .only_with(Law::luding)
        .since(3),
    choice<&Parameters::bound>("bound", "bound", Merge::same, {{"adhesive"}, {"contact"}}).since(3),
    choice<&Parameters::kt_given>("kt given", nullptr, Merge::either,
                                  {{nullptr}, {"kt", {&Parameters::kt}}}),
    Number{&Parameters::kt, "kt", "tangential stiffness", dimension::stiffness, range::not_negative,
           Mean::harmonic}
        .or_else(tangential_stiffness, "2/7 k1"),
    choice<&Parameters::damping>(
        "damping", nullptr, Merge::same,
        {{"restitution", {&Parameters::restitution}},
         {"viscous", {&Parameters::viscous_normal, &Parameters::viscous_tangential}}}),
    Number{&Parameters::restitution, "e", "coefficient of restitution", dimension::none,
           range::restitution, Mean::geometric_product},
    Number{&Parameters::viscous_normal, "Bn", "coefficient of the normal dashpot",
           dimension::dashpot, range::not_negative, Mean::harmonic},
    Number{&Parameters::viscous_tangential, "Bt", "coefficient of the tangential dashpot",
           dimension::dashpot, range::not_negative, Mean::harmonic},
    choice<&Parameters::rolling>(
        "rolling model", "rolling", Merge::weaker,
        {{"none"},
         {"constant", {&Parameters::mu_r}},
         {"sds", {&Parameters::kr, &Parameters::rolling_viscous, &Parameters::mu_r}}}),
    Number{&Parameters::mu_r, "mu_r", "coefficient of rolling friction", dimension::none,
           range::not_negative, Mean::geometric},
    Number{&Parameters::kr, "kr", "stiffness of rolling", dimension::stiffness, range::not_negative,
           Mean::harmonic},
    Number{&Parameters::rolling_viscous, "gr", "coefficient of the rolling dashpot",
           dimension::dashpot, range::not_negative, Mean::harmonic},
    choice<&Parameters::twisting>("twisting model", "twisting", Merge::weaker,
                                  {{"none"}, {"marshall"}}),
};
constexpr int parameter_count = sizeof(parameter_table) / sizeof(parameter_table[0]);

/* ---------------------------------------------------------------------- what is asked of it */

constexpr int format_of(const Entry &entry)
{
  const Number *number = std::get_if<Number>(&entry);
  return number ? number->format : std::get_if<Choice>(&entry)->format;
}

/// The format of restart files that are written: the newest format of any parameter.
constexpr int newest_format()
{
  int newest = oldest_restart_format;
  for (const Entry &entry : parameter_table)
    if (format_of(entry) > newest) newest = format_of(entry);
  return newest;
}
constexpr int restart_format = newest_format();

template <class Function> void for_each_number(Function &&function)
{
  for (const Entry &entry : parameter_table)
    if (const Number *number = std::get_if<Number>(&entry)) function(*number);
}

template <class Function> void for_each_choice(Function &&function)
{
  for (const Entry &entry : parameter_table)
    if (const Choice *choice = std::get_if<Choice>(&entry)) function(*choice);
}

const Number &number_of(double Parameters::*member);

/// The choice that has this number as a value, or nullptr.
const Choice *choice_of(const Number &number);

/// Whether the number is typed right after the types, without a keyword.
inline bool is_positional(const Number &number)
{
  return !number.keyword && !choice_of(number);
}

/// Whether the law reads the number, so that it must be valid. Values of alternatives that were not
/// chosen are not read.
bool is_read(const Number &number, const Parameters &p);

/// Value of the number for the law: as given, or its default.
double value_of(const Number &number, const Parameters &p);

/// Name in messages: "mu", "kt", "viscous Bn", "rolling sds kr", "rolling mu_r" (of several
/// models).
std::string name_of(const Number &number);

/// Name in messages while the words of this alternative are read: "rolling constant mu_r".
std::string name_of(const Number &number, const Choice &choice, const Alternative &alternative);

/// Name of an alternative in messages: "rolling sds", "viscous damping"
std::string name_of(const Choice &choice, const Alternative &alternative);

}    // namespace eepa

#endif
