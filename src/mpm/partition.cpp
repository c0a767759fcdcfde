// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/partition.h"

#include <algorithm>
#include <numeric>

namespace furrow {

void Partition::rebalance(const std::vector<double>& count) {
  const int cells = static_cast<int>(count.size()), size = ranks_.size();
  const double all = std::accumulate(count.begin(), count.end(), 0.0);
  bounds_ = {0};
  double sum = 0.0;
  for (int cell = 0; cell < cells; ++cell) {
    sum += count[static_cast<std::size_t>(cell)];
    const int rank = static_cast<int>(bounds_.size());
    if (rank < size && sum >= all * rank / size) bounds_.push_back(cell + 1);
  }
  while (static_cast<int>(bounds_.size()) < size) bounds_.push_back(cells);
  bounds_.push_back(cells);
}

bool Partition::checkpoint(Checkpoint& state) {
  std::vector<double> bounds(bounds_.begin(), bounds_.end());
  state.values("slabs", bounds);
  const bool as_many = bounds.size() == static_cast<std::size_t>(ranks_.size()) + 1;
  if (as_many) bounds_.assign(bounds.begin(), bounds.end());
  return as_many;
}

int Partition::owner(int cell) const {
  return static_cast<int>(std::upper_bound(bounds_.begin() + 1, bounds_.end() - 1, cell) -
                          bounds_.begin()) -
         1;
}

PlaneRange Partition::local_planes_of(int rank) const {
  const auto r = static_cast<std::size_t>(rank);
  if (bounds_[r] == bounds_[r + 1]) return {bounds_[r], bounds_[r]};
  return {std::max(0, bounds_[r] - 1), std::min(bounds_.back(), bounds_[r + 1] + 1) + 2};
}

/// A plane belongs to the first rank to which it is local.
PlaneRange Partition::owned_planes() const {
  PlaneRange mine = local_planes();
  for (int r = 0; r < ranks_.rank(); ++r)
    mine.from = std::max(mine.from, std::min(mine.to, local_planes_of(r).to));
  return mine;
}

void Partition::sum_shared(Grid& grid) const {
  if (ranks_.size() == 1) return;
  for (int field = 0; field < grid.fields(); ++field) sum_shared(grid, field);
}

void Partition::sum_shared(Grid& grid, int field) const {
  const PlaneRange mine = local_planes();
  const std::size_t length = 4 * grid.plane_size();
  const auto shared = [&](int rank) {
    const PlaneRange theirs = local_planes_of(rank);
    return PlaneRange{std::max(mine.from, theirs.from), std::min(mine.to, theirs.to)};
  };
  const auto numbers = [&](const PlaneRange& planes) {
    const double* first = grid.plane_sums(planes.from, field);
    return std::vector<double>(first,
                               first + length * static_cast<std::size_t>(planes.to - planes.from));
  };
  // All are sent before anything is added, then added in the order of the ranks: a node's sum has
  // the same bits on every rank.
  std::vector<std::vector<double>> received(static_cast<std::size_t>(ranks_.size()));
  for (int r = 0; r < ranks_.size(); ++r) {
    const PlaneRange planes = shared(r);
    if (r == ranks_.rank() || planes.to <= planes.from) continue;
    received[static_cast<std::size_t>(r)] = ranks_.exchange(r, numbers(planes));
  }
  std::vector<const double*> parts;
  std::vector<double> own;
  for (int plane = mine.from; plane < mine.to; ++plane) {
    parts.clear();
    for (int r = 0; r < ranks_.size(); ++r) {
      if (r == ranks_.rank()) {
        parts.push_back(nullptr);
      } else if (const PlaneRange planes = shared(r); planes.contains(plane)) {
        parts.push_back(received[static_cast<std::size_t>(r)].data() +
                        length * static_cast<std::size_t>(plane - planes.from));
      }
    }
    if (parts.size() == 1) continue;
    own = numbers({plane, plane + 1});
    std::replace(parts.begin(), parts.end(), static_cast<const double*>(nullptr),
                 static_cast<const double*>(own.data()));
    double* sum = grid.plane_sums(plane, field);
    std::copy_n(parts[0], length, sum);
    for (std::size_t p = 1; p < parts.size(); ++p)
      for (std::size_t n = 0; n < length; ++n) sum[n] += parts[p][n];
  }
}

}  // namespace furrow
