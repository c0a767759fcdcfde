// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/command_bed.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>
#include <unistd.h>

#include "comm.h"
#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/core/gravity.h"
#include "furrow/io/inputs/contact_section.h"
#include "furrow/core/types.h"
#include "coupling/base/bed_line.h"
#include "coupling/liggghts/checkpoint_file.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "coupling/terrain/bed/later_lines.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/errors/signals.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/terrain/bed/bed_choice.h"
#include "coupling/terrain/bed/bed_facts.h"
#include "coupling/terrain/bed/bed_limits.h"
#include "domain.h"
#include "input.h"
#include "furrow/io/files/cache.h"
#include "furrow/io/files/sealed_file.h"
#include "furrow/io/files/version.h"

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

constexpr char no_checkpoint[] = "none";

/// Line "processors": 0 leaves the number of ranks along an axis to LIGGGHTS.
std::string processors_line(const int (&grid)[3]) {
  std::string line = "processors";
  for (const int ranks : grid) line += ranks ? fmt::format(" {}", ranks) : " *";
  return line;
}

/// Text of the parameters: "length 0.2, width 0.1", equal for equal beds.
std::string values_of(const Options& options, const BedSurface& surface) {
  Schema relief("");
  declare_relief(relief);
  std::vector<std::string> words;
  for (const Key& key : options.keys()) {
    if (key.name == "script" || key.name == "from" || key.name == "heightmap" ||
        !options.has(key.name) || (surface.flat() && relief.find(key.name)))
      continue;
    if (key.kind == Key::Kind::numbers)
      words.push_back(fmt::format("{} {}", key.name, fmt::join(options.numbers(key.name), " ")));
    else if (key.kind == Key::Kind::number)
      words.push_back(fmt::format("{} {}", key.name, options.number(key.name)));
    else
      words.push_back(key.name + " " + options.text(key.name));
  }
  if (const std::string map = surface.map_checksum(); !map.empty())
    words.push_back("heightmap " + map);
  return fmt::format("{}", fmt::join(words, ", "));
}

/// @throws InputError for a script that makes no bed with a relief
void check_script(const BedScript& script, const BedSurface& surface) {
  if (surface.flat() || (script.leaves_levelling() && script.reads_highest())) return;
  throw InputError(
      fmt::format("command bed: script '{}'", script.path().string()),
      "levels the bed by itself, and the line has a relief",
      "a script that pours up to ${bed_highest} and has a section '#: levelled'",
      "change it as inputs/beds/sand.lig has it, or remove the keywords of the relief");
}

/// Names and values of a line; several values are joined by a blank.
BedWords words_of(const std::vector<std::string>& words, const Schema& keys) {
  BedWords line;
  const auto at = [&](std::size_t word) {
    return words.begin() + static_cast<std::ptrdiff_t>(word);
  };
  for (std::size_t i = 1; i < words.size();) {
    const Key* key = keys.find(words[i]);
    const std::size_t count = key && key->kind == Key::Kind::numbers ? key->count : 1;
    if (i + count >= words.size())
      throw InputError("command bed", fmt::format("has no value for '{}'", words[i]),
                       "bed <script> <name> <value> <name> <value> ...",
                       "every parameter of the bed needs a value");
    line.emplace_back(words[i], fmt::format("{}", fmt::join(at(i + 1), at(i + 1 + count), " ")));
    i += 1 + count;
  }
  return line;
}

std::vector<std::string> split(const std::string& text) {
  std::istringstream all(text);
  return {std::istream_iterator<std::string>(all), {}};
}

/// A command with a path, which may have blanks.
std::string quoted(const char* command, const fs::path& path) {
  return fmt::format("{} \"{}\"", command, path.string());
}

/// Makes a folder in the place of what has its name; a link is removed and not followed.
void make_new_folder(const fs::path& folder) {
  std::error_code failed;
  fs::remove_all(folder, failed);
  if (!fs::create_directory(folder, failed))
    throw Error(fmt::format("command bed: the folder {} cannot be made ({})", folder.string(),
                            failed ? failed.message() : "something has its name"));
}

/// Makes the folder, and a file in it for a moment. @throws InputError
void check_folder(const fs::path& folder) {
  const fs::path trial = folder / fmt::format("trial{}", getpid());
  try {
    write_sealed_text(trial, "");
    fs::remove(trial);
  } catch (const std::exception& problem) {
    throw InputError(fmt::format("command bed: the folder for beds, '{}',", folder.string()),
                     fmt::format("cannot be used: {}", problem.what()),
                     "a folder that can be written",
                     "name one in the environment variable FURROW_CACHE");
  }
}

}  // namespace

const StyleRow bed_style = command_style<CommandBed>("bed", "terrain/bed/command_bed.md");

Schema CommandBed::schema() {
  Schema schema("command bed");
  schema.text("script",
              "first argument, without the keyword: path of the bed script, relative to the file "
              "with the line");
  schema.number("depth", "m", Range::positive(),
                "height above the floor at which the bed is levelled");
  schema.number("gravity", "m/s^2", admissible_gravity(), "in which the bed settles, downwards")
      .by_default(standard_gravity);
  declare_relief(schema);
  schema
      .text("contact",
            "file with the friction of the grains with steel and rubber; path relative to the "
            "script")
      .optional();
  schema.text("from", "checkpoint of a run on this bed, to continue that run; `none`: start")
      .by_default(no_checkpoint);
  return schema;
}

OutputTable CommandBed::outputs() { return {"variable", bed_outputs().channels()}; }

std::string CommandBed::Request::identity() const {
  const std::string layout =
      "3";  // version of the stored layout; beds of other versions cannot be read
  std::string all = version() + " " + layout + "\n" + script.text();
  for (const Parameter& p : parameters)
    all += "\n" + p.name + " " + (p.name == "heightmap" ? surface.map_checksum() : p.value);
  return all;
}

std::string CommandBed::KeptBed::problem() const {
  for (const fs::path& file : {restart(), facts()}) {
    const SealCheck check = check_seal(file);
    if (check.state != SealCheck::State::whole)
      return fmt::format("'{}' {}", file.string(), check.problem);
  }
  return "";
}

void CommandBed::KeptBed::require_trusted() const {
  std::error_code absent;
  if (!fs::is_directory(folder.parent_path(), absent)) return;
  for (const fs::path& path : {folder.parent_path(), folder, restart(), facts()})
    if (const std::string reason = distrust(path); !reason.empty())
      throw InputError(
          fmt::format("command bed: '{}'", path.string()), reason,
          "a cache folder, and beds in it, that you own and others cannot write",
          "remove it, or name another folder in the environment variable FURROW_CACHE");
}

void CommandBed::command(int narg, char** arg) {
  // The words live in the buffer of the line being parsed, which other commands overwrite.
  const std::vector<std::string> words(arg, arg + narg);
  if (domain->box_exist)
    throw InputError("command bed", "comes after the simulation box was made",
                     "bed before create_box, read_restart or read_data",
                     "move the line up: the bed brings its own box");
  const Request request = read_request(words);
  if (request.from != no_checkpoint) check_checkpoint(*lmp, find_checkpoint(*lmp, request.from));
  set_parameters(request);
  const KeptBed bed(cache_folder() / ("bed-" + content_hash(request.identity())));
  on_first_rank(world, [&] { bed.require_trusted(); });
  if (!is_kept(bed)) make(request, bed);
  read(request, bed);
}

CommandBed::Request CommandBed::read_request(const std::vector<std::string>& words) {
  need(!words.empty(), "command bed", "has no arguments",
       "bed <script> <name> <value> <name> <value> ...");
  BedScript script(fs::path(script_folder(*lmp)) / words[0]);
  Schema keys = schema();
  script.declare_parameters(keys);
  BedWords line = words_of(words, keys);
  const std::string chosen = choose_bed_values(line);
  if (!chosen.empty()) announce(*lmp, "Chosen for the bed: " + chosen);
  std::vector<Entry> entries = {{"script", {words[0]}}};
  std::vector<Parameter> parameters;
  for (const auto& [written, value] : line) {
    const std::string name = current_name(written);
    const Key* key = keys.find(name);
    const bool several = key && key->kind == Key::Kind::numbers;
    entries.push_back({name, several ? split(value) : std::vector<std::string>{value}});
    if (name != "from" && name != "contact") parameters.push_back({name, value, written});
  }
  const Options options = keys.read(entries);
  set_contact(options);
  if (!options.given("gravity"))  // gravity is a parameter of every bed and part of its identity
    parameters.push_back({"gravity", fmt::format("{}", options.number("gravity")), "gravity"});
  check_bed_parameters(options);
  BedSurface surface(options, script_folder(*lmp));
  check_script(script, surface);
  for (const std::string& warning : bed_warnings(options)) warn(*lmp, warning);
  for (const std::string& warning : surface.warnings()) warn(*lmp, warning);
  const std::string values = values_of(options, surface);
  return {std::move(script), std::move(surface), options.text("from"), std::move(parameters),
          values};
}

/// The friction with each material of a body becomes a variable, bed_friction_steel.
void CommandBed::set_contact(const Options& options) {
  if (!options.has("contact")) return;
  const std::string path = (fs::path(script_folder(*lmp)) / options.text("contact")).string();
  std::vector<std::string> limited;
  for (const auto& [material, contact] : read_contact_file(path)) {
    if (std::isfinite(contact.shear_limit)) limited.push_back(material);
    set_variable(*lmp, "bed_friction_" + material, fmt::format("{:.15g}", contact.friction));
    announce(*lmp, fmt::format("Friction of the grains with {}: {:g} ({:g} to {:g}), {}; {}",
                               material, contact.friction, contact.friction_range[0],
                               contact.friction_range[1], contact.label, contact.source));
  }
  if (!limited.empty())
    warn(*lmp, fmt::format("{}: the shear_limit that '{}' has for {} has no effect on grains; use "
                           "contact/continuum for adhesion, or remove it from the file",
                           options.where("contact"), options.text("contact"),
                           fmt::join(limited, " and ")));
}

/// Sets a variable with bed_ before its name for each parameter; also for a former name, which a
/// bed script may still read.
void CommandBed::set_parameters(const Request& request) {
  BedLine line = {{"script", request.script.path().string()}};
  for (const Parameter& p : request.parameters) {
    set_variable(*lmp, "bed_" + p.name, p.value);
    line.emplace_back(p.name, p.value);
    if (p.written == p.name) continue;
    set_variable(*lmp, "bed_" + p.written, p.value);
    warn(*lmp, fmt::format("command bed: parameter '{}' is now called '{}'; write '{} {}'",
                           p.written, p.name, p.name, p.value));
  }
  set_variable(*lmp, "bed_highest", fmt::format("{:.15g}", request.surface.highest()));
  set_bed_line(*lmp, line, request.values);
}

/// True for a bed that is kept whole; a damaged one is made again.
bool CommandBed::is_kept(const KeptBed& bed) {
  int kept = 0;
  if (comm->me == 0 && fs::exists(bed.folder)) {
    const std::string problem = bed.problem();
    kept = problem.empty();
    if (!kept)
      warn(*lmp, fmt::format("command bed: the kept bed's file {}; it is made again", problem));
  }
  MPI_Bcast(&kept, 1, MPI_INT, 0, world);
  return kept;
}

void CommandBed::make(const Request& request, const KeptBed& bed) {
  if (comm->me == 0 && screen)
    fmt::print(screen, "Making the bed {} (kept in {})\n", request.script.path().string(),
               bed.folder.parent_path().string());
  const int grid[3] = {comm->user_procgrid[0], comm->user_procgrid[1], comm->user_procgrid[2]};
  // the check comes before the minutes that a bed takes
  on_first_rank(world, [&] { check_folder(bed.folder.parent_path()); });
  check_later_lines(*lmp);
  {
    const NoCheckpointOnSignal nothing_to_continue;
    run_section(request, "box");
    request.surface.check_period(*lmp);
    for (const char* name : {"contact", "settle"}) run_section(request, name);
    if (request.script.leaves_levelling()) {
      remove_surplus(*lmp, request.surface);
      run_section(request, "levelled");
    }
  }
  // A signal that came before: what came of it is no bed, and must not be kept for others.
  if (agreed_signal())
    throw StateError(
        "command bed was interrupted while it made the bed, which is not kept; start the script "
        "again");
  keep(request, bed);
  input->one("clear");
  input->one(processors_line(grid).c_str());
}

/// Writes the bed under another name first: another run may be making the same bed.
void CommandBed::keep(const Request& request, const KeptBed& bed) {
  const BedFacts facts = measure_bed(*lmp, request.surface);
  check_bed(facts, request.surface);
  std::string text;
  const std::vector<Channel> names = bed_outputs().channels();
  const std::vector<double> values = bed_outputs().values(facts);
  for (std::size_t n = 0; n < names.size(); ++n)
    text += fmt::format("{} {:.10g}\n", names[n].name, values[n]);
  text += "\n# made by:\n" + request.identity() + '\n';

  const KeptBed part(broadcast(fmt::format("{}.part{}", bed.folder.string(), getpid()), world));
  on_first_rank(world, [&] { make_new_folder(part.folder); });
  input->one(quoted("write_restart", part.restart()).c_str());
  on_first_rank(world, [&] {
    write_sealed_text(part.facts(), text);
    std::error_code failed;
    if (!bed.problem().empty()) fs::remove_all(bed.folder, failed);
    fs::rename(part.folder, bed.folder, failed);
    if (failed) fs::remove_all(part.folder);  // another run has made the bed
    if (const std::string problem = bed.problem(); !problem.empty())
      throw Error("command bed: the bed is not kept: " + problem);
  });
}

/// The bed, or the checkpoint of a run on it, with its contact properties and facts.
void CommandBed::read(const Request& request, const KeptBed& bed) {
  // read_restart keeps the setting of the moment, and contact history needs it off
  input->one("newton off");
  const bool begins = request.from == no_checkpoint;
  input->one(quoted("read_restart", begins ? bed.restart() : fs::path(request.from)).c_str());
  run_section(request, "contact");
  std::ifstream file(bed.facts());
  std::string name, value;
  while (file >> name >> value && name[0] != '#') {
    set_variable(*lmp, name, value);
    if (name == "bed_surface_rms")
      if (const std::string warning = request.surface.settled_warning(std::stod(value));
          !warning.empty())
        warn(*lmp, warning);
  }
}

/// Runs the section line by line, so that the command continues after it.
void CommandBed::run_section(const Request& request, const std::string& name) {
  for (const std::string& command : request.script.commands(name)) input->one(command.c_str());
}

}  // namespace furrow::coupling
