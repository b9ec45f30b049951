// SPDX-License-Identifier: GPL-2.0-only
#include "restart_numbers.h"

#include "validation.h"

#include <cmath>

namespace eepa {

namespace {

  /// The value of an enumeration that a restart file stored; casting any other number is undefined.
  int enumerator(double stored, int count, const std::string &what)
  {
    for (int k = 0; k < count; k++)
      if (stored == k) return k;
    refuse("the restart file is damaged: " + what + " " + std::to_string(stored) + " is unknown");
  }

  int known_format(double stored)
  {
    for (int format = oldest_restart_format; format <= restart_format; format++)
      if (stored == format) return format;
    std::string known = std::to_string(oldest_restart_format);
    if (oldest_restart_format < restart_format) known += " to " + std::to_string(restart_format);
    refuse("the restart file has format " + exact(stored) + " of gran/eepa, this version reads " +
           known);
  }

}    // namespace

bool is_count(double value, double least, double most)
{
  return value >= least && value <= most && value == std::floor(value);
}

std::array<double, packed_style_size> pack(const StyleArguments &style)
{
  const LawSettings &s = style.settings;
  return {restart_format,
          static_cast<double>(s.law),
          s.exponent,
          static_cast<double>(s.scaled),
          s.reference_diameter,
          static_cast<double>(s.limit_damping),
          static_cast<double>(style.time_step_check),
          style.largest_diameter};
}

StyleArguments unpack_style(const std::array<double, packed_style_size> &n, int &format)
{
  format = known_format(n[0]);
  StyleArguments style;
  style.settings.law = unpack_law(n[1]);
  style.settings.exponent = n[2];
  style.settings.scaled = n[3] != 0.0;
  style.settings.reference_diameter = n[4];
  style.settings.limit_damping = n[5] != 0.0;
  style.time_step_check = static_cast<TimeStepCheck>(
      enumerator(n[6], static_cast<int>(TimeStepCheck::error) + 1, "dtcheck"));
  style.largest_diameter = n[7];
  const Findings found = validate(style.settings);
  Words errors = found.errors;
  if (!(n[7] >= 0.0 && std::isfinite(n[7]))) errors.push_back("largest d = " + exact(n[7]));
  if (!errors.empty()) refuse("the restart file is damaged: " + joined(errors));
  return style;
}

std::array<double, packed_parameters_size> pack(const Parameters &p)
{
  std::array<double, packed_parameters_size> numbers;
  for (int k = 0; k < parameter_count; k++) {
    const Number *number = std::get_if<Number>(&parameter_table[k]);
    numbers[k] = number ? p.*number->member : std::get_if<Choice>(&parameter_table[k])->get(p);
  }
  return numbers;
}

std::size_t packed_size(int format)
{
  std::size_t size = 0;
  for (const Entry &entry : parameter_table)
    if (format_of(entry) <= format) size++;
  return size;
}

Parameters unpack_parameters(const std::vector<double> &numbers, int format)
{
  Parameters p;
  auto next = numbers.begin();
  for (const Entry &entry : parameter_table) {
    if (format_of(entry) > format) continue;
    const double stored = *next++;
    if (const Number *number = std::get_if<Number>(&entry))
      p.*number->member = stored;
    else if (const Choice *choice = std::get_if<Choice>(&entry))
      choice->set(p, enumerator(stored, choice->count, choice->name));
  }
  return p;
}

Law unpack_law(double stored)
{
  return static_cast<Law>(enumerator(stored, law_count, "law"));
}

}    // namespace eepa
