// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/command_bed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/liggghts/access.h"
#include "domain.h"
#include "input.h"
#include "io/cache.h"
#include "io/version.h"
#include "signal_handling.h"
#include "update.h"
#include "variable.h"

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

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

}  // namespace

void CommandBed::set_variable(const std::string& name, const std::string& value) {
  std::string words[] = {name, "string", value};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data()};
  input->variable->set(3, arguments);
}

/// Line by line, so that this command can go on when the script has ended: no jumps, loops or
/// labels inside.
void CommandBed::run_script(const std::string& text) {
  std::istringstream lines(text);
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

std::map<std::string, double> CommandBed::measure(double depth) {
  const Communicator ranks(&world);
  // Away from the floor and from the levelled surface, where packing is disturbed over a few
  // grains.
  const double bottom = domain->boxlo[2], low = bottom + 0.2 * depth, high = bottom + 0.8 * depth;
  // mass, solid volume in the slice, mass in the slice, kinetic energy
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  double extremes[4] = {1e300, 1e300, -1e300, -1e300};
  for (int i = 0; i < atom->nlocal; ++i) {
    const double z = atom->x[i][2], r = atom->radius[i];
    sums[0] += atom->rmass[i];
    for (int k = 0; k < 3; ++k) sums[3] += 0.5 * atom->rmass[i] * atom->v[i][k] * atom->v[i][k];
    for (int k = 0; k < 2; ++k) {
      extremes[k] = std::min(extremes[k], atom->x[i][k] - r);
      extremes[2 + k] = std::max(extremes[2 + k], atom->x[i][k] + r);
    }
    // Part of the sphere between two planes: volume below height t above its lowest point is pi t^2
    // (r - t/3).
    const auto below = [&](double plane) {
      const double t = std::clamp(plane - (z - r), 0.0, 2.0 * r);
      return M_PI * t * t * (r - t / 3.0);
    };
    const double volume = below(high) - below(low);
    sums[1] += volume;
    sums[2] += volume * atom->density[i];
  }
  ranks.sum(sums, 4);
  for (double& extreme : extremes)
    extreme = &extreme < extremes + 2 ? -ranks.max(-extreme) : ranks.max(extreme);
  double side[2];
  for (int k = 0; k < 2; ++k)
    side[k] = (k == 0 ? domain->xperiodic : domain->yperiodic) ? domain->prd[k]
                                                               : extremes[2 + k] - extremes[k];
  const double area = side[0] * side[1], bulk = sums[2] / (area * (high - low));
  return {{"bed_grains", static_cast<double>(atom->natoms)},
          {"bed_solid_fraction", sums[1] / (area * (high - low))},
          {"bed_bulk_density", bulk},
          // top of a uniform bed of this density and the same mass
          {"bed_level", bottom + sums[0] / (area * bulk)},
          {"bed_kinetic_energy", sums[3]},
          {"bed_settle_steps", static_cast<double>(update->ntimestep)}};
}

void CommandBed::command(int narg, char** arg) {
  // The words live in the buffer of the line being parsed, which other commands overwrite.
  const std::vector<std::string> words(arg, arg + narg);
  if (words.size() < 1 || words.size() % 2 == 0)
    throw InputError("command bed", fmt::format("has {} words", words.size()),
                     "bed <script> <name> <value> <name> <value> ...",
                     "every parameter of the bed needs a value");
  if (domain->box_exist)
    throw InputError("command bed", "comes after the simulation box was made",
                     "bed before create_box, read_restart or read_data",
                     "move the line up: the bed brings its own box");

  const fs::path script = fs::path(script_folder(*lmp)) / words[0];
  const std::string text = read_file(script);
  std::string identity = version() + "\n" + text;
  double depth = 0.0;
  std::string from = "none";  // a checkpoint of a run on this bed
  for (std::size_t i = 1; i < words.size(); i += 2) {
    if (words[i] == "from") {
      from = words[i + 1];
      continue;
    }
    identity += "\n" + words[i] + " " + words[i + 1];
    set_variable("bed_" + words[i], words[i + 1]);
    if (words[i] == "depth") depth = std::strtod(words[i + 1].c_str(), nullptr);
  }
  if (!(depth > 0.0))
    throw InputError("command bed, parameter 'depth'", "is missing or not positive",
                     "depth and a number > 0 [m]",
                     "the bed is levelled at this height above the floor");

  const fs::path folder = cache_folder(),
                 restart = folder / ("bed-" + content_hash(identity) + ".restart");
  fs::path facts_path = restart;
  facts_path.replace_extension(".txt");
  int kept = comm->me == 0 && fs::exists(restart) && fs::exists(facts_path);
  MPI_Bcast(&kept, 1, MPI_INT, 0, world);

  if (!kept) {
    if (comm->me == 0 && screen)
      fmt::print(screen, "Making the bed {} (kept in {})\n", script.string(), folder.string());
    const int grid[3] = {comm->user_procgrid[0], comm->user_procgrid[1], comm->user_procgrid[2]};
    if (comm->me == 0) fs::create_directories(folder);
    for (const char* name : {"box", "contact", "settle"}) run_script(section(text, name));
    // A termination signal ends every run at once and lets the script go on: what came of it is no
    // bed, and must not be kept for others.
    if (Communicator(&world).max(LAMMPS_NS::SignalHandler::request_quit ? 1.0 : 0.0) > 0.0)
      throw StateError(
          "command bed was interrupted while it made the bed, which is not kept; start the script "
          "again");
    const std::map<std::string, double> facts = measure(depth);
    const std::string part =
        fmt::format("{}.part{}", restart.string(), static_cast<long>(facts.at("bed_grains")));
    input->one(("write_restart " + part).c_str());
    if (comm->me == 0) {
      fs::rename(part, restart);
      std::ofstream file(facts_path);
      for (const auto& [name, value] : facts)
        file << name << ' ' << fmt::format("{:.10g}", value) << '\n';
      file << "\n# made by:\n" << identity << '\n';
    }
    input->one("clear");
    const auto choice = [](int n) { return n ? std::to_string(n) : std::string("*"); };
    input->one(
        ("processors " + choice(grid[0]) + " " + choice(grid[1]) + " " + choice(grid[2])).c_str());
  }
  MPI_Barrier(world);
  // read_restart keeps the setting of the moment, and contact history needs it off
  input->one("newton off");
  input->one(("read_restart " + (from == "none" ? restart.string() : from)).c_str());
  run_script(section(text, "contact"));
  std::ifstream file(facts_path);
  std::string name, value;
  while (file >> name >> value && name[0] != '#') set_variable(name, value);
}

}  // namespace furrow::coupling
