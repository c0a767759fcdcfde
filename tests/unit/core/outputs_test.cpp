// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/options/outputs.h"

#include <gtest/gtest.h>

namespace furrow::outputs_test {
namespace {

TEST(Outputs, ListHasNamesUnitsMeaningsAndValues) {
  struct Plate {
    double sinkage, force;
  };
  const Outputs<const Plate> outputs = {
      {"sinkage", "m", "below the ground level", [](const Plate& plate) { return plate.sinkage; }},
      {"force", "N", "upwards", [](const Plate& plate) { return plate.force; }},
  };
  const Plate plate{0.02, 300.0};
  EXPECT_EQ(outputs.values(plate), (std::vector<double>{0.02, 300.0}));
  EXPECT_EQ(outputs.value(1, plate), 300.0);
  ASSERT_EQ(outputs.channels().size(), outputs.size());
  EXPECT_EQ(outputs.channels()[1].name, "force");
  EXPECT_EQ(outputs.channels()[1].unit, "N");
  EXPECT_EQ(outputs.channels()[0].meaning, "below the ground level");
}

}  // namespace
}  // namespace furrow::outputs_test
