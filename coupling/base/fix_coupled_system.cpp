// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/fix_coupled_system.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "atom.h"
#include "core/error.h"
#include "coupling/base/bed_line.h"
#include "coupling/base/fix_order.h"
#include "coupling/base/keeps_state.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/base/furrow_fix.h"
#include "coupling/base/grain_check.h"
#include "coupling/liggghts/has_options.h"
#include "coupling/base/restart_record.h"
#include "coupling/base/uses_fix.h"
#include "coupling/liggghts/contact_history.h"
#include "coupling/liggghts/errors.h"
#include "coupling/liggghts/global_properties.h"
#include "coupling/liggghts/script.h"
#include "coupling/liggghts/stream_check.h"
#include "coupling/liggghts/style_registry.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr char system_id[] = "furrow_system";

/// A line each.
std::string names_of_restorable_fixes(const LAMMPS_NS::Modify& modify) {
  std::string names;
  for (const auto* fix : fixes_of<const KeepsState>(modify))
    if (fix->must_be_restored()) names += name_of(as_fix(*fix)) + '\n';
  return names;
}

/// A line each: id and values.
std::string text_of(const std::map<std::string, std::string>& properties) {
  std::string text;
  for (const auto& [id, values] : properties) text += id + ' ' + values + '\n';
  return text;
}

}  // namespace

const StyleRow system_style = fix_style<FixCoupledSystem>("furrow/system", "internal", "");

FixCoupledSystem::FixCoupledSystem(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      communicator_(&world),
      grain_forces_(*lammps),
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
  members_.push_back({&body, name});
  const auto restored = restored_works_.find(name);
  if (restored == restored_works_.end()) return;
  members_.back().work = restored->second.work;
  if (communicator_.rank() == 0) members_.back().work_of_step = restored->second.work_of_step;
}

void FixCoupledSystem::remove(const Body& body) {
  system_.remove(body);
  members_.erase(std::remove_if(members_.begin(), members_.end(),
                                [&](const Member& m) { return m.body == &body; }),
                 members_.end());
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

FixCoupledSystem::Member& FixCoupledSystem::member(const Body& body) {
  const auto found = std::find_if(members_.begin(), members_.end(),
                                  [&](const Member& m) { return m.body == &body; });
  if (found == members_.end())
    with_local_errors(*error, [] { throw Error("a requested body is in no system"); });
  return *found;
}

void FixCoupledSystem::pre_delete(bool unfixing) {
  if (unfixing) with_collective_errors(*error, [&] { forbid_removal_while_used(*modify, *this); });
}

int FixCoupledSystem::setmask() {
  using namespace LAMMPS_NS::FixConst;
  // PRE_EXCHANGE and PRE_FORCE: for the set-up
  return PRE_INITIAL_INTEGRATE | INITIAL_INTEGRATE | PRE_EXCHANGE | PRE_FORCE | FINAL_INTEGRATE |
         END_OF_STEP | POST_RUN;
}

/// Before the first neighbour lists: a position that is no number would crash them.
void FixCoupledSystem::init() {
  with_collective_errors(*error, [&] { check_fix_order(*modify, *this); });
  with_collective_errors(*error, [&] { check_restored_fixes(); });
  with_local_errors(*error, [&] { check_grains_finite(*lmp); });
  with_collective_errors(*error, [&] { scene_watch_->before_run(); });
}

/// What the checkpoint keeps and the script does not have is lost; what the script has and the
/// checkpoint does not, begins as its line says.
void FixCoupledSystem::check_restored_fixes() {
  if (checkpointed_fixes_.empty()) return;
  std::set<std::string> kept;
  std::istringstream lines(checkpointed_fixes_);
  for (std::string name; std::getline(lines, name);) kept.insert(name);
  for (const auto* fix : fixes_of<const KeepsState>(*modify)) {
    if (!fix->must_be_restored()) continue;
    const std::string name = name_of(as_fix(*fix));
    if (fix->restored())
      kept.erase(name);
    else
      warn(*lmp,
           fmt::format("{} has no state in the checkpoint: it starts as its line states", name));
  }
  if (!kept.empty())
    throw StateError(fmt::format(
        "the checkpoint has the state of {}, and the script that continues has no such line "
        "before its first run; write it there, with the same id and style",
        fmt::join(kept, ", ")));
  checkpointed_fixes_.clear();
  warn_of_changed_properties();
  warn_of_changed_controllers();
}

/// Properties of grains may be changed on purpose between two stages of a run.
void FixCoupledSystem::warn_of_changed_properties() {
  const std::map<std::string, std::string> now = global_properties(*lmp);
  std::istringstream lines(checkpointed_properties_);
  for (std::string property, values; lines >> property && std::getline(lines >> std::ws, values);)
    if (const auto found = now.find(property); found != now.end() && found->second != values)
      warn(*lmp, fmt::format("fix property/global '{}' is {}, and was {} when the checkpoint was "
                             "written: the run continues with these other values",
                             property, found->second, values));
}

/// Of those that keep no state: rigs. A line for each keyword: name of the fix, keyword, value.
std::string FixCoupledSystem::lines_of_controllers() const {
  std::string lines;
  for (const NamedController& each : controllers_) {
    const auto* fix = dynamic_cast<const FurrowFix*>(modify->find_fix_id(each.name.c_str()));
    if (!fix || fix->must_be_restored()) continue;
    for (const auto& [key, value] : fix->settings())
      lines += fmt::format("{}\t{}\t{}\n", fix->name(), key, value);
  }
  return lines;
}

/// A wheel may be driven in another way on purpose, in a second stage of a run.
void FixCoupledSystem::warn_of_changed_controllers() {
  std::map<std::string, std::map<std::string, std::string>> now;
  std::istringstream present(lines_of_controllers()), saved(checkpointed_controllers_);
  std::string fix, key, value;
  const auto read = [&](std::istringstream& lines) -> bool {
    return std::getline(lines, fix, '\t') && std::getline(lines, key, '\t') &&
           std::getline(lines, value);
  };
  while (read(present)) now[fix][key] = value;
  std::set<std::string> missing;
  while (read(saved)) {
    if (!now.count(fix))
      missing.insert(fix);
    else if (now[fix][key] != value)
      warn(*lmp, fmt::format("{}, keyword '{}' is {}, and was {} when the checkpoint was written: "
                             "the run continues as this line states",
                             fix, key, now[fix][key], value));
  }
  if (!missing.empty())
    warn(*lmp, fmt::format("the run of the checkpoint had {}, and the script that continues has no "
                           "such line: the run continues without",
                           fmt::join(missing, ", ")));
}

/// The checkpoint has the grains in the order in which the run without a break goes on to add up
/// their forces; the set-up would sort them.
void FixCoupledSystem::setup_pre_exchange() {
  if (forces_ == ForceState::restored) sort_interval_ = std::exchange(atom->sortfreq, 0);
}

void FixCoupledSystem::setup_pre_force(int) {
  has_run_ = true;
  const bool restored = forces_ == ForceState::restored;
  if (restored) {
    atom->sortfreq = sort_interval_;
    atom->nextsort = next_sort_;
  }
  for (Member& m : members_)
    if (restored && m.restored_forces.cols() == 0) m.restored_forces = m.body->surface().f;
  clear_forces();
  if (!restored) return;
  forces_ = ForceState::restored;
  saved_histories_.save(*lmp);
}

/// The forces of the last step before the checkpoint, in place of those that the set-up has made of
/// full-step velocities.
void FixCoupledSystem::pre_initial_integrate() {
  if (forces_ != ForceState::restored) return;
  clear_forces();
  grain_forces_.put_back();
  saved_histories_.put_back(*lmp);
  saved_histories_ = {};
  for (Member& m : members_) m.body->surface().f = m.restored_forces;
  system_.restore_published_contact_forces(restored_contact_forces_);
  forces_ = ForceState::complete;
}

void FixCoupledSystem::initial_integrate(int) {
  with_collective_errors(*error, [&] {
    // those of the set-up, made after this fix had its turn
    if (forces_ == ForceState::partial) sum_forces();
    for (const NamedController& each : controllers_) try {
        each.controller->apply(time_, update->dt);
      } catch (const StateError& problem) {
        throw StateError(fmt::format("fix {}: {}", each.name, problem.what()));
      }
    scene_watch_->after_step(advance_bodies());
    time_ += update->dt;
    clear_forces();
  });
}

/// @return sub-steps
int FixCoupledSystem::advance_bodies() try {
  const int sub_steps = system_.advance(update->dt);
  sub_steps_ += sub_steps;
  return sub_steps;
} catch (const StateError& problem) {
  throw StateError(problem.what() + scene_watch_->likely_cause());
}

void FixCoupledSystem::post_run() {
  with_collective_errors(*error, [&] {
    scene_watch_->after_run();
    check_streams(*lmp);
  });
}

void FixCoupledSystem::final_integrate() {
  with_collective_errors(*error, [&] {
    sum_forces();
    system_.publish_contact_forces();
    for (Member& m : members_) m.touched = m.touched || !m.body->surface().f.isZero(0.0);
  });
}

void FixCoupledSystem::end_of_step() {
  with_local_errors(*error, [&] { check_velocities_finite(*lmp); });
  for (Member& m : members_) m.work_of_step = work_of(m.contacts, *atom, update->dt);
}

void FixCoupledSystem::clear_forces() {
  system_.clear_forces();
  for (Member& m : members_) {
    const Surface& surface = m.body->surface();
    m.ledger = {};
    m.contacts.clear();
    if (surface.node_count() > 0) m.reference = surface.x.rowwise().mean();
  }
  forces_ = ForceState::partial;
}

void FixCoupledSystem::sum_forces() {
  for (Member& m : members_) m.ledger.work_before = std::exchange(m.work_of_step, {});
  if (communicator_.size() > 1) sum_over_ranks();
  for (Member& m : members_) {
    m.audit.add(m.ledger, m.body->surface(), m.reference, m.name, update->ntimestep);
    m.work += m.ledger.work_before;
  }
  forces_ = ForceState::complete;
}

/// One sum for all bodies: nodal forces and ledgers side by side.
void FixCoupledSystem::sum_over_ranks() {
  buffer_.clear();
  for (const Member& m : members_) {
    const Matrix3X& f = m.body->surface().f;
    buffer_.insert(buffer_.end(), f.data(), f.data() + f.size());
    const auto ledger = m.ledger.numbers();
    buffer_.insert(buffer_.end(), ledger.begin(), ledger.end());
  }
  communicator_.sum(buffer_.data(), buffer_.size());
  const double* next = buffer_.data();
  for (Member& m : members_) {
    Matrix3X& f = m.body->surface().f;
    std::copy(next, next + f.size(), f.data());
    next += f.size();
    m.ledger = ContactLedger::from(next);
    next += ContactLedger::size;
  }
}

/// Collective. In the middle of a run (command restart) forces and contact histories are those of
/// the last step; LIGGGHTS would write the histories as they were when the neighbour lists were
/// made. After a run (command write_restart) it brings them up to date itself, moves grains between
/// ranks without their forces, and a further run in this process computes them again as well.
void FixCoupledSystem::write_restart(FILE* file) {
  const bool in_run = update->whichflag == 1;
  if (in_run) {
    grain_forces_.store();
    update_contact_histories(*lmp);
  }
  gather_works_of_step();
  if (communicator_.rank() != 0) return;
  with_local_errors(*error, [&] {
    Checkpoint state(style);
    checkpoint(state, in_run, system_.published_contact_forces());
    write_record(file, state);
  });
}

void FixCoupledSystem::restart(char* buffer) {
  with_collective_errors(*error, [&] {
    Checkpoint state = read_record(style, buffer);
    checkpoint(state, false, {});
    state.finish();
    restored_ = true;
  });
}

/// @param in_run, contact_forces to be saved; what is read goes to the members
void FixCoupledSystem::checkpoint(Checkpoint& state, bool in_run,
                                  std::vector<double> contact_forces) {
  state.match("the parameters of the bed", bed_values(*lmp));
  state.value("time", time_);
  state.value("in_run", in_run);
  if (state.saving()) next_sort_ = atom->nextsort;
  state.value("next_sort", next_sort_);
  state.values("contact_forces", contact_forces);
  checkpoint_works(state);
  std::string fixes = names_of_restorable_fixes(*modify);
  state.value("fixes", fixes);
  std::string properties = text_of(global_properties(*lmp));
  state.value("properties", properties);
  std::string controllers = lines_of_controllers();
  state.value("controllers", controllers);
  if (state.saving()) return;
  checkpointed_fixes_ = fixes;
  checkpointed_properties_ = properties;
  checkpointed_controllers_ = controllers;
  if (in_run) forces_ = ForceState::restored;
  restored_contact_forces_ = std::move(contact_forces);
}

void FixCoupledSystem::checkpoint_works(Checkpoint& state) {
  std::string names;
  std::vector<double> numbers;
  for (const Member& m : members_) {
    names += m.name + '\n';
    for (const ContactWork& work : {m.work_of_step, m.work})
      for (const double number : work.numbers()) numbers.push_back(number);
  }
  state.value("bodies", names);
  state.values("contact_works", numbers);
  if (state.saving()) return;
  std::istringstream lines(names);
  const double* next = numbers.data();
  for (std::string name; std::getline(lines, name); next += 2 * ContactWork::size)
    restored_works_[name] = {ContactWork::from(next), ContactWork::from(next + ContactWork::size)};
}

/// Collective: from all ranks to the first, which writes the checkpoint.
void FixCoupledSystem::gather_works_of_step() {
  for (Member& m : members_) {
    auto numbers = m.work_of_step.numbers();
    communicator_.sum(numbers.data(), numbers.size());
    m.work_of_step = communicator_.rank() == 0 ? ContactWork::from(numbers.data()) : ContactWork();
  }
}

}  // namespace furrow::coupling
