// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/command_run_until_steady.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/bodies/wheel_hub.h"
#include "furrow/core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/base/roles/grain_bed.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/errors/signals.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/output/histories/fix_wheel_history.h"
#include "input.h"
#include "furrow/io/results/summary.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double stretch = 0.25;        // of the time so far that is added at once
constexpr double smallest_scale = 0.1;  // of a coefficient near 0
constexpr double unlimited = std::numeric_limits<double>::infinity();

using Clock = std::chrono::steady_clock;

/// Reasons why the two values that a wheel is run for are not steady within this error.
std::vector<std::string> reasons(const Summary& summary, double target) {
  if (!summary.trouble.empty()) return {summary.trouble};
  std::vector<std::string> found;
  const Resistance& r = summary.resistance;
  for (const SteadyValue& value : {r.value("hub_drop"), r.answer()}) {
    const double least = value.unit.empty() ? smallest_scale : 0.0;
    const double share = value.standard_error / std::max(std::abs(value.mean), least);
    if (!value.steady)
      found.push_back(fmt::format("{}: {}", plain_name(value.name), value.verdict));
    else if (!(share <= target))
      found.push_back(fmt::format("{}: its standard error is {:.2g} % of it",
                                  plain_name(value.name), 100.0 * share));
  }
  return found;
}

}  // namespace

const StyleRow run_until_steady_style =
    command_style<CommandRunUntilSteady>("run_until_steady", "output/command_run_until_steady.md");

Schema CommandRunUntilSteady::schema() {
  Schema schema("command run_until_steady");
  schema.number("error", "", Range::open(0.0, 1.0),
                "largest relative standard error of hub drop and coefficient; for a coefficient "
                "below 0.1, its error over 0.1");
  schema
      .number("wall_time", "s", Range::positive(),
              "wall time from this line after which no further stretch begins; by default no limit")
      .optional();
  return schema;
}

void CommandRunUntilSteady::command(int narg, char** arg) {
  const Options options = schema().read(std::vector<std::string>(arg, arg + narg));
  const std::vector<FixWheelHistory*> histories = fixes_of<FixWheelHistory>(*modify);
  if (histories.empty() || !histories.front()->is_open())
    throw InputError("command run_until_steady", "has no history of a wheel that has run",
                     "a fix wheel/history and a run before it");
  const double target = options.number("error");
  const double limit = options.has("wall_time") ? options.number("wall_time") : unlimited;
  const Clock::time_point began = Clock::now();
  const long first = static_cast<long>(update->ntimestep);
  std::string problem, end;
  while (end.empty() && !agreed_signal()) {
    problem = unsteady(histories, target);
    if (problem.empty()) break;
    double elapsed = std::chrono::duration<double>(Clock::now() - began).count();
    MPI_Bcast(&elapsed, 1, MPI_DOUBLE, 0, world);
    const double duration =
        std::min(stretch * FixCoupledSystem::of(*lmp).time(), time_left(histories));
    const long steps = static_cast<long>(duration / update->dt);
    if (elapsed >= limit)
      end = fmt::format("the wall_time of {:g} s is over", limit);
    else if (steps < 10)
      end = "the ground ends ahead of the wheel; make it longer";
    else
      run(steps);
  }
  if (agreed_signal()) return;
  const long added = static_cast<long>(update->ntimestep) - first;
  if (end.empty())
    announce(*lmp,
             fmt::format("run_until_steady: hub drop and coefficient are steady within {:g} %, "
                         "after {} steps more",
                         100.0 * target, added));
  else
    warn(*lmp, fmt::format("run_until_steady: not steady within {:g} % after {} steps more: {}. {}",
                           100.0 * target, added, end, problem));
}

std::string CommandRunUntilSteady::unsteady(const std::vector<FixWheelHistory*>& histories,
                                            double target) const {
  std::string text;
  on_first_rank(world, [&] {
    std::vector<std::string> found;
    for (const FixWheelHistory* history : histories)
      for (const std::string& reason : reasons(summarise(history->folder()), target))
        found.push_back(reason);
    text = fmt::format("{}", fmt::join(found, "; "));
  });
  return broadcast(text, world);
}

double CommandRunUntilSteady::time_left(const std::vector<FixWheelHistory*>& histories) const {
  double end = unlimited;  // [m]
  for (const Ground* ground : Grounds(*lmp))
    if (!ground->moves()) end = std::min(end, ground->extent(0).second);
  double left = unlimited;
  for (const FixWheelHistory* history : histories) {
    const WheelHub& wheel = history->wheel();
    const double speed = wheel.velocity().x();
    const double room = end - 2.0 * wheel.nominal_radius() - wheel.centre().x();
    if (speed > 0.0) left = std::min(left, std::max(room, 0.0) / speed);
  }
  return left;
}

void CommandRunUntilSteady::run(long steps) { input->one(fmt::format("run {}", steps).c_str()); }

}  // namespace furrow::coupling
