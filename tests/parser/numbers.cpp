// SPDX-License-Identifier: GPL-2.0-only

// Words that the parser accepts as numbers.

#include <eepa_commands/commands.h>

#include <gtest/gtest.h>

#include <stdexcept>

using eepa::parse_number;

namespace {

class GoodNumber : public testing::TestWithParam<std::pair<const char *, double>> {};
TEST_P(GoodNumber, IsRead)
{
  EXPECT_EQ(parse_number("k1", GetParam().first), GetParam().second);
}
INSTANTIATE_TEST_SUITE_P(
    Words, GoodNumber,
    testing::Values(std::pair("1", 1.0), std::pair("-2.5", -2.5), std::pair("+3", 3.0),
                    std::pair("5e3", 5e3), std::pair("5E-3", 5e-3), std::pair(".5", 0.5),
                    std::pair("5.", 5.0), std::pair("1e+06", 1e6), std::pair("0", 0.0),
                    std::pair("4.9406564584124654e-324", 4.9406564584124654e-324)));

class BadNumber : public testing::TestWithParam<const char *> {};
TEST_P(BadNumber, IsRefusedByNameAndWord)
{
  try {
    parse_number("k_adh", GetParam());
    FAIL() << GetParam() << " was taken for a number";
  } catch (const std::invalid_argument &e) {
    EXPECT_EQ(std::string(e.what()),
              std::string("k_adh = ") + GetParam() + " is not a finite number");
  }
}
INSTANTIATE_TEST_SUITE_P(Words, BadNumber,
                         testing::Values("", " ", "nan", "NaN", "-nan", "inf", "-inf", "INF",
                                         "infinity", "0x10", "0X1p3", "1e", "1e+", "e5", ".", "+",
                                         "-", "--1", "1-", "1.2.3", "1,5", " 1", "1 ", "1e5e5",
                                         "1e999", "-1e999", "k1", "1d3", "1_000", "5e3N/m"));

}    // namespace
