// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_RESTART_NUMBERS_H
#define EEPA_COMMANDS_RESTART_NUMBERS_H

#include "commands.h"
#include "parameter_table.h"

#include <array>
#include <vector>

// Style and parameters as plain numbers of restart files. The first number of a style is the format,
// which says which parameters are there; see parameter_table.h.

namespace eepa {

constexpr std::size_t packed_style_size = 8;
constexpr std::size_t packed_parameters_size = parameter_count;

std::array<double, packed_style_size> pack(const StyleArguments &style);
std::array<double, packed_parameters_size> pack(const Parameters &parameters);

/// \param[out] format  of the file, which unpack_parameters() has to know
/// \throw std::invalid_argument when this version can not read the format, or the numbers are damaged
StyleArguments unpack_style(const std::array<double, packed_style_size> &numbers, int &format);

/// How many numbers a pair of types has in files of a format.
std::size_t packed_size(int format);

/// \param numbers  packed_size(format) of them
/// \throw std::invalid_argument when they are damaged
Parameters unpack_parameters(const std::vector<double> &numbers, int format);

/// A law that a restart file stored.
/// \throw std::invalid_argument when there is none of that number
Law unpack_law(double stored);

}    // namespace eepa

#endif
