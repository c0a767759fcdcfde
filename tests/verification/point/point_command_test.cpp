// SPDX-License-Identifier: GPL-2.0-or-later
/// The program furrow-point as a user runs it.

#include <filesystem>

#include <gmock/gmock.h>

#include "../../unit/io/scratch.h"
#include "furrow/io/formats/csv_file.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/inputs/point_file.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/files/version.h"
#include "tests/support/program.h"

namespace furrow::point_command_test {
namespace {

using test::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;

Outcome furrow_point(const std::string& arguments) {
  return test::run_program(std::string(FURROW_POINT) + " " + arguments);
}

const std::string points = std::string(FURROW_SOURCE_DIR) + "/inputs/points/";

void expect_png(const std::string& path) {
  const std::string content = read_text_file(path);
  ASSERT_GT(content.size(), 10000u) << path;
  EXPECT_EQ(content.substr(1, 3), "PNG");
}

TEST(PointCommand, ResultFilesOfARunAgree) {
  const Scratch scratch;
  const std::string folder = scratch.path("triaxial");
  const Outcome outcome = furrow_point("run " + points + "mccormick_triaxial.yaml -o " + folder);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("reached       p = 1.531 MPa, q = 1.592 MPa"),
                                  HasSubstr("step error"), HasSubstr("updates       elastic ")));
  const CsvTable csv = CsvTable::read(folder + "/point.csv");
  EXPECT_EQ(csv.rows(), 801u);
  // (d + sigma_c tan(beta))/(1 - tan(beta)/3)
  EXPECT_NEAR(csv.numbers("q").back(), 1.59153e6, 10.0);
  const Hdf5File h5(folder + "/point.h5", Hdf5File::Mode::read);
  for (const std::string& name : csv.names())
    EXPECT_EQ(h5.read_numbers("/point/" + name), csv.numbers(name)) << name;
  EXPECT_EQ(h5.text_attribute("/point/q", "unit"), "Pa");
  EXPECT_EQ(h5.members("/yield_surface").size(), 3u);
  expect_png(folder + "/point.png");
}

TEST(PointCommand, EffectiveInputRepeatsTheRun) {
  const Scratch scratch;
  ASSERT_EQ(
      furrow_point("run --no-plot " + points + "snow_rut.yaml -o " + scratch.path("a")).status, 0);
  ASSERT_EQ(furrow_point("run --no-plot " + scratch.path("a/run.yaml") + " -o " + scratch.path("b"))
                .status,
            0);
  EXPECT_EQ(read_text_file(scratch.path("a/point.csv")),
            read_text_file(scratch.path("b/point.csv")));
  EXPECT_FALSE(std::filesystem::exists(scratch.path("a/point.png")));
}

/// Every shipped path runs to its end.
TEST(PointCommand, AllShippedPathsRun) {
  int runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(points)) {
    if (entry.path().stem().string().rfind("fit_", 0) == 0) continue;
    const Scratch scratch;
    const Outcome outcome =
        furrow_point("run --no-plot " + entry.path().string() + " -o " + scratch.path("r"));
    EXPECT_EQ(outcome.status, 0) << entry.path() << outcome.text;
    EXPECT_THAT(outcome.text, ::testing::Not(HasSubstr("nan")));
    ++runs;
  }
  EXPECT_GE(runs, 9);
}

/// furrow-post makes the fit; tests/unit/postproc/laws/law_fit_test.py checks its numbers.
TEST(PointCommand, FitWritesAMaterialFileAndAFigure) {
  const Scratch scratch;
  const std::string folder = scratch.path("fit");
  const Outcome outcome = furrow_point("fit " + points + "fit_mccormick.yaml -o " + folder);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr(read_text_file(folder + "/report.txt")));
  const MaterialFile fitted = read_material_file(folder + "/material.yaml");
  const MaterialOptions options = read_sections(fitted.model, fitted.sections);
  const Hdf5File h5(folder + "/fit.h5", Hdf5File::Mode::read);
  EXPECT_DOUBLE_EQ(options.at("hardening").options.number("pc0"),
                   h5.number_attribute("/parameters/hardening.pc0", "value"));
  expect_png(folder + "/fit.png");
}

TEST(PointCommand, ListsLawsAndPathsFromTheirDeclarations) {
  const Outcome all = furrow_point("laws");
  EXPECT_EQ(all.status, 0);
  for (const MaterialModel& material : material_models()) {
    EXPECT_THAT(all.text, HasSubstr(material.name + ": " + material.meaning));
    for (const SectionSchema& section : material.sections)
      for (const SectionChoice& choice : section.choices)
        EXPECT_THAT(all.text, HasSubstr(choice.schema.table()));
  }
  EXPECT_THAT(furrow_point("laws elastic").text,
              AllOf(HasSubstr("Young's modulus"), ::testing::Not(HasSubstr("cohesion"))));
  EXPECT_THAT(furrow_point("paths").text,
              AllOf(HasSubstr("path triaxial: "), HasSubstr("strain_xx"), HasSubstr("deviation")));
  EXPECT_THAT(furrow_point("--version").text, HasSubstr(version()));
}

TEST(PointCommand, FailuresHaveTheirMessageAndStatus) {
  const Scratch scratch;
  const auto file = [&](const std::string& text) { return scratch.file("bad.yaml", text); };
  const std::string out = " -o " + scratch.path("r");
  const auto expect_failure = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = furrow_point(arguments);
    EXPECT_NE(outcome.status, 0) << arguments;
    EXPECT_THAT(outcome.text, HasSubstr(message));
  };
  const std::string snow =
      "material: " + std::string(FURROW_SOURCE_DIR) + "/inputs/materials/fresh_snow.yaml\n";
  expect_failure(
      "",
      "needs one of the commands run, fit, curves, channels, table, laws, show, usual or paths");
  expect_failure("run", "file is required");
  expect_failure("run absent.yaml", "furrow-point: absent.yaml does not exist");
  expect_failure("run " + file("") + out, "bad.yaml is empty");
  expect_failure("run " + file("material: none.yaml\npath: {type: confined, strain: [1]}\n") + out,
                 "none.yaml does not exist");
  expect_failure("run " + file(snow + "path: {type: bending}\n") + out,
                 "bad.yaml, line 2: path, keyword 'type' is 'bending'");
  expect_failure("run " + file(snow + "path: {type: hydrostatic, pressure: [-1e6]}\n") + out,
                 "path hydrostatic, segment 1, step ");
  expect_failure("fit " + file(snow) + out, "has no list 'parameters'");
  expect_failure("laws granite", "has the unknown law 'granite'; allowed: ");
  EXPECT_FALSE(std::filesystem::exists(scratch.path("r")));  // nothing is left of a refused run
  write_text_file(scratch.path("taken"), "");
  expect_failure("run --no-plot " + points + "mccormick_confined.yaml -o " + scratch.path("taken"),
                 "taken: cannot be made as a folder");
}

}  // namespace
}  // namespace furrow::point_command_test
