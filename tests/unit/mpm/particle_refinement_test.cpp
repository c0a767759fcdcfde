// SPDX-License-Identifier: GPL-2.0-or-later
// Ground that follows a body on a graded axis: particles are halved ahead and united behind.
#include "furrow/mpm/particles/particle_refinement.h"

#include <random>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"
#include "tests/support/checkpoints.h"
#include "tests/support/error_of.h"

namespace furrow::particle_refinement_test {
namespace {

using ::testing::HasSubstr;
using namespace testing_terrain;

constexpr double cell = 0.025, depth = 0.1;

/// 1.6 m of ground with 0.2 m of fine cells, in strides of four.
TerrainParameters following_ground(const std::string& material = snow()) {
  TerrainParameters ground = box(material_of(material), {-0.8, -0.1, 0}, {0.8, 0.1, depth}, cell);
  const FollowingAxis axis = following_axis({-0.8, 0.8, cell, -0.1, 0.1, 1.3}, "ground");
  ground.x = axis.layout;
  ground.halvings = axis.halvings;
  ground.z = even(0, depth + 2 * cell, cell);
  ground.gravity = {0, 0, -standard_gravity};
  ground.initial_stress = ground.window = true;
  set_boundary(ground, {"smooth", "smooth", "smooth", "smooth", "rough", "free"});
  return ground;
}

std::string clay() {
  return "undrained_clay density 1800 su 2e4 sensitivity 3 slip_95 0.03 elasticity linear E 2e6 nu "
         "0.45";
}

TEST(FollowingAxis, AxisHasWholeStridesAndTheFineStretch) {
  for (const double growth : {1.1, 1.2, 1.4})
    for (const double fine : {0.2, 0.43, 0.8}) {
      const FollowingAxis axis =
          following_axis({-1.5, 2.5, cell, 0.5 - fine / 2, 0.5 + fine / 2, growth}, "ground");
      SCOPED_TRACE(::testing::Message() << growth << " " << fine << " " << axis.halvings);
      ASSERT_GE(axis.halvings, 1);
      const double stride = std::ldexp(cell, axis.halvings);
      const Axis x(axis.layout, "ground");
      EXPECT_NEAR(x.fine_cell(), cell, 1e-12);
      const double strides = (x.upper() - x.lower()) / stride;
      EXPECT_NEAR(strides, std::round(strides), 1e-9);
      EXPECT_NEAR(x.upper() - x.lower(), 4.0, 0.5 * stride + 1e-9);
      EXPECT_NEAR(0.5 * (x.lower() + x.upper()), 0.5, 1e-12);
      EXPECT_LE(stride, x.length(0) + 1e-12);
      // wherever the window is, within half a stride of what it follows
      for (int c = 0; c < x.cells(); ++c)
        if (x.knot(c) > 0.5 - 0.5 * (fine + stride) - 1e-9 &&
            x.knot(c + 1) < 0.5 + 0.5 * (fine + stride) + 1e-9) {
          EXPECT_NEAR(x.length(c), cell, 1e-12);
        }
      EXPECT_GE(axis.layout.fine_upper - axis.layout.fine_lower, fine + stride - 1e-12);
    }
}

TEST(FollowingAxis, AxisIsUniformWithoutRoomForLongerCells) {
  const FollowingAxis axis = following_axis({0.0, 1.0, cell, 0.05, 0.95, 1.2}, "ground");
  EXPECT_EQ(axis.halvings, 0);
  EXPECT_TRUE(Axis(axis.layout, "ground").uniform());
  // room for cells of 3/2, which are shorter than a stride
  EXPECT_EQ(following_axis({0.0, 0.5, cell, 0.2, 0.3, 1.15}, "ground").halvings, 0);
}

/// A particle with a random motion, in a layer at one end, where cells are long.
struct OneParticle {
  explicit OneParticle(const std::string& material)
      : parameters(following_ground(material)),
        grid(make_grid(parameters, "ground")),
        refinement(parameters, grid, "ground") {
    const std::shared_ptr<const Material>& law = parameters.layers[0].material;
    groups.push_back({law, Particles(*law)});
    Particles& p = particles();
    p.append(1);
    for (std::size_t c = 0; c < column::state; ++c) p.data(c)[0] = random();
    for (int c = 0; c < 4; ++c) p.data(column::velocity)[c] = random();
    for (int c = 0; c < 12; ++c) p.data(column::affine)[c] = random();
    VectorX state = law->initial_state();
    for (Eigen::Index f = 0; f < 6; ++f) state[f] = -1e3 * random();
    state[field::volume_ratio] = 0.8;
    state[field::stored_energy] = 30.0;
    state[field::dissipated_energy] = 70.0;
    p.set_state(0, state);
    p.data(column::id)[0] = 8.0 * parts();
    p.data(column::half_x)[0] = 0.25 * parts() * cell;
    p.data(column::half_y)[0] = p.data(column::half_z)[0] = 0.25 * cell;
    place(0.0);
  }
  double random() { return std::uniform_real_distribution<double>(0.5, 1.0)(generator); }
  double parts() const { return std::ldexp(1.0, parameters.halvings); }
  Particles& particles() { return groups[0].particles; }
  /// Moves all particles so that the first is at x.
  void place(double x) {
    double* values = particles().data(column::x);
    const double move = x - values[0];
    for (std::size_t p = 0; p < particles().size(); ++p) values[p] += move;
  }
  void refine() { refinement.refine(groups); }
  /// Mass, momentum, moment of momentum about the origin, energies of the state.
  std::vector<double> sums() {
    std::vector<double> sums(9, 0.0);
    for (std::size_t p = 0; p < particles().size(); ++p) {
      const double m = groups[0].mass(p);
      const Vector3 x = particles().position(p), v = particles().velocity(p);
      const Vector3 moment = x.cross(v);
      sums[0] += m;
      for (int a = 0; a < 3; ++a) {
        sums[1 + static_cast<std::size_t>(a)] += m * v[a];
        sums[4 + static_cast<std::size_t>(a)] += m * moment[a];
      }
      sums[7] += sum_of(p, field::stored_energy);
      sums[8] += sum_of(p, field::dissipated_energy);
    }
    return sums;
  }
  double sum_of(std::size_t p, std::size_t state_field) {
    return particles().data(column::volume)[p] * particles().data(column::state + state_field)[p];
  }

  std::mt19937 generator{3};
  TerrainParameters parameters;
  Grid grid;
  std::vector<ParticleGroup> groups;
  ParticleRefinement refinement;
};

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t n = 0; n < a.size(); ++n)
    EXPECT_NEAR(a[n], b[n], 1e-13 * std::abs(b[n])) << "sum " << n;
}

TEST(ParticleRefinement, HalvesKeepMassMotionEnergyAndState) {
  for (const std::string& material : {snow(), clay()}) {
    OneParticle one(material);
    const std::vector<double> before = one.sums();
    const VectorX state = one.particles().state(0);
    const Matrix3 affine = one.particles().affine(0);
    const double half = one.particles().data(column::half_x)[0];
    one.refine();
    ASSERT_EQ(one.particles().size(), 4u);
    expect_same(one.sums(), before);
    const auto width = one.groups[0].material->find_field("band_width");
    std::vector<double> ids, places;
    for (std::size_t p = 0; p < 4; ++p) {
      VectorX expected = state;
      if (width) {
        expected[static_cast<Eigen::Index>(*width)] = cell;
      }
      EXPECT_LT((one.particles().state(p) - expected).norm(), 1e-12 * state.norm());
      EXPECT_EQ(one.particles().affine(p), affine);
      EXPECT_DOUBLE_EQ(one.particles().data(column::half_x)[p], half / 4.0);
      ids.push_back(one.particles().data(column::id)[p]);
      places.push_back(one.particles().data(column::x)[p]);
    }
    std::sort(places.begin(), places.end());
    for (std::size_t n = 0; n < 4; ++n)
      EXPECT_NEAR(places[n], half * (2.0 * static_cast<double>(n) - 3.0) / 4.0, 1e-15);
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(ids, (std::vector<double>{32, 33, 34, 35}));
  }
}

/// Particles in the long cells at the end of the grid; their differences are within what makes them
/// alike.
TEST(ParticleRefinement, UnitedParticlesKeepMassMomentumAndEnergy) {
  OneParticle one(snow());
  one.refine();
  Particles& p = one.particles();
  one.place(one.grid.axis(0).lower() + 0.02);
  for (std::size_t n = 0; n < 4; ++n) {
    for (int c = 0; c < 3; ++c)
      p.data(column::velocity)[4 * n + static_cast<std::size_t>(c)] = one.random();
    p.data(column::state + field::volume_ratio)[n] *= 1.0 + 0.01 * one.random();
    p.data(column::state + field::stress)[n] *= 1.0 + 0.02 * one.random();
    p.data(column::state + field::stored_energy)[n] *= one.random();
    p.data(column::y)[n] += 0.1 * cell * one.random();
  }
  const std::vector<double> before = one.sums();
  const auto volume = [&] {
    double sum = 0.0;
    for (std::size_t n = 0; n < p.size(); ++n) sum += one.sum_of(n, field::volume_ratio);
    return sum;
  };
  const double volume_before = volume();
  one.refine();
  ASSERT_LT(p.size(), 4u);
  const std::vector<double> after = one.sums();
  for (const std::size_t n : {0u, 1u, 2u, 3u, 7u, 8u})
    EXPECT_NEAR(after[n], before[n], 1e-13 * std::abs(before[n])) << "sum " << n;
  EXPECT_NEAR(volume(), volume_before, 1e-13 * volume_before);
  EXPECT_EQ(p.data(column::id)[0], 32.0);
}

TEST(ParticleRefinement, DivisionAndUnionAreInverse) {
  OneParticle one(clay());
  one.refine();
  const std::size_t fine = one.particles().size();
  OneParticle other(clay());
  other.place(one.grid.axis(0).lower() + 0.2);
  one.place(other.particles().data(column::x)[0] - 0.75 * other.particles().half_spacing(0).x());
  one.refine();
  ASSERT_EQ(fine, 4u);
  ASSERT_EQ(one.particles().size(), 1u);
  for (const std::size_t c :
       std::vector<std::size_t>{column::x, column::y, column::half_x, column::volume, column::id,
                                column::initial_x, column::state + field::stored_energy})
    EXPECT_NEAR(one.particles().data(c)[0], other.particles().data(c)[0], 1e-12) << c;
}

/// A change of one of two halves, after which they stay two.
TEST(ParticleRefinement, DifferentParticlesAreNotUnited) {
  const auto count = [](const std::function<void(Particles&)>& change) {
    OneParticle one(snow());
    one.refine();
    one.place(one.grid.axis(0).lower() + 0.02);
    change(one.particles());
    one.refine();
    return one.particles().size();
  };
  const auto scaled = [&](std::size_t column, double factor) {
    return count([&](Particles& p) {
      for (const std::size_t n : {0u, 1u}) p.data(column)[n] *= factor;
    });
  };
  const std::size_t united = count([](Particles&) {});
  EXPECT_LT(united, 4u);
  EXPECT_EQ(scaled(column::state + field::volume_ratio, 1.01), united);
  EXPECT_GT(scaled(column::state + field::volume_ratio, 1.06), united);
  EXPECT_GT(scaled(column::state + field::stress, 2.0), united);
  // a quarter of a strain
  EXPECT_GT(count([](Particles& p) {
              for (const std::size_t n : {0u, 1u})
                p.data(column::state + field::internal)[n] += 0.25;
            }),
            united);
  EXPECT_GT(count([](Particles& p) {
              for (const std::size_t n : {0u, 1u}) p.data(column::z)[n] += 0.6 * 0.5 * cell;
            }),
            united);
}

/// A contact keeps values with the particle: neither halves nor pairs while it needs them.
TEST(ParticleRefinement, ParticlesInContactAreNeitherDividedNorUnited) {
  OneParticle one(snow());
  const ParticleColumn touch =
      one.particles().add_column("touch", 1, [](const double* value) { return *value == 0.0; });
  touch.data()[0] = 1.0;
  one.refine();
  EXPECT_EQ(one.particles().size(), 1u);
  touch.data()[0] = 0.0;
  one.refine();
  EXPECT_EQ(one.particles().size(), 4u);
  one.place(one.grid.axis(0).lower() + 0.02);
  for (std::size_t p = 0; p < 4; ++p) touch.data()[p] = 1.0;
  one.refine();
  EXPECT_EQ(one.particles().size(), 4u);
}

/// Particles end where cells end: a uniform stress is balanced to rounding, wherever the window is.
TEST(GradedWindow, UniformStressStaysAtRest) {
  constexpr double stress = -1e4;
  TerrainParameters parameters = following_ground(elastic(5e6, 0.2, 1500));
  parameters.z = even(0, depth, cell);
  parameters.gravity.setZero();
  parameters.initial_stress = false;
  for (const Face face : all_faces) parameters.boundary[face] = BoundaryKind::smooth;
  ContinuumTerrain ground(parameters, Communicator());
  for (int n = 0; n < 4; ++n) {
    ground.follow(0.6 * n * std::ldexp(cell, parameters.halvings));
    for (int step = 0; step < parameters.remap_interval; ++step) ground.advance(1e-5);
    for_particles(ground, [&](Particles& p, std::size_t i) {
      for (std::size_t a = 0; a < 3; ++a) p.data(column::state + field::stress + a)[i] = stress;
      for (std::size_t a = 0; a < 4; ++a) p.data(column::velocity)[4 * i + a] = 0.0;
      for (std::size_t a = 0; a < 12; ++a) p.data(column::affine)[12 * i + a] = 0.0;
    });
    for (int step = 0; step < parameters.remap_interval; ++step) ground.advance(1e-5);
    double speed = 0.0;
    for_particles(ground, [&](Particles& p, std::size_t i) {
      speed = std::max(speed, p.velocity(i).norm());
    });
    EXPECT_LT(speed, 1e-10 * -stress / (1500.0 * 60.0)) << n;  // of that behind a wave
  }
  EXPECT_GT(ground.travelled(), 0.1);
}

/// 24 strides over undisturbed sand, which stays as below a window with even cells. There too it
/// settles a little at the start, by the error of its weight in the cells.
TEST(GradedWindow, UndisturbedGroundSettlesAsInEvenCells) {
  const TerrainParameters graded = following_ground(
      "drucker_prager_cap density 1500 d 100 beta 47 R 0.02 eps_vol_pl_0 0 elasticity linear E "
      "4.8e6 nu 0.2 hardening table p 3 1132 5890 29680 178400 eps_vol_pl 0 0.0089 0.0158 0.0259 "
      "0.0303 interpolation linear beyond extrapolate");
  TerrainParameters even_cells = graded;
  even_cells.x = even(-0.8, 0.8, cell);
  even_cells.halvings = 0;
  struct Result {
    double stress[2], top, speed, maximum_particles;
  };
  const auto travel = [&](const TerrainParameters& parameters) {
    ContinuumTerrain ground(parameters, Communicator());
    const double stride = std::ldexp(cell, graded.halvings), mass = sums_of(ground).mass;
    Result result = {};
    for (int n = 1; n <= 24; ++n) {
      ground.follow(n * stride);
      const double dt = ground.stable_time_step();
      for (int step = 0; step < 48; ++step) ground.advance(dt);
      result.maximum_particles = std::max(result.maximum_particles, ground.particle_count());
    }
    EXPECT_NEAR(ground.travelled(), 24 * stride, 1.01 * stride);
    EXPECT_NEAR(sums_of(ground).mass, mass, 1e-9 * mass);
    for (const int layer : {0, 2})
      result.stress[layer / 2] = mean_of(ground, field::stress + 2, [layer](const Vector3& x) {
        return x.z() > layer * cell && x.z() < (layer + 1) * cell;
      });
    std::vector<double> ids;
    for_particles(ground, [&](Particles& p, std::size_t n) {
      result.top = std::max(result.top,
                            p.data(column::z)[n] + p.data(column::half_z)[n] * p.volume_ratio(n));
      result.speed = std::max(result.speed, p.velocity(n).norm());
      ids.push_back(p.data(column::id)[n]);
    });
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
    EXPECT_FALSE(ground.rut().points().empty());
    for (const RutPoint& point : ground.rut().points()) EXPECT_NEAR(point.z, depth, 5e-5);
    return result;
  };
  const Result one = travel(graded), other = travel(even_cells);
  for (const int layer : {0, 1}) EXPECT_NEAR(one.stress[layer] / other.stress[layer], 1.0, 3e-3);
  EXPECT_NEAR(one.top, other.top, 1e-5);
  EXPECT_LT(one.speed, 1.1 * other.speed);
  // as many as at the start, and half of those in even cells
  EXPECT_EQ(one.maximum_particles, 8704);
  EXPECT_EQ(other.maximum_particles, 16384);
}

TEST(GradedWindow, GroundThatLongParticlesCannotFillIsRefused) {
  const auto refusal = [](const std::function<void(TerrainParameters&)>& change) {
    TerrainParameters parameters = following_ground();
    change(parameters);
    return test::error_of<InputError>(
        [&] { ContinuumTerrain ground(parameters, Communicator(), "fix soil"); });
  };
  EXPECT_THAT(
      refusal([](TerrainParameters& p) { p.boundary[Face::y_upper] = BoundaryKind::absorbing; }),
      HasSubstr("fix soil, keyword 'fine_length' is given with 'follow' and an absorbing face; "
                "allowed: flat ground of one piece"));
  EXPECT_THAT(refusal([](TerrainParameters& p) { p.surface_mesh = true; }),
              HasSubstr("'follow' and 'surface_mesh yes'"));
  EXPECT_THAT(refusal([](TerrainParameters& p) { p.thin_parts = true; }), HasSubstr("no error"));
}

}  // namespace
}  // namespace furrow::particle_refinement_test
