// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/wheels/fix_tyre.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/styles/script.h"
#include "furrow/tyre/tyre_parameters.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double min_pressure = 1e3;  // [Pa] of any tyre, with room
// Radius of gyration of a rim, and what turns with it, over the radius of its beads.
constexpr double min_gyration = 0.05, max_gyration = 30.0;
constexpr int max_sub_steps = 4;  // in a step on grains, shown to be quiet: fix_tyre_darnell.md

}  // namespace

void declare_file_and_pressure(Schema& schema) {
  schema.text("file", "tyre file, relative to the script")
      .may_change();  // of place and name: checkpoints compare what is in it
  schema
      .number("pressure", "Pa", Range::non_negative(),
              "inflation pressure, 1e3 to 2e6; by default that of the tyre file")
      .optional();
}

void declare_damping(Schema& schema) {
  schema
      .number("damping", "1/s", Range::non_negative(),
              "damping rate of the tyre's motion relative to the rim")
      .by_default(100.0);
}

std::string tyre_path(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  return (std::filesystem::path(script_folder(lammps)) / options.text("file")).string();
}

/// Pressure in Pa; values in psi, bar or kPa are refused by their size.
double read_pressure(const Options& options, double of_file) {
  const double pressure = options.has("pressure") ? options.number("pressure") : of_file;
  if (pressure < min_pressure || pressure > largest_inflation)
    throw InputError(options.where("pressure"), fmt::format("is {:g} Pa", pressure),
                     fmt::format("{:g} to {:g} Pa", min_pressure, largest_inflation),
                     "35 psi, 2.41 bar and 241 kPa are 241e3 Pa; a tyre without pressure is not "
                     "modelled");
  return pressure;
}

void inflate(const Options& options, Tyre& tyre) {
  try {
    tyre.settle(nullptr);
  } catch (const StateError& problem) {
    throw InputError(options.where("pressure"),
                     fmt::format("is {:g} Pa, at which the tyre does not come to rest: {}",
                                 tyre.pressure(), problem.what()),
                     "a pressure that its carcass holds",
                     "lower it, or check the stiffnesses of the tyre file");
  }
}

/// Tread and sidewalls turn the rim back and forth in the steps of the tread.
void check_rim(const Options& options, const HubParameters& hub, double bead_radius) {
  if (options.flag("half") && hub.centre.y() != 0.0)
    throw InputError(options.where("axle"),
                     fmt::format("has y = {} m with a half model", hub.centre.y()),
                     "y = 0: the plane of symmetry");
  const double usual = hub.inertia.mass * bead_radius * bead_radius,
               least = min_gyration * min_gyration * usual,
               most = max_gyration * max_gyration * usual;
  if (!(hub.inertia.axial >= least && hub.inertia.axial <= most))
    throw InputError(options.where("inertia"), fmt::format("is {:g} kg m^2", hub.inertia.axial),
                     fmt::format("{:.3g} to {:.3g} kg m^2", least, most),
                     fmt::format("a rim of {:g} kg at {:g} m has about {:.3g} kg m^2",
                                 hub.inertia.mass, bead_radius, usual));
}

/// An explicit damping of the rate c is stable up to c dt = 1.
void check_damping(const Options& options, double stable_step) {
  if (options.number("damping") * stable_step > 1.0)
    throw InputError(options.where("damping"),
                     fmt::format("is {:g} 1/s", options.number("damping")),
                     fmt::format("at most {:.2g} 1/s with this mesh", 1.0 / stable_step),
                     "20 to 200 1/s is the range of rubber's losses");
}

const Outputs<FixTyre>& FixTyre::outputs() {
  using Fix = FixTyre;
  static const Outputs<Fix> list = {
      {"deflection", "m", "rise of the tread's lowest node above the unloaded tread",
       [](Fix& fix) { return fix.tyre().deflection(); }},
      {"pressure", "Pa", "present inflation pressure",
       [](Fix& fix) { return fix.tyre().pressure(); }},
      {"section_width", "m", "largest width of the section",
       [](Fix& fix) { return fix.tyre().section_width(); }},
      {"tread_energy", "J", "elastic energy of the tread; both halves of a half model",
       [](Fix& fix) { return fix.tyre().tread_energy(); }},
      {"sidewall_chord", "", "longest sidewall chord over the sidewall length",
       [](Fix& fix) { return fix.tyre().largest_sidewall_chord(); }},
  };
  return list;
}

FixTyre::FixTyre(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
                 const MakeHub& make_tyre)
    : FixWheelHub(lammps, narg, arg, schema, make_tyre) {
  provide(outputs());
}

/// Line by line, so that an error names the value of the tyre file that differs.
void FixTyre::checkpoint(Checkpoint& state) {
  std::istringstream lines(tyre_text());
  for (std::string line; std::getline(lines, line);)
    state.match("line '" + line.substr(0, line.find(':')) + "' of the tyre file", line);
  FixBody::checkpoint(state);
}

/// Grain forces that come only once in many sub-steps may feed energy into a light tread:
/// fix_tyre_darnell.md.
void FixTyre::init() {
  const double stable = tyre().stable_time_step();
  if (find_user(*modify, "mesh/body", *this) && update->dt > max_sub_steps * stable)
    warn(*lmp,
         fmt::format("{}: the time step {:.3g} s is more than {} of the tyre's own, {:.3g} s; "
                     "grain forces come once a step and may shake the tread: choose a step "
                     "of at most {:.2g} s",
                     name(), update->dt, max_sub_steps, stable, max_sub_steps * stable));
}

}  // namespace furrow::coupling
