// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/fix_coupled_system.h"

#include <algorithm>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/error.h"
#include "coupling/base/bed_line.h"
#include "coupling/base/roles/fix_order.h"
#include "coupling/base/checks/grain_check.h"
#include "coupling/base/restart_record.h"
#include "coupling/base/roles/fix_user.h"
#include "coupling/liggghts/errors/errors.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/errors/stream_check.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr char system_id[] = "furrow_system";

}  // namespace

const StyleRow system_style = fix_style<FixCoupledSystem>("furrow/system", "internal", "");

FixCoupledSystem::FixCoupledSystem(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      communicator_(&world),
      grain_loads_(communicator_),
      restored_forces_(*lammps),
      continued_lines_(*lammps),
      scene_watch_(watch_scene(*lammps)) {
  if (id != std::string(system_id) || narg > 3)
    throw InputError("fix furrow/system", "is written in the script", "no such line",
                     "remove it: the fix of the first body makes it");
  restart_global = 1;
  nevery = 1;
}

FixCoupledSystem& FixCoupledSystem::of(LAMMPS_NS::LAMMPS& lammps) {
  if (FixCoupledSystem* existing = find(lammps)) return *existing;
  return dynamic_cast<FixCoupledSystem&>(add_fix(lammps, {system_id, "all", "furrow/system"}));
}

FixCoupledSystem* FixCoupledSystem::find(LAMMPS_NS::LAMMPS& lammps) {
  return dynamic_cast<FixCoupledSystem*>(lammps.modify->find_fix_id(system_id));
}

void FixCoupledSystem::add(Body& body, const std::string& name) {
  system_.add(body, name);
  grain_loads_.add(body, name);
}

void FixCoupledSystem::remove(const Body& body) {
  system_.remove(body);
  grain_loads_.remove(body);
}

void FixCoupledSystem::add(MotionController& controller, const std::string& name) {
  controllers_.push_back({&controller, name});
}

void FixCoupledSystem::remove(const MotionController& controller) {
  controllers_.erase(
      std::remove_if(controllers_.begin(), controllers_.end(),
                     [&](const NamedController& c) { return c.controller == &controller; }),
      controllers_.end());
}

GrainLoad& FixCoupledSystem::load(const Body& body) {
  GrainLoad* found = grain_loads_.find(body);
  if (!found) with_local_errors(*error, [] { throw Error("a requested body is in no system"); });
  return *found;
}

std::vector<std::string> FixCoupledSystem::names_of_controllers() const {
  std::vector<std::string> names;
  for (const NamedController& each : controllers_) names.push_back(each.name);
  return names;
}

void FixCoupledSystem::pre_delete(bool unfixing) {
  if (unfixing) with_collective_errors(*error, [&] { forbid_removal_while_used(*modify, *this); });
}

int FixCoupledSystem::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return PRE_INITIAL_INTEGRATE | INITIAL_INTEGRATE | PRE_EXCHANGE | PRE_FORCE | FINAL_INTEGRATE |
         END_OF_STEP | POST_RUN;
}

// ---- a run: checks and set-up
// --------------------------------------------------------------------

/// Before the first neighbour lists: a position that is no number would crash them.
void FixCoupledSystem::init() {
  with_collective_errors(*error, [&] {
    check_fix_order(*modify, *this);
    continued_lines_.check(names_of_controllers());
  });
  with_local_errors(*error, [&] { check_grains_finite(*lmp); });
  with_collective_errors(*error, [&] { scene_watch_->before_run(); });
}

void FixCoupledSystem::setup_pre_exchange() { restored_forces_.suspend_sorting(); }

void FixCoupledSystem::setup_pre_force(int) {
  has_run_ = true;
  restored_forces_.keep(grain_loads_);
  clear_forces();
}

// ---- one step
// ------------------------------------------------------------------------------------

void FixCoupledSystem::pre_initial_integrate() {
  if (!restored_forces_.waiting()) return;
  clear_forces();
  restored_forces_.put_back(system_);
  forces_complete_ = true;
}

void FixCoupledSystem::initial_integrate(int) {
  with_collective_errors(*error, [&] {
    // forces of the set-up, which LIGGGHTS computes after this fix
    if (!forces_complete_) sum_and_audit_forces();
    set_loads_and_motions();
    advance_bodies();
    clear_forces();
  });
}

void FixCoupledSystem::final_integrate() {
  with_collective_errors(*error, [&] {
    sum_and_audit_forces();
    system_.publish_contact_forces();
    grain_loads_.mark_touched_bodies();
  });
}

void FixCoupledSystem::end_of_step() {
  with_local_errors(*error, [&] { check_velocities_finite(*lmp); });
  grain_loads_.find_works(*atom, update->dt);
}

void FixCoupledSystem::post_run() {
  with_collective_errors(*error, [&] {
    scene_watch_->after_run();
    check_streams(*lmp);
  });
}

// ---- parts of a step
// -----------------------------------------------------------------------------

void FixCoupledSystem::set_loads_and_motions() {
  for (const NamedController& each : controllers_) try {
      each.controller->apply(time_, update->dt);
    } catch (const StateError& problem) {
      throw StateError(fmt::format("fix {}: {}", each.name, problem.what()));
    }
}

void FixCoupledSystem::advance_bodies() {
  int sub_steps = 0;
  try {
    sub_steps = system_.advance(update->dt);
  } catch (const StateError& problem) {
    throw StateError(problem.what() + scene_watch_->likely_cause());
  }
  sub_steps_ += sub_steps;
  scene_watch_->after_step(sub_steps);
  time_ += update->dt;
}

void FixCoupledSystem::clear_forces() {
  system_.clear_forces();
  grain_loads_.begin_step();
  forces_complete_ = false;
}

void FixCoupledSystem::sum_and_audit_forces() {
  grain_loads_.sum_over_ranks();
  grain_loads_.audit(update->ntimestep);
  forces_complete_ = true;
}

// ---- restart files
// -------------------------------------------------------------------------------

/// Collective. After a run (command write_restart) LIGGGHTS brings contact histories up to date
/// itself and moves grains between ranks without their forces; a further run in this process
/// computes the forces again as well.
void FixCoupledSystem::write_restart(FILE* file) {
  const bool in_run = update->whichflag == 1;
  if (in_run) restored_forces_.store();
  grain_loads_.gather_works_of_step();
  if (communicator_.rank() != 0) return;
  with_local_errors(*error, [&] {
    Checkpoint state(style);
    checkpoint(state, in_run);
    write_record(file, state);
  });
}

void FixCoupledSystem::restart(char* buffer) {
  with_collective_errors(*error, [&] {
    Checkpoint state = read_record(style, buffer);
    checkpoint(state, false);
    state.finish();
    restored_ = true;
  });
}

/// @param in_run to be saved
void FixCoupledSystem::checkpoint(Checkpoint& state, bool in_run) {
  state.match("the parameters of the bed", bed_values(*lmp));
  state.value("time", time_);
  restored_forces_.checkpoint(state, in_run, system_);
  grain_loads_.checkpoint(state);
  continued_lines_.checkpoint(state, names_of_controllers());
}

}  // namespace furrow::coupling
