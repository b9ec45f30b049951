// SPDX-License-Identifier: GPL-2.0-only
#include "stl_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace eepa {

namespace {

  // A binary file: a header of 80 bytes without meaning, the number of triangles, and for each one its
  // normal and three corners, 12 floats, and 2 bytes without meaning; all little-endian.
  constexpr std::size_t header_size = 80;
  constexpr std::size_t prologue_size = header_size + 4;
  constexpr std::size_t facet_size = 50;
  /// So that three times a triangle's number is an int.
  constexpr std::size_t most_triangles = 500'000'000;

  [[noreturn]] void refuse(const std::string &file, const std::string &message)
  {
    throw std::invalid_argument(file + ": " + message);
  }

  std::uint32_t read_unsigned(const char *bytes)
  {
    const auto *b = reinterpret_cast<const unsigned char *>(bytes);
    return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
  }

  float read_float(const char *bytes)
  {
    const std::uint32_t bits = read_unsigned(bytes);
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  void require_some(const StlTriangles &triangles)
  {
    if (triangles.corners.empty()) refuse(triangles.name, "holds no triangles");
  }

  StlTriangles parse_binary(const char *bytes, std::size_t count, const std::string &name)
  {
    StlTriangles found;
    found.name = name;
    found.binary = true;
    found.corners.resize(9 * count);
    found.normals.resize(3 * count);
    for (std::size_t t = 0; t < count; ++t) {
      const char *facet = bytes + prologue_size + facet_size * t;
      for (std::size_t i = 0; i < 12; ++i) {
        const char *place = facet + 4 * i;
        const float value = read_float(place);
        if (i < 3)
          // a normal that is not a number is one that the file does not give
          found.normals[3 * t + i] = std::isfinite(value) ? value : 0.0f;
        else if (std::isfinite(value))
          found.corners[9 * t + i - 3] = value;
        else
          refuse(name,
                 "triangle " + std::to_string(t + 1) + " (byte " + std::to_string(place - bytes) +
                     ") has a coordinate " + std::to_string(value) +
                     ": it must be a finite number");
      }
    }
    require_some(found);
    return found;
  }

  bool same_word(std::string_view word, std::string_view lower_case)
  {
    return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                      [](char a, char b) {
                        return std::tolower(static_cast<unsigned char>(a)) == b;
                      });
  }

  bool is_space(char c)
  {
    return c == ' ' || (c >= '\t' && c <= '\r');
  }

  /// Walks over the words of a text and counts its lines.
  class Text {
   public:
    Text(const char *begin, const char *end, const std::string &name) :
        next_(begin), end_(end), name_(name)
    {
    }

    /// The next word, empty at the end.
    std::string_view word()
    {
      while (next_ != end_ && is_space(*next_)) step();
      const char *begin = next_;
      while (next_ != end_ && !is_space(*next_)) ++next_;
      return {begin, static_cast<std::size_t>(next_ - begin)};
    }

    void skip_line()
    {
      while (next_ != end_ && *next_ != '\n' && *next_ != '\r') ++next_;
    }

    void expect(std::string_view wanted)
    {
      const std::string_view found = word();
      if (!same_word(found, wanted)) refuse_word(found, "'" + std::string(wanted) + "'");
    }

    double coordinate()
    {
      const std::string_view found = word();
      double value = 0.0;
      if (!read_number(found, value) || !std::isfinite(value))
        refuse_word(found, "a finite number as a coordinate");
      return value;
    }

    /// A component of a normal, of which some programs write that it is not a number.
    float component()
    {
      double value = 0.0;
      if (!read_number(word(), value) || !(std::fabs(value) <= 1e30)) return 0.0f;
      return static_cast<float>(value);
    }

    [[noreturn]] void refuse_word(std::string_view found, const std::string &allowed) const
    {
      constexpr std::size_t shown = 40;
      std::string text = "the end of the file";
      if (!found.empty()) {
        text = "'";
        for (const char c : found.substr(0, shown)) text += c > ' ' && c <= '~' ? c : '?';
        text += found.size() > shown ? "...'" : "'";
      }
      refuse(name_,
             "line " + std::to_string(line_) + " has " + text + " where " + allowed +
                 " is expected" + (found.empty() ? ": the file is truncated" : ""));
    }

   private:
    /// Over one white space; a carriage return and line feed together end one line.
    void step()
    {
      if (*next_ == '\n' || (*next_ == '\r' && (next_ + 1 == end_ || next_[1] != '\n'))) ++line_;
      ++next_;
    }

    static bool read_number(std::string_view word, double &value)
    {
      const char *begin = word.data(), *end = begin + word.size();
      if (begin != end && *begin == '+') {
        ++begin;
        if (begin != end && *begin == '-') return false;
      }
      const auto [stop, error] = std::from_chars(begin, end, value);
      if (stop != end || begin == end) return false;
      if (error == std::errc::result_out_of_range) {
        // too small for a double, or too large
        value = 0.0;
        const std::size_t power = word.find_first_of("eE");
        return power != word.npos && word.substr(power + 1, 1) == "-";
      }
      return error == std::errc();
    }

    const char *next_, *end_;
    const std::string &name_;
    long line_ = 1;
  };

  /// A facet, of which the first word has been read.
  void parse_facet(Text &text, StlTriangles &found)
  {
    text.expect("normal");
    for (int i = 0; i < 3; ++i) found.normals.push_back(text.component());
    text.expect("outer");
    text.expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      const std::string_view word = text.word();
      if (!same_word(word, "vertex"))
        text.refuse_word(word,
                         "vertex " + std::to_string(corner + 1) + " of the 3 of triangle " +
                             std::to_string(found.count() + 1));
      for (int i = 0; i < 3; ++i) found.corners.push_back(text.coordinate());
    }
    const std::string_view word = text.word();
    if (!same_word(word, "endloop"))
      text.refuse_word(
          word, "'endloop' after the 3 vertices of triangle " + std::to_string(found.count()));
    text.expect("endfacet");
  }

  StlTriangles parse_text(const char *bytes, std::size_t size, const std::string &name)
  {
    StlTriangles found;
    found.name = name;
    // what a triangle takes at least, so that memory is asked for once
    constexpr std::size_t least_size = 100;
    found.corners.reserve(9 * (size / least_size + 1));
    found.normals.reserve(3 * (size / least_size + 1));
    Text text(bytes, bytes + size, name);
    for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
      if (!same_word(word, "solid")) text.refuse_word(word, "'solid' or the end of the file");
      text.skip_line();
      for (word = text.word(); !same_word(word, "endsolid"); word = text.word()) {
        if (!same_word(word, "facet")) text.refuse_word(word, "'facet' or 'endsolid'");
        if (static_cast<std::size_t>(found.count()) == most_triangles)
          refuse(name, "holds more than " + std::to_string(most_triangles) + " triangles");
        parse_facet(text, found);
      }
      text.skip_line();
    }
    require_some(found);
    return found;
  }

  /// Whether a file of which the size is not that of a binary one may be text.
  bool looks_like_text(const char *bytes, std::size_t size)
  {
    const char *end = bytes + size;
    const char *begin = std::find_if_not(bytes, end, is_space);
    constexpr std::string_view first = "solid";
    if (static_cast<std::size_t>(end - begin) < first.size()) return false;
    if (!same_word({begin, first.size()}, first)) return false;
    // a header that is filled up with zeros, or the high byte of the number of triangles
    return std::find(bytes, bytes + std::min(size, prologue_size), '\0') ==
        bytes + std::min(size, prologue_size);
  }

}    // namespace

std::vector<char> read_bytes(const std::string &file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, "the file can not be opened");
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    refuse(file, "the file can not be read: it is a folder or a device");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) refuse(file, "the file can not be read: " + error.message());
  std::vector<char> bytes(size);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size)))
    refuse(file, "the file can not be read to its end");
  return bytes;
}

StlTriangles parse_stl(const char *bytes, std::size_t size, const std::string &name)
{
  const bool has_count = size >= prologue_size;
  const std::size_t count = has_count ? read_unsigned(bytes + header_size) : 0;
  if (has_count && size == prologue_size + facet_size * count) {
    if (count > most_triangles)
      refuse(name,
             "holds " + std::to_string(count) + " triangles: there can be " +
                 std::to_string(most_triangles) + " at most");
    return parse_binary(bytes, count, name);
  }
  if (looks_like_text(bytes, size)) return parse_text(bytes, size, name);
  if (!has_count)
    refuse(name,
           "has " + std::to_string(size) +
               " bytes and does not begin with 'solid': an STL file is text that does, or has at "
               "least " +
               std::to_string(prologue_size) + " bytes");
  refuse(name,
         "has " + std::to_string(size) + " bytes where a binary STL file of " +
             std::to_string(count) + " triangles, as it gives at byte " +
             std::to_string(header_size) + ", has " +
             std::to_string(prologue_size + facet_size * count) +
             ": the file is truncated, or not an STL file");
}

StlTriangles read_stl(const std::string &file)
{
  const std::vector<char> bytes = read_bytes(file);
  return parse_stl(bytes.data(), bytes.size(), file);
}

}    // namespace eepa
