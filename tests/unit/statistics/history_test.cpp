// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/history.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::history_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

History three_rows() {
  History history({{"time", "s", "time"}, {"force", "N", "force"}});
  history.append({0.0, 5.0});
  history.append({0.5, 6.0});
  history.append({1.0, 7.0});
  return history;
}

TEST(History, KeepsRowsAndGivesColumns) {
  const History history = three_rows();
  EXPECT_EQ(history.size(), 3u);
  EXPECT_EQ(history.index("force"), 1u);
  EXPECT_EQ(history.column("force"), (std::vector<double>{5, 6, 7}));
  EXPECT_EQ(history.at(1, 0), 0.5);
  EXPECT_EQ(History().size(), 0u);
}

TEST(History, TruncationKeepsTheRowAtTheTime) {
  History history = three_rows();
  history.truncate_after(0.5);
  EXPECT_EQ(history.column("time"), (std::vector<double>{0.0, 0.5}));
  history.truncate_after(-1.0);
  EXPECT_EQ(history.size(), 0u);
}

TEST(History, RefusesWrongRowsAndNames) {
  History history = three_rows();
  EXPECT_THAT(error_of([&] { history.append({1.0}); }),
              HasSubstr("a history of 2 channels cannot take a row of 1 numbers"));
  EXPECT_THAT(error_of([&] { history.column("torque"); }),
              HasSubstr("no channel 'torque'; it has time, force"));
  EXPECT_THAT(error_of([&] { history.at(3, 0); }),
              HasSubstr("has 3 rows and 2 channels, none at row 3, channel 0"));
  EXPECT_THAT(error_of([&] { History(history.channels(), {{0.0}}); }),
              HasSubstr("a history of 2 channels cannot have 1 columns"));
  EXPECT_THAT(error_of([&] {
                History(history.channels(), {{0.0, 1.0}, {5.0}});
              }),
              HasSubstr("columns of 2 and 1 rows"));
  EXPECT_THAT(error_of([] { History().index("time"); }), HasSubstr("it has none"));
}

}  // namespace
}  // namespace furrow::history_test
