// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies/coupled_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

// more in one interval means that a body is collapsing, not that it is stiff
constexpr double most_sub_steps = 1e6;

}  // namespace

void World::remove(const Body& body) {
  members_.erase(std::remove_if(members_.begin(), members_.end(),
                                [&](const Member& member) { return member.body == &body; }),
                 members_.end());
}

void World::remove(const Interaction& interaction) {
  interactions_.erase(
      std::remove_if(interactions_.begin(), interactions_.end(),
                     [&](const Named& named) { return named.interaction == &interaction; }),
      interactions_.end());
}

int World::advance(double interval) {
  if (!(std::isfinite(interval) && interval > 0.0))
    throw StateError(fmt::format("the world cannot advance by {} s", interval));
  double smallest = std::numeric_limits<double>::infinity();
  for (const Member& member : members_) {
    const double stable = member.body->stable_time_step();
    if (!(stable > interval / most_sub_steps))
      throw StateError(
          fmt::format("body '{}': its stable time step is {} s, less than a millionth of the "
                      "interval {} s; an element has "
                      "collapsed or a stiffness has grown without bound",
                      member.name, stable, interval));
    smallest = std::min(smallest, stable);
  }
  const int sub_steps = std::max(1, static_cast<int>(std::ceil(interval / smallest)));
  const double dt = interval / sub_steps;
  for (Member& m : members_) {
    Matrix3X& f = m.body->surface().f;
    if (shown_) f -= m.interaction;
    m.given = f;
    f *= sub_steps;
    if (!interactions_.empty()) m.interaction.setZero(3, f.cols());
    m.body->begin_interval();
  }
  shown_ = false;
  for (int i = 0; i < sub_steps; ++i) {
    apply_interactions(dt);
    if (!interactions_.empty())
      for (Member& m : members_) m.interaction += m.body->surface().f / sub_steps;
    advance_bodies(dt);
    for (Member& m : members_) m.body->surface().f.setZero();
  }
  for (Member& m : members_) {
    if (!interactions_.empty()) m.interaction -= m.given;
    m.body->surface().f = m.given;
    m.body->end_interval();
  }
  return sub_steps;
}

void World::apply_interactions(double dt) {
  for (const Named& named : interactions_) try {
      named.interaction->apply(dt);
    } catch (const StateError& error) {
      throw StateError(fmt::format("contact '{}': {}", named.name, error.what()));
    }
}

void World::advance_bodies(double dt) {
  for (const Member& member : members_) {
    try {
      member.body->advance(dt);
    } catch (const StateError& error) {
      throw StateError(fmt::format("body '{}': {}", member.name, error.what()));
    }
    member.body->surface().check_finite(member.name);
  }
}

void World::clear_forces() {
  for (const Member& m : members_) m.body->surface().clear_forces();
  shown_ = false;
}

void World::show_interaction_forces() {
  if (shown_ || interactions_.empty()) return;
  for (Member& m : members_)
    if (m.interaction.cols() == m.body->surface().f.cols())
      m.body->surface().f += m.interaction;
    else
      m.interaction.setZero(3, m.body->surface().f.cols());
  shown_ = true;
}

std::vector<double> World::shown_forces() const {
  std::vector<double> forces;
  if (shown_)
    for (const Member& m : members_)
      forces.insert(forces.end(), m.interaction.data(),
                    m.interaction.data() + m.interaction.size());
  return forces;
}

void World::restore_shown_forces(const std::vector<double>& forces) {
  shown_ = !forces.empty();
  const double* next = forces.data();
  std::size_t needed = 0;
  for (const Member& m : members_) needed += static_cast<std::size_t>(m.body->surface().f.size());
  if (shown_ && needed != forces.size())
    throw Error("the saved contact forces belong to other bodies");
  for (Member& m : members_) {
    if (!shown_) break;
    m.interaction.resize(3, m.body->surface().f.cols());
    std::copy_n(next, m.interaction.size(), m.interaction.data());
    next += m.interaction.size();
  }
}

}  // namespace furrow
