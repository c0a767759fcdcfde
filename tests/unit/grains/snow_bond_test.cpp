// SPDX-License-Identifier: GPL-2.0-or-later
// The contact law of snow against its own surfaces, closed forms and balances.

#include "furrow/grains/snow_bond.h"

#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace furrow::snow_bond_test {
namespace {

constexpr double d = 0.02, mass = 7e-4, dt = 1e-5;
const SnowBondParameters ag;  // the defaults
const double k = SnowBond::stiffness(ag, d);

/// At rest with this overlap.
SnowContact touch(double overlap) {
  return {d, mass, overlap, Vector3::UnitZ(), 0.0, Vector3::Zero(), Vector3::Zero(), 0.0, dt};
}

SnowBondState sintered(double overlap = 0.01 * d) {
  SnowBondState state;
  SnowBond::sinter(ag, touch(overlap), state);
  return state;
}

/// A contact that is moved at these rates for some steps; positions follow.
struct Path {
  SnowBondParameters law = ag;
  SnowContact contact = touch(0.01 * d);
  SnowBondState state = sintered();
  SnowBondResponse last = {};
  SnowBondEnergy energy = {};  ///< of the last step
  SnowBondEnergy sum = {};     ///< dissipated so far
  double work = 0.0;           ///< done on the contact

  explicit Path(double damping = 0.0) { law.damping = damping; }

  void step() {
    const Vector3 before = last.force, moment_before = last.moment;
    contact.overlap -= contact.normal_velocity * contact.dt;
    last = SnowBond::advance(law, contact, state, &energy);
    const Vector3 velocity = contact.normal_velocity * contact.normal + contact.tangential_velocity;
    work -=
        0.5 * contact.dt *
        ((before + last.force).dot(velocity) + (moment_before + last.moment).dot(contact.rotation));
    sum.crushed += energy.crushed;
    sum.damped += energy.damped;
    sum.released += energy.released;
  }
  void steps(int count) {
    for (int n = 0; n < count; ++n) step();
  }
  double normal() const { return last.force.dot(contact.normal); }
  double shear() const { return (last.force - normal() * contact.normal).norm(); }
  SnowStrength strength() const {
    return SnowBond::strength(law, d, SnowHardening::at(law, state.crushing(d)));
  }
  double bond_force() const { return SnowBond::bonded_share(state, d) * strength().Fb; }
};

TEST(SnowBond, CrushingForceFollowsTheYieldSurface) {
  Path path;
  path.contact.normal_velocity = -1.0;
  for (int n = 0; n < 1000; ++n) {
    path.step();
    const double X = (path.state.plastic - path.state.at_sintering) / d;
    const double expected =
        d * d * (ag.Y0 * std::exp(ag.p * X) + ag.Y1 * (std::exp(ag.q * X) - 1.0));
    ASSERT_NEAR(path.normal() / expected, 1.0, 1e-12) << "step " << n;
  }
  EXPECT_GT(path.state.plastic, 0.4 * d);  // far into the dense part
}

TEST(SnowBond, OneLargeStepEndsOnTheYieldSurface) {
  Path path;
  path.contact.overlap = 0.6 * d;
  path.step();
  EXPECT_NEAR(path.normal() / path.strength().Fy, 1.0, 1e-10);
  EXPECT_NEAR(path.normal(), k * (0.6 * d - path.state.plastic), 1e-9 * path.normal());
}

TEST(SnowBond, UnloadingAndReloadingAreElastic) {
  Path path;
  path.contact.normal_velocity = -0.5;
  path.steps(200);
  const double peak = path.normal(), plastic = path.state.plastic, crushed = path.sum.crushed;
  path.contact.normal_velocity = 0.05;
  path.step();
  EXPECT_NEAR(path.normal(), peak - k * 0.05 * dt, 1e-12 * k * d);
  path.contact.normal_velocity = -0.05;
  path.step();
  EXPECT_NEAR(path.normal(), peak, 1e-12 * k * d);
  EXPECT_EQ(path.state.plastic, plastic);
  EXPECT_EQ(path.sum.crushed, crushed);
}

TEST(SnowBond, ObliqueCrushingKeepsTheDirectionOfTheForce) {
  // Oblique crushing of a bond: the force keeps the direction of the displacement, K0 = 0.
  Path path;
  path.law.chi = 10.0;  // crushing decides, not shear
  path.contact.normal_velocity = -1.0;
  path.contact.tangential_velocity = 0.5 * Vector3::UnitX();
  path.steps(500);
  EXPECT_GT(path.state.plastic, 0.1 * d);
  EXPECT_NEAR(path.last.force[0] / path.last.force[2], -0.5, 1e-9);
}

TEST(SnowBond, BondBreaksAtItsTensileStrength) {
  for (const double zeta : {0.3, 1.0}) {
    Path path;
    path.law.zeta = zeta;
    path.contact.normal_velocity = 2e-4;
    double strongest = 0.0;
    while (path.state.bonded) {
      path.step();
      strongest = std::min(strongest, path.normal());
      ASSERT_GT(path.contact.overlap, 0.0);
    }
    const double strength = zeta * d * d * ag.Y0;
    EXPECT_NEAR(-strongest, strength, k * 2e-4 * dt);
    EXPECT_TRUE(path.last.broken);
    EXPECT_NEAR(path.sum.released / (0.5 * strength * strength / k), 1.0, 0.02);
    EXPECT_EQ(path.state.at_break, path.state.plastic);
    path.steps(10);
    EXPECT_EQ(path.last.force.norm(), 0.0);
  }
}

TEST(SnowBond, SlidingIsLimitedByCohesionAndFriction) {
  struct Case {
    const char* what;
    bool bonded;
    double pressing;  // of the crush strength
    double chi, mu;
  };
  for (const Case& c :
       {Case{"dry", false, 0.5, 0.7, 0.3}, Case{"dry, smooth", false, 0.5, 0.7, 0.0},
        Case{"bond without load", true, 0.0, 0.7, 0.3},
        Case{"bond in tension", true, -0.5, 0.7, 0.3},
        Case{"bond without cohesion", true, 0.5, 0.0, 0.3},
        Case{"weak bond", true, 0.5, 0.1, 0.3}}) {
    Path path;
    path.law.chi = c.chi;
    path.law.mu = c.mu;
    path.law.w = 0.0;
    path.state.bonded = c.bonded;
    path.contact.overlap += c.pressing * d * d * ag.Y0 / k;
    path.contact.tangential_velocity = 0.05 * Vector3::UnitY();
    for (int n = 0; n < 300; ++n) {
      path.step();
      const double limit = path.law.chi * path.bond_force() + c.mu * std::max(0.0, path.normal());
      EXPECT_LE(path.shear(), limit * (1 + 1e-9) + 1e-15) << c.what;
      if (n > 100) {
        EXPECT_NEAR(path.shear(), limit, 1e-9 * k * d) << c.what;
      }
    }
    // A dry contact slides without sinking in.
    if (!c.bonded || c.chi == 0.0) {
      EXPECT_NEAR(path.normal(), c.pressing * d * d * ag.Y0, 1e-9 * k * d) << c.what;
    }
  }
}

TEST(SnowBond, BendingAndTorsionAreLimitedByThePlasticDisc) {
  for (const bool pressed : {false, true}) {
    Path path;
    if (pressed) path.contact.overlap += 0.5 * d * d * ag.Y0 / k;
    path.contact.rotation = Vector3(3.0, 4.0, 0.0);
    path.steps(2000);
    const double a = SnowBond::bond_radius * d, Fb = d * d * ag.Y0, Fn = pressed ? 0.5 * Fb : 0.0;
    EXPECT_NEAR(path.last.moment.norm() / (4.0 / (3.0 * pi) * a * (Fb + Fn)), 1.0, 1e-9);
    EXPECT_NEAR(path.last.moment[0] / path.last.moment[1], 0.75, 1e-9);
    path.contact.rotation = Vector3(0.0, 0.0, 5.0);
    path.steps(2000);
    EXPECT_NEAR(path.last.moment[2] / (-2.0 / 3.0 * a * (ag.chi * Fb + ag.mu * Fn)), 1.0, 1e-9);
  }
}

TEST(SnowBond, PressureSintersUnbondedContact) {
  Path path;
  path.state = {};
  path.contact.overlap = 0.0;
  path.contact.normal_velocity = -0.5;
  int made = 0;
  for (int n = 0; n < 400; ++n) {
    path.step();
    made += path.last.made;
  }
  EXPECT_EQ(made, 1);
  EXPECT_TRUE(path.state.bonded);
  EXPECT_NEAR(path.state.area, ag.w * pi * d / 4 * path.state.plastic, 1e-15);
  Path wall = path;
  wall.state = {};
  wall.contact.sinters = false;
  wall.contact.overlap = 0.0;
  wall.steps(400);
  EXPECT_FALSE(wall.state.bonded);
}

TEST(SnowBond, SinteringRelaxesTheStress) {
  Path path(0.2);
  path.state = {};
  path.law.Y0 = 1e6;
  path.contact.normal_velocity = -0.1;
  path.contact.tangential_velocity = 0.02 * Vector3::UnitX();
  path.steps(50);
  ASSERT_GT(path.last.force.norm(), 1.0);
  for (const bool sinters : {true, false}) {
    SnowBondState state = path.state;
    SnowContact contact = touch(path.contact.overlap);
    contact.sinters = sinters;
    SnowBondEnergy energy;
    const SnowBondResponse found = SnowBond::sinter(path.law, contact, state, &energy);
    EXPECT_EQ(state.bonded, sinters);
    EXPECT_EQ(found.made, sinters);
    EXPECT_NEAR(energy.released, path.energy.stored, 1e-12);
    EXPECT_EQ(SnowBond::advance(path.law, contact, state).force.norm(), 0.0);
  }
}

TEST(SnowBond, DampersActOnElasticMotionAlone) {
  Path path(0.2);
  path.contact.normal_velocity = -0.01;
  path.step();
  const double c = 2.0 * 0.2 * std::sqrt(mass * k), elastic = k * 0.01 * dt;
  EXPECT_NEAR(path.normal(), elastic + c * 0.01, 1e-9);
  path.contact.normal_velocity = -2.0;
  path.steps(200);
  EXPECT_NEAR(path.normal() / path.strength().Fy, 1.0, 0.02);  // c v would be eight times as much
}

/// Motions that a contact in a bed may have, and some that it may not.
class RandomMotion {
 public:
  explicit RandomMotion(unsigned seed) : random_(seed) {}
  void change(SnowContact& contact) {
    const double speed = std::pow(10.0, -3.0 + 3.0 * number());
    contact.normal_velocity = speed * (2.0 * number() - 1.1);
    if (contact.overlap > 0.5 * d) contact.normal_velocity = speed;
    contact.tangential_velocity = speed * Vector3(number() - 0.5, number() - 0.5, 0.0);
    contact.rotation = speed / d * Vector3(number() - 0.5, number() - 0.5, number() - 0.5);
  }
  double number() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

 private:
  std::mt19937 random_;
};

TEST(SnowBond, RandomPathsStayInsideTheSurfacesAndNeverGainEnergy) {
  int broken = 0, made = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    RandomMotion random(seed);
    Path path;
    for (int n = 0; n < 5000; ++n) {
      if (n % 50 == 0) random.change(path.contact);
      const double share = SnowBond::bonded_share(path.state, d), plastic = path.state.plastic;
      path.step();
      if (path.contact.overlap <= 0.0) {
        SnowBond::part(path.law, d, path.state);
        path.contact.overlap = 1e-6 * d;
        path.contact.normal_velocity = -0.1;
        continue;
      }
      broken += path.last.broken;
      made += path.last.made;
      const SnowStrength strong = path.strength();
      const double rounding = 1e-9 * k * d;
      ASSERT_LE(path.normal(), strong.Fy * (1 + 1e-9)) << seed << ", step " << n;
      ASSERT_GE(path.normal(), -ag.zeta * share * strong.Fb - rounding);
      ASSERT_LE(path.shear(),
                ag.chi * share * strong.Fb + ag.mu * std::max(0.0, path.normal()) + rounding);
      ASSERT_GE(path.state.plastic, plastic);
      ASSERT_GE(path.energy.crushed, 0.0) << seed << ", step " << n;
      ASSERT_GE(path.energy.released, 0.0);
      ASSERT_TRUE(path.last.force.allFinite() && path.last.moment.allFinite());
    }
  }
  EXPECT_GT(broken, 20);
  EXPECT_GT(made, 20);
}

/// |work - stored - dissipated| of a path that crushes, shears, bends and twists, over the work.
double budget_error(int steps) {
  Path path;
  const double time = 4e-3;
  path.contact.dt = time / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = (n + 0.5) / steps;
    path.contact.normal_velocity = -0.05 * std::sin(9.0 * t);
    path.contact.tangential_velocity =
        Vector3(0.03 * std::cos(7.0 * t), 0.02 * std::sin(5.0 * t), 0);
    path.contact.rotation = 2.0 * Vector3(std::sin(6.0 * t), std::cos(4.0 * t), std::sin(8.0 * t));
    path.step();
  }
  EXPECT_GT(path.sum.crushed, 0.0);
  return std::abs(path.work - path.energy.stored - path.sum.crushed - path.sum.released) /
         path.work;
}

TEST(SnowBond, EnergyBalancesToFirstOrder) {
  const double coarse = budget_error(2000), fine = budget_error(20000);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.15 * coarse);
}

TEST(SnowBond, RigidRotationOfThePairTurnsForceAndMoment) {
  Path path;
  path.contact.normal_velocity = -0.2;
  path.contact.tangential_velocity = 0.1 * Vector3::UnitX();
  path.contact.rotation = Vector3(1.0, -2.0, 1.5);
  path.steps(50);
  const Vector3 force = path.last.force, moment = path.last.moment;
  // The pair turns by 1 rad about an axis that is neither the normal nor across it.
  const Vector3 axis = Vector3(1.0, 2.0, 2.0) / 3.0;
  const int steps = 2000;
  const double rate = 1.0 / (steps * dt);
  path.contact.normal_velocity = 0.0;
  path.contact.tangential_velocity.setZero();
  path.contact.rotation.setZero();
  for (int n = 1; n <= steps; ++n) {
    const auto at = [&](double s) {
      return Vector3(Eigen::AngleAxisd(s / steps, axis) * Vector3::UnitZ());
    };
    path.contact.normal = at(n);
    path.contact.spin = rate * axis.dot(at(n - 0.5));
    path.step();
  }
  const Eigen::AngleAxisd turn(1.0, axis);
  EXPECT_LT((path.last.force - turn * force).norm() / force.norm(), 1e-3);
  EXPECT_LT((path.last.moment - turn * moment).norm() / moment.norm(), 1e-3);
  EXPECT_LE(path.last.force.norm(), force.norm());  // no energy is gained
}

TEST(SnowBond, SwappingTheClustersReversesForcesBitwise) {
  RandomMotion random(7);
  Path one(0.2), other(0.2);
  for (int n = 0; n < 3000; ++n) {
    if (n % 40 == 0) random.change(one.contact);
    one.contact.normal =
        (one.contact.normal + 1e-4 * Vector3(random.number(), random.number(), 0)).normalized();
    one.contact.tangential_velocity -=
        one.contact.tangential_velocity.dot(one.contact.normal) * one.contact.normal;
    one.contact.spin = 100.0 * random.number();
    other.contact = one.contact;
    for (Vector3* vector :
         {&other.contact.normal, &other.contact.tangential_velocity, &other.contact.rotation})
      *vector *= -1.0;
    other.contact.spin *= -1.0;
    one.step();
    other.step();
    ASSERT_EQ((one.last.force + other.last.force).norm(), 0.0) << "step " << n;
    ASSERT_EQ((one.last.moment + other.last.moment).norm(), 0.0) << "step " << n;
    ASSERT_EQ(one.state.torsion, other.state.torsion);
  }
}

TEST(SnowBond, StressesDoNotDependOnTheSizeOfClusters) {
  // Lengths and times times f, masses times f^3: forces times f^2, moments times f^3.
  const double f = 3.0;
  RandomMotion random(11);
  Path small(0.2), large(0.2);
  large.contact.d = f * d;
  large.contact.overlap = f * small.contact.overlap;
  large.contact.mass = f * f * f * mass;
  large.contact.dt = f * dt;
  large.state = {};
  SnowBond::sinter(ag, large.contact, large.state);
  for (int n = 0; n < 3000; ++n) {
    if (n % 50 == 0) random.change(small.contact);
    if (small.contact.overlap < 0.04 * d || n > 2900) small.contact.normal_velocity = -0.1;
    large.contact.normal_velocity = small.contact.normal_velocity;
    large.contact.tangential_velocity = small.contact.tangential_velocity;
    large.contact.rotation = small.contact.rotation / f;
    small.step();
    large.step();
  }
  EXPECT_GT(small.last.force.norm(), 0.1 * d * d * ag.Y0);
  EXPECT_LT((large.last.force - f * f * small.last.force).norm(), 1e-7 * large.last.force.norm());
  EXPECT_LT((large.last.moment - f * f * f * small.last.moment).norm(),
            1e-7 * large.last.moment.norm());
}

// The short way of an elastic step against the general one, before and after crushing.
TEST(SnowBond, ElasticShortCutEqualsTheGeneralStep) {
  for (const double crushing : {0.0, 0.1}) {
    Path path(0.2);
    path.contact.normal_velocity = -1.0;
    while (path.state.crushing(d) < crushing) path.step();
    // back to half of the strength, then a turn and a slide
    path.contact.overlap = path.state.plastic + 0.5 * path.bond_force() / k;
    path.contact.normal_velocity = 1e-3;
    path.contact.tangential_velocity = Vector3(2e-4, -1e-4, 0.0);
    path.contact.rotation = Vector3(0.02, 0.01, -0.03);
    path.contact.spin = 0.5;
    for (int n = 0; n < 20; ++n) {
      SnowBondState yielding = path.state;
      SnowBondEnergy energy;
      const SnowBondTrial trial(path.law, path.contact, path.state);
      const SnowBondResponse expected =
          SnowBond::advance_yielding(path.law, path.contact, trial, yielding, &energy);
      SnowBondResponse response;
      ASSERT_TRUE(SnowBond::advance_elastic(path.law, path.contact, trial, path.state, response,
                                            &path.energy));
      EXPECT_LT((response.force - expected.force).norm(), 1e-12 * expected.force.norm());
      EXPECT_LT((response.moment - expected.moment).norm(), 1e-12 * expected.moment.norm());
      EXPECT_NEAR(path.energy.stored / energy.stored, 1.0, 1e-12);
      EXPECT_NEAR(path.energy.damped / energy.damped, 1.0, 1e-9);
      EXPECT_EQ(yielding.plastic, path.state.plastic);
    }
  }
}

TEST(SnowBond, IncrementalHardeningIsTheExponential) {
  const SnowHardening start = SnowHardening::at(ag, 0.2);
  for (const double dX : {1e-6, 1e-4, 2e-3, 2.4e-3, 0.02, 0.3}) {  // by series and beyond
    const SnowHardening grown = SnowGrowth(ag, start, 0.5).after(2.0 * dX),
                        expected = SnowHardening::at(ag, 0.2 + dX);
    EXPECT_NEAR(grown.soft / expected.soft, 1.0, 1e-12) << dX;
    EXPECT_NEAR(grown.dense / expected.dense, 1.0, 1e-12) << dX;
    EXPECT_NEAR(grown.bond / expected.bond, 1.0, 1e-12) << dX;
  }
}

// A contact keeps its hardening from step to step; a new run recognises it, and other parameters.
TEST(SnowBond, MillionSmallStepsKeepTheHardening) {
  constexpr int steps = 1000000;
  constexpr double X = 0.5;
  SnowHardening grown;
  for (int n = 0; n < steps; ++n) grown = SnowGrowth(ag, grown, X / steps).after(1.0);
  EXPECT_TRUE(grown.is_at(ag, X));
  EXPECT_FALSE(grown.is_at(ag, X + 1e-7));
  SnowBondParameters harder = ag;
  harder.q *= 1.001;
  EXPECT_FALSE(grown.is_at(harder, X));
}

TEST(SnowBond, StoredStateIsLoadedCompletely) {
  Path path;
  path.contact.normal_velocity = -0.2;
  path.contact.tangential_velocity = Vector3(0.1, 0.2, 0.0);
  path.contact.rotation = Vector3(1.0, -2.0, 1.5);
  path.steps(100);
  double values[SnowBondState::size];
  path.state.store(values);
  SnowBondState again = SnowBondState::load(values);
  Path rest = path;
  rest.state = again;
  path.steps(10);
  rest.steps(10);
  EXPECT_EQ(path.last.force, rest.last.force);
  EXPECT_EQ(path.last.moment, rest.last.moment);
}

TEST(SnowBond, SeparationReleasesTheElasticEnergy) {
  SnowBondState state = sintered();
  const double plastic = state.plastic;
  EXPECT_NEAR(SnowBond::part(ag, d, state), 0.5 * k * plastic * plastic, 1e-15);
  EXPECT_FALSE(state.bonded);
  EXPECT_EQ(state.plastic, 0.0);
}

TEST(SnowBond, ParametersAreDeclaredOnce) {
  std::vector<Entry> entries;
  double value = 0.13;
  const Schema schema = SnowBondParameters::schema();
  for (const Key& key : schema.keys())
    entries.push_back({key.name, {std::to_string(value -= 0.01)}});
  const SnowBondParameters read = SnowBondParameters::from(schema.read(entries));
  double sum = 0.0;
  for (const double each : {read.E, read.Y0, read.p, read.Y1, read.q, read.pc, read.chi, read.zeta,
                            read.mu, read.w, read.damping})
    sum += each;
  EXPECT_NEAR(sum, 11 * 0.07, 1e-12);  // each once
}

}  // namespace
}  // namespace furrow::snow_bond_test
