// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/moving_window.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

MovingWindow::MovingWindow(const TerrainParameters& parameters, Discretisation& discretisation,
                           const ParticleDistribution& distribution, Boundary& boundary,
                           TerrainFill& fill, TerrainEnergy& energy, const std::string& where)
    : enabled_(parameters.window),
      cells_(1 << parameters.halvings),
      per_cell_(static_cast<std::size_t>(parameters.particles_per_cell[0])),
      has_surface_mesh_(parameters.surface_mesh),
      discretisation_(discretisation),
      distribution_(distribution),
      boundary_(boundary),
      fill_(fill),
      energy_(energy),
      followed_x_(0.5 * (parameters.x.lower + parameters.x.upper)),
      start_(parameters.x.lower) {
  if (!enabled_) return;
  check(parameters, where);
  if (parameters.slabs > 0)
    stride_ = discretisation.grid.axis(0).cells() / static_cast<int>(parameters.slabs);
}

void MovingWindow::check(const TerrainParameters& parameters, const std::string& where) const {
  const Axis& x = discretisation_.grid.axis(0);
  if (!x.uniform() && cells_ == 1)
    throw InputError(where, "moves along a graded x axis",
                     "a uniform x axis for ground that moves, or one of 'fine_length'",
                     "'edges' of a body that is no wheel need ground that stays");
  const int slabs = static_cast<int>(parameters.slabs);
  if (has_surface_mesh_ && slabs == 0)
    throw InputError(where, "follows a body and has a surface mesh",
                     "a terrain that moves by slabs",
                     "write 'slabs <number>', and name this terrain in the line of the bed/window "
                     "with 'terrain'");
  if (slabs > 0 && x.cells() % slabs != 0)
    throw InputError(where, fmt::format("has {} cells along x in {} slabs", x.cells(), slabs),
                     "slabs of a whole number of cells",
                     fmt::format("make 'length' {:.6g} or {:.6g} m, or change 'cell' or 'slabs'",
                                 (x.cells() / slabs) * slabs * x.length(0),
                                 (x.cells() / slabs + 1) * slabs * x.length(0)));
}

double MovingWindow::travelled() const { return discretisation_.grid.axis(0).lower() - start_; }

std::size_t MovingWindow::dropped_slabs() const {
  return static_cast<std::size_t>(shifts_ / stride_);
}

bool MovingWindow::move() {
  if (!enabled_) return false;
  const Axis& x = discretisation_.grid.axis(0);
  bool moved = false;
  while (followed_x_ > 0.5 * (x.lower() + x.upper()) + lead()) {
    // Rows of the far field pass from rank to rank when the grid moves.
    if (!moved)
      boundary_.synchronise(discretisation_.ranks(), discretisation_.partition.owned_nodes());
    for (int layer = 0; layer < stride_; ++layer) move_by_layer();
    moved = true;
  }
  return moved;
}

/// Largest distance of the middle behind the followed body [m].
double MovingWindow::lead() const {
  const Axis& x = discretisation_.grid.axis(0);
  return cells_ == 1 ? stride_ * x.length(0) : 0.5 * cells_ * x.fine_cell();
}

double MovingWindow::first_layer_end() const {
  const Axis& x = discretisation_.grid.axis(0);
  return cells_ == 1 ? x.knot(1) : x.lower() + cells_ * x.fine_cell();
}

void MovingWindow::move_by_layer() {
  remove_first_layer();
  discretisation_.grid.shift_x(cells_);
  boundary_.shift_x(cells_);
  shifts_ += cells_;
  const double before = internal_energy(discretisation_.groups);
  fill_.add_ahead(discretisation_);
  energy_.add_initial(internal_energy(discretisation_.groups) - before);
}

/// Removes this rank's particles in the first layer across x. Particles of a surface mesh
/// that came there from further ahead, against the travel, are kept: they go to the new end of the
/// ground, where undisturbed ones would be. Collective.
void MovingWindow::remove_first_layer() {
  const Axis& y = discretisation_.grid.axis(1);
  const double edge = first_layer_end();
  // Top, mass and volume of the removed particles, by row of cells along y
  std::vector<double> top(static_cast<std::size_t>(y.cells()),
                          -std::numeric_limits<double>::infinity());
  std::vector<double> mass(top.size(), 0.0);
  std::vector<double> volume(top.size(), 0.0);
  const double internal_before = internal_energy(discretisation_.groups);
  const double dissipated_before = sum_energy(discretisation_.groups, field::dissipated_energy);
  std::vector<std::size_t> kept;
  for (ParticleGroup& group : discretisation_.groups) {
    Particles& particles = group.particles;
    kept.clear();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      double& x = particles.data(column::x)[p];
      const bool came_back = x < edge && has_surface_mesh_ &&
                             fill_.column_of(discretisation_.grid, particles.data(column::id)[p]) >=
                                 static_cast<std::size_t>(shifts_ + 1) * per_cell_;
      if (came_back) x = edge + particles.half_spacing(p).x();
      if (x >= edge) {
        kept.push_back(p);
        continue;
      }
      const int cell = y.cell_of(particles.data(column::y)[p]);
      if (cell < 0) distribution_.report_outside(group);
      const auto row = static_cast<std::size_t>(cell);
      const double ratio = particles.volume_ratio(p);
      top[row] = std::max(top[row],
                          particles.data(column::z)[p] + particles.data(column::half_z)[p] * ratio);
      mass[row] += group.mass(p);
      volume[row] += particles.data(column::volume)[p] * ratio;
      energy_.add_removed_kinetic(0.5 * group.mass(p) * particles.velocity(p).squaredNorm());
    }
    particles.reorder(kept);
  }
  energy_.add_removed(
      internal_before - internal_energy(discretisation_.groups),
      dissipated_before - sum_energy(discretisation_.groups, field::dissipated_energy));
  // A row may have particles of two ranks: they change ranks when they are sorted.
  const Communicator& ranks = discretisation_.ranks();
  ranks.max(top.data(), top.size());
  ranks.sum(mass.data(), mass.size());
  ranks.sum(volume.data(), volume.size());
  if (ranks.rank() == 0) record_rut(top, mass, volume);
}

/// @param top, mass, volume  of the removed ground in each row of cells along y [m], [kg], [m^3]
void MovingWindow::record_rut(const std::vector<double>& top, const std::vector<double>& mass,
                              const std::vector<double>& volume) {
  const Axis& x = discretisation_.grid.axis(0);
  const Axis& y = discretisation_.grid.axis(1);
  for (std::size_t row = 0; row < top.size(); ++row) {
    if (!(volume[row] > 0.0)) continue;
    const int cell = static_cast<int>(row);
    rut_.add({0.5 * (x.lower() + first_layer_end()), y.knot(cell) + 0.5 * y.length(cell), top[row],
              mass[row] / volume[row]});
  }
}

void MovingWindow::checkpoint_position(Checkpoint& state) {
  int shifts = shifts_;
  state.value("shifts", shifts);
  discretisation_.grid.shift_x(shifts - shifts_);
  shifts_ = shifts;
  state.value("followed_x", followed_x_);
}

void MovingWindow::checkpoint_rut(Checkpoint& state) {
  rut_.checkpoint(state, discretisation_.ranks());
}

}  // namespace furrow
