// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/laboratory/fix_layer_shear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/data/box_motion.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double largest_travel_of_step = 0.1;  // of the radius of the smallest grain

}  // namespace

const StyleRow layer_shear_style =
    fix_style<FixLayerShear>("layer/shear", "laboratory", "laboratory/fix_layer_shear.md");

Schema FixLayerShear::schema() {
  Schema schema("fix layer/shear");
  schema.number("speed", "m/s", Range::any(), "velocity along x");
  schema
      .number("accelerate_time", "s", Range::non_negative(),
              "time in which the layer reaches its speed, smoothly")
      .by_default(0.0);
  return schema;
}

const Outputs<FixLayerShear>& FixLayerShear::outputs() {
  using Fix = FixLayerShear;
  static const Outputs<Fix> list = {
      {"displacement", "m", "displacement of the layer along x",
       [](Fix& fix) { return fix.displacement_; }},
      {"force_x", "N", "force of the other grains on the layer",
       [](Fix& fix) { return fix.force_[0]; }},
      {"force_y", "N", "force of the other grains on the layer",
       [](Fix& fix) { return fix.force_[1]; }},
      {"force_z", "N", "force of the other grains on the layer",
       [](Fix& fix) { return fix.force_[2]; }},
  };
  return list;
}

FixLayerShear::FixLayerShear(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()),
      speed_(options().number("speed")),
      ramp_{0.0, options().number("accelerate_time")} {
  time_integrate = 1;
  keep_state();
  provide(outputs());
}

int FixLayerShear::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::FINAL_INTEGRATE;
}

void FixLayerShear::checkpoint(Checkpoint& state) {
  state.value("elapsed", elapsed_);
  state.value("displacement", displacement_);
  state.value("height", height_);
  state.values("force", force_);
  height_restored_ = !state.saving();
}

/// The layer is rigid: it follows the cell along z with the velocity that the cell has at its
/// middle.
void FixLayerShear::init() {
  const double middle = middle_of_layer();
  if (!std::exchange(height_restored_, false)) height_ = middle;
  collectively([&] { check_speed(); });
}

double FixLayerShear::middle_of_layer() const {
  const Communicator ranks(&world);
  double sums[] = {0.0, 0.0};
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit) {
      sums[0] += atom->x[i][2];
      sums[1] += 1.0;
    }
  ranks.sum(sums, 2);
  collectively([&] {
    if (sums[1] == 0.0)
      throw InputError(name(), "has no grains in its group", "a group with grains",
                       "define the group by a region that holds a layer of grains");
  });
  return sums[0] / sums[1];
}

/// In a step the layer shall not pass a grain.
void FixLayerShear::check_speed() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < atom->nlocal; ++i) smallest = std::min(smallest, atom->radius[i]);
  smallest = -Communicator(&world).max(-smallest);
  const double largest_speed = largest_travel_of_step * smallest / update->dt;
  if (std::abs(speed_) > largest_speed)
    throw InputError(options().where("speed"), fmt::format("is {:g} m/s", speed_),
                     fmt::format("at most {:.3g} m/s with grains of radius {:.3g} m and steps of "
                                 "{:g} s",
                                 largest_speed, smallest, update->dt),
                     "choose a lower speed or a shorter timestep");
}

void FixLayerShear::initial_integrate(int) {
  const double dt = update->dt;
  const double speed = speed_ * ramp_.mean(elapsed_, elapsed_ + dt);
  const double rise = box_velocity_z(*lmp, height_);
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

}  // namespace furrow::coupling
