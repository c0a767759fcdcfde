// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for the lines of the script, the step and the grains' properties.

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "atom.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/base/time_step_check.h"
#include "coupling/checks/scene_checks.h"
#include "coupling/laboratory/fix_cell_servo.h"
#include "coupling/liggghts/access.h"
#include "coupling/liggghts/global_properties.h"
#include "fix_property_global.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double sub_steps_to_aim_at = 10;  // for the remedy
constexpr double shortest_step = 1e-9;      // [s] sound passes a micrometre of rock in it
// Of pairs of types; LIGGGHTS looks at the elastic ones itself.
constexpr const char* not_negative[] = {"coefficientFriction", "coefficientRollingFriction",
                                        "coefficientRollingViscousDamping",
                                        "cohesionEnergyDensity"};

bool is_whole_number(const std::string& word) {
  const std::string digits = word.substr(!word.empty() && (word[0] == '-' || word[0] == '+'));
  return !digits.empty() && std::all_of(digits.begin(), digits.end(),
                                        [](unsigned char letter) { return std::isdigit(letter); });
}

}  // namespace

Found run_has_whole_numbers(const Scene& scene) {
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

Found timestep_is_given(const Scene& scene) {
  if (scene.lammps.update->timestep_set || scene.lammps.modify->n_fixes_style("dt/reset") > 0)
    return {};
  return refusal("timestep",
                 fmt::format("is not given, and LIGGGHTS's own is {:g} s", scene.step()),
                 "a step that the scene chooses", "write 'timestep <seconds>' before the run");
}

Found timestep_is_no_zero(const Scene& scene) {
  if (scene.step() >= shortest_step) return {};
  return refusal("timestep", fmt::format("is {} s", scene.step()),
                 fmt::format("a number >= {:g} [s]", shortest_step),
                 "write 'timestep <seconds>' before the run");
}

Found sub_steps_are_few(const Scene& scene) {
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

/// Of grains that a wall/gran/body or a cell/servo holds.
Found step_suits_grains(const Scene& scene) {
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  for (const auto* wall : fixes_of<const FixWallGranBody>(modify))
    return check_time_step(scene.lammps, fmt::format("fix wall/gran/body '{}'", wall->id));
  for (const auto* cell : fixes_of<const FixCellServo>(modify))
    return check_time_step(scene.lammps, cell->name());
  return {};
}

Found properties_are_not_negative(const Scene& scene) {
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
