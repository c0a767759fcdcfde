// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/terrain_step.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/mpm/transfer/cell_average.h"

namespace furrow {

namespace {

// particles between grid and material: gradients and weights stay in the second-level cache
constexpr std::size_t step_chunk = 256;

}  // namespace

TerrainStep::TerrainStep(Discretisation& discretisation, Boundary& boundary,
                         ParticleDistribution& distribution, RemapControl& remap, PointLoads& loads,
                         TerrainEnergy& energy, const Vector3& gravity,
                         const TransferScheme& scheme, const SlideContact* slide,
                         ActiveGround* active, DividedGround* divided)
    : discretisation_(discretisation),
      boundary_(boundary),
      distribution_(distribution),
      remap_(remap),
      loads_(loads),
      energy_(energy),
      gravity_(gravity),
      scheme_(scheme),
      slide_(slide),
      active_(active),
      divided_(divided),
      kernels_(transfer_kernels()) {
  allocate(step_chunk);
}

/// Buffers of a chunk.
void TerrainStep::allocate(std::size_t particles) {
  if (particles <= normal_stress_storage_.size() / 3) return;
  gradient_storage_.resize(9 * particles);
  normal_stress_storage_.resize(3 * particles);
  weights_.resize(batches(particles));
  for (std::size_t g = 0; g < 9; ++g) gradient_[g] = gradient_storage_.data() + g * particles;
  for (std::size_t a = 0; a < 3; ++a)
    normal_stress_[a] = normal_stress_storage_.data() + a * particles;
}

/// Calls visit(first, count) for the computed particles, some at a time; those of a cell together.
template <class Visit>
void TerrainStep::for_chunks(ParticleGroup& group, Visit&& visit) {
  const double* cell = group.particles.data(column::cell);
  group.for_awake([&](std::size_t from, std::size_t to) {
    for (std::size_t first = from, end; first < to; first = end) {
      end = std::min(first + step_chunk, to);
      while (end < to && cell[end] == cell[end - 1]) ++end;
      allocate(end - first);
      visit(first, end - first);
    }
  });
}

void TerrainStep::advance(double dt) {
  if (!remap_.interval_running()) begin_remap_interval(dt);
  sum_nodal_forces();
  accelerate_nodes(dt);
  move_nodes(dt);
  update_particles(dt);
  count_energies(dt);
  end_step(dt);
}

void TerrainStep::begin_remap_interval(double dt) {
  remap_.begin_interval(dt);
  set_quadrature_positions(0.5 * (remap_.steps_left() - 1) * dt);
  if (divided_) divided_->begin_interval();
  clear_displacement();
  particles_to_grid();
}

/// Adds the forces of contacts to those of the stress, which are on the nodes already.
void TerrainStep::sum_nodal_forces() {
  loads_.scatter_to_grid();
  complete_sums();
}

void TerrainStep::complete_sums() {
  if (divided_) divided_->join_sums();
  discretisation_.add_shared_sums();
}

void TerrainStep::accelerate_nodes(double dt) {
  Grid& grid = discretisation_.grid;
  boundary_.renew_tractions(grid, discretisation_.partition.local_nodes(), gravity_);
  if (active_) active_->hold_border(dt);
  discretisation_.for_moving_nodes([&](const NodeBlock& local, const NodeBlock& owned) {
    grid.accelerate(local, dt, gravity_);
    if (slide_) energy_.add_slide_loss(slide_->apply(grid, boundary_, local, owned));
    boundary_.apply(grid, local, owned, dt);
  });
}

void TerrainStep::move_nodes(double dt) {
  node_totals_ = {};
  discretisation_.for_moving_nodes([&](const NodeBlock& local, const NodeBlock& owned) {
    const NodeTotals totals = discretisation_.grid.move(local, owned, dt);
    node_totals_.momentum += totals.momentum;
    node_totals_.kinetic_energy += totals.kinetic_energy;
  });
  if (divided_) divided_->copy_motion();
  remap_.grid_moved();
}

void TerrainStep::update_particles(double dt) {
  for (ParticleGroup& group : discretisation_.groups) {
    const GridView view = discretisation_.local_view(group.field);
    for_chunks(group, [&](std::size_t first, std::size_t count) {
      update_particles(group, first, count, view, dt);
    });
  }
}

void TerrainStep::count_energies(double dt) {
  if (active_) active_->count_load(loads_.total_force(), dt);
  energy_.set_node_totals(node_totals_);
  energy_.add_gravity_work(dt * gravity_.dot(node_totals_.momentum));
  loads_.count_work(dt, energy_);
}

void TerrainStep::end_step(double dt) {
  discretisation_.exchange.count_step();
  const double travel = remap_.count_step(dt);
  distribution_.add_drift(divided_ ? std::max(travel, divided_->speed_of_parts() * dt) : travel);
  if (!remap_.interval_running()) grid_to_particles();
}

/// Sets the positions where particles will be after a time [s]; one that would be beyond a face is
/// stopped by it before: its weights are taken where it is.
void TerrainStep::set_quadrature_positions(double time) {
  for (ParticleGroup& group : discretisation_.groups) {
    const double* v = group.particles.data(column::velocity);
    for (std::size_t a = 0; a < 3; ++a) {
      const Axis& axis = discretisation_.grid.axis(static_cast<int>(a));
      const double lower = axis.lower();
      const double upper = axis.upper();
      const double* x = group.particles.data(column::x + a);
      double* shape = group.particles.data(column::quadrature_x + a);
      group.for_awake([&](std::size_t from, std::size_t to) {
        for (std::size_t p = from; p < to; ++p) {
          const double later = x[p] + time * v[4 * p + a];
          shape[p] = later >= lower && later <= upper ? later : x[p];
        }
      });
    }
  }
}

/// A fresh grid: masses, velocities and the forces of the stress.
void TerrainStep::particles_to_grid() {
  Grid& grid = discretisation_.grid;
  clear_sums();
  for (ParticleGroup& group : discretisation_.groups)
    group.for_awake([&](std::size_t from, std::size_t to) {
      if (kernels_.scatter_momentum(discretisation_.local_view(group.field),
                                    group.particles.view(from, to - from),
                                    group.material->density()) > 0)
        distribution_.report_outside(group);
    });
  complete_sums();
  discretisation_.for_awake_nodes(
      [&](const NodeBlock& local, const NodeBlock&) { grid.compute_velocities(local); });
  if (divided_) divided_->copy_motion();
  if (active_) active_->stop_border();
  if (scheme_.residual_share > 0.0)
    for (ParticleGroup& group : discretisation_.groups)
      group.for_awake([&](std::size_t from, std::size_t to) {
        kernels_.gather_residual(discretisation_.local_view(group.field),
                                 group.particles.view(from, to - from));
      });
  scatter_stress_forces();
}

/// Finds the weights first; within an interval, update_particles() uses those of the strain.
void TerrainStep::scatter_stress_forces() {
  for (ParticleGroup& group : discretisation_.groups) {
    const GridView view = discretisation_.local_view(group.field);
    for_chunks(group, [&](std::size_t first, std::size_t count) {
      const ParticleView particles = group.particles.view(first, count);
      kernels_.find_weights(view, particles, weights_.data());
      scatter_force(view, particles);
    });
  }
}

/// Strain, stress and, unless this step ends the interval, the force of the new stress for the next
/// step; of a chunk of particles.
void TerrainStep::update_particles(ParticleGroup& group, std::size_t first, std::size_t count,
                                   const GridView& grid, double dt) {
  const ParticleView particles = group.particles.view(first, count);
  kernels_.find_weights(grid, particles, weights_.data());
  kernels_.gather_strain(grid, particles, weights_.data(), dt, gradient_.data());
  if (scheme_.cell_average) average_volume_change(particles, gradient_.data());
  // The work of the mean of the stresses before and after the step: with either alone, the audit of
  // a vibrating body drifts by O(dt).
  energy_.add_half_stress_work(kernels_.stress_work(particles, gradient_.data()));
  update_stress(group, first, count, dt);
  energy_.add_half_stress_work(kernels_.stress_work(particles, gradient_.data()));
  if (!remap_.last_step()) scatter_force(grid, particles);
}

/// Scatters the force of the stress with the mean pressure of each cell; the weights are known.
void TerrainStep::scatter_force(const GridView& grid, ParticleView particles) {
  if (scheme_.cell_average) average_pressure(particles, normal_stress_.data());
  kernels_.scatter_force(grid, particles, weights_.data());
}

void TerrainStep::update_stress(ParticleGroup& group, std::size_t first, std::size_t count,
                                double dt) {
  PointBlock block;
  block.size = count;
  std::copy(gradient_.begin(), gradient_.end(), block.gradient.begin());
  group.particles.state_pointers(first, state_pointers_);
  block.state = state_pointers_.data();
  block.time_step = dt;
  try {
    group.material->update_block(block);
  } catch (const PointError& error) {
    const Vector3 x = group.particles.position(first + error.point);
    throw StateError(
        fmt::format("the particle at {:.4g} {:.4g} {:.4g} m: {}", x[0], x[1], x[2], error.what()));
  }
}

void TerrainStep::grid_to_particles() {
  if (!remap_.particles_lag()) return;
  remap_.particles_updated();
  if (active_) active_->add_motion();
  const double share = remap_.residual_share();
  for (ParticleGroup& group : discretisation_.groups)
    group.for_awake([&](std::size_t from, std::size_t to) {
      kernels_.gather_motion(discretisation_.local_view(group.field),
                             group.particles.view(from, to - from), share);
    });
  clear_displacement();
}

void TerrainStep::clear_sums() {
  discretisation_.for_awake_nodes(
      [&](const NodeBlock& local, const NodeBlock&) { discretisation_.grid.clear_sums(local); });
}

void TerrainStep::clear_displacement() {
  discretisation_.for_awake_nodes([&](const NodeBlock& local, const NodeBlock&) {
    discretisation_.grid.clear_displacement(local);
  });
}

void TerrainStep::capture_initial_tractions() {
  if (boundary_.has_initial_tractions()) return;
  set_quadrature_positions(0.0);
  particles_to_grid();
  discretisation_.add_shared_sums();
  boundary_.capture_initial_tractions(discretisation_.grid, discretisation_.partition.local_nodes(),
                                      gravity_);
}

void TerrainStep::restore_stress_forces() {
  if (!remap_.interval_running()) return;
  clear_sums();
  scatter_stress_forces();
}

}  // namespace furrow
