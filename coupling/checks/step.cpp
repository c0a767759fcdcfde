// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for the lines of the script, the step and the grains' properties.

#include <algorithm>
#include <cctype>
#include <limits>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/base/checks/high_friction.h"
#include "coupling/base/loads/snow_pairs.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/base/checks/time_step_check.h"
#include "coupling/checks/scene_checks.h"
#include "coupling/laboratory/fix_cell_servo.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/data/global_properties.h"
#include "fix_property_global.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double sub_steps_to_aim_at = 10;  // for the remedy
constexpr double shortest_step = 1e-9;      // [s] sound passes a micrometre of rock in it
// [kg/m3] of single grains: light foam, steel, and ice
constexpr double lightest_grain = 10, heaviest_grain = 8000, density_of_ice = 920;
// Properties of pairs of types; LIGGGHTS checks the elastic ones itself.
constexpr const char* not_negative[] = {"coefficientFriction", "coefficientRollingFriction",
                                        "coefficientRollingViscousDamping",
                                        "cohesionEnergyDensity"};

bool is_whole_number(const std::string& word) {
  const std::string digits = word.substr(!word.empty() && (word[0] == '-' || word[0] == '+'));
  return !digits.empty() && std::all_of(digits.begin(), digits.end(),
                                        [](unsigned char letter) { return std::isdigit(letter); });
}

/// Checks the interval of a fix that acts once in so many steps. A script of many short runs may
/// mean it.
CheckResult interval_fits(const Scene& scene, const Options& options,
                          const std::string& consequence) {
  const long every = options.integer("every"), steps = scene.lammps.update->nsteps;
  if (every <= steps) return {};
  return warning(fmt::format("{} is {} steps, and this run has {}: {}; write a smaller number",
                             options.where("every"), every, steps, consequence));
}

}  // namespace

CheckResult run_has_whole_numbers(const Scene& scene) {
  const std::vector<std::string> words = current_command(scene.lammps);
  if (words.empty() || words[0] != "run") return {};
  // Behind "every" and its number come commands.
  const auto last = std::find(words.begin(), words.end(), "every");
  for (auto word = words.begin(); word + 1 < last; ++word) {
    if (*word != "run" && *word != "start" && *word != "stop") continue;
    const std::string& number = *(word + 1);
    if (!is_whole_number(number))
      return refusal("run", fmt::format("has '{}' for a number of steps", number),
                     "a whole number in digits", "write 100000, not 1e5 nor 1e5.0");
  }
  return {};
}

CheckResult timestep_is_given(const Scene& scene) {
  if (scene.lammps.update->timestep_set || scene.lammps.modify->n_fixes_style("dt/reset") > 0)
    return {};
  return refusal("timestep",
                 fmt::format("is not given, and LIGGGHTS's own is {:g} s", scene.step()),
                 "a step that the scene chooses", "write 'timestep <seconds>' before the run");
}

CheckResult timestep_is_no_zero(const Scene& scene) {
  if (scene.step() >= shortest_step) return {};
  return refusal("timestep", fmt::format("is {} s", scene.step()),
                 fmt::format("a number >= {:g} [s]", shortest_step),
                 "write 'timestep <seconds>' before the run");
}

CheckResult sub_steps_are_few(const Scene& scene) {
  const CoupledSystem::StepLimit limit = FixCoupledSystem::of(scene.lammps).step_limit();
  const double step = scene.step(), sub_steps = step / limit.step;
  if (sub_steps <= many_sub_steps) return {};
  const std::string finding = fmt::format(
      "a step of {:.4g} s takes {:.3g} sub-steps of body '{}', whose stable step is "
      "{:.3g} s",
      step, sub_steps, limit.body, limit.step);
  const std::string remedy =
      fmt::format("write 'timestep {:.1g}', or make the body's elements or cells larger",
                  sub_steps_to_aim_at * limit.step);
  if (!(sub_steps <= CoupledSystem::max_sub_steps))
    return refusal("timestep", fmt::format("is {:.4g} s: {}", step, finding),
                   fmt::format("at most {:g} sub-steps", CoupledSystem::max_sub_steps), remedy);
  Finding slow = warning(fmt::format("{}: the run will be slow; {}", finding, remedy));
  slow.explains_errors = true;
  return slow;
}

/// Checks grains that a wall/gran/body or a cell/servo holds.
CheckResult step_suits_grains(const Scene& scene) {
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  for (const auto* wall : fixes_of<const FixWallGranBody>(modify))
    return check_time_step(scene.lammps, fmt::format("fix wall/gran/body '{}'", wall->id));
  for (const auto* cell : fixes_of<const FixCellServo>(modify))
    return check_time_step(scene.lammps, cell->name());
  return {};
}

CheckResult grain_work_looks_in_the_run(const Scene& scene, const FixGrainWork& work) {
  return interval_fits(scene, work.options(), "it counts no work");
}

CheckResult arc_is_written_in_the_run(const Scene& scene, const FixWheelArc& arc) {
  return interval_fits(scene, arc.options(), "it writes no profile");
}

CheckResult friction_is_a_coefficient(const Scene& scene) {
  const int types = scene.lammps.atom->ntypes;
  for (const char* name : {"coefficientFriction", "coefficientRollingFriction"}) {
    auto* property = property_of_pairs(scene.lammps, name);
    if (!property) continue;
    const double* const* values = property->get_array();
    for (int a = 0; a < types; ++a)
      for (int b = 0; b < types; ++b)
        if (is_high_friction(values[a][b]))
          return warning(high_friction(
              fmt::format("fix property/global '{}', {}", property->id, name), values[a][b]));
  }
  return {};
}

CheckResult grains_have_the_density_of_matter(const Scene& scene) {
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  if (scene.grains == 0.0) return {};
  double lightest = std::numeric_limits<double>::infinity(), heaviest = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) {
    lightest = std::min(lightest, atom.density[i]);
    heaviest = std::max(heaviest, atom.density[i]);
  }
  const Communicator ranks(&scene.lammps.world);
  lightest = -ranks.max(-lightest);
  heaviest = ranks.max(heaviest);
  const bool snow = grains_are_snow(scene.lammps);
  const double most = snow ? density_of_ice : heaviest_grain;
  if (lightest >= lightest_grain && heaviest <= most) return {};
  return warning(fmt::format(
      "the grains have densities of {:.4g} to {:.4g} kg/m3, and {} has {:g} to {:g} kg/m3; give "
      "kg/m3, not g/cm3 nor N/m3",
      lightest, heaviest, snow ? "snow" : "solid matter", lightest_grain, most));
}

CheckResult properties_are_not_negative(const Scene& scene) {
  const int types = scene.lammps.atom->ntypes;
  for (const char* name : not_negative) {
    auto* property = property_of_pairs(scene.lammps, name);
    if (!property) continue;
    const double* const* values = property->get_array();
    for (int a = 0; a < types; ++a)
      for (int b = 0; b < types; ++b)
        if (!(values[a][b] >= 0.0))
          return refusal(fmt::format("fix property/global '{}', {}", property->id, name),
                         fmt::format("is {:g} for types {} and {}", values[a][b], a + 1, b + 1),
                         "numbers >= 0");
  }
  return {};
}

}  // namespace furrow::coupling
