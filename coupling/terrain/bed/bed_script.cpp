// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/bed_script.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

constexpr char mark[] = "#: ";
constexpr char parameters[] = "parameters";
constexpr char highest[] = "highest";  // given by Furrow

/// Range of a text such as "> 0", ">= 1", "[0, 0.5)", "any".
std::optional<Range> to_range(const std::string& text) {
  static const std::regex bound(R"((>=?) *(\S+))"), interval(R"(([\[(])(\S+), *(\S+)([\])]))");
  std::smatch match;
  if (text == "any") return Range::any();
  try {
    if (std::regex_match(text, match, bound)) {
      Range range = Range::at_least(std::stod(match[2]));
      range.lower_open = match[1] == ">";
      return range;
    }
    if (std::regex_match(text, match, interval)) {
      return Range{std::stod(match[2]), std::stod(match[3]), match[1] == "(", match[4] == ")"};
    }
  } catch (const std::logic_error&) {  // no number
  }
  return std::nullopt;
}

}  // namespace

std::string current_name(const std::string& parameter) {
  return parameter == "headroom" ? "clearance_above" : parameter;
}

BedScript::BedScript(const fs::path& path) : path_(path) {
  std::error_code failed;
  std::ifstream file(path);
  if (!fs::is_regular_file(path, failed) || !file)
    throw InputError("command bed", fmt::format("cannot read '{}'", path.string()),
                     "the path of a script that makes a bed",
                     "give it relative to the folder of the file with the line");
  std::ostringstream text;
  text << file.rdbuf();
  text_ = text.str();

  static const std::set<std::string> forbidden = {"jump",  "label", "include",      "next",
                                                  "clear", "bed",   "read_restart", "quit"};
  for (const std::string& section : sections())
    for (const std::string& command : commands(section)) {
      std::string word;
      std::istringstream(command) >> word;
      if (forbidden.count(word))
        refuse(fmt::format("has the command '{}' in its section '{}'", word, section),
               "commands that run one after the other in this file");
    }
}

void BedScript::refuse(const std::string& problem, const std::string& allowed) const {
  throw InputError(fmt::format("command bed: script '{}'", path_.string()), problem, allowed);
}

bool BedScript::has(const std::string& section) const {
  return ("\n" + text_).find(fmt::format("\n{}{}\n", mark, section)) != std::string::npos;
}

/// Names of the sections with commands.
std::vector<std::string> BedScript::sections() const {
  std::vector<std::string> found = {"box", "contact", "settle"};
  if (leaves_levelling()) found.emplace_back("levelled");
  return found;
}

bool BedScript::reads_highest() const {
  return text_.find(fmt::format("${{bed_{}}}", highest)) != std::string::npos;
}

/// Lines between "#: <section>" and the next "#: ".
std::vector<std::string> BedScript::lines(const std::string& section) const {
  if (!has(section))
    throw InputError("command bed",
                     fmt::format("finds no line '{}{}' in '{}'", mark, section, path_.string()),
                     "sections '#: box', '#: contact', '#: settle'");
  std::istringstream all(text_);
  std::vector<std::string> found;
  bool inside = false;
  for (std::string line; std::getline(all, line);) {
    if (line.compare(0, 3, mark) == 0)
      inside = line.substr(3) == section;
    else if (inside)
      found.push_back(line);
  }
  return found;
}

std::vector<std::string> BedScript::commands(const std::string& section) const {
  std::vector<std::string> found;
  std::string whole;
  for (const std::string& line : lines(section)) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    if (end != std::string::npos && line[end] == '&') {
      whole += line.substr(0, end) + " ";
      continue;
    }
    found.push_back(whole + line);
    whole.clear();
  }
  if (!whole.empty()) found.push_back(whole);
  return found;
}

/// Parameters that the commands read and do not set.
std::vector<std::string> BedScript::parameters_that_are_read() const {
  static const std::regex read(R"(\$\{bed_(\w+)\}|\bv_bed_(\w+))");
  static const std::regex set(R"(^\s*variable\s+bed_(\w+))");
  std::vector<std::string> found;
  std::set<std::string> known = {highest};
  for (const std::string& section : sections())
    for (const std::string& command : commands(section)) {
      for (std::sregex_iterator match(command.begin(), command.end(), read), end; match != end;
           ++match) {
        const std::string name = (*match)[1].matched ? (*match)[1] : (*match)[2];
        if (known.insert(name).second) found.push_back(current_name(name));
      }
      std::smatch match;
      if (std::regex_search(command, match, set)) known.insert(match[1]);
    }
  return found;
}

void BedScript::declare_parameters(Schema& schema) const {
  if (!has(parameters)) {
    for (const std::string& name : parameters_that_are_read())
      if (!schema.find(name)) schema.text(name, fmt::format("read by '{}'", path_.string()));
    return;
  }
  static const std::regex row(R"(# (\w+)  +(\S+)  +(integer )?(\S.*?)  +(\S.*))");
  const std::string format = "lines '# name  unit  range  meaning', two blanks between";
  for (const std::string& line : lines(parameters)) {
    std::smatch match;
    if (line.empty()) continue;
    if (!std::regex_match(line, match, row))
      refuse(fmt::format("has in its section '{}' the line '{}'", parameters, line), format);
    const std::optional<Range> range = to_range(match[4]);
    if (!range)
      refuse(fmt::format("has for '{}' the range '{}'", match[1].str(), match[4].str()),
             "> 0, >= 0, [0, 1], (0, 1), any; each also after 'integer'");
    if (schema.find(match[1])) continue;
    if (match[3].matched)
      schema.integer(match[1], *range, match[5]);
    else
      schema.number(match[1], match[2] == "-" ? "" : match[2].str(), *range, match[5]);
  }
}

}  // namespace furrow::coupling
