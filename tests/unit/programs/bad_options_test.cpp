// SPDX-License-Identifier: GPL-2.0-or-later
// Wrong options of the command-line programs: each is refused with status 1 in one line that names
// the option and what is allowed, before anything is computed.
#include <sstream>

#include <gmock/gmock.h>

#include "../io/scratch.h"
#include "furrow/io/results/history_file.h"
#include "furrow/io/files/replace_file.h"
#include "tests/support/program.h"

namespace furrow::bad_options_test {
namespace {

using test::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Case {
  std::string arguments, message;
};

/// Lines that begin with the name of a program; furrow-tyre prints the head of its table as well.
int messages(const std::string& text) {
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line);) count += line.rfind("furrow-", 0) == 0 ? 1 : 0;
  return count;
}

template <class Cases>
void expect_refusals(const std::string& program, const Cases& cases) {
  for (const Case& bad : cases) {
    const Outcome outcome = test::run_program(program + " " + bad.arguments);
    EXPECT_TRUE(outcome.ended) << bad.arguments << "\n" << outcome.text;
    EXPECT_EQ(outcome.status, 1) << bad.arguments;
    EXPECT_EQ(messages(outcome.text), 1) << bad.arguments << "\n" << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr(bad.message), Not(HasSubstr("terminate called"))))
        << bad.arguments;
  }
}

const std::string inputs = FURROW_SOURCE_DIR "/inputs/";

TEST(BadOptions, FurrowTyreRefusesFaultyOptions) {
  const Scratch scratch;
  write_text_file(scratch.path("taken"), "");
  const std::string tyre = inputs + "tyres/p235_75r15.yaml --mesh 4 36 ";
  const std::string bricks = inputs + "tyres/p235_75r15_smooth.yaml ";
  const Case cases[] = {
      {"", "file is required"},
      {"fit 15 --pressure 241 -o " + scratch.path("new.yaml"), "'15' is no size designation"},
      {"absent.yaml", "absent.yaml does not exist; allowed: a YAML file"},
      {inputs, "is a folder; allowed: a YAML file"},
      {inputs + "materials/fresh_snow.yaml", "it looks like a material file"},
      {tyre + "--load nan", "--load: is 'nan'; allowed: a number > 0 [N]"},
      {tyre + "--load -500", "--load: is '-500'; allowed: a number > 0 [N]"},
      {tyre + "--load 0", "--load: is '0'; allowed: a number > 0 [N]"},
      {tyre + "--load 4kN", "--load: is '4kN'; allowed: a number > 0 [N]"},
      {tyre + "--load 1e12",
       "--load, at 241 kPa, is 1e+12 N; allowed: a number in [37.2082, 37208.2] [N], up to width "
       "times diameter"},
      {tyre + "--load 6.2",
       "--load, at 241 kPa, is 6.2 N; allowed: a number in [37.2082, 37208.2]"},
      {tyre + "--load 3000 --load 1e400", "--load: is '1e400'"},
      {tyre + "--pressure 241000", "--pressure: is '241000'; allowed: a number in [0, 2000] [kPa]"},
      {tyre + "--pressure -1", "--pressure: is '-1'; allowed: a number in [0, 2000] [kPa]"},
      {tyre + "--pressure inf", "--pressure: is 'inf'"},
      {tyre + "--tolerance 0", "--tolerance: is '0'; allowed: a number in [1e-09, 0.1]"},
      {tyre + "--tolerance nan", "--tolerance: is 'nan'"},
      {tyre + "--friction -0.1", "--friction: is '-0.1'; allowed: a number in [0, 5]"},
      {tyre + "--friction 50", "--friction: is '50'; allowed: a number in [0, 5]"},
      {tyre + "--unknown", "furrow-tyre: The following argument was not expected: --unknown; see"},
      {tyre + "--rim-stiffness -5", "--rim-stiffness: is '-5'; allowed: a number >= 0 [N m/rad/m]"},
      {tyre + "--tread-stiffness nan", "--tread-stiffness: is 'nan'"},
      {tyre + "--link 20 0", "--link: is '20'; allowed: a number in [-1, 1] [m]"},
      {tyre + "--link 0.01", "--link"},
      {tyre + "--folder /proc/x", "/proc/x: cannot be made as a folder ("},
      {tyre + "--folder " + scratch.path("taken"), "taken: cannot be made as a folder ("},
      {tyre + "--mass 3", "--mass"},
      {tyre + "--modes 5", "--modes requires --folder"},
      {tyre + "--modes 0 --folder " + scratch.path("modes"), "--modes: is '0'"},
      {tyre + "--modes 5 --half --folder " + scratch.path("modes"), "--half excludes --modes"},
      {tyre + "--no-plot", "--no-plot requires --modes"},
      {inputs + "tyres/p235_75r15.yaml --mesh 4", "--mesh"},
      {inputs + "tyres/p235_75r15.yaml --mesh 4 2.5", "--mesh"},
      {inputs + "tyres/p235_75r15.yaml --mesh 4 99999",
       "elements around is 99999; allowed: an integer in [12, 2000]"},
      {inputs + "tyres/p235_75r15.yaml --mesh -1 36", "elements across is -1; allowed: an integer"},
      {inputs + "tyres/p235_75r15.yaml --sections 60",
       "--sections is given for a tyre without a tread of bricks, which has no such thing; "
       "allowed: --mesh for its mesh; leave it out"},
      {bricks + "--mesh 6 72", "--mesh is given for a tyre with a tread of bricks"},
      {bricks + "--direct", "--direct is given for a tyre with a tread of bricks"},
      {bricks + "--rim-stiffness 10", "--rim-stiffness is given for a tyre with a tread of bricks"},
      {bricks + "--tread-stiffness 10", "--tread-stiffness is given for a tyre with"},
      {bricks + "--link 0 0", "--link is given for a tyre with a tread of bricks"}};
  expect_refusals(FURROW_TYRE, cases);
}

TEST(BadOptions, FurrowSidewallRefusesFaultyOptions) {
  const Scratch scratch;
  write_text_file(scratch.path("taken"), "");
  const std::string run = "run --no-plot " + inputs + "tyres/p235_75r15.yaml ";
  const Case cases[] = {
      {"", "needs one of the commands run or keys"},
      {"run", "file is required"},
      {"bend", "not expected: bend"},
      {run + "-p nan", "--pressure: is 'nan'; allowed: a number in [0, 2000000] [Pa]"},
      {run + "-p 1e9", "--pressure: is '1e9'; allowed: a number in [0, 2000000] [Pa]"},
      {run + "-n 1000", "--nodes: Value 1000 not in range"},
      {"run --no-plot " + inputs + "points/fit_foam.yaml",
       "it looks like a point file with curves"}};
  expect_refusals("FURROW_CACHE=" + scratch.path("cache") + " " FURROW_SIDEWALL, cases);
}

TEST(BadOptions, FurrowPointRefusesFaultyOptions) {
  const Scratch scratch;
  const std::string run = inputs + "points/mccormick_confined.yaml";
  const Case cases[] = {
      {"fit " + run, "it looks like a point file with a path to drive"},
      {"run " + inputs + "points/fit_abele_gow.yaml",
       "it looks like a point file with curves to fit"},
      {"run " + inputs + "materials/fresh_snow.yaml", "it looks like a material file"},
      {"run " + inputs, "is a folder"},
      {"run --no-plot -o /proc/x " + run, "/proc/x: cannot be made as a folder ("},
      {"run --no-plott " + run, "--no-plott"},
      {"laws > /dev/full", "furrow-point: the standard output cannot be written"}};
  expect_refusals(FURROW_POINT, cases);

  write_text_file(scratch.path("p.yaml"),
                  "material: " + inputs +
                      "materials/compacted_sand_elastic.yaml\npath: {type: tension, strain: 19}\n");
  const Outcome strained = test::run_program(FURROW_POINT " run --no-plot -o " +
                                             scratch.path("out") + " " + scratch.path("p.yaml"));
  EXPECT_EQ(strained.status, 0);
  EXPECT_THAT(strained.text, HasSubstr("p.yaml: segment 1 comes to a logarithmic strain zz of 19"));
}

TEST(BadOptions, FurrowResistanceRefusesFaultyOptions) {
  const Scratch scratch;
  {
    HistoryFile file = HistoryFile::create(scratch.path("history.h5"),
                                           {{"time", "s", ""}, {"x", "m", ""}}, RunInfo());
    for (int i = 0; i < 10; ++i) file.append({0.1 * i, 0.05 * i});
  }
  std::filesystem::create_directory(scratch.path("text"));
  write_text_file(scratch.path("text/history.h5"), "no HDF5");
  const std::string folder = scratch.folder();
  const Case cases[] = {
      {"", "results is required"},
      {"absent", "absent: has no history.h5; name the results folder of a run"},
      {scratch.path("text"), "history.h5: cannot open as an HDF5 file"},
      {folder + " " + folder + "/.", "are one folder; give each folder once"},
      {"--together " + folder + " " + folder, "are one folder; give each folder once"},
      {folder + " --window nan 1", "--window: is 'nan'; allowed: any finite number [s]"},
      {folder + " --window 1", "--window"},
      {folder + " --window 0 1 --distance 0 1", "--window"},
      {folder + " --window 0.5 0.2",
       "the window by time is 0.5 to 0.2 s; allowed: a part of 0 to 0.9 s, the begin before the "
       "end"},
      {folder + " --window 0 100", "the window by time is 0 to 100 s; allowed: a part of"},
      {folder + " --distance -3 1", "the window by distance is -3 to 1 m; allowed: a part of"}};
  expect_refusals(FURROW_RESISTANCE, cases);
}

}  // namespace
}  // namespace furrow::bad_options_test
