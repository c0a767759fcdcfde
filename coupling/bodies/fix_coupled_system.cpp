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

constexpr char world_id[] = "furrow_world";
// of the force scale: round-off of the sums, nothing else
constexpr double momentum_tolerance = 1e-10;

}  // namespace

FixWorld::FixWorld(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), communicator_(&world), grain_forces_(*lammps) {
  restart_global = 1;
  nevery = 1;
}

FixWorld& FixWorld::of(LAMMPS_NS::LAMMPS& lammps) {
  if (LAMMPS_NS::Fix* existing = lammps.modify->find_fix_id(world_id))
    return dynamic_cast<FixWorld&>(*existing);
  std::string words[] = {world_id, "all", "furrow/world"};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data()};
  lammps.modify->add_fix(3, arguments);
  return of(lammps);
}

BodyFix& FixWorld::find_body(LAMMPS_NS::LAMMPS& lammps, const std::string& where,
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

void FixWorld::add(Body& body, const std::string& name) {
  world_.add(body, name);
  members_.push_back({&body, name, {}, {}});
}

void FixWorld::remove(Body& body) {
  world_.remove(body);
  members_.erase(std::remove_if(members_.begin(), members_.end(),
                                [&](const Member& m) { return m.body == &body; }),
                 members_.end());
}

void FixWorld::remove(Driver& driver) {
  drivers_.erase(std::remove(drivers_.begin(), drivers_.end(), &driver), drivers_.end());
}

FixWorld::Member& FixWorld::member(const Body& body) {
  return *std::find_if(members_.begin(), members_.end(),
                       [&](const Member& m) { return m.body == &body; });
}
ContactLedger& FixWorld::ledger(const Body& body) { return member(body).ledger; }
const Vector3& FixWorld::moment_reference(const Body& body) { return member(body).reference; }
const MomentumAudit& FixWorld::audit(const Body& body) { return member(body).audit; }
double FixWorld::contact_count(const Body& body) { return member(body).contacts; }

int FixWorld::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return PRE_INITIAL_INTEGRATE | INITIAL_INTEGRATE | PRE_FORCE | FINAL_INTEGRATE |
         END_OF_STEP;  // PRE_FORCE: for setup_pre_force
}

/// Before the first neighbour lists: a position that is no number would crash them.
void FixWorld::init() {
  guarded_alone(*error, [&] { check_grains_finite(*lmp); });
}

void FixWorld::setup_pre_force(int) {
  for (Member& m : members_)
    if (resumed_ && m.resumed_forces.cols() == 0) m.resumed_forces = m.body->surface().f;
  clear_forces();
}

/// The forces of the last step before the checkpoint, in place of those that the set-up has made of
/// full-step velocities.
void FixWorld::pre_initial_integrate() {
  if (!resumed_) return;
  resumed_ = false;
  clear_forces();
  grain_forces_.put_back();
  for (Member& m : members_) m.body->surface().f = m.resumed_forces;
  world_.restore_shown_forces(resumed_shown_);
  summed_ = true;
}

void FixWorld::initial_integrate(int) {
  guarded(*error, [&] {
    if (!summed_) sum_forces();  // the forces of the set-up, made after this fix had its turn
    for (Driver* driver : drivers_) driver->apply(time_, update->dt);
    world_.advance(update->dt);
    time_ += update->dt;
    clear_forces();
  });
}

void FixWorld::final_integrate() {
  guarded(*error, [&] {
    sum_forces();
    world_.show_interaction_forces();
  });
}

void FixWorld::end_of_step() {
  guarded_alone(*error, [&] { check_velocities_finite(*lmp); });
}

void FixWorld::clear_forces() {
  world_.clear_forces();
  for (Member& m : members_) {
    const Surface& surface = m.body->surface();
    m.ledger = {};
    if (surface.node_count() > 0) m.reference = surface.x.rowwise().mean();
  }
  summed_ = false;
}

/// One sum over ranks for all bodies: nodal forces and ledgers side by side.
void FixWorld::sum_forces() {
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

void FixWorld::check_momentum(Member& m) const {
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
void FixWorld::write_restart(FILE* file) {
  const bool in_run = update->whichflag == 1;
  if (in_run) {
    grain_forces_.store();
    for (int i = 0; i < modify->nfix; ++i)
      if (modify->fix[i]->style == std::string("contacthistory"))
        modify->fix[i]->setup_pre_exchange();
  }
  if (communicator_.rank() != 0) return;
  std::vector<double> state = world_.shown_forces();
  state.insert(state.begin(), {time_, in_run ? 1.0 : 0.0, static_cast<double>(state.size())});
  write_record(file, state);
}

void FixWorld::restart(char* buffer) {
  const auto* state = reinterpret_cast<const double*>(buffer);
  time_ = state[0];
  resumed_ = state[1] != 0.0;
  resumed_shown_.assign(state + 3, state + 3 + static_cast<std::size_t>(state[2]));
}

}  // namespace furrow::coupling
