// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/overburden.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/error_of.h"

namespace furrow::overburden_test {
namespace {

using ::testing::HasSubstr;
using testing_terrain::elastic;
using testing_terrain::material_of;
using testing_terrain::snow;

TerrainParameters deep(std::vector<TerrainLayer> layers) {
  TerrainParameters ground;
  ground.surface = 0.0;
  ground.layers = std::move(layers);
  return ground;
}

std::vector<ParticleLevel> levels_down(double depth, int count) {
  std::vector<ParticleLevel> levels(static_cast<std::size_t>(count));
  for (std::size_t n = 0; n < levels.size(); ++n) {
    levels[n].half = 0.5 * depth / count;
    levels[n].z = -(2.0 * double(n) + 1.0) * levels[n].half;
  }
  return levels;
}

/// sigma_zz = -rho g depth, sigma_xx = nu/(1 - nu) sigma_zz, for ground that is hardly compressed
/// by its weight.
TEST(Overburden, ElasticGroundCarriesItsWeight) {
  const double rho = 1800.0, nu = 0.3;
  auto levels = levels_down(2.0, 20);
  find_overburden(deep({{material_of(elastic(1e9, nu, rho)), 2.0}}), 0.0, levels);
  for (const ParticleLevel& level : levels) {
    const double stress = rho * standard_gravity * level.z;
    // the tolerance is the density's change, rho g z/M
    EXPECT_NEAR(level.state[field::stress + 2] / stress, 1.0, 1e-4);
    EXPECT_NEAR(level.state[field::stress] / level.state[field::stress + 2], nu / (1.0 - nu), 1e-4);
    EXPECT_EQ(level.state[field::stress + 5], 0.0);
  }
}

/// A weight on the surface is carried by every level, beside its own.
TEST(Overburden, SurchargeIsCarriedByAllLevels) {
  const double rho = 1800.0, surcharge = 5e3;
  auto ground = deep({{material_of(elastic(1e9, 0.3, rho)), 2.0}});
  ground.surcharge = surcharge;
  auto levels = levels_down(2.0, 20);
  find_overburden(ground, ground.surcharge, levels);
  for (const ParticleLevel& level : levels)
    EXPECT_NEAR(-level.state[field::stress + 2] / (surcharge - rho * standard_gravity * level.z),
                1.0, 1e-4);
}

/// Snow compacts under its weight: equilibrium holds with the density it has then, sum over what
/// lies above of rho(z) g dz.
TEST(Overburden, SnowIsInEquilibriumAtItsCompactedDensity) {
  const auto material = material_of(snow());
  auto levels = levels_down(2.0, 40);
  find_overburden(deep({{material, 2.0}}), 0.0, levels);
  double above = 0.0;
  for (const ParticleLevel& level : levels) {
    const double own = 2.0 * level.half * standard_gravity * material->current_density(level.state);
    EXPECT_NEAR(-level.state[field::stress + 2] / (above + 0.5 * own), 1.0, 1e-3);
    above += own;
  }
  EXPECT_GT(material->current_density(levels.back().state),
            material->current_density(levels.front().state));
}

TEST(Overburden, StressSumsTheWeightOfLayers) {
  const auto light = material_of(elastic(1e8, 0.3, 200)),
             heavy = material_of(elastic(1e9, 0.2, 2000));
  auto levels = levels_down(1.0, 10);
  // the lowest reaches the base whatever its thickness
  find_overburden(deep({{light, 0.3}, {heavy, 0.1}}), 0.0, levels);
  for (const ParticleLevel& level : levels) {
    const double depth = -level.z;
    EXPECT_EQ(level.layer, depth < 0.3 ? 0u : 1u) << depth;
    const double stress =
        standard_gravity * (depth < 0.3 ? 200 * depth : 200 * 0.3 + 2000 * (depth - 0.3));
    EXPECT_NEAR(-level.state[field::stress + 2] / stress, 1.0, 1e-3) << depth;
  }
}

/// A patch has its own layers and their weight.
TEST(Overburden, PatchHasTheStressOfItsLayers) {
  const auto light = material_of(elastic(1e8, 0.3, 200)),
             heavy = material_of(elastic(1e9, 0.2, 2000));
  auto ground = deep({{light, 1.0}, {heavy, 0.3}, {light, 0.7}});
  ground.patches = {{0.5, 1}};
  auto levels = levels_down(1.0, 10);
  find_overburden(ground, 0.0, levels);
  for (const ParticleLevel& level : levels) EXPECT_EQ(level.layer, 0u);
  find_overburden(ground, 0.0, levels, 1);
  for (const ParticleLevel& level : levels) {
    const double depth = -level.z;
    EXPECT_EQ(level.layer, depth < 0.3 ? 1u : 2u) << depth;
    const double stress =
        standard_gravity * (depth < 0.3 ? 2000 * depth : 2000 * 0.3 + 200 * (depth - 0.3));
    EXPECT_NEAR(-level.state[field::stress + 2] / stress, 1.0, 1e-3) << depth;
  }
}

TEST(Overburden, StressIsZeroWithoutInitialStress) {
  const auto material = material_of(snow());
  auto ground = deep({{material, 1.0}});
  ground.initial_stress = false;
  auto levels = levels_down(1.0, 4);
  find_overburden(ground, ground.surcharge, levels);
  for (const ParticleLevel& level : levels) EXPECT_EQ(level.state, material->initial_state());
}

TEST(Overburden, LawThatCannotCarryTheWeightIsRefused) {
  const auto material = material_of(elastic(1e3, 0.3, 5000));  // 1.3 kPa against 50 kPa a metre
  auto levels = levels_down(2.0, 4);
  EXPECT_THAT(test::error_of<InputError>([&] {
                find_overburden(deep({{material, 2.0}}), 0.0, levels);
              }),
              ::testing::AllOf(
                  HasSubstr("law elastic cannot carry"),
                  HasSubstr("Pa of weight; allowed: a law that stiffens in confined compression")));
}

}  // namespace
}  // namespace furrow::overburden_test
