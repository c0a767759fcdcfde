// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/weld.h"

#include <gtest/gtest.h>

namespace furrow::weld_test {
namespace {

TEST(Weld, FindsEqualPlacesAndPeriodicImages) {
  Matrix3X x(3, 6);
  x << 0.0, 1.0, 2.0, 0.0, -1.0, 0.5,  //
      0.0, 0.0, 0.0, 0.0, 0.0, 0.5,    //
      0.0, 0.0, 0.0, 1e-12, 0.0, 0.0;
  EXPECT_EQ(weld_nodes(x, Vector3::Zero(), 1e-9), (std::vector<int>{0, 1, 2, 0, 4, 5}));
  EXPECT_EQ(weld_nodes(x, Vector3(2, 0, 0), 1e-9), (std::vector<int>{0, 1, 0, 0, 1, 5}));
  EXPECT_EQ(weld_nodes(x, Vector3(1, 1, 1), 1e-9), (std::vector<int>{0, 0, 0, 0, 0, 5}));
}

}  // namespace
}  // namespace furrow::weld_test
