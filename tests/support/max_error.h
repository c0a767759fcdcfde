// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Extremes of the values that a test collects. std::max over a loop starts at a value that passes
/// and skips NaN (std::max(worst, NaN) is worst); these refuse both: what was never measured, or
/// measured as NaN, fails the test.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

namespace furrow::test {

/// Smallest and largest of the values added.
class Range {
 public:
  void add(double value) {
    ++count_;
    if (std::isnan(value)) ++undefined_;
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
  }
  std::size_t count() const { return count_; }
  /// NaN, which passes no comparison, and a failure if there was no value or one was NaN.
  double min() const { return sound() ? min_ : nan_; }
  double max() const { return sound() ? max_ : nan_; }

 private:
  bool sound() const {
    EXPECT_GT(count_, 0u) << "no value was measured";
    EXPECT_EQ(undefined_, 0u) << "of " << count_ << " values are NaN";
    return count_ > 0 && undefined_ == 0;
  }
  static constexpr double nan_ = std::numeric_limits<double>::quiet_NaN();
  std::size_t count_ = 0;
  std::size_t undefined_ = 0;
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = -std::numeric_limits<double>::infinity();
};

/// Largest magnitude of the errors added.
class MaxError {
 public:
  void add(double error) { magnitudes_.add(std::abs(error)); }
  std::size_t count() const { return magnitudes_.count(); }
  /// As Range::max().
  double max() const { return magnitudes_.max(); }

 private:
  Range magnitudes_;
};

}  // namespace furrow::test
