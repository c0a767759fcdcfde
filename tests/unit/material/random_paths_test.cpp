// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/max_error.h"
#include "tests/support/paths.h"

namespace furrow::random_paths_test {
namespace {

using testing_paths::excess_of_cone;
using testing_paths::material_of;
using testing_paths::stretch;

/// Numbers are thrown in statements of their own: in which order the arguments of a call are
/// evaluated is the compiler's choice, and the paths are to be the same for all.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double decades(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  bool chance(double probability) { return between(0, 1) < probability; }
  double normal() { return std::normal_distribution<double>()(engine_); }
  /// keys K and section
  std::string section() {
    if (chance(0.4)) return "K 1";
    if (chance(0.5)) return fmt::format("K {}", between(0.778, 1));
    return fmt::format("K {} section matsuoka_nakai", between(0.6, 1));
  }

 private:
  std::mt19937 engine_;
};

std::string random_elasticity(Dice& dice, double young, double tensile) {
  if (dice.chance(0.7))
    return fmt::format(" elasticity linear E {} nu {}", young, dice.between(0, 0.48));
  const double pt = tensile * dice.between(1.01, 3) + 1.0, kappa = dice.decades(1e-3, 0.05),
               e0 = dice.between(0.2, 5), nu = dice.between(0, 0.45);
  return fmt::format(
      " elasticity porous elasticity.kappa {} elasticity.e0 {} elasticity.p0 0 pt_el {} nu {}",
      kappa, e0, pt, nu);
}

std::string random_hardening(Dice& dice, double p_first) {
  if (dice.chance(0.3)) {
    const double lambda = dice.between(0.1, 0.5), kappa = dice.between(0.001, 0.05),
                 e0 = dice.between(0.2, 5);
    return fmt::format(" hardening exponential pc0 {} lambda {} hardening.kappa {} hardening.e0 {}",
                       p_first, lambda, kappa, e0);
  }
  const int rows = 2 + static_cast<int>(dice.between(0, 12));
  std::string p, eps;
  double strength = p_first, strain = 0;
  for (int k = 0; k < rows; ++k) {
    p += fmt::format(" {}", strength);
    eps += fmt::format(" {}", strain);
    const double rise = dice.decades(1e-3, 0.4);
    strain += k + 2 == rows ? 0.4 : rise;  // a flat end: exp() beyond the table must not leave the
                                           // range of pressures on earth
    strength *= k + 2 == rows ? 2.0 : dice.decades(1.05, 10);
  }
  return fmt::format(" hardening table p{} eps_vol_pl{} interpolation {} beyond extrapolate", p,
                     eps, dice.chance(0.5) ? "log" : "linear");
}

std::string random_cap(Dice& dice) {
  const double young = dice.decades(1e5, 1e9), pb = young * dice.decades(1e-5, 1e-2);
  const double d = dice.chance(0.2) ? 0.0 : pb * dice.decades(1e-4, 1e2),
               beta = dice.between(1, 65), R = dice.decades(1e-4, 2),
               alpha = dice.chance(0.5) ? 0.0 : dice.between(0, 0.1);
  const std::string section = dice.section();
  const double tan_beta = std::tan(radians(beta));
  std::string material = fmt::format("drucker_prager_cap density 300 d {} beta {} R {} {} alpha {}",
                                     d, beta, R, section, alpha);
  if (dice.chance(0.3))
    material += fmt::format(" tension {}", d / tan_beta * dice.between(0, 0.99));
  material += random_elasticity(dice, young, d / tan_beta);
  return material += random_hardening(dice, pb);
}

std::string random_foam(Dice& dice) {
  const double young = dice.decades(1e5, 1e9), pc = young * dice.decades(1e-5, 1e-2),
               pt = pc * dice.decades(1e-4, 1), sigma0 = 3 * pc * dice.between(0.05, 0.95);
  std::string material =
      fmt::format("crushable_foam density 300 pt {} sigma0 {} {} ", pt, sigma0, dice.section());
  material += random_elasticity(dice, young, pt);
  return material += random_hardening(dice, pc);
}

std::string random_cam_clay(Dice& dice) {
  const double young = dice.decades(1e5, 1e9), p0 = young * dice.decades(1e-5, 1e-2),
               M = dice.decades(0.05, 8),
               ratio = dice.chance(0.2) ? 0.0 : (dice.chance(0.1) ? 1.0 : dice.decades(1e-4, 1));
  std::string material =
      fmt::format("cohesive_cam_clay density 300 M {} tension_ratio {}", M, ratio);
  material += random_elasticity(dice, young, ratio * p0);
  return material += random_hardening(dice, p0);
}

std::string random_cohesive_cap(Dice& dice) {
  const double young = dice.decades(1e5, 1e9), pc = young * dice.decades(1e-5, 1e-2),
               d = dice.chance(0.1) ? 0.0 : pc * dice.decades(1e-2, 1e2),
               beta = dice.between(0, 65), growth = dice.between(0, 6),
               nu_p = dice.between(0, 0.49), apex = std::min(1 / std::tan(radians(beta)), 2.0),
               ratio = dice.chance(0.2) ? 0.0 : dice.between(0, 1) * apex;
  std::string material = fmt::format(
      "cohesive_cap density 300 nu_p {} d {} d_density 300 d_exponent {} beta {} tension_ratio {}",
      nu_p, d, growth, beta, ratio);
  if (dice.chance(0.3)) material += fmt::format(" aspect {}", dice.decades(0.2, 8));
  material += random_elasticity(dice, young, ratio * d);
  return material += random_hardening(dice, pc);
}

std::string random_norsand(Dice& dice) {
  const double M = dice.between(0.6, 1.7), N = dice.chance(0.3) ? 0.5 : dice.between(0.1, 0.6),
               lambda = dice.chance(0.1) ? 0.0 : dice.between(0.005, 0.08),
               chi = dice.between(1, 5), e0 = dice.between(0.4, 1.2), H = dice.decades(20, 1000),
               shear = dice.decades(1e6, 1e9), exponent = dice.between(0.2, 1),
               nu = dice.between(0, 0.2), pt = dice.decades(1, 1e3);
  const std::string section = dice.section() + (dice.chance(0.3) ? " H_exponent 0" : "");
  return fmt::format(
      "norsand density 1500 e0 {} M {} N {} gamma 0.85 lambda {} chi {} H {} H_psi {} G {} n {} nu "
      "{} pt {} {}",
      e0, M, N, lambda, chi, H, dice.chance(0.5) ? 0.0 : 2 * H, shear, exponent, nu, pt, section);
}

struct Family {
  std::string name;
  std::string (*random)(Dice&);
  int paths;
  std::vector<Branch> branches;  ///< that the paths are to meet
};

struct Tally {
  UpdateReport report;
  test::Range yield, heat;  // over the stress scale
  std::size_t steps = 0;
};

/// One path of mixed steps, from 1e-6 to jumps of 0.5 of strain, each turned at random.
void expect_sound_path(Dice& dice, const std::string& text, Tally& tally) {
  const auto material = material_of(text);
  VectorX state = material->initial_state();
  for (int step = 0; step < 12; ++step) {
    Vector6 strain;
    for (int k = 0; k < 6; ++k) strain[k] = dice.normal();
    if (dice.chance(0.3)) strain.tail<3>().setZero();
    if (dice.chance(0.4)) strain.head<3>().array() -= 1.0;
    if (dice.chance(0.2)) strain.head<3>().setConstant(dice.chance(0.7) ? -1.0 : 1.0);
    strain *= (dice.chance(0.1) ? 0.5 : dice.decades(1e-6, 0.1)) / strain.norm();
    Vector3 axis;
    for (int k = 0; k < 3; ++k) axis[k] = dice.normal();
    const double angle = dice.chance(0.3) ? dice.between(0, 0.3) : 0.0;
    const Matrix3 turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    const Matrix3 gradient = turn * (Matrix3::Identity() + stretch(strain)) - Matrix3::Identity();
    const VectorX before = state;
    UpdateReport report;
    ASSERT_NO_THROW(report = material->update_point(gradient, state))
        << text << "\nstep " << step << " strain " << strain.transpose();
    tally.report += report;
    ++tally.steps;
    ASSERT_TRUE(state.allFinite()) << text;
    const double scale = material->stress_scale(state);
    const double excess = material->yield_function(state) / scale;
    tally.yield.add(excess);
    ASSERT_LE(excess, 1e-8 + excess_of_cone(*material, before, state))
        << text << "\nstep " << step << " strain " << strain.transpose() << "\nstate "
        << state.transpose();
    const double heat = state[field::dissipated_energy] - before[field::dissipated_energy];
    tally.heat.add(heat / scale);
    ASSERT_GE(heat, -1e-14 * scale) << text << "\nstep " << step << " strain " << strain.transpose()
                                    << "\nstate " << state.transpose();
    ASSERT_LT(report.max_iterations, 300u)
        << text << "\nstep " << step << " strain " << strain.transpose();
  }
}

TEST(RandomPaths, StressStaysInTheYieldSurfaceAndDissipates) {
  Dice dice(20261121);
  for (const Family& family :
       {Family{"cap",
               random_cap,
               10000,
               {Branch::elastic, Branch::shear, Branch::transition, Branch::cap, Branch::tension}},
        Family{"foam", random_foam, 3000, {Branch::elastic, Branch::cap, Branch::tension}},
        Family{"cam_clay",
               random_cam_clay,
               5000,
               {Branch::elastic, Branch::shear, Branch::cap, Branch::tension}},
        Family{"cohesive_cap",
               random_cohesive_cap,
               5000,
               {Branch::elastic, Branch::shear, Branch::cap, Branch::tension}},
        Family{
            "norsand",
            random_norsand,
            5000,
            {Branch::elastic, Branch::shear, Branch::transition, Branch::cap, Branch::tension}}}) {
    Tally tally;
    for (int path = 0; path < family.paths; ++path) {
      expect_sound_path(dice, family.random(dice), tally);
      if (::testing::Test::HasFatalFailure()) return;
    }
    const auto& points = tally.report.points;
    const double yielding = static_cast<double>(tally.steps - points[0]);
    RecordProperty(family.name,
                   fmt::format("{} steps: elastic {} shear {} transition {} cap {} tension {}; "
                               "iterations mean {:.2f} most {}; yield at most "
                               "{:.2e}, heat at least {:.2e}",
                               tally.steps, points[0], points[1], points[2], points[3], points[4],
                               static_cast<double>(tally.report.iterations) / yielding,
                               tally.report.max_iterations, tally.yield.max(), tally.heat.min()));
    for (const Branch branch : family.branches)
      EXPECT_GT(points[static_cast<std::size_t>(branch)], 500u)
          << family.name << " hardly met: " << to_string(branch);
  }
}

}  // namespace
}  // namespace furrow::random_paths_test
