// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_RESTART_NUMBERS_H
#define EEPA_COMMANDS_RESTART_NUMBERS_H

#include "commands.h"
#include "parameter_table.h"

#include <array>
#include <vector>

// Style and parameters as plain numbers for restart files. The first number of a style is the
// format, which determines the parameters in the file; see parameter_table.h.

namespace eepa {

/// Whether a number of a file is an integer within bounds.
bool is_count(double value, double least, double most);

constexpr std::size_t packed_style_size = 8;
constexpr std::size_t packed_parameters_size = parameter_count;

std::array<double, packed_style_size> pack(const StyleArguments &style);
std::array<double, packed_parameters_size> pack(const Parameters &parameters);

/// \param[out] format  format of the file, an argument of unpack_parameters()
/// \throw std::invalid_argument when this version can not read the format, or the numbers are
///        damaged
StyleArguments unpack_style(const std::array<double, packed_style_size> &numbers, int &format);

/// Number of values of a pair of types in files of a format.
std::size_t packed_size(int format);

/// \param numbers  packed_size(format) of them
/// \throw std::invalid_argument when they are damaged
Parameters unpack_parameters(const std::vector<double> &numbers, int format);

/// The law that a restart file stored as a number.
/// \throw std::invalid_argument when no law has that number
Law unpack_law(double stored);

}    // namespace eepa

#endif
