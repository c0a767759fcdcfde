// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/quintic_spline.h"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/max_error.h"

namespace furrow::quintic_spline_test {
namespace {

template <class Function>
QuinticSpline3 spline_of(Function f, const std::array<GridAxis, 3>& axes) {
  std::vector<double> values;
  for (int i = 0; i < axes[0].nodes; ++i)
    for (int j = 0; j < axes[1].nodes; ++j)
      for (int k = 0; k < axes[2].nodes; ++k)
        values.push_back(f(axes[0].node(i), axes[1].node(j), axes[2].node(k)));
  return QuinticSpline3::through(axes, values);
}

TEST(QuinticSpline, PolynomialsOfDegreeFiveAreExact) {
  const auto f = [](double x, double y, double z) {
    return std::pow(x, 5) - 2 * x * std::pow(y, 5) + x * x * std::pow(z, 4) * y -
           3 * std::pow(z, 5) + x * y * z + 1;
  };
  const QuinticSpline3 spline =
      spline_of(f, {GridAxis{-1, 1, 6}, GridAxis{0, 2, 9}, GridAxis{0.5, 1.5, 7}});
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    const double x = 2 * uniform(engine) - 1, y = 2 * uniform(engine), z = 0.5 + uniform(engine);
    QuinticSpline3::Value value;
    spline.evaluate({x, y, z}, value, true);
    EXPECT_NEAR(value.f, f(x, y, z), 1e-11);
    EXPECT_NEAR(value.gradient[0],
                5 * std::pow(x, 4) - 2 * std::pow(y, 5) + 2 * x * std::pow(z, 4) * y + y * z, 1e-9);
    EXPECT_NEAR(value.gradient[1], -10 * x * std::pow(y, 4) + x * x * std::pow(z, 4) + x * z, 1e-9);
    EXPECT_NEAR(value.gradient[2], 4 * x * x * std::pow(z, 3) * y - 15 * std::pow(z, 4) + x * y,
                1e-9);
    EXPECT_NEAR(value.hessian(0, 0), 20 * std::pow(x, 3) + 2 * std::pow(z, 4) * y, 1e-7);
    EXPECT_NEAR(value.hessian(1, 1), -40 * x * std::pow(y, 3), 1e-7);
    EXPECT_NEAR(value.hessian(2, 2), 12 * x * x * z * z * y - 60 * std::pow(z, 3), 1e-7);
    EXPECT_NEAR(value.hessian(0, 1), -10 * std::pow(y, 4) + 2 * x * std::pow(z, 4) + z, 1e-7);
    EXPECT_NEAR(value.hessian(0, 2), 8 * x * std::pow(z, 3) * y + y, 1e-7);
    EXPECT_NEAR(value.hessian(1, 2), 4 * x * x * std::pow(z, 3) + x, 1e-7);
  }
}

/// Halving the steps divides the largest errors by 2^6 (value), 2^5 (gradient), 2^4 (second
/// derivatives) at least.
TEST(QuinticSpline, ErrorsFallWithTheirOrder) {
  const auto f = [](double x, double y, double z) { return std::exp(x) * std::sin(2 * y + z); };
  std::array<std::array<test::MaxError, 3>, 2> errors;
  for (std::size_t level = 0; level < 2; ++level) {
    const int n = level == 0 ? 17 : 33;
    const QuinticSpline3 spline =
        spline_of(f, {GridAxis{0, 2, n}, GridAxis{0, 2, n}, GridAxis{0, 2, n}});
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> uniform(0.0, 2.0);
    for (int k = 0; k < 4000; ++k) {
      const double x = uniform(engine), y = uniform(engine), z = uniform(engine);
      QuinticSpline3::Value value;
      spline.evaluate({x, y, z}, value, true);
      const double e = std::exp(x), s = std::sin(2 * y + z), c = std::cos(2 * y + z);
      errors[level][0].add(value.f - e * s);
      errors[level][1].add((value.gradient - Vector3(e * s, 2 * e * c, e * c)).norm());
      errors[level][2].add(value.hessian(1, 1) + 4 * e * s);
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_GT(errors[0][k].max() / errors[1][k].max(), std::pow(2.0, 5.7 - static_cast<double>(k)))
        << "derivative " << k;
}

/// Value, gradient and Hessian are the same from both sides of a node, and so are third differences
/// of the Hessian's neighbours.
TEST(QuinticSpline, DerivativesAreContinuousAcrossNodes) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  const QuinticSpline3 spline =
      spline_of([&](double, double, double) { return normal(engine); },
                {GridAxis{0, 9, 10}, GridAxis{0, 9, 10}, GridAxis{0, 9, 10}});
  for (int node = 1; node < 9; ++node) {
    const auto hessian = [&](double x) {
      QuinticSpline3::Value value;
      spline.evaluate({x, 4.3, 2.7}, value, true);
      return value.hessian(0, 0);
    };
    // The third derivative of f from both sides by one-sided differences: also without a jump, for
    // any values
    const double h = 1e-4,
                 right =
                     (-3 * hessian(node) + 4 * hessian(node + h) - hessian(node + 2 * h)) / (2 * h),
                 left =
                     (3 * hessian(node - 1e-15) - 4 * hessian(node - h) + hessian(node - 2 * h)) /
                     (2 * h);
    EXPECT_NEAR(left, right, 1e-4 * (1.0 + std::abs(right))) << node;
  }
}

TEST(QuinticSpline, ImpossibleSplinesAreRefused) {
  const std::array<GridAxis, 3> axes = {GridAxis{0, 1, 6}, GridAxis{0, 1, 6}, GridAxis{0, 1, 6}};
  std::vector<double> values(216, 1.0);
  EXPECT_THROW(
      QuinticSpline3::through({axes[0], GridAxis{0, 1, 5}, axes[2]}, std::vector<double>(180, 1.0)),
      StateError);
  EXPECT_THROW(QuinticSpline3::through({axes[0], GridAxis{1, 0, 6}, axes[2]}, values), StateError);
  EXPECT_THROW(QuinticSpline3::through(axes, std::vector<double>(215, 1.0)), StateError);
  values[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(QuinticSpline3::through(axes, values), StateError);
  EXPECT_THROW(QuinticSpline3::of(axes, std::vector<double>(999, 0.0)), StateError);
}

}  // namespace
}  // namespace furrow::quintic_spline_test
