// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/rut_record.h"

namespace furrow {

namespace {

std::vector<RutPoint> points_from(const std::vector<double>& numbers) {
  std::vector<RutPoint> points;
  for (std::size_t n = 0; n + 3 < numbers.size(); n += 4)
    points.push_back({numbers[n], numbers[n + 1], numbers[n + 2], numbers[n + 3]});
  return points;
}

}  // namespace

/// Four for each point.
std::vector<double> RutRecord::gather_numbers(const Communicator& ranks) const {
  std::vector<double> numbers;
  for (const RutPoint& point : points_)
    numbers.insert(numbers.end(), {point.x, point.y, point.z, point.density});
  return ranks.gather(numbers);
}

std::vector<RutPoint> RutRecord::gather(const Communicator& ranks) const {
  return points_from(gather_numbers(ranks));
}

void RutRecord::checkpoint(Checkpoint& state, const Communicator& ranks) {
  std::vector<double> numbers;
  if (state.saving()) numbers = gather_numbers(ranks);
  state.values("rut", numbers);
  points_.clear();
  if (ranks.rank() == 0) points_ = points_from(numbers);
}

}  // namespace furrow
