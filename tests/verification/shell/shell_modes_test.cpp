// SPDX-License-Identifier: GPL-2.0-or-later
// Natural modes against closed forms: a cantilever, and an inflated ring on an elastic foundation,
// which is the classical model of a tyre.

#include "furrow/shell/natural_modes.h"

#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shell_model.h"
#include "tests/support/error_of.h"

namespace furrow::test::shell_modes_test {
namespace {

constexpr double E = 1e10;           // [Pa]
constexpr double thickness = 4e-3;   // [m]
constexpr double areal_mass = 10.0;  // [kg/m^2]

// Without Poisson's ratio a strip is a beam.
ShellSection section() { return {OrthotropicLayer::isotropic(E, 0.0, thickness), areal_mass}; }

class Structure : public RelaxingStructure {
 public:
  Structure(ShellModel& model, double pressure) : model_(model), pressure_(pressure) {}
  ShellNodes& nodes() override { return model_.nodes; }
  double compute_forces() override {
    model_.compute(pressure_);
    if (further_) further_(model_.nodes);
    return 0.0;
  }
  void follow(double) override {}
  void add(std::function<void(ShellNodes&)> forces) { further_ = std::move(forces); }

 private:
  ShellModel& model_;
  double pressure_;
  std::function<void(ShellNodes&)> further_;
};

NaturalModes modes_of(Structure& structure, const ShellModel& model, int count) {
  return natural_modes(structure, neighbours_of(model.shell.quads(), model.nodes.count()), count);
}

// ---- a cantilever ----------------------------------------------------------------------------

struct Cantilever {
  static constexpr double length = 1.0;  // [m]

  /// Square elements, for any number of them: one element wide.
  explicit Cantilever(int elements)
      : model(mapped_shell(
            elements, 1,
            [elements](double s, double t) {
              return Vector3(length * s, length / elements * (t - 0.5), 0.0);
            },
            section(), [](const Vector3&) { return Vector3::UnitX(); })),
        structure(model, 0.0) {
    for (Eigen::Index n = 0; n < model.nodes.count(); ++n) {
      if (model.nodes.x(0, n) < 1e-9) model.nodes.hold(n);
      // bending out of its plane only
      model.nodes.free_to_move(1, n) = 0.0;
      model.nodes.free_to_turn(0, n) = model.nodes.free_to_turn(2, n) = 0.0;
    }
  }
  /// [Hz] of an Euler-Bernoulli beam, clamped and free: cos(b) cosh(b) = -1
  static double exact(int mode) {
    const double b[] = {1.875104069, 4.694091133, 7.854757438};
    const double bending = E * std::pow(thickness, 3) / 12.0;
    return std::pow(b[mode] / length, 2) * std::sqrt(bending / areal_mass) / (2.0 * pi);
  }

  ShellModel model;
  Structure structure;
};

TEST(NaturalModes, CantileverHasEulerBernoulliFrequencies) {
  double coarse_error[3];
  for (const int elements : {40, 80}) {
    Cantilever beam(elements);
    const NaturalModes modes = modes_of(beam.structure, beam.model, 3);
    EXPECT_LT(modes.asymmetry, 1e-7);
    for (int i = 0; i < 3; ++i) {
      SCOPED_TRACE(fmt::format("{} elements, mode {}", elements, i));
      const double error = std::abs(modes.frequency[i] / Cantilever::exact(i) - 1.0);
      EXPECT_LT(error, 3e-3);
      if (elements == 40) {
        coarse_error[i] = error;
      } else {
        EXPECT_LT(error, coarse_error[i] / 3.3);  // of order 1.7 to 2
      }
      EXPECT_NEAR(modes.shape[static_cast<std::size_t>(i)].row(2).cwiseAbs().maxCoeff(), 1.0,
                  1e-12);
    }
  }
}

// ---- a ring ------------------------------------------------------------------------------------

struct Ring {
  static constexpr double radius = 0.35, width = 0.02;

  explicit Ring(double pressure, double radial = 0.0, double tangential = 0.0)
      : model(ring(radius, width, 96, 1, section())), structure(model, pressure) {
    ShellNodes& nodes = model.nodes;
    nodes.free_to_move.row(1).setZero();
    nodes.free_to_turn.row(0).setZero();
    nodes.free_to_turn.row(2).setZero();
    inflate(pressure);
    rest = nodes.x;
    structure.add([this, radial, tangential](ShellNodes& moved) {
      for (Eigen::Index n = 0; n < moved.count(); ++n) {
        const Vector3 outwards = Vector3(rest(0, n), 0.0, rest(2, n)).normalized();
        const Vector3 along(-outwards.z(), 0.0, outwards.x());
        const Vector3 u = moved.x.col(n) - rest.col(n);
        const double area = moved.mass[n] / areal_mass;
        moved.force.col(n) -=
            area * (radial * outwards.dot(u) * outwards + tangential * along.dot(u) * along);
      }
    });
  }

  /// Newton's method for the radius at which the polygon is in equilibrium.
  void inflate(double pressure) {
    ShellNodes& nodes = model.nodes;
    const Matrix3X made = nodes.x;
    const auto unbalanced = [&](double stretch) {
      nodes.x = made;
      nodes.x.row(0) *= stretch;
      nodes.x.row(2) *= stretch;
      model.compute(pressure);
      return nodes.force.cwiseProduct(nodes.x).sum();
    };
    for (int i = 0; i < 20; ++i) {
      const double slope = (unbalanced(inflated + 1e-7) - unbalanced(inflated - 1e-7)) / 2e-7;
      inflated -= unbalanced(inflated) / slope;
    }
    unbalanced(inflated);
  }

  /// [Hz] of n waves without extension: with the displacement W cos(n a) outwards, W/n sin(n a)
  /// along it, under live pressure p on an elastic foundation of k_w outwards and k_v along it,
  ///   omega^2 rho h (1 + 1/n^2) = D (n^2 - 1)^2/R^4 + p (n^2 - 1)/R + k_w + k_v/n^2.
  /// Its static limit is the ring's critical pressure, -(n^2 - 1) D/R^3 at n = 2.
  double exact(int n, double p, double k_w, double k_v) const {
    const double R = radius * inflated, n2 = n * n;
    const double D = E * std::pow(thickness, 3) / 12.0;
    const double stiffness =
        D * std::pow((n2 - 1.0) / (R * R), 2) + p * (n2 - 1.0) / R + k_w + k_v / n2;
    return std::sqrt(stiffness / (areal_mass / inflated * (1.0 + 1.0 / n2))) / (2.0 * pi);
  }

  ShellModel model;
  Structure structure;
  Matrix3X rest;  // [m] of the inflated ring
  double inflated = 1.0;
};

TEST(NaturalModes, InflatedRingOnAnElasticFoundationHasTheClosedForm) {
  const double p = 20e3, k_w = 3e5, k_v = 1e5;
  Ring tyre(p, k_w, k_v);
  const NaturalModes modes = modes_of(tyre.structure, tyre.model, 10);
  EXPECT_LT(modes.asymmetry, 1e-4);
  std::vector<double> expected;
  for (int n = 1; n <= 5; ++n) expected.insert(expected.end(), 2, tyre.exact(n, p, k_w, k_v));
  // all springs along the ring at once: n = 0
  expected.push_back(std::sqrt(k_v / areal_mass) / (2.0 * pi));
  std::sort(expected.begin(), expected.end());
  for (int i = 0; i < 10; ++i)
    EXPECT_NEAR(modes.frequency[i] / expected[static_cast<std::size_t>(i)], 1.0, 0.01) << i;
}

TEST(NaturalModes, RingNearItsCriticalPressureHasTheClosedForm) {
  const double D = E * std::pow(thickness, 3) / 12.0;
  const double critical = -3.0 * D / std::pow(Ring::radius, 3);
  // enough to hold it, not enough to stiffen it
  const double held = 1.0;
  Ring below(0.8 * critical, held, held);
  EXPECT_NEAR(modes_of(below.structure, below.model, 4).frequency[3] /
                  below.exact(2, 0.8 * critical, held, held),
              1.0, 0.02);
  Ring above(1.1 * critical, held, held);
  EXPECT_THAT(error_of([&] { modes_of(above.structure, above.model, 4); }),
              testing::HasSubstr("not in stable equilibrium"));
}

// ---- what is refused ---------------------------------------------------------------------------

TEST(NaturalModes, ForcesBetweenDistantNodesAreIncluded) {
  Cantilever beam(10);
  const Matrix3X rest = beam.model.nodes.x;
  beam.structure.add([rest](ShellNodes& nodes) {
    const Eigen::Index last = nodes.count() - 1;
    const Matrix3X u = nodes.x - rest;
    const Vector3 spring = 1e6 * (u.col(last) - u.col(3));
    nodes.force.col(3) += spring;
    nodes.force.col(last) -= spring;
  });
  EXPECT_THAT(error_of([&] { modes_of(beam.structure, beam.model, 3); }),
              testing::HasSubstr("between nodes that are not neighbours"));
}

TEST(NaturalModes, TooManyModesAreRefused) {
  Cantilever beam(4);
  EXPECT_THAT(error_of([&] { modes_of(beam.structure, beam.model, 1000); }),
              testing::HasSubstr("is 1000; allowed: 1 to"));
}

}  // namespace
}  // namespace furrow::test::shell_modes_test
