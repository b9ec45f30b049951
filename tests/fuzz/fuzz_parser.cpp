// SPDX-License-Identifier: GPL-2.0-only

// Any bytes, split at blanks, through the parser that pair_style, pair_coeff and the wall share.
// libFuzzer calls this; replay.cpp does where there is none.

#include <eepa_commands/commands.h>
#include <eepa_commands/validation.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace {

using eepa::Words;

#define REQUIRE(condition)                                                           \
  do {                                                                               \
    if (!(condition)) {                                                              \
      std::fprintf(stderr, "%s:%d: violated: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                  \
    }                                                                                \
  } while (false)

Words split(const std::string &text)
{
  std::istringstream in(text);
  Words words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// Equal to the last bit, the sign of zero included.
template <std::size_t N>
bool same_bits(const std::array<double, N> &a, const std::array<double, N> &b)
{
  return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
}

/// Whether `parse` succeeded; a refusal must be an invalid_argument that says something.
template <class Parse> bool accepted(Parse parse)
{
  try {
    parse();
    return true;
  } catch (const std::invalid_argument &error) {
    REQUIRE(error.what()[0] != '\0');
    return false;
  }
}

void check_parameters(const Words &words, std::size_t first, const std::string &stop,
                      const eepa::LawSettings &settings)
{
  eepa::Parameters parameters;
  Words warnings;
  std::size_t next = 0;
  if (!accepted([&] {
        next = eepa::parse_parameters(words, first, stop, settings, parameters, warnings);
      }))
    return;
  REQUIRE(next > first && next <= words.size());
  REQUIRE(next == words.size() || words[next] == stop);
  REQUIRE(eepa::validate(parameters, settings).errors.empty());
  for (const auto &warning : warnings) REQUIRE(!warning.empty());

  const auto packed = eepa::pack(parameters);
  REQUIRE(same_bits(packed, eepa::pack(eepa::unpack_parameters(packed))));

  eepa::Parameters again;
  const Words written = split(eepa::to_words(parameters));
  REQUIRE(accepted([&] {
    next = eepa::parse_parameters(written, 0, "", settings, again, warnings);
  }));
  REQUIRE(next == written.size());
  REQUIRE(same_bits(packed, eepa::pack(again)));
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const Words words = split(std::string(reinterpret_cast<const char *>(data), size));

  for (const auto &word : words) {
    double value = 0.0;
    if (accepted([&] {
          value = eepa::parse_number("number", word);
        }))
      REQUIRE(std::isfinite(value));
  }

  // as a wall has it: style arguments, coeff, parameters, wall
  eepa::StyleArguments style;
  std::size_t next = 0;
  if (accepted([&] {
        next = eepa::parse_style(words, 0, "coeff", style);
      })) {
    REQUIRE(next > 0 && next <= words.size());
    REQUIRE(next == words.size() || words[next] == "coeff");
    REQUIRE(eepa::validate(style.settings).errors.empty());
    const auto packed = eepa::pack(style);
    REQUIRE(same_bits(packed, eepa::pack(eepa::unpack_style(packed))));
    check_parameters(words, next + 1, "wall", style.settings);
  }

  // as a wall's motion has it
  eepa::LoadArguments load;
  if (accepted([&] {
        next = eepa::parse_load(words, 0, {"contacts"}, load);
      })) {
    REQUIRE(next > 0 && next <= words.size());
    REQUIRE(next == words.size() || words[next] == "contacts");
    REQUIRE(std::isfinite(load.mass) && load.mass > 0.0);
    REQUIRE(std::isfinite(load.damping) && load.damping >= 0.0);
    REQUIRE(load.lowest <= load.highest);
    REQUIRE(load.area.value > 0.0 || !load.area.variable.empty() || !load.by_pressure);
  }

  // as pair_coeff has it, to the end
  for (const auto law : {eepa::Law::plateau, eepa::Law::linear})
    for (const double exponent : {1.0, 1.5}) {
      eepa::LawSettings settings;
      settings.law = law;
      settings.exponent = exponent;
      if (eepa::validate(settings).errors.empty()) check_parameters(words, 0, "", settings);
    }
  return 0;
}
