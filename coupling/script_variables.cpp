// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/script_variables.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <utility>

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

// std::regex calls itself for every character: of a longer line it exhausts the stack.
constexpr std::size_t longest_line = 10000;

class Reader {
 public:
  Reader(fs::path script, std::map<std::string, std::string> values)
      : folder_(script.parent_path()), values_(std::move(values)) {
    read(script);
  }
  ScriptVariables result() && { return std::move(found_); }

 private:
  void read(const fs::path& path);
  void read_line(const std::string& line);
  void follow(const std::string& written, const fs::path& folder);
  void definition(const std::smatch& match);

  fs::path folder_;  // of the main script: paths of beds are relative to it
  std::map<std::string, std::string> values_;
  std::set<std::string> files_;
  ScriptVariables found_;
};

/// LIGGGHTS's rule: from a # that stands in no quotes.
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

template <class Action>
void for_each_match(const std::string& text, const std::regex& pattern, Action&& action) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    action(*match);
}

void Reader::read(const fs::path& path) {
  std::error_code failed;
  if (!files_.insert(fs::weakly_canonical(path, failed).string()).second) return;
  std::ifstream file(path);
  std::string line, whole;
  if (!fs::is_regular_file(path, failed) || !file) {
    found_.complete = false;
    return;
  }
  while (std::getline(file, line)) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    if (end != std::string::npos && line[end] == '&') {
      whole += line.substr(0, end);
      continue;
    }
    read_line(without_comment(whole + line));
    whole.clear();
  }
  read_line(without_comment(whole));
}

void Reader::read_line(const std::string& line) {
  static const std::regex mention(R"(\$\{(\w+)\}|\$(\w)|\bv_(\w+))");
  static const std::regex define(R"((?:^|["'])\s*variable\s+(\w+)\s+(\w+)\s*([^\s"']*))");
  static const std::regex next(R"((?:^|["'])\s*next\s+([^"']+))"), word(R"(\w+)");
  static const std::regex include(R"((?:^|["'])\s*(?:include|jump)\s+([^\s"']+))");
  static const std::regex bed(R"(^\s*bed\s+([^\s"']+))");
  if (line.size() > longest_line) {
    found_.complete = false;
    return;
  }
  for_each_match(line, mention, [&](const std::smatch& match) {
    for (std::size_t i = 1; i < match.size(); ++i)
      if (match[i].matched) found_.mentioned.insert(match[i]);
  });
  for_each_match(line, define, [&](const std::smatch& match) { definition(match); });
  for_each_match(line, next, [&](const std::smatch& match) {
    for_each_match(match[1], word,
                   [&](const std::smatch& name) { found_.mentioned.insert(name.str()); });
  });
  for_each_match(line, include, [&](const std::smatch& match) {
    if (match[1] != "SELF") follow(match[1], "");
  });
  for_each_match(line, bed, [&](const std::smatch& match) { follow(match[1], folder_); });
}

void Reader::definition(const std::smatch& match) {
  static const std::set<std::string> replaceable = {"index", "loop", "universe", "uloop", "world"};
  const std::string name = match[1], style = match[2];
  found_.mentioned.insert(name);
  values_.emplace(name, match[3]);  // the command line's comes first
  std::vector<std::string>& names = found_.set_by_script;
  if (replaceable.count(style) && std::find(names.begin(), names.end(), name) == names.end())
    names.push_back(name);
}

/// A path that depends on more than plain values is not known before the script runs.
void Reader::follow(const std::string& written, const fs::path& folder) {
  static const std::regex variable(R"(\$\{(\w+)\})");
  std::string path = written;
  for (std::smatch match; std::regex_search(path, match, variable);) {
    const auto value = values_.find(match[1]);
    if (value == values_.end() || value->second.find('$') != std::string::npos) {
      found_.complete = false;
      return;
    }
    path = match.prefix().str() + value->second + match.suffix().str();
  }
  if (path.find('$') != std::string::npos)
    found_.complete = false;
  else
    read(folder / path);
}

}  // namespace

ScriptVariables find_variables(const std::string& script,
                               std::map<std::string, std::string> values) {
  return Reader(script, std::move(values)).result();
}

}  // namespace furrow::coupling
