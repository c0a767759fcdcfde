// SPDX-License-Identifier: GPL-2.0-or-later
// On one rank; several ranks: tests/verification/mpm_ranks/ranks_test.cpp.
#include "mpm/partition.h"

#include <gtest/gtest.h>

namespace furrow {
namespace {

TEST(Partition, OneRankHasEverything) {
  Partition partition(Communicator(), 7);
  partition.rebalance(std::vector<double>(7, 3.0));
  for (int cell = 0; cell < 7; ++cell) EXPECT_EQ(partition.owner(cell), 0);
  EXPECT_EQ(partition.first_local_cell(), 0);
  EXPECT_EQ(partition.last_local_cell(), 6);
  EXPECT_EQ(partition.local_planes().from, 0);
  EXPECT_EQ(partition.local_planes().to, 9);  // planes of nodes
  EXPECT_EQ(partition.owned_planes().from, 0);
  EXPECT_EQ(partition.owned_planes().to, 9);
}

TEST(Partition, BalanceOfNothingIsStillEverything) {
  Partition partition(Communicator(), 4);
  partition.rebalance(std::vector<double>(4, 0.0));
  EXPECT_EQ(partition.owner(3), 0);
  EXPECT_EQ(partition.last_local_cell(), 3);
}

}  // namespace
}  // namespace furrow
