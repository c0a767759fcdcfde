// SPDX-License-Identifier: GPL-2.0-or-later
// Bad parameters, each with its message; the two ways to write a law; what the listing offers.

#include "furrow/material/registry.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"
#include "tests/support/paths.h"

namespace furrow::registry_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing_paths::material_of;

const std::string elastic = " elasticity linear E 13.79e6 nu 0.3";
const std::string table =
    " hardening table p 1e3 5e4 1e6 eps_vol_pl 0 0.5 1 interpolation linear beyond stop";
const std::string yield = "drucker_prager_cap density 200 d 5e3 beta 22.53 R 0.02";
const std::string clay = "cohesive_cam_clay density 200 M 3.3";
const std::string cap = "cohesive_cap density 200 nu_p 0.1 d 1e3 d_density 200 d_exponent 3";

const std::string sand =
    "norsand density 1600 e0 0.7 M 1.2 gamma 0.8 lambda 0.02 H 100 G 4e7 n 0.5";

std::string message_of(const std::string& text) {
  return error_of<InputError>([&] { material_of(text); });
}

struct Refusal {
  std::string text;
  std::vector<std::string> message;
};

class BadParameters : public ::testing::TestWithParam<Refusal> {};

TEST_P(BadParameters, FaultyParametersAreRefusedWithTheirMessage) {
  for (const std::string& part : GetParam().message)
    EXPECT_THAT(message_of(GetParam().text), HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    Registry, BadParameters,
    ::testing::Values(
        Refusal{"mud density 1",
                {"unknown law 'mud'",
                 "drucker_prager_cap, drucker_prager, undrained_clay, crushable_foam, "
                 "cohesive_cam_clay, cohesive_cap, norsand, elastic, neo_hookean"}},
        Refusal{
            "undrained_clay density 1800 su 3e4 sensitivity 2 slip_95 0.005 band_width 1" + elastic,
            {"keyword 'slip_95' is 0.005 m", "at least 0.00848", "band_width"}},
        Refusal{"undrained_clay density 1800 su 3e4 elasticity porous kappa 0.01 e0 1 pt_el 1e5 nu "
                "0.3",
                {"section 'elasticity', keyword 'type' is porous", "linear"}},
        Refusal{"drucker_prager density 200 d 5e3 beta 20 psi 21" + elastic,
                {"keyword 'psi' is 21 degrees", "at most beta, 20 degrees"}},
        Refusal{"drucker_prager density 200 d 0 beta 0" + elastic,
                {"keyword 'd' and beta are both 0: the ground has no strength"}},
        Refusal{"drucker_prager density 200 d 5e3 beta 20 elasticity porous kappa 0.01 e0 1 pt_el "
                "1e5 nu 0.3",
                {"section 'elasticity', keyword 'type' is porous", "linear"}},
        Refusal{"drucker_prager_cap density 200 beta 22.53 R 0.02" + elastic + table,
                {"law drucker_prager_cap, keyword 'd' is missing", "cohesion"}},
        Refusal{yield + " K 0.7" + elastic + table,
                {"keyword 'K' is 0.7", "in [0.778, 1]", "take section matsuoka_nakai"}},
        Refusal{yield + " K 0.59 section matsuoka_nakai" + elastic + table,
                {"keyword 'K' is 0.59", "in [0.6, 1]"}},
        Refusal{yield + " K 0.9 section mohr_coulomb" + elastic + table,
                {"keyword 'section' is 'mohr_coulomb'", "one of: abaqus, matsuoka_nakai"}},
        Refusal{"drucker_prager_cap density 200 d 5e3 beta 95 R 0.02" + elastic + table,
                {"keyword 'beta' is 95", "(0, 80] [degree]"}},
        Refusal{
            yield + " alpha 0.95" + elastic + table,
            {"keyword 'alpha' is 0.95", "wider than the shear strength", "below cos(beta) = 0.92"}},
        Refusal{yield + " tension 2e4" + elastic + table,
                {"keyword 'tension' is 20000 Pa, beyond the apex", "at most d/tan(beta) = 12053"}},
        Refusal{yield + " eps_vol_pl_0 2" + elastic + table,
                {"keyword 'eps_vol_pl_0' is 2, outside the hardening data", "in [0, 1]"}},
        Refusal{yield + " colour 2" + elastic + table,
                {"has no keyword 'colour'", "density, d, beta"}},
        Refusal{yield + " d 1" + elastic + table, {"keyword 'd' is given twice"}},
        Refusal{yield + " elasticity linear E stiff nu 0.3" + table,
                {"elasticity linear, keyword 'E'"}},
        Refusal{yield + " elasticity linear E 1e6 nu 0.5" + table,
                {"keyword 'nu' is 0.5", "(-1, 0.5)"}},
        Refusal{yield + " elasticity rubber" + table,
                {"section 'elasticity', keyword 'type' is 'rubber'", "linear, porous"}},
        Refusal{yield + " elasticity porous kappa 0.01 e0 1 nu 0.3" + table,
                {"'pt_el' are both 0", "p0 + pt_el > 0"}},
        Refusal{yield + " elasticity porous kappa 0.01 e0 1 pt_el 1e5 nu 0.3 G 1e6" + table,
                {"has both 'nu' and 'G'", "exactly one"}},
        Refusal{yield + " elasticity porous kappa 0.01 e0 1 pt_el 1e5" + table,
                {"has neither 'nu' nor 'G'", "exactly one"}},
        Refusal{yield + " elasticity porous kappa 0.01 e0 1 pt_el 1e2 nu 0.3" + table,
                {"keyword 'pt_el' is 100 Pa", "above the tensile strength, 12053"}},
        Refusal{yield + elastic +
                    " hardening table p 1e3 5e4 5e4 eps_vol_pl 0 0.5 1 interpolation linear beyond "
                    "stop",
                {"keyword 'p' does not increase: row 2 is 50000, row 3 is 50000",
                 "strictly increasing"}},
        Refusal{yield + elastic +
                    " hardening table p 1e3 5e4 6e4 eps_vol_pl 0 0.5 0.4 interpolation linear "
                    "beyond stop",
                {"keyword 'eps_vol_pl' does not increase: row 2 is 0.5, row 3 is 0.4"}},
        Refusal{
            yield + elastic +
                " hardening table p 1e3 5e4 eps_vol_pl 0 0.5 1 interpolation linear beyond stop",
            {"keyword 'eps_vol_pl' has 3 values for 2 of 'p'"}},
        Refusal{yield + elastic +
                    " hardening table p 1e3 eps_vol_pl 0 interpolation linear beyond stop",
                {"has 1 row(s)", "2 to 64 rows"}},
        Refusal{yield + elastic + " hardening table p 1e3 5e4 eps_vol_pl 0 1 interpolation linear",
                {"keyword 'beyond' is missing", "extrapolate, stop"}},
        Refusal{yield + elastic +
                    " hardening table p 0 5e4 eps_vol_pl 0 1 interpolation linear beyond stop",
                {"keyword 'p' is 0", "each > 0 [Pa]"}},
        Refusal{yield + elastic +
                    " hardening by_density p 1e3 5e4 rho 210 400 interpolation log beyond stop",
                {"keyword 'rho' reaches from 210 to 400 kg/m3, without the density of the law, 200",
                 "densities around it"}},
        Refusal{yield + elastic +
                    " hardening by_density p 1e3 5e4 9e4 rho 100 400 300 interpolation log beyond "
                    "stop",
                {"keyword 'rho' does not increase: row 2 is 400, row 3 is 300"}},
        Refusal{yield + elastic +
                    " hardening by_density p 1e3 5e4 9e4 rho 100 400 interpolation log beyond stop",
                {"keyword 'rho' has 2 values for 3 of 'p'"}},
        Refusal{yield + elastic + " hardening exponential pc0 100 lambda 0.1 kappa 0.2 e0 1",
                {"keyword 'lambda' is 0.1, not above kappa = 0.2"}},
        Refusal{yield + " elasticity porous kappa 0.01 e0 1 pt_el 1e5 nu 0.3 hardening exponential "
                        "pc0 100 lambda 0.1",
                {"keyword 'kappa' belongs to more than one section",
                 "elasticity.kappa, hardening.kappa"}},
        Refusal{"crushable_foam density 200 pt 11 sigma0 400" + elastic +
                    " hardening exponential pc0 100 lambda 0.1 kappa 0.01 e0 1",
                {"keyword 'sigma0' is 400", "below 3 pc0 = 300 Pa"}},
        Refusal{
            "crushable_foam density 200 pt 11 sigma0 200 pc0_reading pc0_plus_pt" + elastic + table,
            {"with a hardening table"}},
        Refusal{"crushable_foam density 200 pt 110 sigma0 200 pc0_reading pc0_plus_pt" + elastic +
                    " hardening exponential pc0 100 lambda 0.1 kappa 0.01 e0 1",
                {"keyword 'pc0' is 100 Pa, which includes the tensile strength", "above 110 Pa"}},
        Refusal{clay + " tension_ratio 1.5" + elastic + table,
                {"keyword 'tension_ratio' is 1.5", "in [0, 1]"}},
        Refusal{clay + " tension_ratio 0.1 eps_vol_pl_0 2" + elastic + table,
                {"keyword 'eps_vol_pl_0' is 2, outside the hardening data", "in [0, 1]"}},
        Refusal{
            clay + " tension_ratio 0.1 elasticity porous kappa 0.01 e0 1 pt_el 50 nu 0.3" + table,
            {"keyword 'pt_el' is 50 Pa", "above the tensile strength at the start, 100 Pa"}},
        Refusal{cap + " beta 30 tension_ratio 2" + elastic + table,
                {"keyword 'tension_ratio' is 2", "at most 1.732", "apex of the shear line"}},
        Refusal{cap + " beta 30 tension_ratio 0.1 aspect 0" + elastic + table,
                {"keyword 'aspect' is 0", "(0, 20]"}},
        Refusal{cap + " beta 30 tension_ratio 0.1 eps_vol_pl_0 2" + elastic + table,
                {"keyword 'eps_vol_pl_0' is 2, outside the hardening data", "in [0, 1]"}},
        Refusal{cap +
                    " beta 30 tension_ratio 0.1 elasticity porous kappa 0.01 e0 1 pt_el 50 nu 0.3" +
                    table,
                {"keyword 'pt_el' is 50 Pa", "above the tensile strength at the start, 100 Pa"}},
        Refusal{sand + " chi 3 nu 0.2 N 0.9", {"keyword 'N' is 0.9", "in [0.05, 0.8]"}},
        Refusal{sand + " chi 300 nu 0.2", {"keyword 'chi' is 300", "at most 96", "too large"}},
        Refusal{sand + " chi 3 nu 0.45", {"keyword 'nu' is 0.45", "at most 0.9", "0.1 to 0.3"}},
        Refusal{"elastic density 0" + elastic,
                {"law elastic, keyword 'density' is 0", "> 0 [kg/m3]"}},
        Refusal{"neo_hookean density 1100 G 1e6", {"keyword 'bulk' is missing"}}));

TEST(Registry, UnknownSectionIsRefused) {
  EXPECT_THAT(
      test::error_of<InputError>([&] {
        make_material("elastic", MaterialSections{{"hardening", {}}});
      }),
      AllOf(HasSubstr("law elastic has no section 'hardening'"), HasSubstr("law, elasticity")));
}

TEST(Registry, FlatListAndSectionsGiveTheSameLaw) {
  const auto flat = material_of(yield + elastic + table);
  const auto nested = make_material(
      "drucker_prager_cap",
      MaterialSections{
          {"law", {{"density", {"200"}}, {"d", {"5e3"}}, {"beta", {"22.53"}}, {"R", {"0.02"}}}},
          {"elasticity", {{"type", {"linear"}}, {"E", {"13.79e6"}}, {"nu", {"0.3"}}}},
          {"hardening",
           {{"type", {"table"}},
            {"p", {"1e3", "5e4", "1e6"}},
            {"eps_vol_pl", {"0", "0.5", "1"}},
            {"interpolation", {"linear"}},
            {"beyond", {"stop"}}}}});
  Matrix3 h = Matrix3::Zero();
  h(2, 2) = -0.1;
  VectorX a = flat->initial_state(), b = nested->initial_state();
  flat->update_point(h, a);
  nested->update_point(h, b);
  EXPECT_EQ(a, b);
}

TEST(Registry, ListsNamesMeaningsAndSchemas) {
  for (const MaterialModel& material : material_models()) {
    EXPECT_FALSE(material.meaning.empty());
    EXPECT_EQ(material.sections.front().name, "law");
    for (const SectionSchema& section : material.sections)
      for (const SectionChoice& choice : section.choices)
        for (const Key& key : choice.schema.keys())
          EXPECT_GT(key.meaning.size(), 3u) << material.name << ", " << key.name;
  }
}

}  // namespace
}  // namespace furrow::registry_test
