// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/scene_checks.h"

#include <fmt/format.h>

#include "coupling/liggghts/fixes_of.h"
#include "coupling/checks/box_check.h"
#include "coupling/checks/grain_motion_check.h"
#include "coupling/checks/grain_place_check.h"
#include "coupling/checks/ground_level_check.h"
#include "coupling/checks/lost_grains_check.h"
#include "coupling/checks/properties_check.h"
#include "coupling/checks/resolution_check.h"
#include "coupling/checks/run_command_check.h"
#include "coupling/checks/schedule_check.h"
#include "coupling/checks/speed_check.h"
#include "coupling/checks/step_check.h"
#include "coupling/checks/touch_check.h"
#include "coupling/contact/fix_wall_gran_body.h"
#include "coupling/contact/time_step_check.h"
#include "coupling/liggghts/script.h"
#include "update.h"

namespace furrow::coupling {

SceneChecks::SceneChecks(LAMMPS_NS::LAMMPS& lammps) : lammps_(lammps), box_(edges_of_box(lammps)) {}

void SceneChecks::say(const std::string& warning) {
  if (said_.insert(warning).second) warn(lammps_, warning);
}

void SceneChecks::after_step(int sub_steps) {
  const Warn warn = [this](const std::string& text) { say(text); };
  if (first_step_) {
    check_weight(lammps_, warn);
    warn_of_grains_without_floor(lammps_, warn);
  }
  first_step_ = false;
  if (slow_step_.empty() && sub_steps > many_sub_steps) slow_step_ = check_sub_steps(lammps_, warn);
}

std::string SceneChecks::likely_cause() const {
  return slow_step_.empty() ? "" : fmt::format("; a likely cause: {}", slow_step_);
}

void SceneChecks::after_run() {
  warn_of_lost_grains(lammps_, grains_, [this](const std::string& text) { say(text); });
}

void SceneChecks::before_run() {
  const Warn warn = [this](const std::string& text) { say(text); };
  grains_ = count_grains(lammps_);
  first_step_ = true;
  check_run_command(lammps_);
  check_mesh_walls(lammps_);
  check_mesh_motion(lammps_);
  if (lammps_.update->nsteps == 0) return;  // a set-up: the scene may not be complete yet
  check_step_length(lammps_);
  for (const auto* wall : fixes_of<const FixWallGranBody>(*lammps_.modify))
    check_time_step(lammps_, fmt::format("fix wall/gran/body '{}'", wall->id));
  check_contact_properties(lammps_);
  slow_step_ = check_sub_steps(lammps_, warn);
  warn_of_changed_box(lammps_, box_, warn);
  check_grain_motion(lammps_, warn);
  check_grains_in_terrain(lammps_, warn);
  warn_of_bodies_that_touch_nothing(lammps_, warn);
  warn_of_bodies_in_one_place(lammps_, warn);
  warn_of_planes_in_terrain(lammps_, warn);
  check_schedules(lammps_, warn);
  check_ground_under_bodies(lammps_, warn);
  check_speeds(lammps_, warn);
  check_ground_levels(lammps_, warn);
}

}  // namespace furrow::coupling
