// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/terrain_contact.h"

#include <cmath>
#include <limits>
#include <optional>

#include <gmock/gmock.h>

#include "furrow/bodies/rigid_plate.h"
#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::terrain_contact_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;
using namespace testing_terrain;

ContinuumTerrain block(double y_lower = -0.1) {
  TerrainParameters p =
      box(material_of(elastic(1e6, 0.2, 500)), {-0.1, y_lower, -0.1}, {0.1, 0.1, 0.0}, 0.025);
  p.z = even(-0.1, 0.1, 0.025);
  return ContinuumTerrain(p, Communicator());
}

TEST(TerrainContact, ReadsItsKeys) {
  const auto read = [](const std::vector<std::string>& words) {
    return ContactParameters::from(ContactParameters::schema().read(words));
  };
  EXPECT_EQ(read({}).friction, 0.3);
  EXPECT_EQ(read({"surface", "smooth"}).friction, 0.0);
  EXPECT_EQ(read({"surface", "rough"}).friction, std::numeric_limits<double>::infinity());
  EXPECT_EQ(read({"enforcement", "impulse"}).enforcement, "impulse");
  EXPECT_EQ(read({"friction", "0.5", "slip_length", "0.02"}).slip_length, 0.02);
  EXPECT_THAT(error_of([&] {
                read({"surface", "rough", "friction", "0.5"});
              }),
              HasSubstr("keyword 'friction' is given with a rough surface"));
  EXPECT_THAT(error_of([&] {
                read({"surface", "rough", "slip_length", "0.01"});
              }),
              HasSubstr("keyword 'slip_length' is given with a rough surface; "
                        "allowed: slip_length with surface frictional only"));
  EXPECT_EQ(read({"surface", "rough", "shear_limit", "1e4"}).shear_limit, 1e4);
  EXPECT_THAT(error_of([&] {
                read({"surface", "smooth", "shear_limit", "1e4"});
              }),
              HasSubstr("keyword 'shear_limit' is given with a smooth surface"));
  EXPECT_THAT(error_of([&] { read({"friction", "-1"}); }), HasSubstr("keyword 'friction' is -1"));
  EXPECT_THAT(error_of([&] { read({"damping", "2"}); }), HasSubstr("keyword 'damping' is 2"));
}

/// Ground level with a plate's lower face is not touched by it, under the plate or beside its edge.
TEST(TerrainContact, PlateAtTheSurfaceHasNoForce) {
  ContinuumTerrain ground = block();
  RigidPlate plate({PlateShape::circle, 0.11, 0.05, 4}, {0.003, 0.004, 1e-9});
  TerrainContact contact(plate, ground, ContactParameters{}, false, "foot");
  contact.apply(1e-5);
  EXPECT_EQ(contact.contacts(), 0.0);
  EXPECT_EQ(contact.force(), Vector3::Zero());
}

/// A spring that the step cannot follow makes energy from nothing.
TEST(TerrainContact, RefusesASpringTooStiffForTheStep) {
  ContinuumTerrain ground = block();
  RigidPlate plate({PlateShape::circle, 0.11, 0.05, 4}, {0.0, 0.0, 0.01});
  ContactParameters stiff;
  stiff.stiffness = 3.9;
  stiff.damping = 0.1;
  EXPECT_THAT(error_of([&] { TerrainContact(plate, ground, stiff, false, "foot"); }),
              HasSubstr("has a stiffness of 3.9, too stiff for steps of cfl 0.4 with 2 particles "
                        "along a cell and damping 0.1; allowed: stiffness below "));
}

/// nu = 0, one particle on a plate that stands still, in a remap interval: the bound is the limit
/// of stability. With a = 4 cfl^2 and two particles along a cell, (4 - a)(4 - b) = b.
/// @return the largest speed over that at the start
double growth_on_a_plate(double damping, double of_bound) {
  constexpr double h = 0.1, modulus = 1e6, density = 200.0, cfl = 0.2;
  const double a = 4.0 * cfl * cfl, b = 4.0 * (4.0 - a) / (5.0 - a);
  const double root = std::sqrt(4.0 * damping * damping + b) - 2.0 * damping;  // n cfl sqrt(s)
  ContactParameters spring;
  spring.damping = damping;
  spring.friction = 0.0;
  spring.stiffness = of_bound * std::pow(root / (2.0 * cfl), 2);
  TerrainParameters parameters =
      box(material_of(elastic(modulus, 0.0, density)), {0, 0, 0}, {0.6, 0.6, 0.6}, h);
  parameters.cfl = 0.01;  // the contact checks another step than this test takes
  parameters.remap_interval = 64;
  ContinuumTerrain ground(parameters, Communicator());
  bool found = false;
  carve(ground, [&](const Vector3& x) {
    const bool keep = !found && (x - Vector3(0.33, 0.33, 0.33)).norm() < 0.05;
    found |= keep;
    return keep;
  });
  const Vector3 x = ground.groups()[0].particles.position(0);
  RigidPlate plate({PlateShape::square, 0.3, 0.05, 4}, {x.x(), x.y(), x.z() + 0.025 - 1e-4});
  TerrainContact contact(plate, ground, spring, false, "foot");
  const double dt = cfl * h / std::sqrt(modulus / density);
  // The spring's force of the start is held by an equal one: vibration about equilibrium.
  std::vector<ParticleMotion> motion;
  double bias = 0.0, first = 0.0, largest = 0.0;
  for (int step = 0; step < 60; ++step) {
    contact.apply(dt);
    ground.interpolate_motion({{0, 0}}, motion);
    if (step == 0) bias = contact.force().z();
    ground.add_point_force({0, 0}, {0, 0, bias * (step == 0 ? 1.01 : 1.0)},
                           {x.x(), x.y(), x.z() + 0.025 - 1e-4});
    ground.advance(dt);
    ground.interpolate_motion({{0, 0}}, motion);
    const double speed = motion[0].velocity.norm();
    if (step == 0) first = speed;
    largest = std::max(largest, speed);
  }
  return largest / first;
}

TEST(TerrainContact, LoneParticleIsStableUpToTheBoundOfTheStiffness) {
  for (const double damping : {0.0, 0.1, 0.5}) {
    // a leapfrog at 0.99 of its frequency grows to 1/sqrt(1 - 0.98) = 7.1
    EXPECT_LT(growth_on_a_plate(damping, 0.98), 7.1) << damping;
    // from 1 % of the contact's force until the particle lets go of the plate
    EXPECT_GT(growth_on_a_plate(damping, 1.06), 30.0) << damping;
  }
}

/// A plate at 1 m/s; the steps since the last contact are 1, 2 and 0.5 times 1e-5 s long. The force
/// of a step belongs to the gap that the last step left: minus the path.
TEST(TerrainContact, GapFollowsTheMotionWhenTheStepChanges) {
  TerrainParameters parameters =
      box(material_of(elastic(1e6, 0.2, 500)), {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.0}, 0.025);
  parameters.z = even(-0.1, 0.1, 0.025);
  parameters.gravity = Vector3::Zero();
  ContinuumTerrain ground(parameters, Communicator());
  RigidPlate plate({PlateShape::square, 0.1, 0.05, 4}, {0, 0, -1e-6});
  TerrainContact contact(plate, ground, ContactParameters{}, false, "foot");
  double path = 1e-6;
  for (const double dt : {1e-5, 2e-5, 0.5e-5, 1e-5}) {
    contact.apply(dt);
    EXPECT_NEAR(contact.penetration(), path, 1e-12);
    plate.surface().v.row(2).setConstant(-1.0);
    plate.surface().x.row(2).array() -= dt;
    path += dt;
  }
}

/// A plate that slides on ground at rest with T/N = mu (1 - exp(-j/k)).
struct SlidingPlate {
  static constexpr double cell = 0.025, reach = cell / 8.0, dt = 1e-3;  // 4 particles along a cell

  SlidingPlate() {
    TerrainParameters parameters =
        box(material_of(elastic(1e6, 0.2, 500)), {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.0}, cell);
    parameters.z = even(-0.1, 0.1, cell);
    parameters.gravity = Vector3::Zero();
    parameters.particles_per_cell = {4, 4, 4};
    ground.emplace(parameters, Communicator());
    law.friction = 0.5;
    law.slip_length = 0.01;
    law.stiffness = 0.1;
    law.damping = 0.0;
  }
  void touch() {
    contact.emplace(plate, *ground, law, false, "foot");
    contact->apply(dt);
  }
  void move(const Vector3& path, int steps) {
    for (int n = 0; n < steps; ++n) {
      plate.surface().v.colwise() = Vector3(path / (steps * dt));
      plate.surface().x.colwise() += Vector3(path / steps);
      contact->apply(dt);
    }
  }
  double mobilised() const { return std::abs(contact->force().x()) / contact->force().z(); }
  static double closed_form(double slip) { return 0.5 * (1.0 - std::exp(-slip / 0.01)); }

  std::optional<ContinuumTerrain> ground;
  RigidPlate plate{{PlateShape::square, 0.5, 0.05, 4}, {0, 0, -1e-4}};  // wider than the ground
  ContactParameters law;
  std::optional<TerrainContact> contact;
};

/// The plate slides by 10 mm, rises, slides by 3 mm, comes back and slides by 2 mm: a particle that
/// was no farther than its reach has slipped by 15 mm.
TEST(TerrainContact, SlipPersistsOverABounceAndEndsWithTheContact) {
  const auto mobilised_after_rising = [](double reaches) {
    SlidingPlate sliding;
    sliding.touch();
    sliding.move({0.01, 0, 0}, 10);
    sliding.move({0, 0, reaches * SlidingPlate::reach}, 20);
    sliding.move({0.003, 0, 0}, 10);
    EXPECT_EQ(sliding.contact->force(), Vector3::Zero());
    sliding.move({0, 0, -reaches * SlidingPlate::reach}, 20);
    sliding.move({0.002, 0, 0}, 10);
    return sliding.mobilised();
  };
  EXPECT_NEAR(mobilised_after_rising(0.5), SlidingPlate::closed_form(0.015), 0.02);
  EXPECT_NEAR(mobilised_after_rising(3.0), SlidingPlate::closed_form(0.002), 0.02);
}

/// Every second row of particles lies a spacing lower. It touches after 10 mm of slip of the other
/// rows and begins with it.
TEST(TerrainContact, NewContactStartsWithTheSlipOfItsCell) {
  constexpr double spacing = 2.0 * SlidingPlate::reach;
  SlidingPlate sliding;
  carve(*sliding.ground, [](const Vector3& x) {
    return x.z() < -spacing || std::fmod(x.x() + 0.1, 2.0 * spacing) > spacing;
  });
  sliding.touch();
  sliding.move({0.01, 0, 0}, 10);
  const double contacts = sliding.contact->contacts();
  sliding.move({0, 0, -1.8 * spacing}, 20);
  sliding.move({0.008, 0, 0}, 40);
  EXPECT_GT(sliding.contact->contacts(), 1.5 * contacts);
  EXPECT_NEAR(sliding.mobilised(), SlidingPlate::closed_form(0.018), 0.01);
}

/// A script may remove a contact and define it once more, with another friction.
TEST(TerrainContact, ContactIsRemovedAndDefinedAgain) {
  ContinuumTerrain ground = block();
  RigidPlate plate({PlateShape::square, 0.1, 0.05, 4}, {0, 0, -1e-4});
  double first = 0.0;
  for (int n = 0; n < 2; ++n) {
    TerrainContact contact(plate, ground, ContactParameters{}, false, "foot");
    if (n > 0) ground.advance(1e-7);
    contact.apply(1e-5);
    if (n == 0) first = contact.force().z();
    EXPECT_GT(first, 0.0);
    EXPECT_NEAR(contact.force().z(), first, 1e-3 * first);
  }
}

/// gap = height of the plate above the particles' faces: spring force k gap of every particle under
/// it.
TEST(TerrainContact, ForceIsStiffnessTimesPenetration) {
  ContinuumTerrain ground = block();
  const double depth = 1e-4, stiffness = 1.6 * (1e6 * 0.8 / (1.2 * 0.6)) * 0.0125;  // 1.6 M V^(1/3)
  RigidPlate plate({PlateShape::square, 0.1, 0.05, 4}, {0, 0, -depth});
  TerrainContact contact(plate, ground, ContactParameters{}, false, "foot");
  contact.apply(1e-5);
  EXPECT_EQ(contact.contacts(), 64.0);
  EXPECT_NEAR(contact.penetration(), depth, 1e-12);
  EXPECT_NEAR(contact.force().z(), 64 * stiffness * depth, 1e-9 * contact.force().z());
  EXPECT_NEAR(contact.area(), 0.01, 1e-9);
  EXPECT_NEAR(plate.surface().total_force().z(), contact.force().z(), 1e-9);
}

/// A rough plate over all of the ground, 0.2 m x 0.2 m, drags it with the shear limit.
TEST(TerrainContact, RoughPlateHasTheShearLimit) {
  SlidingPlate sliding;
  sliding.law.friction = std::numeric_limits<double>::infinity();
  sliding.law.slip_length = 0.0;
  sliding.law.shear_limit = 50.0;
  sliding.touch();
  for (const double path : {1e-3, 9e-3}) {
    sliding.move({path, 0, 0}, 1000);
    EXPECT_NEAR(sliding.contact->force().x(), -50.0 * 0.2 * 0.2, 1e-9) << path;
  }
}

/// Every second row of particles is lower, and bounces after all have slid. The others drag with
/// the shear limit of the whole surface, 0.2 m x 0.2 m.
TEST(TerrainContact, BouncingParticlesPassTheirShearLimitToTheOthers) {
  SlidingPlate sliding;
  sliding.law.friction = std::numeric_limits<double>::infinity();
  sliding.law.slip_length = 0.0;
  sliding.law.shear_limit = 50.0;
  for_particles(*sliding.ground, [](Particles& particles, std::size_t p) {
    const double row = std::floor((particles.position(p).x() + 0.1) / (2.0 * SlidingPlate::reach));
    if (std::fmod(row, 2.0) > 0.5) particles.data(column::z)[p] -= 1.5e-4;
  });
  sliding.touch();
  const double contacts = sliding.contact->contacts();
  sliding.move({0, 0, -2e-4}, 10);
  sliding.move({9e-3, 0, 0}, 1000);
  EXPECT_EQ(sliding.contact->contacts(), 2.0 * contacts);
  sliding.move({0, 0, 2e-4}, 10);
  sliding.move({9e-3, 0, 0}, 1000);
  EXPECT_EQ(sliding.contact->contacts(), contacts);
  EXPECT_NEAR(sliding.contact->force().x(), -50.0 * 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(sliding.contact->area(), 0.2 * 0.2, 1e-12);
}

/// Undersides of two ribs, with a groove between them.
class TwoRibs : public Body {
 public:
  /// @param left, right  edges of the groove [m]
  TwoRibs(double left, double right, double height) {
    surface_.resize(8);
    surface_.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 6, 5}, {5, 6, 7}};
    const double x[4] = {left - 0.1, left, right, right + 0.1};
    for (int n = 0; n < 8; ++n)
      surface_.x.col(n) << x[n / 4 * 2 + n % 2], n % 4 < 2 ? -0.1 : 0.1, height;
  }
  void move(double dx) { surface_.x.row(0).array() += dx; }
  double stable_time_step() const override { return 1.0; }
  void advance(double) override {}
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override { return {}; }
  void checkpoint(Checkpoint&) override {}

 private:
  Surface surface_;
};

/// A particle that touches one rib beside a groove leaves it for another that is closer by more
/// than a tenth of half its spacing, not for a lesser gain.
TEST(TerrainContact, ParticleSwitchesFacetForAMinimumGain) {
  ContinuumTerrain ground = block();
  const double half = 0.00625, width = 6e-3;
  carve(ground, [&](const Vector3& x) { return (x - Vector3(half, half, -half)).norm() < 1e-6; });
  TwoRibs ribs(half - 0.5 * width + 1e-4, half + 0.5 * width + 1e-4, -1e-3);
  TerrainContact contact(ribs, ground, ContactParameters{}, false, "foot");
  const auto side_force = [&](double dx) {
    ribs.move(dx);
    contact.apply(1e-6);
    return contact.force().x();
  };
  EXPECT_LT(side_force(0.0), 0.0);    // of the left rib
  EXPECT_LT(side_force(-4e-4), 0.0);  // the right one is nearer by 0.3 mm
  EXPECT_GT(side_force(-6e-4), 0.0);  // ... by 0.9 mm
  EXPECT_GT(side_force(8e-4), 0.0);   // and back
  EXPECT_EQ(contact.contacts(), 1.0);
}

/// Half a model gives the whole plate's force, without sideways force or moment about x.
TEST(TerrainContact, HalfModelIsMirrored) {
  ContinuumTerrain whole = block(), half = block(0.0);
  RigidPlate one({PlateShape::square, 0.1, 0.05, 4}, {0.01, 0, -1e-4}),
      other({PlateShape::square, 0.1, 0.05, 4}, {0.01, 0, -1e-4});
  TerrainContact full(one, whole, ContactParameters{}, false, "whole"),
      mirrored(other, half, ContactParameters{}, true, "half");
  full.apply(1e-5);
  mirrored.apply(1e-5);
  EXPECT_EQ(full.contacts(), mirrored.contacts());
  EXPECT_LT((full.force() - mirrored.force()).norm(), 1e-9 * full.force().norm());
  // The plate's diagonals are not mirrored, so that nodes may share a force otherwise; its moment
  // is the same.
  EXPECT_LT(
      (one.surface().total_moment(Vector3::Zero()) - other.surface().total_moment(Vector3::Zero()))
          .norm(),
      1e-9 * full.force().norm());
}

TEST(TerrainContact, ImpossibleContactIsRefused) {
  ContinuumTerrain ground = block(0.0);
  RigidPlate aside({PlateShape::square, 0.05, 0.05, 4}, {0, 0.01, 0.01});
  EXPECT_THAT(error_of([&] { TerrainContact(aside, ground, ContactParameters{}, true, "foot"); }),
              HasSubstr("foot needs a surface that is its own mirror image in the plane y = 0 m"));
  RigidPlate inside({PlateShape::square, 0.1, 0.05, 4}, {0, 0.05, -0.08});
  TerrainContact overlap(inside, ground, ContactParameters{}, false, "overlap");
  EXPECT_THAT(error_of([&] { overlap.apply(1e-5); }),
              HasSubstr("is inside of the body at the start; start above the ground"));
  RigidPlate away({PlateShape::square, 0.1, 0.05, 4}, {0.3, 0.05, 0.01});
  TerrainContact departed(away, ground, ContactParameters{}, false, "departed");
  EXPECT_THAT(error_of([&] { departed.apply(1e-5); }),
              HasSubstr("the middle of the body is at x = 0.3 m"));
  RigidPlate finer({PlateShape::square, 0.1, 0.05, 8}, {0, 0.05, 0.01});
  TerrainContact one(away, ground, ContactParameters{}, false, "one"),
      other(finer, ground, ContactParameters{}, false, "other");
  EXPECT_THAT(error_of([&] { test::hand_over(one, other); }), HasSubstr("surface_nodes is"));
}

}  // namespace
}  // namespace furrow::terrain_contact_test
