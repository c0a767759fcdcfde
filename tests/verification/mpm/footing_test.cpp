// SPDX-License-Identifier: GPL-2.0-or-later
// Flat footings: a rigid punch on an elastic half-space, and a strip on cohesive ground.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "furrow/bodies/rigid_plate.h"

namespace furrow::footing_test {
namespace {

using namespace testing_terrain;

struct Punch {
  double force;        // over 2 a E* d
  double penetration;  // of the springs over d
};

/// A smooth circular punch of radius a on a quarter of ground `size` a wide and deep; cells grow
/// away from it.
Punch punch_force(double cells_per_radius, double size, const char* far) {
  const double a = 0.1, E = 1e6, nu = 0.3, d = 1e-4, cell = a / cells_per_radius, reach = 1.5 * a;
  TerrainParameters p;
  p.layers = {{material_of(elastic(E, nu, 1000)), size * a}};
  p.gravity.setZero();
  p.initial_stress = false;
  p.x = p.y = {0.0, size * a, cell, 0.0, reach, 1.25};
  // a whole number of cells down from the surface
  p.z = {-size * a, 2 * cell, cell, -reach, 2 * cell, 1.25};
  p.surface = 0.0;
  p.cfl = 0.35;
  set_boundary(p, {"smooth", far, "smooth", far, far, "free"});
  PressedGround press(p, {PlateShape::circle, 2 * a, 0.5 * a, 12}, {0, 0, 1e-9});
  ContactParameters smooth;
  smooth.friction = 0.0;
  smooth.stiffness = 2.0;
  smooth.damping = 0.5;
  press.touch(smooth);
  const double ramp = 0.08, hold = 0.16, interval = 5e-4;
  double time = 0.0, sum = 0.0, count = 0.0;
  while (time < hold) {
    press.plate.prescribe(time < ramp ? -(d + 1e-9) / ramp : 0.0);
    press.system.advance(interval);
    time += interval;
    if (time < 0.75 * hold) continue;
    sum += press.contact->force().z();
    count += 1.0;
  }
  return {4.0 * sum / count / (2.0 * a * E / (1 - nu * nu) * d), press.contact->penetration() / d};
}

/// F = 2 a E d/(1 - nu^2) (J. Boussinesq; K. L. Johnson, Contact Mechanics, eq 3.36). The particles
/// beside the edge make the punch wider by up to half a particle, its springs give way by a tenth
/// of d. Ground that ends at walls and a rough base is stiffer; absorbing faces stand for the rest
/// of the half-space.
TEST(Punch, StiffnessIsThatOfTheElasticHalfSpace) {
  const Punch wide = punch_force(4, 8, "absorbing"), narrow = punch_force(4, 4, "absorbing"),
              boxed = punch_force(4, 4, "rough");
  RecordProperty("force",
                 fmt::format("ground of 8 a {:.4f}, of 4 a {:.4f}, in a rough box of 4 a {:.4f}",
                             wide.force, narrow.force, boxed.force));
  RecordProperty("penetration", fmt::format("{:.3f}", wide.penetration));
  EXPECT_NEAR(wide.force, 1.0, 0.03);
  EXPECT_LT(std::abs(wide.force - 1.0), std::abs(narrow.force - 1.0));
  EXPECT_LT(std::abs(narrow.force - 1.0), 0.6 * std::abs(boxed.force - 1.0));
}

/// Mean pressure [Pa] near the end under a strip of half-width 1/2 m on weightless ground: one cell
/// in plane strain, half a model.
/// @param settlement  at the end, in half-widths
/// @param edge_cells  cells at the edge of the strip, and at the surface, for one elsewhere
double bearing_pressure(const std::string& material, double settlement, int cells_per_half_width,
                        double edge_cells, double cfl) {
  const double b = 0.5, cell = b / cells_per_half_width, depth = 2.4 * b, speed = 0.04;
  TerrainParameters p = box(material_of(material), {0, 0, -depth}, {4.4 * b, cell, 0}, cell);
  p.z = even(-depth, 2 * cell, cell);
  if (edge_cells > 1.0) {
    p.x.edges = {b};
    p.z.edges = {0.0};
    p.x.edge_cell = p.z.edge_cell = cell / edge_cells;
  }
  set_boundary(p, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  p.particles_per_cell = {2, 1, 2};
  p.cfl = cfl;
  PressedGround press(p, {PlateShape::square, 2 * b, 0.3, 4}, {0, 0.5 * cell, 1e-6});
  ContactParameters rough;
  rough.friction = std::numeric_limits<double>::infinity();
  press.touch(rough);
  double time = 0.0, sum = 0.0, count = 0.0;
  while (-press.plate.centre().z() < settlement * b) {
    press.plate.prescribe(-speed * std::min(1.0, time / 0.1));
    press.system.advance(2e-3);
    time += 2e-3;
    if (-press.plate.centre().z() < 0.95 * settlement * b) continue;
    sum += press.contact->force().z();
    count += 1.0;
  }
  return sum / count / (b * cell);
}

/// Mises in plane strain: d = sqrt(3) c; E/c = 1000.
double bearing_factor(int cells_per_half_width, double edge_cells, double nu = 0.3,
                      double cfl = 0.6) {
  constexpr double c = 1e4, E = 1e7;
  const std::string material = fmt::format(
      "drucker_prager_cap density 2000 d {} beta 0.001 R 0.1 elasticity linear "
      "E {} nu {} hardening table p 1e9 2e9 "
      "eps_vol_pl 0 1 interpolation linear beyond extrapolate",
      std::sqrt(3.0) * c, E, nu);
  return bearing_pressure(material, 0.04, cells_per_half_width, edge_cells, cfl) / c;
}

constexpr double prandtl = 2.0 + pi;

/// L. Prandtl (1920): q = (2 + pi) c. The answer comes from above, with about the first order of
/// the cell: the singular edge of the strip.
TEST(StripFooting, BearingCapacityConvergesToPrandtl) {
  const double coarse = bearing_factor(5, 1), fine = bearing_factor(10, 1),
               extrapolated = 2 * fine - coarse;
  RecordProperty("bearing_factor",
                 fmt::format("b/5 {:.3f}, b/10 {:.3f}, first order to zero {:.3f}; Prandtl {:.3f}",
                             coarse, fine, extrapolated, prandtl));
  EXPECT_LT(coarse, 1.13 * prandtl);
  EXPECT_GT(coarse, fine);
  EXPECT_GT(fine, prandtl);
  EXPECT_LT(fine, 1.075 * prandtl);
  EXPECT_NEAR(extrapolated, prandtl, 0.03 * prandtl);
}

/// Cells of a quarter at the edge and the surface alone.
TEST(StripFooting, ShortCellsAtTheEdgeSuffice) {
  const double coarse = bearing_factor(5, 4), fine = bearing_factor(10, 4);
  RecordProperty("bearing_factor", fmt::format("b/5 {:.3f}, b/10 {:.3f}", coarse, fine));
  EXPECT_NEAR(coarse, prandtl, 0.05 * prandtl);
  EXPECT_NEAR(fine, prandtl, 0.035 * prandtl);
}

/// The load of ground that flows at constant volume does not depend on its bulk modulus.
TEST(StripFooting, NearlyIncompressibleGroundDoesNotLock) {
  const double soft = bearing_factor(5, 1, 0.3, 0.4), stiff = bearing_factor(5, 1, 0.49, 0.4);
  RecordProperty("bearing_factor", fmt::format("nu 0.3 {:.3f}, nu 0.49 {:.3f}", soft, stiff));
  EXPECT_NEAR(stiff, soft, 0.02 * soft);
}

}  // namespace
}  // namespace furrow::footing_test
