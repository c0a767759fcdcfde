// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/material_file.h"

#include <gmock/gmock.h>

#include "furrow/io/inputs/contact_section.h"
#include "furrow/io/formats/csv_file.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/formats/yaml_tree.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::material_file_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Line 1 is the first of the text.
const std::string sand =
    "title: Sand\n"                                     // 1
    "law:\n"                                            // 2
    "  type: drucker_prager_cap\n"                      // 3
    "  density: 1800\n"                                 // 4
    "  d: 1.194e6\n"                                    // 5
    "  beta: 14.56\n"                                   // 6
    "  R: 0.1\n"                                        // 7
    "  K: 1\n"                                          // 8
    "elasticity: {type: linear, E: 689e6, nu: 0.25}\n"  // 9
    "hardening:\n"                                      // 10
    "  type: table\n"                                   // 11
    "  p: [0.138e6, 0.172e6, 0.434e6]\n"                // 12
    "  eps_vol_pl: [0, 0.005, 0.01]\n"                  // 13
    "  interpolation: linear\n"                         // 14
    "  beyond: extrapolate\n";                          // 15

class MaterialFileTest : public ::testing::Test {
 protected:
  std::string file(const std::string& text, const std::string& name = "sand.yaml") {
    return scratch_.file(name, text);
  }
  /// Text of a shipped material, to be written to another folder.
  static std::string shipped(const std::string& name) {
    const std::string folder = FURROW_SOURCE_DIR "/inputs/materials/";
    return with(read_text_file(folder + name + ".yaml"), "contact: ", "contact: " + folder);
  }
  std::string refusal(const std::string& text) {
    return scratch_.without_folder(error_of([&] { read_material_file(file(text)); }));
  }
  Scratch scratch_;
};

TEST_F(MaterialFileTest, FileGivesTheLawOfTheRegistry) {
  const MaterialFile read = read_material_file(file(sand));
  EXPECT_EQ(read.title, "Sand");
  EXPECT_EQ(read.model.name, "drucker_prager_cap");
  const auto material = read.make();
  EXPECT_EQ(material->density(), 1800.0);
  EXPECT_DOUBLE_EQ(material->moduli(material->initial_state()).bulk, 689e6 / 1.5);
  EXPECT_DOUBLE_EQ(material->yield_surface(material->initial_state()).back().x(), 0.138e6);
  EXPECT_EQ(load_material(file(sand))->name(), "drucker_prager_cap");
}

/// As inputs/materials/contact/sand.yaml.
const std::string of_rubber =
    "rubber:\n"
    "  friction: 0.41\n"
    "  friction_range: [0.38, 0.45]\n"
    "  slip_length: 0.009\n"
    "  slip_length_range: [0.006, 0.012]\n"
    "  label: estimated\n"
    "  source: three soils\n";

TEST_F(MaterialFileTest, ContactIsReadFromItsFileOrSection) {
  EXPECT_TRUE(read_material_file(file(sand)).contact.empty());
  file(of_rubber, "rubber.yaml");
  file(sand + "contact: rubber.yaml\n", "base.yaml");
  for (const std::string& text :
       {sand + "contact: rubber.yaml\n", std::string("base: base.yaml\n")}) {
    const GroundContact contact = read_material_file(file(text)).contact;
    ASSERT_EQ(contact.count("rubber"), 1u);
    EXPECT_EQ(contact.at("rubber").friction, 0.41);
    EXPECT_EQ(contact.at("rubber").slip_length, 0.009);
    EXPECT_EQ(contact.at("rubber").slip_length_range[1], 0.012);
    EXPECT_EQ(contact.at("rubber").label, "estimated");
    EXPECT_FALSE(std::isfinite(contact.at("rubber").shear_limit));
  }
  file(of_rubber + "  shear_limit: 15e3\n  shear_limit_range: [1e4, 16e3]\n", "rubber.yaml");
  const GroundContact clay = read_material_file(file(sand + "contact: rubber.yaml\n")).contact;
  EXPECT_EQ(clay.at("rubber").shear_limit, 15e3);
  EXPECT_EQ(clay.at("rubber").shear_limit_range[0], 1e4);
}

TEST_F(MaterialFileTest, ConeIndexIsNotInheritedFromABase) {
  EXPECT_FALSE(read_material_file(file(sand)).cone_index);
  EXPECT_EQ(read_material_file(file(sand + "cone_index: 131e3\n", "base.yaml")).cone_index, 131e3);
  EXPECT_FALSE(read_material_file(file("base: base.yaml\nlaw: {density: 1700}\n")).cone_index);
  EXPECT_EQ(read_material_file(file("base: base.yaml\ncone_index: 2e5\n")).cone_index, 2e5);
}

TEST_F(MaterialFileTest, ConeIndexInOtherUnitsIsRefusedOrWarnedOf) {
  EXPECT_THAT(refusal(sand + "cone_index: 0\n"),
              AllOf(HasSubstr("line 16"), HasSubstr("cone_index"), HasSubstr("> 0")));
  EXPECT_THAT(refusal(sand + "cone_index: {value: 1e5}\n"), HasSubstr("line 16"));
  const auto warnings = read_material_file(file(sand + "cone_index: 131\n")).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], AllOf(HasSubstr("line 16"), HasSubstr("kPa times 1000")));
  // the warnings about the law stay
  const auto both =
      read_material_file(file(with(sand, "E: 689e6", "E: 689") + "cone_index: 131\n"));
  EXPECT_GE(both.warnings.size(), 2u);
}

TEST_F(MaterialFileTest, RefusesContactInOtherUnits) {
  const auto refused = [&](const std::string& old, const std::string& now) {
    file(with(of_rubber, old, now), "rubber.yaml");
    return refusal(sand + "contact: rubber.yaml\n");
  };
  EXPECT_THAT(refused("friction: 0.41", "friction: 22"), HasSubstr("keyword 'friction' is 22"));
  EXPECT_THAT(refused("slip_length: 0.009", "slip_length: 9"), HasSubstr("'slip_length' is 9"));
  EXPECT_THAT(refused("slip_length: 0.009", "slip_length: 0.09"),
              HasSubstr("is [0.006, 0.012], and slip_length is 0.09"));
  EXPECT_THAT(refused("label: estimated", "label: guess"),
              HasSubstr("measured, estimated, assumed"));
  EXPECT_THAT(refused("rubber:", "wood:"), HasSubstr("'wood'"));
  EXPECT_THAT(refused("  label", "  shear_limit: 15\n  shear_limit_range: [20, 30]\n  label"),
              HasSubstr("is [20, 30], and shear_limit is 15"));
  EXPECT_THAT(refused("  label", "  shear_limit: 15e3\n  label"), HasSubstr("both or none"));
}

/// A copy of a material that leaves its contact behind, also as the base of another.
TEST_F(MaterialFileTest, RefusesContactFileThatIsAbsent) {
  const std::string fault =
      "sand.yaml, line 16: keyword 'contact' names the file absent.yaml, which is not there; "
      "allowed: a file next to this one, or a section with a part for each material of a body; "
      "copy the contact file along with this one, or remove the line";
  EXPECT_THAT(refusal(sand + "contact: absent.yaml\n"), HasSubstr(fault));
  file("base: sand.yaml\n", "over.yaml");
  EXPECT_THAT(
      scratch_.without_folder(error_of([&] { read_material_file(scratch_.path("over.yaml")); })),
      HasSubstr(fault));
}

TEST_F(MaterialFileTest, EffectiveValuesReadBackAsTheSameLaw) {
  const MaterialFile first = read_material_file(file(with(sand, "Sand", "\"Shoop's sand: # 1\"")));
  EXPECT_EQ(first.title, "Shoop's sand: # 1");
  const std::string text = material_file_text("it's: # sand", first.model, first.options);
  EXPECT_THAT(text, AllOf(HasSubstr("alpha: 0"),
                          HasSubstr("beta: 14.56  # [degree] slope of the shear line"),
                          HasSubstr("p: [0.138e6, 0.172e6, 0.434e6]  # [Pa]")));
  const MaterialFile second = read_material_file(file(text, "written.yaml"));
  EXPECT_EQ(second.title, "it's: # sand");
  EXPECT_EQ(material_file_text("it's: # sand", second.model, second.options), text);
}

TEST_F(MaterialFileTest, VariantGivesOnlyTheDifferences) {
  file(sand);
  const MaterialFile variant =
      read_material_file(file("base: sand.yaml\nlaw: {d: 5e3}\n", "variant.yaml"));
  const MaterialFile base = read_material_file(file(sand));
  EXPECT_EQ(variant.title, "Sand");
  EXPECT_EQ(material_file_text("", variant.model, variant.options),
            with(material_file_text("", base.model, base.options), "d: 1.194e6", "d: 5e3"));
  // A section of another type replaces the base's whole: no table keys are left in it.
  const MaterialFile other =
      read_material_file(file("base: variant.yaml\ntitle: other\nhardening: {type: exponential, "
                              "pc0: 1e5, lambda: 0.1, kappa: 0, e0: 0.5}\n",
                              "other.yaml"));
  EXPECT_EQ(other.title, "other");
  const std::string text = material_file_text("", other.model, other.options);
  EXPECT_THAT(text, AllOf(HasSubstr("d: 5e3"), HasSubstr("pc0: 1e5"),
                          ::testing::Not(HasSubstr("interpolation"))));
}

/// Each message says file, line and key, what is allowed, and what to do where that is not plain.
TEST_F(MaterialFileTest, BadFilesAreRefusedWithTheirPlace) {
  struct Case {
    std::string text, message;
  };
  const std::vector<Case> cases = {
      {"", "sand.yaml is empty; allowed: a YAML file"},
      {"# only a comment\n", "sand.yaml is empty"},
      {"law: [1, 2\n", "is not YAML"},
      {"- 1\n- 2\n", "sand.yaml, line 1 is not a map"},
      {"title: Sand\n", "sand.yaml has no section 'law'"},
      {"law: elastic\n", "sand.yaml, line 1: 'law' is not a section of keys"},
      {with(sand, "drucker_prager_cap", "drucker_prager_kap"),
       "sand.yaml, line 3 has the unknown law 'drucker_prager_kap'; allowed: one of: "},
      {with(sand, "  type: drucker_prager_cap\n", ""),
       "sand.yaml, line 2: keyword 'type' is missing"},
      {with(sand, "  d: 1.194e6\n", ""),
       "sand.yaml, line 2: law drucker_prager_cap, keyword 'd' is missing; allowed: a number in "
       "[0, 1000000000] [Pa]; it is: cohesion"},
      {with(sand, "K: 1", "K: 0.77"),
       "sand.yaml, line 8: law drucker_prager_cap, keyword 'K' is 0.77: the section would not be "
       "convex; allowed: a number in [0.778, 1] for section abaqus"},
      {with(sand, "d: 1.194e6", "d: -1"),
       "sand.yaml, line 5: law drucker_prager_cap, keyword 'd' is -1; allowed: a number in [0, "
       "1000000000] [Pa]"},
      {with(sand, "d: 1.194e6", "d: 1.194e12"),
       "keyword 'd' is 1.194e12; allowed: a number in [0, "},
      {with(sand, "[0, 0.005, 0.01]", "[0.138e6, 0.172e6, 0.434e6]"),
       "hardening table, keyword 'eps_vol_pl' is 0.138e6; allowed: a list of numbers, each in [-5, "
       "5]"},
      {with(with(sand, "type: table", "type: by_density"), "eps_vol_pl: [0, 0.005, 0.01]",
            "rho: [113.76, 20.65e3, 1156.4e3]"),
       "hardening by_density, keyword 'rho' is 20.65e3; allowed: a list of numbers, each in (0, "
       "5000]"},
      {with(sand, "d: 1.194e6", "d: soft"),
       "sand.yaml, line 5: law drucker_prager_cap, keyword 'd' is 'soft', which is not a number"},
      {with(sand, "d: 1.194e6", "d: nan"),
       "sand.yaml, line 5: law drucker_prager_cap, keyword 'd' is nan"},
      {with(sand, "d: 1.194e6", "d: .nan"),
       "sand.yaml, line 5: law drucker_prager_cap, keyword 'd' is '.nan', which is not a number"},
      {with(sand, "d: 1.194e6", "d: inf"),
       "sand.yaml, line 5: law drucker_prager_cap, keyword 'd' is inf"},
      {with(sand, "d: 1.194e6", "d:"), "sand.yaml, line 5: keyword 'd' has no value"},
      {with(sand, "d: 1.194e6", "d: [1, 2]"),
       "sand.yaml, line 5: law drucker_prager_cap, keyword 'd' has 2 value(s)"},
      {with(sand, "d: 1.194e6", "d: {a: 2}"),
       "sand.yaml, line 5: keyword 'd' is a section; allowed: a value or a list"},
      {with(sand, "  K: 1\n", "  K: 1\n  d: 5\n"), "sand.yaml, line 9: keyword 'd' is given twice"},
      {with(sand, "  beta: 14.56", "  betta: 14.56"),
       "sand.yaml, line 6: law drucker_prager_cap has no keyword 'betta'; allowed: density, d, "
       "beta"},
      {with(sand, "  beta: 14.56", "  betta: 14.56"), "did you mean 'beta'?"},
      {with(sand, "elasticity:", "elastisity:"),
       "sand.yaml, line 9 has the section 'elastisity', which law drucker_prager_cap does not "
       "have"},
      {with(sand, "elasticity: {type: linear, E: 689e6, nu: 0.25}\n", ""),
       "sand.yaml: elasticity linear, keyword 'E' is missing"},
      {with(sand, "nu: 0.25", "nu: 0.5"),
       "sand.yaml, line 9: elasticity linear, keyword 'nu' is 0.5; allowed: a number in (-1, 0.5)"},
      {with(sand, "type: table", "type: spline"),
       "sand.yaml, line 11: section 'hardening', keyword 'type' is 'spline'; allowed: one of: "
       "table, by_density, exponential"},
      {with(sand, "interpolation: linear", "interpolation: cubic"),
       "sand.yaml, line 14: hardening table, keyword 'interpolation' is 'cubic'; allowed: one of: "
       "linear, log"},
      {with(sand, "0.172e6, 0.434e6", "0.434e6, 0.172e6"),
       "sand.yaml, line 12: hardening table, keyword 'p' does not increase: row 2 is 434000, row 3 "
       "is 172000"},
      {with(sand, "0.005, 0.01", "0.005, 0.005"),
       "sand.yaml, line 13: hardening table, keyword 'eps_vol_pl' does not increase"},
      {with(sand, "0.005, 0.01", "0.005"),
       "sand.yaml, line 13: hardening table, keyword 'eps_vol_pl' has 2 values for 3 of 'p'"},
      {with(sand, "[0, 0.005, 0.01]", "[0, [0.005], 0.01]"),
       "sand.yaml, line 13: keyword 'eps_vol_pl' is not a list of plain values"},
      {with(sand, "[0, 0.005, 0.01]", "[0, , 0.01]"), "sand.yaml, line 13"},
      {with(sand, "  K: 1\n", "  K: 1\n  eps_vol_pl_0: 0.5\n"),
       "sand.yaml, line 9: law drucker_prager_cap, keyword 'eps_vol_pl_0' is 0.5, outside the "
       "hardening data"},
      {"base: nothing.yaml\n", "sand.yaml, line 1: base: nothing.yaml does not exist"},
      {"base: ''\n", "is a folder"},
      {"base: [a, b]\n", "sand.yaml, line 1: keyword 'base' is not a word"},
      {"title: a\nbase: sand.yaml\n",
       "sand.yaml, line 2: base leads back to sand.yaml: sand.yaml -> sand.yaml; allowed: a base "
       "that does not need this file"},
      {"base: ./../" + std::filesystem::path(scratch_.folder()).filename().string() +
           "/sand.yaml\n",
       "sand.yaml, line 1: base leads back to sand.yaml"},
      {sand + "---\n" + sand, "sand.yaml, line 17 begins a second document"},
      {with(sand, "law:", "lay:"),
       "sand.yaml has no section 'law'; allowed: the section 'law' with the law's name as 'type'"},
      {with(sand, "hardening:", "hardning:"), "did you mean 'hardening'?"},
      {with(sand, "drucker_prager_cap", "druker_prager_cap"),
       "has the unknown law 'druker_prager_cap'; allowed: one of: "},
      {with(sand, "drucker_prager_cap", "druker_prager_cap"), "did you mean 'drucker_prager_cap'?"},
      {with(sand, "  d: 1.194e6\n", "  cohesion: {value: 1.194e6}\n"),
       "sand.yaml, line 5: law drucker_prager_cap has no keyword 'cohesion'; allowed: density, d"},
      {with(sand, "d: 1.194e6", "d: 1e400"),
       "keyword 'd' is '1e400', which is too large for a number"},
      {with(sand, "d: 1.194e6", "d: 1.194 MPa"),
       "keyword 'd' is '1.194 MPa', which is not a number; allowed: a number in [0, "
       "1000000000] [Pa]"},
      {with(sand, "d: 1.194e6", "d: 1,194"), "keyword 'd' is '1,194', which is not a number"},
      {with(sand, "density: 1800", "density: 1e30"),
       "sand.yaml: law drucker_prager_cap has a density of 1e+30 kg/m3; allowed: a number in"},
      {with(sand, "E: 689e6", "E: 1e-30"),
       "sand.yaml: law drucker_prager_cap has a stiffness at rest of 1.2e-30 Pa"},
      {with(sand, "nu: 0.25", "nu: 0.4999999999"),
       "(Poisson's ratio 0.4999999999); allowed: a ratio in [0.001, 10000]"},
  };
  for (const Case& bad : cases) EXPECT_THAT(refusal(bad.text), HasSubstr(bad.message)) << bad.text;
  EXPECT_THAT(error_of([&] { read_material_file(scratch_.path("absent.yaml")); }),
              HasSubstr("absent.yaml does not exist; allowed: a YAML file"));
}

TEST_F(MaterialFileTest, CircularBasesAreRefusedWithTheirChain) {
  file("base: b.yaml\n", "a.yaml");
  file("base: c.yaml\n", "b.yaml");
  file("base: a.yaml\n", "c.yaml");
  EXPECT_THAT(
      error_of([&] { read_material_file(scratch_.path("a.yaml")); }),
      ::testing::ContainsRegex("c.yaml, line 1: base leads back to [^ ]*a.yaml: [^ ]*a.yaml -> "
                               "[^ ]*b.yaml -> [^ ]*c.yaml -> [^ ]*a.yaml"));
  for (int n = 0; n < 12; ++n)
    file("base: " + std::to_string(n + 1) + ".yaml\n", std::to_string(n) + ".yaml");
  EXPECT_THAT(
      error_of([&] { read_material_file(scratch_.path("0.yaml")); }),
      HasSubstr("8.yaml, line 1: base is the base of 9 files; allowed: 8 one after the other"));
}

TEST_F(MaterialFileTest, UnusualValuesAreReadWithAWarning) {
  EXPECT_THAT(read_material_file(file(sand)).warnings, ::testing::IsEmpty());
  const std::string text = with(sand, "density: 1800", "density: 1.8");
  EXPECT_THAT(
      read_material_file(file(text)).warnings,
      ::testing::ElementsAre(HasSubstr(
          "sand.yaml, line 4: law drucker_prager_cap, keyword 'density' is 1.8 kg/m3; usual "
          "is 40 to 3000 kg/m3; give SI units: g/cm3 times 1000, kN/m3 times 102")));
  // Key by key, and in a base
  file(with(text, "E: 689e6", "E: 689"), "base.yaml");
  EXPECT_THAT(
      read_material_file(file("base: base.yaml\nlaw: {beta: 0.25}\n")).warnings,
      ::testing::ElementsAre(HasSubstr("base.yaml, line 4: "),
                             HasSubstr("sand.yaml, line 2: law drucker_prager_cap, keyword "
                                       "'beta' is 0.25 degree; usual is 4 to 80"),
                             HasSubstr("base.yaml, line 9: elasticity linear, keyword 'E' is "
                                       "689 Pa; usual is 20000 to 1e+11 Pa; give SI units: "
                                       "kPa times 1000, MPa times 1e6")));
}

TEST_F(MaterialFileTest, CapInAnotherUnitIsReadWithAWarning) {
  const std::string snow = shipped("fresh_snow");
  EXPECT_THAT(read_material_file(file(snow)).warnings, ::testing::IsEmpty());
  const auto warned = [&](const std::string& text, const std::string& warning) {
    EXPECT_THAT(read_material_file(file(text)).warnings, ::testing::Contains(HasSubstr(warning)));
  };
  warned(with(snow, "beta: 65 ", "beta: 1.134 "),
         "keyword 'beta' is 1.134 degree; usual is 4 to 80 degree, or 0; give SI units: radians "
         "times 57.3");
  warned(with(snow, "R: 1e-2", "R: 1e6"), "R is 1e+06; caps of soils and snow have 0.0001 to 5");
  warned(with(snow, "d: 5e3", "d: 5e7"), "d is 5e+07 Pa; ice and weak rock have up to 5e+06 Pa");
  const std::string kilopascal =
      with(snow, "[113.76, 20.65e3, 41.3e3, 82.6e3, 206.5e3, 413e3,  826e3,  1156.4e3]",
           "[0.11376, 20.65, 41.3, 82.6, 206.5, 413, 826, 1156.4]");
  warned(kilopascal,
         "the hardening ends with p = 1156.4 Pa at 813.8 kg/m3; ground of that density has a "
         "strength of at least 10000 Pa; give Pa, not kPa");
  // field snow, whose law is another
  EXPECT_THAT(read_material_file(file(shipped("field_snow"))).warnings, ::testing::IsEmpty());
}

/// All shipped materials, from fresh snow to dense sand and rubber.
TEST_F(MaterialFileTest, ShippedMaterialsAreReadWithoutAWarning) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(FURROW_SOURCE_DIR "/inputs/materials")) {
    if (entry.path().extension() != ".yaml") continue;
    ++count;
    if (entry.path().parent_path().filename() == "contact") {
      EXPECT_EQ(read_contact_file(entry.path().string()).size(), body_materials().size());
      continue;
    }
    EXPECT_THAT(read_material_file(entry.path().string()).warnings, ::testing::IsEmpty())
        << entry.path();
  }
  EXPECT_GT(count, 20);
}

/// Grounds at the ends of what is found in nature.
TEST_F(MaterialFileTest, NaturalExtremesAreReadWithoutAWarning) {
  const std::string laws[] = {
      // light fresh snow
      "law: {type: drucker_prager_cap, density: 60, d: 50, beta: 40, R: 0.02}\n"
      "elasticity: {E: 2e5, nu: 0.1}\n"
      "hardening: {type: by_density, rho: [60, 100, 200, 400], p: [5, 20, 500, 5e4], "
      "interpolation: log, beyond: extrapolate}\n",
      // ice
      "law: {type: drucker_prager_cap, density: 917, d: 2e6, beta: 30, R: 0.5}\n"
      "elasticity: {E: 9e9, nu: 0.3}\n"
      "hardening: {type: table, eps_vol_pl: [0, 0.02], p: [1e7, 5e7], interpolation: linear, "
      "beyond: extrapolate}\n",
      // peat
      "law: {type: cohesive_cam_clay, density: 150, M: 1.6, tension_ratio: 0.1}\n"
      "elasticity: {type: porous, kappa: 0.3, e0: 10, p0: 1e3, pt_el: 2e3, nu: 0.2}\n"
      "hardening: {type: exponential, pc0: 5e3, lambda: 2, kappa: 0.3, e0: 10}\n",
      // soft clay
      "law: {type: cohesive_cam_clay, density: 1500, M: 0.9, tension_ratio: 0}\n"
      "elasticity: {E: 3e5, nu: 0.35}\n"
      "hardening: {type: table, eps_vol_pl: [0, 0.1, 0.2], p: [1e4, 3e4, 1e5], interpolation: log, "
      "beyond: extrapolate}\n",
      // sandstone
      "law: {type: drucker_prager_cap, density: 2300, d: 5e6, beta: 50, R: 0.5}\n"
      "elasticity: {E: 2e10, nu: 0.2}\n"
      "hardening: {type: table, eps_vol_pl: [0, 0.05, 0.15], p: [1e8, 3e8, 6e8], interpolation: "
      "linear, beyond: extrapolate}\n"};
  for (const std::string& law : laws)
    EXPECT_THAT(read_material_file(file(law)).warnings, ::testing::IsEmpty()) << law;
}

/// A shipped material with a section in another unit.
TEST_F(MaterialFileTest, OtherUnitsAreReadWithAWarning) {
  struct Case {
    std::string material, change, warning;  ///< the change is a section over that of the material
  };
  const Case cases[] = {
      // E in kPa
      {"fresh_snow", "elasticity: {E: 13.79e3}", "keyword 'E' is 13790 Pa; usual is 20000 "},
      {"field_snow", "elasticity: {E: 13.79e3}", "keyword 'E' is 13790 Pa; usual is 20000 "},
      {"dry_sand", "elasticity: {E: 4.78e3}", "keyword 'E' is 4780 Pa; usual is 20000 "},
      // 144.8 kPa at the initial compaction of 0.001, over E/1.5
      {"mccormick_sand", "elasticity: {E: 689e3}",
       "the hardening begins with 0.315 times the bulk modulus of the elasticity, 4.59e+05 Pa"},
      {"compacted_sand_elastic", "elasticity: {E: 50e3}", "compression waves have 6.11 m/s"},
      {"rubber", "law: {G: 1e3, bulk: 49.667e3}", "keyword 'G' is 1000 Pa; usual is 10000 "},
      // E in mPa
      {"fresh_snow", "elasticity: {E: 13.79e9}", "compression waves have 9.63e+03 m/s"},
      {"dry_sand", "elasticity: {E: 4.78e9}",
       "the bulk modulus of the elasticity is 1.03e+04 times"},
      {"compacted_sand_elastic", "elasticity: {E: 50e9}", "compression waves have 6.11e+03 m/s"},
      {"rubber", "law: {G: 1e9, bulk: 49.667e9}", "compression waves have 6.81e+03 m/s"},
      // strengths in kPa
      {"mccormick_sand", "hardening: {p: [138, 172, 434, 896, 1655, 2758, 4137, 6895, 13447]}",
       "the bulk modulus of the elasticity is 3.42e+04 times that"},
      {"fresh_snow_exponential", "hardening: {pc0: 0.11376}", "the hardening ends with p = "},
      {"fresh_snow_foam", "hardening: {pc0: 0.11376}\nlaw: {pt: 0.011376, sigma0: 0.27579}",
       "give Pa, not kPa"},
      {"fresh_snow", "law: {d: 5}", "d is 5 Pa at 200 kg/m3; snow has at least 20 Pa"},
      // strengths in mPa
      {"variants/fresh_snow_shoop",
       "hardening: {p: [113.76e3, 5e7, 1e8, 2e8, 5e8, 1e9, 2e9, 2.8e9, 3.25e9]}",
       "the hardening has p = 113760 Pa at 199.8 kg/m3; ground of that density has a strength of "
       "at most 1e+05 Pa; give Pa, not mPa"},
      {"field_snow",
       "hardening: {p: [15e3, 2376e3, 14850e3, 594e5, 12474e4, 2079e5, 4158e5, 8316e5]}",
       "the hardening has p = 2.376e+06 Pa at 380 kg/m3"},
      {"dry_sand", "hardening: {p: [3e3, 1.2e6, 3e6, 6e6, 1.3e7, 3.3e7, 6.6e7, 1.3e8, 1.978e8]}",
       "the hardening ends with 96.8 times the bulk modulus"},
      {"fresh_snow_exponential", "hardening: {pc0: 113760}", "the hardening has pc0 = 113760 Pa"},
      // 210 MPa at the initial compaction of 0.001, over E/1.5
      {"mccormick_sand_exponential", "hardening: {pc0: 2e8}",
       "the hardening begins with 0.457 times the bulk modulus"},
      {"fresh_snow", "law: {d: 5e6}",
       "d is 5e+06 Pa and E 1.379e+07 Pa; ground has a d of at most"},
      // percent
      {"dry_sand",
       "hardening: {eps_vol_pl: [0, 0.8865, 1.215, 1.547, 1.952, 2.429, 2.529, 2.629, 2.729]}",
       "the hardening ends at eps_vol_pl = 2.729, a density of 2.305e+04 kg/m3"},
      {"mccormick_sand_exponential", "hardening: {e0: 47.2}",
       "e0 is 47.2 in hardening: without voids the ground would have 8.676e+04 kg/m3"},
      {"fresh_snow_foam", "elasticity: {e0: 350}\nhardening: {e0: 350}", "e0 is 350 in elasticity"},
      // tan(beta) for beta, and a large ratio
      {"fresh_snow", "law: {beta: 2.14}", "keyword 'beta' is 2.14 degree; usual is 4 to 80 "},
      {"fresh_snow_cam_clay", "law: {M: 7}",
       "keyword 'M' is 7; usual is 0.07 to 5; M is a ratio q/p, no angle"},
  };
  for (const Case& unit : cases) {
    const std::string text =
        "base: " FURROW_SOURCE_DIR "/inputs/materials/" + unit.material + ".yaml\n" + unit.change;
    EXPECT_THAT(read_material_file(file(text)).warnings,
                ::testing::Contains(HasSubstr(unit.warning)))
        << text;
  }
  EXPECT_THAT(refusal("base: " FURROW_SOURCE_DIR
                      "/inputs/materials/fresh_snow_cam_clay.yaml\nlaw: {M: 33}\n"),
              HasSubstr("law cohesive_cam_clay, keyword 'M' is 33; allowed: a number in (0, 20]: a "
                        "ratio q/p, no angle; of a friction angle phi, M = 6 sin(phi)/(3 - "
                        "sin(phi))"));
}

TEST_F(MaterialFileTest, DifferentKappaInTwoSectionsIsWarnedOf) {
  const std::string foam = shipped("fresh_snow_foam");
  EXPECT_THAT(read_material_file(file(foam)).warnings, ::testing::IsEmpty());
  const std::string changed = with(foam, "kappa: 0.005      #", "kappa: 0.05 #");
  EXPECT_THAT(read_material_file(file(changed)).warnings,
              ::testing::ElementsAre(HasSubstr("kappa is 0.005 in elasticity and 0.05 in "
                                               "hardening")));
}

TEST_F(MaterialFileTest, InconsistentSectionsOfAFoamAreReadWithAWarning) {
  const std::string foam = shipped("fresh_snow_foam");
  EXPECT_THAT(read_material_file(file(with(foam, "pc0: 113.76 ", "pc0: 113.76e3"))).warnings,
              ::testing::Contains(HasSubstr("sigma0/pc0 is 0.00242, usual is a number in [0.3, "
                                            "2.8]; the sections hardly belong to one")));
  EXPECT_THAT(read_material_file(file(with(foam, "sigma0: 275.79", "sigma0: 335"))).warnings,
              ::testing::ElementsAre(HasSubstr("sigma0/pc0 is 2.94")));
  const std::string tensile = with(foam, "pt_el: 22.752", "pt_el: 300");
  EXPECT_THAT(read_material_file(file(with(tensile, "pt: 11.376", "pt: 150"))).warnings,
              ::testing::ElementsAre(HasSubstr("pt is 150 Pa in law, above pc0 = 113.76 Pa")));
}

TEST(CsvFile, NumbersAreReadAndFaultsAreNamed) {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return CsvTable::read(scratch.file("a.csv", text));
  };
  const CsvTable table = read("# made by hand\np_Pa, name ,rho\n1e5,a,\n-2,b,3\n");
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.numbers("p_Pa"), (std::vector<double>{1e5, -2}));
  EXPECT_TRUE(std::isnan(table.numbers("rho")[0]));
  EXPECT_THAT(error_of([&] { table.numbers("name"); }),
              HasSubstr("a.csv, line 3, column 'name' is 'a'; allowed: a finite number"));
  EXPECT_THAT(error_of([&] { table.numbers("q"); }),
              HasSubstr("has no column 'q'; allowed: p_Pa, name, rho"));
  EXPECT_THAT(error_of([&] { read("a,b\n1,2\n3\n"); }),
              HasSubstr("a.csv, line 3 has 1 values; allowed: 2"));
  EXPECT_THAT(error_of([&] { read("a,b\n"); }), HasSubstr("has no rows"));
  const CsvTable back = read(csv_text({"x: of y"}, {"x", "y"}, {{0.1, 1.0 / 3.0}, {-1e-300, 4}}));
  EXPECT_EQ(back.numbers("x"), (std::vector<double>{0.1, 1.0 / 3.0}));
  EXPECT_EQ(back.numbers("y"), (std::vector<double>{-1e-300, 4}));
}

/// A column of the same test in the dialects of programs and in the units of apparatus.
TEST(CsvFile, DialectsAndUnitsOfProgramsAreRead) {
  const Scratch scratch;
  const struct {
    const char* text;
    const char* strain;
    const char* stress;
  } tables[] = {
      {"strain,q_Pa\n0.005,60000\n0.1,119000\n", "strain", "q_Pa"},
      {"\xEF\xBB\xBFstrain_percent,q_kPa\r\n0.5,60\r\n10,119\r\n", "strain_percent", "q_kPa"},
      {"Axial strain (%);Deviator [kPa]\n0,5;60,0\n10,0;119,0\n", "Axial strain (%)",
       "Deviator [kPa]"},
      {"\"strain\"\t\"q, MPa\"\n0,005\t0,06\n0,1\t0,119\n\t\n", "strain", "q, MPa"},
      {"strain,q\n%,kN/m²\n+0.5,60\n10,119\n", "strain", "q [kPa]"},
      {"strain,q\n5e-3,60\n0.1,119\n", "strain", "q [kPa]"},
      {"strain,q [psi]\n0.005,8.702264\n0.1,17.25952\n", "strain", "q [psi]"}};
  for (const auto& one : tables) {
    const CsvTable table = CsvTable::read(scratch.file("a.csv", one.text));
    const std::string units = one.text;
    const bool second_line = units.find("\n%,") != std::string::npos;
    const MeasuredColumn strain = table.measured(second_line ? "strain [%]" : one.strain, ""),
                         stress = table.measured(second_line ? "q [kN/m²]" : one.stress, "Pa");
    ASSERT_EQ(strain.values.size(), 2u) << one.text;
    EXPECT_NEAR(strain.values[0], 0.005, 1e-12) << one.text;
    EXPECT_NEAR(strain.values[1], 0.1, 1e-12) << one.text;
    EXPECT_NEAR(stress.values[0], 60e3, 0.5) << one.text;
    EXPECT_NEAR(stress.values[1], 119e3, 0.5) << one.text;
  }
  const CsvTable gaps = CsvTable::read(scratch.file("a.csv", "a,b\n1,NaN\nNA,2\n,3\n"));
  EXPECT_TRUE(std::isnan(gaps.numbers("a")[1]) && std::isnan(gaps.numbers("a")[2]));
  EXPECT_TRUE(std::isnan(gaps.numbers("b")[0]));
}

TEST(CsvFile, RefusesAnUnclearOrWrongUnitWithBothReadings) {
  const Scratch scratch;
  const CsvTable table = CsvTable::read(
      scratch.file("a.csv", "strain,q,e [kPa],p_s,eps\n0.5,60,0.8,1e5,0.1\n10,119,0.7,2e5,0.2\n"));
  EXPECT_THAT(
      error_of([&] { table.measured("strain", ""); }),
      HasSubstr("column 'strain' has no unit, and values up to 10: in ratio up to 10 ratio, "
                "in % up to 0.1 ratio; allowed: a heading with its unit: 'strain [ratio]' or "
                "'strain [%]'"));
  EXPECT_THAT(error_of([&] { table.measured("q", "Pa"); }),
              HasSubstr("values up to 119: in Pa up to 119 Pa, in kPa up to 1.19e+05 Pa"));
  EXPECT_THAT(error_of([&] { table.measured("e [kPa]", ""); }),
              HasSubstr("has the unit 'kPa'; allowed: %, percent"));
  EXPECT_THAT(error_of([&] { table.measured("eps [furlong]", ""); }),
              HasSubstr("has the unit 'furlong'"));
  EXPECT_EQ(table.measured("p_s", "Pa").values[1], 2e5);  // s is no unit of a pressure
  EXPECT_EQ(table.measured("strain [ratio]", "").values[1], 10.0);
  EXPECT_EQ(table.measured("eps", "").values[1], 0.2);
  EXPECT_THAT(error_of([&] { CsvTable::read(scratch.file("b.csv", "a,b\n1,5,2\n")); }),
              HasSubstr("has 3 values; allowed: 2"));
}

}  // namespace
}  // namespace furrow::material_file_test
