// SPDX-License-Identifier: GPL-2.0-or-later
// Stiffness and step that command bed chooses, against Hertz's law on a lattice and the Rayleigh
// time, and what it says where it cannot choose.
#include "coupling/terrain/bed/bed_choice.h"

#include <cmath>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "coupling/base/checks/time_step_check.h"
#include "tests/support/error_of.h"

namespace furrow::coupling::bed_choice_test {
namespace {

using testing::HasSubstr;

BedWords line(std::vector<std::pair<std::string, std::string>> more) {
  BedWords words = {{"diameter", "0.02"}, {"density", "2600"}, {"poisson", "0.25"}};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

double value(const BedWords& words, const std::string& name) {
  for (const auto& [word, text] : words)
    if (word == name) return std::stod(text);
  return std::nan("");
}

TEST(BedChoice, YoungsModulusGivesTheHertzOverlapOfACubicLattice) {
  const double p = 4e4, nu = 0.25, d = 0.02, share = 0.015;
  const double E = young_for_overlap(p, nu, share);
  // Hertz: F = 4/3 E* sqrt(R*) delta^1.5, R* = d/4; on the lattice each contact carries p d^2
  const double E_star = E / (2 * (1 - nu * nu));
  const double force = 4.0 / 3.0 * E_star * std::sqrt(d / 4) * std::pow(share * d, 1.5);
  EXPECT_NEAR(force, p * d * d, 1e-12 * force);
}

TEST(BedChoice, ModulusAndStepReplaceAutoAndThePressureIsDropped) {
  BedWords words = line({{"young", "auto"}, {"step", "auto"}, {"pressure", "4e4"}});
  const std::string said = choose_bed_values(words);
  const double young = young_for_overlap(4e4, 0.25, chosen_overlap);
  EXPECT_NEAR(value(words, "young"), young, 1e-3 * young);
  const double time = rayleigh_time(0.5 * 0.85 * 0.02, 2600, young, 0.25);
  EXPECT_NEAR(value(words, "step"), 0.2 * time, 1e-3 * time);
  EXPECT_TRUE(std::isnan(value(words, "pressure")));
  EXPECT_THAT(said, HasSubstr("grains overlap by 1.5 % under 40000 Pa"));
  EXPECT_THAT(said, HasSubstr("0.2 of the smallest grain's Rayleigh time"));
}

TEST(BedChoice, StepOfSnowFollowsItsContactTime) {
  BedWords words = {{"diameter", "0.04"}, {"density", "323"}, {"modulus", "2e7"}, {"step", "auto"}};
  choose_bed_values(words);
  const double time = snow_contact_time(0.5 * 0.85 * 0.04, 323, 2e7);
  EXPECT_NEAR(value(words, "step"), 0.2 * time, 1e-3 * time);
}

TEST(BedChoice, LineWithoutAutoIsUnchanged) {
  BedWords words = line({{"young", "1e7"}, {"step", "1e-5"}, {"pressure", "4e4"}});
  const BedWords before = words;
  EXPECT_EQ(choose_bed_values(words), "");
  EXPECT_EQ(words, before);
}

TEST(BedChoice, MissingOrWrongKeywordsAreRefused) {
  const auto refusal = [](BedWords words) {
    return test::error_of<InputError>([&] { choose_bed_values(words); });
  };
  EXPECT_THAT(refusal(line({{"young", "auto"}})), HasSubstr("keyword 'pressure' is missing"));
  EXPECT_THAT(refusal(line({{"young", "auto"}, {"pressure", "-1"}})), HasSubstr("number > 0 [Pa]"));
  EXPECT_THAT(refusal(line({{"step", "auto"}, {"stiffness", "1e5"}})),
              HasSubstr("beds with young and poisson, or modulus"));
}

}  // namespace
}  // namespace furrow::coupling::bed_choice_test
