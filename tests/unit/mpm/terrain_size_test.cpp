// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/terrain_size.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/mpm/continuum_terrain.h"
#include "terrain_scene.h"
#include "tests/support/error_of.h"

namespace furrow::terrain_size_test {
namespace {

using ::testing::HasSubstr;

/// Half of the height of the grid is empty.
TerrainParameters some_terrain() {
  TerrainParameters terrain =
      testing_terrain::box(testing_terrain::material_of(testing_terrain::elastic(1e6, 0.3, 200.0)),
                           {0.0, 0.0, 0.0}, {1.0, 0.5, 0.2}, 0.05);
  terrain.z = testing_terrain::even(0.0, 0.4, 0.05);
  return terrain;
}

TEST(TerrainSize, CellsAreCountedWithoutAGrid) {
  const AxisLayout layouts[] = {
      {0.0, 1.0, 0.1, 0.0, 1.0, 1.0},      // even
      {-2.0, 3.0, 0.05, -0.3, 0.4, 1.0},   // even outside too
      {-2.0, 3.0, 0.05, -0.3, 0.4, 1.15},  // growing on both sides
      {0.0, 40.0, 0.02, 0.0, 0.1, 1.5},    // growing far on one
  };
  for (const AxisLayout& layout : layouts)
    EXPECT_NEAR(Axis::cell_count(layout), Axis(layout, "axis").cells(), 1.0);
}

TEST(TerrainSize, EstimateIsTheSizeOfTheTerrain) {
  const TerrainParameters parameters = some_terrain();
  const ContinuumTerrain terrain(parameters, Communicator());
  const TerrainSize size = size_of(parameters);
  EXPECT_NEAR(size.particles / terrain.particle_count(), 1.0, 1e-9);
  const Grid& grid = terrain.grid();
  EXPECT_NEAR(
      size.cells / (double(grid.axis(0).cells()) * grid.axis(1).cells() * grid.axis(2).cells()),
      1.0, 1e-9);
}

TEST(TerrainSize, TerrainLargerThanMemoryIsRefusedWithTheEstimate) {
  TerrainParameters parameters = some_terrain();
  parameters.z.upper = 1e12;
  parameters.z.fine_upper = 1e12;
  EXPECT_THAT(test::error_of<InputError>(
                  [&] { ContinuumTerrain terrain(parameters, Communicator(), "snow"); }),
              ::testing::AllOf(HasSubstr("snow would have"), HasSubstr("GiB on this machine")));
}

}  // namespace
}  // namespace furrow::terrain_size_test
