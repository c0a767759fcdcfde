// SPDX-License-Identifier: GPL-2.0-or-later
// On one rank; several ranks: tests/verification/mpm_ranks/ranks_test.cpp.
#include "furrow/mpm/grid/partition.h"

#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"

namespace furrow::partition_test {
namespace {

Grid grid_of(int x_cells, int y_cells) {
  return Grid(Axis(testing_terrain::even(0, x_cells, 1), "x"),
              Axis(testing_terrain::even(0, y_cells, 1), "y"),
              Axis(testing_terrain::even(0, 3, 1), "z"));
}

TEST(Partition, OneRankHasEverything) {
  const Partition partition(Communicator(), {1, 1}, grid_of(7, 4));
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 4; ++y) EXPECT_EQ(partition.owner(x, y), 0);
  for (const int axis : {0, 1}) {
    EXPECT_EQ(partition.local_cells(axis).from, 0);
    EXPECT_EQ(partition.local_cells(axis).to, axis == 0 ? 7 : 4);
  }
  for (const NodeBlock& block : {partition.local_nodes(), partition.owned_nodes()}) {
    EXPECT_EQ(block.x.from, 0);
    EXPECT_EQ(block.x.to, 9);
    EXPECT_EQ(block.y.from, 0);
    EXPECT_EQ(block.y.to, 6);
  }
}

TEST(Partition, BalanceOfEmptyGroundCoversAllCells) {
  Partition partition(Communicator(), {1, 1}, grid_of(4, 2));
  partition.set_bounds(partition.balanced({std::vector<double>(4, 0.0), {0.0, 0.0}}));
  EXPECT_EQ(partition.owner(3, 1), 0);
  EXPECT_EQ(partition.local_cells(0).to, 4);
}

/// Columns of nodes of the largest block, shared ones included, by hand: 100 x 40 cells on 8 ranks
/// are 17 x 42 as 8 x 1, 29 x 23 as 4 x 2, 53 x 14 as 2 x 4 blocks and 102 x 9 as 1 x 8. 1000 x 400
/// cells on 64 ranks are 129 x 54 as 8 x 8 and, where some have a cell more, 67 x 104 as 16 x 4.
TEST(BlockLayout, LayoutHasTheSmallestHalo) {
  struct Case {
    int ranks, x_cells, y_cells, x, y;
  };
  for (const Case& c :
       {Case{1, 9, 9, 1, 1}, Case{2, 20, 5, 2, 1}, Case{2, 5, 20, 1, 2}, Case{2, 20, 20, 2, 1},
        Case{4, 20, 20, 2, 2}, Case{8, 100, 40, 4, 2}, Case{8, 400, 10, 8, 1},
        Case{7, 40, 30, 7, 1}, Case{64, 1000, 400, 8, 8}, Case{1024, 1000, 400, 64, 16}}) {
    const BlockLayout layout = choose_layout(c.ranks, c.x_cells, c.y_cells);
    EXPECT_EQ(layout.x, c.x) << c.ranks << " ranks, " << c.x_cells << " x " << c.y_cells;
    EXPECT_EQ(layout.y, c.y) << c.ranks << " ranks, " << c.x_cells << " x " << c.y_cells;
  }
}

TEST(BlockLayout, LayoutNeedsAsManyBlocksAsRanks) {
  EXPECT_NO_THROW(check_layout({4, 2}, 8, "ground"));
  EXPECT_THROW(check_layout({4, 3}, 8, "ground"), InputError);
}

}  // namespace
}  // namespace furrow::partition_test
