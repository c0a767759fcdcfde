// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable step of the ground, against the closed form of a lone particle that breathes
// (coupling/terrain/fix_terrain_continuum.md).

#include <gtest/gtest.h>

#include "../../unit/mpm/terrain_scene.h"
#include "tests/support/max_error.h"

namespace furrow::step_limit_test {
namespace {

using namespace testing_terrain;

constexpr double h = 0.1, E = 1e6, density = 200.0;

/// Largest rate of strain after some steps, over that at the start, of a single particle whose
/// nodes start with v_i = a d_i. With G_i = N_i d_i/D this is a mode of vibration: H = a dt I, f_i
/// = -V 3 K a N_i d_i/D, omega^2 = 3 K/(rho D), D = h^2/4.
double growth(double nu, double step_over_limit) {
  TerrainParameters parameters =
      box(material_of(elastic(E, nu, density)), {0, 0, 0}, {0.6, 0.6, 0.6}, h);
  parameters.remap_interval = 64;
  ContinuumTerrain ground(parameters, Communicator());
  bool found = false;
  carve(ground, [&](const Vector3& x) {
    const bool keep = !found && (x - Vector3(0.33, 0.33, 0.33)).norm() < 0.05;
    found |= keep;
    return keep;
  });
  EXPECT_EQ(ground.particle_count(), 1.0);
  const double rate = 1e-9;
  set_motion(ground, Vector3::Zero(), rate * Matrix3::Identity());
  const double bulk = E / (3.0 * (1.0 - 2.0 * nu)), limit = h / std::sqrt(3.0 * bulk / density);
  test::MaxError strain_rate;
  for (int step = 0; step < 50; ++step) {
    ground.advance(step_over_limit * limit);
    std::vector<ParticleMotion> motion;
    ground.interpolate_motion({{0, 0}}, motion);
    strain_rate.add(motion[0].affine.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  }
  return strain_rate.max() / rate;
}

TEST(StepLimit, SingleParticleIsStableUpToTheClosedForm) {
  for (const double nu : {0.0, 0.3, 0.45}) {
    EXPECT_LT(growth(nu, 0.99), 10.0) << nu;  // 1/sqrt(1 - 0.99^2) = 7.1 in a leapfrog
    EXPECT_GT(growth(nu, 1.01), 1e4) << nu;   // 1.33 a step
  }
}

/// The program's own step keeps below it.
TEST(StepLimit, ChosenStepIsBelowTheLimit) {
  for (const double nu : {0.0, 0.3, 0.45}) {
    const ContinuumTerrain ground(
        box(material_of(elastic(E, nu, density)), {0, 0, 0}, {0.6, 0.6, 0.6}, h), Communicator());
    const double bulk = E / (3.0 * (1.0 - 2.0 * nu));
    EXPECT_LT(ground.stable_time_step(), 0.8 * h / std::sqrt(3.0 * bulk / density)) << nu;
  }
}

}  // namespace
}  // namespace furrow::step_limit_test
