// SPDX-License-Identifier: GPL-2.0-or-later
// furrow-tyre --half against the whole tyre, at a pressure where the belt does not wrinkle.
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/program.h"

namespace furrow::half_tyre_command_test {
namespace {

/// Numbers of the last line that furrow-tyre prints, that of the loaded tyre.
std::vector<double> loaded(const std::string& options) {
  const test::Outcome outcome = test::run_program(
      FURROW_TYRE " " FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15.yaml --pressure 40 " + options);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  const std::string text = outcome.text.substr(0, outcome.text.find_last_not_of('\n') + 1);
  std::istringstream line(text.substr(text.rfind('\n') + 1));
  std::vector<double> numbers;
  for (std::string cell; std::getline(line, cell, ',');) numbers.push_back(std::stod(cell));
  return numbers;
}

// The states differ by the tolerance of the equilibrium; steps and residual are the last columns.
TEST(TyreCommand, HalfATyreHasTheDeflectionAndContactOfTheWhole) {
  const std::vector<double> whole = loaded("--mesh 4 36 --load 2000"),
                            half = loaded("--mesh 4 36 --load 2000 --half");
  ASSERT_EQ(whole.size(), half.size());
  ASSERT_GT(whole.size(), 6u);
  EXPECT_NE(whole[whole.size() - 2], half[half.size() - 2]);  // the whole is another computation
  for (std::size_t k = 0; k + 2 < whole.size(); ++k)
    EXPECT_NEAR(half[k], whole[k], 3e-3 * whole[k]) << "column " << k;
}

}  // namespace
}  // namespace furrow::half_tyre_command_test
