// SPDX-License-Identifier: GPL-2.0-or-later
// A sphere pressed into a faceted sheet gives Hertz's force F = 4/3 E* sqrt(R) delta^(3/2)
// everywhere: on faces, over edges and corners, on flat, convex and concave sheets, also when the
// sheet was flat at the start and bent afterwards, also with obtuse triangles. Closed form: Hertz
// (1882), with E* = E/(2 (1 - nu^2)) for equal materials.

#include <cmath>

#include <gtest/gtest.h>

#include "atom.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/max_error.h"
#include "update.h"

namespace furrow::test::hertz_on_facets_test {
namespace {

constexpr double young = 5e6, poisson = 0.3, radius = 0.004, overlap = 4e-6, side = 0.2,
                 height = 0.1;
constexpr int cells = 20;

double hertz_force() {
  return 4.0 / 3.0 * young / (2.0 * (1.0 - poisson * poisson)) * std::sqrt(radius) *
         std::pow(overlap, 1.5);
}

/// Cross-section of a sheet bent to a cylinder: z(x), curvature > 0 convex upwards, < 0 concave, 0
/// flat.
double profile(double x, double curvature) {
  if (curvature == 0.0) return height;
  const double r = 1.0 / std::abs(curvature), sag = r - std::sqrt(r * r - x * x);
  return curvature > 0.0 ? height - sag : height + sag;
}

/// The path of a sphere's centre that keeps the overlap constant on a polygon of facets: parallel
/// to the faces, about a convex edge, and turning where the two planes are equally deep in a
/// concave one.
std::vector<Vector2> centre_path(double curvature, double step) {
  std::vector<Vector2> corner(cells + 1);
  for (int i = 0; i <= cells; ++i) {
    const double x = -side / 2 + side * i / cells;
    corner[static_cast<std::size_t>(i)] = Vector2(x, profile(x, curvature));
  }
  const double offset = radius - overlap;
  std::vector<Vector2> path;
  for (std::size_t i = 2; i + 2 < corner.size(); ++i) {
    const Vector2 along = (corner[i + 1] - corner[i]).normalized(), normal(-along[1], along[0]);
    const Vector2 before = (corner[i] - corner[i - 1]).normalized(),
                  after = (corner[i + 2] - corner[i + 1]).normalized();
    const auto turn = [](const Vector2& a, const Vector2& b) {
      return std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    };
    const double in = turn(before, along), out = turn(along, after);  // positive: concave
    const double begin = in > 0 ? offset * std::tan(in / 2) : 0.0;
    const double end =
        (corner[i + 1] - corner[i]).norm() - (out > 0 ? offset * std::tan(out / 2) : 0.0);
    for (double s = begin; s < end; s += step)
      path.push_back(corner[i] + s * along + offset * normal);
    for (double angle = 0.0; angle < -out; angle += step / offset)
      path.push_back(corner[i + 1] +
                     offset * Vector2(normal[0] * std::cos(angle) + along[0] * std::sin(angle),
                                      normal[1] * std::cos(angle) + along[1] * std::sin(angle)));
  }
  return path;
}

struct Case {
  double curvature;
  bool bent_after_start;
  bool obtuse;
  const char* name;
};

class HertzOnFacets : public testing::TestWithParam<Case> {};

TEST_P(HertzOnFacets, ForceIsHertzOnFacesEdgesAndCorners) {
  const Case& c = GetParam();
  Surface start = make_sheet(cells, side, height);
  // shear of the sheet in its plane: angles beyond 120 degrees
  const double shear = c.obtuse ? 1.5 : 0.0;
  start.x.row(1) += shear * start.x.row(0);
  const Matrix3X flat = start.x;
  const auto bend = [&](Surface& surface) {
    for (Eigen::Index n = 0; n < flat.cols(); ++n)
      surface.x(2, n) = profile(flat(0, n), c.curvature);
  };
  if (!c.bent_after_start) bend(start);

  Scene scene;
  scene.granular_box(Vector3(-0.11, -0.3, 0), Vector3(0.11, 0.3, 0.2), 0.0015);
  scene.contact_properties(young, poisson, 0.3, 0.0);
  scene.commands("pair_style gran model hertz tangential history\npair_coeff * *\ntimestep 1e-5");
  scene.add_body("sheet", std::make_unique<PrescribedBody>(
                              start, [&](double, Surface& surface) { bend(surface); }));
  scene.commands(
      "fix skin all mesh/body body sheet type 1\n"
      "fix walls all wall/gran/body model hertz tangential history mesh n_meshes 1 meshes skin");
  const std::vector<Vector2> path = centre_path(c.curvature, 5e-5);
  const auto lateral = [=](double x) {
    return shear * x + 0.0031 + 0.004 * std::sin(40.0 * x);
  };  // wanders over diagonals and corners
  scene.command("create_atoms 1 single " + std::to_string(path[0][0]) + " " +
                std::to_string(lateral(path[0][0])) + " 0.15");
  scene.command("set group all density 2500 diameter 0.008");
  std::size_t index = 0;
  scene.at_start_of_step([&] {
    LAMMPS_NS::Atom& atom = *scene.lammps().atom;
    for (int i = 0; i < atom.nlocal; ++i) {
      atom.x[i][0] = path[index][0];
      atom.x[i][1] = lateral(path[index][0]);
      atom.x[i][2] = path[index][1];
    }
    ++index;
  });
  Range normal_force;
  scene.at_end_of_step([&] {
    LAMMPS_NS::Atom& atom = *scene.lammps().atom;
    Vector3 force = Vector3::Zero();
    for (int i = 0; i < atom.nlocal; ++i) force += Eigen::Map<const Vector3>(atom.f[i]);
    for (int k = 0; k < 3; ++k) force[k] = scene.sum(force[k]);
    normal_force.add(force.norm());
  });
  scene.command("run " + std::to_string(path.size() - 1));
  const coupling::MomentumAudit& audit = scene.system().audit(scene.body("sheet"));
  EXPECT_EQ(normal_force.count(), path.size() - 1);
  EXPECT_NEAR(normal_force.min() / hertz_force(), 1.0, 1e-3);
  EXPECT_NEAR(normal_force.max() / hertz_force(), 1.0, 1e-3);
  EXPECT_GT(audit.force_scale, 0.5 * hertz_force());
  EXPECT_LT(audit.force, 1e-10);
  EXPECT_LT(audit.moment, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Sheets, HertzOnFacets,
                         testing::Values(Case{0.0, false, false, "flat"},
                                         Case{5.0, false, false, "convex"},
                                         Case{-5.0, false, false, "concave"},
                                         Case{5.0, true, false, "convex_bent_after_start"},
                                         Case{-5.0, true, false, "concave_bent_after_start"},
                                         Case{0.0, false, true, "flat_obtuse"},
                                         Case{5.0, true, true, "convex_obtuse_bent"},
                                         Case{-5.0, true, true, "concave_obtuse_bent"}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace furrow::test::hertz_on_facets_test
