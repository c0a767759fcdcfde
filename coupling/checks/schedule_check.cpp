// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/schedule_check.h"

#include <fmt/format.h>

#include "coupling/base/fix_coupled_system.h"
#include "coupling/checks/driven_bodies.h"
#include "update.h"

namespace furrow::coupling {

void check_schedules(LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  const double step = lammps.update->dt;
  const double end = FixCoupledSystem::of(lammps).time() + step * lammps.update->nsteps;
  for (const DrivenBody& driven : driven_bodies(*lammps.modify)) {
    const double start = driven.options.number("start");
    if (start >= end)
      warn(
          fmt::format("{} is {:.4g} s: this run ends before, and '{}' does not set off; make it "
                      "smaller, or the run longer",
                      driven.options.where("start"), start, driven.body.id));
    else if ((!driven.options.has("speed") || driven.options.number("speed") > 0.0) &&
             driven.full_speed > end + 0.5 * step)
      warn(
          fmt::format("{}: '{}' has its speed from {:.4g} s on, after the end of this run, which "
                      "then has no steady values; run longer, or shorten {}",
                      driven.options.subject(), driven.body.id, driven.full_speed, driven.stages));
  }
}

}  // namespace furrow::coupling
