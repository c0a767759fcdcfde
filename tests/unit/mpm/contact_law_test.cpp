// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/contact_law.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/mpm/contact/narrow_phase.h"
#include "terrain_scene.h"
#include "tests/support/error_of.h"

namespace furrow::contact_law_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double mass = 2.0, stiffness = 1e5, dt = 1e-4;

/// A particle that touches a horizontal surface above it, 1 mm deep.
struct Touch {
  ContactPoint point{0, Vector3(1, 0, 0), Vector3::Zero(), Vector3(0, 0, -1), -1e-3, 0.0};
  ContactHistory history = of_stiffness();
  ContactLosses losses;

  static ContactHistory of_stiffness() {
    ContactHistory history;
    history.stiffness = stiffness;
    return history;
  }

  template <class Law>
  Vector3 force(const Law& law, const Vector3& velocity, double last_dt = dt) {
    return law.force({point, velocity, mass, 1.0, last_dt}, dt, history, losses);
  }
};

TEST(ContactLaw, NameSelectsTheContactLaw) {
  EXPECT_THAT(contact_law_names(), ElementsAre("penalty", "impulse"));
  ContactParameters parameters;
  EXPECT_TRUE(std::holds_alternative<PenaltyLaw>(make_contact_law(parameters, "foot")));
  parameters.enforcement = "impulse";
  EXPECT_TRUE(std::holds_alternative<ImpulseLaw>(make_contact_law(parameters, "foot")));
  parameters.enforcement = "glue";
  EXPECT_THAT(test::error_of<InputError>([&] { make_contact_law(parameters, "foot"); }),
              HasSubstr("foot has the enforcement 'glue'; allowed: penalty, impul"));
}

/// k gap + c approach along the normal, with c = 2 damping sqrt(k m); it pushes only.
TEST(PenaltyLaw, NormalForceIsSpringAndDashpot) {
  ContactParameters parameters;
  parameters.damping = 0.25;
  const PenaltyLaw law(parameters);
  const double c = 2.0 * 0.25 * std::sqrt(stiffness * mass);
  Touch at_rest, closing, leaving;
  EXPECT_NEAR(at_rest.force(law, Vector3::Zero()).z(), -stiffness * 1e-3, 1e-9);
  EXPECT_EQ(at_rest.losses.damping, 0.0);
  EXPECT_NEAR(closing.force(law, {0, 0, 0.1}).z(), -(stiffness * 1e-3 + c * 0.1), 1e-9);
  EXPECT_NEAR(closing.losses.damping, c * 0.1 * 0.1 * dt, 1e-15);
  EXPECT_EQ(leaving.force(law, {0, 0, -10.0}).z(), 0.0);
}

/// The tangential spring stretches until mu N; what it slides beyond is friction's loss.
TEST(PenaltyLaw, SlidesAtTheLimitOfFriction) {
  ContactParameters parameters;
  parameters.damping = 0.0;
  parameters.friction = 0.3;
  const PenaltyLaw law(parameters);
  Touch touch;
  const double normal = stiffness * 1e-3;
  EXPECT_NEAR(touch.force(law, {0.5, 0, 0}).x(), -stiffness * 0.5 * dt, 1e-9);  // sticks
  EXPECT_EQ(touch.losses.friction, 0.0);
  double slid = 0.5 * dt;
  for (int step = 0; step < 20; ++step) {
    slid += 0.5 * dt;
    const double pull = -touch.force(law, {0.5, 0, 0}).x();
    EXPECT_LE(pull, 0.3 * normal * (1 + 1e-12));
  }
  const double stretch = 0.3 * normal / stiffness;
  EXPECT_NEAR(touch.history.spring.x(), stretch, 1e-12);
  EXPECT_NEAR(touch.history.slip, slid - stretch, 1e-12);
  EXPECT_NEAR(touch.losses.friction, 0.3 * normal * (slid - stretch), 1e-9);
}

/// Springs stretch by the motion since the last step, for any length of the next step.
TEST(PenaltyLaw, SpringStretchesByTheMotionOfTheLastStep) {
  ContactParameters parameters;
  parameters.damping = 0.0;
  const PenaltyLaw law(parameters);
  Touch touch;
  touch.force(law, {0.5, 0, 0}, dt);
  touch.force(law, {0.5, 0, 0}, 0.25 * dt);
  EXPECT_NEAR(touch.history.spring.x(), 1.25 * 0.5 * dt, 1e-18);
}

/// Porous elasticity: K = (p + pt_el) (1 + e0)/kappa. When the ground stiffens under a loaded
/// contact, the springs keep k (gap^2 + stretch^2)/2. When it softens, the springs stay. Ground
/// that has opened gets the springs of the start.
TEST(PenaltyLaw, StiffnessFollowsTheModulusAndKeepsTheEnergy) {
  ParticleGroup group = [] {
    auto material = testing_terrain::material_of(
        "crushable_foam density 200 pt 2000 sigma0 5000 K 1 pc0_reading pc0 elasticity porous "
        "elasticity.kappa 0.005 elasticity.e0 3.5 nu 0.3 pt_el 5000 hardening exponential pc0 5000 "
        "lambda 0.35 hardening.kappa 0.005 hardening.e0 3.5");
    ParticleGroup one{material, Particles(*material)};
    one.particles.append(1);
    one.particles.set_state(0, material->initial_state());
    one.particles.data(column::volume)[0] = 8e-6;
    return one;
  }();
  ContactParameters parameters;
  parameters.stiffness = 0.4;
  PenaltyLaw law(parameters);
  law.fit(testing_terrain::box(group.material, {0, 0, 0}, {1, 1, 1}, 0.5), "foot");
  ContactHistory history;
  law.update_stiffness(group, 0, history);
  const double wave_over_bulk = 3.0 * 0.7 / 1.3;  // nu = 0.3
  const double now = 0.4 * 5000.0 * 900.0 * wave_over_bulk * 0.02;
  EXPECT_NEAR(history.stiffness, now, 1e-9 * now);
  for (const double before : {0.25 * now, 4.0 * now}) {
    const double after = std::max(before, now);
    history.gap = -1e-3;
    history.spring = {0.0, 2e-3, 0.0};
    history.stiffness = before;
    law.update_stiffness(group, 0, history);
    EXPECT_NEAR(history.stiffness, after, 1e-9 * now);
    EXPECT_NEAR(history.gap, -1e-3 * std::sqrt(before / after), 1e-15);
    EXPECT_NEAR(history.spring.y(), 2e-3 * std::sqrt(before / after), 1e-15);
  }
  VectorX opened = group.material->initial_state();
  opened.head<3>().setConstant(1500.0);
  group.particles.set_state(0, opened);
  history = {};
  law.update_stiffness(group, 0, history);
  EXPECT_NEAR(history.stiffness, now, 1e-9 * now);
}

/// m (approach + a fifth of the penetration each step)/dt; friction stops the sliding at most.
TEST(ImpulseLaw, StopsTheApproachWithinTheStep) {
  ContactParameters parameters;
  parameters.friction = std::numeric_limits<double>::infinity();
  const ImpulseLaw law(parameters);
  Touch touch;
  const Vector3 force = touch.force(law, {0.5, 0, 0.1});
  EXPECT_NEAR(force.z(), -mass * (0.1 + 0.2 * 1e-3 / dt) / dt, 1e-6);
  EXPECT_NEAR(force.x(), -mass * 0.5 / dt, 1e-6);
  EXPECT_NEAR(touch.history.slip, 0.5 * dt, 1e-15);
  Touch leaving;
  EXPECT_EQ(leaving.force(law, {0.5, 0, -100.0}), Vector3::Zero());
}

/// min(mu sigma, shear_limit) (1 - exp(-j/k))
TEST(Friction, FrictionGrowsExponentiallyWithSlip) {
  const Friction friction{0.5, 0.02};
  EXPECT_EQ(friction.limit(100.0, 0.0, 1.0), 0.0);
  EXPECT_NEAR(friction.limit(100.0, 0.02, 1.0), 50.0 * (1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_EQ(friction.limit(-1.0, 0.02, 1.0), 0.0);
  EXPECT_EQ((Friction{0.5, 0.0}.limit(100.0, 0.0, 1.0)), 50.0);
}

TEST(Friction, ShearLimitCapsTheFriction) {
  const double rough = std::numeric_limits<double>::infinity();
  EXPECT_EQ((Friction{0.5, 0.0, 3e3}.limit(100.0, 0.0, 0.01)), 30.0);
  EXPECT_EQ((Friction{0.5, 0.0, 3e3}.limit(40.0, 0.0, 0.01)), 20.0);
  EXPECT_EQ((Friction{rough, 0.0, 3e3}.limit(1e-6, 0.0, 0.01)), 30.0);
  EXPECT_EQ((Friction{rough, 0.0, 3e3}.limit(-1.0, 0.0, 0.01)), 0.0);
  EXPECT_NEAR((Friction{0.5, 0.02, 3e3}.limit(100.0, 0.02, 0.01)), 30.0 * (1.0 - std::exp(-1.0)),
              1e-12);
}

TEST(ContactHistory, LiftingResetsSpringAndGapAndTheEndResetsSlip) {
  ContactHistory history;
  history.spring = {1, 2, 3};
  history.slip = 4;
  history.stiffness = 5;
  history.gap = -6;
  history.reach_excess = 7;
  EXPECT_TRUE(history.touches());
  history.lift(1.0);
  EXPECT_FALSE(history.touches());
  EXPECT_EQ(history.spring, Vector3::Zero());
  EXPECT_EQ(history.slip, 5.0);
  history.end_contact();
  EXPECT_EQ(history.slip, 0.0);
  EXPECT_EQ(history.stiffness, 5.0);
  EXPECT_EQ(history.gap, 0.0);
  EXPECT_EQ(history.reach_excess, 7.0);
}

/// Its gap after steps with the normals n and the velocities of the ground relative to the surface,
/// where it touches and where it touched.
double followed(double gap, const std::vector<Vector3>& normals,
                const std::vector<Vector3>& velocities, const std::vector<Vector3>& there) {
  const auto material = testing_terrain::material_of(testing_terrain::elastic(1e6, 0.2, 500));
  Particles particles(*material);
  particles.append(1);
  particles.set_state(0, material->initial_state());
  for (std::size_t k = 0; k < 3; ++k) particles.data(column::half_x + k)[0] = 0.01;
  ContactHistory history;
  history.gap = gap;
  history.normal = normals.front();
  for (std::size_t step = 1; step < normals.size(); ++step) {
    ContactPoint contact{};
    contact.normal = normals[step];
    NarrowPhase::follow(velocities[step], there[step], dt, particles, 0, history, contact);
    history.gap = contact.gap;
    history.normal = contact.normal;
  }
  return history.gap;
}

TEST(NarrowPhase, GapFollowsTheNormalMotion) {
  const std::vector<Vector3> velocities(3, Vector3(2.0, 5.0, 0.0));
  EXPECT_NEAR(followed(-1e-3, {3, Vector3::UnitX()}, velocities, velocities),
              -1e-3 + 2.0 * 2.0 * dt, 1e-15);
}

/// A particle half way between the walls of a groove is thrown back and forth: the wall that it has
/// just come nearer to is the closest one. Its gap must not grow by every step.
TEST(NarrowPhase, GapStaysUnderAlternatingMotionBetweenWalls) {
  std::vector<Vector3> normals, velocities;
  for (int step = 0; step < 1000; ++step) {
    normals.push_back((step % 2 ? 1.0 : -1.0) * Vector3::UnitX());
    velocities.push_back(-normals.back());
  }
  EXPECT_NEAR(followed(-1e-3, normals, velocities, velocities), -1e-3, 1e-12);
}

/// A particle thrown back and forth between walls that move apart lets go of both by their motion:
/// else a spring would press them apart, and give work, without end.
TEST(NarrowPhase, SeparatingWallsLoseContact) {
  const double apart = 0.3;  // [m/s] of each wall
  std::vector<Vector3> normals, velocities, there;
  for (int step = 0; step <= 1000; ++step) {
    normals.push_back((step % 2 ? 1.0 : -1.0) * Vector3::UnitX());
    velocities.push_back(apart * normals.back());
    there.push_back(-velocities.back());
  }
  EXPECT_NEAR(followed(-1.0, normals, velocities, there), -1.0 + 1000 * apart * dt, 1e-9);
}

}  // namespace
}  // namespace furrow::contact_law_test
