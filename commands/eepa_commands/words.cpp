// SPDX-License-Identifier: GPL-2.0-only
#include "words.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace eepa {

void refuse(const std::string &message)
{
  throw std::invalid_argument(message);
}

void refuse_value(const std::string &name, double value, const std::string &allowed)
{
  refuse(name + " = " + brief(value) + " is not allowed: it must be " + allowed);
}

double parse_number(const std::string &name, const std::string &word)
{
  // strtod would take leading blanks, hexadecimals and the like
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isdigit(c) || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
  });
  char *end = nullptr;
  const double value = plain ? std::strtod(word.c_str(), &end) : 0.0;
  if (!plain || *end != '\0' || !std::isfinite(value))
    refuse(name + " = " + word + " is not a finite number");
  return value;
}

Quantity parse_quantity(const std::string &name, const std::string &word)
{
  Quantity quantity;
  if (word.compare(0, 2, "v_") != 0)
    quantity.value = parse_number(name, word);
  else if (word.size() > 2)
    quantity.variable = word.substr(2);
  else
    refuse(name + " = v_ names no variable");
  return quantity;
}

std::string listed(const Words &words, const std::string &conjunction)
{
  std::string all;
  for (std::size_t k = 0; k < words.size(); k++) {
    if (k > 0) all += k + 1 < words.size() ? ", " : " " + conjunction + " ";
    all += words[k];
  }
  return all;
}

std::string joined(const Words &words, const std::string &between)
{
  std::string all;
  for (const auto &word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

bool contains(const Words &words, const std::string &word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string brief(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

std::string exact(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

Reader::Reader(const Words &words, std::size_t first, std::string stop) :
    words_(words), next_(first), stop_(std::move(stop))
{
}

bool Reader::done() const
{
  return next_ >= words_.size() || (!stop_.empty() && words_[next_] == stop_);
}

void Reader::require(std::size_t count, const std::string &what) const
{
  if (next_ + count > words_.size()) refuse("missing value: " + what);
}

const std::string &Reader::word(const std::string &name)
{
  if (done()) refuse("missing value: " + name);
  return words_[next_++];
}

std::string Reader::keyword()
{
  const std::string &key = word("keyword");
  if (!seen_.insert(key).second) refuse("keyword " + key + " is given twice");
  return key;
}

int Reader::dimension(const std::string &name)
{
  const std::string &dim = word(name + " dimension");
  if (dim != "x" && dim != "y" && dim != "z")
    refuse(name + " dimension '" + dim + "' is not allowed: it must be x, y or z");
  return dim[0] - 'x';
}

}    // namespace eepa
