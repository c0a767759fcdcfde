// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/bodies/fix_coupled_system.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/contact/grain_check.h"
#include "coupling/liggghts/errors.h"
#include "coupling/base/restart_record.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr char system_id[] = "furrow_system";
// of the force scale: round-off of the sums, nothing else
constexpr double momentum_tolerance = 1e-10;

}  // namespace

FixCoupledSystem::FixCoupledSystem(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), communicator_(&world), grain_forces_(*lammps) {
  restart_global = 1;
  nevery = 1;
}

FixCoupledSystem& FixCoupledSystem::of(LAMMPS_NS::LAMMPS& lammps) {
  if (LAMMPS_NS::Fix* existing = lammps.modify->find_fix_id(system_id))
    return dynamic_cast<FixCoupledSystem&>(*existing);
  std::string words[] = {system_id, "all", "furrow/system"};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data()};
  lammps.modify->add_fix(3, arguments);
  return of(lammps);
}

BodyFix& FixCoupledSystem::find_body(LAMMPS_NS::LAMMPS& lammps, const std::string& where,
                                     const std::string& fix_id) {
  auto* found = dynamic_cast<BodyFix*>(lammps.modify->find_fix_id(fix_id.c_str()));
  if (found) return *found;
  std::string known;
  for (int i = 0; i < lammps.modify->nfix; ++i)
    if (dynamic_cast<BodyFix*>(lammps.modify->fix[i]))
      known += (known.empty() ? "" : ", ") + std::string(lammps.modify->fix[i]->id);
  throw InputError(where, fmt::format("is '{}', and no body has that fix id", fix_id),
                   known.empty() ? "the id of a fix that makes a body" : "one of: " + known,
                   "write the fix that makes the body (such as wheel/rigid) before this line");
}

void FixCoupledSystem::add(Body& body, const std::string& name) {
  system_.add(body, name);
  members_.push_back({&body, name, {}, {}});
}

void FixCoupledSystem::remove(Body& body) {
  system_.remove(body);
  members_.erase(std::remove_if(members_.begin(), members_.end(),
                                [&](const Member& m) { return m.body == &body; }),
                 members_.end());
}

void FixCoupledSystem::remove(MotionController& controller) {
  controllers_.erase(std::remove(controllers_.begin(), controllers_.end(), &controller),
                     controllers_.end());
}

FixCoupledSystem::Member& FixCoupledSystem::member(const Body& body) {
  return *std::find_if(members_.begin(), members_.end(),
                       [&](const Member& m) { return m.body == &body; });
}
ContactLedger& FixCoupledSystem::ledger(const Body& body) { return member(body).ledger; }
const Vector3& FixCoupledSystem::moment_reference(const Body& body) {
  return member(body).reference;
}
const MomentumAudit& FixCoupledSystem::audit(const Body& body) { return member(body).audit; }
double FixCoupledSystem::contact_count(const Body& body) { return member(body).contacts; }

int FixCoupledSystem::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return PRE_INITIAL_INTEGRATE | INITIAL_INTEGRATE | PRE_FORCE | FINAL_INTEGRATE |
         END_OF_STEP;  // PRE_FORCE: for setup_pre_force
}

/// Before the first neighbour lists: a position that is no number would crash them.
void FixCoupledSystem::init() {
  with_local_errors(*error, [&] { check_grains_finite(*lmp); });
}

void FixCoupledSystem::setup_pre_force(int) {
  for (Member& m : members_)
    if (resumed_ && m.resumed_forces.cols() == 0) m.resumed_forces = m.body->surface().f;
  clear_forces();
}

/// The forces of the last step before the checkpoint, in place of those that the set-up has made of
/// full-step velocities.
void FixCoupledSystem::pre_initial_integrate() {
  if (!resumed_) return;
  resumed_ = false;
  clear_forces();
  grain_forces_.put_back();
  for (Member& m : members_) m.body->surface().f = m.resumed_forces;
  system_.restore_published_contact_forces(resumed_contact_forces_);
  summed_ = true;
}

void FixCoupledSystem::initial_integrate(int) {
  with_collective_errors(*error, [&] {
    if (!summed_) sum_forces();  // the forces of the set-up, made after this fix had its turn
    for (MotionController* controller : controllers_) controller->apply(time_, update->dt);
    system_.advance(update->dt);
    time_ += update->dt;
    clear_forces();
  });
}

void FixCoupledSystem::final_integrate() {
  with_collective_errors(*error, [&] {
    sum_forces();
    system_.publish_contact_forces();
  });
}

void FixCoupledSystem::end_of_step() {
  with_local_errors(*error, [&] { check_velocities_finite(*lmp); });
}

void FixCoupledSystem::clear_forces() {
  system_.clear_forces();
  for (Member& m : members_) {
    const Surface& surface = m.body->surface();
    m.ledger = {};
    if (surface.node_count() > 0) m.reference = surface.x.rowwise().mean();
  }
  summed_ = false;
}

/// One sum over ranks for all bodies: nodal forces and ledgers side by side.
void FixCoupledSystem::sum_forces() {
  summed_ = true;
  if (communicator_.size() > 1) {
    buffer_.clear();
    for (Member& m : members_) {
      const Matrix3X& f = m.body->surface().f;
      buffer_.insert(buffer_.end(), f.data(), f.data() + f.size());
      for (const Vector3* v : {&m.ledger.grain_force, &m.ledger.grain_moment, &m.ledger.lever_gap})
        buffer_.insert(buffer_.end(), v->data(), v->data() + 3);
      buffer_.insert(buffer_.end(),
                     {m.ledger.force_scale, m.ledger.moment_scale, m.ledger.contacts});
    }
    communicator_.sum(buffer_.data(), buffer_.size());
    const double* next = buffer_.data();
    for (Member& m : members_) {
      Matrix3X& f = m.body->surface().f;
      std::copy(next, next + f.size(), f.data());
      next += f.size();
      for (Vector3* v : {&m.ledger.grain_force, &m.ledger.grain_moment, &m.ledger.lever_gap}) {
        *v = Vector3(next[0], next[1], next[2]);
        next += 3;
      }
      m.ledger.force_scale = next[0];
      m.ledger.moment_scale = next[1];
      m.ledger.contacts = next[2];
      next += 3;
    }
  }
  for (Member& m : members_) check_momentum(m);
}

void FixCoupledSystem::check_momentum(Member& m) const {
  m.contacts = m.ledger.contacts;
  if (m.ledger.force_scale == 0.0) return;
  const Surface& surface = m.body->surface();
  const double force_imbalance = (surface.total_force() + m.ledger.grain_force).norm();
  const double moment_imbalance =
      (surface.total_moment(m.reference) + m.ledger.grain_moment).norm();
  const double force_defect = force_imbalance / m.ledger.force_scale,
               moment_defect = moment_imbalance / m.ledger.moment_scale;
  // Written so that NaN fails too.
  if (!(force_defect < momentum_tolerance) || !(moment_defect < momentum_tolerance))
    throw StateError(fmt::format(
        "body '{}': forces on its nodes and on the grains do not cancel at step {}: relative "
        "defect {:.3g} "
        "in force, {:.3g} in moment (limit {:g}); a contact force is not finite or was lost",
        m.name, update->ntimestep, force_defect, moment_defect, momentum_tolerance));
  m.audit.force_imbalance = std::max(m.audit.force_imbalance, force_imbalance);
  m.audit.force_scale = std::max(m.audit.force_scale, m.ledger.force_scale);
  m.audit.moment_imbalance = std::max(m.audit.moment_imbalance, moment_imbalance);
  m.audit.moment_scale = std::max(m.audit.moment_scale, m.ledger.moment_scale);
  m.audit.force = std::max(m.audit.force, force_defect);
  m.audit.moment = std::max(m.audit.moment, moment_defect);
  m.audit.lever_gap =
      std::max(m.audit.lever_gap, m.ledger.lever_gap.norm() / m.ledger.moment_scale);
}

/// Collective. In the middle of a run (command restart) forces and contact histories are those of
/// the last step; LIGGGHTS would write the histories as they were when the neighbour lists were
/// made. After a run (command write_restart) it brings them up to date itself, moves grains between
/// ranks without their forces, and a further run in this process computes them anew as well.
void FixCoupledSystem::write_restart(FILE* file) {
  const bool in_run = update->whichflag == 1;
  if (in_run) {
    grain_forces_.store();
    for (int i = 0; i < modify->nfix; ++i)
      if (modify->fix[i]->style == std::string("contacthistory"))
        modify->fix[i]->setup_pre_exchange();
  }
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
  });
}

/// @param in_run, contact_forces to be saved; what is read goes to resumed_,
/// resumed_contact_forces_
void FixCoupledSystem::checkpoint(Checkpoint& state, bool in_run,
                                  std::vector<double> contact_forces) {
  state.value("time", time_);
  state.value("in_run", in_run);
  state.values("contact_forces", contact_forces);
  if (state.saving()) return;
  resumed_ = in_run;
  resumed_contact_forces_ = std::move(contact_forces);
}

}  // namespace furrow::coupling
