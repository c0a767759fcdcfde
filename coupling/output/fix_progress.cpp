// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/fix_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "comm.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/base/roles/ground.h"
#include "furrow/tyre/tyre.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr int steps_between_looks = 10;  // at the clock: that is cheap, but not free

std::string clock_text(double seconds) {
  const long s = std::lround(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

/// Text of a count: "3.1 M" for 3.1e6.
std::string count_text(double count) {
  for (const auto& [unit, name] : {std::pair(1e9, "G"), {1e6, "M"}, {1e3, "k"}})
    if (count >= unit) return fmt::format("{:.1f} {}", count / unit, name);
  return fmt::format("{:.0f}", count);
}

}  // namespace

const StyleRow progress_style =
    fix_style<FixProgress>("progress", "progress", "output/fix_progress.md");

Schema FixProgress::schema() {
  Schema schema("fix progress");
  schema.number("every", "s", Range::positive(), "wall time between lines").by_default(5.0);
  schema.text("label", "first word of the line").by_default("run");
  return schema;
}

FixProgress::FixProgress(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()), interval_(options().number("every")) {
  nevery = steps_between_looks;
}

int FixProgress::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP; }

void FixProgress::setup(int) {
  started_ = Clock::now();
  printed_ = 0.0;
  left_ = {};
  work_ = {};
  const FixCoupledSystem* system = FixCoupledSystem::find(*lmp);
  sub_steps_ = system ? system->sub_steps() : 0.0;
}

/// Adds the work of the steps since the last call. Collective: particles are spread over the ranks.
void FixProgress::add_work() {
  work_.grain_steps += nevery * static_cast<double>(atom->natoms);
  const FixCoupledSystem* system = FixCoupledSystem::find(*lmp);
  if (!system) return;
  const double sub_steps = system->sub_steps() - sub_steps_;
  sub_steps_ = system->sub_steps();
  for (const Terrain* terrain : fixes_of<Terrain>(*modify))
    work_.particle_updates += sub_steps * terrain->particle_count();
  for (const FixWheelHub* wheel : fixes_of<FixWheelHub>(*modify))
    if (dynamic_cast<const Tyre*>(&wheel->body())) work_.tyre_steps += sub_steps;
}

double FixProgress::share_done() const {
  return static_cast<double>(update->ntimestep - update->firststep) /
         static_cast<double>(update->laststep - update->firststep);
}

void FixProgress::end_of_step() {
  add_work();
  if (comm->me != 0) return;
  const double elapsed = std::chrono::duration<double>(Clock::now() - started_).count();
  left_.note(share_done(), elapsed);
  const bool last = update->ntimestep > update->laststep - nevery;
  if (last || elapsed - printed_ >= interval_) print(elapsed, last);
}

/// Work in a second, each kind in a separate unit; LIGGGHTS's steps where there is nothing else.
std::string FixProgress::rates(double elapsed) const {
  const std::pair<double, const char*> all[] = {{work_.grain_steps, "grain steps/s"},
                                                {work_.particle_updates, "particle updates/s"},
                                                {work_.tyre_steps, "tyre steps/s"}};
  std::string text;
  for (const auto& [count, unit] : all)
    if (count > 0.0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count_text(count / elapsed), unit);
  const double steps = static_cast<double>(update->ntimestep - update->firststep);
  return text.empty() ? count_text(steps / elapsed) + " steps/s" : text;
}

/// On a terminal each line takes the place of the one before.
void FixProgress::print(double elapsed, bool last) {
  printed_ = elapsed;
  if (!screen) return;
  const std::string line = fmt::format(
      "[{}] {:5.1f} %  elapsed {}  left {}  {}", options().text("label"), 100.0 * share_done(),
      clock_text(elapsed), clock_text(left_.estimate()), rates(std::max(elapsed, 1e-9)));
  const bool terminal = isatty(fileno(screen)) == 1;
  fmt::print(screen, terminal ? "\r{}\033[K{}" : "{}{}", line, terminal && !last ? "" : "\n");
  std::fflush(screen);
}

}  // namespace furrow::coupling
