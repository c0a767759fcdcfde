// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/fix_progress.h"

#include <cmath>

#include <fmt/format.h>

#include "atom.h"
#include "comm.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr int steps_between_looks = 10;  // at the clock: that is cheap, but not free

std::string clock_text(double seconds) {
  const long s = std::lround(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

Schema FixProgress::schema() {
  Schema schema("fix progress");
  schema.number("every", "s", Range::positive(), "seconds of wall time between lines")
      .by_default(5.0);
  schema.text("label", "what is going on, first word of the line").by_default("run");
  return schema;
}

FixProgress::FixProgress(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()), interval_(options().number("every")) {
  nevery = steps_between_looks;
}

int FixProgress::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP; }

void FixProgress::setup(int) { started_ = last_ = Clock::now(); }

void FixProgress::end_of_step() {
  if (comm->me != 0) return;
  const Clock::time_point now = Clock::now();
  const bool last = update->ntimestep > update->laststep - nevery;
  if (!last && std::chrono::duration<double>(now - last_).count() < interval_) return;
  last_ = now;
  print(now);
}

void FixProgress::print(Clock::time_point now) const {
  const double elapsed = std::chrono::duration<double>(now - started_).count();
  const double done = static_cast<double>(update->ntimestep - update->firststep),
               all = static_cast<double>(update->laststep - update->firststep);
  const double left = done > 0.0 ? elapsed * (all - done) / done : 0.0;
  const std::string line = fmt::format(
      "[{}] {:5.1f} %  elapsed {}  left {}  {:.1f} M grain steps/s\n", options().text("label"),
      100.0 * done / all, clock_text(elapsed), clock_text(left),
      elapsed > 0.0 ? 1e-6 * done * static_cast<double>(atom->natoms) / elapsed : 0.0);
  if (screen) {
    std::fputs(line.c_str(), screen);
    std::fflush(screen);
  }
}

}  // namespace furrow::coupling
