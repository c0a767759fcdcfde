// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/command_bed.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <mpi.h>

#include "comm.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/liggghts/script.h"
#include "coupling/terrain/bed_facts.h"
#include "domain.h"
#include "input.h"
#include "io/cache.h"
#include "io/version.h"
#include "signal_handling.h"

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

constexpr char line_variable[] = "furrow_bed";  // holds the words of the line, one on each line
constexpr char no_checkpoint[] = "none";

/// Of a parameter that was renamed.
std::string current_name(const std::string& name) {
  return name == "headroom" ? "clearance_above" : name;
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path);
  if (!file)
    throw InputError("command bed", fmt::format("cannot read '{}'", path.string()),
                     "the path of a script that makes a bed",
                     "give it relative to the folder of the main script");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The lines of a bed script between "#: <name>" and the next "#: ".
std::string section(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find("#: " + name + "\n");
  if (begin == std::string::npos)
    throw InputError("command bed", fmt::format("finds no line '#: {}' in the script", name),
                     "sections '#: box', '#: contact', '#: settle'");
  return text.substr(begin, text.find("\n#: ", begin) - begin);
}

/// "command processors": 0 leaves the number of ranks along an axis to LIGGGHTS.
std::string processors_line(const int (&grid)[3]) {
  std::string line = "processors";
  for (const int ranks : grid) line += ranks ? fmt::format(" {}", ranks) : " *";
  return line;
}

}  // namespace

Schema CommandBed::schema() {
  Schema schema("command bed");
  schema.text("script", "path of the script that makes the bed, relative to the main script");
  schema.number("depth", "m", Range::positive(), "the bed is levelled at this height");
  schema.text("from", "restart file of a run on this bed, to continue that run; `none`: begin")
      .by_default(no_checkpoint);
  return schema;
}

OutputTable CommandBed::outputs() { return {"variable", bed_outputs().channels()}; }

std::string CommandBed::Request::identity() const {
  std::string all = version() + "\n" + text;
  for (const Parameter& p : parameters) all += "\n" + p.name + " " + p.value;
  return all;
}

CommandBed::KeptBed::KeptBed(const Request& request)
    : restart(cache_folder() / ("bed-" + content_hash(request.identity()) + ".restart")),
      facts(fs::path(restart).replace_extension(".txt")) {}

void CommandBed::command(int narg, char** arg) {
  // The words live in the buffer of the line being parsed, which other commands overwrite.
  const std::vector<std::string> words(arg, arg + narg);
  if (domain->box_exist)
    throw InputError("command bed", "comes after the simulation box was made",
                     "bed before create_box, read_restart or read_data",
                     "move the line up: the bed brings its own box");
  const Request request = read_request(words);
  set_parameters(request);
  const KeptBed bed(request);
  if (!is_kept(bed)) make(request, bed);
  MPI_Barrier(world);
  read(request, bed);
}

CommandBed::Request CommandBed::read_request(const std::vector<std::string>& words) {
  if (words.size() % 2 == 0)
    throw InputError("command bed", fmt::format("has {} words", words.size()),
                     "bed <script> <name> <value> <name> <value> ...",
                     "every parameter of the bed needs a value");
  std::vector<Entry> entries = {{"script", {words[0]}}};
  Request request;
  for (std::size_t i = 1; i < words.size(); i += 2) {
    const std::string& name = words[i];
    const std::string& value = words[i + 1];
    if (name == "depth" || name == "from") entries.push_back({name, {value}});
    if (name != "from") request.parameters.push_back({current_name(name), value, name});
  }
  const Options options = schema().read(entries);
  request.script = fs::path(script_folder(*lmp)) / options.text("script");
  request.text = read_file(request.script);
  request.depth = options.number("depth");
  request.from = options.text("from");
  return request;
}

/// Each becomes a variable with bed_ before its name; of a former name too, which a bed script may
/// still read.
void CommandBed::set_parameters(const Request& request) {
  std::string line = "script\n" + request.script.string();
  for (const Parameter& p : request.parameters) {
    set_variable(*lmp, "bed_" + p.name, p.value);
    line += "\n" + p.name + "\n" + p.value;
    if (p.written == p.name) continue;
    set_variable(*lmp, "bed_" + p.written, p.value);
    warn(*lmp, fmt::format("command bed: parameter '{}' is now called '{}'; write '{} {}'",
                           p.written, p.name, p.name, p.value));
  }
  set_variable(*lmp, line_variable, line);
}

bool CommandBed::is_kept(const KeptBed& bed) {
  int kept = comm->me == 0 && fs::exists(bed.restart) && fs::exists(bed.facts);
  MPI_Bcast(&kept, 1, MPI_INT, 0, world);
  return kept;
}

void CommandBed::make(const Request& request, const KeptBed& bed) {
  if (comm->me == 0 && screen)
    fmt::print(screen, "Making the bed {} (kept in {})\n", request.script.string(),
               bed.restart.parent_path().string());
  const int grid[3] = {comm->user_procgrid[0], comm->user_procgrid[1], comm->user_procgrid[2]};
  // before the minutes that a bed takes: a folder that cannot be made is an error now
  if (comm->me == 0) fs::create_directories(bed.restart.parent_path());
  for (const char* name : {"box", "contact", "settle"}) run_section(request, name);
  // A termination signal ends every run at once and lets the script go on: what came of it is no
  // bed, and must not be kept for others.
  if (Communicator(&world).any(LAMMPS_NS::SignalHandler::request_quit))
    throw StateError(
        "command bed was interrupted while it made the bed, which is not kept; start the script "
        "again");
  keep(request, bed);
  input->one("clear");
  input->one(processors_line(grid).c_str());
}

/// Both files take their names when they are whole.
void CommandBed::keep(const Request& request, const KeptBed& bed) {
  const BedFacts facts = measure_bed(*lmp, request.depth);
  const std::string part =
      fmt::format("{}.part{}", bed.restart.string(), static_cast<long>(facts.grains));
  input->one(("write_restart " + part).c_str());
  if (comm->me != 0) return;
  fs::rename(part, bed.restart);
  std::ofstream file(bed.facts);
  const std::vector<Channel> names = bed_outputs().channels();
  const std::vector<double> values = bed_outputs().values(facts);
  for (std::size_t n = 0; n < names.size(); ++n)
    file << fmt::format("{} {:.10g}\n", names[n].name, values[n]);
  file << "\n# made by:\n" << request.identity() << '\n';
}

/// The bed, or the checkpoint of a run on it, with its contact properties and facts.
void CommandBed::read(const Request& request, const KeptBed& bed) {
  // read_restart keeps the setting of the moment, and contact history needs it off
  input->one("newton off");
  input->one(
      ("read_restart " + (request.from == no_checkpoint ? bed.restart.string() : request.from))
          .c_str());
  run_section(request, "contact");
  std::ifstream file(bed.facts);
  std::string name, value;
  while (file >> name >> value && name[0] != '#') set_variable(*lmp, name, value);
}

/// Line by line, so that this command can go on when the section has ended: no jumps, loops or
/// labels inside.
void CommandBed::run_section(const Request& request, const std::string& name) {
  std::istringstream lines(section(request.text, name));
  std::string line, whole;
  while (std::getline(lines, line)) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    if (end != std::string::npos && line[end] == '&') {
      whole += line.substr(0, end) + " ";
      continue;
    }
    whole += line;
    input->one(whole.c_str());
    whole.clear();
  }
}

std::vector<std::pair<std::string, std::string>> bed_line(LAMMPS_NS::LAMMPS& lammps) {
  std::vector<std::pair<std::string, std::string>> words;
  std::istringstream line(variable(lammps, line_variable).value_or(""));
  std::string name, value;
  while (std::getline(line, name) && std::getline(line, value)) words.emplace_back(name, value);
  return words;
}

}  // namespace furrow::coupling
