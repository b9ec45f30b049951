// SPDX-License-Identifier: GPL-2.0-only
// Reading of STL files: both kinds, and each error by its name.

#include "support.h"

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace stl_file_test {
using namespace eepa_walls_test;

StlTriangles parse(const std::string &bytes)
{
  // in memory of exactly this size, so that a sanitizer sees what is read beyond
  const std::vector<char> copy(bytes.begin(), bytes.end());
  return parse_stl(copy.data(), copy.size(), "file.stl");
}

void expect_error(const std::string &bytes, const std::vector<std::string> &parts)
{
  try {
    parse(bytes);
    FAIL() << "no error with " << parts[0];
  } catch (const std::invalid_argument &error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("file.stl: "), 0u) << message;
    for (const std::string &part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << message << "\nhas no: " << part;
  }
}

const std::string facet = "facet normal 0 0 1\n outer loop\n"
                          "  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n"
                          " endloop\nendfacet\n";

std::string replaced(std::string text, const std::string &what, const std::string &with)
{
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

std::string solid(const std::string &facets)
{
  return "solid name\n" + facets + "endsolid name\n";
}

/// 12 numbers a triangle.
std::string binary(const std::vector<float> &numbers, const std::string &header = "")
{
  const std::uint32_t count = static_cast<std::uint32_t>(numbers.size() / 12);
  std::string bytes(84, ' ');
  bytes.replace(0, header.size(), header);
  std::memcpy(&bytes[80], &count, 4);
  for (std::size_t t = 0; t < count; ++t) {
    bytes.append(reinterpret_cast<const char *>(&numbers[12 * t]), 48);
    bytes.append("\x12\x34", 2);
  }
  return bytes;
}

std::vector<float> some_numbers(int triangles)
{
  Random random(1);
  std::vector<float> numbers;
  for (int i = 0; i < 12 * triangles; ++i)
    numbers.push_back(
        static_cast<float>(random.between(-1, 1) * std::pow(10, random.below(20) - 9)));
  return numbers;
}

std::string text_of_numbers(const std::vector<float> &numbers)
{
  std::string text = "solid of numbers\n";
  char line[200];
  for (std::size_t i = 0; i < numbers.size(); i += 12) {
    const float *x = &numbers[i];
    std::snprintf(line, sizeof line, "  facet normal %.9g %.9g %.9g\n    outer loop\n", x[0], x[1],
                  x[2]);
    text += line;
    for (int k = 3; k < 12; k += 3) {
      std::snprintf(line, sizeof line, "      vertex %.9e %.9E %.9g\n", x[k], x[k + 1], x[k + 2]);
      text += line;
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid of numbers\n";
}

void expect_numbers(const StlTriangles &s, const std::vector<float> &numbers)
{
  ASSERT_EQ(s.count(), static_cast<int>(numbers.size() / 12));
  for (int t = 0; t < s.count(); ++t)
    for (int i = 0; i < 12; ++i) {
      const float expected = numbers[12 * t + i];
      const double read = i < 3 ? s.normals[3 * t + i] : s.corners[9 * t + i - 3];
      ASSERT_EQ(static_cast<float>(read), expected);
    }
}

TEST(StlFile, ReadsTextAndBinary)
{
  const std::vector<float> numbers = some_numbers(100);
  const StlTriangles text = parse(text_of_numbers(numbers));
  EXPECT_FALSE(text.binary);
  expect_numbers(text, numbers);
  const StlTriangles bytes = parse(binary(numbers));
  EXPECT_TRUE(bytes.binary);
  expect_numbers(bytes, numbers);
  EXPECT_EQ(bytes.name, "file.stl");
}

TEST(StlFile, OfTextKeepsDoublePrecision)
{
  const double x = parse(solid(replaced(facet, "1 0 0", "0.12345678901234567 0 0"))).corners[3];
  EXPECT_EQ(x, 0.12345678901234567);
}

TEST(StlFile, ThatIsBinaryMayBeginWithSolid)
{
  const std::vector<float> numbers = some_numbers(7);
  for (const std::string header :
       {"solid", "solid name\n", "SOLID facet normal 0 0 1 outer loop"}) {
    const StlTriangles s = parse(binary(numbers, header));
    EXPECT_TRUE(s.binary);
    expect_numbers(s, numbers);
  }
}

TEST(StlFile, OfTextMayLookDifferent)
{
  const std::string plain = solid(facet + facet);
  std::string crlf, cr, upper, spaced;
  for (const char c : plain) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
    upper += static_cast<char>(std::toupper(c));
    spaced += c == ' ' ? "\t \v" : std::string(1, c);
  }
  const std::string no_name = "solid\n" + facet + facet + "endsolid";
  const std::string two =
      solid(facet) + "\n" + "solid facet normal\n" + facet + "endsolid other one";
  for (const std::string &text : {plain, crlf, cr, upper, spaced, no_name, two, "\n \n" + plain}) {
    const StlTriangles s = parse(text);
    ASSERT_EQ(s.count(), 2) << text;
    EXPECT_FALSE(s.binary);
    EXPECT_EQ(s.corners,
              (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}));
    EXPECT_EQ(s.normals, (std::vector<float>{0, 0, 1, 0, 0, 1}));
  }
}

TEST(StlFile, OfTextHasNumbersOfAnyKind)
{
  const auto read = [](const std::string &number) {
    return parse(solid(replaced(facet, "1 0 0", number + " 0 0"))).corners[3];
  };
  EXPECT_EQ(read("+1.5"), 1.5);
  EXPECT_EQ(read("-.5"), -0.5);
  EXPECT_EQ(read("5."), 5.0);
  EXPECT_EQ(read("1E+02"), 100.0);
  EXPECT_EQ(read("+1.25e-2"), 0.0125);
  EXPECT_EQ(read("1e-999"), 0.0);
}

TEST(StlFile, IsReadAlikeInEveryLocale)
{
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char *locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
    if (std::setlocale(LC_ALL, locale)) break;
  EXPECT_EQ(parse(solid(replaced(facet, "1 0 0", "1.5 0 0"))).corners[3], 1.5);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(StlFile, NeedsNoNormals)
{
  const StlTriangles s = parse(solid(replaced(facet, "normal 0 0 1", "normal nan -1.#IND 1e99")));
  EXPECT_EQ(s.normals, (std::vector<float>{0, 0, 0}));
  std::vector<float> numbers = some_numbers(1);
  numbers[1] = std::nanf("");
  EXPECT_EQ(parse(binary(numbers)).normals[1], 0.0f);
}

TEST(StlFile, IsReadFromTheDisk)
{
  const std::string name = ::testing::TempDir() + "eepa_stl_file_test.stl";
  std::ofstream(name, std::ios::binary) << binary(some_numbers(3));
  EXPECT_EQ(read_stl(name).count(), 3);
  EXPECT_EQ(read_stl(name).name, name);
  std::ofstream(name, std::ios::binary) << "";
  EXPECT_TRUE(read_bytes(name).empty());
  EXPECT_THROW(read_stl(name), std::invalid_argument);
  std::remove(name.c_str());
  for (const std::string &other : {name, ::testing::TempDir()}) {
    try {
      read_stl(other);
      FAIL();
    } catch (const std::invalid_argument &error) {
      EXPECT_EQ(std::string(error.what()).find(other + ": the file can not be "), 0u)
          << error.what();
    }
  }
}

TEST(StlError, OfAFileThatIsNoStlFile)
{
  expect_error("", {"has 0 bytes", "does not begin with 'solid'"});
  expect_error("PK\x03\x04", {"has 4 bytes", "at least 84 bytes"});
  expect_error(std::string(200, 'x'),
               {"has 200 bytes", "binary STL file of 2021161080 triangles", "at byte 80",
                "not an STL file"});
}

TEST(StlError, OfABinaryFile)
{
  const std::string whole = binary(some_numbers(3), "solid");
  expect_error(whole.substr(0, whole.size() - 1),
               {"has 233 bytes where a binary STL file of 3 triangles", "has 234", "truncated"});
  expect_error(whole + "x", {"has 235 bytes where a binary STL file of 3 triangles"});
  expect_error(whole.substr(0, 83), {"has 83 bytes"});
  expect_error(binary({}), {"holds no triangles"});
  std::vector<float> numbers = some_numbers(3);
  numbers[12 + 7] = std::numeric_limits<float>::infinity();
  expect_error(binary(numbers), {"triangle 2 (byte 162)", "coordinate inf", "finite number"});
  numbers[12 + 7] = std::nanf("");
  expect_error(binary(numbers), {"triangle 2 (byte 162)", "nan"});
}

TEST(StlError, OfTextThatIsTruncated)
{
  const std::string whole = solid(facet);
  // wherever it ends before endsolid
  const std::size_t end = whole.find("endsolid") + 8;
  for (std::size_t size = 5; size < end; ++size) {
    try {
      parse(whole.substr(0, size));
      FAIL() << size;
    } catch (const std::invalid_argument &error) {
      EXPECT_NE(std::string(error.what()).find("line "), std::string::npos) << error.what();
    }
  }
  expect_error(whole.substr(0, whole.find("vertex 0 1 0")),
               {"line 6 has the end of the file", "vertex 3 of the 3 of triangle 1", "truncated"});
  expect_error("solid x\n" + facet, {"line 9 has the end of the file", "'facet' or 'endsolid'"});
}

TEST(StlError, OfTextThatIsNotAsExpected)
{
  const auto broken = [](const std::string &what, const std::string &with) {
    return solid(facet + replaced(facet, what, with));
  };
  expect_error(solid(""), {"holds no triangles"});
  expect_error("solids\n",
               {"line 1 has 'solids' where 'solid' or the end of the file is expected"});
  expect_error(solid(facet) + "x", {"line 10 has 'x' where 'solid' or the end of the file"});
  expect_error(broken("facet", "face"), {"line 9 has 'face' where 'facet' or 'endsolid'"});
  expect_error(broken("normal", "n"), {"line 9 has 'n' where 'normal' is expected"});
  expect_error(broken("outer", "inner"), {"line 10 has 'inner' where 'outer' is expected"});
  expect_error(broken("loop", "vertex"), {"line 10 has 'vertex' where 'loop' is expected"});
  expect_error(broken("  vertex 0 1 0\n", ""),
               {"line 13 has 'endloop' where vertex 3 of the 3 of triangle 2 is expected"});
  expect_error(broken("  vertex 0 1 0\n", "  vertex 0 1 0\n  vertex 1 1 0\n"),
               {"line 14 has 'vertex' where 'endloop' after the 3 vertices of triangle 2"});
  expect_error(broken("endfacet", "endloop"), {"line 15 has 'endloop' where 'endfacet'"});
  for (const std::string number : {"1,5", "nan", "inf", "-inf", "1e999", "-1e999", "0x10", "+-1",
                                   "1.5f", "--", "+", "one", "1e", "1e+"})
    expect_error(broken("1 0 0", number + " 0 0"),
                 {"line 12 has '" + number + "' where a finite number as a coordinate"});
  expect_error(broken("1 0 0", "1 0"), {"line 13 has 'vertex' where a finite number"});
  expect_error(broken("1 0 0", "1 0 0 0"), {"line 12 has '0' where vertex 3"});
  expect_error(broken("normal 0 0 1", "normal 0 0"), {"line 10 has 'loop' where 'outer'"});
  // what is shown of the file is short, and can be shown
  expect_error(broken("outer", "\x01\xff" + std::string(100, 'y')),
               {"line 10 has '??" + std::string(38, 'y') + "...'"});
}

TEST(StlError, CountsLinesOfAnyKind)
{
  expect_error("solid x\r\nfacet normal 0 0 1\r\nx", {"line 3 has 'x'"});
  expect_error("solid x\rfacet normal 0 0 1\rx", {"line 3 has 'x'"});
  expect_error("solid x\n\r\nfacet normal 0 0 1\n\n\nx", {"line 6 has 'x'"});
}

}    // namespace stl_file_test
