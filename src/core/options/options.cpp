// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/options/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/core/options/nearest_word.h"
#include "furrow/core/options/usual_range.h"

namespace furrow {

namespace {

std::string after_origin(const std::string& origin, const std::string& text) {
  return origin.empty() ? text : origin + ": " + text;
}

std::optional<double> to_number(const std::string& text) {
  double value = 0.0;
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, status] = std::from_chars(begin, end, value);
  if (status != std::errc{} || stop != end) return std::nullopt;
  return value;
}

/// Meaning of a key, and the conversion of values in other units.
std::string remedy_of(const Key& key) {
  const UsualRange* usual = find_usual_range(key.name, key.unit);
  const std::string hint = usual ? usual->remedy() : "";
  if (key.meaning.empty() || key.meaning == key.name) return hint;
  return "it is: " + key.meaning + (hint.empty() ? "" : "; " + hint);
}

/// Warning about the first number outside of the key's usual range; empty without one.
std::string range_warning(const Key& key, const std::vector<double>& numbers) {
  const UsualRange* usual = find_usual_range(key.name, key.unit);
  for (const double number : numbers)
    if (usual && !usual->contains(number)) return usual->warning(number);
  return {};
}

/// Reason why a text is no number.
std::string no_number(const std::string& text) {
  double value = 0.0;
  const char* begin = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
  const bool too_large =
      std::from_chars(begin, text.data() + text.size(), value).ec == std::errc::result_out_of_range;
  return fmt::format("is '{}', which is {}", text,
                     too_large ? "too large for a number" : "not a number");
}

// Integers up to it are exact as a double.
constexpr double largest_integer = 9007199254740992.0;

}  // namespace

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  if (lower_open ? value <= lower : value < lower) return false;
  return upper_open ? value < upper : value <= upper;
}

std::string Range::text() const {
  const bool below = std::isfinite(lower), above = std::isfinite(upper);
  if (!below && !above) return "any finite number";
  if (!above) return fmt::format("{} {}", lower_open ? ">" : ">=", lower);
  if (!below) return fmt::format("{} {}", upper_open ? "<" : "<=", upper);
  return fmt::format("in {}{}, {}{}", lower_open ? '(' : '[', lower, upper, upper_open ? ')' : ']');
}

std::string Key::allowed() const {
  const std::string unit_text = unit.empty() ? "" : fmt::format(" [{}]", unit);
  switch (kind) {
    case Kind::number: {
      const bool bounded = std::isfinite(range.lower) || std::isfinite(range.upper);
      return fmt::format("{}{}{}", bounded ? "a number " : "", range.text(), unit_text);
    }
    case Kind::integer:
      return fmt::format("an integer {}", range.text());
    case Kind::numbers:
      return fmt::format("{} numbers, each {}{}", count == 0 ? "a list of" : std::to_string(count),
                         range.text(), unit_text);
    case Kind::choice:
      return fmt::format("one of: {}", fmt::join(choices, ", "));
    case Kind::text:
      return "a word";
    case Kind::flag:
      return "yes or no";
  }
  return {};
}

Schema& Schema::declare(Key key) {
  keys_.push_back(std::move(key));
  return *this;
}

Schema& Schema::number(const std::string& name, const std::string& unit, Range range,
                       const std::string& meaning) {
  return declare({name, Key::Kind::number, unit, range, 1, {}, meaning});
}
Schema& Schema::integer(const std::string& name, Range range, const std::string& meaning) {
  return declare({name, Key::Kind::integer, "", range, 1, {}, meaning});
}
Schema& Schema::numbers(const std::string& name, std::size_t count, const std::string& unit,
                        Range range, const std::string& meaning) {
  return declare({name, Key::Kind::numbers, unit, range, count, {}, meaning});
}
Schema& Schema::choice(const std::string& name, std::vector<std::string> choices,
                       const std::string& meaning) {
  return declare({name, Key::Kind::choice, "", {}, 1, std::move(choices), meaning});
}
Schema& Schema::text(const std::string& name, const std::string& meaning) {
  return declare({name, Key::Kind::text, "", {}, 1, {}, meaning});
}
Schema& Schema::flag(const std::string& name, const std::string& meaning) {
  return declare({name, Key::Kind::flag, "", {}, 1, {"yes", "no"}, meaning, false, {"no"}});
}
Schema& Schema::optional() {
  keys_.back().required = false;
  return *this;
}
Schema& Schema::by_default(const std::string& value) {
  keys_.back().default_values = {value};
  return optional();
}
Schema& Schema::by_default(double value) { return by_default(fmt::format("{}", value)); }
Schema& Schema::by_default(const std::vector<double>& values) {
  for (double value : values) keys_.back().default_values.push_back(fmt::format("{}", value));
  return optional();
}

Schema& Schema::may_change() {
  keys_.back().may_change = true;
  return *this;
}

const Key* Schema::find(const std::string& name) const {
  const auto found =
      std::find_if(keys_.begin(), keys_.end(), [&](const Key& key) { return key.name == name; });
  return found == keys_.end() ? nullptr : &*found;
}

std::string inverted_flag(const std::string& value) {
  return value == "yes" ? "no" : value == "no" ? "yes" : value;
}

Schema& Schema::alias(const std::string& former, const std::string& key,
                      Alias::Translation translation) {
  if (!find(key) || resolve(former))
    throw Error(fmt::format("{}: '{}' cannot be a former name of '{}'", subject_, former, key));
  aliases_.push_back({former, key, translation});
  return *this;
}

const Alias* Schema::find_alias(const std::string& former) const {
  const auto found = std::find_if(aliases_.begin(), aliases_.end(),
                                  [&](const Alias& alias) { return alias.former == former; });
  return found == aliases_.end() ? nullptr : &*found;
}

const Key* Schema::resolve(const std::string& name) const {
  const Alias* alias = find_alias(name);
  return find(alias ? alias->key : name);
}

Options Schema::read(const std::vector<std::string>& words) const {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < words.size();) {
    Entry entry{words[i++], {}};
    const Key* key = resolve(entry.key);
    // an unknown key is refused below, with its name
    const std::size_t count = !key ? words.size() : key->count;
    while (i < words.size() &&
           (count == 0 ? to_number(words[i]).has_value() : entry.values.size() < count)) {
      if (key && resolve(words[i]) && key->kind != Key::Kind::text &&
          key->kind != Key::Kind::choice)
        break;
      entry.values.push_back(words[i++]);
    }
    entries.push_back(std::move(entry));
  }
  return read(entries);
}

/// Checks the values of one key and adds them. @param where names the key in errors
void Schema::accept(Options& options, const Key& key, const std::vector<std::string>& texts,
                    bool given, const std::string& origin, const std::string& where) const {
  if (key.count == 0 ? texts.empty() : texts.size() != key.count)
    throw InputError(where,
                     texts.empty() ? "has no value" : fmt::format("has {} value(s)", texts.size()),
                     key.allowed(), remedy_of(key));
  Options::Value value{texts, {}, given, origin};
  if (key.kind == Key::Kind::choice || key.kind == Key::Kind::flag) {
    if (std::find(key.choices.begin(), key.choices.end(), texts[0]) == key.choices.end())
      throw InputError(where, fmt::format("is '{}'", texts[0]), key.allowed(), remedy_of(key));
  } else if (key.kind != Key::Kind::text) {
    for (const std::string& text : texts) {
      const std::optional<double> number = to_number(text);
      if (!number) throw InputError(where, no_number(text), key.allowed(), remedy_of(key));
      if (!key.range.contains(*number) ||
          (key.kind == Key::Kind::integer &&
           (*number != std::round(*number) || std::abs(*number) > largest_integer)))
        throw InputError(where, fmt::format("is {}", text), key.allowed(), remedy_of(key));
      value.numbers.push_back(*number);
    }
  }
  if (const std::string warning = range_warning(key, value.numbers); given && !warning.empty())
    options.warnings_.push_back(where + " " + warning);
  options.values_[key.name] = std::move(value);
}

Options Schema::read(const std::vector<Entry>& entries) const {
  Options options;
  options.subject_ = subject_;
  options.keys_ = keys_;

  for (const Entry& entry : entries) {
    const Key* key = resolve(entry.key);
    if (!key) {
      std::vector<std::string> names;
      for (const Key& known : keys_) names.push_back(known.name);
      throw InputError(after_origin(entry.origin, subject_),
                       fmt::format("has no keyword '{}'", entry.key),
                       fmt::format("{}", fmt::join(names, ", ")), did_you_mean(names, entry.key));
    }
    std::string where = after_origin(entry.origin, subject_ + ", keyword '" + entry.key + "'");
    std::vector<std::string> values = entry.values;
    const Alias* alias = find_alias(entry.key);
    if (alias) where += fmt::format(" (now '{}')", key->name);
    if (options.given(key->name))
      throw InputError(where, "is given twice", "each keyword once", "remove one of them");
    if (alias && alias->translation)
      std::transform(values.begin(), values.end(), values.begin(), alias->translation);
    accept(options, *key, values, true, entry.origin, where);
    if (alias)
      options.warnings_.push_back(fmt::format("{}: keyword '{}' is now called '{}'; write '{} {}'",
                                              after_origin(entry.origin, subject_), entry.key,
                                              key->name, key->name, fmt::join(values, " ")));
  }
  for (const Key& key : keys_) {
    if (options.given(key.name)) continue;
    if (key.required)
      throw InputError(options.where(key.name), "is missing", key.allowed(), remedy_of(key));
    if (!key.default_values.empty())
      accept(options, key, key.default_values, false, {}, options.where(key.name));
  }
  return options;
}

void Schema::check(const std::vector<std::string>& words) const {
  const auto unknown = [](const std::string& word) { return word.find('$') != std::string::npos; };
  for (std::size_t i = 0; i < words.size();) {
    const std::string& name = words[i++];
    if (unknown(name)) return;
    const Key* key = resolve(name);
    if (!key) {
      read(std::vector<Entry>{{name, {}}});  // throws
      return;
    }
    std::vector<std::string> values;
    while (i < words.size() &&
           (key->count == 0 ? to_number(words[i]).has_value() : values.size() < key->count))
      values.push_back(words[i++]);
    if (std::any_of(values.begin(), values.end(), unknown) ||
        (key->count == 0 && i < words.size() && unknown(words[i]))) {
      if (key->count != 1 || (i < words.size() && !resolve(words[i]))) return;
      continue;  // the value took one word
    }
    Options scratch;
    accept(scratch, *key, values, true, {}, fmt::format("{}, keyword '{}'", subject_, name));
  }
}

std::string Schema::table() const {
  std::string text;
  for (const Key& key : keys_)
    text += fmt::format(
        "  {:<18} {:<42} {:<12} {}\n", key.name, key.allowed(),
        key.required ? "required" : fmt::format("{}", fmt::join(key.default_values, " ")),
        key.meaning);
  return text;
}

const Options::Value& Options::value(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) throw Error(where(key) + " has no value");
  return found->second;
}
double Options::number(const std::string& key) const { return value(key).numbers.at(0); }
long Options::integer(const std::string& key) const {
  return static_cast<long>(value(key).numbers.at(0));
}
const std::vector<double>& Options::numbers(const std::string& key) const {
  return value(key).numbers;
}
const std::string& Options::text(const std::string& key) const { return value(key).texts.at(0); }
bool Options::flag(const std::string& key) const { return value(key).texts.at(0) == "yes"; }
bool Options::has(const std::string& key) const { return values_.count(key) > 0; }
bool Options::given(const std::string& key) const {
  const auto found = values_.find(key);
  return found != values_.end() && found->second.given;
}
std::string Options::where(const std::string& key) const {
  const auto found = values_.find(key);
  return after_origin(found == values_.end() ? "" : found->second.origin,
                      subject_ + ", keyword '" + key + "'");
}
std::vector<Entry> Options::effective() const {
  std::vector<Entry> entries;
  for (const Key& key : keys_)
    if (has(key.name)) entries.push_back({key.name, value(key.name).texts});
  return entries;
}

}  // namespace furrow
