// SPDX-License-Identifier: GPL-2.0-or-later
// A light, stiff, deforming body on grains: the exchange of forces once a LIGGGHTS step must stay
// stable and keep the balance of energy. Statics and energy conservation are the references.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/membrane.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/max_error.h"
#include "update.h"

namespace furrow::test::membrane_on_bed_test {
namespace {

constexpr double gravity = 9.81, side = 0.08;
constexpr const char* hertz = "model hertz tangential history";

std::unique_ptr<Membrane> make_cover(double height, const MembraneMaterial& material,
                                     double pressure) {
  const int cells = 10;
  Surface sheet = make_sheet(cells, side, height, true);
  std::vector<int> edge;
  for (Eigen::Index n = 0; n < sheet.x.cols(); ++n)
    if (std::max(std::abs(sheet.x(0, n)), std::abs(sheet.x(1, n))) > side / 2 - 1e-9)
      edge.push_back(static_cast<int>(n));
  auto membrane = std::make_unique<Membrane>(sheet, material, edge);
  membrane->set_pressure(pressure);
  return membrane;
}

/// Frictionless side walls, a bed of 300 grains that falls onto a membrane which is blown up from
/// below.
void make_bed_on_membrane(Scene& scene, const MembraneMaterial& material, double pressure,
                          double young, double step) {
  scene.granular_box(Vector3(-side / 2 - 0.001, -side / 2 - 0.001, 0),
                     Vector3(side / 2 + 0.001, side / 2 + 0.001, 0.2), 0.002);
  scene.contact_properties(young, 0.3, 0.5, 0.0);
  scene.grains_fall(hertz, step, gravity);
  scene.add_body("cover", make_cover(0.03, material, pressure));
  scene.wall_of_body("cover", hertz, "walls");
  scene.flat_walls(hertz, {"xplane -0.04", "xplane 0.04", "yplane -0.04", "yplane 0.04"});
  scene.pour(0.004, "block -0.04 0.04 -0.04 0.04 0.045 0.15", "particles_in_region 300");
  scene.commands("thermo 100000");
}

TEST(MembraneOnBed, InflatedMembraneCarriesItsWeight) {
  Scene scene;
  // 1 mm rubber, two sub-steps a LIGGGHTS step; twice the pressure of the bed, so that it bulges
  // upwards.
  make_bed_on_membrane(scene, {2e7, 0.3, 1e-3, 1000.0, 30.0}, 1000.0, 5e6, 2e-5);
  scene.command("fix calm all viscous 0.02");
  scene.command("run 50000");
  scene.command("unfix calm");
  double sum = 0.0;
  int samples = 0;
  auto& membrane = static_cast<Membrane&>(scene.body("cover"));
  scene.at_end_of_step([&] {
    sum += membrane.surface().total_force()[2];
    ++samples;
  });
  const double momentum_before = scene.upward_momentum();
  scene.command("run 1000");
  // Impulse of the membrane = weight x time + change of the bed's momentum: holds also while grains
  // still tremble.
  const double weight = scene.grain_mass() * gravity,
               momentum_rate = (scene.upward_momentum() - momentum_before) / (1000 * 2e-5);
  const double carried = -sum / samples / (weight + momentum_rate);
  EXPECT_GT(membrane.surface().x.row(2).maxCoeff(), 0.031);  // it does bulge
  EXPECT_NEAR(carried, 1.0, 1e-5);
  EXPECT_LT(std::abs(momentum_rate), 0.01 * weight);  // at rest, nearly
  const coupling::MomentumAudit& audit = scene.system().audit(membrane);
  EXPECT_GT(audit.force_scale, 0.5 * weight);
  EXPECT_LT(audit.force, 1e-10);
  EXPECT_LT(audit.moment, 1e-10);
}

/// No damping in the membrane, elastic enough to throw the grains up again and again: 1e5 steps,
/// works and energies must add up.
TEST(MembraneOnBed, EnergyBalanceClosesOver100000StepsOfBouncing) {
  Scene scene;
  make_bed_on_membrane(scene, {2e6, 0.3, 0.5e-3, 1000.0, 0.0}, 0.0, 5e6, 1e-5);
  auto& membrane = static_cast<Membrane&>(scene.body("cover"));
  MaxError imbalance;
  double throughput = 0.0, before = 0.0;
  scene.at_end_of_step([&] {
    const EnergyBudget budget = membrane.energy_budget();
    throughput += std::abs(budget.contact_work - before);
    before = budget.contact_work;
    imbalance.add(budget.residual());
  });
  scene.command("run 100000");
  EXPECT_GT(throughput, 10 * membrane.energy_budget().stored_energy);  // many bounces, not one
  EXPECT_LT(imbalance.max(), 0.01 * throughput);
}

}  // namespace
}  // namespace furrow::test::membrane_on_bed_test
