// SPDX-License-Identifier: GPL-2.0-only

// The lists and the table of coefficients in lammps_pkg/doc/pair_gran_eepa.rst are those of the table of
// parameters. They stand between `.. generated: NAME` and `.. generated: end`.
//
//   EEPA_WRITE_DOCUMENTATION=1 build/test_parser --gtest_filter='*Documentation*'   writes them

#include <eepa_commands/parameter_table.h>
#include <eepa_commands/words.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace {

using namespace eepa;

std::string emphasized(const std::string &word)
{
  return "*" + word + "*";
}

std::string emphasized(Words words)
{
  for (auto &word : words) word = emphasized(word);
  return joined(words, " or ");
}

std::string units(const Number &number)
{
  const std::string units = number.dimension.units;
  return "(" + units + (units == dimension::none.units ? ")" : " units)");
}

/// `constant mu_r`
std::string with_values(const std::string &word, const Alternative &alternative)
{
  std::string all = word;
  for (int k = 0; k < alternative.count(); k++)
    all += std::string(" ") + number_of(alternative.numbers[k]).name;
  return all;
}

std::string laws()
{
  Words names;
  for (const LawEntry &law : law_table) names.push_back(law.name);
  return "* law = " + emphasized(names) + "\n";
}

/* ---------------------------------------------------------------------- syntax */

const std::string indent = "     ";

std::string value_line(const Number &number)
{
  return indent + "    " + number.name + " = " + number.meaning + " " + units(number) + "\n";
}

std::string keyword_line(const std::string &keyword, int count, const std::string &values)
{
  return indent + "  " + emphasized(keyword) + (count == 1 ? " value = " : " values = ") + values +
      "\n";
}

std::string syntax()
{
  std::string list, lines;
  Words keywords;
  const auto add_values = [&lines](const Choice &choice, int first, int last) {
    for_each_number([&](const Number &number) {
      for (int k = first; k < last; k++)
        if (choice.alternatives[k].has(number.member)) {
          lines += value_line(number);
          return;
        }
    });
  };
  for (const Entry &entry : parameter_table) {
    if (const Number *number = std::get_if<Number>(&entry)) {
      if (is_positional(*number))
        list += std::string("* ") + number->name + " = " + number->meaning + " " + units(*number) +
            "\n";
      if (!number->keyword) continue;
      keywords.push_back(number->keyword);
      lines += keyword_line(number->keyword, 1, number->name) + value_line(*number);
    } else if (const Choice *choice = std::get_if<Choice>(&entry)) {
      Words words;
      for (int k = 0; k < choice->count; k++) {
        const Alternative &alternative = choice->alternatives[k];
        if (!alternative.word) continue;
        if (choice->keyword) {
          words.push_back(with_values(emphasized(alternative.word), alternative));
          continue;
        }
        keywords.push_back(alternative.word);
        lines += keyword_line(alternative.word, alternative.count(),
                              with_values("", alternative).substr(1));
        add_values(*choice, k, k + 1);
      }
      if (!choice->keyword) continue;
      keywords.push_back(choice->keyword);
      lines += keyword_line(choice->keyword, 1, joined(words, " or "));
      add_values(*choice, 0, choice->count);
    }
  }
  return list +
      "* zero or more keyword/value pairs of *pair_coeff* may be appended\n\n"
      "  .. parsed-literal::\n\n" +
      indent + "keyword = " + emphasized(keywords) + "\n" + lines;
}

/* ---------------------------------------------------------------------- table */

std::string text(double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string row(const Words &cells)
{
  return "   * - " + joined(cells, "\n     - ") + "\n";
}

std::string allowed(const Number &number)
{
  const Range &range = number.range;
  std::string words = range.words;
  words = words.substr(0, words.find(" ("));
  if (std::isfinite(range.low) && std::isfinite(range.high) && !range.low_is_excluded)
    words = text(range.low) + " to " + text(range.high);
  if (range.least)
    for (const LawEntry &law : law_table)
      if (law.least_ratio != 1.0 || law.least_is_excluded)
        words += "; " + emphasized(law.name) + (law.least_is_excluded ? ": > " : ": >= ") +
            (law.least_ratio != 1.0 ? text(law.least_ratio) + " " : "") +
            number_of(range.least).name;
  if (number.law) words += "; " + emphasized(entry_of(*number.law).name) + " only";
  return words;
}

std::string default_of(const Number &number)
{
  if (is_positional(number)) return "required";
  if (number.law) return "required with " + emphasized(entry_of(*number.law).name);
  if (number.otherwise_words) return number.otherwise_words;
  return is_read(number, Parameters()) ? text(Parameters().*number.member) : "--";
}

std::string scaling(const Dimension &dimension)
{
  const int constant = static_cast<int>(dimension.power(0.0));
  const int with_n = static_cast<int>(dimension.power(1.0)) - constant;
  if (with_n == 0 && constant == 0) return "--";
  if (with_n == 0)
    return constant == 1 ? ":math:`s`" : ":math:`s^" + std::to_string(constant) + "`";
  if (with_n != -1) throw std::logic_error("a power of s that has no words yet");
  return ":math:`s^{" + std::to_string(constant) + "-n}`";
}

std::string merging(const Choice &choice)
{
  const std::string same = "they must be the same";
  if (choice.merge != Merge::weaker) return same;
  const std::string first = emphasized(choice.alternatives[0].word) + " if either is";
  return choice.count == 2 ? first : first + "; else " + same;
}

std::string table()
{
  std::string all = ".. list-table::\n   :header-rows: 1\n\n" +
      row({"name", "units", "allowed", "default", "mixed", "scales with"});
  for (const Entry &entry : parameter_table) {
    if (const Number *number = std::get_if<Number>(&entry)) {
      all += row({number->name, number->dimension.units, allowed(*number), default_of(*number),
                  number->mean == Mean::harmonic ? "harmonic" : "geometric",
                  scaling(number->dimension)});
    } else if (const Choice *choice = std::get_if<Choice>(&entry)) {
      Words words;
      for (int k = 0; k < choice->count; k++)
        if (choice->alternatives[k].word) words.push_back(emphasized(choice->alternatives[k].word));
      if (words.size() == 1) continue;    // given or not
      all += row({choice->keyword ? choice->keyword : joined(words, ", "), "--", listed(words),
                  emphasized(choice->chosen(Parameters()).word), merging(*choice), "--"});
    }
  }
  return all;
}

/* ---------------------------------------------------------------------- file */

std::string file_name()
{
  const char *root = std::getenv("EEPA_SOURCE_DIR");
  return (root ? std::string(root) + "/" : "") + "lammps_pkg/doc/pair_gran_eepa.rst";
}

std::string read_file()
{
  std::ifstream file(file_name());
  if (!file) throw std::runtime_error("can not read " + file_name() + ": set EEPA_SOURCE_DIR");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Documentation : public testing::TestWithParam<std::pair<const char *, std::string (*)()>> {};

TEST_P(Documentation, HasWhatTheTableSays)
{
  std::string page = read_file();
  const std::string begin = std::string(".. generated: ") + GetParam().first + "\n\n";
  const std::string end = "\n.. generated: end\n";
  const std::size_t mark = page.find(begin);
  ASSERT_NE(mark, std::string::npos) << begin;
  const std::size_t from = mark + begin.size(), to = page.find(end, from);
  ASSERT_NE(to, std::string::npos) << end;
  const std::string wanted = GetParam().second();
  if (std::getenv("EEPA_WRITE_DOCUMENTATION"))
    std::ofstream(file_name()) << page.replace(from, to - from, wanted);
  else
    EXPECT_EQ(page.substr(from, to - from), wanted)
        << "EEPA_WRITE_DOCUMENTATION=1 writes it into the page";
}

INSTANTIATE_TEST_SUITE_P(Blocks, Documentation,
                         testing::Values(std::pair("laws", &laws), std::pair("syntax", &syntax),
                                         std::pair("coefficients", &table)));

}    // namespace
