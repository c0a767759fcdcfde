// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/command_line.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "furrow/core/error.h"
#include "furrow/core/options/nearest_word.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/script_variables.h"

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

constexpr int up_to_next_option = -1;

/// An option of LIGGGHTS: its names, how many words follow it, and which words they may be.
struct Option {
  std::vector<std::string> names;
  int words;
  std::vector<std::string> choices = {};
};

const std::vector<Option>& options() {
  static const std::vector<Option> list = {
      {{"-in", "-i"}, 1},
      {{"-var", "-v"}, up_to_next_option},
      {{"-log", "-l"}, 1},
      {{"-screen", "-sc"}, 1},
      {{"-echo", "-e"}, 1, {"none", "screen", "log", "both"}},
      {{"-nocite", "-nc"}, 0},
      {{"-help", "-h"}, 0},
      {{"-thermo"}, 1},
      {{"-uid"}, 1},
      {{"-partition", "-p"}, up_to_next_option},
      {{"-pscreen", "-ps"}, 1},
      {{"-plog", "-pl"}, 1},
      {{"-reorder", "-ro"}, 2},
      {{"-restart", "-r"}, 2},
      {{"-restart_offset", "-roff"}, 3},
      {{"-domain"}, 1, {"box", "wedge"}},
      {{"-suffix", "-sf"}, 1},
      {{"-cuda", "-c"}, 1, {"on", "off"}},
      {{"-seedtolerant", "-st"}, 0},
      {{"-wb"}, 0},
      {{"--help"}, 0},
      {{"--variables"}, 1},
      {{"--keys"}, 0},
      {{"--version"}, 0},
  };
  return list;
}

const Option* find_option(const std::string& word) {
  const auto found = std::find_if(options().begin(), options().end(), [&](const Option& option) {
    return std::count(option.names.begin(), option.names.end(), word) > 0;
  });
  return found == options().end() ? nullptr : &*found;
}

[[noreturn]] void refuse(const std::string& problem, const std::string& allowed,
                         const std::string& remedy = "") {
  throw InputError("furrow", problem, allowed, remedy);
}

[[noreturn]] void refuse_word(const std::string& word) {
  if (word.empty()) refuse("is started with an empty argument", "options of LIGGGHTS, see --help");
  if (word[0] != '-')
    refuse(fmt::format("is started with '{}', which is no option", word),
           "options that begin with '-'", fmt::format("for a script write '-in {}'", word));
  std::vector<std::string> names;
  for (const Option& option : options())
    names.insert(names.end(), option.names.begin(), option.names.end());
  refuse(fmt::format("has no option '{}'", word), "options of LIGGGHTS, see --help",
         did_you_mean(names, word));
}

bool is_name(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

CommandLine::Variable as_variable(const std::string& option,
                                  const std::vector<std::string>& words) {
  const std::string allowed = fmt::format("{} <name> <value>", option);
  if (words.size() < 2)
    refuse(words.empty() ? fmt::format("has an option {} without a variable", option)
                         : fmt::format("has a variable '{}' without a value", words[0]),
           allowed);
  if (!is_name(words[0]))
    refuse(fmt::format("has a variable with the name '{}'", words[0]),
           "letters, digits and underscores", fmt::format("write '{}'", allowed));
  if (std::count(words.begin(), words.end(), ""))
    refuse(fmt::format("has a variable '{}' with an empty value", words[0]), allowed,
           "leave it out for the value that the script has");
  return {words[0], {words.begin() + 1, words.end()}};
}

/// Adds a variable once. LIGGGHTS would silently take the first of two values.
void add_variable(CommandLine& line, CommandLine::Variable variable) {
  for (const CommandLine::Variable& other : line.variables)
    if (other.name == variable.name)
      refuse(fmt::format("has the variable '{}' twice, as '{}' and '{}'", variable.name,
                         fmt::join(other.values, " "), fmt::join(variable.values, " ")),
             "each variable once", "remove one of them");
  line.variables.push_back(std::move(variable));
}

/// A script may also be a pipe.
void check_script(const std::string& script) {
  const std::string where = fmt::format("script '{}'", script);
  const std::string allowed = "a file with commands of LIGGGHTS and Furrow",
                    remedy = "give its path after -in";
  std::error_code failed;
  const fs::file_status status = fs::status(script, failed);
  if (!fs::exists(status))
    throw InputError(
        where,
        "cannot be read: " +
            (failed ? failed : std::make_error_code(std::errc::no_such_file_or_directory))
                .message(),
        allowed, remedy);
  if (fs::is_directory(status)) throw InputError(where, "is a folder", allowed, remedy);
  if (access(script.c_str(), R_OK) != 0)
    throw InputError(where, fmt::format("cannot be read: {}", std::strerror(errno)), allowed,
                     remedy);
  if (!fs::is_regular_file(status)) return;
  if (fs::file_size(script, failed) == 0) throw InputError(where, "is empty", allowed, remedy);
  if (const std::string problem = script_text_problem(script); !problem.empty())
    throw InputError(where, problem, "a text in UTF-8 whose lines end with LF or CR LF",
                     "save it so in an editor");
}

void check_writable(const std::string& path, const std::string& script) {
  std::error_code absent;
  if (fs::equivalent(path, script, absent))
    throw InputError(fmt::format("file '{}' of -log or -screen", path), "is the script",
                     "another file, or none");
  const int handle = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (handle < 0)
    throw InputError(fmt::format("file '{}' of -log or -screen", path),
                     fmt::format("cannot be written: {}", std::strerror(errno)),
                     "a path in a folder that is there, or none");
  close(handle);
}

ScriptVariables variables_of(const CommandLine& line) {
  std::map<std::string, std::string> values;
  for (const CommandLine::Variable& variable : line.variables)
    values.emplace(variable.name, variable.values[0]);
  return find_variables(line.script, values);
}

void check_variables(const CommandLine& line) {
  const ScriptVariables script = variables_of(line);
  // Nothing is known of what a missing file reads.
  if (!script.not_found.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, value] : script.defaults) names.push_back(name);
  for (const CommandLine::Variable& variable : line.variables) {
    if (script.mentioned.count(variable.name)) continue;
    refuse(
        fmt::format("has a variable '{}' that no line of '{}' reads", variable.name, line.script),
        names.empty() ? "no variable, as the script has none"
                      : fmt::format("{}", fmt::join(names, ", ")),
        did_you_mean(names, variable.name));
  }
}

}  // namespace

CommandLine read_command_line(const std::vector<std::string>& words) {
  CommandLine line;
  for (std::size_t i = 0; i < words.size();) {
    const std::string& name = words[i++];
    const Option* option = find_option(name);
    if (!option) refuse_word(name);
    std::vector<std::string> values;
    // As LIGGGHTS has it, the first value of a variable may begin with '-': a negative number.
    const std::size_t at_once = name == "-var" || name == "-v" ? 2 : 1;
    const auto is_value = [&](const std::string& word) {
      if (find_option(word)) return false;
      return option->words != up_to_next_option || values.size() < at_once || word[0] != '-';
    };
    const std::size_t wanted =
        option->words == up_to_next_option ? words.size() : static_cast<std::size_t>(option->words);
    while (i < words.size() && values.size() < wanted && is_value(words[i]))
      values.push_back(words[i++]);
    if (option->words != up_to_next_option && values.size() < wanted)
      refuse(fmt::format("has an option {} without its {}", name,
                         wanted == 1 ? "value" : fmt::format("{} values", wanted)),
             wanted == 1 ? "one argument after it" : fmt::format("{} arguments after it", wanted));
    if (!option->choices.empty() &&
        !std::count(option->choices.begin(), option->choices.end(), values[0]))
      refuse(fmt::format("has an option {} with '{}'", name, values[0]),
             fmt::format("{}", fmt::join(option->choices, ", ")));

    const std::string& meaning = option->names[0];
    if (meaning == "--help") line.help = true;
    if (meaning == "--version") line.version = true;
    if (meaning == "--variables") line.lists_variables = true;
    if (meaning == "--keys") line.lists_keys = true;
    if (meaning == "-in" || meaning == "--variables") {
      if (!line.script.empty()) refuse("has two scripts", "one -in or --variables");
      if (values[0].empty())
        refuse(fmt::format("has an empty argument after {}", meaning), "a path");
      line.script = values[0];
    }
    if (meaning == "-var") add_variable(line, as_variable(name, values));
    if ((meaning == "-log" || meaning == "-screen") && values[0] != "none")
      line.written_files.push_back(values[0]);
  }
  return line;
}

void check_command_line(const CommandLine& line) {
  if (line.script.empty() && isatty(STDIN_FILENO))
    refuse("is started without a script", "-in <script>", "see --help");
  if (!line.script.empty()) check_script(line.script);
  for (const std::string& path : line.written_files) check_writable(path, line.script);
  // A pipe can be read only once.
  if (!line.script.empty() && fs::is_regular_file(line.script)) check_variables(line);
}

std::vector<std::string> words_for_liggghts(std::vector<std::string> words) {
  for (std::size_t i = 2; i < words.size(); ++i)
    if ((words[i - 1] == "-screen" || words[i - 1] == "-sc") && words[i] == "none")
      words[i] = "/dev/null";
  return words;
}

std::string script_variables(const CommandLine& line) {
  check_script(line.script);
  return variables_json(variables_of(line));
}

std::string usage() {
  return "Usage: furrow -in <script> [-var <name> <value>]... [-log <file>|none] "
         "[-screen <file>|none]\n"
         "       mpirun -n <ranks> furrow -in <script> ...\n"
         "LIGGGHTS with Furrow's fix styles; all options of LIGGGHTS are taken (-help lists its "
         "styles).\n"
         "  -in <script>         input script; without it, standard input is read\n"
         "  -var <name> <value>  sets a variable of the script\n"
         "  -log, -screen        where LIGGGHTS's messages go; without -log: log.liggghts\n"
         "  --variables <script> prints the variables and files of a script as JSON, and runs "
         "nothing\n"
         "  --keys               prints the keywords of all styles of Furrow as JSON\n"
         "  --help, --version    this text; the versions of Furrow and LIGGGHTS\n"
         "Status: 0 the script has come to its end, 1 error, 2 wrong command line, 129, 130 "
         "or 143 stopped by SIGHUP, SIGINT or SIGTERM.\n";
}

}  // namespace furrow::coupling
