// SPDX-License-Identifier: GPL-2.0-or-later
// The tyre with a tread of bricks as a body: its mesh, conservation laws in free flight, rest on a
// plane, half and whole, area of contact, restarts, refusals.

#include "furrow/tyre/brick/brick_tyre.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "furrow/io/inputs/brick_tyre_file.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"
#include "furrow/tyre/contact_patch.h"
#include "furrow/tyre/brick/section_curve.h"

namespace furrow::brick_tyre_test {
namespace {

using test::error_of;
using testing::HasSubstr;

BrickTyreParameters tyre_file(const std::string& name, double pressure = 2.41e5) {
  BrickTyreParameters tyre = read_brick_tyre_file(std::string(FURROW_SOURCE_DIR) +
                                                  "/inputs/tyres/p235_75r15_" + name + ".yaml");
  tyre.pressure = pressure;
  return tyre;
}

BrickTyreSettings coarse(bool half = false, int sections = 16) {
  BrickTyreSettings settings;
  settings.sections = sections;
  settings.half = half;
  return settings;
}

const HubParameters rim{{20.0, 0.6, 0.4}, {0.0, 0.0, 0.4}};

/// The outside has no gaps but the two beads, and its normals point outwards: seen from above, the
/// areas of the tread's outside sum up to nothing.
TEST(BrickTyreMesh, OuterSurfaceIsOpenAtTheBeadsAlone) {
  for (const char* name : {"smooth", "ribbed", "lugged"}) {
    const int sections = 60;
    const BrickTyreMesh mesh = make_brick_tyre_mesh(tyre_file(name), sections, false);
    std::map<std::pair<int, int>, int> edges;
    Vector3 area = Vector3::Zero();
    for (const Vector3i& triangle : mesh.triangles) {
      Vector3 corner[3];
      for (int k = 0; k < 3; ++k) {
        ++edges[{triangle[k], triangle[(k + 1) % 3]}];
        corner[k] = mesh.x.col(mesh.surface_nodes[static_cast<std::size_t>(triangle[k])]);
      }
      area += 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    }
    int open = 0;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << name;
      open += edges.count({edge.second, edge.first}) == 0;
    }
    EXPECT_EQ(open, 2 * sections) << name;
    EXPECT_LT(area.norm(), 1e-12) << name;
    EXPECT_EQ(mesh.beads.size(), 2u * sections) << name;
    double lowest = 0.0;  // the grid's lines are the tread's outermost nodes
    for (int n = 0; n < mesh.grid.count(); ++n)
      lowest = std::min(lowest, mesh.x(2, mesh.surface_nodes[static_cast<std::size_t>(n)]));
    EXPECT_NEAR(lowest, -tyre_file(name).radius(), 1e-12) << name;
  }
}

TEST(BrickTyreMesh, RubberHasTheVolumeOfTheSection) {
  const BrickTyreParameters smooth = tyre_file("smooth");
  const auto mass = [&](int sections, bool half) {
    const BrickTyreMesh mesh = make_brick_tyre_mesh(smooth, sections, half);
    return (half ? 2.0 : 1.0) * Brick8(mesh.x, mesh.bricks, smooth.tread.rubber).mass().sum();
  };
  EXPECT_NEAR(mass(60, true), mass(60, false), 1e-9);
  // rings of rubber, one on each side, which widen outwards where the outline turns
  const SectionCurve curve(smooth.carcass.axial, smooth.carcass.radius);
  const double ds = 1e-4;
  double volume = 0.0;
  for (double s = 0.5 * ds; s < smooth.tread.end(); s += ds) {
    const double thickness = smooth.tread.thickness_at(s);
    const double radius = curve.point(s)[1] + 0.5 * thickness * curve.normal(s)[1];
    const Vector2 before = curve.normal(s - 0.5 * ds), after = curve.normal(s + 0.5 * ds);
    const double turn = after[0] * before[1] - after[1] * before[0];  // [rad]
    volume += 2.0 * 2.0 * pi * radius * thickness * (ds + 0.5 * thickness * turn);
  }
  EXPECT_NEAR(mass(120, true) / (814.575 * volume), 1.0, 0.02);  // elements are chords
}

TEST(BrickTyreMesh, SectionsMustBeAMultipleOfThePitches) {
  EXPECT_THAT(error_of([] { make_brick_tyre_mesh(tyre_file("lugged"), 100, true); }),
              HasSubstr("has 100 sections for 30 pitches"));
}

TEST(BrickTyreParameters, NarrowestVoidAndRibAreFound) {
  const double none = std::numeric_limits<double>::infinity();
  for (const auto& [name, groove, rib] :
       {std::tuple("smooth", none, none), std::tuple("ribbed", 0.0162, 0.0154),
        std::tuple("lugged", 0.0386, 0.0386)}) {
    const BrickTyreParameters tyre = tyre_file(name);
    const double narrowest_void = tyre.tread.narrowest_void(tyre.radius());
    const double narrowest_rib = tyre.tread.narrowest_rib(tyre.radius());
    EXPECT_TRUE(narrowest_void == groove || std::abs(narrowest_void - groove) < 1e-4) << name;
    EXPECT_TRUE(narrowest_rib == rib || std::abs(narrowest_rib - rib) < 1e-4) << name;
  }
}

/// The section is an arc of 8 cm, whose tension at 200 kPa is 16 kN/m where it is widest.
TEST(BrickTyreParameters, TensionOf4TimesTheShearStiffnessWrinklesWithoutCords) {
  BrickTyreParameters tyre = tyre_file("smooth", 2e5);
  tyre.carcass.cords = false;
  tyre.carcass.axial.clear();
  tyre.carcass.radius.clear();
  for (int k = 0; k <= 12; ++k) {
    tyre.carcass.axial.push_back(0.08 * std::sin(0.2 * k));
    tyre.carcass.radius.push_back(0.25 + 0.08 * std::cos(0.2 * k));
  }
  const auto said = [&](double shear) {
    for (CarcassZone& zone : tyre.carcass.zones) zone.wall.shear = shear;
    return wrinkling(tyre);
  };
  EXPECT_EQ(said(1.01 * 4e3), "");
  EXPECT_THAT(said(0.99 * 4e3), HasSubstr("at 200 kPa the tension across the carcass"));
  EXPECT_THAT(said(2e3), HasSubstr("1.6e+04 N/m, more than four times its shear stiffness of 2e+03 "
                                   "N/m: a fine mesh wrinkles there; give 'cords: yes'"));
  tyre.carcass.cords = true;
  EXPECT_EQ(said(2e3), "");
  for (const char* name : {"smooth", "ribbed", "lugged", "equivalent"})
    EXPECT_EQ(wrinkling(tyre_file(name)), "") << name;
}

/// Momentum, and angular momentum about y of all masses about the origin.
std::pair<Vector3, double> momenta(const BrickTyre& tyre) {
  const ShellNodes& nodes = tyre.nodes();
  Vector3 linear = rim.inertia.mass * tyre.velocity() + nodes.v * nodes.mass;
  double angular = tyre.centre().cross(rim.inertia.mass * tyre.velocity()).y() +
                   rim.inertia.axial * tyre.angular_velocity().y();
  for (Eigen::Index n = 0; n < nodes.count(); ++n)
    angular += nodes.mass[n] * Vector3(nodes.x.col(n)).cross(Vector3(nodes.v.col(n))).y() +
               nodes.inertia[n] * nodes.w(1, n);
  return {linear, angular};
}

/// Inflated, thrown and spinning at ten turns a second, without damping.
TEST(BrickTyre, FreeFlightKeepsMomentumAndEnergy) {
  BrickTyreSettings settings = coarse();
  settings.damping_rate = 0.0;
  BrickTyre tyre(tyre_file("smooth"), settings, rim);
  tyre.settle(nullptr);
  for (const auto coordinate : {Coordinate::x, Coordinate::y, Coordinate::z, Coordinate::spin})
    tyre.release(coordinate);
  tyre.set_velocity({1.0, 0.0, 2.0}, {2.0 * pi * 10.0, 0.0, 0.0});
  const double dt = 0.9 * tyre.stable_time_step();
  const double start = tyre.energy_budget().residual();
  const auto [p0, L0] = momenta(tyre);
  double worst = 0.0;
  const long steps = std::lround(0.1 / dt);
  for (long i = 0; i < steps; ++i) {
    tyre.advance(dt);
    worst = std::max(worst, std::abs(tyre.energy_budget().residual() - start));
  }
  const auto [p1, L1] = momenta(tyre);
  EXPECT_LT((p1 - p0).norm(), 1e-9 * p0.norm());
  EXPECT_NEAR(L1 / L0, 1.0, 1e-5);
  EXPECT_LT(worst, 1e-3 * tyre.energy_budget().kinetic_energy);
}

TEST(BrickTyre, HalfAndWholeModelCarryTheLoadOnAPlane) {
  std::vector<double> deflections;
  for (const bool half : {true, false}) {
    BrickTyre tyre(tyre_file("smooth"), coarse(half, 24), rim);
    tyre.settle(nullptr);
    RigidPlaneParameters road;
    road.height = tyre.lowest_tread_height();
    RigidPlane plane(road, tyre.surface());
    tyre.release(Coordinate::z);
    tyre.set_load({0.0, 0.0, -5000.0});
    EXPECT_TRUE(tyre.settle(&plane).converged);
    const double copies = half ? 2.0 : 1.0;
    EXPECT_NEAR(copies * plane.total_force().z() / 5000.0, 1.0, 2e-3);
    deflections.push_back(0.4 - tyre.centre().z());
    const ContactPatch patch = contact_patch(tyre, plane);
    EXPECT_NEAR(patch.force, 5000.0, 10.0);
    EXPECT_GT(patch.perimeter_area, 0.01);
    EXPECT_GT(tyre.minimum_volume_ratio(), 0.5);
    EXPECT_GT(tyre.section_width(), 0.22);
  }
  EXPECT_NEAR(deflections[0] / deflections[1], 1.0, 5e-3);
}

/// [m^2] of the undeformed tread, as made, that a plane cuts off: of what reaches below it the
/// chords, voids left out.
double area_cut_off(const BrickTyreParameters& tyre, double depth) {
  const SectionCurve curve(tyre.carcass.axial, tyre.carcass.radius);
  const auto outside = [&](double s) -> Vector2 {
    return curve.point(s) + tyre.tread.thickness_at(s) * curve.normal(s);
  };
  const double level = tyre.radius() - depth;
  const double ds = 1e-4;
  double area = 0.0;
  for (double s = 0.5 * ds; s < tyre.tread.end(); s += ds) {
    const auto inside = [&](const TreadVoid& cut) { return s > cut.from && s < cut.to; };
    const double radius = outside(s)[1];
    if (radius < level || std::any_of(tyre.tread.voids.begin(), tyre.tread.voids.end(), inside))
      continue;
    const double across = outside(s + 0.5 * ds)[0] - outside(s - 0.5 * ds)[0];
    area += 2.0 * across * 2.0 * std::sqrt(radius * radius - level * level);
  }
  return area;
}

TEST(BrickTyre, NodalContactAreaExcludesVoidsAndWalls) {
  std::vector<double> areas;
  for (const char* name : {"smooth", "ribbed"}) {
    const BrickTyreParameters parameters = tyre_file(name);
    BrickTyre tyre(parameters, coarse(true, 400), rim);
    RigidPlaneParameters road;
    const double depth = 4e-3;  // [m] less than the grooves
    road.height = tyre.centre().z() - parameters.radius() + depth;
    RigidPlane plane(road, tyre.surface());
    plane.press_on(tyre.surface());
    areas.push_back(contact_patch(tyre, plane).nodal_area);
    EXPECT_NEAR(areas.back() / area_cut_off(parameters, depth), 1.0, 0.06) << name;
    const PrintStress print = print_stress(tyre.surface(), plane);
    EXPECT_NEAR(print.pressure.dot(print.area) / plane.total_force().z(), 1.0, 1e-12) << name;
    EXPECT_NEAR(2.0 * print.area.sum() / areas.back(), 1.0, 1e-12) << name;
  }
  EXPECT_LT(areas[1], 0.7 * areas[0]);
}

/// A rigid print: nodes pressed through the plane, the tyre as made. It ends on the crown.
TEST(BrickTyre, OutlineOfAPrintConvergesAtSecondOrder) {
  const BrickTyreParameters parameters = tyre_file("smooth");
  const auto error = [&](double depth, int sections) {
    BrickTyre tyre(parameters, coarse(true, sections), rim);
    RigidPlaneParameters road;
    road.height = tyre.centre().z() - parameters.radius() + depth;
    RigidPlane plane(road, tyre.surface());
    plane.press_on(tyre.surface());
    const double exact = area_cut_off(parameters, depth);
    return std::abs(contact_patch(tyre, plane).perimeter_area / exact - 1.0);
  };
  for (const double depth : {1e-3, 1.5e-3}) {
    EXPECT_LT(error(depth, 400), 0.015) << depth;
    EXPECT_LT(error(depth, 400), 0.1 * error(depth, 100)) << depth;
  }
  EXPECT_LT(error(6e-3, 400), 0.01);  // ends with the tread
}

TEST(BrickTyre, RestartContinuesBitwise) {
  const auto make = [] { return BrickTyre(tyre_file("ribbed"), coarse(true), rim); };
  const auto roll = [](BrickTyre& tyre, int steps) {
    for (int i = 0; i < steps; ++i) tyre.advance(1e-6);
  };
  BrickTyre tyre = make();
  tyre.release(Coordinate::spin);
  tyre.set_velocity({0.0, 0.0, 0.0}, {20.0, 0.0, 0.0});
  roll(tyre, 50);
  BrickTyre other = make();
  test::hand_over(tyre, other);
  EXPECT_EQ(tyre.stable_time_step(), other.stable_time_step());
  roll(tyre, 50);
  roll(other, 50);
  EXPECT_EQ(tyre.nodes().x, other.nodes().x);
  EXPECT_EQ(tyre.energy_budget().residual(), other.energy_budget().residual());
  EXPECT_GT(tyre.position(Coordinate::spin), 0.0);
}

TEST(BrickTyre, ImpossibleTyresAreRefused) {
  BrickTyreSettings settings = coarse(true);
  settings.sections = 6;
  EXPECT_THAT(error_of([&] { BrickTyre(tyre_file("smooth"), settings, rim); }),
              HasSubstr("tyre, sections is 6; allowed: an integer in [12, 1000]"));
  HubParameters light = rim;
  light.inertia = {0.1, 0.003, 0.002};
  EXPECT_THAT(error_of([&] { BrickTyre(tyre_file("smooth"), coarse(true), light); }),
              HasSubstr("tyre, mass of the rim is 0.1 kg"));
}

}  // namespace
}  // namespace furrow::brick_tyre_test
