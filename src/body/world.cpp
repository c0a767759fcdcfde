#include "body/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

constexpr double most_sub_steps = 1e6;  // more in one interval means that a body is collapsing, not that it is stiff

}  // namespace

void World::remove(const Body& body) {
  members_.erase(
      std::remove_if(members_.begin(), members_.end(), [&](const Member& member) { return member.body == &body; }),
      members_.end());
}

int World::advance(double interval) {
  if (!(std::isfinite(interval) && interval > 0.0))
    throw StateError(fmt::format("the world cannot advance by {} s", interval));
  double smallest = std::numeric_limits<double>::infinity();
  for (const Member& member : members_) {
    const double stable = member.body->stable_time_step();
    if (!(stable > interval / most_sub_steps))
      throw StateError(
          fmt::format("body '{}': its stable time step is {} s, less than a millionth of the interval {} s; an element has "
                      "collapsed or a stiffness has grown without bound",
                      member.name, stable, interval));
    smallest = std::min(smallest, stable);
  }
  const int sub_steps = std::max(1, static_cast<int>(std::ceil(interval / smallest)));
  for (int i = 0; i < sub_steps; ++i)
    for (const Member& member : members_) {
      try {
        member.body->advance(interval / sub_steps);
      } catch (const StateError& error) {
        throw StateError(fmt::format("body '{}': {}", member.name, error.what()));
      }
      member.body->surface().check_finite(member.name);
    }
  return sub_steps;
}

}  // namespace furrow
