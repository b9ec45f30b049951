// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_PARSER_SUPPORT_H
#define EEPA_TESTS_PARSER_SUPPORT_H

#include <eepa_commands/commands.h>

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>

namespace eepa_test {

using namespace eepa;

inline Words words(const std::string &line)
{
  std::istringstream stream(line);
  Words all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

inline StyleArguments style_of(const std::string &line)
{
  StyleArguments style;
  parse_style(words(line), 0, "", style);
  return style;
}

inline Parameters parameters_of(const std::string &line, const std::string &style = "linear")
{
  Parameters parameters;
  Words warnings;
  parse_parameters(words(line), 0, "", style_of(style).settings, parameters, warnings);
  return parameters;
}

/// The message of the error that `attempt` throws, "" when it throws none.
template <class Attempt> std::string refusal(Attempt &&attempt)
{
  try {
    attempt();
  } catch (const std::invalid_argument &e) {
    return e.what();
  }
  return "";
}

/// A line that is refused with this message.
struct Mistake {
  const char *line, *message;
};

}    // namespace eepa_test

#endif
