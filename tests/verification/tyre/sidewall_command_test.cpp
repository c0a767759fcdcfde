// SPDX-License-Identifier: GPL-2.0-or-later
/// The program furrow-sidewall as a user runs it.

#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>

#include "../../unit/io/scratch.h"
#include "furrow/io/formats/csv_file.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/inputs/tyre_file.h"
#include "tests/support/program.h"

namespace furrow::sidewall_command_test {
namespace {

using test::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string tyres = std::string(FURROW_SOURCE_DIR) + "/inputs/tyres/";

class SidewallCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) {
    return test::run_program("FURROW_CACHE=" + scratch_.path("cache") + " " + FURROW_SIDEWALL +
                             " " + arguments);
  }
  Scratch scratch_;
};

TEST_F(SidewallCommand, RunWritesTextTableAndFigure) {
  const std::string folder = scratch_.path("tr");
  const Outcome outcome = run("run " + tyres + "p235_75r15.yaml -o " + folder);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(
      outcome.text,
      AllOf(HasSubstr("P235/75 R15 at 241 kPa"), HasSubstr("10 segments, 161 mm; chord 139.6 mm"),
            HasSubstr("32 x 12 x 8 nodes"), HasSubstr("results       " + folder)));
  const Hdf5File h5(folder + "/sidewall.h5", Hdf5File::Mode::read);
  EXPECT_EQ(h5.number_attribute("/", "pressure"), 241e3);
  for (const std::string name : {"deflection", "lateral", "rotation"}) {
    const CsvTable csv = CsvTable::read(folder + "/" + name + ".csv");
    EXPECT_EQ(csv.rows(), 81u);
    for (const std::string& column : csv.names())
      EXPECT_EQ(h5.read_numbers("/" + name + "/" + column), csv.numbers(column));
    const std::vector<double> solved = csv.numbers("F_r"), looked_up = csv.numbers("F_r_table");
    for (std::size_t i = 0; i < solved.size(); ++i)
      EXPECT_NEAR(looked_up[i], solved[i], 1e-4 * std::abs(solved[i]) + 0.1);
    // The column K_rr is minus the slope of F_r where r moves
    const std::vector<double> K = csv.numbers("K_rr"), r = csv.numbers("r");
    if (name != "deflection") continue;
    for (std::size_t i = 30; i + 1 < r.size(); ++i)
      EXPECT_NEAR(-(solved[i + 1] - solved[i - 1]) / (r[i + 1] - r[i - 1]), K[i],
                  0.005 * std::abs(K[i]) + 1e-3 * K[30]);
  }
  EXPECT_EQ(h5.members("/profiles").size(), 6u);
  const std::vector<double> R = h5.read_numbers("/profiles/0/R");
  EXPECT_NEAR(R.front(), 0.208, 1e-12);
  EXPECT_NEAR(R.back(), 0.3475, 1e-12);
  const std::string picture = read_text_file(folder + "/sidewall.png");
  ASSERT_GT(picture.size(), 10000u);
  EXPECT_EQ(picture.substr(1, 3), "PNG");
}

TEST_F(SidewallCommand, EffectiveTyreRepeatsTheRun) {
  for (const char* name : {"p235_75r15.yaml", "generic_195_65r15.yaml"}) {
    ASSERT_EQ(run("run --no-plot -p 150e3 " + tyres + name + " -o " + scratch_.path("a")).status,
              0);
    ASSERT_EQ(
        run("run --no-plot " + scratch_.path("a/tyre.yaml") + " -o " + scratch_.path("b")).status,
        0);
    EXPECT_EQ(read_text_file(scratch_.path("a/deflection.csv")),
              read_text_file(scratch_.path("b/deflection.csv")));
    EXPECT_FALSE(std::filesystem::exists(scratch_.path("a/sidewall.png")));
  }
}

TEST_F(SidewallCommand, KeysAreListed) {
  EXPECT_THAT(run("keys").text, AllOf(HasSubstr("bead_spacing"), HasSubstr("tread_stiffness"),
                                      HasSubstr("N m/rad/m")));
}

TEST_F(SidewallCommand, FailuresNameTheCause) {
  const auto expect_failure = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = run(arguments);
    EXPECT_NE(outcome.status, 0) << arguments;
    EXPECT_THAT(outcome.text, HasSubstr(message));
  };
  expect_failure("run absent.yaml", "furrow-sidewall: absent.yaml does not exist");
  expect_failure("run --no-plot -p -5 " + tyres + "p235_75r15.yaml -o " + scratch_.path("x"),
                 "--pressure: is '-5'; allowed: a number in [0, 2000000] [Pa]");
  expect_failure("run -n 3 " + tyres + "p235_75r15.yaml", "nodes");
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("x")));

  TyreParameters tyre = read_tyre_file(tyres + "p235_75r15.yaml");
  tyre.sidewall.rim_stiffness = tyre.sidewall.tread_stiffness = 100.0;
  write_text_file(scratch_.path("stiff.yaml"), tyre_file_text(tyre));
  expect_failure(
      "run --no-plot -p 2e4 " + scratch_.path("stiff.yaml") + " -o " + scratch_.path("x"),
      "the chain snaps through");
}

}  // namespace
}  // namespace furrow::sidewall_command_test
