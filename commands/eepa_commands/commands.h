// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_COMMANDS_H
#define EEPA_COMMANDS_COMMANDS_H

#include <eepa/parameters.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

// The one parser of everything that a pair_style, a pair_coeff and a wall have in common, and of a
// wall's load. It knows nothing of LAMMPS, so that it can be tested and fuzzed alone.

namespace eepa {

using Words = std::vector<std::string>;

/// What to do about a time step above the stable one.
enum class TimeStepCheck { off, warn, error };

/// pair_style gran/eepa ...
struct StyleArguments {
  LawSettings settings;
  TimeStepCheck time_step_check = TimeStepCheck::warn;
  /// that particles may grow to in a run [length]; 0 where they do not grow. Walls need none.
  double largest_diameter = 0.0;
};

/// Reads `plateau|linear [scale d_ref] [exponent n] [limit_damping yes|no]
/// [dtcheck warn|error|off] [largest d]` from words[first] on.
/// \param stop  a word that ends the arguments, or "" when they go to the end
/// \return index of the first word not read
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_style(const Words &words, std::size_t first, const std::string &stop,
                        StyleArguments &style);

/// Reads `k1 k2 k_adh f0 mu [kt v] [restitution e | viscous Bn Bt]
/// [rolling none|constant mu_r|sds kr gr mu_r] [twisting none|marshall]` from words[first] on and
/// validates it.
/// \param warnings  gets what deserves a line in the log
/// \return index of the first word not read
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_parameters(const Words &words, std::size_t first, const std::string &stop,
                             const LawSettings &settings, Parameters &parameters, Words &warnings);

/// A number, or a variable that gives it.
struct Quantity {
  double value = 0.0;
  std::string variable;    ///< name without v_; empty where a number was given
};

/// What drives a platen, and how it answers. Along the plane's axis.
struct LoadArguments {
  bool by_pressure = false;    ///< else by a force
  Quantity force;              ///< > 0 towards + [force]
  Quantity pressure;           ///< > 0 towards the particles [force/length^2]
  Quantity area;               ///< > 0 [length^2]
  double mass = 0.0;           ///< > 0 [mass]
  double damping = 0.0;        ///< >= 0 [mass/time]
  double lowest = -std::numeric_limits<double>::infinity();    ///< limits of travel [length]
  double highest = std::numeric_limits<double>::infinity();
};

/// Reads `F|pressure p area A mass M [damping c] [limits lo hi]` from words[first] on; F, p and A
/// may be v_name.
/// \param others  keywords that end the arguments
/// \return index of the first word not read
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_load(const Words &words, std::size_t first, const Words &others,
                       LoadArguments &load);

/// The message of a number that is not allowed, as all of this package have it.
/// \throw std::invalid_argument always
[[noreturn]] void refuse_value(const std::string &name, double value, const std::string &allowed);

/// Reads a finite number.
/// \throw std::invalid_argument naming `name` and the word
double parse_number(const std::string &name, const std::string &word);

/// Reads a finite number or v_name.
/// \throw std::invalid_argument naming `name` and the word
Quantity parse_quantity(const std::string &name, const std::string &word);

/// Validates parameters once more, after settings changed or types were mixed.
/// \throw std::invalid_argument with every message
void require_valid(const Parameters &parameters, const LawSettings &settings, Words &warnings);

/// The words that parse_parameters() reads back to the same parameters, to the last bit.
std::string to_words(const Parameters &parameters);

constexpr std::size_t packed_style_size = 8;
constexpr std::size_t packed_parameters_size = 16;

/// Plain numbers for restart files, the format's version among the style's.
std::array<double, packed_style_size> pack(const StyleArguments &style);
std::array<double, packed_parameters_size> pack(const Parameters &parameters);

/// \throw std::invalid_argument when another version of this package wrote them, or they are
/// damaged
StyleArguments unpack_style(const std::array<double, packed_style_size> &numbers);
Parameters unpack_parameters(const std::array<double, packed_parameters_size> &numbers);

}    // namespace eepa

#endif
