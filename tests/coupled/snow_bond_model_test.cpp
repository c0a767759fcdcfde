// SPDX-License-Identifier: GPL-2.0-or-later
// The contact model snow/bond in LIGGGHTS against the law driven alone, and its conservation laws.

#include "furrow/grains/snow_bond.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atom.h"
#include "tests/coupled/support/scene.h"
#include "tests/coupled/support/snow.h"

namespace furrow::test::snow_bond_model_test {
namespace {

constexpr double dt = 1e-5, density = 340.0;

void snow_box(Scene& scene, const SnowBondParameters& law) {
  scene.granular_box(Vector3::Constant(-0.1), Vector3::Constant(0.1), 0.004);
  snow_contacts(scene, law);
  scene.command(fmt::format("timestep {}", dt));
}

void add_grain(Scene& scene, const Vector3& x) {
  scene.command(
      fmt::format("create_atoms 1 single {:.17g} {:.17g} {:.17g} units box", x[0], x[1], x[2]));
}

/// A sphere that moves as fix nve/sphere moves it.
struct Sphere {
  Vector3 x, v, omega;
  double radius;
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();

  double mass() const { return density * 4.0 / 3.0 * pi * radius * radius * radius; }
  void kick() {
    v += 0.5 * dt / mass() * force;
    omega += 0.5 * dt / (0.4 * mass() * radius * radius) * torque;
  }
};

struct Pair {
  SnowBondParameters law;
  Sphere i, j;
  SnowBondState state;

  SnowContact contact() const {
    const Vector3 arm = i.x - j.x;
    const double r = arm.norm(), overlap = i.radius + j.radius - r;
    const Vector3 n = arm / r, v = i.v - j.v;
    const Vector3 turning =
        (i.radius - 0.5 * overlap) * i.omega + (j.radius - 0.5 * overlap) * j.omega;
    return {i.radius + j.radius,
            i.mass() * j.mass() / (i.mass() + j.mass()),
            overlap,
            n,
            v.dot(n),
            v - v.dot(n) * n + n.cross(turning),
            i.omega - j.omega,
            0.5 * (i.omega + j.omega).dot(n),
            dt};
  }
  void set_forces(const SnowBondResponse& response) {
    const SnowContact c = contact();
    const Vector3 couple = c.normal.cross(response.force);
    i.force = response.force;
    j.force = -response.force;
    i.torque = response.moment - (i.radius - 0.5 * c.overlap) * couple;
    j.torque = -response.moment - (j.radius - 0.5 * c.overlap) * couple;
  }
  void begin_run() { set_forces(SnowBond::hold(law, contact(), state)); }
  void step(bool sinters = false) {
    for (Sphere* s : {&i, &j}) {
      s->kick();
      s->x += dt * s->v;
    }
    set_forces(sinters ? SnowBond::sinter(law, contact(), state)
                       : SnowBond::advance(law, contact(), state));
    for (Sphere* s : {&i, &j}) s->kick();
  }
};

/// Position, velocity and angular velocity of the grain with this tag, on all ranks.
std::array<Vector3, 3> motion_of(Scene& scene, int tag) {
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  double values[9] = {};
  for (int i = 0; i < atom.nlocal; ++i)
    if (atom.tag[i] == tag)
      for (int c = 0; c < 3; ++c) {
        values[c] = atom.x[i][c];
        values[3 + c] = atom.v[i][c];
        values[6 + c] = atom.omega[i][c];
      }
  for (double& value : values) value = scene.sum(value);
  return {Vector3(values), Vector3(values + 3), Vector3(values + 6)};
}

void expect_motion(Scene& scene, int tag, const Sphere& expected) {
  const auto [x, v, omega] = motion_of(scene, tag);
  EXPECT_LT((x - expected.x).norm(), 1e-12) << tag;
  EXPECT_LT((v - expected.v).norm(), 1e-9 * expected.v.norm() + 1e-12) << tag;
  EXPECT_LT((omega - expected.omega).norm(), 1e-9 * expected.omega.norm() + 1e-9) << tag;
}

void set_motion(Scene& scene, int tag, const Sphere& sphere) {
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  for (int i = 0; i < atom.nlocal; ++i)
    if (atom.tag[i] == tag)
      for (int c = 0; c < 3; ++c) {
        atom.v[i][c] = sphere.v[c];
        atom.omega[i][c] = sphere.omega[c];
      }
}

/// Two unlike clusters are sintered, pressed together obliquely while they turn, and torn apart;
/// the pair lies across the border of two ranks.
TEST(SnowBondModel, PairMovesAsThePointLaw) {
  Pair pair;
  pair.i = {{0.0101, 0.001, 0.0}, {-1.0, 0.4, 0.1}, {20.0, -30.0, 15.0}, 0.0115};
  pair.j = {{-0.0085, 0.0, 0.0005}, {0.6, 0.0, 0.0}, {5.0, 10.0, -12.0}, 0.0085};
  Scene scene;
  snow_box(scene, pair.law);
  for (const Sphere& s : {pair.i, pair.j}) add_grain(scene, s.x);
  scene.commands(
      "set atom 1 diameter 0.023 density 340\nset atom 2 diameter 0.017 density 340\n"
      "fix move all nve/sphere\nthermo 100000");
  const auto both = [&](auto&& action) {
    action(1, pair.i);
    action(2, pair.j);
  };
  both([&](int tag, const Sphere& s) { set_motion(scene, tag, s); });
  sinter(scene);
  pair.step(true);
  both([&](int tag, const Sphere& s) { expect_motion(scene, tag, s); });
  scene.command("run 500");
  pair.begin_run();
  for (int n = 0; n < 500; ++n) pair.step();
  EXPECT_GT(pair.state.plastic, 1.2 * pair.state.at_sintering);
  both([&](int tag, const Sphere& s) { expect_motion(scene, tag, s); });
  pair.i.v = {0.3, -0.3, 0.0};
  pair.j.v.setZero();
  both([&](int tag, const Sphere& s) { set_motion(scene, tag, s); });
  scene.command("run 500");
  pair.begin_run();
  for (int n = 0; n < 500; ++n) pair.step();
  EXPECT_FALSE(pair.state.bonded);
  both([&](int tag, const Sphere& s) { expect_motion(scene, tag, s); });
}

/// A grain that is thrown at a floor, and its mirror image: half a contact.
TEST(SnowBondModel, WallContactIsHalfOfAMirroredPair) {
  for (const bool mesh : {false, true}) {
    Pair pair;
    pair.i = {{0.013, 0.011, 0.0105}, {0.1, 0.05, -0.4}, {10.0, -20.0, 8.0}, 0.01};
    Scene scene;
    snow_box(scene, pair.law);
    add_grain(scene, pair.i.x);
    scene.commands(
        "set group all diameter 0.02 density 340\nfix move all nve/sphere\nthermo 100000");
    if (mesh) {
      scene.add_body("sheet", std::make_unique<PrescribedBody>(make_sheet(8, 0.16, 0.0),
                                                               [](double, Surface&) {}));
      scene.wall_of_body("sheet", snow_model, "floor");
    } else {
      scene.command(
          fmt::format("fix floor all wall/gran {} primitive type 2 zplane 0", snow_model));
    }
    set_motion(scene, 1, pair.i);
    scene.command("run 1500");
    Sphere& grain = pair.i;
    for (int n = 0; n < 1500; ++n) {
      grain.kick();
      grain.x += dt * grain.v;
      grain.force.setZero();
      grain.torque.setZero();
      if (const double overlap = grain.radius - grain.x[2]; overlap > 0.0) {
        const Vector3 up = Vector3::UnitZ();
        const Vector3 rolling = up.cross((grain.radius - 0.5 * overlap) * grain.omega);
        const SnowContact c = {2.0 * grain.radius,
                               0.5 * grain.mass(),
                               2.0 * overlap,
                               up,
                               2.0 * grain.v[2],
                               2.0 * (Vector3(grain.v[0], grain.v[1], 0.0) + rolling),
                               2.0 * grain.omega,
                               0.5 * grain.omega[2],
                               dt,
                               false};
        const SnowBondResponse response = SnowBond::advance(pair.law, c, pair.state);
        grain.force = response.force;
        grain.torque = response.moment - (grain.radius - 0.5 * overlap) * up.cross(response.force);
      } else {
        SnowBond::part(pair.law, 2.0 * grain.radius, pair.state);
      }
      grain.kick();
    }
    EXPECT_GT(grain.v[2], 0.0);
    EXPECT_LT(grain.v[2], 0.1);  // crushed
    expect_motion(scene, 1, grain);
  }
}

/// Momentum of a lump of clusters, and its moment [SI].
struct Sums {
  Vector3 momentum = Vector3::Zero(), moment = Vector3::Zero();  // about the origin
  double scale = 0.0, moment_scale = 0.0;

  explicit Sums(Scene& scene) {
    const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
    for (int i = 0; i < atom.nlocal; ++i) {
      const double m = atom.rmass[i];
      const Vector3 x(atom.x[i]), v(atom.v[i]), omega(atom.omega[i]);
      momentum += m * v;
      moment += m * x.cross(v) + 0.4 * m * atom.radius[i] * atom.radius[i] * omega;
      scale += m * v.norm();
      moment_scale += m * x.norm() * v.norm();
    }
    for (int c = 0; c < 3; ++c) {
      momentum[c] = scene.sum(momentum[c]);
      moment[c] = scene.sum(moment[c]);
    }
    scale = scene.sum(scale);
    moment_scale = scene.sum(moment_scale);
  }
};

/// Two sintered lumps of 64 clusters.
void two_lumps(Scene& scene) {
  for (const double x : {-0.05, 0.03})
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k)
          add_grain(scene, Vector3(x, 0.1 * x - 0.02, -0.02) + 0.0099 * Vector3(i, j, k) +
                               1e-4 * Vector3(std::sin(i + 2.0 * k), std::cos(3.0 * j),
                                              std::sin(5.0 * k)));
  scene.commands(
      "set group all diameter 0.0101 density 340\nfix move all nve/sphere\nthermo 100000\n"
      "fix energy all snow/energy\ntimestep 4e-6");
  sinter(scene);
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  for (int i = 0; i < atom.nlocal; ++i) atom.v[i][0] = atom.x[i][0] < -0.005 ? 3.0 : -3.0;
}

/// Nothing acts on the lumps from outside while they collide and break up.
TEST(SnowBondModel, CollidingLumpsKeepLinearAndAngularMomentum) {
  Scene scene;
  snow_box(scene, {});
  two_lumps(scene);
  const Sums before(scene);
  scene.command("run 5000");
  const Sums after(scene);
  EXPECT_LT((after.momentum - before.momentum).norm() / before.scale, 1e-13);
  EXPECT_LT((after.moment - before.moment).norm() / before.moment_scale, 1e-12);
  EXPECT_GT(snow_energy(scene, 7), 50.0);  // bonds broken
}

TEST(SnowBondModel, CollidingLumpsHaveAClosedEnergyBalance) {
  Scene scene;
  snow_box(scene, {});
  two_lumps(scene);
  const double bonds = snow_energy(scene, 5);
  EXPECT_EQ(bonds, snow_energy(scene, 6));  // made by sintering
  const double kinetic = scene.grain_kinetic_energy(), released = snow_energy(scene, 4);
  scene.command("run 5000");
  const double left = scene.grain_kinetic_energy(), stored = snow_energy(scene, 1),
               crushed = snow_energy(scene, 2), damped = snow_energy(scene, 3),
               lost = snow_energy(scene, 4) - released;
  EXPECT_LT(left, 0.5 * kinetic);
  EXPECT_GT(crushed, 0.3 * kinetic);
  EXPECT_NEAR((left + stored + crushed + damped + lost) / kinetic, 1.0, 0.03);
  EXPECT_NEAR(snow_energy(scene, 5), snow_energy(scene, 6) - snow_energy(scene, 7), 1e-9);
}

}  // namespace
}  // namespace furrow::test::snow_bond_model_test
