// SPDX-License-Identifier: GPL-2.0-or-later
// A ring of sidewalls: its forces on the tread are the gradient of its potential, and with the
// rim's reaction they balance.

#include "furrow/tyre/sidewall/sidewall_ring.h"

#include <gtest/gtest.h>

#include "furrow/tyre/sidewall/sidewall_direct.h"
#include "tyres.h"

namespace furrow::sidewall_ring_test {
namespace {

/// Edge nodes of 12 stations, a little displaced and turned, on a rim that stands askew.
struct Ring {
  static constexpr int n = 12;
  RimPose rim{Vector3(0.3, -0.2, 0.5),
              Quaternion(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized())).toRotationMatrix()};
  ShellNodes nodes{Matrix3X::Zero(3, n)};
  double pressure = 2e5;
  TyreParameters parameters = p235(pressure);

  explicit Ring(int side, const Vector2& link = Vector2::Zero()) {
    parameters.link = link;
    std::srand(3);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double angle = 2.0 * pi * static_cast<double>(i) / n, radius = parameters.tread.radius;
      const Vector3 at(radius * std::sin(angle), side * parameters.tread.half_width,
                       -radius * std::cos(angle));
      nodes.x.col(i) = rim.centre + rim.attitude * (at + 0.008 * Vector3::Random());
      const Vector3 turn = 0.2 * Vector3::Random();
      nodes.set_rotation(i, Quaternion(rim.attitude) *
                                Quaternion(Eigen::AngleAxisd(turn.norm(), turn.normalized())));
    }
  }
  SidewallRing make(int side) const {
    std::vector<int> edge;
    for (int i = 0; i < n; ++i) edge.push_back(i);
    return SidewallRing(std::make_unique<SidewallDirect>(parameters.sidewall, pressure), parameters,
                        side, edge, 0.18);
  }
  void compute(SidewallRing& ring) {
    nodes.force.setZero();
    nodes.moment.setZero();
    ring.add_forces(nodes, rim);
  }
};

TEST(SidewallRing, ForcesAreTheGradientOfThePotential) {
  for (const auto& [side, link] : {std::pair{1, Vector2(0, 0)}, std::pair{-1, Vector2(0, 0)},
                                   std::pair{1, Vector2(-0.012, 0.005)}}) {
    Ring model(side, link);
    SidewallRing ring = model.make(side);
    model.compute(ring);
    const Matrix3X force = model.nodes.force, moment = model.nodes.moment;
    // the pressure's potential is -p V of a closed surface: a cap of triangles from the tread's
    // edge to a fixed point closes it
    const Vector3 apex = model.rim.centre;
    const auto cap = [&, sign = side](const Matrix3X& x) {
      double volume = 0.0;
      for (int i = 0; i < Ring::n; ++i) {
        const Vector3 a = x.col(i), b = x.col((i + 1) % Ring::n);
        volume -= sign * -a.dot(b.cross(apex)) / 6.0;
      }
      return volume;
    };
    const double step = 1e-6;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 6; ++k) {
        double value[2];
        for (int sign = 0; sign < 2; ++sign) {
          Ring moved = model;
          const double h = sign ? step : -step;
          if (k < 3)
            moved.nodes.x(k, i) += h;
          else
            moved.nodes.set_rotation(i, Quaternion(Eigen::AngleAxisd(h, Vector3::Unit(k - 3))) *
                                            moved.nodes.q[static_cast<std::size_t>(i)]);
          SidewallRing other = moved.make(side);
          moved.compute(other);
          value[sign] = model.pressure * (other.volume() + cap(moved.nodes.x)) - other.potential();
        }
        const double numeric = (value[1] - value[0]) / (2.0 * step);
        // the pressure on the cap: a third of each triangle's at its nodes
        double expected = k < 3 ? force(k, i) : moment(k - 3, i);
        if (k < 3) {
          const Vector3 before = model.nodes.x.col((i + Ring::n - 1) % Ring::n),
                        here = model.nodes.x.col(i), after = model.nodes.x.col((i + 1) % Ring::n);
          const Vector3 area =
              0.5 * ((here - apex).cross(before - apex) + (after - apex).cross(here - apex));
          expected += -side * model.pressure * area[k] / 3.0;
        }
        EXPECT_NEAR(numeric, expected, 2e-5 * force.cwiseAbs().maxCoeff())
            << side << " node " << i << " component " << k;
      }
  }
}

TEST(SidewallRing, ForcesAreIndependentOfThePlaceOfTheWheel) {
  Ring model(1);
  SidewallRing ring = model.make(1);
  model.compute(ring);
  const Matrix3X force = model.nodes.force;
  Ring moved = model;
  const Matrix3 turn = Eigen::AngleAxisd(1.1, Vector3(3, -1, 2).normalized()).toRotationMatrix();
  const Vector3 shift(5, 3, -2);
  moved.rim.centre = turn * model.rim.centre + shift;
  moved.rim.attitude = turn * model.rim.attitude;
  moved.nodes.x = (turn * model.nodes.x).colwise() + shift;
  for (int i = 0; i < Ring::n; ++i)
    moved.nodes.set_rotation(i, Quaternion(turn) * model.nodes.q[static_cast<std::size_t>(i)]);
  SidewallRing other = moved.make(1);
  moved.compute(other);
  EXPECT_LT((moved.nodes.force - turn * force).cwiseAbs().maxCoeff(),
            1e-8 * force.cwiseAbs().maxCoeff());
}

TEST(SidewallRing, ArcsFromBeadToTreadHaveTheLengthOfTheSidewall) {
  Ring model(1);
  SidewallRing ring = model.make(1);
  const int points = 200;
  Matrix3X x(3, points * Ring::n);
  ring.arcs(points, model.nodes, model.rim, x, 0);
  for (int i = 0; i < Ring::n; ++i) {
    double length = 0.0;
    for (int k = 0; k < points; ++k)
      length +=
          ((k + 1 < points ? Vector3(x.col(i * points + k + 1)) : Vector3(model.nodes.x.col(i))) -
           x.col(i * points + k))
              .norm();
    EXPECT_NEAR(length, model.parameters.sidewall.length, 1e-4 * length);
    EXPECT_LT((x.col(i * points) - model.rim.centre -
               model.rim.attitude * ring.bead(static_cast<std::size_t>(i)))
                  .norm(),
              1e-12);
  }
}

}  // namespace
}  // namespace furrow::sidewall_ring_test
