// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/point_file.h"

#include <gmock/gmock.h>

#include "furrow/material/point/point_driver.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::point_file_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

class PointFileTest : public ::testing::Test {
 protected:
  PointFileTest() {
    file("ground.yaml", "law: {type: elastic, density: 1000}\nelasticity: {E: 1e6, nu: 0.25}\n");
    file("data.csv", "sigma_Pa,rho,hole_Pa\n1e4,1008,1\n2e4,1017,\n");
  }
  std::string file(const std::string& name, const std::string& text) {
    return scratch_.file(name, text);
  }
  std::string run_refusal(const std::string& text) {
    return scratch_.without_folder(error_of([&] { read_point_run(file("run.yaml", text)); }));
  }
  std::string fit_refusal(const std::string& text) {
    return scratch_.without_folder(error_of([&] { read_point_fit(file("fit.yaml", text)); }));
  }
  Scratch scratch_;
};

TEST_F(PointFileTest, EffectivePathReadsBackAsTheSamePath) {
  for (const std::string path :
       {"{type: hydrostatic, pressure: [1e4, 0]}", "{type: confined, strain: [0.1]}",
        "{type: triaxial, confinement: 1e3, axial_strain: [0.1, 0]}",
        "{type: simple_shear, normal_stress: 1e3, shear: [0.2]}",
        "{type: cyclic, upper: 1e4, cycles: 2}",
        "{type: tension, strain: 0.01, lateral: hydrostatic}",
        "{type: table, steps: 7, rows: [{stress_zz: -1e3}, {strain_xz: 0.1, stress_zz: 0, steps: "
        "3}]}"}) {
    const PointRun first =
        read_point_run(file("run.yaml", "material: ground.yaml\npath: " + path + "\n"));
    const PointRun second =
        read_point_run(file("again.yaml", "material: ground.yaml\n" + first.path_text));
    EXPECT_EQ(first.path_text, second.path_text);
    ASSERT_EQ(first.path.segments.size(), second.path.segments.size()) << path;
    for (std::size_t s = 0; s < first.path.segments.size(); ++s) {
      EXPECT_EQ(first.path.segments[s].control, second.path.segments[s].control);
      EXPECT_EQ(first.path.segments[s].target, second.path.segments[s].target);
      EXPECT_EQ(first.path.segments[s].steps, second.path.segments[s].steps);
    }
  }
}

TEST_F(PointFileTest, BadRunsAreRefusedWithTheirPlace) {
  const std::string head = "material: ground.yaml\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"path: {type: confined, strain: [0.1]}\n", "run.yaml: run, keyword 'material' is missing"},
      {"material: sea.yaml\npath: {type: confined, strain: [0.1]}\n", "sea.yaml does not exist"},
      {head, "run.yaml has no section 'path'"},
      {head + "paths: 1\n", "run.yaml, line 2: run has no keyword 'paths'"},
      {head + "paths: {type: confined}\n",
       "run.yaml, line 2: run has no keyword 'paths'; allowed: title, material, path; did you mean "
       "'path'?"},
      {head + "path: {type: cyclic, upper: 1, cycles: 100000, steps: 100000}\n",
       "run.yaml, line 2: path cyclic has 2e+10 steps in 200000 pieces; allowed: at most 2e+06 in "
       "all"},
      {head + "path: {type: confined, strain: [1e-1], steps: 1e300}\n", "keyword 'steps' is 1e300"},
      {"material: data.csv\npath: {type: confined, strain: [0.1]}\n",
       "data.csv, line 1 is not a map"},
      {"material: ''\npath: {type: confined, strain: [0.1]}\n", "is a folder"},
      {head + "path: {strain: [0.1]}\n",
       "run.yaml, line 2: path, keyword 'type' is missing; allowed: one of: hydrostatic, confined"},
      {head + "path: {type: confine}\n", "run.yaml, line 2: path, keyword 'type' is 'confine'"},
      {head + "path:\n  type: confined\n",
       "run.yaml, line 2: path confined has neither 'stress' nor 'strain'; allowed: exactly one of "
       "stress, strain"},
      {head + "path:\n  type: confined\n  stress: [1]\n  strain: [1]\n",
       "path confined has both 'stress' and 'strain'"},
      {head + "path:\n  type: triaxial\n  confinement: -1\n  axial_strain: [0.1]\n",
       "run.yaml, line 4: path triaxial, keyword 'confinement' is -1; allowed: a number >= 0 [Pa]"},
      {head + "path:\n  type: confined\n  strain: [0.1]\n  steps: 0\n",
       "run.yaml, line 5: path confined, keyword 'steps' is 0; allowed: an integer in [1, "},
      {head + "path:\n  type: cyclic\n  upper: 1\n  lower: 2\n  cycles: 1\n",
       "run.yaml, line 4: path cyclic, keyword 'upper' is 1, not above lower = 2"},
      {head + "path:\n  type: cyclic\n  upper: 1\n  cycles: 1\n  confinement: 3\n",
       "run.yaml, line 6: path cyclic, keyword 'confinement' is given, but the lateral strain is "
       "fixed"},
      {head + "path: {type: table}\n", "run.yaml, line 2 has no list 'rows'"},
      {head + "path:\n  type: table\n  rows: []\n", "run.yaml, line 4: 'rows' is empty"},
      {head + "path:\n  type: table\n  rows:\n    - {strain_zz: 1, stress_zz: 1}\n",
       "run.yaml, line 5: row of path table, keyword 'stress_zz' controls a component whose strain "
       "is given too"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_THAT(run_refusal(text), HasSubstr(message)) << text;
}

TEST_F(PointFileTest, BadFitsAreRefusedWithTheirPlace) {
  const auto fit = [](const std::string& parameters, const std::string& curve) {
    return "material: ground.yaml\nparameters: " + parameters + "\ncurves:\n  - {" + curve + "}\n";
  };
  const std::string e = "[{name: elasticity.E}]";
  const std::string curve =
      "data: data.csv, path: {type: confined}, drive: {stress: sigma_Pa}, compare: {density: rho}";
  EXPECT_EQ(read_point_fit(file("fit.yaml", fit(e, curve))).curves.at(0).measured,
            (std::vector<double>{1008, 1017}));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {fit("[]", curve), "fit.yaml, line 2: 'parameters' is empty"},
      {fit("[{lower: 1}]", curve),
       "fit.yaml, line 2: parameter of a fit, keyword 'name' is missing"},
      {fit(e,
           "data: none.csv, path: {type: confined}, drive: {stress: sigma_Pa}, compare: {density: "
           "rho}"),
       "none.csv does not exist"},
      {fit(e,
           "data: data.csv, path: {type: confined}, drive: {stress: sigma}, compare: {density: "
           "rho}"),
       "has no column 'sigma'; allowed: sigma_Pa, rho, hole_Pa"},
      {fit(e,
           "data: data.csv, path: {type: confined}, drive: {steps: sigma_Pa}, compare: {density: "
           "rho}"),
       "fit.yaml, line 4: 'drive' names 'steps', no list of targets of this path; allowed: stress, "
       "strain"},
      {fit(e,
           "data: data.csv, path: {type: confined}, drive: {stress: hole_Pa}, compare: {density: "
           "rho}"),
       "which has an empty cell"},
      {fit(e,
           "data: data.csv, path: {type: confined}, drive: {stress: sigma_Pa}, compare: {colour: "
           "rho}"),
       "fit.yaml, line 4: law elastic has no channel 'colour'"},
      {fit(e, "data: data.csv, path: {type: confined}, drive: {stress: sigma_Pa}"),
       "fit.yaml, line 4 has no section 'compare'"},
      {fit(e, curve + ", scale: square"),
       "fit.yaml, line 4: curve of a fit, keyword 'scale' is 'square'; allowed: one of: linear, "
       "log"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_THAT(fit_refusal(text), HasSubstr(message)) << text;
}

TEST_F(PointFileTest, ParametersThatCannotBeFittedAreRefusedWithTheirLine) {
  file("sand.yaml",
       "base: " FURROW_SOURCE_DIR "/inputs/materials/mccormick_sand.yaml\nlaw: {beta: 14.56}\n");
  const auto refusal = [&](const std::string& parameter, const std::string& more = "") {
    return fit_refusal("material: sand.yaml\nparameters:\n  - {name: " + parameter +
                       "}\ncurves:\n  - data: data.csv\n    path: {type: confined}\n"
                       "    drive: {stress: sigma_Pa}\n    compare: {density: rho}\n" +
                       more);
  };
  const std::string line = "fit.yaml, line 3: parameter ";
  EXPECT_EQ(refusal("law.beta"), "no error");
  EXPECT_THAT(refusal("law.phi"),
              HasSubstr(line + "'law.phi' is no number of this material; allowed: "));
  EXPECT_THAT(refusal("hardening.p"),
              HasSubstr(line + "'hardening.p' is a list of 9; allowed: hardening.p[1] to "
                               "hardening.p[9]"));
  EXPECT_THAT(refusal("'hardening.p[10]'"), HasSubstr("is beyond the list of 9"));
  EXPECT_THAT(refusal("'hardening.p[0]'"), HasSubstr("has no place in its list"));
  EXPECT_THAT(refusal("hardening.interpolation"), HasSubstr("is no number"));
  EXPECT_THAT(refusal("law.beta, start: 85"), HasSubstr("starts at 85; allowed: a start in"));
  EXPECT_THAT(refusal("law.beta, lower: 90"), HasSubstr("has the bounds 90 and 80"));
  EXPECT_THAT(refusal("law.beta}\n  - {name: law.beta"),
              HasSubstr("fit.yaml, line 4: parameter 'law.beta' is given twice"));
  EXPECT_THAT(refusal("law.beta}\n  - {name: law.d}\n  - {name: law.R"),
              HasSubstr("fit.yaml: fit has 3 parameters for 2 data"));
  file("data.csv", "sigma_Pa,rho\n1e4,1008\n2e4,-1\n");
  EXPECT_THAT(refusal("law.beta", "    scale: log\n"),
              HasSubstr("fit.yaml, line 8 takes column 'rho', which has the value -1 and is "
                        "compared in logarithms"));
  EXPECT_EQ(refusal("law.beta"), "no error");
}

TEST_F(PointFileTest, CurvesOfOnePathAndSampleShareTheirComputation) {
  const std::string drive = "data: data.csv, drive: {stress: sigma_Pa}, path: {type: confined";
  const auto fit = [&](const std::vector<std::string>& curves) {
    std::string text = "material: ground.yaml\nparameters: [{name: elasticity.nu}]\ncurves:\n";
    for (const std::string& curve : curves) text += "  - {" + curve + "}\n";
    return read_point_fit(file("fit.yaml", text));
  };
  const std::vector<std::string> curves = {
      drive + "}, compare: {density: rho}", drive + "}, compare: {p: sigma_Pa}",
      drive + ", steps: 3}, compare: {p: sigma_Pa}",
      "sample: {law.density: 2000}, " + drive + "}, compare: {p: sigma_Pa}",
      "sample: {law.density: 2000}, " + drive + "}, compare: {density: rho}"};
  const PointFit whole = fit(curves);
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_EQ(share_a_path(whole.curves[i], whole.curves[j]), (i == 1 && j == 0) || i + j == 7)
          << i << j;
  std::vector<double> apart;
  for (const std::string& curve : curves) {
    const PointFit one = fit({curve, drive + "}, compare: {density: rho}"});
    const std::vector<double> values = curves_of(one, sections_with(one, {"0.25"}));
    apart.insert(apart.end(), values.begin(), values.begin() + 2);
  }
  EXPECT_EQ(curves_of(whole, sections_with(whole, {"0.25"})), apart);
}

TEST_F(PointFileTest, SampleParametersChangeOnlyTheirCurve) {
  const auto fit = [&](const std::string& sample) {
    const std::string curve =
        "data: data.csv, path: {type: confined}, drive: {stress: sigma_Pa}, compare: {density: "
        "rho}";
    return "material: ground.yaml\nparameters: [{name: elasticity.nu}]\ncurves:\n  - {" + curve +
           "}\n  - {sample: {" + sample + "}, " + curve + "}\n";
  };
  const PointFit read = read_point_fit(file("fit.yaml", fit("law.density: 2000")));
  const std::vector<double> densities = curves_of(read, sections_with(read, {"0.25"}));
  ASSERT_EQ(densities.size(), 4u);
  EXPECT_DOUBLE_EQ(densities[2] / densities[0], 2.0);
  EXPECT_DOUBLE_EQ(densities[3] / densities[1], 2.0);

  EXPECT_THAT(fit_refusal(fit("law.beta: 20")),
              HasSubstr("sample, 'law.beta' is no number of this material; allowed: "));
  EXPECT_THAT(fit_refusal(fit("elasticity.nu: 0.1")),
              HasSubstr("sample, 'elasticity.nu' is a parameter of the fit"));
  EXPECT_THAT(fit_refusal(fit("law.density: [1, 2]")),
              HasSubstr("sample, 'law.density' has 2 values; allowed: one number"));
  EXPECT_THAT(fit_refusal(fit("law.density: -1")), HasSubstr("fit.yaml, line 5: "));
}

}  // namespace
}  // namespace furrow::point_file_test
