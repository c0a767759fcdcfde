// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/grains/snow_overlap_check.h"

#include <fmt/format.h>

#include "furrow/core/communicator.h"
#include "coupling/liggghts/styles/script.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr LAMMPS_NS::bigint compare_every = 200;  // steps between comparisons

}  // namespace

void SnowOverlapCheck::finish_step() {
  const LAMMPS_NS::Update& now = *lammps_.update;
  if (warned_ || (now.ntimestep % compare_every != 0 && now.ntimestep != now.laststep)) return;
  double found[] = {densest_, largest_};
  Communicator(&lammps_.world).max(found, 2);
  warned_ = found[0] > ice_density;
  if (warned_)
    warn(lammps_,
         fmt::format("model snow/bond: two clusters overlap by {:.2f} of the sum of their radii; "
                     "snow pressed like this along the line of their centres has {:.0f} kg/m3, "
                     "more than ice ({:g}), which the model does not describe: lower the load, or "
                     "raise snowDenseStrength",
                     found[1], found[0], ice_density));
}

}  // namespace furrow::coupling
