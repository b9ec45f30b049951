// SPDX-License-Identifier: GPL-2.0-only

// What restart and data files carry comes back to the last bit, and files of every format are read.

#include "support.h"

#include <eepa_commands/restart_numbers.h>

using namespace eepa_test;

namespace {

Parameters unpacked(const std::array<double, packed_parameters_size> &numbers)
{
  return unpack_parameters({numbers.begin(), numbers.end()}, restart_format);
}

bool same(const Parameters &a, const Parameters &b)
{
  return pack(a) == pack(b);
}

TEST(RoundTrip, OfParametersThroughWordsIsExact)
{
  for (const char *line : {"0.1 0.30000000000000004 1e-300 -3.3333333333333335 0.5",
                           "5e3 1e4 5e3 -1e-9 0.5 kt 0.1 restitution 0.7 rolling constant 0.001",
                           "5e3 1e4 5e3 0 0.5 kt 0 viscous 0.1 0.2 rolling sds 0.1 0.2 0.3",
                           "5e3 1e4 5e3 0 0.5 bound contact twisting marshall"}) {
    const Parameters p = parameters_of(line);
    EXPECT_TRUE(same(p, parameters_of(to_words(p)))) << to_words(p);
    EXPECT_TRUE(same(p, unpacked(pack(p)))) << to_words(p);
  }
  const Parameters p = parameters_of("5e3 1e4 5e3 0 0.5 depth 0.1 bound contact", "luding");
  EXPECT_TRUE(same(p, parameters_of(to_words(p), "luding"))) << to_words(p);
  EXPECT_TRUE(same(p, unpacked(pack(p))));
}

TEST(RoundTrip, OfStyleThroughNumbersIsExact)
{
  for (const char *line :
       {"plateau", "luding", "linear scale 0.1 exponent 1.1 limit_damping yes dtcheck off",
        "linear dtcheck error"}) {
    int format = 0;
    const StyleArguments style = style_of(line);
    const StyleArguments again = unpack_style(pack(style), format);
    EXPECT_EQ(again.settings.law, style.settings.law);
    EXPECT_EQ(again.settings.exponent, style.settings.exponent);
    EXPECT_EQ(again.settings.scaled, style.settings.scaled);
    EXPECT_EQ(again.settings.reference_diameter, style.settings.reference_diameter);
    EXPECT_EQ(again.settings.limit_damping, style.settings.limit_damping);
    EXPECT_EQ(again.time_step_check, style.time_step_check);
    EXPECT_EQ(format, restart_format);
  }
}

// Files of format 2 have these numbers in this order; it can not change any more.
const std::vector<double> format_2 = {1, 4, 3, -4, 5, 1, 6, 1, 1, 7, 8, 2, 9, 10, 11, 1};

TEST(Format2, IsRead)
{
  ASSERT_EQ(packed_size(2), format_2.size());
  const Parameters p = unpack_parameters(format_2, 2);
  EXPECT_TRUE(
      same(p, parameters_of("1 4 3 -4 5 kt 6 viscous 7 8 rolling sds 10 11 9 twisting marshall")));
  // what each number is, beyond doubt
  EXPECT_EQ(p.k1, 1.0);
  EXPECT_EQ(p.k2, 4.0);
  EXPECT_EQ(p.k_adh, 3.0);
  EXPECT_EQ(p.f0, -4.0);
  EXPECT_EQ(p.mu, 5.0);
  EXPECT_TRUE(p.kt_given);
  EXPECT_EQ(p.kt, 6.0);
  EXPECT_EQ(p.damping, Damping::viscous);
  EXPECT_EQ(p.restitution, 1.0);
  EXPECT_EQ(p.viscous_normal, 7.0);
  EXPECT_EQ(p.viscous_tangential, 8.0);
  EXPECT_EQ(p.rolling, RollingModel::sds);
  EXPECT_EQ(p.mu_r, 9.0);
  EXPECT_EQ(p.kr, 10.0);
  EXPECT_EQ(p.rolling_viscous, 11.0);
  EXPECT_EQ(p.twisting, TwistingModel::marshall);
  EXPECT_EQ(p.bound, FrictionBound::adhesive);    // format 3 has it, and depth
  EXPECT_EQ(p.depth, 0.0);
}

TEST(Format2, HasLawsAndChecksByNumber)
{
  int format = 0;
  const StyleArguments style = unpack_style({2, 1, 1.5, 1, 3, 1, 2, 4}, format);
  EXPECT_EQ(format, 2);
  EXPECT_EQ(style.settings.law, Law::linear);
  EXPECT_EQ(style.settings.exponent, 1.5);
  EXPECT_TRUE(style.settings.scaled);
  EXPECT_EQ(style.settings.reference_diameter, 3.0);
  EXPECT_TRUE(style.settings.limit_damping);
  EXPECT_EQ(style.time_step_check, TimeStepCheck::error);
  EXPECT_EQ(style.largest_diameter, 4.0);
  EXPECT_EQ(unpack_style({2, 0, 1, 0, 1, 0, 0, 0}, format).settings.law, Law::plateau);
}

TEST(AnotherFormat, IsRefused)
{
  const std::string known = restart_format == 2 ? "2" : "2 to " + std::to_string(restart_format);
  for (const double format : {1.0, restart_format + 1.0, 2.5}) {
    auto numbers = pack(style_of("linear"));
    numbers[0] = format;
    int read = 0;
    EXPECT_EQ(refusal([&] {
                unpack_style(numbers, read);
              }),
              "the restart file has format " + exact(format) +
                  " of gran/eepa, this version reads " + known);
  }
}

TEST(DamagedNumbers, AreNamed)
{
  int format = 0;
  const struct {
    std::size_t index;
    double value;
    const char *message;
  } styles[] = {{1, 7, "law 7.000000 is unknown"},
                {6, 3, "dtcheck 3.000000 is unknown"},
                {2, 5, "exponent = 5 is not allowed: it must be between 1 and 2"},
                {7, -1, "largest d = -1"}};
  for (const auto &damage : styles) {
    auto numbers = pack(style_of("linear"));
    numbers[damage.index] = damage.value;
    EXPECT_EQ(refusal([&] {
                unpack_style(numbers, format);
              }),
              std::string("the restart file is damaged: ") + damage.message);
  }
  const struct {
    std::size_t index;
    double value;
    const char *message;
  } enumerations[] = {{5, 2, "kt given 2.000000 is unknown"},
                      {7, -1, "damping -1.000000 is unknown"},
                      {11, 0.5, "rolling model 0.500000 is unknown"},
                      {15, 2, "twisting model 2.000000 is unknown"}};
  for (const auto &damage : enumerations) {
    std::vector<double> numbers = format_2;
    numbers[damage.index] = damage.value;
    EXPECT_EQ(refusal([&] {
                unpack_parameters(numbers, 2);
              }),
              std::string("the restart file is damaged: ") + damage.message);
  }
}

}    // namespace
