// SPDX-License-Identifier: GPL-2.0-or-later
// Where the particles of continuum ground are: order in memory, ranks, and ground that moves.
#include <algorithm>
#include <limits>
#include <numeric>

#include "mpm/continuum_terrain.h"

namespace furrow {

void ContinuumTerrain::sort() {
  drift_ = 0.0;
  ++generation_;
  migrate();
  const std::size_t ny = static_cast<std::size_t>(grid_.axis(1).cells()),
                    nz = static_cast<std::size_t>(grid_.axis(2).cells());
  std::vector<std::size_t> cell, start, order;
  for (ParticleGroup& group : groups_) {
    const std::size_t n = group.particles.size();
    cell.resize(n);
    start.assign(static_cast<std::size_t>(grid_.axis(0).cells()) * ny * nz + 1, 0);
    for (std::size_t p = 0; p < n; ++p) {
      const Vector3 x = group.particles.position(p);
      const int c[3] = {grid_.axis(0).cell_of(x[0]), grid_.axis(1).cell_of(x[1]),
                        grid_.axis(2).cell_of(x[2])};
      if (c[0] < 0 || c[1] < 0 || c[2] < 0) report_outside(group);
      cell[p] = (static_cast<std::size_t>(c[0]) * ny + static_cast<std::size_t>(c[1])) * nz +
                static_cast<std::size_t>(c[2]);
      ++start[cell[p] + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    order.resize(n);
    for (std::size_t p = 0; p < n; ++p) order[start[cell[p]]++] = p;
    group.particles.reorder(order);
  }
  if (free_surface_.exists()) free_surface_.relocate(groups_);
}

/// Balances the slabs and sends every particle to the owner of its cell.
void ContinuumTerrain::migrate() {
  if (ranks().size() == 1) return;
  const Axis& x = grid_.axis(0);
  std::vector<double> count(static_cast<std::size_t>(x.cells()), 0.0);
  for (const ParticleGroup& group : groups_)
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const int cell = x.cell_of(group.particles.data(column::x)[p]);
      if (cell < 0) report_outside(group);
      ++count[static_cast<std::size_t>(cell)];
    }
  ranks().sum(count.data(), count.size());
  boundary_.synchronise(ranks(), partition_.owned());
  partition_.rebalance(count);
  std::vector<std::size_t> staying;
  for (ParticleGroup& group : groups_) {
    std::vector<std::vector<double>> leaving(static_cast<std::size_t>(ranks().size()));
    staying.clear();
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const int owner = partition_.owner(x.cell_of(group.particles.data(column::x)[p]));
      if (owner == ranks().rank())
        staying.push_back(p);
      else
        group.particles.pack(p, leaving[static_cast<std::size_t>(owner)]);
    }
    group.particles.reorder(staying);
    for (int r = 0; r < ranks().size(); ++r) {
      if (r == ranks().rank()) continue;
      const std::vector<double> arriving =
          ranks().exchange(r, leaving[static_cast<std::size_t>(r)]);
      for (std::size_t n = 0; n < arriving.size(); n += group.particles.record_length())
        group.particles.unpack(arriving.data() + n);
    }
  }
}

// ---- moving ground ------------------------------------------------------------------------------

double ContinuumTerrain::travelled() const { return grid_.axis(0).lower() - start_; }

void ContinuumTerrain::move_window() {
  if (!parameters_.window) return;
  const Axis& x = grid_.axis(0);
  bool moved = false;
  while (focus_ > 0.5 * (x.lower() + x.upper()) + x.length(0)) {
    remove_behind();
    if (!moved) boundary_.synchronise(ranks(), partition_.owned());  // rows go over from rank to rank
    grid_.shift_x(1);
    boundary_.shift_x(1);
    ++shifts_;
    const double before = internal_energy();
    add_column(x.cells() - 1);
    initial_ += internal_energy() - before;
    moved = true;
  }
  if (moved) sort();
}

void ContinuumTerrain::remove_behind() {
  const Axis &x = grid_.axis(0), &y = grid_.axis(1);
  const double edge = x.knot(1);
  std::vector<double> top(static_cast<std::size_t>(y.cells()),
                          -std::numeric_limits<double>::infinity()),
      mass(top.size(), 0.0), volume(top.size(), 0.0);
  const double before = internal_energy(), heat_before = energy(field::dissipated_energy);
  std::vector<std::size_t> kept;
  for (ParticleGroup& group : groups_) {
    const Particles& particles = group.particles;
    kept.clear();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      if (particles.data(column::x)[p] >= edge) {
        kept.push_back(p);
        continue;
      }
      const auto row = static_cast<std::size_t>(y.cell_of(particles.data(column::y)[p]));
      const double ratio = particles.data(column::state + field::volume_ratio)[p],
                   reference = particles.data(column::volume)[p];
      top[row] = std::max(top[row],
                          particles.data(column::z)[p] + particles.data(column::half_z)[p] * ratio);
      mass[row] += group.material->density() * reference;
      volume[row] += reference * ratio;
      dropped_kinetic_ +=
          0.5 * group.material->density() * reference * particles.velocity(p).squaredNorm();
    }
    group.particles.reorder(kept);
  }
  dropped_internal_ += before - internal_energy();
  dropped_dissipated_ += heat_before - energy(field::dissipated_energy);
  for (std::size_t row = 0; row < top.size(); ++row)
    if (volume[row] > 0.0)
      rut_.push_back({0.5 * (x.lower() + edge),
                      y.knot(static_cast<int>(row)) + 0.5 * y.length(static_cast<int>(row)),
                      top[row], mass[row] / volume[row]});
}

}  // namespace furrow
