// SPDX-License-Identifier: GPL-2.0-or-later
// A slope that a rig states turns the weight of everything in the scene: a grain falls along it,
// the base of a continuum holds it, and a towed wheel rolls down, each as in closed form.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "modify.h"
#include "furrow/statistics/history.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test::slope_test {
namespace {

constexpr double gravity = 9.80665, step = 5e-5;   // [m/s^2], [s]
constexpr double slope = -10.0, side_slope = 5.0;  // [degrees]
constexpr double settled = 0.1, cruising = 0.12;   // [s]

template <class Fix>
Fix& fix_of(Scene& scene, const char* id) {
  return dynamic_cast<Fix&>(*scene.lammps().modify->find_fix_id(const_cast<char*>(id)));
}

double mass_of(ContinuumTerrain& terrain) {
  double mass = 0.0;
  for (const ParticleGroup& group : terrain.unsynchronised_groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) mass += group.mass(p);
  return terrain.ranks().sum(mass);
}

TEST(Slope, GrainContinuumAndWheelAccelerateAlongTheTiltedGravity) {
  Scene scene;
  scene.granular_box(Vector3(-0.5, -0.3, -0.2), Vector3(1.5, 0.3, 3.0), 0.05);
  scene.contact_properties(5e6, 0.3, 0.5, 0.3);
  scene.commands(fmt::format(
      "pair_style gran model hertz tangential history\npair_coeff * *\ntimestep {}\n"
      "fix weight all gravity {} vector 0 0 -1\ncreate_atoms 1 single 0.5 0 2.5 units box\n"
      "set group all diameter 0.01 density 2500\nfix move all nve/sphere\nthermo 100000",
      step, gravity));
  scene.command(
      fmt::format("fix block all terrain/continuum material {}/inputs/materials/rubber.yaml length "
                  "0.08 width 0.08 depth 0.04 cell 0.02 centre 1 0 ends free sides free cfl 0.2",
                  FURROW_SOURCE_DIR));
  scene.commands(fmt::format(
      "fix wheel all wheel/rigid diameter 0.2 width 0.05 mass 2 inertia 0.012 segments 200 axle 0 "
      "0 "
      "0.1001\n"
      "fix road all contact/plane body wheel level 0 friction 0.5 stiffness 1e8 "
      "tangential_stiffness 1e8\n"
      "fix rig all wheel/rig wheel wheel load_mass 5 mode towed travel free slope {} side_slope {} "
      "settle_time "
      "{} accelerate_time {} ground_level 0 damping 300",
      slope, side_slope, settled, cruising - settled));
  const WheelRig& rig = fix_of<coupling::FixWheelRig>(scene, "rig").rig();
  ContinuumTerrain& block = fix_of<coupling::FixTerrainContinuum>(scene, "block").terrain();
  const History channels(WheelRig::channels());
  const auto reading = [&](const char* name) {
    return rig.measure(scene.system().time())[channels.index(name)];
  };

  scene.command(fmt::format("run {}", std::lround(cruising / step)));
  const double speed = reading("velocity_x");
  const Vector3 base = block.boundary_impulse(Face::z_lower);
  constexpr double time = 0.15;  // [s]
  scene.command(fmt::format("run {}", std::lround(time / step)));

  // the grain falls freely, from the start
  Vector3 fall = Vector3::Zero();
  for (double t = 0.5 * step; t < cruising + time; t += step)
    fall += step * (rig.tilt(t) * Vector3(0.0, 0.0, -gravity));
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  Vector3 v = Vector3::Zero();
  for (int i = 0; i < atom.nlocal; ++i) v = Eigen::Map<const Vector3>(atom.v[i]);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(scene.sum(v[c]), fall[c], 1e-4) << c;

  // the base holds the block up and along the slope
  const Vector3 held = (block.boundary_impulse(Face::z_lower) - base) / time;
  const double weight = mass_of(block) * gravity;
  EXPECT_NEAR(held.x(), weight * std::sin(radians(slope)), 5e-3 * weight);
  const double across = std::sin(radians(side_slope)), down = std::cos(radians(side_slope));
  EXPECT_NEAR(held.y(), weight * across * std::cos(radians(slope)), 5e-3 * weight);
  EXPECT_NEAR(held.z(), weight * down * std::cos(radians(slope)), 5e-3 * weight);

  // the wheel rolls: a = -g sin/(1 + I/(m r^2))
  const double a = -gravity * std::sin(radians(slope)) / (1.0 + 0.012 / (5.0 * 0.1 * 0.1));
  EXPECT_NEAR((reading("velocity_x") - speed) / time, a, 0.01 * a);
  EXPECT_NEAR(reading("slip"), 0.0, 0.01);
  EXPECT_EQ(reading("axle_free"), 1.0);
}

}  // namespace
}  // namespace furrow::test::slope_test
