// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_COMMANDS_H
#define EEPA_COMMANDS_COMMANDS_H

#include "words.h"

#include <eepa/parameters.h>

#include <string>

// The parser of everything that pair_style, pair_coeff and walls have in common; the rest of a
// wall's command is in wall_commands.h. It does not depend on LAMMPS, so that it can be tested and
// fuzzed alone.

namespace eepa {

/// The names of all laws, as in "plateau or linear".
std::string law_names();

/// Response to a time step above the stable one.
enum class TimeStepCheck { off, warn, error };

/// pair_style gran/eepa ...
struct StyleArguments {
  LawSettings settings;
  TimeStepCheck time_step_check = TimeStepCheck::warn;
  /// largest diameter that particles grow to in a run [length]; 0 where they do not grow. Walls
  /// need none.
  double largest_diameter = 0.0;
};

/// Reads `law [scale d_ref] [exponent n] [limit_damping yes|no]
/// [dtcheck warn|error|off] [largest d]` from words[first] on.
/// \param stop  a word that ends the arguments, or "" when they go to the end
/// \return index of the first word not read
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_style(const Words &words, std::size_t first, const std::string &stop,
                        StyleArguments &style);

/// Reads `k1 k2 k_adh f0 mu keyword values ...` from words[first] on, with the keywords of the
/// table of parameters, and validates it.
/// \param warnings  receives warnings for the log
/// \return index of the first word not read
/// \throw std::invalid_argument naming argument, value and what is allowed
std::size_t parse_parameters(const Words &words, std::size_t first, const std::string &stop,
                             const LawSettings &settings, Parameters &parameters, Words &warnings);

/// Validates parameters again, after settings changed or types were mixed.
/// \throw std::invalid_argument with every message
void require_valid(const Parameters &parameters, const LawSettings &settings, Words &warnings);

/// Words from which parse_parameters() reads the same parameters, to the last bit.
std::string to_words(const Parameters &parameters);

}    // namespace eepa

#endif
