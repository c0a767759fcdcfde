// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/plausibility.h"

#include <gmock/gmock.h>

#include "tests/support/paths.h"
#include "tests/support/error_of.h"

namespace furrow::plausibility_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing_paths::material_of;

std::string refusal(const std::string& text) {
  return test::error_of<InputError>([&] { check_plausible(*material_of(text)); });
}

TEST(Plausibility, ImpossibleMaterialValuesAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"elastic density 25000 elasticity linear E 5e6 nu 0.2",
       "law elastic has a density of 25000 kg/m3; allowed: a number in [0.001, 23000]; units are "
       "SI"},
      {"elastic density 1e-4 elasticity linear E 5e6 nu 0.2", "has a density of 0.0001 kg/m3"},
      {"elastic density 200 elasticity linear E 1e-30 nu 0.2",
       "has a stiffness at rest of 1.11e-30 Pa and a density of 200 kg/m3: compression waves of "
       "7.45e-17 m/s; allowed: a speed in [0.001, 30000] [m/s]"},
      {"elastic density 200 elasticity linear E 1e15 nu 0.2", "compression waves of 2.36e+06 m/s"},
      {"elastic density 200 elasticity porous kappa 1e-9 e0 0.8 p0 1 nu 0.3",
       "keyword 'kappa' is 1e-09 and e0 0.8: a bulk modulus of 1.8e+09 times the pressure; "
       "allowed: (1 + e0)/kappa in [1, 1000000]"},
      {"elastic density 200 elasticity porous kappa 5 e0 0.8 p0 1e4 nu 0.3",
       "a bulk modulus of 0.36 times the pressure"},
      {"elastic density 200 elasticity porous kappa 0.01 e0 0.8 p0 1e12 nu 0.3",
       "has a stiffness at rest of "},
      {"elastic density 200 elasticity linear E 5e6 nu 0.4999999999",
       "has a bulk modulus of 5e+09 times its shear modulus (Poisson's ratio 0.4999999999); "
       "allowed: "
       "a ratio in [0.001, 10000]: Poisson's ratio in [-0.9955, 0.49995]"},
      {"elastic density 200 elasticity linear E 5e6 nu -0.9999", "(Poisson's ratio -0.9999)"},
      {"neo_hookean density 1100 G 1 bulk 5e7", "has a bulk modulus of 5e+07 times"}};
  for (const auto& [text, message] : cases) EXPECT_THAT(refusal(text), HasSubstr(message));
  EXPECT_EQ(refusal("elastic density 200 elasticity linear E 5e6 nu 0.4999"), "no error");
}

TEST(Plausibility, UnusualMaterialValuesAreWarnedOf) {
  const auto warnings_of = [](const char* text) {
    return plausibility_warnings(*material_of(text));
  };
  EXPECT_THAT(warnings_of("elastic density 1600 elasticity linear E 5e6 nu 0.2"), IsEmpty());
  // kPa for Pa, in an E that rubber may have
  EXPECT_THAT(warnings_of("elastic density 2000 elasticity linear E 2e4 nu 0.3"),
              ElementsAre(HasSubstr("compression waves have 3.67 m/s at a pressure of 10 kPa")));
}

}  // namespace
}  // namespace furrow::plausibility_test
