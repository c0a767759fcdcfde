// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/style_record.h"

#include <charconv>
#include <optional>

#include <nlohmann/json.hpp>

namespace furrow {

namespace {

using Value = StyleRecord::Value;

template <class Number>
std::optional<Number> whole(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  if (text.empty() || status != std::errc{} || stop != end) return std::nullopt;
  return number;
}

std::vector<Value> typed(const Key& key, const Options& options) {
  switch (key.kind) {
    case Key::Kind::flag:
      return {options.flag(key.name)};
    case Key::Kind::integer:
      return {static_cast<std::int64_t>(options.integer(key.name))};
    case Key::Kind::number:
    case Key::Kind::numbers: {
      const std::vector<double>& numbers = options.numbers(key.name);
      return {numbers.begin(), numbers.end()};
    }
    case Key::Kind::choice:
    case Key::Kind::text:
      return {options.text(key.name)};
  }
  return {};
}

}  // namespace

Value typed_value(const std::string& text) {
  if (const auto integer = whole<std::int64_t>(text)) return *integer;
  if (const auto number = whole<double>(text)) return *number;
  return text;
}

std::vector<std::pair<std::string, std::vector<Value>>> typed_values(const Options& options) {
  std::vector<std::pair<std::string, std::vector<Value>>> list;
  for (const Key& key : options.keys())
    if (options.has(key.name)) list.emplace_back(key.name, typed(key, options));
  return list;
}

std::string styles_json(const std::vector<StyleRecord>& styles) {
  std::string text = "[";
  for (const StyleRecord& style : styles) {
    nlohmann::ordered_json json{
        {"id", style.id}, {"group", style.group}, {"style", style.style}, {"kind", style.kind}};
    json["options"] = nlohmann::ordered_json::object();
    for (const auto& [key, values] : style.options) {
      nlohmann::ordered_json& list = json["options"][key] = nlohmann::ordered_json::array();
      for (const Value& value : values)
        std::visit([&](const auto& plain) { list.push_back(plain); }, value);
    }
    text += (text.size() > 1 ? ",\n " : "") + json.dump();
  }
  return text + "]\n";
}

}  // namespace furrow
