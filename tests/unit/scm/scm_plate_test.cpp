// SPDX-License-Identifier: GPL-2.0-or-later
// A plate on a height field: Bekker's pressure, elastic unloading, energy, soil that flows aside.

#include "furrow/scm/scm_contact.h"

#include <cmath>

#include <gtest/gtest.h>

#include "furrow/bodies/rigid_plate.h"
#include "furrow/core/error.h"
#include "furrow/scm/contact_width.h"
#include "tests/support/checkpoints.h"

namespace furrow::scm_plate_test {
namespace {

constexpr double side = 0.2;

Soil loam() {
  Soil soil;
  soil.k_c = 2e4;
  soil.k_phi = 8e5;
  soil.n = 0.7;
  soil.cohesion = 2e3;
  soil.friction_angle = radians(30.0);
  soil.shear_length = 0.01;
  soil.stiffness = 5e7;
  return soil;
}

/// A plate that stands askew to the cells, on ground at z = 0.
struct Pressing {
  explicit Pressing(const Soil& of, PlateShape shape = PlateShape::square, double cell = 0.013)
      : soil(of),
        plate({shape, side, 0.02, 20}, Vector3(0.0137, -0.0071, 0.0)),
        field({0.6, 0.6, Vector2::Zero(), 0.0, cell}),
        contact(plate, field, soil, {}) {}

  /// Moves the plate and returns the force on it at the new place [N].
  double move(double upwards) {
    plate.surface().clear_forces();
    plate.prescribe(upwards);
    plate.advance(1.0);
    contact.apply(1.0);
    return plate.surface().total_force().z();
  }
  double bekker(double sinkage) const {
    return (soil.k_c / (0.5 * side) + soil.k_phi) * std::pow(sinkage, soil.n) * side * side;
  }

  Soil soil;
  RigidPlate plate;
  HeightField field;
  ScmContact contact;
};

/// Each half of a plate over two soils carries what it would carry on its soil alone, with the
/// width of the whole plate.
TEST(ScmPlate, TwoAdjacentSoilsCarryTheirShares) {
  Soil firm = loam(), soft = loam();
  soft.k_phi = 2e5;
  soft.n = 1.0;
  for (const int axis : {0, 1}) {
    const auto force = [&](const SoilPatches& soils) {
      RigidPlate plate({PlateShape::square, side, 0.02, 20}, Vector3::Zero());
      HeightField field({0.6, 0.6, Vector2::Zero(), 0.0, 0.01});
      ScmContact contact(plate, field, soils, {});
      plate.surface().clear_forces();
      plate.prescribe(-0.01);
      plate.advance(1.0);
      contact.apply(1.0);
      return plate.surface().total_force().z();
    };
    const auto both = [&](double begin) {
      SoilPatches soils(firm);
      soils.add(axis, begin, soft);
      return force(soils);
    };
    const double on_firm = force(firm), on_soft = force(soft);
    EXPECT_EQ(both(0.2), on_firm);
    EXPECT_EQ(both(-0.2), on_soft);
    EXPECT_NEAR(both(0.0), 0.5 * (on_firm + on_soft), 1e-9 * on_firm);
  }
}

TEST(ScmPlate, PressureIsBekkersAndUnloadingIsElastic) {
  Pressing pressing(loam());
  double force = 0.0;
  for (int step = 1; step <= 40; ++step) {
    force = pressing.move(-0.001);
    EXPECT_NEAR(force, pressing.bekker(0.001 * step), 1e-10 * force) << step;
  }
  EXPECT_NEAR(pressing.contact.step().width, 0.5 * side, 1e-10);
  EXPECT_NEAR(pressing.contact.step().area, side * side, 1e-12);
  const double loaded = force, area = side * side,
               elastic = loaded / (pressing.soil.stiffness * area);
  EXPECT_NEAR(pressing.move(0.5 * elastic), 0.5 * loaded, 1e-8 * loaded);
  EXPECT_NEAR(pressing.move(0.6 * elastic), 0.0, 0.0);
  EXPECT_NEAR(pressing.field.deepest(), 0.04 - elastic, 1e-12);
  EXPECT_NEAR(pressing.move(-0.6 * elastic), 0.5 * loaded, 1e-8 * loaded);
  EXPECT_NEAR(pressing.move(-0.5 * elastic), loaded, 1e-8 * loaded);
  EXPECT_NEAR(pressing.move(-0.001), pressing.bekker(0.041), 1e-8 * loaded);
}

TEST(ScmPlate, WidthOfACircularPlateIsItsRadius) {
  Pressing pressing(loam(), PlateShape::circle);
  pressing.move(-0.01);
  // a regular polygon of 60 sides with the area of the circle
  EXPECT_NEAR(pressing.contact.step().width, 0.5 * side, 1e-3 * side);
  EXPECT_NEAR(pressing.contact.step().area, 0.25 * pi * side * side, 1e-12);
}

TEST(ScmPlate, ConvexHullOfAStripHasItsPerimeter) {
  std::vector<Vector2> hull, points = {{0.0, 0.0}, {1.0, 0.0}, {0.4, 0.05}, {1.0, 0.1}, {0.0, 0.1}};
  const double perimeter = hull_perimeter(points, hull);
  EXPECT_NEAR(perimeter, 2.2, 1e-14);
  EXPECT_NEAR(contact_width(0.1, perimeter), 0.1 / 1.1, 1e-14);
}

/// The work of the plate is what the soil dissipates and stores; the error is of first order.
TEST(ScmPlate, WorkIsDissipatedAndStored) {
  double last_error = 0.0;
  for (const int steps : {50, 100, 200}) {
    Pressing pressing(loam());
    double work = 0.0, force = 0.0;
    const auto go = [&](double distance, int count) {
      for (int step = 0; step < count; ++step) {
        const double next = pressing.move(-distance / count);
        work += 0.5 * (force + next) * distance / count;
        force = next;
      }
    };
    go(0.03, steps);
    go(-0.0005, steps);
    go(0.0105, steps);
    const double dissipated = pressing.contact.losses().compaction;
    const double error = std::abs(work - dissipated - pressing.contact.step().stored) / work;
    EXPECT_LT(error, 1.5 / steps);
    if (last_error > 0.0) {
      EXPECT_NEAR(last_error / error, 2.0, 0.3);
    }
    last_error = error;
  }
}

TEST(ScmPlate, DampingResistsSinkingAndNeverPulls) {
  Soil soil = loam();
  soil.damping = 1e5;
  Pressing pressing(soil);
  const double force = pressing.move(-0.01);
  EXPECT_NEAR(force, pressing.bekker(0.01) + 1e5 * 0.01 * side * side, 1e-9 * force);
  EXPECT_NEAR(pressing.contact.losses().damping, 1e5 * 0.01 * 0.01 * side * side, 1e-9);
  const double slower = 1e-5;  // m in a second, upwards
  EXPECT_NEAR(pressing.move(slower),
              pressing.bekker(0.01) - (soil.stiffness + soil.damping) * slower * side * side,
              1e-9 * force);
  soil.damping = 1e10;
  Pressing damped(soil);
  damped.move(-0.01);
  EXPECT_EQ(damped.move(slower), 0.0);
}

TEST(ScmPlate, FlowKeepsTheVolumeAndTheAngleOfRepose) {
  Soil soil = loam();
  soil.flow = 1.0;
  Pressing pressing(soil);
  for (int step = 0; step < 400; ++step) pressing.move(-1e-4);
  const double below = pressing.field.volume_below();
  EXPECT_GT(below, 0.9 * 0.04 * side * side);
  EXPECT_NEAR(pressing.field.volume_above(), below, 1e-13);
  const double steepest = std::tan(soil.friction_angle) * pressing.field.cell();
  for (int column = 0; column < pressing.field.columns(); ++column)
    for (int row = 0; row + 1 < pressing.field.rows(); ++row) {
      const double z = pressing.field.surface(pressing.field.index(column, row)),
                   next = pressing.field.surface(pressing.field.index(column, row + 1));
      if (z >= 0.0 && next >= 0.0) {
        EXPECT_LT(std::abs(next - z), 1.1 * steepest);
      }
    }
}

TEST(ScmPlate, PartOfTheVolumeStaysCompacted) {
  Soil soil = loam();
  soil.flow = 0.3;
  Pressing pressing(soil);
  for (int step = 0; step < 40; ++step) pressing.move(-1e-3);
  EXPECT_NEAR(pressing.field.volume_above(), 0.3 * pressing.field.volume_below(), 1e-13);
}

TEST(ScmPlate, RestartContinuesBitwise) {
  Soil soil = loam();
  soil.flow = 0.5;
  Pressing pressing(soil), continued(soil);
  for (int step = 0; step < 5; ++step) pressing.move(-2e-3);
  Checkpoint field("field"), contact("contact"), plate("plate");
  pressing.field.checkpoint(field);
  pressing.contact.checkpoint(contact);
  pressing.plate.checkpoint(plate);
  Checkpoint same_field = field.reread(), same_contact = contact.reread(),
             same_plate = plate.reread();
  continued.field.checkpoint(same_field);
  continued.contact.checkpoint(same_contact);
  continued.plate.checkpoint(same_plate);
  for (const double distance : {-2e-3, 1e-3, -2e-3})
    EXPECT_EQ(pressing.move(distance), continued.move(distance));
  EXPECT_EQ(pressing.field.volume_above(), continued.field.volume_above());
  EXPECT_EQ(pressing.contact.losses().compaction, continued.contact.losses().compaction);
}

TEST(ScmPlate, BodyBeyondTheFieldIsRefused) {
  Soil soil = loam();
  RigidPlate plate({PlateShape::square, side, 0.02, 20}, Vector3(0.25, 0.0, -0.001));
  HeightField field({0.6, 0.6, Vector2::Zero(), 0.0, 0.02});
  ScmContact contact(plate, field, soil, {});
  EXPECT_THROW(contact.apply(1.0), StateError);
}

TEST(ScmPlate, ScriptHasPriorityOverTheSoilCard) {
  Schema schema("soil");
  declare_soil(schema);
  const std::vector<std::string> words = {"k_phi", "1e6", "phi", "30", "K", "0.01"};
  const Soil soil = soil_from(schema.read(words), {{"k_phi", 2e6}, {"n", 1.1}, {"c", 500.0}});
  EXPECT_EQ(soil.k_phi, 1e6);
  EXPECT_EQ(soil.n, 1.1);
  EXPECT_EQ(soil.cohesion, 500.0);
  EXPECT_EQ(soil.stiffness, 1e8);
  EXPECT_THROW(soil_from(schema.read(words), {{"n", 1.1}}), InputError);
}

TEST(ScmPlate, ValuesInOtherUnitsAreRefusedOrWarnedOf) {
  Schema schema("soil");
  declare_soil(schema);
  const std::vector<std::string> none;
  const std::map<std::string, double> sand = {{"k_c", 15600.0}, {"k_phi", 2407400.0},
                                              {"n", 1.1},       {"c", 250.0},
                                              {"phi", 31.9},    {"K", 0.0114}};
  EXPECT_TRUE(plausibility_warnings(soil_from(schema.read(none), sand)).empty());
  const auto warnings_with = [&](const std::vector<std::string>& words) {
    return plausibility_warnings(soil_from(schema.read(words), sand)).size();
  };
  EXPECT_EQ(warnings_with({"c", "0.25"}), 1u);
  EXPECT_EQ(warnings_with({"c", "2e-16"}), 0u);  // result of a fit for 0
  EXPECT_EQ(warnings_with({"K", "4.3e-5"}), 1u);
  for (const auto& [key, value] : std::map<std::string, double>{
           {"k_phi", 2407.4}, {"phi", 0.557}, {"K", 11.4}, {"c", 2.5e6}, {"stiffness", 1e5}}) {
    auto other = sand;
    other[key] = value;
    EXPECT_THROW(soil_from(schema.read(none), other), InputError) << key;
  }
  // snow and heavy clay of [Wong2008]
  soil_from(schema.read(none), {{"k_c", 4370.0},
                                {"k_phi", 196720.0},
                                {"n", 1.6},
                                {"c", 1030.0},
                                {"phi", 19.7},
                                {"K", 0.04}});
  soil_from(schema.read(none), {{"k_c", 12700.0},
                                {"k_phi", 1555950.0},
                                {"n", 0.13},
                                {"c", 68950.0},
                                {"phi", 34.0},
                                {"K", 0.01}});
}

TEST(ScmPlate, ImpossibleFieldsAreRefused) {
  EXPECT_THROW(HeightField({0.6, 0.1, Vector2::Zero(), 0.0, 0.2}), InputError);
  EXPECT_THROW(HeightField({0.6, -0.6, Vector2::Zero(), 0.0, 0.02}), InputError);
  EXPECT_THROW(HeightField({6e3, 6e3, Vector2::Zero(), 0.0, 0.02}), InputError);
  Soil soil = loam();
  soil.k_c = -1e6;
  EXPECT_THROW(soil.modulus(0.1), StateError);
}

}  // namespace
}  // namespace furrow::scm_plate_test
