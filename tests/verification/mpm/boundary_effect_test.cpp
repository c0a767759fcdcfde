// SPDX-License-Identifier: GPL-2.0-or-later
// Expected effects of sides and base of the ground, next to the runs of the study
// inputs/validation/ground_size.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/io/inputs/material_file.h"
#include "furrow/mpm/ground/boundary_effect.h"

namespace furrow::boundary_effect_test {
namespace {

const std::string inputs = std::string(FURROW_SOURCE_DIR) + "/inputs/";

GroundKind kind_of(const std::string& file) {
  return ground_kind(*read_material_file(inputs + file).make());
}

TEST(GroundKind, CompactionAndFrictionSetTheKind) {
  for (const char* snow :
       {"fresh_snow", "fresh_snow_cam_clay", "fresh_snow_foam", "field_snow", "snow"})
    EXPECT_EQ(kind_of(fmt::format("materials/{}.yaml", snow)), GroundKind::snow) << snow;
  for (const char* sand : {"dry_sand", "dry_sand_smooth", "grc1", "norsand_loose", "norsand_dry",
                           "norsand_dense", "mccormick_sand"})
    EXPECT_EQ(kind_of(fmt::format("materials/{}.yaml", sand)), GroundKind::sand) << sand;
  for (const char* clay : {"validation/ground_size/clay", "materials/clay_soft",
                           "materials/clay_medium", "materials/clay_stiff"})
    EXPECT_EQ(kind_of(fmt::format("{}.yaml", clay)), GroundKind::clay) << clay;
  EXPECT_EQ(kind_of("materials/compacted_sand_elastic.yaml"), GroundKind::clay);
}

struct Fit {
  std::string kind, body, edge, quantity;
  BoundaryEffect effect;
};

/// Rows of effects.csv.
std::vector<Fit> stored_fits() {
  std::ifstream file(inputs + "validation/ground_size/effects.csv");
  std::vector<Fit> fits;
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "kind,body,edge,quantity,a,c,residual,runs");
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    Fit fit;
    cells >> fit.kind >> fit.body >> fit.edge >> fit.quantity >> fit.effect.amplitude >>
        fit.effect.decay;
    fits.push_back(fit);
  }
  return fits;
}

/// To 0.005, within the distances of the runs.
TEST(BoundaryEffect, ConstantsAreTheFitsOfTheStudy) {
  const std::vector<Fit> fits = stored_fits();
  EXPECT_EQ(fits.size(), 18u);
  for (const Fit& fit : fits)
    for (const GroundKind kind : {GroundKind::sand, GroundKind::clay, GroundKind::snow}) {
      if (fit.kind != name_of(kind)) continue;
      const PressedBy tool = fit.body == "wheel" ? PressedBy::wheel : PressedBy::plate;
      const BoundaryEffects effects =
          fit.edge == "width" ? effects_of_sides(kind, tool) : effects_of_base(kind, tool);
      const BoundaryEffect& effect =
          fit.quantity == "net_traction" ? effects.traction : effects.response;
      for (const double x : {0.5, 1.0, 2.0})
        EXPECT_NEAR(effect.at(x), fit.effect.at(x), 0.005)
            << fit.kind << ' ' << fit.body << ' ' << fit.edge << ' ' << fit.quantity << ' ' << x;
    }
}

TEST(BoundaryEffect, EffectIsSmallAtTheRecommendedSize) {
  for (const GroundKind kind : {GroundKind::sand, GroundKind::clay, GroundKind::snow})
    for (const PressedBy tool : {PressedBy::wheel, PressedBy::plate})
      for (const BoundaryEffects& effects :
           {effects_of_sides(kind, tool), effects_of_base(kind, tool)}) {
        const double x = effects.enough();
        EXPECT_LT(std::abs(effects.response.at(x)), 0.02 + 1e-9);
        EXPECT_LT(std::abs(effects.traction.at(x)), 0.01 + 1e-9);
        if (x > 0.0) {
          EXPECT_TRUE(std::abs(effects.response.at(0.99 * x)) > 0.02 ||
                      std::abs(effects.traction.at(0.99 * x)) > 0.01);
        }
      }
}

}  // namespace
}  // namespace furrow::boundary_effect_test
