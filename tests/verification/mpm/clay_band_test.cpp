// SPDX-License-Identifier: GPL-2.0-or-later
// Sensitive clay that a rough plate drags over a rough base: a shear band that does not depend on
// the cell.

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "furrow/bodies/rigid_plate.h"

namespace furrow::clay_band_test {
namespace {

using namespace testing_terrain;

constexpr double su = 1e4, sensitivity = 4.0, slip_95 = 0.02;

/// Shear stress over s_u after each of the paths of the plate [m], on a layer of 50 mm, 0.4 m long.
std::vector<double> drag(double cell, const std::vector<double>& paths) {
  const double length = 0.4, height = 0.05, speed = 0.2, press = 5e-4;
  TerrainParameters p =
      box(material_of(fmt::format("undrained_clay density 1800 su {} sensitivity {} slip_95 {} "
                                  "elasticity linear E 1e6 nu 0.45",
                                  su, sensitivity, slip_95)),
          {0, 0, -height}, {length, cell, 0}, cell);
  p.x = even(-0.1, length + 0.1, cell);
  p.z = even(-height, 4 * cell, cell);
  set_boundary(p, {"free", "free", "smooth", "smooth", "rough", "free"});
  p.particles_per_cell = {2, 1, 2};
  PressedGround scene(p, {PlateShape::square, 2.0, 0.3, 4}, {0.5 * length, 0.5 * cell, 1e-6});
  carve(scene.ground, [&](const Vector3& x) { return x.x() > 0.0 && x.x() < length; });
  ContactParameters rough;
  rough.friction = std::numeric_limits<double>::infinity();
  scene.touch(rough);
  const double interval = 2e-4;
  for (double down = 0.0; down < press; down += 0.05 * interval) {
    scene.plate.prescribe(-0.05);
    scene.system.advance(interval);
  }
  const double start = scene.plate.centre().x();
  std::vector<double> stresses;
  for (const double path : paths) {
    double sum = 0.0, count = 0.0;
    while (scene.plate.centre().x() - start < 1.1 * path) {
      scene.plate.prescribe(Vector3(speed, 0, 0));
      scene.system.advance(interval);
      if (scene.plate.centre().x() - start < 0.9 * path) continue;
      sum -= scene.contact->force().x();
      count += 1.0;
    }
    stresses.push_back(sum / count / (length * cell) / su);
  }
  return stresses;
}

/// A band of one cell would follow s/s_u = 1/s_t + (1 - 1/s_t) exp(-3 u/slip_95) at the path u. The
/// band is about 0.7 cells wide, so that the stress is lower. In cells of half the size it is the
/// same.
TEST(ClayBand, SofteningIsIndependentOfTheCell) {
  const std::vector<double> paths = {0.002, 0.005, 0.01, 0.02};
  const std::vector<double> coarse = drag(0.0125, paths), fine = drag(0.00625, paths);
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const double one_cell =
        1 / sensitivity + (1 - 1 / sensitivity) * std::exp(-3 * paths[n] / slip_95);
    RecordProperty(fmt::format("at_{:g}_mm", 1e3 * paths[n]),
                   fmt::format("{:.3f}, {:.3f}; one cell {:.3f}", coarse[n], fine[n], one_cell));
    EXPECT_NEAR(fine[n], coarse[n], 0.05) << paths[n];
    EXPECT_NEAR(fine[n], one_cell, 0.15) << paths[n];
    EXPECT_GT(fine[n], 1 / sensitivity) << paths[n];
  }
}

}  // namespace
}  // namespace furrow::clay_band_test
