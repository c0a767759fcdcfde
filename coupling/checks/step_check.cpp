// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/step_check.h"

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double sub_steps_to_aim_at = 10;  // for the remedy
constexpr double shortest_step = 1e-9;      // [s] sound passes a micrometre of rock in it

}  // namespace

void check_step_length(const LAMMPS_NS::LAMMPS& lammps) {
  if (!lammps.update->timestep_set && lammps.modify->n_fixes_style("dt/reset") == 0)
    throw InputError("timestep",
                     fmt::format("is not given, and LIGGGHTS's own is {:g} s", lammps.update->dt),
                     "a step that the scene chooses", "write 'timestep <seconds>' before the run");
  if (!(lammps.update->dt >= shortest_step))
    throw InputError("timestep", fmt::format("is {} s", lammps.update->dt),
                     fmt::format("a number >= {:g} [s]", shortest_step),
                     "write 'timestep <seconds>' before the run");
}

std::string check_sub_steps(LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  const CoupledSystem::StepLimit limit = FixCoupledSystem::of(lammps).step_limit();
  const double step = lammps.update->dt, sub_steps = step / limit.step;
  if (sub_steps <= many_sub_steps) return "";
  const std::string finding = fmt::format(
      "a step of {:.4g} s takes {:.3g} sub-steps of body '{}', whose stable step is "
      "{:.3g} s",
      step, sub_steps, limit.body, limit.step);
  const std::string remedy =
      fmt::format("write 'timestep {:.1g}', or make the body's elements or cells larger",
                  sub_steps_to_aim_at * limit.step);
  if (!(sub_steps <= CoupledSystem::max_sub_steps))
    throw InputError("timestep", fmt::format("is {:.4g} s: {}", step, finding),
                     fmt::format("at most {:g} sub-steps", CoupledSystem::max_sub_steps), remedy);
  warn(fmt::format("{}: the run will be slow; {}", finding, remedy));
  return fmt::format("{}; {}", finding, remedy);
}

}  // namespace furrow::coupling
