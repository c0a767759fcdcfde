// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/lost_grains_check.h"

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/terrain/fix_bed_window.h"

namespace furrow::coupling {

double count_grains(const LAMMPS_NS::LAMMPS& lammps) {
  return Communicator(&lammps.world).sum(lammps.atom->nlocal);
}

void warn_of_lost_grains(const LAMMPS_NS::LAMMPS& lammps, double at_the_start, const Warn& warn) {
  const double lost = at_the_start - count_grains(lammps);
  if (lost <= 0.0 || !fixes_of<const FixBedWindow>(*lammps.modify).empty()) return;
  warn(
      fmt::format("{:.0f} of {:.0f} grains have left the box in this run; if they were not meant "
                  "to, look for a time step that is too large or for a wall that is missing",
                  lost, at_the_start));
}

}  // namespace furrow::coupling
