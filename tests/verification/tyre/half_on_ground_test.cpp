// SPDX-License-Identifier: GPL-2.0-or-later
// Half a tyre on half a ground against the whole tyre on the same half a ground: the same
// arithmetic in another order.

#include <cmath>

#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "../../unit/tyre/tyres.h"
#include "furrow/tyre/darnell/darnell_tyre.h"

namespace furrow::half_on_ground_test {
namespace {

struct Outcome {
  double height, spin, force_x, force_z, width, friction, work, dissipated;
};

/// Inflated without a disturbance, so that the whole tyre stays symmetric, dropped on snow and
/// pulled along with friction.
Outcome drop_and_pull(bool half) {
  DarnellTyreSettings settings = coarse(half);
  settings.damping_rate = 2000.0;
  DarnellTyre tyre(p235(4e4), settings, {{20.0, 0.6, 0.4}, {0.0, 0.0, 0.36}});
  const double dt = 0.9 * tyre.stable_time_step();
  for (int i = 0; i < 1500; ++i) tyre.advance(dt);

  TerrainParameters snow =
      testing_terrain::box(testing_terrain::material_of(testing_terrain::snow()),
                           {-0.3, 0.0, -0.12}, {0.5, 0.2, 0.0}, 0.04);
  snow.z = testing_terrain::even(-0.12, 0.12, 0.04);
  testing_terrain::set_boundary(snow, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  ContinuumTerrain ground(snow, Communicator());
  TerrainContact contact(tyre, ground, ContactParameters{}, !half, "contact");
  CoupledSystem system;
  system.add(tyre, "tyre");
  system.add(ground, "ground");
  system.add(contact, "contact");
  tyre.release(Coordinate::z);
  tyre.release(Coordinate::spin);
  tyre.prescribe(Coordinate::x, 3.0);
  tyre.set_load({0.0, 0.0, -1500.0});
  tyre.set_velocity({3.0, 0.0, -2.0}, {4.0, 0.0, 0.0});
  for (int i = 0; i < 600; ++i) {
    system.clear_forces();
    system.advance(5e-5);
    system.publish_contact_forces();
  }
  const Wrench wrench = tyre.ground_wrench();
  const double both = half ? 2.0 : 1.0;
  return {tyre.centre().z(),
          tyre.position(Coordinate::spin),
          wrench.force.x(),
          wrench.force.z(),
          tyre.section_width(),
          both * contact.friction_loss(),
          ground.energy_budget().contact_work,
          ground.energy_budget().dissipated_energy};
}

TEST(HalfTyre, HalfModelEqualsTheWholeOnHalfGround) {
  const Outcome half = drop_and_pull(true), whole = drop_and_pull(false);
  EXPECT_LT(whole.height, 0.33);
  EXPECT_GT(whole.force_z, 500.0);
  EXPECT_LT(whole.force_x, -50.0);
  EXPECT_GT(whole.friction, 1.0);
  EXPECT_GT(whole.dissipated, 5.0);
  EXPECT_NEAR(half.height, whole.height, 1e-8);
  EXPECT_NEAR(half.spin, whole.spin, 1e-7);
  EXPECT_NEAR(half.width, whole.width, 1e-7);
  EXPECT_NEAR(half.force_x / whole.force_x, 1.0, 1e-6);
  EXPECT_NEAR(half.force_z / whole.force_z, 1.0, 1e-6);
  EXPECT_NEAR(half.friction / whole.friction, 1.0, 1e-6);
  EXPECT_NEAR(half.work / whole.work, 1.0, 1e-6);
  EXPECT_NEAR(half.dissipated / whole.dissipated, 1.0, 1e-6);
}

}  // namespace
}  // namespace furrow::half_on_ground_test
