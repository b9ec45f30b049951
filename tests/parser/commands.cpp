// SPDX-License-Identifier: GPL-2.0-only

// The parser of pair_style and pair_coeff: what it reads, where it stops and what it says of each
// mistake.

#include "support.h"

using namespace eepa_test;

namespace {

TEST(StyleArguments, HaveTheDefaultsOfTheContract)
{
  const StyleArguments style = style_of("linear");
  EXPECT_EQ(style.settings.law, Law::linear);
  EXPECT_EQ(style.settings.exponent, 1.0);
  EXPECT_FALSE(style.settings.scaled);
  EXPECT_FALSE(style.settings.limit_damping);
  EXPECT_EQ(style.time_step_check, TimeStepCheck::warn);
  EXPECT_EQ(style_of("plateau").settings.law, Law::plateau);
}

TEST(StyleArguments, AreReadInAnyOrder)
{
  const StyleArguments style =
      style_of("linear dtcheck error exponent 1.5 limit_damping yes scale 1e-3");
  EXPECT_EQ(style.time_step_check, TimeStepCheck::error);
  EXPECT_EQ(style.settings.exponent, 1.5);
  EXPECT_TRUE(style.settings.limit_damping);
  EXPECT_TRUE(style.settings.scaled);
  EXPECT_EQ(style.settings.reference_diameter, 1e-3);
  EXPECT_EQ(style_of("linear dtcheck off").time_step_check, TimeStepCheck::off);
  EXPECT_FALSE(style_of("linear limit_damping no").settings.limit_damping);
}

TEST(StyleArguments, DoNotRememberAnEarlierCommand)
{
  StyleArguments style = style_of("linear scale 2 exponent 1.5 limit_damping yes dtcheck off");
  parse_style(words("plateau"), 0, "", style);
  EXPECT_FALSE(style.settings.scaled);
  EXPECT_EQ(style.settings.exponent, 1.0);
  EXPECT_FALSE(style.settings.limit_damping);
  EXPECT_EQ(style.time_step_check, TimeStepCheck::warn);
}

TEST(StyleArguments, StopAtTheWordThatEndsThem)
{
  StyleArguments style;
  const Words line = words("ID all wall/gran/eepa linear scale 2 coeff 1 2 3");
  EXPECT_EQ(parse_style(line, 3, "coeff", style), 6u);
  EXPECT_EQ(parse_style(words("linear"), 0, "coeff", style), 1u);    // end of the line
}

TEST(Parameters, HaveTheDefaultsOfTheContract)
{
  const Parameters p = parameters_of("5e3 1e4 2e3 -0.5 0.3");
  EXPECT_EQ(p.k1, 5e3);
  EXPECT_EQ(p.k2, 1e4);
  EXPECT_EQ(p.k_adh, 2e3);
  EXPECT_EQ(p.f0, -0.5);
  EXPECT_EQ(p.mu, 0.3);
  EXPECT_FALSE(p.kt_given);
  EXPECT_EQ(tangential_stiffness(p), 2.0 / 7.0 * 5e3);
  EXPECT_EQ(p.damping, Damping::restitution);
  EXPECT_EQ(p.restitution, 1.0);
  EXPECT_EQ(p.rolling, RollingModel::none);
  EXPECT_EQ(p.twisting, TwistingModel::none);
  EXPECT_EQ(p.bound, FrictionBound::adhesive);
  EXPECT_EQ(p.depth, 0.0);
}

TEST(Parameters, TakeEveryKeywordInAnyOrder)
{
  const Parameters p =
      parameters_of("1 2 3 -4 5 twisting marshall rolling sds 6 7 8 viscous 9 10 kt 11");
  EXPECT_EQ(p.twisting, TwistingModel::marshall);
  EXPECT_EQ(p.rolling, RollingModel::sds);
  EXPECT_EQ(p.kr, 6.0);
  EXPECT_EQ(p.rolling_viscous, 7.0);
  EXPECT_EQ(p.mu_r, 8.0);
  EXPECT_EQ(p.damping, Damping::viscous);
  EXPECT_EQ(p.viscous_normal, 9.0);
  EXPECT_EQ(p.viscous_tangential, 10.0);
  EXPECT_TRUE(p.kt_given);
  EXPECT_EQ(p.kt, 11.0);
  const Parameters q = parameters_of("1 2 3 -4 5 restitution 0.25 rolling constant 0.001");
  EXPECT_EQ(q.restitution, 0.25);
  EXPECT_EQ(q.rolling, RollingModel::constant);
  EXPECT_EQ(q.mu_r, 0.001);
  EXPECT_EQ(parameters_of("1 2 3 -4 5 rolling none").rolling, RollingModel::none);
  EXPECT_EQ(parameters_of("1 2 3 -4 5 twisting none").twisting, TwistingModel::none);
  EXPECT_EQ(parameters_of("1 2 3 -4 5 bound contact kt 6").bound, FrictionBound::contact);
  EXPECT_EQ(parameters_of("1 2 3 -4 5 kt 6 bound adhesive").bound, FrictionBound::adhesive);
  EXPECT_EQ(parameters_of("1 2 3 -4 5 kt 6 depth 0.05", "luding").depth, 0.05);
  EXPECT_EQ(parameters_of("1 2 3 -4 5 depth 1", "luding").depth, 1.0);
}

TEST(Parameters, StopAtTheWordThatEndsThem)
{
  Parameters p;
  Words warnings;
  const Words line = words("coeff 1 2 0 0 0 kt 3 wall zplane 0 NULL");
  EXPECT_EQ(parse_parameters(line, 1, "wall", LawSettings(), p, warnings), 8u);
}

TEST(Parameters, WarnOnceOfPlateauThatUnloadsLate)
{
  Parameters p;
  Words warnings;
  LawSettings plateau;
  plateau.law = Law::plateau;
  parse_parameters(words("1e4 3e4 0 0 0"), 0, "", plateau, p, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "plateau with k2 = 30000 > 2 k1 = 20000: unloading keeps to the loading branch down to "
            "an overlap of 0.5 of the largest one, where the k2 line meets it");
  warnings.clear();
  parse_parameters(words("1e4 2e4 0 0 0"), 0, "", plateau, p, warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(Parameters, AreLeftAloneByARefusedCommand)
{
  Parameters p = parameters_of("1 2 3 -4 5");
  Words warnings;
  EXPECT_THROW(parse_parameters(words("7 8 9 -1 2 kt -1"), 0, "", LawSettings(), p, warnings),
               std::invalid_argument);
  EXPECT_EQ(p.k1, 1.0);
}

class StyleMistake : public testing::TestWithParam<Mistake> {};
TEST_P(StyleMistake, IsNamed)
{
  EXPECT_EQ(refusal([] {
              style_of(GetParam().line);
            }),
            GetParam().message);
}
const Mistake style_mistakes[] = {
    {"", "missing value: law (plateau, linear or luding)"},
    {"hertz", "law 'hertz' is unknown: it must be plateau, linear or luding"},
    {"Linear", "law 'Linear' is unknown: it must be plateau, linear or luding"},
    {"linear scale", "missing value: scale d_ref"},
    {"linear scale 0", "scale d_ref = 0 is not allowed: it must be > 0"},
    {"linear scale -1", "scale d_ref = -1 is not allowed: it must be > 0"},
    {"linear scale nan", "scale d_ref = nan is not a finite number"},
    {"linear exponent", "missing value: exponent"},
    {"linear exponent 0.5", "exponent = 0.5 is not allowed: it must be between 1 and 2"},
    {"linear exponent 2.5", "exponent = 2.5 is not allowed: it must be between 1 and 2"},
    {"luding exponent 1.5",
     "exponent = 1.5 is not allowed with luding: only linear has an exponent"},
    {"plateau exponent 1.5",
     "exponent = 1.5 is not allowed with plateau: only linear has an exponent"},
    {"linear limit_damping", "missing value: limit_damping"},
    {"linear limit_damping maybe", "limit_damping 'maybe' is not allowed: it must be yes or no"},
    {"linear dtcheck", "missing value: dtcheck"},
    {"linear dtcheck 1", "dtcheck '1' is not allowed: it must be warn, error or off"},
    {"linear scale 1 scale 2", "keyword scale is given twice"},
    {"linear dtcheck off exponent 1 dtcheck off", "keyword dtcheck is given twice"},
    {"linear largest 0", "largest d = 0 is not allowed: it must be > 0"},
    {"linear largest big", "largest d = big is not a finite number"},
    {"linear 5",
     "keyword '5' is unknown: it must be scale, exponent, limit_damping, dtcheck or largest"},
    {"linear coeff",
     "keyword 'coeff' is unknown: it must be scale, exponent, limit_damping, dtcheck or largest"},
};
INSTANTIATE_TEST_SUITE_P(Lines, StyleMistake, testing::ValuesIn(style_mistakes));

class ParameterMistake : public testing::TestWithParam<Mistake> {};
TEST_P(ParameterMistake, IsNamed)
{
  EXPECT_EQ(refusal([] {
              parameters_of(GetParam().line);
            }),
            GetParam().message);
}
const Mistake parameter_mistakes[] = {
    {"", "missing value: k1"},
    {"1", "missing value: k2"},
    {"1 2", "missing value: k_adh"},
    {"1 2 3", "missing value: f0"},
    {"1 2 3 -4", "missing value: mu"},
    {"1 2 3 kt 4", "f0 = kt is not a finite number"},
    {"nan 2 3 -4 5", "k1 = nan is not a finite number"},
    {"1 inf 3 -4 5", "k2 = inf is not a finite number"},
    {"1 2 0x3 -4 5", "k_adh = 0x3 is not a finite number"},
    {"1 2 3 1e 5", "f0 = 1e is not a finite number"},
    {"1 2 3 -4 mu", "mu = mu is not a finite number"},
    {"0 2 3 -4 5", "k1 = 0 is not allowed: it must be > 0"},
    {"-1 2 3 -4 5", "k1 = -1 is not allowed: it must be > 0"},
    {"3 2 3 -4 5", "k2 = 2 is not allowed: it must be >= k1 = 3"},
    {"1 2 -3 -4 5", "k_adh = -3 is not allowed: it must be >= 0"},
    {"1 2 3 4 5", "f0 = 4 is not allowed: it must be <= 0 (a negative pull-off force attracts)"},
    {"1 2 3 -4 -5", "mu = -5 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 kt", "missing value: kt"},
    {"1 2 3 -4 5 kt -6", "kt = -6 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 restitution", "missing value: restitution"},
    {"1 2 3 -4 5 restitution 1.1",
     "restitution = 1.1 is not allowed: it must be between 0 (critical damping) and 1 (none)"},
    {"1 2 3 -4 5 restitution -0.1",
     "restitution = -0.1 is not allowed: it must be between 0 (critical damping) and 1 (none)"},
    {"1 2 3 -4 5 viscous 1", "missing value: viscous Bt"},
    {"1 2 3 -4 5 viscous -1 0", "viscous Bn = -1 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 viscous 0 -1", "viscous Bt = -1 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 restitution 1 viscous 0 0", "restitution and viscous exclude each other"},
    {"1 2 3 -4 5 viscous 0 0 restitution 1", "restitution and viscous exclude each other"},
    {"1 2 3 -4 5 rolling", "missing value: rolling model"},
    {"1 2 3 -4 5 rolling free",
     "rolling model 'free' is unknown: it must be none, constant or sds"},
    {"1 2 3 -4 5 rolling constant", "missing value: rolling constant mu_r"},
    {"1 2 3 -4 5 rolling constant -1", "rolling mu_r = -1 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 rolling sds 1 2", "missing value: rolling sds mu_r"},
    {"1 2 3 -4 5 rolling sds -1 2 3", "rolling sds kr = -1 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 rolling sds 1 -2 3", "rolling sds gr = -2 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 rolling sds 1 2 -3", "rolling mu_r = -3 is not allowed: it must be >= 0"},
    {"1 2 3 -4 5 kt 1 kt 2", "keyword kt is given twice"},
    {"1 2 3 -4 5 restitution 1 restitution 1", "keyword restitution is given twice"},
    {"1 2 3 -4 5 twisting", "missing value: twisting model"},
    {"1 2 3 -4 5 twisting sds", "twisting model 'sds' is unknown: it must be none or marshall"},
    {"1 2 3 -4 5 twisting none twisting none", "keyword twisting is given twice"},
    {"1 2 3 -4 5 bound", "missing value: bound"},
    {"1 2 3 -4 5 bound none", "bound 'none' is unknown: it must be adhesive or contact"},
    {"1 2 3 -4 5 bound contact bound contact", "keyword bound is given twice"},
    {"1 2 3 -4 5 depth 0.05", "keyword depth is not allowed with linear: only luding has it"},
    {"1 2 3 -4 5 6",
     "keyword '6' is unknown: it must be bound, kt, restitution, viscous, rolling or twisting"},
    {"1 2 3 -4 5 wall",
     "keyword 'wall' is unknown: it must be bound, kt, restitution, viscous, rolling or twisting"},
    {"0 2 -3 -4 5",
     "k1 = 0 is not allowed: it must be > 0; k_adh = -3 is not allowed: it must be "
     ">= 0"},
};
INSTANTIATE_TEST_SUITE_P(Lines, ParameterMistake, testing::ValuesIn(parameter_mistakes));

TEST(ParameterMistakeOfALaw, IsNamed)
{
  EXPECT_EQ(refusal([] {
              parameters_of("1e4 1.5e4 0 0 0", "plateau");
            }),
            "k2 = 15000 is not allowed with plateau: it must be >= 2 k1 = 20000, or a virgin "
            "contact never loads; use linear, which takes any k2 >= k1");
  EXPECT_EQ(refusal([] {
              parameters_of("1 2 0 0 0", "linear exponent 1.5");
            }),
            "kt must be given (force/length) when the exponent is 1.5: 2/7 k1 is a stiffness only "
            "for exponent 1");
  const Mistake of_luding[] = {
      {"1 2 0 0 0", "depth must be given with luding; it must be > 0 and <= 1"},
      {"1 2 0 0 0 depth", "missing value: depth"},
      {"1 2 0 0 0 depth 0", "depth must be given with luding; it must be > 0 and <= 1"},
      {"1 2 0 0 0 depth -0.1", "depth = -0.1 is not allowed: it must be > 0 and <= 1"},
      {"1 2 0 0 0 depth 1.01", "depth = 1.01 is not allowed: it must be > 0 and <= 1"},
      {"1 2 0 0 0 depth nan", "depth = nan is not a finite number"},
      {"2 2 0 0 0 depth 0.1",
       "k2 = 2 is not allowed with luding: it must be > k1 = 2; use linear, which takes k2 = k1"},
      {"1 2 0 0 0 6",
       "keyword '6' is unknown: it must be depth, bound, kt, restitution, viscous, rolling or "
       "twisting"},
  };
  for (const Mistake &mistake : of_luding)
    EXPECT_EQ(refusal([&] {
                parameters_of(mistake.line, "luding");
              }),
              mistake.message);
}

TEST(RequireValid, RefusesWhatOtherSettingsForbid)
{
  const Parameters p = parameters_of("1e4 1e4 0 0 0");
  Words warnings;
  EXPECT_NO_THROW(require_valid(p, style_of("linear").settings, warnings));
  EXPECT_THROW(require_valid(p, style_of("plateau").settings, warnings), std::invalid_argument);
  EXPECT_THROW(require_valid(p, style_of("linear exponent 2").settings, warnings),
               std::invalid_argument);
  EXPECT_THROW(require_valid(p, style_of("luding").settings, warnings), std::invalid_argument);
  EXPECT_EQ(refusal([&] {
              require_valid(parameters_of("1 2 0 0 0 depth 0.05", "luding"),
                            style_of("linear").settings, warnings);
            }),
            "depth is not allowed with linear: only luding has it");
}

}    // namespace
