// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/particles/particle_distribution.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/rank_numbers.h"

namespace furrow {

namespace {

constexpr double max_drift = 0.5;  // of the shortest cell between two sortings
constexpr std::size_t chunk_length = std::size_t(1) << 17;  // numbers in memory next to particles

}  // namespace

ParticleDistribution::ParticleDistribution(Discretisation& discretisation, Boundary& boundary)
    : discretisation_(discretisation), boundary_(boundary) {}

bool ParticleDistribution::sorting_due() const {
  return drift_ > max_drift * discretisation_.grid.shortest_cell();
}

void ParticleDistribution::sort() {
  drift_ = 0.0;
  ++generation_;
  for (ParticleGroup& group : discretisation_.groups) group.particles.remove_released_columns();
  migrate();
  for (ParticleGroup& group : discretisation_.groups) sort_by_cell(group, false);
}

std::array<int, 3> ParticleDistribution::cell_of(double number) const {
  const auto n = static_cast<long long>(number);
  const long long y = discretisation_.grid.axis(1).cells(),
                  z = discretisation_.grid.axis(2).cells();
  return {static_cast<int>(n / (y * z)), static_cast<int>(n / z % y), static_cast<int>(n % z)};
}

/// Counting sort: stable, so that the order of the particles of a cell stays.
void ParticleDistribution::sort_by_cell(ParticleGroup& group, bool of_last_sorting) {
  const Grid& grid = discretisation_.grid;
  const CellRange x_cells = discretisation_.partition.own_cells(0);
  const CellRange y_cells = discretisation_.partition.own_cells(1);
  const auto nx = static_cast<std::size_t>(x_cells.size());
  const auto ny = static_cast<std::size_t>(y_cells.size());
  const auto nz = static_cast<std::size_t>(grid.axis(2).cells());
  const std::size_t n = group.particles.size();
  cell_.resize(n);
  start_.assign(nx * ny * nz + 1, 0);
  double* cell_of_particle = group.particles.data(column::cell);
  for (std::size_t p = 0; p < n; ++p) {
    const Vector3 x = group.particles.position(p);
    const std::array<int, 3> c =
        of_last_sorting ? cell_of(cell_of_particle[p])
                        : std::array<int, 3>{grid.axis(0).cell_of(x[0]), grid.axis(1).cell_of(x[1]),
                                             grid.axis(2).cell_of(x[2])};
    if (c[0] < 0 || c[1] < 0 || c[2] < 0) report_outside(group);
    cell_[p] = (static_cast<std::size_t>(c[0] - x_cells.from) * ny +
                static_cast<std::size_t>(c[1] - y_cells.from)) *
                   nz +
               static_cast<std::size_t>(c[2]);
    ++start_[cell_[p] + 1];
    cell_of_particle[p] =
        (static_cast<double>(c[0]) * grid.axis(1).cells() + c[1]) * grid.axis(2).cells() + c[2];
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  order_.resize(n);
  for (std::size_t p = 0; p < n; ++p) order_[start_[cell_[p]]++] = p;
  group.particles.reorder(order_);
  if (!group.awake) return;
  // start_ has the ends of the cells after the loop above
  group.column_start.assign(nx * ny + 1, 0);
  for (std::size_t c = 1; c <= nx * ny; ++c) group.column_start[c] = start_[c * nz - 1];
}

/// Number of particles of all ranks in each layer of cells along x and y.
Partition::Counts ParticleDistribution::count_in_layers() const {
  Partition::Counts counts;
  for (std::size_t a = 0; a < 2; ++a) {
    const Axis& axis = discretisation_.grid.axis(static_cast<int>(a));
    counts[a].assign(static_cast<std::size_t>(axis.cells()), 0.0);
    for (const ParticleGroup& group : discretisation_.groups)
      for (std::size_t p = 0; p < group.particles.size(); ++p) {
        const int cell = axis.cell_of(group.particles.data(column::x + a)[p]);
        if (cell < 0) report_outside(group);
        ++counts[a][static_cast<std::size_t>(cell)];
      }
    discretisation_.ranks().sum(counts[a].data(), counts[a].size());
  }
  return counts;
}

/// A far field is known at the local nodes; blocks that move get it from those that had it.
void ParticleDistribution::rebalance() {
  const Partition& partition = discretisation_.partition;
  Partition::Bounds bounds = partition.balanced(count_in_layers());
  if (bounds == partition.bounds()) return;
  boundary_.synchronise(partition.ranks(), partition.owned_nodes());
  discretisation_.set_bounds(std::move(bounds));
}

void ParticleDistribution::migrate() {
  if (discretisation_.ranks().size() == 1) return;
  rebalance();
  for (ParticleGroup& group : discretisation_.groups)
    for (const int axis : {0, 1}) send_along(axis, group);
}

/// Sends particles to the blocks of this row (axis 0) or column (axis 1) that have their cells
/// along the axis.
void ParticleDistribution::send_along(int axis, ParticleGroup& group) {
  const Partition& partition = discretisation_.partition;
  if (partition.blocks(axis) == 1) return;
  std::vector<Communicator::Message> messages(static_cast<std::size_t>(partition.blocks(axis)));
  for (int block = 0; block < partition.blocks(axis); ++block)
    messages[static_cast<std::size_t>(block)].other = partition.rank_along(axis, block);
  const double* x = group.particles.data(column::x + static_cast<std::size_t>(axis));
  std::vector<std::size_t> staying;
  for (std::size_t p = 0; p < group.particles.size(); ++p) {
    const int block = partition.block_of(axis, discretisation_.grid.axis(axis).cell_of(x[p]));
    if (block == partition.own_block(axis))
      staying.push_back(p);
    else
      group.particles.pack(p, messages[static_cast<std::size_t>(block)].sent);
  }
  group.particles.reorder(staying);
  partition.ranks().exchange_lengths(messages);
  partition.ranks().exchange(messages);
  for (const Communicator::Message& message : messages)
    for (std::size_t n = 0; n < message.received.size(); n += group.particles.record_length())
      group.particles.unpack(message.received.data() + n);
}

void ParticleDistribution::report_outside(const ParticleGroup& group) const {
  const Grid& grid = discretisation_.grid;
  for (std::size_t p = 0; p < group.particles.size(); ++p) {
    const Vector3 x = group.particles.position(p);
    for (int a = 0; a < 3; ++a)
      if (grid.axis(a).cell_of(x[a]) < 0)
        throw StateError(fmt::format(
            "a particle is at {:.4g} {:.4g} {:.4g} m, outside of the grid (x {:.4g} to {:.4g}, y "
            "{:.4g} to {:.4g}, z {:.4g} to {:.4g} m): enlarge the grid ('clearance_above', "
            "'length', 'width'), or check for an unstable contact, a suddenly applied load, or a "
            "'free' face",
            x[0], x[1], x[2], grid.axis(0).lower(), grid.axis(0).upper(), grid.axis(1).lower(),
            grid.axis(1).upper(), grid.axis(2).lower(), grid.axis(2).upper()));
  }
  throw StateError(
      fmt::format("particles moved more than a cell in {:.2g} m of expected drift: the ground has "
                  "become unstable",
                  drift_));
}

NodeBlock ParticleDistribution::Saved::columns_of(std::size_t rank) const {
  const auto at = [&](std::size_t n) { return static_cast<int>(columns[4 * rank + n]); };
  return {{at(0), at(1)}, {at(2), at(3)}};
}

std::uint64_t ParticleDistribution::Saved::start_of_nodes(std::size_t rank) const {
  std::uint64_t start = 0;
  for (const std::vector<double>& of_group : lengths)
    start += static_cast<std::uint64_t>(of_group[rank]);
  return start;
}

/// Collective calls come first, because a rank with a full disk fails alone.
void ParticleDistribution::checkpoint_values(Checkpoint& state, RankNumbers& numbers) {
  const Communicator& ranks = discretisation_.ranks();
  const bool same_layout = discretisation_.partition.checkpoint(state);
  Saved saved;
  for (ParticleGroup& group : discretisation_.groups) {
    const std::size_t mine = group.particles.size() * group.particles.record_length();
    saved.lengths.emplace_back();
    if (state.saving()) saved.lengths.back() = ranks.gather({double(mine)});
    state.values("numbers_of_ranks", saved.lengths.back());
  }
  const auto [x, y] = discretisation_.grid.stored();
  if (state.saving())
    saved.columns = ranks.gather({double(x.from), double(x.to), double(y.from), double(y.to)});
  state.values("columns_of_ranks", saved.columns);
  if (state.saving()) {
    save_particles(numbers);
    discretisation_.grid.save(numbers);
  } else {
    restore(numbers, saved, same_layout);
  }
}

void ParticleDistribution::save_particles(RankNumbers& numbers) const {
  std::vector<double> chunk;
  const auto write = [&] {
    numbers.append(chunk.data(), chunk.size());
    chunk.clear();
  };
  for (const ParticleGroup& group : discretisation_.groups)
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      group.particles.pack(p, chunk);
      if (chunk.size() >= chunk_length) write();
    }
  write();
}

/// The drift stays, so that the next sorting comes when it would have come.
void ParticleDistribution::restore(RankNumbers& numbers, const Saved& saved, bool same_layout) {
  const auto rank = static_cast<std::size_t>(discretisation_.ranks().rank());
  check_numbers(numbers, saved);
  for (ParticleGroup& group : discretisation_.groups) group.particles.clear();
  for (std::size_t r = 0; r < saved.ranks(); ++r)
    if (!same_layout || r == rank) read_particles(numbers, saved, r, same_layout);
  const double drift = drift_;
  if (!same_layout)
    for (ParticleGroup& group : discretisation_.groups) sort_by_cell(group, true);
  drift_ = drift;
  ++generation_;
  Grid& grid = discretisation_.grid;
  grid.store(discretisation_.partition.local_nodes());
  for (std::size_t r = 0; r < saved.ranks(); ++r)
    if (!same_layout || r == rank)
      grid.restore(numbers, static_cast<int>(r), saved.start_of_nodes(r), saved.columns_of(r));
}

/// The ranks share the files out among them; all of them throw what is wrong with one.
void ParticleDistribution::check_numbers(RankNumbers& numbers, const Saved& saved) const {
  const Communicator& ranks = discretisation_.ranks();
  const auto is_empty = [&](std::size_t r) {
    return saved.start_of_nodes(r) == 0 &&
           discretisation_.grid.saved_length(saved.columns_of(r)) == 0;
  };
  double wrong = -1.0;
  for (auto r = static_cast<std::size_t>(ranks.rank()); r < saved.ranks();
       r += static_cast<std::size_t>(ranks.size()))
    if (!is_empty(r)) try {
        numbers.check(static_cast<int>(r));
      } catch (const Error&) {
        wrong = static_cast<double>(r);
      }
  wrong = ranks.max(wrong);
  if (wrong < 0.0) return;
  numbers.check(static_cast<int>(wrong));
  throw Error(
      fmt::format("a rank cannot read the checkpoint's particles of rank {:.0f}; bring the "
                  "checkpoint to a folder that all ranks share",
                  wrong));
}

/// Takes the particles whose cell, that of the last sorting, belongs to this rank.
void ParticleDistribution::read_particles(RankNumbers& numbers, const Saved& saved,
                                          std::size_t rank, bool all) {
  const Partition& partition = discretisation_.partition;
  std::uint64_t first = 0;
  std::vector<double> chunk;
  for (std::size_t g = 0; g < saved.lengths.size(); ++g) {
    Particles& particles = discretisation_.groups[g].particles;
    const std::size_t length = particles.record_length();
    const std::size_t most = length * (1 + chunk_length / length);
    auto left = static_cast<std::uint64_t>(saved.lengths[g][rank]);
    if (all) particles.reserve(particles.size() + left / length);
    while (left > 0) {
      chunk.resize(std::min<std::uint64_t>(most, left));
      numbers.read(static_cast<int>(rank), first, chunk.data(), chunk.size());
      for (const double *next = chunk.data(), *end = next + chunk.size(); next != end;
           next += length) {
        const std::array<int, 3> cell = cell_of(next[Particles::place_in_record(column::cell)]);
        if (all || partition.owner(cell[0], cell[1]) == discretisation_.ranks().rank())
          particles.unpack(next);
      }
      first += chunk.size();
      left -= chunk.size();
    }
  }
}

}  // namespace furrow
