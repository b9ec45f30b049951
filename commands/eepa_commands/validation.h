// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_VALIDATION_H
#define EEPA_COMMANDS_VALIDATION_H

#include <eepa/parameters.h>

#include <string>
#include <vector>

// Checks of the kernel's input before a run.

namespace eepa {

/// The findings on a set of parameters: errors forbid a run, warnings deserve one line.
struct Findings {
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};

/// Checks the settings of a pair style or wall.
Findings validate(const LawSettings &settings);

/// Checks the parameters of one pair of types against a law.
Findings validate(const Parameters &parameters, const LawSettings &settings);

}    // namespace eepa

#endif
