// SPDX-License-Identifier: GPL-2.0-only
#include "commands.h"

#include "validation.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <stdexcept>

namespace eepa {

namespace {

  constexpr double restart_format = 2.0;

  [[noreturn]] void refuse(const std::string &message)
  {
    throw std::invalid_argument(message);
  }

  std::string joined(const Words &words)
  {
    std::string all;
    for (const auto &word : words) all += (all.empty() ? "" : "; ") + word;
    return all;
  }

  /// Walks over the words of one command and names what is missing.
  class Reader {
   public:
    Reader(const Words &words, std::size_t first, std::string stop) :
        words_(words), next_(first), stop_(std::move(stop))
    {
    }

    bool done() const
    {
      return next_ >= words_.size() || (!stop_.empty() && words_[next_] == stop_);
    }
    std::size_t position() const { return next_; }

    const std::string &word(const std::string &name)
    {
      if (done()) refuse("missing value: " + name);
      return words_[next_++];
    }
    double number(const std::string &name) { return parse_number(name, word(name)); }
    /// The next word, not read.
    const std::string &peek() const { return words_[next_]; }

    /// A keyword, each at most once.
    std::string keyword()
    {
      const std::string &key = word("keyword");
      if (!seen_.insert(key).second) refuse("keyword " + key + " is given twice");
      return key;
    }

   private:
    const Words &words_;
    std::size_t next_;
    std::string stop_;
    std::set<std::string> seen_;
  };

  Law parse_law(const std::string &word)
  {
    if (word == "plateau") return Law::plateau;
    if (word == "linear") return Law::linear;
    refuse("law '" + word + "' is unknown: it must be plateau or linear");
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

  void parse_rolling(Reader &reader, Parameters &p)
  {
    const std::string &model = reader.word("rolling model");
    if (model == "none") {
      p.rolling = RollingModel::none;
    } else if (model == "constant") {
      p.rolling = RollingModel::constant;
      p.mu_r = reader.number("rolling constant mu_r");
    } else if (model == "sds") {
      p.rolling = RollingModel::sds;
      p.kr = reader.number("rolling sds kr");
      p.rolling_viscous = reader.number("rolling sds gr");
      p.mu_r = reader.number("rolling sds mu_r");
    } else {
      refuse("rolling model '" + model + "' is unknown: it must be none, constant or sds");
    }
  }

  TwistingModel parse_twisting(const std::string &word)
  {
    if (word == "none") return TwistingModel::none;
    if (word == "marshall") return TwistingModel::marshall;
    refuse("twisting model '" + word + "' is unknown: it must be none or marshall");
  }

  Quantity parse_quantity(Reader &reader, const std::string &name)
  {
    return eepa::parse_quantity(name, reader.word(name));
  }

  /// A limit of travel; NULL leaves `open` as it is.
  double parse_limit(Reader &reader, const std::string &name, double open)
  {
    const std::string &word = reader.word(name);
    return word == "NULL" ? open : parse_number(name, word);
  }

  std::string brief(double value)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%g", value);
    return text;
  }

  /// An enumerator that a restart file stored; a cast of any other number is undefined.
  template <class Enum> Enum enumerator(double stored, Enum last, const char *what)
  {
    for (int k = 0; k <= static_cast<int>(last); k++)
      if (stored == k) return static_cast<Enum>(k);
    refuse(std::string("the restart file is damaged: ") + what + " " + std::to_string(stored) +
           " is unknown");
  }

  std::string exact(double value)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.17g", value);
    return text;
  }

}    // namespace

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

std::size_t parse_style(const Words &words, std::size_t first, const std::string &stop,
                        StyleArguments &style)
{
  Reader reader(words, first, stop);
  style = StyleArguments();
  LawSettings &settings = style.settings;
  settings.law = parse_law(reader.word("law (plateau or linear)"));
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
  p.k1 = reader.number("k1");
  p.k2 = reader.number("k2");
  p.k_adh = reader.number("k_adh");
  p.f0 = reader.number("f0");
  p.mu = reader.number("mu");
  bool damped = false;
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "kt") {
      p.kt_given = true;
      p.kt = reader.number("kt");
    } else if (key == "restitution" || key == "viscous") {
      if (damped) refuse("restitution and viscous exclude each other");
      damped = true;
      if (key == "restitution") {
        p.restitution = reader.number("restitution");
      } else {
        p.damping = Damping::viscous;
        p.viscous_normal = reader.number("viscous Bn");
        p.viscous_tangential = reader.number("viscous Bt");
      }
    } else if (key == "rolling") {
      parse_rolling(reader, p);
    } else if (key == "twisting") {
      p.twisting = parse_twisting(reader.word("twisting model"));
    } else {
      refuse("keyword '" + key +
             "' is unknown: it must be kt, restitution, viscous, rolling or twisting");
    }
  }
  require_valid(p, settings, warnings);
  parameters = p;
  return reader.position();
}

std::size_t parse_load(const Words &words, std::size_t first, const Words &others,
                       LoadArguments &load)
{
  Reader reader(words, first, "");
  load = LoadArguments();
  load.by_pressure = !reader.done() && reader.peek() == "pressure";
  if (load.by_pressure) {
    reader.keyword();
    load.pressure = parse_quantity(reader, "load pressure");
  } else {
    load.force = parse_quantity(reader, "load force");
  }
  bool has_mass = false, has_area = false;
  while (!reader.done() && std::find(others.begin(), others.end(), reader.peek()) == others.end()) {
    const std::string key = reader.keyword();
    if (key == "mass") {
      has_mass = true;
      load.mass = reader.number("load mass");
      if (load.mass <= 0.0) refuse_value("load mass", load.mass, "> 0");
    } else if (key == "area") {
      has_area = true;
      load.area = parse_quantity(reader, "load area");
      if (load.area.variable.empty() && load.area.value <= 0.0)
        refuse_value("load area", load.area.value, "> 0");
    } else if (key == "damping") {
      load.damping = reader.number("load damping");
      if (load.damping < 0.0) refuse_value("load damping", load.damping, ">= 0");
    } else if (key == "limits") {
      load.lowest = parse_limit(reader, "load limits lo", load.lowest);
      load.highest = parse_limit(reader, "load limits hi", load.highest);
      if (load.lowest > load.highest)
        refuse_value("load limits lo", load.lowest, "<= hi = " + brief(load.highest));
    } else {
      refuse("load keyword '" + key + "' is unknown: it must be mass, area, damping or limits");
    }
  }
  if (!has_mass) refuse("load: missing keyword mass");
  if (load.by_pressure && !has_area) refuse("load pressure: missing keyword area");
  if (!load.by_pressure && has_area) refuse("load area is allowed with load pressure only");
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
  std::string words = exact(p.k1) + " " + exact(p.k2) + " " + exact(p.k_adh) + " " + exact(p.f0) +
      " " + exact(p.mu);
  if (p.kt_given) words += " kt " + exact(p.kt);
  if (p.damping == Damping::restitution)
    words += " restitution " + exact(p.restitution);
  else
    words += " viscous " + exact(p.viscous_normal) + " " + exact(p.viscous_tangential);
  if (p.rolling == RollingModel::constant) words += " rolling constant " + exact(p.mu_r);
  if (p.rolling == RollingModel::sds)
    words += " rolling sds " + exact(p.kr) + " " + exact(p.rolling_viscous) + " " + exact(p.mu_r);
  if (p.twisting == TwistingModel::marshall) words += " twisting marshall";
  return words;
}

std::array<double, packed_style_size> pack(const StyleArguments &style)
{
  const LawSettings &s = style.settings;
  return {restart_format,
          static_cast<double>(s.law),
          s.exponent,
          static_cast<double>(s.scaled),
          s.reference_diameter,
          static_cast<double>(s.limit_damping),
          static_cast<double>(style.time_step_check),
          style.largest_diameter};
}

StyleArguments unpack_style(const std::array<double, packed_style_size> &n)
{
  if (n[0] != restart_format)
    refuse("the restart file has format " + exact(n[0]) + " of gran/eepa, this version reads " +
           exact(restart_format));
  StyleArguments style;
  style.settings.law = enumerator(n[1], Law::linear, "law");
  style.settings.exponent = n[2];
  style.settings.scaled = n[3] != 0.0;
  style.settings.reference_diameter = n[4];
  style.settings.limit_damping = n[5] != 0.0;
  style.time_step_check = enumerator(n[6], TimeStepCheck::error, "dtcheck");
  style.largest_diameter = n[7];
  Findings found = validate(style.settings);
  if (!(n[7] >= 0.0 && std::isfinite(n[7]))) found.errors.push_back("largest d = " + exact(n[7]));
  if (!found.errors.empty()) refuse("the restart file is damaged: " + joined(found.errors));
  return style;
}

std::array<double, packed_parameters_size> pack(const Parameters &p)
{
  return {p.k1,
          p.k2,
          p.k_adh,
          p.f0,
          p.mu,
          static_cast<double>(p.kt_given),
          p.kt,
          static_cast<double>(p.damping),
          p.restitution,
          p.viscous_normal,
          p.viscous_tangential,
          static_cast<double>(p.rolling),
          p.mu_r,
          p.kr,
          p.rolling_viscous,
          static_cast<double>(p.twisting)};
}

Parameters unpack_parameters(const std::array<double, packed_parameters_size> &n)
{
  Parameters p;
  p.k1 = n[0];
  p.k2 = n[1];
  p.k_adh = n[2];
  p.f0 = n[3];
  p.mu = n[4];
  p.kt_given = n[5] != 0.0;
  p.kt = n[6];
  p.damping = enumerator(n[7], Damping::viscous, "damping");
  p.restitution = n[8];
  p.viscous_normal = n[9];
  p.viscous_tangential = n[10];
  p.rolling = enumerator(n[11], RollingModel::sds, "rolling model");
  p.mu_r = n[12];
  p.kr = n[13];
  p.rolling_viscous = n[14];
  p.twisting = enumerator(n[15], TwistingModel::marshall, "twisting model");
  return p;
}

}    // namespace eepa
