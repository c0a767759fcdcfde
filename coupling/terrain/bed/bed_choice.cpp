// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/bed_choice.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/options/options.h"
#include "coupling/base/checks/time_step_check.h"
#include "coupling/terrain/bed/bed_limits.h"

namespace furrow::coupling {

namespace {

constexpr char chosen[] = "auto";

BedWords::iterator find(BedWords& words, const std::string& name) {
  return std::find_if(words.begin(), words.end(),
                      [&](const auto& word) { return word.first == name; });
}

bool is_chosen(BedWords& words, const std::string& name) {
  const auto word = find(words, name);
  return word != words.end() && word->second == chosen;
}

/// @throws InputError where it is missing or no number in the range
double number(BedWords& words, const std::string& name, const char* unit, const Range& range) {
  Schema schema("command bed");
  schema.number(name, unit, range, "");
  std::vector<Entry> entries;
  for (const auto& [word, value] : words)
    if (word == name) entries.push_back({word, {value}});
  return schema.read(entries).number(name);
}

double positive(BedWords& words, const std::string& name, const char* unit) {
  return number(words, name, unit, Range::positive());
}

double poisson_of(BedWords& words) { return number(words, "poisson", "", Range::closed(0, 0.5)); }

std::string choose_young(BedWords& words) {
  const double pressure = positive(words, "pressure", "Pa");
  const double young = young_for_overlap(pressure, poisson_of(words), chosen_overlap);
  find(words, "young")->second = fmt::format("{:.4g}", young);
  words.erase(find(words, "pressure"));
  return fmt::format("young {:.4g} Pa: grains overlap by {:g} % under {:g} Pa", young,
                     100 * chosen_overlap, pressure);
}

std::string choose_step(BedWords& words) {
  const double radius = 0.5 * smallest_grain * positive(words, "diameter", "m");
  const double density = positive(words, "density", "kg/m^3");
  double time;
  const char* of;
  if (find(words, "young") != words.end()) {
    time = rayleigh_time(radius, density, positive(words, "young", "Pa"), poisson_of(words));
    of = "Rayleigh";
  } else if (find(words, "modulus") != words.end()) {
    time = snow_contact_time(radius, density, positive(words, "modulus", "Pa"));
    of = "contact";
  } else {
    throw InputError("command bed, keyword 'step'", "is 'auto'", "a number > 0 [s]",
                     "it is chosen for beds with young and poisson, or modulus");
  }
  find(words, "step")->second = fmt::format("{:.4g}", chosen_step * time);
  return fmt::format("step {:.4g} s: {:g} of the smallest grain's {} time", chosen_step * time,
                     chosen_step, of);
}

}  // namespace

double young_for_overlap(double pressure, double poisson, double share) {
  return 3.0 * (1.0 - poisson * poisson) * pressure / std::pow(share, 1.5);
}

std::string choose_bed_values(BedWords& words) {
  std::string found;
  if (is_chosen(words, "young")) found = choose_young(words);
  if (is_chosen(words, "step")) found += (found.empty() ? "" : "; ") + choose_step(words);
  return found;
}

}  // namespace furrow::coupling
