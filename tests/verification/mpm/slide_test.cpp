// SPDX-License-Identifier: GPL-2.0-or-later
// Ground that slides on itself: Coulomb's law on an incline, two columns without friction, ground
// of one piece with much of it, momentum and energy.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/max_error.h"

namespace furrow::slide_test {
namespace {

using namespace testing_terrain;

constexpr double cell = 0.025;

/// An elastic block of 0.2 x 0.1 x 0.1 m on ground, both of one terrain that is cut between them.
/// The plane has a slope in the grid, and gravity one against the vertical of the grid.
struct Incline {
  Incline(double plane_slope, double gravity_slope, double friction, int remap_interval = 16,
          double residual_share = TransferScheme().residual_share)
      : along(std::cos(plane_slope), 0, std::sin(plane_slope)),
        slope(plane_slope + gravity_slope),
        ground(block(plane_slope, gravity_slope, friction, remap_interval, residual_share),
               Communicator()) {
    const Vector3 across(-along.z(), 0, along.x());
    carve(ground, [&](const Vector3& x) {
      return x.dot(across) < 0.0 || (std::abs(x.dot(along) - 0.2) < 0.1 && x.dot(across) < 0.1);
    });
    start = block_centre();
  }
  static TerrainParameters block(double plane_slope, double gravity_slope, double friction,
                                 int remap_interval, double residual_share) {
    const double drop = cell * std::ceil(0.4 * std::tan(plane_slope) / cell);
    TerrainParameters p = box(material_of(elastic(1e6, 0.2, 1000)), {-0.4, 0, -drop - 2 * cell},
                              {0.4, 0.1, drop + 0.1}, cell);
    set_boundary(p, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
    p.gravity = standard_gravity * Vector3(-std::sin(gravity_slope), 0, -std::cos(gravity_slope));
    p.initial_stress = plane_slope == 0.0;  // the block's own weight, as it stands on the ground
    p.remap_interval = remap_interval;
    p.scheme.residual_share = residual_share;
    p.slide = SlideSurface{
        SlidePlane{Vector3::Zero(), {-std::sin(plane_slope), 0, std::cos(plane_slope)}}, friction};
    return p;
  }
  Vector3 block_centre() {
    Vector3 sum = Vector3::Zero();
    mass = 0.0;
    for (ParticleGroup& group : ground.groups())
      for (std::size_t p = 0; group.field == 1 && p < group.particles.size(); ++p) {
        mass += group.mass(p);
        sum += group.mass(p) * group.particles.position(p);
      }
    return sum / mass;
  }
  void run(double duration) {
    while (time < duration) {
      const double dt = ground.stable_time_step();
      ground.advance(dt);
      time += dt;
    }
  }
  double moved() { return -(block_centre() - start).dot(along); }  ///< down the plane [m]

  Vector3 along;
  double slope;
  ContinuumTerrain ground;
  Vector3 start;
  double time = 0.0, mass = 0.0;
};

struct Slopes {
  const char* name;
  double plane, gravity;  // tangents
};

class Planes : public ::testing::TestWithParam<Slopes> {};
INSTANTIATE_TEST_SUITE_P(Slide, Planes,
                         ::testing::Values(Slopes{"along_the_cells", 0.0, 0.6},
                                           Slopes{"across_the_cells", 0.6, 0.0}),
                         [](const auto& one) { return one.param.name; });

/// a = g (sin(slope) - mu cos(slope)), and friction takes mu m g cos(slope) over the distance.
TEST_P(Planes, BlockSlidesByCoulombFriction) {
  for (const double mu : {0.0, 0.3}) {
    Incline incline(std::atan(GetParam().plane), std::atan(GetParam().gravity), mu);
    incline.run(mu > 0.0 ? 0.4 : 0.2);
    const double normal = standard_gravity * std::cos(incline.slope),
                 a = standard_gravity * std::sin(incline.slope) - mu * normal,
                 distance = incline.moved(), closed = 0.5 * a * incline.time * incline.time,
                 loss = mu * incline.mass * normal * distance;
    const EnergyBudget budget = incline.ground.energy_budget();
    RecordProperty(fmt::format("mu_{:.0f}_percent", 100 * mu),
                   fmt::format("distance {:.4f} of the closed form, slide loss {:.4g} J of {:.4g}, "
                               "numerical loss {:.2g}, residual {:.1g}, of {:.3g} J",
                               distance / closed, incline.ground.slide_loss(), loss,
                               budget.numerical_loss, budget.residual(), budget.load_work));
    EXPECT_NEAR(distance / closed, 1.0, 0.02) << "mu " << mu;
    EXPECT_NEAR(incline.ground.slide_loss(), loss, 0.03 * loss) << "mu " << mu;
    EXPECT_LT(std::abs(budget.residual()), 5e-3 * budget.load_work) << "mu " << mu;
    EXPECT_GE(budget.numerical_loss, 0.0);
    EXPECT_LT(budget.numerical_loss, 0.05 * budget.load_work) << "mu " << mu;
  }
}

/// Below the angle of friction it stays, once the first bounce is over, but for what shaking lets
/// it creep; a plain affine transfer in every step damps that.
TEST_P(Planes, BlockSticksBelowTheAngleOfFriction) {
  Incline incline(std::atan(GetParam().plane), std::atan(GetParam().gravity), 0.8, 1, 0.0);
  const double duration = 0.4,
               free = 0.5 * standard_gravity * std::sin(incline.slope) * duration * duration;
  incline.run(0.5 * duration);
  const double at_half = incline.moved();
  incline.run(duration);
  RecordProperty("crept_over_free_fall", fmt::format("{:.2e}", (incline.moved() - at_half) / free));
  EXPECT_LT(std::abs(incline.moved() - at_half), 0.02 * free);
}

/// The upper particles of the part x < 0 are pressed down.
void press(ContinuumTerrain& ground, double top, double force) {
  const Particles& particles = ground.groups()[0].particles;
  for (std::size_t p = 0; p < particles.size(); ++p)
    if (particles.data(column::initial_z)[p] > top - 0.5 * cell)
      ground.add_point_force({0, p}, {0, 0, -force}, particles.position(p));
}

/// Without friction, and without sideways strain for want of Poisson's ratio, the loaded half moves
/// as a separate column between smooth walls, and the other half not at all.
TEST(SlideSurface, ColumnsWithoutFrictionMoveIndependently) {
  const auto column_to = [](double upper) {
    const double top = 8 * cell;
    TerrainParameters p =
        box(material_of(elastic(1e6, 0.0, 1000)), {-4 * cell, 0, 0}, {upper, 2 * cell, top}, cell);
    set_boundary(p, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
    p.z = even(0, top + 4 * cell, cell);
    p.scheme.cell_average = false;  // means of cells would strain the columns sideways
    if (upper > 0.0) p.slide = SlideSurface{SlidePlane{Vector3::Zero(), Vector3::UnitX()}, 0.0};
    return p;
  };
  ContinuumTerrain both(column_to(4 * cell), Communicator()), alone(column_to(0.0), Communicator());
  for (int n = 0; n < 150; ++n) {
    press(both, 8 * cell, 1e-3);
    press(alone, 8 * cell, 1e-3);
    both.advance(1e-4);
    alone.advance(1e-4);
  }
  const auto sunk = [](ContinuumTerrain& ground, std::size_t group, std::vector<double>& of_level) {
    const Particles& particles = ground.groups()[group].particles;
    test::MaxError largest;
    of_level.assign(16, 0.0);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double z = particles.data(column::initial_z)[p], u = particles.position(p).z() - z;
      of_level[static_cast<std::size_t>(2 * z / cell)] = u;
      largest.add(u);
    }
    return largest.max();
  };
  std::vector<double> loaded, reference, idle;
  const double most = sunk(alone, 0, reference);
  sunk(both, 0, loaded);
  EXPECT_GT(most, 1e-7);
  for (std::size_t level = 0; level < 16; ++level)
    EXPECT_NEAR(loaded[level], reference[level], 1e-9 * most) << "level " << level;
  EXPECT_LT(sunk(both, 1, idle), 1e-9 * most);
}

/// Positions and velocities by number.
std::vector<double> motions_of(ContinuumTerrain& ground) {
  std::vector<double> motions;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const auto first = 6 * static_cast<std::size_t>(particles.data(column::id)[p]);
    if (motions.size() < first + 6) motions.resize(first + 6, 0.0);
    const Vector3 x = particles.position(p), v = particles.velocity(p);
    std::copy_n(x.data(), 3, motions.data() + first);
    std::copy_n(v.data(), 3, motions.data() + first + 3);
  });
  return motions;
}

/// Ground under pressure in a closed box, shaken: with friction that holds it, any surface gives
/// the numbers of ground of one piece; and a checkpoint on the way changes nothing.
TEST(SlideSurface, HighFrictionEqualsUndividedGround) {
  const auto shaken = [](std::optional<SlideSurface> slide, bool restarted) {
    TerrainParameters p =
        box(material_of(elastic(1e6, 0.2, 1000)), {-0.1, -0.1, 0}, {0.1, 0.1, 0.1}, cell);
    p.boundary.fill(BoundaryKind::smooth);
    p.scheme = {false, 0.0};  // each side would have its own means and residual motion
    p.slide = slide;
    auto ground = std::make_unique<ContinuumTerrain>(p, Communicator());
    for_particles(*ground, [](Particles& particles, std::size_t i) {
      const Vector3 x = particles.position(i);
      VectorX state = particles.state(i);
      state.head<3>().setConstant(-1e4);
      particles.set_state(i, state);
      const double s =
          0.02 * std::sin(20 * x.x() + 1) * std::cos(13 * x.y()) * std::sin(30 * x.z());
      Eigen::Map<Vector3>(particles.data(column::velocity) + 4 * i) = s * Vector3(1, -2, 0.5);
    });
    for (int n = 0; n < 120; ++n) {
      ground->advance(2e-4);
      if (!restarted || n != 50) continue;
      auto again = std::make_unique<ContinuumTerrain>(p, Communicator());
      test::hand_over(*ground, *again);
      ground = std::move(again);
    }
    return motions_of(*ground);
  };
  const std::vector<double> whole = shaken({}, false);
  for (const SlideSurface& slide :
       {SlideSurface{SlidePlane{{0.01, 0, 0}, Vector3(3, 1, 2).normalized()}, 1e6},
        SlideSurface{SlideCylinder{0.01, 0.0, 0.06}, 1e6},
        SlideSurface{SlideBox{0.0, 0.01, 0.12, 0.1}, 1e6}}) {
    const std::vector<double> cut = shaken(slide, false);
    ASSERT_EQ(cut.size(), whole.size());
    test::MaxError difference;
    for (std::size_t n = 0; n < cut.size(); ++n) difference.add(cut[n] - whole[n]);
    EXPECT_LT(difference.max(), 1e-12);  // of 0.02 m/s and 0.1 m
    EXPECT_EQ(shaken(slide, true), cut);
  }
}

/// The two parts of a free body hit and rub each other. Angular momentum: to rounding with a remap
/// in each step, else to second order (terrain_step.h).
TEST(SlideSurface, MomentumAndEnergyBalance) {
  for (const int remap_interval : {1, TerrainParameters().remap_interval}) {
    TerrainParameters p =
        box(material_of(elastic(1e6, 0.2, 500)), {-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}, 2 * cell);
    p.remap_interval = remap_interval;
    const Vector3 normal = Vector3(1, 2, 3).normalized();
    p.slide = SlideSurface{SlidePlane{Vector3::Zero(), normal}, 0.4};
    ContinuumTerrain ground(p, Communicator());
    carve(ground, [](const Vector3& x) { return x.norm() < 0.15; });
    set_motion(ground, {0.3, 0.2, 0.0}, spin({1.0, 2.0, -3.0}));
    for (ParticleGroup& group : ground.groups())
      for (std::size_t i = 0; group.field == 1 && i < group.particles.size(); ++i)
        Eigen::Map<Vector3>(group.particles.data(column::velocity) + 4 * i) +=
            Vector3(1, -1, 0) - 0.5 * normal;
    const Sums before = sums_of(ground);
    for (int n = 0; n < 200; ++n) ground.advance(0.5 * ground.stable_time_step());
    const Sums after = sums_of(ground);
    const EnergyBudget budget = ground.energy_budget();
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13 * before.momentum.norm());
    EXPECT_LT((after.angular - before.angular).norm(),
              (remap_interval == 1 ? 1e-12 : 2e-3) * before.angular.norm());
    // The budget does not know the kinetic energy of the start.
    const double lost = budget.numerical_loss + before.kinetic;
    RecordProperty(fmt::format("remap_interval_{}", remap_interval),
                   fmt::format("kinetic {:.3g} to {:.3g}, slide loss {:.3g}, numerical {:.3g} J",
                               before.kinetic, budget.kinetic_energy, ground.slide_loss(), lost));
    EXPECT_GT(ground.slide_loss(), 0.05 * before.kinetic);
    EXPECT_LT(std::abs(budget.residual()), 5e-3 * before.kinetic);
    EXPECT_GT(lost, -1e-3 * before.kinetic);
    EXPECT_LT(lost, (remap_interval == 1 ? 0.3 : 0.15) * before.kinetic);
  }
}

}  // namespace
}  // namespace furrow::slide_test
