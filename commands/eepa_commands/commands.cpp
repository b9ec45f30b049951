// SPDX-License-Identifier: GPL-2.0-only
#include "commands.h"

#include "parameter_table.h"
#include "validation.h"

#include <algorithm>

namespace eepa {

namespace {

  Law parse_law(const std::string &word)
  {
    for (int k = 0; k < law_count; k++)
      if (word == law_table[k].name) return static_cast<Law>(k);
    refuse("law '" + word + "' is unknown: it must be " + law_names());
  }

  bool parse_switch(const std::string &name, const std::string &word)
  {
    if (word == "yes" || word == "on" || word == "true") return true;
    if (word == "no" || word == "off" || word == "false") return false;
    refuse(name + " '" + word + "' is not allowed: it must be yes or no");
  }

  TimeStepCheck parse_check(const std::string &word)
  {
    if (word == "warn") return TimeStepCheck::warn;
    if (word == "error") return TimeStepCheck::error;
    if (word == "off") return TimeStepCheck::off;
    refuse("dtcheck '" + word + "' is not allowed: it must be warn, error or off");
  }

  /// Reads the options of one pair of types into `parameters`.
  class OptionReader {
   public:
    OptionReader(Reader &reader, Law law, Parameters &parameters) :
        reader_(reader), law_(law), parameters_(parameters)
    {
    }

    void read(const std::string &key)
    {
      for (const Entry &entry : parameter_table) {
        const Number *number = std::get_if<Number>(&entry);
        const Choice *choice = std::get_if<Choice>(&entry);
        if (number ? read_number(*number, key) : read_choice(*choice, key)) return;
      }
      refuse("keyword '" + key + "' is unknown: it must be " + listed(keywords()));
    }

   private:
    Reader &reader_;
    const Law law_;
    Parameters &parameters_;
    std::vector<const Choice *> chosen_;

    bool read_number(const Number &number, const std::string &key)
    {
      if (!number.keyword || key != number.keyword) return false;
      if (number.law && *number.law != law_)
        refuse("keyword " + key + " is not allowed with " + entry_of(law_).name + ": only " +
               entry_of(*number.law).name + " has it");
      parameters_.*number.member = reader_.number(name_of(number));
      return true;
    }

    bool read_choice(const Choice &choice, const std::string &key)
    {
      if (choice.keyword && key != choice.keyword) return false;
      const std::string &word = choice.keyword ? reader_.word(choice.name) : key;
      for (int k = 0; k < choice.count; k++) {
        const Alternative &alternative = choice.alternatives[k];
        if (!alternative.word || word != alternative.word) continue;
        if (contains_choice(choice))
          refuse(listed(words_of(choice), "and") + " exclude each other");
        chosen_.push_back(&choice);
        choice.set(parameters_, k);
        for (int n = 0; n < alternative.count(); n++) {
          const Number &number = number_of(alternative.numbers[n]);
          parameters_.*number.member = reader_.number(name_of(number, choice, alternative));
        }
        return true;
      }
      if (choice.keyword)
        refuse(std::string(choice.name) + " '" + word + "' is unknown: it must be " +
               listed(words_of(choice)));
      return false;
    }

    bool contains_choice(const Choice &choice) const
    {
      return std::find(chosen_.begin(), chosen_.end(), &choice) != chosen_.end();
    }

    static Words words_of(const Choice &choice)
    {
      Words words;
      for (int k = 0; k < choice.count; k++)
        if (choice.alternatives[k].word) words.push_back(choice.alternatives[k].word);
      return words;
    }

    /// The keywords that the law has.
    Words keywords() const
    {
      Words all;
      for (const Entry &entry : parameter_table) {
        if (const Number *number = std::get_if<Number>(&entry)) {
          if (number->keyword && (!number->law || *number->law == law_))
            all.push_back(number->keyword);
        } else if (const Choice *choice = std::get_if<Choice>(&entry)) {
          const Words words = choice->keyword ? Words{choice->keyword} : words_of(*choice);
          all.insert(all.end(), words.begin(), words.end());
        }
      }
      return all;
    }
  };

}    // namespace

std::string law_names()
{
  Words names;
  for (const LawEntry &law : law_table) names.push_back(law.name);
  return listed(names);
}

std::size_t parse_style(const Words &words, std::size_t first, const std::string &stop,
                        StyleArguments &style)
{
  Reader reader(words, first, stop);
  style = StyleArguments();
  LawSettings &settings = style.settings;
  settings.law = parse_law(reader.word("law (" + law_names() + ")"));
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "scale") {
      settings.scaled = true;
      settings.reference_diameter = reader.number("scale d_ref");
    } else if (key == "exponent") {
      settings.exponent = reader.number("exponent");
    } else if (key == "limit_damping") {
      settings.limit_damping = parse_switch(key, reader.word(key));
    } else if (key == "dtcheck") {
      style.time_step_check = parse_check(reader.word(key));
    } else if (key == "largest") {
      style.largest_diameter = reader.number("largest d");
      if (style.largest_diameter <= 0.0) refuse_value("largest d", style.largest_diameter, "> 0");
    } else {
      refuse("keyword '" + key +
             "' is unknown: it must be scale, exponent, limit_damping, dtcheck or largest");
    }
  }
  const Findings found = validate(settings);
  if (!found.errors.empty()) refuse(joined(found.errors));
  return reader.position();
}

std::size_t parse_parameters(const Words &words, std::size_t first, const std::string &stop,
                             const LawSettings &settings, Parameters &parameters, Words &warnings)
{
  Reader reader(words, first, stop);
  Parameters p;
  for_each_number([&](const Number &number) {
    if (is_positional(number)) p.*number.member = reader.number(number.name);
  });
  OptionReader options(reader, settings.law, p);
  while (!reader.done()) options.read(reader.keyword());
  require_valid(p, settings, warnings);
  parameters = p;
  return reader.position();
}

void require_valid(const Parameters &parameters, const LawSettings &settings, Words &warnings)
{
  const Findings found = validate(parameters, settings);
  if (!found.errors.empty()) refuse(joined(found.errors));
  warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
}

std::string to_words(const Parameters &p)
{
  const Parameters defaults;
  Words words;
  for_each_number([&](const Number &number) {
    if (is_positional(number)) words.push_back(exact(p.*number.member));
  });
  for (const Entry &entry : parameter_table) {
    if (const Number *number = std::get_if<Number>(&entry)) {
      if (number->keyword && p.*number->member != defaults.*number->member)
        words.insert(words.end(), {number->keyword, exact(p.*number->member)});
    } else if (const Choice *choice = std::get_if<Choice>(&entry)) {
      const Alternative &chosen = choice->chosen(p);
      if (chosen.count() == 0 && choice->get(p) == choice->get(defaults)) continue;
      if (choice->keyword) words.push_back(choice->keyword);
      words.push_back(chosen.word);
      for (int k = 0; k < chosen.count(); k++) words.push_back(exact(p.*chosen.numbers[k]));
    }
  }
  return joined(words, " ");
}

}    // namespace eepa
