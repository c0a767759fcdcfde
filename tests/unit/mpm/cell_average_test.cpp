// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/transfer/cell_average.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "furrow/core/types.h"

namespace furrow::cell_average_test {
namespace {

/// Particles of three cells with random volume, stress and strain increment.
struct Points {
  Points() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto fill = [&](std::vector<double>& values) {
      for (std::size_t p = 0; p < cell.size(); ++p) values.push_back(1.0 + unit(random));
    };
    fill(volume);
    fill(ratio);
    for (auto& s : stress) fill(s);
    for (std::size_t g = 0; g < 9; ++g) {
      fill(h[g]);
      gradient[g] = h[g].data();
    }
    for (std::size_t a = 0; a < 3; ++a) normal[a] = copies[a].data();
  }
  ParticleView view() const {
    ParticleView v;
    v.size = cell.size();
    v.cell = cell.data();
    v.volume = volume.data();
    v.volume_ratio = ratio.data();
    for (std::size_t s = 0; s < 6; ++s) v.stress[s] = stress[s].data();
    return v;
  }
  double trace(std::size_t p) const { return h[0][p] + h[4][p] + h[8][p]; }
  double current_volume(std::size_t p) const { return volume[p] * ratio[p]; }

  std::vector<double> cell = {4, 4, 4, 7, 9, 9, 9, 9};
  std::vector<double> volume, ratio, stress[6], h[9];
  std::vector<double> copies[3] = {std::vector<double>(8), std::vector<double>(8),
                                   std::vector<double>(8)};
  double *gradient[9], *normal[3];
};

/// sum V theta of each cell stays, its particles have one theta, and the deviator stays.
TEST(CellAverage, CellKeepsVolumeAndDeviator) {
  Points points;
  const Points old;
  average_volume_change(points.view(), points.gradient);
  const std::size_t ends[] = {0, 3, 4, 8};
  for (std::size_t c = 0; c < 3; ++c) {
    double change = 0.0;
    for (std::size_t p = ends[c]; p < ends[c + 1]; ++p) {
      change += points.current_volume(p) * (points.trace(p) - old.trace(p));
      EXPECT_NEAR(points.trace(p), points.trace(ends[c]), 1e-14);
      for (std::size_t g = 0; g < 9; ++g) {
        const double third = g % 4 == 0 ? 1.0 / 3.0 : 0.0;
        EXPECT_NEAR(points.h[g][p] - third * points.trace(p), old.h[g][p] - third * old.trace(p),
                    1e-14);
      }
    }
    EXPECT_NEAR(change, 0.0, 1e-13);
  }
  EXPECT_EQ(points.h[0][3], old.h[0][3]);  // alone in its cell
}

/// sum V p(mean) theta = sum V p theta(mean): the energy that the grid loses is the work that the
/// material gets.
TEST(CellAverage, MeanPressureAndMeanVolumeChangeDoTheSameWork) {
  Points points;
  ParticleView averaged = points.view();
  average_pressure(averaged, points.normal);
  double of_forces = 0.0, of_material = 0.0;
  const auto work = [&](const ParticleView& v, std::size_t p) {
    return points.current_volume(p) *
           (v.stress[0][p] * points.h[0][p] + v.stress[1][p] * points.h[4][p] +
            v.stress[2][p] * points.h[8][p]);
  };
  for (std::size_t p = 0; p < averaged.size; ++p) of_forces += work(averaged, p);
  average_volume_change(points.view(), points.gradient);
  for (std::size_t p = 0; p < averaged.size; ++p) of_material += work(points.view(), p);
  EXPECT_NEAR(of_forces, of_material, 1e-13 * of_material);
  EXPECT_NE(averaged.stress[0][0], points.stress[0][0]);
  EXPECT_EQ(averaged.stress[3], points.stress[3].data());
}

}  // namespace
}  // namespace furrow::cell_average_test
