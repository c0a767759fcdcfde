// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/point/point_driver.h"

#include <cmath>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/io/inputs/material_file.h"
#include "tests/support/error_of.h"

namespace furrow::point_driver_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// McCormick sand, [Shoop2001] Table 4
const double K = 689e6 / 1.5, tan_beta = std::tan(radians(14.56)), d = 1.194e6, R = 0.1;

std::unique_ptr<Material> preset(const std::string& name) {
  return load_material(std::string(FURROW_SOURCE_DIR) + "/inputs/materials/" + name + ".yaml");
}

PointPath path(const std::string& type, const std::vector<Entry>& entries) {
  const PathType& known = find_path_type(type);
  return known.build(known.schema.read(entries));
}

double volume_strain(const PointRecord& record) {
  return -std::log(record.state[field::volume_ratio]);
}
Invariants stress(const PointRecord& record) { return invariants(stress_of(record.state)); }

/// Hydrostatic: eps_v = p/K + H^-1(p) - eps_0 on the rows of [Shoop2001] Table 5, and p/K before
/// first yield at 0.1448 MPa.
TEST(PointDriver, HydrostaticCompressionFollowsTheHardeningTable) {
  const auto sand = preset("mccormick_sand");
  const PointHistory history = drive_point(
      *sand, path("hydrostatic", {{"pressure", {"0.144e6", "0.434e6", "2.758e6", "13.447e6", "0"}},
                                  {"steps", {"40"}},
                                  {"tolerance", {"1e-13"}}}));
  const double expected[] = {0.144e6 / K, 0.434e6 / K + 0.01 - 0.001, 2.758e6 / K + 0.04 - 0.001,
                             13.447e6 / K + 0.10 - 0.001, 0.10 - 0.001};
  for (std::size_t s = 0; s < 5; ++s) {
    const PointRecord& end = history.records[40 * (s + 1)];
    ASSERT_EQ(end.segment, int(s) + 1);
    EXPECT_NEAR(volume_strain(end), expected[s], 2e-12) << s;
    EXPECT_NEAR(sand->current_density(end.state), 1800.0 * std::exp(expected[s]), 1e-8);
  }
  EXPECT_EQ(history.cost.steps, 200);
  // first step: 8 epsilon of the P-wave modulus over 3.6 kPa
  EXPECT_LT(history.cost.largest_residual, 4e-10);
}

/// Triaxial compression ends at q = (d + sigma_c tan(beta))/(1 - tan(beta)/3).
TEST(PointDriver, TriaxialCompressionEndsInTheCriticalState) {
  const auto sand = preset("mccormick_sand");
  for (const double confinement : {0.25e6, 1e6, 4e6}) {
    const PointHistory history =
        drive_point(*sand, path("triaxial", {{"confinement", {std::to_string(confinement)}},
                                             {"axial_strain", {"0.3"}},
                                             {"steps", {"300"}}}));
    const PointRecord& end = history.records.back();
    EXPECT_NEAR(stress(end).q / ((d + confinement * tan_beta) / (1.0 - tan_beta / 3.0)), 1.0, 1e-6);
    int compressed = 0;
    for (const PointRecord& record : history.records) {
      if (record.segment != 2) continue;
      ++compressed;
      EXPECT_NEAR(record.state[0], -confinement, 2e-10 * stress(record).q + 1e-10 * confinement);
      EXPECT_NEAR(record.state[1], record.state[0], 4e-10 * stress(record).q + 1e-10 * confinement);
    }
    EXPECT_EQ(compressed, 300);
    // The axial strain counts from the end of the isotropic piece.
    EXPECT_NEAR(-end.strain[2] + history.records[300].strain[2], 0.3, 1e-12);
  }
}

/// On the cap in confined compression with small R: sigma_1 = p + 2q/3 of pa = (pb - R d)/(1 + R
/// tan(beta)), Q = d + pa tan(beta), y = 1/sqrt(1 + 2.25 R^2), q = y Q, p = pa + 1.5 R^2 y Q.
TEST(PointDriver, ConfinedCompressionFollowsTheCap) {
  MaterialSections sections =
      read_material_file(std::string(FURROW_SOURCE_DIR) + "/inputs/materials/mccormick_sand.yaml")
          .sections;
  const double small = 1e-3;
  for (Entry& entry : sections["law"])
    if (entry.key == "R") entry.values = {"1e-3"};
  const auto sand = make_material("drucker_prager_cap", sections);
  const PointHistory history = drive_point(
      *sand, path("confined", {{"stress", {"4e6", "8e6", "12e6"}}, {"steps", {"200"}}}));
  const std::size_t eps = *sand->find_field("eps_vol_pl");
  for (const int row : {200, 400, 600}) {
    const PointRecord& end = history.records[std::size_t(row)];
    ASSERT_EQ(end.branch, Branch::cap);
    const double pb = sand->yield_surface(end.state).back().x();
    const double pa = (pb - small * d) / (1.0 + small * tan_beta), Q = d + pa * tan_beta,
                 y = 1.0 / std::sqrt(1.0 + 2.25 * small * small);
    EXPECT_NEAR(stress(end).q / (y * Q), 1.0, 1e-3);
    EXPECT_NEAR(-end.state[2] / (pa + 1.5 * small * small * y * Q + 2.0 / 3.0 * y * Q), 1.0, 1e-3);
    EXPECT_NEAR(volume_strain(end), stress(end).p / K + end.state[Eigen::Index(eps)] - 0.001,
                1e-10);  // elastic and plastic parts
  }
}

/// Elastic law: every path has its closed form in logarithmic strain.
TEST(PointDriver, ElasticPathsFollowHookesLaw) {
  const auto ground = preset("compacted_sand_elastic");  // E 50 MPa, nu 0.3
  const double E = 50e6, G = E / 2.6, M = E * 0.7 / (1.3 * 0.4);
  const PointHistory tension = drive_point(*ground, path("tension", {{"strain", {"0.2"}}}));
  EXPECT_NEAR(tension.records.back().state[2], 0.2 * E, 1e-10 * 0.2 * E);
  EXPECT_NEAR(tension.records.back().strain[0], -0.3 * 0.2, 1e-12);
  const PointHistory confined =
      drive_point(*ground, path("confined", {{"stress", {"1e6", "-1e6"}}}));
  EXPECT_NEAR(confined.records[100].strain[2], -1e6 / M, 1e-12);
  EXPECT_NEAR(confined.records.back().strain[2], 1e6 / M, 1e-12);
  const PointHistory cyclic = drive_point(*ground, path("cyclic", {{"upper", {"2e6"}},
                                                                   {"lower", {"1e6"}},
                                                                   {"cycles", {"3"}},
                                                                   {"lateral", {"free"}},
                                                                   {"confinement", {"1e6"}}}));
  EXPECT_EQ(cyclic.cost.steps, 700);  // the isotropic piece and three times up and down
  EXPECT_NEAR(cyclic.records.back().strain[2], -1e6 / (3.0 * E / (3.0 * 0.4)), 1e-12);
  const PointHistory shear =
      drive_point(*ground, path("simple_shear", {{"normal_stress", {"0"}}, {"shear", {"1e-4"}}}));
  EXPECT_NEAR(shear.records.back().state[5], 1e-4 * G, 1e-4 * G * 1e-6);
}

/// Six controlled stresses of an elastic point, sheared and stretched: the strain is Hooke's law
/// inverted where it is small.
TEST(PointDriver, SixStressesAreControlledTogether) {
  const auto ground = preset("compacted_sand_elastic");
  const double E = 50e6, nu = 0.3, G = E / 2.6;
  const Vector6 target = (Vector6() << -30, 20, -70, 10, -5, 15).finished();
  PointPath six;
  six.segments.push_back({});
  six.segments[0].control.fill(Control::stress);
  six.segments[0].target = target;
  six.segments[0].steps = 3;
  for (const Motion motion : {Motion::stretch, Motion::shear}) {
    six.motion = motion;
    const PointRecord end = drive_point(*ground, six).records.back();
    EXPECT_LT((stress_of(end.state) - target).norm(), 2e-6);  // rounding of F - I, 1e-16 E, rules
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(end.strain[c], ((1 + nu) * target[c] + 80 * nu) / E, 1e-11);
    for (int c = 3; c < 6; ++c) EXPECT_NEAR(end.strain[c], target[c] / (2 * G), 1e-11);
  }
}

/// Simple shear of rubber: sigma_xz = mu gamma exactly (Simo and Hughes, isochoric), q^2 = mu^2 (3
/// gamma^2 + gamma^4); and ln V of simple shear, det = 1, has the largest principal stretch
/// asinh(gamma/2).
TEST(PointDriver, LargeSimpleShearOfRubberIsTheClosedForm) {
  const auto rubber = preset("rubber");
  const PointHistory history = drive_point(
      *rubber,
      path("simple_shear",
           {{"normal_stress", {"0"}}, {"shear", {"2"}}, {"volume", {"fixed"}}, {"steps", {"50"}}}));
  const PointRecord& end = history.records.back();
  EXPECT_NEAR(end.state[5], 2.0 * 1e6, 1e-3);
  EXPECT_NEAR(stress(end).q, 1e6 * std::sqrt(12.0 + 16.0), 1e-2);
  const double largest = std::asinh(1.0);
  EXPECT_NEAR(end.strain.head<3>().squaredNorm() + 2.0 * end.strain.tail<3>().squaredNorm(),
              2.0 * largest * largest, 1e-12);
  EXPECT_NEAR(end.strain.head<3>().sum(), 0.0, 1e-12);
}

/// Snow at 90 % of the way to ice in ten steps: nearly zero strength at the start, modulus over
/// strength 1e5.
TEST(PointDriver, LargeStepsOnSoftSnowAreSolved) {
  const auto snow = preset("fresh_snow");
  const PointHistory coarse =
      drive_point(*snow, path("confined", {{"stress", {"2e6"}}, {"steps", {"10"}}}));
  const PointHistory fine =
      drive_point(*snow, path("confined", {{"stress", {"2e6"}}, {"steps", {"2000"}}}));
  EXPECT_NEAR(snow->current_density(coarse.records.back().state) /
                  snow->current_density(fine.records.back().state),
              1.0, 1e-4);
  EXPECT_LE(coarse.cost.largest_residual, 1.1e-10);
  EXPECT_LE(coarse.cost.max_newton_iterations, 40);
}

/// The step error it reports is that of a run with every step halved; first order of the law: it
/// halves with the steps.
TEST(PointDriver, StepErrorFallsAtFirstOrder) {
  const auto sand = preset("mccormick_sand");
  double before = 0.0;
  for (const char* steps : {"25", "50", "100", "200"}) {
    const PointPath shear =
        path("simple_shear", {{"normal_stress", {"2e6"}}, {"shear", {"0.02"}}, {"steps", {steps}}});
    const StepError error = step_error(*sand, shear, drive_point(*sand, shear));
    if (before > 0.0) {
      EXPECT_NEAR(before / error.q, 2.0, 0.3);
    }
    before = error.q;
  }
  EXPECT_GT(before, 1e-8);
  EXPECT_LT(before, 1e-3);
}

TEST(PointDriver, UnreachableStressIsAnErrorWithItsCause) {
  const auto snow = preset("variants/fresh_snow_shoop");
  // Uniaxial compression by stress: beyond the shear strength no strain gives 1 MPa without lateral
  // stress.
  const PointPath beyond =
      path("cyclic", {{"upper", {"1e6"}}, {"cycles", {"1"}}, {"lateral", {"free"}}});
  EXPECT_THAT(test::error_of<StateError>([&] { drive_point(*snow, beyond); }),
              AllOf(HasSubstr("path cyclic, segment 2, step "),
                    HasSubstr("cannot reach stress_xx = 0 Pa"), HasSubstr("the point is at p = ")));
  const PointPath tension = path("hydrostatic", {{"pressure", {"-1e6"}}});
  EXPECT_THROW(drive_point(*snow, tension), StateError);
}

TEST(PointDriver, ChannelsAreFoundByName) {
  const auto sand = preset("mccormick_sand");
  PointRecord record;
  record.state = sand->initial_state();
  EXPECT_EQ(find_point_channel(*sand, "density").value(record), 1800.0);
  EXPECT_EQ(find_point_channel(*sand, "eps_vol_pl").value(record), 0.001);
  EXPECT_THAT(test::error_of<InputError>([&] { find_point_channel(*sand, "rho"); }),
              HasSubstr("has no channel 'rho'; allowed: segment, step, axial_strain"));
}

}  // namespace
}  // namespace furrow::point_driver_test
