// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/styles/script.h"

#include <filesystem>
#include <fstream>

#include <mpi.h>
#include <unistd.h>

#include <fmt/format.h>

#include "comm.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/driver.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "input.h"
#include "modify.h"
#include "variable.h"

namespace furrow::coupling {

namespace {

/// Number of the line that the stream has just been read up to; 0 when it is unknown (standard
/// input).
long line_number(FILE* file) {
  const long position = file ? std::ftell(file) : -1;
  if (position < 0 || file == stdin) return 0;
  std::rewind(file);
  long lines = 0;
  int last = '\n';
  for (long i = 0; i < position; ++i) {
    last = std::fgetc(file);
    lines += last == '\n';
  }
  std::fseek(file, position, SEEK_SET);
  return lines + (last != '\n');
}

std::string file_name(FILE* file) {
  char path[4096];
  const ssize_t length =
      readlink(fmt::format("/proc/self/fd/{}", fileno(file)).c_str(), path, sizeof path - 1);
  return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : "input script";
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  return pointers;
}

}  // namespace

std::string script_position(const LAMMPS_NS::LAMMPS& lammps) {
  if (!lammps.input || !lammps.infile) return "";
  const char* text = current_line(lammps);
  const long line = line_number(lammps.infile);
  if (line == 0) return text ? fmt::format("standard input: {}", text) : "";
  return fmt::format("{}, line {}: {}", file_name(lammps.infile), line, text ? text : "");
}

std::string script_name(const LAMMPS_NS::LAMMPS& lammps) {
  return lammps.infile && lammps.infile != stdin ? file_name(lammps.infile) : "";
}

std::string script_folder(const LAMMPS_NS::LAMMPS& lammps) {
  int rank = 0;
  MPI_Comm_rank(lammps.world, &rank);
  return broadcast(
      rank == 0 ? std::filesystem::path(script_name(lammps)).parent_path().string() : "",
      lammps.world);
}

std::vector<ScriptLine> later_lines(const LAMMPS_NS::LAMMPS& lammps) {
  std::vector<ScriptLine> lines;
  const long present = lammps.infile ? line_number(lammps.infile) : 0;
  if (present == 0) return lines;
  std::ifstream file(script_name(lammps));
  bool continues = false;
  std::string line;
  for (long number = 1; std::getline(file, line); ++number) {
    if (number <= present) continue;
    const std::size_t end = line.find_last_not_of(" \t\r");
    const bool more = end != std::string::npos && line[end] == '&';
    if (more) line.erase(end);
    if (continues)
      lines.back().text += line;
    else
      lines.push_back({number, line});
    continues = more;
  }
  return lines;
}

std::string script_text_problem(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(1 << 16, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  const std::string start = text.substr(0, 2);
  if (start == "\xFF\xFE" || start == "\xFE\xFF") return "is written in UTF-16";
  if (text.find('\0') != std::string::npos) return "has bytes of value 0: it is no text";
  if (text.find('\r') != std::string::npos && text.find('\n') == std::string::npos)
    return "has lines that end with CR alone: all of it is one line";
  return "";
}

void check_include(const LAMMPS_NS::LAMMPS& lammps) {
  constexpr int deepest = 50;
  const std::vector<std::string> words = current_command(lammps);
  if (words.size() != 2) return;  // LIGGGHTS refuses that
  on_first_rank(lammps.world, [&] {
    const std::string where = fmt::format("command include, file '{}'", words[1]);
    if (open_scripts(lammps) > deepest)
      throw InputError(where, fmt::format("stands within {} files that include another", deepest),
                       "files that do not include themselves",
                       "remove the line, or end the loop by an 'if' with 'jump'");
    if (const std::string problem = script_text_problem(words[1]); !problem.empty())
      throw InputError(where, problem, "a text in UTF-8 whose lines end with LF or CR LF",
                       "save it so in an editor");
  });
}

LAMMPS_NS::Fix& add_fix(LAMMPS_NS::LAMMPS& lammps, std::vector<std::string> words) {
  std::vector<char*> arguments = pointers_to(words);
  lammps.modify->add_fix(static_cast<int>(arguments.size()), arguments.data());
  return *lammps.modify->find_fix_id(words[0].c_str());
}

void add_compute(LAMMPS_NS::LAMMPS& lammps, std::vector<std::string> words) {
  if (lammps.modify->find_compute(words[0].c_str()) >= 0) return;
  std::vector<char*> arguments = pointers_to(words);
  lammps.modify->add_compute(static_cast<int>(arguments.size()), arguments.data());
}

void set_variable(LAMMPS_NS::LAMMPS& lammps, std::string name, std::string value) {
  std::vector<std::string> words = {std::move(name), "string", std::move(value)};
  std::vector<char*> arguments = pointers_to(words);
  lammps.input->variable->set(static_cast<int>(arguments.size()), arguments.data());
}

std::optional<std::string> variable(LAMMPS_NS::LAMMPS& lammps, std::string name) {
  if (lammps.input->variable->find(name.data()) < 0) return std::nullopt;
  const char* value = lammps.input->variable->retrieve(name.data());
  return value ? std::optional<std::string>(value) : std::nullopt;
}

void announce(LAMMPS_NS::LAMMPS& lammps, const std::string& text) {
  if (lammps.comm->me != 0) return;
  for (FILE* stream : {lammps.screen, lammps.logfile}) {
    if (!stream) continue;
    std::fprintf(stream, "%s\n", text.c_str());
    std::fflush(stream);  // a run that then takes for ever has said why
  }
}

void warn(LAMMPS_NS::LAMMPS& lammps, const std::string& text) {
  announce(lammps, "WARNING: " + text);
  if (driver() && lammps.comm->me == 0) driver()->warned(text);
}

}  // namespace furrow::coupling
