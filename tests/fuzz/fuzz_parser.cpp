// SPDX-License-Identifier: GPL-2.0-only

// Arbitrary bytes, split at blanks, through the parser of pair_style, pair_coeff, fix
// wall/gran/eepa and its fix_modify. Called by libFuzzer, or by replay.cpp without it.

#include <eepa_commands/mixing.h>
#include <eepa_commands/restart_numbers.h>
#include <eepa_commands/validation.h>
#include <eepa_commands/wall_commands.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace {

using eepa::MotionArguments;
using eepa::WallDrive;
using eepa::WallShape;
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

/// Whether `parse` succeeded; a refusal must be an invalid_argument with a message.
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

/// Checks what must hold for every set of parameters that a command was read to.
void check_parameters(const eepa::Parameters &parameters, const eepa::LawSettings &settings)
{
  REQUIRE(eepa::validate(parameters, settings).errors.empty());
  const auto packed = eepa::pack(parameters);
  REQUIRE(same_bits(
      packed,
      eepa::pack(eepa::unpack_parameters({packed.begin(), packed.end()}, eepa::restart_format))));

  eepa::Parameters again;
  Words warnings;
  std::size_t next = 0;
  const Words written = split(eepa::to_words(parameters));
  REQUIRE(accepted([&] {
    next = eepa::parse_parameters(written, 0, "", settings, again, warnings);
  }));
  REQUIRE(next == written.size());
  REQUIRE(same_bits(packed, eepa::pack(again)));

  std::string why;
  REQUIRE(eepa::mix(parameters, parameters, again, why) && why.empty());
  REQUIRE(same_bits(packed, eepa::pack(again)));
}

/// Reads words like those of pair_coeff.
void parse_parameters(const Words &words, std::size_t first, const std::string &stop,
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
  for (const auto &warning : warnings) REQUIRE(!warning.empty());
  check_parameters(parameters, settings);
}

bool is_quantity(const eepa::Quantity &quantity)
{
  return std::isfinite(quantity.value) && (quantity.variable.empty() || quantity.value == 0.0);
}

void check_shape(const WallShape &shape)
{
  REQUIRE(shape.kind >= 0 && shape.kind < WallShape::kind_count);
  if (!shape.is_plane()) {
    REQUIRE(shape.planes() == 0 && std::isfinite(shape.radius));
    REQUIRE((shape.kind == WallShape::zcylinder) == (shape.radius > 0.0));
    REQUIRE((shape.kind == WallShape::region) == !shape.region_id.empty());
    REQUIRE((shape.kind == WallShape::mesh) == !shape.file.empty());
    REQUIRE(std::isfinite(shape.placement.scale) && shape.placement.scale > 0.0);
    REQUIRE(std::isfinite(shape.placement.degrees));
    REQUIRE(shape.smooth >= 0.0 && shape.smooth < 90.0);
    return;
  }
  REQUIRE(shape.planes() == 1 || shape.planes() == 2);
  REQUIRE(shape.axis() >= 0 && shape.axis() < 3);
  REQUIRE(std::isfinite(shape.lo) && std::isfinite(shape.hi));
  if (shape.planes() == 2) REQUIRE(shape.lo < shape.hi);
}

void check_motion(const MotionArguments &motion, const WallShape &shape)
{
  for (const auto &component : motion.velocity) {
    REQUIRE(is_quantity(component));
    if (motion.drive != WallDrive::velocity)
      REQUIRE(component.value == 0.0 && component.variable.empty());
  }
  REQUIRE(is_quantity(motion.shear));
  REQUIRE(motion.wiggle_axis >= 0 && motion.wiggle_axis < 3);
  REQUIRE(motion.shear_axis >= 0 && motion.shear_axis < 3);
  REQUIRE(eepa::is_motion(eepa::name_of(motion.drive)));
  if (motion.drive == WallDrive::wiggle)
    REQUIRE(std::isfinite(motion.amplitude) && std::isfinite(motion.period) && motion.period > 0.0);
  if (motion.drive == WallDrive::shear) REQUIRE(motion.slides);
  if (motion.slides) {
    REQUIRE(motion.drive == WallDrive::shear || motion.drive == WallDrive::load);
    REQUIRE(!shape.is_plane() || motion.shear_axis != shape.axis());
  }
  if (motion.drive == WallDrive::rotate) REQUIRE(motion.rotates);
  if (motion.rotates) {
    REQUIRE(motion.drive != WallDrive::shear && motion.drive != WallDrive::still);
    REQUIRE(!motion.slides && is_quantity(motion.rotation.speed));
    double squared = 0.0;
    for (const double component : motion.rotation.axis) squared += component * component;
    REQUIRE(std::fabs(squared - 1.0) < 1e-14);
    for (const double component : motion.rotation.point) REQUIRE(std::isfinite(component));
  }
  if (motion.drive != WallDrive::load) return;
  REQUIRE(shape.planes() != 2 && shape.kind != WallShape::zcylinder);
  REQUIRE(motion.load.axis >= 0 && motion.load.axis < 3);
  REQUIRE(!shape.is_plane() || motion.load.axis == shape.axis());
  const eepa::LoadArguments &load = motion.load;
  REQUIRE(is_quantity(load.force) && is_quantity(load.pressure) && is_quantity(load.area));
  REQUIRE(std::isfinite(load.mass) && load.mass > 0.0);
  REQUIRE(std::isfinite(load.damping) && load.damping >= 0.0);
  REQUIRE(load.lowest <= load.highest);
  REQUIRE(load.area.value > 0.0 || !load.area.variable.empty() || !load.by_pressure);
}

void parse_style(const Words &words)
{
  eepa::StyleArguments style;
  std::size_t next = 0;
  if (!accepted([&] {
        next = eepa::parse_style(words, 0, "coeff", style);
      }))
    return;
  REQUIRE(next > 0 && next <= words.size());
  REQUIRE(next == words.size() || words[next] == "coeff");
  REQUIRE(eepa::validate(style.settings).errors.empty());
  const auto packed = eepa::pack(style);
  int format = 0;
  REQUIRE(same_bits(packed, eepa::pack(eepa::unpack_style(packed, format))));
  REQUIRE(format == eepa::restart_format);
  parse_parameters(words, next + 1, "wall", style.settings);
}

void parse_wall(const Words &words)
{
  eepa::WallArguments wall;
  Words warnings;
  if (!accepted([&] {
        wall = eepa::parse_wall(words, 0, warnings);
      }))
    return;
  REQUIRE(eepa::validate(wall.style.settings).errors.empty());
  check_parameters(wall.parameters, wall.style.settings);
  check_shape(wall.shape);
  check_motion(wall.motion, wall.shape);
  REQUIRE(!wall.contact_table || eepa::contains(words, "contacts"));
  REQUIRE(wall.face_interval >= 0);
  REQUIRE(wall.face_interval == 0 || wall.shape.kind == WallShape::mesh);
  for (const double component : wall.about) REQUIRE(std::isfinite(component));
}

void parse_wall_change(const Words &words)
{
  WallShape shapes[5];
  shapes[0].has_lo = true;
  shapes[1].kind = WallShape::xplane;
  shapes[1].has_lo = shapes[1].has_hi = true;
  shapes[1].hi = 1.0;
  shapes[2].kind = WallShape::zcylinder;
  shapes[2].radius = 1.0;
  shapes[3].kind = WallShape::region;
  shapes[4].kind = WallShape::mesh;
  for (const WallShape &shape : shapes) {
    MotionArguments motion;
    motion.amplitude = 77.0;
    std::size_t read = 0;
    if (!accepted([&] {
          read = eepa::parse_wall_change(words, shape, motion);
        }) ||
        read == 0) {
      REQUIRE(motion.amplitude == 77.0);
      REQUIRE(read == 0);
      continue;
    }
    REQUIRE(read <= words.size() && eepa::is_motion(words.front()));
    REQUIRE(read == words.size() || !eepa::is_motion(words[read]));
    check_motion(motion, shape);
  }
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

  parse_style(words);
  parse_wall(words);
  parse_wall_change(words);
  for (int law = 0; law < eepa::law_count; law++)
    for (const double exponent : {1.0, 1.5}) {
      eepa::LawSettings settings;
      settings.law = static_cast<eepa::Law>(law);
      settings.exponent = exponent;
      if (eepa::validate(settings).errors.empty()) parse_parameters(words, 0, "", settings);
    }
  return 0;
}
