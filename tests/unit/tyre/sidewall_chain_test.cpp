// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_chain.h"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "furrow/tyre/sidewall/sidewall_direct.h"
#include "tyres.h"
#include "tests/support/error_of.h"

namespace furrow::sidewall_chain_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

SidewallResponse cold(SidewallChain& chain, const SidewallEnd& end, double pressure) {
  VectorX angles;
  return chain.solve(end, pressure, angles);
}

TEST(SidewallChain, StiffnessIsTheDerivativeOfTheForces) {
  for (const auto& make : {tr_sidewall, tr_sector})
    for (const double k : {0.0, 1.0, 100.0})
      for (const double pressure : {0.0, 103e3, 241e3})
        for (const SidewallEnd& end : ends) {
          SidewallChain chain(make(k, k));
          const auto response = [&](const SidewallEnd& e) { return cold(chain, e, pressure); };
          const Matrix3 K = response(end).stiffness;
          EXPECT_LT((K - stiffness_by_differences(response, end, 2e-5)).norm(), 1e-6 * K.norm())
              << "k " << k << ", p " << pressure << ", a " << end.a << ", r " << end.r;
        }
}

TEST(SidewallChain, ForcesAreTheGradientOfPotentialAndChordPressure) {
  for (const auto& make : {tr_sidewall, tr_sector})
    for (const double k : {0.0, 10.0})
      for (const double pressure : {0.0, 241e3})
        for (const SidewallEnd& end : ends) {
          const SidewallParameters sidewall = make(k, 2 * k);
          SidewallChain chain(sidewall);
          const auto response = [&](const SidewallEnd& e) { return cold(chain, e, pressure); };
          const SidewallResponse here = response(end);
          EXPECT_LT((here.force + gradient_by_differences(response, end, 2e-5)).norm(),
                    1e-7 * (1.0 + here.on_tread.norm()));
          // The chord's pressure on a strip of width omega: the tread's share is the integral of
          // omega s/chord ds
          const double share = sidewall.bead_width / 2 + sidewall.taper * end.r / 3;
          EXPECT_LT(
              (here.on_tread - here.force - pressure * share * Vector3(end.r, -end.a, 0.0)).norm(),
              1e-12 * (1.0 + here.on_tread.norm()));
          // dF_a/dr - dF_r/da = p omega, and the rest is symmetric
          const Matrix3& K = here.stiffness;
          EXPECT_NEAR(K(1, 0) - K(0, 1), pressure * (sidewall.bead_width + sidewall.taper * end.r),
                      1e-9 * K.norm());
          EXPECT_NEAR(K(0, 2), K(2, 0), 1e-9 * K.norm());
          EXPECT_NEAR(K(1, 2), K(2, 1), 1e-9 * K.norm());
        }
}

/// Forces on tread and rim are all that the gas does to an even strip: resultant and moment, from
/// the nodes themselves.
TEST(SidewallChain, ForcesOfBothEndsBalanceThePressure) {
  SidewallChain chain(tr_sidewall(5.0, 20.0));
  for (const SidewallEnd& end : ends) {
    const double p = 179e3;
    const SidewallResponse response = cold(chain, end, p);
    const SidewallShape shape = chain.shape(end, p);
    const Eigen::Matrix2Xd& nodes = shape.nodes;
    Vector2 force = Vector2::Zero();
    double moment = 0.0;  // about the bead
    for (int i = 0; i + 1 < nodes.cols(); ++i) {
      const Vector2 edge = nodes.col(i + 1) - nodes.col(i),
                    middle = 0.5 * (nodes.col(i + 1) + nodes.col(i));
      const Vector2 load = p * Vector2(edge[1], -edge[0]);
      force += load;
      moment += middle[0] * load[1] - middle[1] * load[0];
    }
    const Vector3 tread = response.on_tread, rim = shape.on_rim;
    EXPECT_NEAR((tread + rim).head<2>().x(), force.x(), 1e-8);
    EXPECT_NEAR((tread + rim).head<2>().y(), force.y(), 1e-8);
    EXPECT_NEAR(tread[2] + rim[2] + end.a * tread[1] - end.r * tread[0], moment, 1e-8);
    EXPECT_NEAR(nodes(0, 10), end.a, 1e-14);
    EXPECT_NEAR(nodes(1, 10), end.r, 1e-14);
    EXPECT_NEAR(shape.bending - p * shape.area, response.potential, 1e-9);
  }
}

/// The tyre's gas does work p dV on a strip between two meridians, V = 2 pi integral of A R dR +
/// ...: the potential holds that volume.
TEST(SidewallChain, SectorAreaIsVolumeOverTreadCircumference) {
  const double R_bead = 0.208, R_tread = 0.3475;
  SidewallChain chain(tr_sector(1.0, 1.0));
  for (const SidewallEnd& end : ends) {
    const SidewallShape shape = chain.shape(end, 103e3);
    // Pappus and Guldin: the polygon between chain and chord turned about the axle; triangles from
    // the bead
    double volume = 0.0;
    for (int i = 1; i + 1 < shape.nodes.cols(); ++i) {
      const Vector2 u = shape.nodes.col(i), v = shape.nodes.col(i + 1);
      const double area = 0.5 * (u[0] * v[1] - u[1] * v[0]),
                   centroid = R_bead + (u[1] + v[1]) / 3.0;
      volume += 2.0 * pi * centroid * area;
    }
    EXPECT_NEAR(shape.area, volume / (2.0 * pi * R_tread), 1e-12);
  }
}

/// Moments of rim spring, N - 1 hinges and tread spring [N m/m].
VectorX moments(const SidewallParameters& sidewall, const VectorX& angles, double phi) {
  const Eigen::Index n = angles.size();
  const double L = sidewall.length / static_cast<double>(n);
  VectorX moments(n + 1);
  moments[0] = sidewall.rim_stiffness * (angles[0] - sidewall.rim_angle);
  moments[n] = -sidewall.tread_stiffness * (angles[n - 1] - sidewall.tread_angle - phi);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const auto hinge = static_cast<std::size_t>(i);
    moments[i + 1] =
        sidewall.bending[hinge] * ((angles[i + 1] - angles[i]) / L - sidewall.curvature[hinge]);
  }
  return moments;
}

/// Every hinge: moment difference = force times arm, with the pressure on the nodes beyond.
TEST(SidewallChain, EveryHingeIsInEquilibrium) {
  SidewallChain chain(tr_sidewall(3.0, 7.0));
  for (const double p : {0.0, 103e3})
    for (const SidewallEnd& end : ends) {
      const SidewallResponse response = cold(chain, end, p);
      const SidewallShape shape = chain.shape(end, p);
      const Eigen::Matrix2Xd& x = shape.nodes;
      const VectorX M = moments(chain.parameters(), shape.angles, end.phi);
      // The part from node i on: what the tread does to it, the pressure on it, and the hinge's
      // moment
      for (int i = 0; i < 10; ++i) {
        double moment = -response.on_tread[2] - M[i];
        const Vector2 arm = x.col(10) - x.col(i);
        moment -= arm[0] * response.on_tread[1] - arm[1] * response.on_tread[0];
        for (int j = i; j < 10; ++j) {
          const Vector2 edge = x.col(j + 1) - x.col(j),
                        middle = 0.5 * (x.col(j + 1) + x.col(j)) - x.col(i);
          moment += p * (-middle[0] * edge[0] - middle[1] * edge[1]);
        }
        EXPECT_NEAR(moment, 0.0, 1e-8) << "hinge " << i;
      }
    }
}

TEST(SidewallChain, RotatedChainHasRotatedForces) {
  SidewallParameters sidewall = tr_sidewall(8.0, 8.0);
  SidewallChain chain(sidewall);
  const double turn = 0.4;
  sidewall.rim_angle += turn;
  SidewallChain turned(sidewall);
  const SidewallEnd end{0.01, 0.11, 0.1};
  const Eigen::Rotation2Dd R(turn);
  const Vector2 place = R * Vector2(end.a, end.r);
  const SidewallResponse first = cold(chain, end, 103e3),
                         second = cold(turned, {place[0], place[1], end.phi + turn}, 103e3);
  EXPECT_LT((R * first.on_tread.head<2>() - second.on_tread.head<2>()).norm(), 1e-8);
  EXPECT_NEAR(first.on_tread[2], second.on_tread[2], 1e-9);
  EXPECT_NEAR(first.potential, second.potential, 1e-9);
}

/// From a chain that is bent the wrong way, in an S, or at random, the search ends where the arc
/// leads.
TEST(SidewallChain, PoorInitialGuessReachesTheSameBranch) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double pressure : {2e4, 103e3, 241e3})
    for (const SidewallEnd& end : ends) {
      SidewallChain chain(tr_sector(1.0, 1.0));
      VectorX right;
      const Vector3 expected = chain.solve(end, pressure, right).on_tread;
      const double direction = std::atan2(end.r, end.a);
      for (int start = 0; start < 12; ++start) {
        VectorX angles = right;
        for (int i = 0; i < 10; ++i) {
          // mirrored: bulges inwards
          if (start == 0) angles[i] = 2.0 * direction - right[i];
          // an S
          if (start == 1) angles[i] = direction + (i < 5 ? 1 : -1) * (right[i] - direction);
          if (start > 1) angles[i] = direction + 1.5 * uniform(engine);
        }
        EXPECT_LT((chain.solve(end, pressure, angles).on_tread - expected).norm(),
                  1e-7 * expected.norm())
            << "start " << start << ", p " << pressure << ", a " << end.a << ", r " << end.r;
        EXPECT_LT((angles - right).norm(), 1e-6);
      }
    }
}

/// A loop of the tread edge, in small steps from the last solution: it comes back to what it was,
/// and agrees with a fresh search.
TEST(SidewallChain, WarmStartsFollowTheSameBranch) {
  for (const double k : {0.0, 10.0}) {
    SidewallDirect warm(tr_sector(k, k), 103e3);
    SidewallChain chain(tr_sector(k, k));
    for (int step = 0; step <= 400; ++step) {
      const double t = 2.0 * pi * step / 400;
      const SidewallEnd end{0.03 * std::sin(t), 0.09 + 0.05 * std::cos(t), 0.4 * std::sin(2 * t)};
      SidewallResponse response;
      warm.evaluate(&end, &response, 1, false);
      EXPECT_LT((response.on_tread - cold(chain, end, 103e3).on_tread).norm(), 1e-6)
          << "step " << step;
    }
  }
}

/// Stiff springs, hardly any pressure, and a chain so nearly straight that forces are a thousand
/// times those of the pressure.
TEST(SidewallChain, NearlyStraightChainIsSolved) {
  for (const auto& make : {tr_sidewall, tr_sector})
    for (const double k : {0.0, 50.0, 1000.0})
      for (const double pressure : {0.0, 5e3, 241e3})
        for (const double direction : {45.0, 90.0, 135.0})
          for (const double phi : {-1.0, 0.0, 1.0}) {
            SidewallChain chain(make(k, k));
            const auto end_at = [&](double share) {
              const double c = 0.161 * share;
              return SidewallEnd{c * std::cos(radians(direction)), c * std::sin(radians(direction)),
                                 phi};
            };
            const SidewallResponse nearly = cold(chain, end_at(0.999), pressure),
                                   more = cold(chain, end_at(0.9999), pressure);
            // The pull along the chord does work on the chord, and grows without bound as the chain
            // is straightened
            const Vector2 along(std::cos(radians(direction)), std::sin(radians(direction)));
            const double pull = -nearly.on_tread.head<2>().dot(along),
                         stronger = -more.on_tread.head<2>().dot(along);
            EXPECT_GT(stronger, pull + 20.0) << "k " << k << ", p " << pressure;
            if (pressure < 1e5) continue;
            // small angles: as 1/sqrt(1 - c/l)
            EXPECT_NEAR(stronger / pull, std::sqrt(10.0), 0.35);
          }
}

TEST(SidewallChain, ImpossibleStatesAreRefused) {
  SidewallChain chain(tr_sidewall(1.0, 1.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [&](const SidewallEnd& end, double pressure) {
    return error_of([&] { cold(chain, end, pressure); });
  };
  EXPECT_THAT(refusal({0.0, 0.1611, 0.0}, 1e5),
              HasSubstr("stretched past its length: its ends (a = 0 m, r = 0.1611 m) are 0.1611 m "
                        "apart, its length is 0.161 m"));
  EXPECT_THAT(refusal({0.001, 0.001, 0.0}, 1e5), HasSubstr("the tread edge lies on the bead"));
  EXPECT_THAT(refusal({nan, 0.1, 0.0}, 1e5), HasSubstr("its tread end is at a = nan m"));
  EXPECT_THAT(refusal({0.0, 0.1, nan}, 1e5), HasSubstr("phi = nan rad"));
  EXPECT_THAT(refusal({0.0, 0.1, 0.0}, -1.0), HasSubstr("the pressure is -1 Pa; it must be >= 0"));
  EXPECT_THAT(refusal({0.0, 0.1, 0.0}, nan), HasSubstr("the pressure is nan Pa"));

  SidewallDirect direct(tr_sidewall(1.0, 1.0), 1e5);
  const SidewallEnd stations[2] = {{0.0, 0.1, 0.0}, {0.0, 0.2, 0.0}};
  SidewallResponse responses[2];
  EXPECT_THAT(error_of([&] { direct.evaluate(stations, responses, 2, true); }),
              HasSubstr("station 1: sidewall: stretched"));
  EXPECT_THAT(error_of([&] { direct.set_pressure(-5.0); }), HasSubstr("the pressure is -5 Pa"));

  SidewallParameters two = uniform_sidewall(3, 0.1, 1.0, 0.0);
  EXPECT_THAT(error_of([&] { SidewallChain{two}; }),
              HasSubstr("has 2 values of bending; allowed: 3 to 999"));
  SidewallParameters negative = tr_sidewall(-1.0, 0.0);
  EXPECT_THAT(error_of([&] { SidewallChain{negative}; }),
              HasSubstr("the stiffness of an end spring is -1"));
}

}  // namespace
}  // namespace furrow::sidewall_chain_test
