// SPDX-License-Identifier: GPL-2.0-or-later
// Extreme uses of a ground, coarse and short: each case ends with finite numbers and its energies
// accounted for, or stops with its cause.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "../../unit/mpm/terrain_scene.h"
#include "furrow/bodies/rigid_plate.h"
#include "furrow/bodies/rigid_wheel.h"
#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::wheel_on_snow_hard_cases_test {
namespace {

using ::testing::HasSubstr;
using namespace testing_terrain;

constexpr double depth = 0.2, weight = 636.0 * standard_gravity;

struct Bed {
  std::string material = snow();
  std::string crust;  // a layer of 5 cm on top, unless empty
  double cell = depth / 3;
  double friction = 0.3;
  double length = 1.0;  // [m] ahead of the wheel
};

RigidWheelParameters tr_wheel(double height) {
  RigidWheelParameters p;
  p.geometry.diameter = 0.74;
  p.geometry.width = 0.272;
  p.geometry.shoulder = 0.051;
  p.hub = {{636.0, 2.15, 1.5}, {0.0, 0.0, depth + 0.37 + height}};
  return p;
}

/// The wheel of [Shoop2001] on 0.2 m of terrain, half model; after a millimetre of free fall it
/// carries its weight.
struct Scene {
  explicit Scene(const Bed& bed, double height = 1e-3)
      : ground(parameters(bed), Communicator()),
        wheel(tr_wheel(height)),
        contact(wheel, ground, contact_parameters(bed), true, "contact") {
    system.add(wheel, "wheel");
    system.add(ground, "ground");
    system.add(contact, "contact");
    wheel.release(Coordinate::z);
    wheel.set_load({0, 0, -weight});
    wheel.set_vertical_damping(3000.0);
  }
  static TerrainParameters parameters(const Bed& bed) {
    TerrainParameters p;
    p.layers = {{material_of(bed.material), depth}};
    if (!bed.crust.empty())
      p.layers = {{material_of(bed.crust), 0.05}, {material_of(bed.material), depth}};
    p.surface = depth;
    p.x = even(-0.6, bed.length, bed.cell);
    p.y = even(0.0, 0.4, bed.cell);
    p.z = even(0.0, depth + 4 * bed.cell, bed.cell);
    return p;
  }
  static ContactParameters contact_parameters(const Bed& bed) {
    ContactParameters p;
    p.friction = bed.friction;
    return p;
  }
  void run(double duration) {
    for (const double end = time + duration; time < end; time += 5e-4) system.advance(5e-4);
  }
  /// Rolls at a speed: spin as of rolling times `spin`.
  void roll(double speed, double spin, double duration) {
    wheel.prescribe(Coordinate::x, speed);
    wheel.prescribe(Coordinate::spin, spin * speed / 0.37);
    run(duration);
  }
  double sinkage() const { return depth - wheel.lowest_point(); }
  /// Energy that is not accounted for, of the work done on the ground.
  double imbalance() {
    const EnergyBudget b = ground.energy_budget();
    return std::abs(b.residual()) / (std::abs(b.contact_work) + std::abs(b.load_work));
  }
  void expect_sound(const char* name) {
    const EnergyBudget b = ground.energy_budget();
    ::testing::Test::RecordProperty(
        name, fmt::format("sinkage {:.4f} m, contact work {:.1f} J, numerical {:.1f} J, imbalance "
                          "{:.1e}, penetration {:.1e} m",
                          sinkage(), b.contact_work, b.numerical_loss, imbalance(),
                          contact.deepest_penetration()));
    EXPECT_TRUE(std::isfinite(b.kinetic_energy + b.stored_energy + b.dissipated_energy));
    EXPECT_LT(imbalance(), 0.05);
    EXPECT_GE(b.numerical_loss, -0.01 * b.contact_work);
    EXPECT_GT(sinkage(), 0.0);
    EXPECT_LT(sinkage(), depth);
  }
  ContinuumTerrain ground;
  RigidWheel wheel;
  TerrainContact contact;
  CoupledSystem system;
  double time = 0.0;
};

TEST(HardCase, WheelDroppedFrom30CentimetresRunsSoundly) {
  Scene scene(Bed{});
  scene.wheel.set_velocity({0, 0, -std::sqrt(2 * standard_gravity * 0.3)}, Vector3::Zero());
  scene.run(0.12);
  scene.expect_sound("drop");
}

TEST(HardCase, LoadDoubledInAStepRunsSoundly) {
  Scene scene(Bed{});
  scene.run(0.12);
  const double before = scene.sinkage();
  scene.wheel.set_load({0, 0, -2 * weight});
  scene.run(0.1);
  EXPECT_GT(scene.sinkage(), before);
  scene.expect_sound("doubled");
}

TEST(HardCase, DraggedLockedWheelRunsSoundly) {
  Scene scene(Bed{});
  scene.run(0.1);
  scene.roll(2.2, 0.0, 0.12);
  EXPECT_LT(scene.contact.force().x(), 0.0);  // it resists
  scene.expect_sound("locked");
}

TEST(HardCase, SnowOf47PascalStrengthRunsSoundly) {
  Bed bed;
  bed.material = snow();
  bed.material.replace(bed.material.find("113.76"), 6, "47.0");
  bed.material.replace(bed.material.find("R 2.2e-2"), 8,
                       "R 9.0e-3");  // leaves p_a >= 0 at the start
  Scene scene(bed);
  scene.run(0.12);
  scene.roll(2.2, 1.0, 0.1);
  scene.expect_sound("weak");
}

TEST(HardCase, GridOf4TimesTheCellRunsSoundly) {
  Bed bed;
  bed.cell = 0.1;  // two cells of snow
  Scene scene(bed);
  scene.run(0.12);
  scene.roll(2.2, 1.0, 0.2);
  scene.expect_sound("coarse");
}

TEST(HardCase, ZeroAndHighFrictionRunSoundly) {
  for (const double friction : {0.0, 0.9}) {
    Bed bed;
    bed.friction = friction;
    Scene scene(bed);
    scene.run(0.1);
    scene.roll(2.2, 1.0, 0.1);
    scene.expect_sound(friction > 0 ? "friction_09" : "friction_0");
  }
}

/// A wheel that has come to rest rolls, is lifted, and rolls back in its rut. The snow that the
/// first pass has compacted carries the load: the second adds 3 % to the sinkage.
TEST(HardCase, SecondPassInTheSameRutAddsLittle) {
  Scene scene(Bed{});
  scene.roll(0.0, 0.0, 0.4);
  scene.roll(2.2, 1.0, 0.15);
  const double first = scene.sinkage();
  scene.wheel.prescribe(Coordinate::z, 1.0);  // lifted
  scene.roll(0.0, 0.0, 0.14);
  EXPECT_EQ(scene.contact.contacts(), 0.0);
  scene.wheel.prescribe(Coordinate::z, -0.9);
  scene.roll(0.0, 0.0, 0.14);
  scene.wheel.release(Coordinate::z);
  scene.roll(0.0, 0.0, 0.3);
  scene.roll(-2.2, 1.0, 0.15);
  EXPECT_GT(scene.sinkage(), first);
  EXPECT_LT(scene.sinkage(), 1.1 * first);
  scene.expect_sound("second_pass");
}

/// Snow with cohesion that grows with density: the wheel spins at 90 % slip, tears itself out of
/// its rut and rolls through it again.
TEST(HardCase, SpinningWheelInCohesiveSnowRunsSoundly) {
  Bed bed;
  bed.material = crushing_snow();
  Scene scene(bed);
  scene.run(0.1);
  scene.roll(0.5, 10.0, 0.1);
  scene.expect_sound("spun");
  scene.wheel.prescribe(Coordinate::z, 1.0);
  scene.roll(0.0, 0.0, 0.1);
  EXPECT_EQ(scene.contact.contacts(), 0.0);
  scene.wheel.release(Coordinate::z);
  scene.roll(0.0, 0.0, 0.15);
  scene.roll(-2.2, 1.0, 0.1);
  scene.expect_sound("rolled_again");
}

TEST(HardCase, StiffCrustOnSoftSnowRunsSoundly) {
  Bed bed;
  bed.crust =
      "drucker_prager_cap density 400 d 1e5 beta 40 R 0.02 eps_vol_pl_0 0.001 elasticity linear E "
      "1e8 nu 0.2 "
      "hardening table p 4e5 2e6 eps_vol_pl 0 0.5 interpolation linear beyond extrapolate";
  Scene scene(bed);
  scene.run(0.12);
  scene.expect_sound("crust");
}

TEST(HardCase, WheelThatLeavesTheGroundStopsTheRun) {
  Bed bed;
  bed.length = 0.1;
  Scene scene(bed);
  EXPECT_THAT(
      test::error_of<StateError>([&] {
        scene.run(0.05);
        scene.roll(3.0, 1.0, 0.2);
      }),
      ::testing::AllOf(
          HasSubstr("contact 'contact': the middle of the body is at x = 0.1"),
          HasSubstr(
              "beyond the ground that reaches from -0.6 to 0.1 m; give the ground more length")));
}

/// Compacted to a tenth of its height: denser than ice, which is reported and not clamped.
void expect_sound_at_90_percent(double stiffness) {
  const double cell = 0.02, height = 0.2;
  const auto material = material_of(snow());
  TerrainParameters p = box(material, {0, 0, 0}, {cell, cell, height}, cell);
  p.z = even(0, height + 2 * cell, cell);
  p.surface = height;
  set_boundary(p, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  PressedGround press(p, {PlateShape::square, 6 * cell, 2 * cell, 3},
                      {0.5 * cell, 0.5 * cell, height + 1e-5});
  ContactParameters lid;
  lid.stiffness = stiffness;
  press.touch(lid);
  while (press.plate.centre().z() > 0.1 * height) {
    press.plate.prescribe(-std::min(1.0, 20 * press.plate.centre().z()));
    press.system.advance(1e-4);
  }
  const EnergyBudget b = press.ground.energy_budget();
  ::testing::Test::RecordProperty(
      "energies", fmt::format("contact {:.4g}, residual {:.2g}, numerical {:.2g} J", b.contact_work,
                              b.residual(), b.numerical_loss));
  EXPECT_LT(std::abs(b.residual()), 0.01 * b.contact_work);
  for_particles(press.ground, [&](Particles& particles, std::size_t n) {
    const double J = particles.data(column::state + field::volume_ratio)[n];
    EXPECT_GT(J, 0.03);
    EXPECT_LT(J, 0.2);
    EXPECT_GT(material->density() / J, ice_density);
  });
}

TEST(HardCase, CompactionBy90PercentRunsSoundly) { expect_sound_at_90_percent(3.6); }

/// The contact's springs are made for the snow's elasticity; ice at tens of megapascals presses
/// through them.
TEST(HardCase, CompactionUnderASoftLidStopsTheRun) {
  EXPECT_THAT(test::error_of<StateError>([&] { expect_sound_at_90_percent(0.1); }),
              ::testing::AllOf(HasSubstr("contact 'foot': the surface is 0.01"),
                               HasSubstr("raise 'stiffness'")));
}

}  // namespace
}  // namespace furrow::wheel_on_snow_hard_cases_test
