// SPDX-License-Identifier: GPL-2.0-only
#include "text.h"

#include <charconv>

namespace eepa {

std::string text_of(double value)
{
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  return std::string(text, end.ptr);
}

std::string text_of(const Vec3 &value)
{
  return text_of(value[0]) + " " + text_of(value[1]) + " " + text_of(value[2]);
}

}    // namespace eepa
