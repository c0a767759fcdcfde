// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/continuum_terrain.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

// particles between grid and law: gradients and weights stay in the second cache
constexpr std::size_t chunk = 256;
constexpr double max_travel = 0.05;    // in a cycle, of the shortest cell times the volume ratio
constexpr double max_drift = 0.5;      // of the shortest cell between two sortings
constexpr double max_off_knot = 1e-6;  // of the cell: the surface is where two cells meet

Grid make_grid(const TerrainParameters& ground, const std::string& where) {
  Grid grid(Axis(ground.x, where + ", x axis"), Axis(ground.y, where + ", y axis"),
            Axis(ground.z, where + ", z axis"));
  if (ground.window && !grid.axis(0).uniform())
    throw InputError(where, "moves along a graded x axis",
                     "a uniform x axis for ground that moves");
  const Axis& z = grid.axis(2);
  const int cell = z.cell_of(ground.surface);
  const double off =
      cell < 0 ? 1.0
               : std::min(ground.surface - z.knot(cell), z.knot(cell + 1) - ground.surface) /
                     z.length(cell);
  if (off > max_off_knot)
    throw InputError(
        where, fmt::format("has its surface at z = {:.6g} m, inside of a cell", ground.surface),
        "the height of an end of a cell",
        "let the fine stretch of the z axis be a whole number of cells below the surface and above "
        "it");
  return grid;
}

std::vector<WaveSpeeds> speeds_of_levels(const Grid& grid, const std::vector<ParticleLevel>& levels,
                                         const TerrainParameters& ground) {
  std::vector<WaveSpeeds> speeds;
  for (int k = 0; k < grid.nodes(2); ++k) {
    const auto nearest = std::min_element(
        levels.begin(), levels.end(), [&](const ParticleLevel& a, const ParticleLevel& b) {
          return std::abs(a.z - grid.axis(2).node(k)) < std::abs(b.z - grid.axis(2).node(k));
        });
    const Material& material = *ground.layers[nearest->layer].material;
    const ElasticModuli moduli = material.moduli(nearest->state);
    const double density = material.current_density(nearest->state);
    speeds.push_back({std::sqrt(moduli.wave() / density), std::sqrt(moduli.shear / density)});
  }
  return speeds;
}

/// Levels of particles from the surface down.
std::vector<ParticleLevel> make_levels(const Grid& grid, const TerrainParameters& ground) {
  std::vector<ParticleLevel> levels;
  const Axis& z = grid.axis(2);
  const int count = ground.particles_per_cell[2];
  for (int cell = z.cells() - 1; cell >= 0; --cell) {
    if (z.knot(cell) + 0.5 * z.length(cell) > ground.surface) continue;
    for (int n = count - 1; n >= 0; --n) {
      ParticleLevel level;
      level.z = z.knot(cell) + (n + 0.5) * z.length(cell) / count;
      level.half = 0.5 * z.length(cell) / count;
      levels.push_back(level);
    }
  }
  find_overburden(ground, levels);
  return levels;
}

}  // namespace

ContinuumTerrain::ContinuumTerrain(const TerrainParameters& parameters, const Communicator& ranks,
                                   const std::string& where)
    : parameters_(parameters),
      where_(where),
      grid_(make_grid(parameters, where)),
      levels_(make_levels(grid_, parameters)),
      partition_(ranks, grid_.axis(0).cells()),
      boundary_(grid_, parameters.faces, parameters.particles_per_cell,
             speeds_of_levels(grid_, levels_, parameters)),
      kernels_(transfer_kernels()),
      gradient_(9 * chunk),
      weights_(batches(chunk)),
      focus_(0.5 * (parameters.x.lower + parameters.x.upper)),
      start_(parameters.x.lower) {
  if (parameters.window && (parameters.faces[x_lower] == BoundaryKind::absorbing ||
                            parameters.faces[x_upper] == BoundaryKind::absorbing))
    throw InputError(where, "moves along x and absorbs there",
                     "smooth, rough or free faces across x for ground that moves");
  for (const TerrainLayer& layer : parameters_.layers)
    groups_.push_back({layer.material, Particles(*layer.material)});
  if (parameters.window && parameters.sheet)
    throw InputError(where, "moves along x and carries a sheet", "one of the two",
                     "grains on moving ground would be left behind");
  fill();
  if (parameters.sheet) make_free_surface();
  if (!boundary_.captured()) {
    set_shape_positions(0.0);
    particles_to_grid();
    partition_.sum_shared(grid_);
    boundary_.capture(grid_, partition_.touched(), parameters_.gravity);
  }
}

void ContinuumTerrain::fill() {
  const int cells = grid_.axis(0).cells();
  partition_.rebalance(std::vector<double>(static_cast<std::size_t>(cells), 1.0));
  for (int cell = 0; cell < cells; ++cell) add_column(cell);
  initial_ = internal_energy();
  sort();
}

void ContinuumTerrain::make_free_surface() {
  const auto& per_cell = parameters_.particles_per_cell;
  const auto columns = static_cast<std::size_t>(grid_.axis(0).cells() * per_cell[0]),
             rows = static_cast<std::size_t>(grid_.axis(1).cells() * per_cell[1]);
  std::vector<double> top(columns * rows);
  for (std::size_t n = 0; n < top.size(); ++n)
    top[n] = static_cast<double>(n * levels_.size());  // the order of add_column()
  free_surface_ = FreeSurfaceMesh(std::move(top), rows, columns);
  free_surface_.relocate(groups_);
  update_free_surface();
}

void ContinuumTerrain::update_free_surface() {
  free_surface_.follow(groups_,
                       [&](double* numbers, std::size_t count) { ranks().sum(numbers, count); });
}

/// The undisturbed particles of a column of cells across y and z, if it is this rank's. Ids are
/// counted on all ranks.
void ContinuumTerrain::add_column(int cell) {
  const Axis &x = grid_.axis(0), &y = grid_.axis(1);
  const auto& per_cell = parameters_.particles_per_cell;
  const bool mine = partition_.owner(cell) == ranks().rank();
  for (int i = 0; i < per_cell[0]; ++i)
    for (int row = 0; row < y.cells(); ++row)
      for (int j = 0; j < per_cell[1]; ++j)
        for (const ParticleLevel& level : levels_) {
          const double id = next_id_++;
          if (!mine) continue;
          Particles& particles = groups_[level.layer].particles;
          const std::size_t p = particles.append(1);
          const double half_x = 0.5 * x.length(cell) / per_cell[0],
                       half_y = 0.5 * y.length(row) / per_cell[1];
          const double position[3] = {x.knot(cell) + (2 * i + 1) * half_x,
                                      y.knot(row) + (2 * j + 1) * half_y, level.z};
          const double half[3] = {half_x, half_y, level.half};
          for (std::size_t a = 0; a < 3; ++a) {
            particles.data(column::x + a)[p] = position[a];
            particles.data(column::initial_x + a)[p] = position[a];
            particles.data(column::half_x + a)[p] = half[a];
          }
          particles.data(column::volume)[p] =
              8.0 * half_x * half_y * level.half / level.state[field::volume_ratio];
          particles.data(column::id)[p] = id;
          particles.set_state(p, level.state);
        }
  ++generation_;
}

/// The d_i/sqrt(D) are orthonormal under the weights N_i, so that |sum_i u_i G_i^T|^2 <= sum_i N_i
/// |u_i|^2/D (Bessel) and omega^2 <= 3 K/(rho D) with D = h^2/4, the largest eigenvalue of an
/// elasticity with nu >= 0: on any arrangement of particles, away from faces. Wave speeds have M in
/// the place of 3 K; cfl makes up for that (coupling/terrain/fix_terrain_continuum.md).
double ContinuumTerrain::stable_time_step() const {
  double fastest = 0.0;
  for (const ParticleGroup& group : groups_) {
    if (group.particles.size() == 0) continue;
    std::vector<double*> pointers;
    const_cast<Particles&>(group.particles).state_pointers(0, pointers);
    PointBlock block;
    block.size = group.particles.size();
    block.state = pointers.data();
    fastest = std::max(fastest, group.material->largest_wave_speed(block));
  }
  return parameters_.cfl * grid_.shortest_cell() / ranks().max(fastest + largest_speed_);
}

void ContinuumTerrain::advance(double dt) {
  if (free_surface_.exists())
    free_surface_.scatter_forces(
        groups_, [&](const ParticleIndex& near, const Vector3& force, const Vector3& point) {
          add_point_force(near, force, point);
        });
  if (!remap_pending()) begin_remap_interval(dt);
  scatter_contact_forces();
  partition_.sum_shared(grid_);
  grid_.accelerate(partition_.touched(), dt, parameters_.gravity);
  boundary_.apply(grid_, partition_.touched(), partition_.owned(), dt);
  totals_ = grid_.move(partition_.touched(), partition_.owned(), dt);
  gravity_work_ += dt * parameters_.gravity.dot(totals_.momentum);
  unsynchronised_ = true;
  update_stress(dt);
  count_contact_work(dt);
  const double way = ranks().max(largest_speed_) * dt;
  drift_ += way;
  travel_ += way;
  // A push can make the ground faster than it was when the cycle began.
  if (--steps_left_ == 0 || travel_ > 2.0 * max_travel * grid_.shortest_cell()) remap();
  if (free_surface_.exists()) {
    update_particles();
    update_free_surface();
  }
}

/// Long enough that mapping takes little, short enough that the weights fit: the more a particle is
/// compacted, the thinner is what it stands for, and the less it may travel.
void ContinuumTerrain::begin_remap_interval(double dt) {
  double square = 0.0, square_over_ratio = 0.0;
  for (const ParticleGroup& group : groups_) {
    const double *v = group.particles.data(column::velocity),
                 *ratio = group.particles.data(column::state + field::volume_ratio);
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const double own =
          v[4 * p] * v[4 * p] + v[4 * p + 1] * v[4 * p + 1] + v[4 * p + 2] * v[4 * p + 2];
      square = std::max(square, own);
      square_over_ratio = std::max(square_over_ratio, own / (ratio[p] * ratio[p]));
    }
  }
  largest_speed_ = std::sqrt(square);
  travel_ = 0.0;
  const double pace = ranks().max(std::sqrt(square_over_ratio)), most = parameters_.remap_interval,
               steps = pace > 0.0 ? max_travel * grid_.shortest_cell() / (pace * dt) : most;
  steps_left_ = std::max(1, static_cast<int>(std::min(steps, most)));
  set_shape_positions(0.5 * (steps_left_ - 1) * dt);
  grid_.clear_displacement(partition_.touched());
  particles_to_grid();
}

/// A fresh grid: masses, velocities and the forces of the stress.
void ContinuumTerrain::particles_to_grid() {
  grid_.clear_sums(partition_.touched());
  const GridView view = local_view();
  for (ParticleGroup& group : groups_)
    if (kernels_.scatter_momentum(view, group.particles.view(0, group.particles.size()),
                                  group.material->density()) > 0)
      report_outside(group);
  partition_.sum_shared(grid_);
  grid_.start(partition_.touched());
  scatter_stress_forces();
}

/// Weights are taken where particles will be after a time; where that is beyond a face, which stops
/// them first, where they are.
void ContinuumTerrain::set_shape_positions(double time) {
  for (ParticleGroup& group : groups_) {
    const double* v = group.particles.data(column::velocity);
    for (std::size_t a = 0; a < 3; ++a) {
      const double* x = group.particles.data(column::x + a);
      double* reference = group.particles.data(column::shape_x + a);
      const double lower = grid_.axis(static_cast<int>(a)).lower(),
                   upper = grid_.axis(static_cast<int>(a)).upper();
      for (std::size_t p = 0; p < group.particles.size(); ++p) {
        const double later = x[p] + time * v[4 * p + a];
        reference[p] = later >= lower && later <= upper ? later : x[p];
      }
    }
  }
}

void ContinuumTerrain::remap() {
  steps_left_ = 0;
  update_particles();
  move_window();
  if (drift_ > max_drift * grid_.shortest_cell()) sort();
}

void ContinuumTerrain::update_particles() {
  if (!unsynchronised_) return;
  unsynchronised_ = false;
  const GridView view = local_view();
  for (ParticleGroup& group : groups_)
    kernels_.gather_motion(view, group.particles.view(0, group.particles.size()));
  grid_.clear_displacement(partition_.touched());
}

std::vector<ParticleGroup>& ContinuumTerrain::groups() {
  update_particles();
  return groups_;
}

/// Particles may be in this rank's slab and one cell beyond.
GridView ContinuumTerrain::local_view() {
  GridView view = grid_.view();
  view.axis[0].from = grid_.axis(0).knot(partition_.first_cell());
  view.axis[0].to = grid_.axis(0).knot(partition_.last_cell() + 1);
  return view;
}

/// Of the stress, with weights found anew; in a cycle update_stress() does it with those of the
/// strain.
void ContinuumTerrain::scatter_stress_forces() {
  const GridView view = local_view();
  for (ParticleGroup& group : groups_)
    for (std::size_t first = 0; first < group.particles.size(); first += chunk) {
      const ParticleView particles =
          group.particles.view(first, std::min(chunk, group.particles.size() - first));
      kernels_.find_weights(view, particles, weights_.data());
      kernels_.scatter_force(view, particles, weights_.data());
    }
}

void ContinuumTerrain::scatter_contact_forces() {
  point_forces_.clear();
  for (const PointLoad& push : point_loads_) {
    const Vector3 reference = groups_[push.near.group].particles.shape_position(push.near.particle),
                  &force = push.force, lever = push.point - reference;
    point_forces_.push_back({{reference[0], reference[1], reference[2]},
                             {force[0], force[1], force[2]},
                             {lever[0], lever[1], lever[2]}});
  }
  kernels_.scatter_point_forces(local_view(), point_forces_.data(), point_forces_.size());
}

/// Strain, law and, while the weights stay, the force that the new stress has in the next step.
void ContinuumTerrain::update_stress(double dt) {
  const bool last = steps_left_ == 1;
  const GridView view = local_view();
  std::array<double*, 9> gradient;
  for (std::size_t g = 0; g < 9; ++g) gradient[g] = gradient_.data() + g * chunk;
  report_ = {};
  for (ParticleGroup& group : groups_)
    for (std::size_t first = 0; first < group.particles.size(); first += chunk) {
      const std::size_t count = std::min(chunk, group.particles.size() - first);
      const ParticleView particles = group.particles.view(first, count);
      kernels_.find_weights(view, particles, weights_.data());
      kernels_.gather_strain(view, particles, weights_.data(), dt, gradient.data());
      // By the mean of the stresses before and after the step: with either alone the audit of a
      // vibrating body drifts by O(dt).
      stress_work_ += 0.5 * kernels_.stress_work(particles, gradient.data());
      PointBlock block;
      block.size = count;
      std::copy(gradient.begin(), gradient.end(), block.gradient.begin());
      group.particles.state_pointers(first, state_pointers_);
      block.state = state_pointers_.data();
      block.time_step = dt;
      try {
        report_ += group.material->update_block(block);
      } catch (const PointError& error) {
        const Vector3 x = group.particles.position(first + error.point);
        throw StateError(fmt::format("the particle at {:.4g} {:.4g} {:.4g} m: {}", x[0], x[1], x[2],
                                     error.what()));
      }
      stress_work_ += 0.5 * kernels_.stress_work(particles, gradient.data());
      if (!last) kernels_.scatter_force(view, particles, weights_.data());
    }
}

// ---- contact ------------------------------------------------------------------------------------

void ContinuumTerrain::add_point_force(const ParticleIndex& near, const Vector3& force,
                                       const Vector3& point) {
  point_loads_.push_back({near, force, point});
}

void ContinuumTerrain::probe(const std::vector<ParticleIndex>& points,
                             std::vector<ParticleMotion>& motions) {
  motions.resize(points.size());
  if (!unsynchronised_) {
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Particles& particles = groups_[points[n].group].particles;
      const std::size_t p = points[n].particle;
      const Vector3 x = particles.position(p);
      motions[n] = {x, remap_pending() ? particles.shape_position(p) : x, particles.velocity(p),
                    particles.affine(p)};
    }
    return;
  }
  point_motions_.resize(points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    Eigen::Map<Vector3>(point_motions_[n].position) =
        groups_[points[n].group].particles.shape_position(points[n].particle);
  kernels_.probe(local_view(), point_motions_.data(), points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const PointMotion& point = point_motions_[n];
    motions[n].reference = Eigen::Map<const Vector3>(point.position);
    motions[n].position = groups_[points[n].group].particles.position(points[n].particle) +
                          Eigen::Map<const Vector3>(point.displacement);
    motions[n].velocity = Eigen::Map<const Vector3>(point.velocity);
    motions[n].affine = Eigen::Map<const Eigen::Matrix<double, 4, 3>>(point.affine).topRows<3>();
  }
}

void ContinuumTerrain::count_contact_work(double dt) {
  if (point_loads_.empty()) return;
  pushed_.clear();
  for (const PointLoad& push : point_loads_) pushed_.push_back(push.near);
  probe(pushed_, pushed_motions_);
  for (std::size_t n = 0; n < point_loads_.size(); ++n) {
    contact_work_ +=
        dt * point_loads_[n].force.dot(pushed_motions_[n].velocity_at(point_loads_[n].point));
    largest_speed_ = std::max(largest_speed_, pushed_motions_[n].velocity.norm());
  }
  point_loads_.clear();
}

// ---- errors and balance -------------------------------------------------------------------------

void ContinuumTerrain::report_outside(const ParticleGroup& group) const {
  for (std::size_t p = 0; p < group.particles.size(); ++p) {
    const Vector3 x = group.particles.position(p);
    for (int a = 0; a < 3; ++a)
      if (grid_.axis(a).cell_of(x[a]) < 0)
        throw StateError(fmt::format(
            "a particle is at {:.4g} {:.4g} {:.4g} m, outside of the grid (x {:.4g} to {:.4g}, y "
            "{:.4g} to "
            "{:.4g}, z {:.4g} to "
            "{:.4g} m): give the ground more headroom or size, or look for an unstable contact",
            x[0], x[1], x[2], grid_.axis(0).lower(), grid_.axis(0).upper(), grid_.axis(1).lower(),
            grid_.axis(1).upper(), grid_.axis(2).lower(), grid_.axis(2).upper()));
  }
  throw StateError(
      fmt::format("particles moved more than a cell in {:.2g} m of expected drift: the ground has "
                  "become unstable",
                  drift_));
}

double ContinuumTerrain::energy(std::size_t kind) const {
  double sum = 0.0;
  for (const ParticleGroup& group : groups_) {
    const double *volume = group.particles.data(column::volume),
                 *energy = group.particles.data(column::state + kind);
    for (std::size_t p = 0; p < group.particles.size(); ++p) sum += volume[p] * energy[p];
  }
  return sum;
}

double ContinuumTerrain::internal_energy() const {
  return energy(field::stored_energy) + energy(field::frozen_energy) +
         energy(field::dissipated_energy);
}

Vector3 ContinuumTerrain::particle_momentum() const {
  Vector3 momentum = Vector3::Zero();
  for (const ParticleGroup& group : groups_)
    for (std::size_t p = 0; p < group.particles.size(); ++p)
      momentum += group.material->density() * group.particles.data(column::volume)[p] *
                  group.particles.velocity(p);
  return momentum;
}

EnergyBudget ContinuumTerrain::energy_budget() const {
  const double dissipated = energy(field::dissipated_energy) + dropped_dissipated_;
  const Vector3 momentum = unsynchronised_ ? totals_.momentum : particle_momentum();
  const double kinetic = totals_.kinetic_energy + dropped_kinetic_,
               load = gravity_work_ + boundary_.work();
  double sums[] = {kinetic,      internal_energy() - initial_ + dropped_internal_ - dissipated,
                   dissipated,   contact_work_,
                   load,         contact_work_ + load - stress_work_ - kinetic,
                   momentum.x(), momentum.y(),
                   momentum.z()};
  ranks().sum(sums, std::size(sums));
  EnergyBudget budget;
  budget.kinetic_energy = sums[0];
  budget.stored_energy = sums[1];
  budget.dissipated_energy = sums[2];
  budget.contact_work = sums[3];
  budget.load_work = sums[4];
  budget.numerical_loss = sums[5];
  budget.momentum = {sums[6], sums[7], sums[8]};
  return budget;
}

Vector3 ContinuumTerrain::face_impulse(Face face) const {
  Vector3 impulse = boundary_.impulse(face);
  ranks().sum(impulse.data(), 3);
  return impulse;
}

double ContinuumTerrain::particle_count() const {
  double count = 0.0;
  for (const ParticleGroup& group : groups_) count += static_cast<double>(group.particles.size());
  return ranks().sum(count);
}

}  // namespace furrow
