// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/point/point_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "furrow/core/error.h"

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

MaterialNumber::MaterialNumber(const std::string& what, const std::string& name,
                               const MaterialModel& model, const MaterialOptions& options,
                               MaterialSections& sections)
    : name_(name) {
  const std::string where = fmt::format("{} '{}'", what, name_);
  const Place place = place_of(name_, where);
  const Key* key = key_of(model, options, place);
  if (!key || (key->kind != Key::Kind::number && key->kind != Key::Kind::numbers))
    throw InputError(where, "is no number of this material", names_of(options),
                     "write section.key, or section.key[n] for one of a list");
  const std::vector<double>& values = options.at(place.section).options.numbers(place.key);
  if (key->kind == Key::Kind::numbers && !place.index)
    throw InputError(where, fmt::format("is a list of {}", values.size()),
                     fmt::format("{0}[1] to {0}[{1}]", name_, values.size()));
  place_ = place.index.value_or(0);
  if (place_ >= values.size())
    throw InputError(where, fmt::format("is beyond the list of {}", values.size()),
                     fmt::format("n up to {}", values.size()));
  section_ = place.section;
  key_ = place.key;
  unit_ = key->unit;
  range_ = key->range;
  value_ = values[place_];

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

void MaterialNumber::put(MaterialSections& sections, const std::string& value) const {
  for (Entry& entry : sections.at(section_))
    if (entry.key == key_) entry.values.at(place_) = value;
}

FitParameter::FitParameter(const MaterialModel& model, const MaterialOptions& options,
                           MaterialSections& sections, const FitParameterInput& input)
    : MaterialNumber("parameter", input.name, model, options, sections) {
  const std::string where = fmt::format("parameter '{}'", name());
  start_ = input.start.value_or(value());
  lower_ = std::max(input.lower, range().lower);
  upper_ = std::min(input.upper, range().upper);
  if (!(lower_ < upper_))
    throw InputError(where, fmt::format("has the bounds {} and {}", lower_, upper_),
                     "lower < upper, within " + range().text());
  if (!range().contains(start_) || start_ < lower_ || start_ > upper_)
    throw InputError(where, fmt::format("starts at {}", start_),
                     fmt::format("a start in [{}, {}], within {}", lower_, upper_, range().text()));
  if (start_ == 0.0 && !(std::isfinite(lower_) && std::isfinite(upper_)))
    throw InputError(where, "starts at 0 without bounds, so its size is not known",
                     "a start other than 0, or lower and upper");
}

bool share_a_path(const FitCurve& one, const FitCurve& other) {
  const auto same_value = [](const auto& a, const auto& b) {
    return a.first.name() == b.first.name() && a.second == b.second;
  };
  const auto same_segment = [](const PathSegment& a, const PathSegment& b) {
    return a.control == b.control && a.target == b.target && a.steps == b.steps &&
           a.duration == b.duration;
  };
  const PointPath &path = one.path, &path2 = other.path;
  return std::equal(one.sample.begin(), one.sample.end(), other.sample.begin(), other.sample.end(),
                    same_value) &&
         path.motion == path2.motion && path.strain_from_switch == path2.strain_from_switch &&
         path.tolerance == path2.tolerance &&
         std::equal(path.segments.begin(), path.segments.end(), path2.segments.begin(),
                    path2.segments.end(), same_segment);
}

std::vector<double> curve_of(const Material& material, const PointHistory& history,
                             const FitCurve& curve) {
  const PointChannel channel = find_point_channel(material, curve.channel);
  const int first = static_cast<int>(curve.path.segments.size() - curve.measured.size()) + 1;
  std::vector<double> values;
  for (const PointRecord& record : history.records)
    if (record.segment >= first &&
        record.step == curve.path.segments[std::size_t(record.segment) - 1].steps)
      values.push_back(channel.value(record));
  return values;
}

}  // namespace furrow
