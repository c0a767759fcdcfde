// SPDX-License-Identifier: GPL-2.0-or-later
// The proposed standard set of R. H. MacNeal and R. L. Harder, Finite Elem. Anal. Des. 1 (1985)
// 3-20, with T. Belytschko's obstacle course, Comput. Methods Appl. Mech. Eng. 51 (1985) 221-258.
// References are the theoretical values printed there. Small displacements.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shell_model.h"

namespace furrow::test::macneal_harder_test {
namespace {

Vector3 along_x(const Vector3&) { return Vector3::UnitX(); }
Vector3 along_z(const Vector3&) { return Vector3::UnitZ(); }

/// Ratios to the reference over meshes; the last must be within the tolerance, and closer than the
/// first.
void expect_convergence(const char* name, const std::vector<int>& meshes,
                        const std::function<double(int)>& ratio, double coarse, double fine) {
  std::string line;
  std::vector<double> ratios;
  for (const int n : meshes) {
    ratios.push_back(ratio(n));
    line += fmt::format("  {}: {:.4f}", n, ratios.back());
  }
  ::testing::Test::RecordProperty(std::string(name) + "_over_reference", line);
  EXPECT_NEAR(ratios.front(), 1.0, coarse) << name;
  EXPECT_NEAR(ratios.back(), 1.0, fine) << name;
  EXPECT_LE(std::abs(ratios.back() - 1.0), std::abs(ratios.front() - 1.0) + 1e-3) << name;
}

/// Cylinder on rigid end diaphragms, pinched by two opposite forces of 1: under the force 1.8248e-5
/// (Belytschko et al.).
double pinched_cylinder(int n) {
  const double R = 300, L = 600, h = 3;
  const ShellSection section(OrthotropicLayer::isotropic(3e6, 0.3, h), 1.0);
  ShellModel model = mapped_shell(
      n, n,
      [&](double s, double t) {
        const double angle = 0.5 * pi * s;
        return Vector3(0.5 * L * t, -R * std::cos(angle), R * std::sin(angle));
      },
      section, along_x);
  const double tiny = 1e-6 * R;
  model.symmetry(0, [&](const Vector3& x) { return x.x() < tiny; });
  model.symmetry(1, [&](const Vector3& x) { return x.y() > -tiny; });
  model.symmetry(2, [&](const Vector3& x) { return x.z() < tiny; });
  for (Eigen::Index i = 0; i < model.nodes.count(); ++i)
    if (model.nodes.x(0, i) > 0.5 * L - tiny) model.nodes.free_to_move.col(i).tail<2>().setZero();
  const Eigen::Index loaded = model.nearest({0, 0, R});
  model.load(2, loaded) = -0.25;
  return -model.solve()(2, loaded) / 1.8248e-5;
}

/// Roof under its own weight on end diaphragms; vertical displacement of the middle of the free
/// edge, 0.3024.
double scordelis_lo(int n) {
  const double R = 25, L = 50, h = 0.25, weight = 90;
  const ShellSection section(OrthotropicLayer::isotropic(4.32e8, 0.0, h), 1.0);
  ShellModel model = mapped_shell(
      n, n,
      [&](double s, double t) {
        const double angle = radians(40) * s;
        return Vector3(0.5 * L * t, -R * std::sin(angle), R * std::cos(angle));
      },
      section, along_x);
  const double tiny = 1e-6 * R;
  model.symmetry(0, [&](const Vector3& x) { return x.x() < tiny; });
  model.symmetry(1, [&](const Vector3& x) { return x.y() > -tiny; });
  for (Eigen::Index i = 0; i < model.nodes.count(); ++i) {
    if (model.nodes.x(0, i) > 0.5 * L - tiny) model.nodes.free_to_move.col(i).tail<2>().setZero();
    model.load(2, i) = -weight * model.shell.mass()[i];  // areal mass 1: the mass is the area
  }
  const Eigen::Index edge =
      model.nearest({0, -R * std::sin(radians(40)), R * std::cos(radians(40))});
  return -model.solve()(2, edge) / 0.3024;
}

/// Hemisphere with an 18 degree hole pulled and pushed by forces of 2 at its equator: 0.0940.
/// Nearly inextensional.
double hemisphere(int n) {
  const double R = 10, h = 0.04;
  const ShellSection section(OrthotropicLayer::isotropic(6.825e7, 0.3, h), 1.0);
  ShellModel model = mapped_shell(
      n, n,
      [&](double s, double t) {
        const double longitude = 0.5 * pi * s, latitude = radians(72) * t;
        return Vector3(R * std::cos(latitude) * std::cos(longitude),
                       R * std::cos(latitude) * std::sin(longitude), R * std::sin(latitude));
      },
      section, along_z);
  const double tiny = 1e-6 * R;
  model.symmetry(0, [&](const Vector3& x) { return x.x() < tiny; });
  model.symmetry(1, [&](const Vector3& x) { return x.y() < tiny; });
  const Eigen::Index a = model.nearest({R, 0, 0}), b = model.nearest({0, R, 0});
  model.nodes.free_to_move(2, a) = 0.0;
  model.load(0, a) = 1.0;
  model.load(1, b) = -1.0;
  return model.solve()(0, a) / 0.0940;
}

/// Beam twisted by 90 degrees, clamped at one end, a unit force across at the other; n elements
/// across, 6 n along.
/// @param in_plane the force along the end's width (0.005424), else across it (0.001754), for h =
/// 0.32
double twisted_beam(int n, double h, bool in_plane, double reference) {
  const double L = 12, width = 1.1;
  const ShellSection section(OrthotropicLayer::isotropic(29e6, 0.22, h), 1.0);
  ShellModel model = mapped_shell(
      6 * n, n,
      [&](double s, double t) {
        const double angle = 0.5 * pi * s, across = width * (t - 0.5);
        return Vector3(L * s, across * std::cos(angle), across * std::sin(angle));
      },
      section, along_x);
  for (Eigen::Index i = 0; i < model.nodes.count(); ++i)
    if (model.nodes.x(0, i) < 1e-6) model.nodes.hold(i);
  const int direction = in_plane ? 2 : 1;  // the end lies along z
  for (int j = 0; j <= n; ++j)
    model.load(direction, model.nearest({L, 0, width * (double(j) / n - 0.5)})) +=
        (j == 0 || j == n ? 0.5 : 1.0) / n;
  return model.solve()(direction, model.nearest({L, 0, 0})) / reference;
}

TEST(MacNealHarder, PinchedCylinderConverges) {
  expect_convergence("pinched cylinder", {8, 16, 32}, pinched_cylinder, 0.30, 0.02);
}
TEST(MacNealHarder, ScordelisLoRoofConverges) {
  expect_convergence("Scordelis-Lo roof", {4, 8, 16, 32}, scordelis_lo, 0.08, 0.01);
}
TEST(MacNealHarder, HemisphereConverges) {
  expect_convergence("hemisphere", {4, 8, 16, 32}, hemisphere, 0.10, 0.01);
}
TEST(MacNealHarder, TwistedBeamConverges) {
  for (const bool in_plane : {true, false})
    expect_convergence(
        in_plane ? "twisted beam, in plane" : "twisted beam, out of plane", {2, 4, 8},
        [&](int n) { return twisted_beam(n, 0.32, in_plane, in_plane ? 5.424e-3 : 1.754e-3); },
        0.03, 0.01);
}
/// Thickness 0.0032 (Belytschko et al. 1989): 5256 and 1294 for a unit force, of an element that
/// does not lock in its membrane.
TEST(MacNealHarder, ThinTwistedBeamConverges) {
  for (const bool in_plane : {true, false})
    expect_convergence(
        in_plane ? "thin twisted beam, in plane" : "thin twisted beam, out of plane", {2, 4, 8},
        [&](int n) { return twisted_beam(n, 0.0032, in_plane, in_plane ? 5256.0 : 1294.0); }, 0.05,
        0.01);
}

}  // namespace
}  // namespace furrow::test::macneal_harder_test
