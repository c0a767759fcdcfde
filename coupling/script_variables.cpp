// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/script_variables.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <utility>

#include <nlohmann/json.hpp>

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

// std::regex calls itself for every character: of a longer line it exhausts the stack.
constexpr std::size_t longest_line = 10000;

class Reader {
 public:
  Reader(const fs::path& script, std::map<std::string, std::string> values)
      : values_(std::move(values)) {
    read(script);
    for (const auto& [name, value] : on_condition_) add_default(name, value);
  }
  ScriptVariables result() && { return std::move(found_); }

 private:
  void read(const fs::path& path);
  void read_line(const std::string& line, const fs::path& folder);
  void follow(const std::string& written, const fs::path& folder);
  void define(const std::smatch& match, bool on_condition);
  void add_default(const std::string& name, const std::string& value);

  std::map<std::string, std::string> values_;
  std::set<std::string> read_;
  std::vector<std::pair<std::string, std::string>> on_condition_;
  ScriptVariables found_;
};

/// Removes a comment as LIGGGHTS does: from a # outside of quotes.
std::string without_comment(const std::string& line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '#' && !quote) return line.substr(0, i);
    if (c == quote)
      quote = 0;
    else if (!quote && (c == '"' || c == '\''))
      quote = c;
  }
  return line;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string unquoted(const std::string& text) {
  const bool quoted = text.size() > 1 && text.front() == text.back() &&
                      (text.front() == '"' || text.front() == '\'');
  return quoted ? text.substr(1, text.size() - 2) : text;
}

template <class Action>
void for_each_match(const std::string& text, const std::regex& pattern, Action&& action) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    action(*match);
}

void Reader::read(const fs::path& path) {
  std::error_code failed;
  const std::string whole_path = fs::weakly_canonical(path, failed).string();
  if (!read_.insert(whole_path).second) return;
  std::ifstream file(path);
  std::string line, whole;
  if (!fs::is_regular_file(path, failed) || !file) {
    found_.not_found.push_back(path.string());
    return;
  }
  found_.files.push_back(whole_path);
  const fs::path folder = path.parent_path();
  while (std::getline(file, line)) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    if (end != std::string::npos && line[end] == '&') {
      whole += line.substr(0, end);
      continue;
    }
    read_line(trimmed(without_comment(whole + line)), folder);
    whole.clear();
  }
  read_line(trimmed(without_comment(whole)), folder);
}

void Reader::read_line(const std::string& line, const fs::path& folder) {
  static const std::regex mention(R"(\$\{([^}]+)\}|\$(\w)|\bv_(\w+))");
  static const std::regex definition(R"(^variable\s+(\S+)\s+(\w+)\s*(.*)$)");
  static const std::regex quoted_definition(
      R"re((?:"\s*variable\s+([^\s"]+)\s+(\w+)\s*([^"]*)"?)|(?:'\s*variable\s+([^\s']+)\s+(\w+)\s*([^']*)'?))re");
  static const std::regex next(R"((?:^|["'])\s*next\s+([^"']+))"), word(R"(\w+)");
  static const std::regex include(R"((?:^|["'])\s*(?:include|jump)\s+([^\s"']+|"[^"]*"|'[^']*'))");
  static const std::regex bed(R"(^bed\s+([^\s"']+|"[^"]*"|'[^']*'))");
  if (line.size() > longest_line) {
    found_.not_found.push_back("a file of a line of more than 10000 characters");
    return;
  }
  for_each_match(line, mention, [&](const std::smatch& match) {
    for (std::size_t i = 1; i < match.size(); ++i)
      if (match[i].matched) found_.mentioned.insert(match[i]);
  });
  for_each_match(line, definition, [&](const std::smatch& match) { define(match, false); });
  for_each_match(line, quoted_definition, [&](const std::smatch& match) { define(match, true); });
  for_each_match(line, next, [&](const std::smatch& match) {
    const std::string names = match[1];
    for_each_match(names, word,
                   [&](const std::smatch& name) { found_.mentioned.insert(name.str()); });
  });
  for_each_match(line, include, [&](const std::smatch& match) {
    if (match[1] != "SELF") follow(unquoted(match[1]), "");
  });
  for_each_match(line, bed, [&](const std::smatch& match) { follow(unquoted(match[1]), folder); });
}

/// A default that holds without a condition comes first, so others wait for the end.
void Reader::define(const std::smatch& match, bool on_condition) {
  static const std::set<std::string> replaceable = {"index", "loop", "universe", "uloop", "world"};
  const std::size_t first = match[1].matched ? 1 : 4;
  const std::string name = match[first], style = match[first + 1],
                    value = trimmed(match[first + 2]);
  if (style == "delete") return;
  found_.mentioned.insert(name);
  if (!replaceable.count(style)) {
    found_.computed.insert(name);
    if (style == "string") values_[name] = unquoted(value);
  } else if (on_condition) {
    on_condition_.emplace_back(name, value);
  } else {
    add_default(name, value);
  }
}

/// The command line's value comes first.
void Reader::add_default(const std::string& name, const std::string& value) {
  values_.emplace(name, unquoted(value));
  if (!found_.has_default(name)) found_.defaults.emplace_back(name, value);
}

/// A path that depends on more than plain values is not known before the script runs.
void Reader::follow(const std::string& written, const fs::path& folder) {
  static const std::regex variable(R"(\$\{(\w+)\})");
  std::string path = written;
  for (std::smatch match; std::regex_search(path, match, variable);) {
    found_.in_paths.insert(match[1]);
    const auto value = values_.find(match[1]);
    if (value == values_.end() || value->second.find('$') != std::string::npos) break;
    path = match.prefix().str() + value->second + match.suffix().str();
  }
  if (path.find('$') != std::string::npos)
    found_.not_found.push_back(path);
  else
    read(folder / path);
}

}  // namespace

bool ScriptVariables::has_default(const std::string& name) const {
  return std::any_of(defaults.begin(), defaults.end(),
                     [&](const auto& each) { return each.first == name; });
}

ScriptVariables find_variables(const std::string& script,
                               std::map<std::string, std::string> values) {
  return Reader(script, std::move(values)).result();
}

std::string variables_json(const ScriptVariables& variables) {
  nlohmann::ordered_json defaults = nlohmann::ordered_json::object();
  for (const auto& [name, value] : variables.defaults) defaults[name] = value;
  const nlohmann::ordered_json object = {{"defaults", defaults},
                                         {"computed", variables.computed},
                                         {"mentioned", variables.mentioned},
                                         {"in_paths", variables.in_paths},
                                         {"files", variables.files},
                                         {"not_found", variables.not_found}};
  return object.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace furrow::coupling
