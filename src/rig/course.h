// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A target of the rig that changes while the wheel rolls.

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace furrow {

/// Values over time: linear between its points, constant before the first and after the last.
class Course {
 public:
  /// @param points time [s], growing, and value; at least one
  explicit Course(std::vector<std::pair<double, double>> points) : points_(std::move(points)) {}

  const std::vector<std::pair<double, double>>& points() const { return points_; }

  double value(double time) const {
    const auto later = std::upper_bound(points_.begin(), points_.end(), time,
                                        [](double t, const auto& p) { return t < p.first; });
    if (later == points_.begin()) return points_.front().second;
    if (later == points_.end()) return points_.back().second;
    const auto& [begin, from] = *(later - 1);
    const auto& [end, to] = *later;
    return from + (to - from) * (time - begin) / (end - begin);
  }

 private:
  std::vector<std::pair<double, double>> points_;
};

/// Courses by the key of their target.
using Courses = std::map<std::string, Course>;

}  // namespace furrow
