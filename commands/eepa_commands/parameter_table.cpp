// SPDX-License-Identifier: GPL-2.0-only
#include "parameter_table.h"

#include <stdexcept>

namespace eepa {

const Number &number_of(double Parameters::*member)
{
  for (const Entry &entry : parameter_table)
    if (const Number *number = std::get_if<Number>(&entry))
      if (number->member == member) return *number;
  throw std::logic_error("a choice names a number that the table of parameters lacks");
}

const Choice *choice_of(const Number &number)
{
  for (const Entry &entry : parameter_table)
    if (const Choice *choice = std::get_if<Choice>(&entry))
      for (int k = 0; k < choice->count; k++)
        if (choice->alternatives[k].has(number.member)) return choice;
  return nullptr;
}

bool is_read(const Number &number, const Parameters &p)
{
  const Choice *choice = choice_of(number);
  return !choice || choice->chosen(p).has(number.member);
}

double value_of(const Number &number, const Parameters &p)
{
  return number.otherwise && !is_read(number, p) ? number.otherwise(p) : p.*number.member;
}

std::string name_of(const Number &number)
{
  if (number.keyword) return number.keyword;
  const Choice *choice = choice_of(number);
  if (!choice) return number.name;
  const Alternative *only = nullptr;
  for (int k = 0; k < choice->count; k++) {
    if (!choice->alternatives[k].has(number.member)) continue;
    if (only) return std::string(choice->keyword) + " " + number.name;
    only = &choice->alternatives[k];
  }
  return name_of(number, *choice, *only);
}

std::string name_of(const Number &number, const Choice &choice, const Alternative &alternative)
{
  std::string name = alternative.word;
  if (choice.keyword)
    name = std::string(choice.keyword) + " " + name;
  else if (alternative.count() == 1)
    return name;
  return name + " " + number.name;
}

std::string name_of(const Choice &choice, const Alternative &alternative)
{
  return choice.keyword ? std::string(choice.keyword) + " " + alternative.word
                        : std::string(alternative.word) + " " + choice.name;
}

}    // namespace eepa
