// SPDX-License-Identifier: GPL-2.0-or-later
// Each reader is given the files of the others.
#include "furrow/io/inputs/input_kind.h"

#include <gmock/gmock.h>

#include <functional>

#include "furrow/io/inputs/point_file.h"
#include "furrow/io/inputs/tyre_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::input_kind_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(InputKind, FileOfAnotherKindIsRefusedWithItsKind) {
  struct Kind {
    std::string file, name;
    std::function<void(const std::string&)> read;
  };
  const std::string inputs = FURROW_SOURCE_DIR "/inputs/";
  const Kind kinds[] = {
      {"materials/fresh_snow.yaml", "a material file",
       [](auto& path) { read_material_file(path); }},
      {"tyres/p235_75r15.yaml", "a tyre file", [](auto& path) { read_tyre_file(path); }},
      {"points/mccormick_triaxial.yaml", "a point file with a path to drive",
       [](auto& path) { read_point_run(path); }},
      {"points/fit_abele_gow.yaml", "a point file with curves to fit",
       [](auto& path) { read_point_fit(path); }}};
  for (const Kind& wanted : kinds)
    for (const Kind& given : kinds) {
      const std::string path = inputs + given.file;
      const std::string message = error_of([&] { wanted.read(path); });
      if (&wanted == &given)
        EXPECT_EQ(message, "no error");
      else
        EXPECT_THAT(message, AllOf(HasSubstr(path + " has the section '"),
                                   HasSubstr("it looks like " + given.name),
                                   HasSubstr("; allowed: " + wanted.name)));
    }
}

}  // namespace
}  // namespace furrow::input_kind_test
