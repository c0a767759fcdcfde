// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/terrain_snapshot.h"

#include <optional>
#include <string>

#include <gmock/gmock.h>

#include "terrain_scene.h"

namespace furrow::terrain_snapshot_test {
namespace {

using namespace testing_terrain;

/// In the plane xz the principal stresses are (a + b)/2 +- sqrt((a - b)^2/4 + s^2), the first at
/// the angle atan2(2 s, a - b)/2 from x.
TEST(TerrainSnapshot, SnapshotHasPrincipalStressesAndAxes) {
  ContinuumTerrain ground(
      box(material_of(elastic(1e6, 0.2, 1000)), {0, 0, 0}, {0.2, 0.1, 0.1}, 0.05), Communicator());
  const double a = -3e3, b = -1e3, s = 2e3, across = -2e3;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    VectorX state = particles.state(p);
    state.head<6>() << a, across, b, 0, 0, s;
    particles.set_state(p, state);
  });
  const TerrainSnapshot snapshot = take_snapshot(ground);
  const double mean = 0.5 * (a + b), radius = std::hypot(0.5 * (a - b), s),
               angle = 0.5 * std::atan2(2 * s, a - b);
  const Vector3 tension(std::cos(angle), 0, std::sin(angle));
  ASSERT_EQ(snapshot.principal_stress.cols(), static_cast<Eigen::Index>(snapshot.size()));
  for (Eigen::Index p = 0; p < snapshot.principal_stress.cols(); ++p) {
    EXPECT_LT(
        (snapshot.principal_stress.col(p) - Vector3(mean + radius, across, mean - radius)).norm(),
        1e-9);
    EXPECT_LT((snapshot.tension_axis.col(p) - tension).norm(), 1e-12);
    EXPECT_LT((snapshot.compression_axis.col(p) - Vector3(-tension.z(), 0, tension.x())).norm(),
              1e-12);
  }
}

TEST(TerrainSnapshot, SnapshotHasThePlasticStrain) {
  for (const std::string& law : {snow(), elastic(1e6, 0.2, 1000)}) {
    const auto material = material_of(law);
    const std::optional<std::size_t> kept = material->find_field("eps_dev_pl");
    ContinuumTerrain ground(box(material, {0, 0, 0}, {0.2, 0.1, 0.1}, 0.05), Communicator());
    if (kept) {
      for_particles(ground, [&](Particles& particles, std::size_t p) {
        particles.data(column::state + *kept)[p] = 0.25;
      });
    }
    EXPECT_THAT(take_snapshot(ground).plastic_strain, ::testing::Each(kept ? 0.25 : 0.0));
  }
}

}  // namespace
}  // namespace furrow::terrain_snapshot_test
