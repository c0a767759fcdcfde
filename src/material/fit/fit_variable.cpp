// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/fit/fit_variable.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

/// "hardening.p[2]": section, key and place from 0.
struct Place {
  std::string section, key;
  std::optional<std::size_t> index;
};

Place place_of(const std::string& name, const std::string& where) {
  const std::size_t dot = name.find('.');
  Place place{name.substr(0, dot), dot == std::string::npos ? "" : name.substr(dot + 1), {}};
  if (place.key.empty() || place.key.back() != ']') return place;
  const std::size_t bracket = place.key.find('[');
  const std::string digits = bracket == std::string::npos
                                 ? ""
                                 : place.key.substr(bracket + 1, place.key.size() - bracket - 2);
  const bool number = !digits.empty() && digits.size() < 7 &&
                      digits.find_first_not_of("0123456789") == std::string::npos;
  if (!number || std::stoul(digits) == 0)
    throw InputError(where, "has no place in its list", "section.key[n], n from 1");
  place.index = std::stoul(digits) - 1;
  place.key.resize(bracket);
  return place;
}

const Key* key_of(const MaterialModel& model, const MaterialOptions& options, const Place& place) {
  const auto section = options.find(place.section);
  if (section == options.end() || !section->second.options.has(place.key)) return nullptr;
  for (const SectionSchema& candidate : model.sections)
    if (candidate.name == place.section)
      return candidate.choice(section->second.type).schema.find(place.key);
  return nullptr;
}

std::string names_of(const MaterialOptions& options) {
  std::string names;
  for (const auto& [section, values] : options)
    for (const Entry& entry : values.options.effective())
      names += fmt::format("{}{}.{}", names.empty() ? "" : ", ", section, entry.key);
  return names;
}

}  // namespace

FitVariable::FitVariable(const MaterialModel& model, const MaterialOptions& options,
                         MaterialSections& sections, const FitParameter& parameter) {
  const std::string where = fmt::format("parameter '{}'", parameter.name);
  const Place place = place_of(parameter.name, where);
  const Key* key = key_of(model, options, place);
  if (!key || (key->kind != Key::Kind::number && key->kind != Key::Kind::numbers))
    throw InputError(where, "is no number of this material", names_of(options),
                     "write section.key, or section.key[n] for one of a list");
  const std::vector<double>& values = options.at(place.section).options.numbers(place.key);
  if (key->kind == Key::Kind::numbers && !place.index)
    throw InputError(where, fmt::format("is a list of {}", values.size()),
                     fmt::format("{0}[1] to {0}[{1}]", parameter.name, values.size()));
  place_ = place.index.value_or(0);
  if (place_ >= values.size())
    throw InputError(where, fmt::format("is beyond the list of {}", values.size()),
                     fmt::format("n up to {}", values.size()));
  section_ = place.section;
  key_ = place.key;
  unit_ = key->unit;

  start_ = parameter.start.value_or(values[place_]);
  lower_ = std::max(parameter.lower, key->range.lower);
  upper_ = std::min(parameter.upper, key->range.upper);
  if (!(lower_ < upper_))
    throw InputError(where, fmt::format("has the bounds {} and {}", lower_, upper_),
                     "lower < upper, within " + key->range.text());
  if (!key->range.contains(start_) || start_ < lower_ || start_ > upper_)
    throw InputError(
        where, fmt::format("starts at {}", start_),
        fmt::format("a start in [{}, {}], within {}", lower_, upper_, key->range.text()));
  logarithmic_ = lower_ >= 0.0 && start_ > 0.0;
  if (!logarithmic_) {
    const bool interval = std::isfinite(lower_) && std::isfinite(upper_);
    if (start_ == 0.0 && !interval)
      throw InputError(where, "starts at 0 without bounds, so its size is not known",
                       "a start other than 0, or lower and upper");
    scale_ = interval ? upper_ - lower_ : std::abs(start_);
  }
  low_ = z_of(lower_);
  high_ = z_of(upper_);

  std::vector<Entry>& entries = sections[section_];
  Entry entry{key_, {}};
  for (const double value : values) entry.values.push_back(fmt::format("{:.17g}", value));
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key_; });
  if (found == entries.end())
    entries.push_back(entry);
  else
    *found = entry;
}

bool FitVariable::bounded() const { return std::isfinite(low_) && std::isfinite(high_); }

double FitVariable::z_of(double value) const {
  return logarithmic_ ? std::log(value) : value / scale_;
}

double FitVariable::value_of(double z) const {
  // rounding must not leave the range
  return std::clamp(logarithmic_ ? std::exp(z) : z * scale_, lower_, upper_);
}

double FitVariable::start_t() const {
  const double z = z_of(start_);
  if (!bounded()) return z;
  // A start at a bound would have no slope: it is moved inside by a thousandth of the interval.
  const double part = std::clamp((z - low_) / (high_ - low_), 1e-3, 1.0 - 1e-3);
  return std::atanh(2.0 * part - 1.0);
}

double FitVariable::z_of_t(double t) const {
  return bounded() ? low_ + (high_ - low_) * 0.5 * (1.0 + std::tanh(t))
                   : std::clamp(t, low_, high_);
}

void FitVariable::put(MaterialSections& sections, double z) const {
  for (Entry& entry : sections.at(section_))
    if (entry.key == key_) entry.values.at(place_) = fmt::format("{:.17g}", value_of(z));
}

std::pair<double, double> FitVariable::around(double z, double step) const {
  return {std::max(z - step, low_), std::min(z + step, high_)};
}

std::string FitVariable::bound_met(double z) const {
  const double margin = bounded() ? 2e-3 * (high_ - low_) : 0.0;
  if (z - low_ <= margin) return fmt::format("stands at its lower bound {}", lower_);
  if (high_ - z <= margin) return fmt::format("stands at its upper bound {}", upper_);
  return {};
}

}  // namespace furrow
