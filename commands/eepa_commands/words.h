// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_WORDS_H
#define EEPA_COMMANDS_WORDS_H

#include <set>
#include <string>
#include <vector>

// Words of a command, and functions that read numbers and keywords from them.

namespace eepa {

using Words = std::vector<std::string>;

/// A number, or the variable that gives it.
struct Quantity {
  double value = 0.0;
  std::string variable;    ///< name without v_; empty where a number was given
};

/// \throw std::invalid_argument always
[[noreturn]] void refuse(const std::string &message);

/// Throws this package's message for a number that is not allowed.
/// \throw std::invalid_argument always
[[noreturn]] void refuse_value(const std::string &name, double value, const std::string &allowed);

/// Reads a finite number.
/// \throw std::invalid_argument naming `name` and the word
double parse_number(const std::string &name, const std::string &word);

/// Reads a finite number or v_name.
/// \throw std::invalid_argument naming `name` and the word
Quantity parse_quantity(const std::string &name, const std::string &word);

/// "a", "a or b", "a, b or c"
std::string listed(const Words &words, const std::string &conjunction = "or");

/// Joins words, with `between` between them.
std::string joined(const Words &words, const std::string &between = "; ");

bool contains(const Words &words, const std::string &word);

/// A number for messages, with 6 digits.
std::string brief(double value);

/// A number with digits enough to read the same bits back.
std::string exact(double value);

/// Walks over the words of one command and names what is missing. Every function that reads throws
/// std::invalid_argument.
class Reader {
 public:
  /// \param stop  a word that ends the command, or "" for the end of the words
  Reader(const Words &words, std::size_t first, std::string stop = "");

  bool done() const;
  /// Index of the next word.
  std::size_t position() const { return next_; }
  /// The next word, without reading it; there must be one.
  const std::string &peek() const { return words_[next_]; }

  /// Demands `count` more words.
  /// \param what  keyword and names of its values
  void require(std::size_t count, const std::string &what) const;
  const std::string &word(const std::string &name);
  /// Reads a keyword, each at most once.
  std::string keyword();
  double number(const std::string &name) { return parse_number(name, word(name)); }
  Quantity quantity(const std::string &name) { return parse_quantity(name, word(name)); }
  /// Reads x, y or z as 0, 1 or 2.
  int dimension(const std::string &name);

 private:
  const Words &words_;
  std::size_t next_;
  std::string stop_;
  std::set<std::string> seen_;
};

}    // namespace eepa

#endif
