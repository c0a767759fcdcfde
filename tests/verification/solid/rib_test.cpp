// SPDX-License-Identifier: GPL-2.0-or-later
// Does a rib of rubber buckle under the stress of a print? Bricks against Euler's column.

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "brick_model.h"
#include "furrow/core/symmetric_eigenvalues.h"

namespace furrow::test::rib_test {
namespace {

/// The ribbed tread of [Shoop2001], Table 9: C10 2.408340 MPa; K = 50 mu assumed.
Rubber ribbed() { return {{4.81668e6, 50.0 * 4.81668e6}, 662.55}; }

/// [Pa] E/(1 - nu^2): bending in plane strain.
double plane_modulus(const Rubber& rubber) {
  const double K = rubber.law.bulk, G = rubber.law.shear;
  const double E = 9.0 * K * G / (3.0 * K + G), nu = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G));
  return E / (1.0 - nu * nu);
}

/// A slice of a long rib: its base is held, its top stays level and may slide along the road.
class Rib {
 public:
  Rib(double width, double height, int across, int up)
      : width_(width),
        height_(height),
        model_(mapped_bricks(
            across, 1, up,
            [&](double r, double s, double t) { return Vector3(width * r, depth * s, height * t); },
            ribbed())) {
    model_.hold([](const Vector3&) { return true; }, {1});
    model_.hold([](const Vector3& x) { return x.z() < 1e-9; }, {0, 2});
    model_.hold([&](const Vector3& x) { return on_top(x); }, {2});
  }

  /// To rest with the top lowered by a share of the height.
  void press(double share) {
    for (Eigen::Index n = 0; n < model_.x.cols(); ++n)
      if (on_top(model_.reference.col(n))) model_.x(2, n) = (1.0 - share) * height_;
    model_.solve();
  }
  /// [Pa] on the unloaded top
  double stress() {
    const Matrix3X f = model_.forces();
    double sum = 0.0;
    for (Eigen::Index n = 0; n < f.cols(); ++n)
      if (on_top(model_.reference.col(n))) sum += f(2, n);
    return sum / (width_ * depth);
  }
  bool is_stable() {
    ElementTangents tangents(model_.reference, model_.mesh.bricks(), model_.rubber);
    const std::vector<Matrix24> elements = tangents(model_.x);
    const Eigen::Index size = model_.x.size();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (int i = 0; i < 24; ++i)
        for (int j = 0; j < 24; ++j)
          K(3 * model_.mesh.bricks()[e][static_cast<std::size_t>(i / 3)] + i % 3,
            3 * model_.mesh.bricks()[e][static_cast<std::size_t>(j / 3)] + j % 3) +=
              0.5 * (elements[e](i, j) + elements[e](j, i));
    for (Eigen::Index i = 0; i < size; ++i)
      if (model_.is_free.data()[i] == 0.0) {
        K.row(i).setZero();
        K.col(i).setZero();
        K(i, i) = ribbed().law.shear * width_;
      }
    return symmetric_eigenvalues(K).minCoeff() > 0.0;
  }

 private:
  static constexpr double depth = 1e-3;  // [m] along the rib
  bool on_top(const Vector3& x) const { return x.z() > height_ - 1e-9; }

  double width_, height_;  // [m]
  BrickModel model_;
};

/// [Pa] at which it is no longer stable, pressed by a share of its height and then by steps;
/// infinite if it is stable up to `end`.
double buckling_stress(Rib rib, double first, double step, double end) {
  for (double share = first; share < end; share += step) {
    rib.press(share);
    if (!rib.is_stable()) return rib.stress();
  }
  return std::numeric_limits<double>::infinity();
}

/// Clamped below, level and free to sway above: pi^2 E' I/h^2, with width and height as they are
/// when it buckles, squeezed by e at a constant volume: 1/(1 - e)^5 of that.
TEST(Rib, SlenderRibBucklesAsAnEulerColumn) {
  const double width = 2e-3, height = 20e-3, modulus = plane_modulus(ribbed());
  const double euler = pi * pi * modulus * std::pow(width / height, 2) / 12.0;
  const double found = buckling_stress(Rib(width, height, 4, 20), 7.5e-3, 1e-4, 0.02);
  EXPECT_NEAR(found * std::pow(1.0 - euler / modulus, 5) / euler, 1.0, 0.05);
}

/// The narrowest rib of p235_75r15_ribbed, 15.4 mm wide and 5.3 mm high, is stable far beyond the
/// largest stress of its print, 0.86 MPa, with one brick or several through its width.
TEST(Rib, RibOfTheTyreIsStableAt4TimesThePrintStress) {
  const double width = 15.4e-3, height = 5.3e-3;
  for (const auto& [across, up] : {std::pair(1, 1), std::pair(2, 1), std::pair(4, 2)}) {
    Rib rib(width, height, across, up);
    double stress = 0.0, share = 0.0;
    while (stress < 4.0 * 0.86e6) {
      rib.press(share += 0.01);
      stress = rib.stress();
      ASSERT_TRUE(rib.is_stable()) << across << " bricks, squeezed by " << share;
    }
    const double buckling = buckling_stress(Rib(width, height, across, up), 0.02, 0.02, 0.6);
    RecordProperty(fmt::format("buckling_stress_MPa_{}x{}", across, up),
                   fmt::format("{:.2f}", 1e-6 * buckling));
  }
}

}  // namespace
}  // namespace furrow::test::rib_test
