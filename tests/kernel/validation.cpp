// SPDX-License-Identifier: GPL-2.0-only
// Messages on parameters (contract, section 3): they name the argument, its value and what is allowed.

#include "support.h"

namespace validation_test {
using namespace eepa_test;

Material good(Law law = Law::linear)
{
  return material(law, 1e3, 2e3, 5e2, -0.01);
}

std::string errors(const Material &m)
{
  std::string all;
  for (const Findings &found : {validate(m.law), validate(m.p, m.law)})
    for (const std::string &line : found.errors) all += line + "\n";
  return all;
}

/// Exactly one error, that has each of these words.
void expect_error(const Material &m, const std::vector<std::string> &words)
{
  const std::string all = errors(m);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1) << all;
  for (const std::string &word : words)
    EXPECT_NE(all.find(word), std::string::npos) << word << " in " << all;
}

TEST(Validation, GoodParametersPass)
{
  EXPECT_EQ(errors(good()), "");
  EXPECT_EQ(errors(good(Law::plateau)), "");
  EXPECT_TRUE(validate(good().p, good().law).warnings.empty());
  EXPECT_TRUE(validate(good(Law::plateau).p, good(Law::plateau).law).warnings.empty());
}

TEST(Validation, EveryValueAtTheEndOfItsRangePasses)
{
  Material m = good();
  m.p.k2 = m.p.k1;
  m.p.k_adh = m.p.f0 = m.p.mu = 0.0;
  m.p.kt_given = true;
  m.p.kt = 0.0;
  for (double e : {0.0, 1.0}) {
    m.p.restitution = e;
    EXPECT_EQ(errors(m), "");
  }
  m.p.damping = Damping::viscous;
  m.p.rolling = RollingModel::sds;
  EXPECT_EQ(errors(m), "");
  for (double n : {1.0, 2.0}) {
    m.law.exponent = n;
    EXPECT_EQ(errors(m), "");
  }
}

TEST(Validation, LoadingStiffness)
{
  Material m = good();
  for (double k1 : {0.0, -5.25}) {
    m.p.k1 = k1;
    expect_error(m, {"k1 = ", k1 == 0.0 ? "0" : "-5.25", "> 0"});
  }
}

TEST(Validation, UnloadingStiffness)
{
  Material m = good();
  m.p.k2 = 999.5;
  expect_error(m, {"k2 = 999.5", ">= k1 = 1000"});
}

TEST(Validation, AdhesiveStiffness)
{
  Material m = good();
  m.p.k_adh = -1.5;
  expect_error(m, {"k_adh = -1.5", ">= 0"});
}

TEST(Validation, PullOffForce)
{
  Material m = good();
  m.p.f0 = 0.25;
  expect_error(m, {"f0 = 0.25", "<= 0", "attracts"});
}

TEST(Validation, Friction)
{
  Material m = good();
  m.p.mu = -0.5;
  expect_error(m, {"mu = -0.5", ">= 0"});
}

TEST(Validation, TangentialStiffness)
{
  Material m = good();
  m.p.kt = -3.0;
  EXPECT_EQ(errors(m), "");    // not given, not read
  m.p.kt_given = true;
  expect_error(m, {"kt = -3", ">= 0"});
}

TEST(Validation, TangentialStiffnessMustBeGivenWithAnExponent)
{
  Material m = good();
  m.law.exponent = 1.5;
  expect_error(m, {"kt", "must be given", "force/length", "1.5"});
}

TEST(Validation, Restitution)
{
  Material m = good();
  for (double e : {-0.125, 1.125}) {
    m.p.restitution = e;
    expect_error(m, {e < 0.0 ? "restitution = -0.125" : "restitution = 1.125", "0", "1"});
  }
  m.p.damping = Damping::viscous;
  EXPECT_EQ(errors(m), "");    // not read
}

TEST(Validation, ViscousDashpots)
{
  Material m = good();
  m.p.viscous_normal = m.p.viscous_tangential = -1.0;
  EXPECT_EQ(errors(m), "");    // not read with restitution
  m.p.damping = Damping::viscous;
  m.p.viscous_tangential = 0.0;
  expect_error(m, {"viscous Bn = -1", ">= 0"});
  m.p.viscous_normal = 0.0;
  m.p.viscous_tangential = -2.0;
  expect_error(m, {"viscous Bt = -2", ">= 0"});
}

TEST(Validation, Rolling)
{
  Material m = good();
  m.p.mu_r = m.p.kr = m.p.rolling_viscous = -1.0;
  EXPECT_EQ(errors(m), "");    // not read without a rolling model
  m.p.rolling = RollingModel::constant;
  expect_error(m, {"mu_r = -1", ">= 0"});
  m.p.rolling = RollingModel::sds;
  m.p.mu_r = 0.0;
  m.p.rolling_viscous = 0.0;
  expect_error(m, {"sds kr = -1", ">= 0"});
  m.p.kr = 0.0;
  m.p.rolling_viscous = -0.5;
  expect_error(m, {"sds gr = -0.5", ">= 0"});
}

TEST(Validation, Exponent)
{
  Material m = good();
  m.p.kt_given = true;
  m.p.kt = 1.0;
  for (double n : {0.75, 2.25}) {
    m.law.exponent = n;
    expect_error(m, {n < 1.0 ? "exponent = 0.75" : "exponent = 2.25", "between 1 and 2"});
  }
}

TEST(Validation, PlateauHasNoExponent)
{
  Material m = good(Law::plateau);
  m.p.kt_given = true;
  m.law.exponent = 1.5;
  expect_error(m, {"exponent = 1.5", "plateau", "linear"});
}

TEST(Validation, ReferenceDiameter)
{
  Material m = good();
  m.law.reference_diameter = -1.0;
  EXPECT_EQ(errors(m), "");    // not read without scaling
  for (double d : {0.0, -0.5}) {
    scale_with_diameter(m, d);
    expect_error(m, {"d_ref = ", d == 0.0 ? "0" : "-0.5", "> 0"});
  }
}

// k2 < 2 k1: the loading condition never holds on a virgin contact
TEST(Validation, PlateauBelowTwiceK1PointsAtLinear)
{
  Material m = good(Law::plateau);
  m.p.k2 = 1999.5;
  expect_error(m, {"k2 = 1999.5", "plateau", ">= 2 k1 = 2000", "use linear"});
  m.law.law = Law::linear;
  EXPECT_EQ(errors(m), "");
}

// k2 > 2 k1: unloading starts late, at k1/(k2 - k1) of the largest overlap
TEST(Validation, PlateauAboveTwiceK1WarnsWithTheNumbers)
{
  Material m = good(Law::plateau);
  m.p.k2 = 5e3;
  EXPECT_EQ(errors(m), "");
  const Findings found = validate(m.p, m.law);
  ASSERT_EQ(found.warnings.size(), 1u);
  for (const char *word : {"plateau", "k2 = 5000", "2 k1 = 2000", "0.25"})
    EXPECT_NE(found.warnings[0].find(word), std::string::npos) << found.warnings[0];
  m.law.law = Law::linear;
  EXPECT_TRUE(validate(m.p, m.law).warnings.empty());
}

TEST(Validation, NotANumberAndInfinityAreNamed)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Field {
    const char *name;
    double Parameters::*member;
  };
  for (const Field &field :
       {Field{"k2 = ", &Parameters::k2}, Field{"k_adh = ", &Parameters::k_adh},
        Field{"f0 = ", &Parameters::f0}, Field{"mu = ", &Parameters::mu},
        Field{"kt = ", &Parameters::kt}, Field{"restitution = ", &Parameters::restitution},
        Field{"rolling mu_r = ", &Parameters::mu_r}, Field{"rolling sds kr = ", &Parameters::kr},
        Field{"rolling sds gr = ", &Parameters::rolling_viscous}}) {
    for (double value : {nan, infinity, -infinity}) {
      Material m = good();
      m.p.kt_given = true;
      m.p.kt = 100.0;
      m.p.rolling = RollingModel::sds;
      ASSERT_EQ(errors(m), "");
      m.p.*field.member = value;
      expect_error(m, {field.name, std::isnan(value) ? "nan" : "inf", "not a finite number"});
    }
  }
  for (double value : {nan, infinity}) {
    Material m = good();
    m.p.k1 = value;    // k2 >= k1 can not hold either
    EXPECT_NE(errors(m).find(std::isnan(value) ? "k1 = nan is not a finite number"
                                               : "k1 = inf is not a finite number"),
              std::string::npos);
    m = good();
    m.law.exponent = value;
    EXPECT_NE(errors(m).find("exponent = "), std::string::npos);
    EXPECT_NE(errors(m).find("not a finite number"), std::string::npos);
    m = good();
    scale_with_diameter(m, value);
    expect_error(m, {"scale d_ref = ", "not a finite number"});
    m = good();
    m.p.damping = Damping::viscous;
    m.p.viscous_normal = value;
    expect_error(m, {"viscous Bn = ", "not a finite number"});
    m.p.viscous_normal = 0.0;
    m.p.viscous_tangential = value;
    expect_error(m, {"viscous Bt = ", "not a finite number"});
  }
}

TEST(Validation, EveryFaultIsReportedAtOnce)
{
  Material m = good();
  m.p.k_adh = -1.0;
  m.p.f0 = 1.0;
  m.p.mu = -1.0;
  EXPECT_EQ(validate(m.p, m.law).errors.size(), 3u);
}
}    // namespace validation_test
