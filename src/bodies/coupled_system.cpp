// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/coupled_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

void CoupledSystem::remove(const Body& body) {
  members_.erase(std::remove_if(members_.begin(), members_.end(),
                                [&](const Member& member) { return member.body == &body; }),
                 members_.end());
}

void CoupledSystem::remove(const Contact& contact) {
  contacts_.erase(std::remove_if(contacts_.begin(), contacts_.end(),
                                 [&](const Named& named) { return named.contact == &contact; }),
                  contacts_.end());
}

int CoupledSystem::advance(double interval) {
  const int sub_steps = sub_steps_of(interval);
  const double dt = interval / sub_steps;
  begin_interval(sub_steps);
  for (int i = 0; i < sub_steps; ++i) {
    apply_contacts(dt);
    if (!contacts_.empty())
      for (Member& m : members_) m.contact_force += m.body->surface().f / sub_steps;
    advance_bodies(dt);
    for (Member& m : members_) m.body->surface().f.setZero();
  }
  end_interval();
  return sub_steps;
}

int CoupledSystem::sub_steps_of(double interval) const {
  if (!(std::isfinite(interval) && interval > 0.0))
    throw StateError(fmt::format("the system cannot advance by {} s", interval));
  const StepLimit limit = step_limit();
  if (!(limit.step * max_sub_steps >= interval))
    throw StateError(
        fmt::format("body '{}': its stable time step is {} s, less than {:g} of the interval {} s; "
                    "an element has collapsed or a stiffness has grown without bound",
                    limit.body, limit.step, 1.0 / max_sub_steps, interval));
  return std::max(1, static_cast<int>(std::ceil(interval / limit.step)));
}

CoupledSystem::StepLimit CoupledSystem::step_limit() const {
  StepLimit limit{std::numeric_limits<double>::infinity(), ""};
  for (const Member& member : members_) {
    const double stable = member.body->stable_time_step();
    if (std::isnan(stable)) return {stable, member.name};
    if (stable < limit.step) limit = {stable, member.name};
  }
  return limit;
}

/// Begins an interval: the forces of others become one impulse in the first sub-step.
void CoupledSystem::begin_interval(int sub_steps) {
  for (Member& m : members_) {
    Matrix3X& f = m.body->surface().f;
    if (published_) f -= m.contact_force;
    m.external_force = f;
    f *= sub_steps;
    if (!contacts_.empty()) m.contact_force.setZero(3, f.cols());
    m.body->begin_interval(!contacts_.empty());
  }
  published_ = false;
}

/// Leaves the forces of others on the surfaces as they were, and in contact_force the contacts'
/// mean alone: the sum over sub-steps had the impulse in it.
void CoupledSystem::end_interval() {
  for (Member& m : members_) {
    if (!contacts_.empty()) m.contact_force -= m.external_force;
    m.body->surface().f = m.external_force;
    m.body->end_interval();
  }
}

void CoupledSystem::apply_contacts(double dt) {
  for (const Named& named : contacts_) try {
      named.contact->apply(dt);
    } catch (const StateError& error) {
      throw StateError(fmt::format("contact '{}': {}", named.name, error.what()));
    }
}

void CoupledSystem::advance_bodies(double dt) {
  for (const Member& member : members_) {
    try {
      member.body->advance(dt);
    } catch (const StateError& error) {
      throw StateError(fmt::format("body '{}': {}", member.name, error.what()));
    }
    member.body->surface().check_finite(member.name);
  }
}

void CoupledSystem::clear_forces() {
  for (const Member& m : members_) m.body->surface().clear_forces();
  published_ = false;
}

void CoupledSystem::publish_contact_forces() {
  if (published_ || contacts_.empty()) return;
  for (Member& m : members_)
    if (m.contact_force.cols() == m.body->surface().f.cols())
      m.body->surface().f += m.contact_force;
    else
      m.contact_force.setZero(3, m.body->surface().f.cols());
  published_ = true;
}

std::vector<double> CoupledSystem::published_contact_forces() const {
  std::vector<double> forces;
  if (published_)
    for (const Member& m : members_)
      forces.insert(forces.end(), m.contact_force.data(),
                    m.contact_force.data() + m.contact_force.size());
  return forces;
}

void CoupledSystem::restore_published_contact_forces(const std::vector<double>& forces) {
  published_ = !forces.empty();
  const double* next = forces.data();
  std::size_t needed = 0;
  for (const Member& m : members_) needed += static_cast<std::size_t>(m.body->surface().f.size());
  if (published_ && needed != forces.size())
    throw Error("the saved contact forces belong to other bodies");
  for (Member& m : members_) {
    if (!published_) break;
    m.contact_force.resize(3, m.body->surface().f.cols());
    std::copy_n(next, m.contact_force.size(), m.contact_force.data());
    next += m.contact_force.size();
  }
}

}  // namespace furrow
