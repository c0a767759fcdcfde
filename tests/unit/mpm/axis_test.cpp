// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/axis.h"

#include <cmath>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::axis_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

struct Splines {
  int cell;
  double value[3], distance[3];  // N_i, x_i - x
};

/// As a kernel makes them (transfer_kernel.h).
Splines splines_at(const Axis& axis, double x) {
  const AxisView view = axis.view();
  Splines s;
  s.cell = axis.cell_of(x);
  const double above = axis.knot(s.cell + 1) - x, below = x - axis.knot(s.cell);
  s.value[0] = view.left[s.cell] * above * above;
  s.value[2] = view.right[s.cell] * below * below;
  s.value[1] = 1.0 - s.value[0] - s.value[2];
  for (int i = 0; i < 3; ++i) s.distance[i] = axis.node(s.cell + i) - x;
  return s;
}

const AxisLayout uniform_layout{-1.0, 2.0, 0.25, -1.0, 2.0, 1.0};
const AxisLayout graded_layout{-1.0, 2.0, 0.05, 0.2, 0.7, 1.25};

class BothAxes : public ::testing::TestWithParam<AxisLayout> {};
INSTANTIATE_TEST_SUITE_P(Axis, BothAxes, ::testing::Values(uniform_layout, graded_layout),
                         [](const auto& one) { return one.index == 0 ? "uniform" : "graded"; });

/// The middle spline too is a B-spline: on its own knots it must be what Cox and de Boor's
/// recursion gives.
double cox_de_boor(const std::vector<double>& t, std::size_t i, int degree, double x) {
  if (degree == 0) return x >= t[i] && x < t[i + 1] ? 1.0 : 0.0;
  const auto k = static_cast<std::size_t>(degree);
  const double a = t[i + k] - t[i], b = t[i + k + 1] - t[i + 1];
  return (a > 0.0 ? (x - t[i]) / a * cox_de_boor(t, i, degree - 1, x) : 0.0) +
         (b > 0.0 ? (t[i + k + 1] - x) / b * cox_de_boor(t, i + 1, degree - 1, x) : 0.0);
}

TEST_P(BothAxes, SplinesAreThoseOfCoxAndDeBoorOnOpenKnots) {
  const Axis axis(GetParam(), "x axis");
  std::vector<double> knots = {axis.lower(), axis.lower()};
  for (int c = 0; c <= axis.cells(); ++c) knots.push_back(axis.knot(c));
  knots.insert(knots.end(), {axis.upper(), axis.upper()});
  for (double x = axis.lower() + 1e-3; x < axis.upper(); x += 0.00731) {
    const Splines s = splines_at(axis, x);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(s.value[i], cox_de_boor(knots, static_cast<std::size_t>(s.cell + i), 2, x), 1e-13)
          << x;
  }
}

TEST_P(BothAxes, LinearFieldsAreReproduced) {
  const Axis axis(GetParam(), "x axis");
  for (double x = axis.lower(); x <= axis.upper(); x += 0.00731) {
    const Splines s = splines_at(axis, x);
    double sum = 0.0, moment = 0.0;
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(s.value[i], -1e-15);
      sum += s.value[i];
      moment += s.value[i] * s.distance[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_NEAR(moment, 0.0, 1e-15) << "x " << x;
  }
}

TEST_P(BothAxes, EndOfTheAxisIsTheOutermostNode) {
  const Axis axis(GetParam(), "x axis");
  EXPECT_DOUBLE_EQ(axis.node(0), axis.lower());
  EXPECT_DOUBLE_EQ(axis.node(axis.nodes() - 1), axis.upper());
  EXPECT_DOUBLE_EQ(splines_at(axis, axis.lower()).value[0], 1.0);
  EXPECT_DOUBLE_EQ(splines_at(axis, axis.upper()).value[2], 1.0);
}

TEST_P(BothAxes, ExtentIsTheIntegralOfTheSpline) {
  const Axis axis(GetParam(), "x axis");
  std::vector<double> integral(static_cast<std::size_t>(axis.nodes()), 0.0);
  // Gauss: exact to the fifth power
  const double point = std::sqrt(0.6), weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (int c = 0; c < axis.cells(); ++c)
    for (int g = 0; g < 3; ++g) {
      const Splines s =
          splines_at(axis, axis.knot(c) + 0.5 * axis.length(c) * (1.0 + (g - 1) * point));
      for (int i = 0; i < 3; ++i)
        integral[static_cast<std::size_t>(c + i)] += weight[g] * axis.length(c) * s.value[i];
    }
  for (int i = 0; i < axis.nodes(); ++i)
    EXPECT_NEAR(axis.extent(i), integral[static_cast<std::size_t>(i)], 1e-14) << "node " << i;
}

/// The kernels find a cell through bins and at most one step further: right for every x, ends and
/// knots included.
TEST_P(BothAxes, BinsFindTheCellOfAnyPlace) {
  const Axis axis(GetParam(), "x axis");
  const AxisView view = axis.view();
  std::vector<double> places;
  for (double x = axis.lower(); x < axis.upper(); x += 0.000317) places.push_back(x);
  for (int c = 0; c <= axis.cells(); ++c) {
    places.push_back(axis.knot(c));
    if (c > 0) places.push_back(std::nextafter(axis.knot(c), -10.0));
  }
  for (const double x : places) {
    int expected = 0;
    while (expected + 1 < axis.cells() && x >= axis.knot(expected + 1)) ++expected;
    EXPECT_EQ(axis.cell_of(x), expected) << x;
    int bin = std::min(static_cast<int>((x - view.lower) * view.bins_per_length), view.bins - 1);
    const int cell = view.cell_of_bin[bin];
    EXPECT_EQ(std::min(cell + (x >= view.knot[cell + 1] ? 1 : 0), view.cells - 1), expected) << x;
  }
}

TEST(Axis, CellsGrowOutsideOfTheFineStretchOnly) {
  const Axis axis(graded_layout, "x axis");
  EXPECT_FALSE(axis.uniform());
  EXPECT_DOUBLE_EQ(axis.lower(), -1.0);
  EXPECT_DOUBLE_EQ(axis.upper(), 2.0);
  for (int c = 0; c < axis.cells(); ++c) {
    const double middle = 0.5 * (axis.knot(c) + axis.knot(c + 1));
    if (middle > 0.2 && middle < 0.7) {
      EXPECT_NEAR(axis.length(c), 0.05, 1e-12);
    } else if (c > 0 && c + 1 < axis.cells()) {
      const double growth =
          middle < 0.2 ? axis.length(c) / axis.length(c + 1) : axis.length(c) / axis.length(c - 1);
      // All cells outside are stretched by one factor to end where the axis ends: the first step
      // differs, later ones do not.
      const bool first = std::abs(middle - 0.45) < 0.25 + 0.05;
      if (first) {
        EXPECT_NEAR(growth, 1.25, 0.25);
      } else {
        EXPECT_NEAR(growth, 1.25, 1e-9);
      }
    }
  }
  EXPECT_NEAR(axis.shortest(), 0.05, 1e-12);
}

TEST(Axis, CellLengthIsAdjustedToAWholeNumber) {
  const Axis axis({0.0, 1.0, 0.3, 0.0, 1.0, 1.0}, "x axis");
  EXPECT_EQ(axis.cells(), 3);
  EXPECT_TRUE(axis.uniform());
  EXPECT_EQ(Axis({0.0, 0.1, 5.0, 0.0, 0.1, 1.0}, "x axis").cells(), 1);
}

TEST(Axis, PlaceOutsideHasNoCell) {
  const Axis axis(uniform_layout, "x axis");
  EXPECT_EQ(axis.cell_of(-1.0 - 1e-12), -1);
  EXPECT_EQ(axis.cell_of(2.0 + 1e-12), -1);
  EXPECT_EQ(axis.cell_of(std::nan("")), -1);
  EXPECT_EQ(axis.cell_of(2.0), axis.cells() - 1);
}

TEST(Axis, ShiftMovesEverythingByWholeCells) {
  Axis axis(uniform_layout, "x axis");
  const Axis before = axis;
  axis.shift(3);
  for (int i = 0; i < axis.nodes(); ++i) EXPECT_NEAR(axis.node(i), before.node(i) + 0.75, 1e-14);
  EXPECT_EQ(axis.cell_of(0.0), before.cell_of(-0.75));
  // every bit is the same, as a restart needs it; by fine cells where the others are longer
  for (const AxisLayout& layout : {AxisLayout{-1.0, 2.0, 0.3, -1.0, 2.0, 1.0}, graded_layout}) {
    Axis in_steps(layout, "x axis"), at_once = in_steps;
    for (int n = 0; n < 17; ++n) in_steps.shift(2);
    at_once.shift(34);
    EXPECT_NEAR(at_once.lower(), -1.0 + 34 * at_once.fine_cell(), 1e-12);
    for (int c = 0; c <= at_once.cells(); ++c) {
      EXPECT_EQ(in_steps.knot(c), at_once.knot(c));
      if (c < at_once.cells()) {
        EXPECT_EQ(in_steps.view().left[c], at_once.view().left[c]);
      }
    }
  }
  EXPECT_NEAR(Axis(graded_layout, "x axis").fine_cell(), 0.05, 1e-12);
}

TEST(Axis, ImpossibleLayoutsAreRefused) {
  const auto refusal = [](const AxisLayout& layout) -> std::string {
    return error_of<InputError>([&] { Axis(layout, "soil, x axis"); });
  };
  EXPECT_THAT(refusal({1.0, 0.0, 0.1, 0.0, 1.0, 1.0}),
              HasSubstr("soil, x axis has cells of 0.1 m from 1 to 0 m"));
  EXPECT_THAT(refusal({0.0, 1.0, -0.1, 0.0, 1.0, 1.0}),
              HasSubstr("allowed: lower < upper, a cell > 0"));
  EXPECT_THAT(refusal({0.0, 1.0, std::nan(""), 0.0, 1.0, 1.0}), HasSubstr("cells of nan m"));
  EXPECT_THAT(refusal({0.0, 1.0, 0.1, 2.0, 3.0, 1.0}),
              HasSubstr("a fine stretch that is not empty"));
  EXPECT_THAT(refusal({0.0, 1.0, 0.1, 0.0, 0.5, 0.9}), HasSubstr("grow by 0.9; allowed: 1 to 1.5"));
  EXPECT_THAT(refusal({0.0, 1.0, 0.1, 0.0, 0.5, 2.0}), HasSubstr("coarser steps reflect waves"));
}

/// Two edges of a body: a knot at each, three cells of the asked length on both sides as nearly as
/// the lengths between knots allow, and cells that grow by 1.4 at most up to the usual length.
TEST(Axis, CellsAreShortAtEdges) {
  AxisLayout layout{-1.0, 2.0, 0.1, -0.5, 1.0, 1.2};
  layout.edges = {0.37, -0.113};
  layout.edge_cell = 0.025;
  const Axis axis(layout, "y axis");
  EXPECT_EQ(Axis::cell_count(layout), axis.cells());
  EXPECT_EQ(axis.lower(), -1.0);
  EXPECT_EQ(axis.upper(), 2.0);
  for (const double edge : layout.edges) {
    const int cell = axis.cell_of(edge);
    EXPECT_EQ(axis.knot(cell), edge);
    for (int c = cell - 3; c < cell + 3; ++c) EXPECT_NEAR(axis.length(c), 0.025, 0.004) << edge;
  }
  double longest = 0.0;
  for (int c = 1; c < axis.cells(); ++c) {
    const double ratio = axis.length(c) / axis.length(c - 1);
    EXPECT_LT(std::max(ratio, 1.0 / ratio), 1.5) << "at " << axis.knot(c);
    if (axis.knot(c) > -0.5 && axis.knot(c + 1) < 1.0) longest = std::max(longest, axis.length(c));
  }
  EXPECT_NEAR(longest, 0.1, 0.01);
  EXPECT_GT(axis.length(0), 0.15);  // grown
}

}  // namespace
}  // namespace furrow::axis_test
