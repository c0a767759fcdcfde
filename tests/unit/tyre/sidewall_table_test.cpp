// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_table.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "furrow/tyre/sidewall/sidewall_direct.h"
#include "tyres.h"
#include "tests/support/error_of.h"

namespace furrow::sidewall_table_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

SidewallResponse at(Sidewall& sidewall, const SidewallEnd& end, bool with_stiffness = true) {
  SidewallResponse response;
  sidewall.evaluate(&end, &response, 1, with_stiffness);
  return response;
}

TEST(SidewallTable, ForcesAndStiffnessAreExactDerivativesOfItsPotential) {
  for (const auto& make : {tr_sidewall, tr_sector}) {
    const SidewallParameters sidewall = make(5.0, 5.0);
    SidewallTable table(sidewall, 103e3);
    for (const SidewallEnd& end : ends) {
      const auto response = [&](const SidewallEnd& e) { return at(table, e); };
      const SidewallResponse here = response(end);
      EXPECT_LT((here.force + gradient_by_differences(response, end, 2e-5)).norm(),
                1e-7 * here.on_tread.norm());
      const double share = sidewall.bead_width / 2 + sidewall.taper * end.r / 3;
      EXPECT_LT((here.on_tread - here.force - 103e3 * share * Vector3(end.r, -end.a, 0.0)).norm(),
                1e-12 * here.on_tread.norm());
      EXPECT_LT((here.stiffness - stiffness_by_differences(response, end, 2e-5)).norm(),
                1e-6 * here.stiffness.norm());
      EXPECT_LT((at(table, end, false).on_tread - here.on_tread).norm(),
                1e-13 * here.on_tread.norm());
    }
  }
}

TEST(SidewallTable, TableAgreesWithTheChain) {
  for (const auto& make : {tr_sidewall, tr_sector}) {
    SidewallTable table(make(5.0, 10.0), 103e3);
    SidewallDirect direct(make(5.0, 10.0), 103e3);
    for (const SidewallEnd& end : ends) {
      const SidewallResponse looked_up = at(table, end), solved = at(direct, end);
      EXPECT_LT((looked_up.on_tread - solved.on_tread).norm(), 1e-5 * solved.on_tread.norm());
      EXPECT_LT((looked_up.force - solved.force).norm(), 1e-5 * solved.on_tread.norm());
      EXPECT_NEAR(looked_up.on_tread[2], solved.on_tread[2], 1e-3);
      EXPECT_NEAR(looked_up.potential, solved.potential, 1e-5 * std::abs(solved.potential));
      EXPECT_LT((looked_up.stiffness - solved.stiffness).norm(), 1e-3 * solved.stiffness.norm());
      EXPECT_EQ(table.shape(end).on_rim, direct.shape(end).on_rim);
    }
  }
}

TEST(SidewallTable, OtherPressureGivesAnotherTable) {
  SidewallTable table(tr_sidewall(1.0, 1.0), 103e3), other(tr_sidewall(1.0, 1.0), 179e3);
  EXPECT_NE(table.coefficients(), other.coefficients());
  table.set_pressure(179e3);
  EXPECT_EQ(table.pressure(), 179e3);
  EXPECT_EQ(table.coefficients(), other.coefficients());
  EXPECT_EQ(at(table, ends[0]).on_tread, at(other, ends[0]).on_tread);
}

TEST(SidewallTable, CoefficientsRestoreTheTable) {
  SidewallTable table(tr_sidewall(1.0, 1.0), 103e3);
  SidewallTable copy(tr_sidewall(1.0, 1.0), 103e3, table.grid(), table.coefficients());
  EXPECT_EQ(at(copy, ends[2]).on_tread, at(table, ends[2]).on_tread);
  EXPECT_EQ(at(copy, ends[2]).stiffness, at(table, ends[2]).stiffness);
}

TEST(SidewallTable, StatesBeyondTheTableAreRefused) {
  SidewallTable table(tr_sidewall(1.0, 1.0), 103e3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [&](const SidewallEnd& end) { return error_of([&] { at(table, end); }); };
  EXPECT_THAT(refusal({0.0, 0.1609, 0.0}),
              HasSubstr("the chord over the length is 0.9994, the table goes from 0.2 to 0.999"));
  EXPECT_THAT(refusal({0.0, 0.17, 0.0}), HasSubstr("the chord over the length is 1.056"));
  EXPECT_THAT(refusal({0.0, 0.03, 0.0}), HasSubstr("the chord over the length is 0.1863"));
  EXPECT_THAT(refusal({0.1, 0.05, 0.0}),
              HasSubstr("the chord's direction is 26.57 degrees, the table goes from 30 to 150"));
  EXPECT_THAT(refusal({0.0, 0.1, 1.1}),
              HasSubstr("the tread's rotation is 63.03 degrees, the table goes from -60 to 60"));
  EXPECT_THAT(refusal({nan, 0.1, 0.0}), HasSubstr("the chord over the length is nan"));
  EXPECT_THAT(refusal({0.0, 0.1, nan}), HasSubstr("the tread's rotation is nan"));
  EXPECT_THAT(error_of([&] { table.set_pressure(-1.0); }), HasSubstr("the pressure is -1 Pa"));
  // Stiff springs and no pressure: the chain snaps through, and no smooth table can follow
  EXPECT_THAT(error_of([&] { SidewallTable(tr_sidewall(100.0, 100.0), 2e4); }),
              HasSubstr("its forces differ from the chain's by"));
  SidewallTableGrid grid;
  grid.chord_max = 1.2;
  EXPECT_THAT(error_of([&] { SidewallTable(tr_sidewall(1.0, 1.0), 1e5, grid); }),
              HasSubstr("chords from 0.2 to 1.2"));
  grid = {};
  grid.rotation_nodes = 4;
  EXPECT_THAT(error_of([&] { SidewallTable(tr_sidewall(1.0, 1.0), 1e5, grid); }),
              HasSubstr("axis 3 has 4 nodes"));
}

}  // namespace
}  // namespace furrow::sidewall_table_test
