// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/laboratory/fix_layer_shear.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/liggghts/errors.h"
#include "coupling/base/args.h"
#include "domain.h"
#include "rig/ramp.h"
#include "update.h"

namespace furrow::coupling {

Schema FixLayerShear::schema() {
  Schema schema("fix layer/shear");
  schema.number("speed", "m/s", Range::any(), "velocity along x");
  schema
      .number("accelerate_time", "s", Range::non_negative(),
              "time in which it gains its speed, smoothly")
      .by_default(0.0);
  return schema;
}

FixLayerShear::FixLayerShear(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      options_(schema().read(args_after_style(narg, arg))),
      speed_(options_.number("speed")),
      accelerate_time_(options_.number("accelerate_time")) {
  vector_flag = 1;
  size_vector = 4;
  global_freq = 1;
  extvector = 0;
}

int FixLayerShear::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::FINAL_INTEGRATE;
}

/// The layer is rigid: it follows the cell along z with the velocity that the cell has at its
/// middle.
void FixLayerShear::init() {
  const Communicator ranks(&world);
  double sums[] = {0.0, 0.0};
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit) {
      sums[0] += atom->x[i][2];
      sums[1] += 1.0;
    }
  ranks.sum(sums, 2);
  with_collective_errors(*error, [&] {
    if (sums[1] == 0.0)
      throw InputError(fmt::format("fix layer/shear '{}'", id), "has no grains in its group",
                       "a group with grains",
                       "define the group by a region that holds a layer of grains");
  });
  height_ = sums[0] / sums[1];
}

void FixLayerShear::initial_integrate(int) {
  const double dt = update->dt,
               speed = speed_ * Ramp{0.0, accelerate_time_}.mean(elapsed_, elapsed_ + dt);
  const double middle = 0.5 * (domain->boxlo[2] + domain->boxhi[2]);
  const double rise = domain->h_rate[2] / domain->prd[2] * (height_ - middle);
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit) {
      atom->v[i][0] = speed;
      atom->v[i][1] = 0.0;
      atom->v[i][2] = rise;
      for (int k = 0; k < 3; ++k) {
        atom->omega[i][k] = 0.0;
        atom->x[i][k] += dt * atom->v[i][k];
      }
    }
  height_ += dt * rise;
  displacement_ += dt * speed;
  elapsed_ += dt;
}

/// Forces between grains of the layer cancel in the sum.
void FixLayerShear::final_integrate() {
  force_ = {};
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (std::size_t k = 0; k < 3; ++k) force_[k] += atom->f[i][k];
  Communicator(&world).sum(force_.data(), 3);
}

double FixLayerShear::compute_vector(int n) {
  return n == 0 ? displacement_ : force_[static_cast<std::size_t>(n - 1)];
}

}  // namespace furrow::coupling
