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
constexpr double most_travel = 0.05;    // in a cycle, of the shortest cell times the volume ratio
constexpr double most_drift = 0.5;      // of the shortest cell between two sortings
constexpr double most_off_knot = 1e-6;  // of the cell: the surface is where two cells meet

Grid make_grid(const GroundParameters& ground, const std::string& where) {
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
  if (off > most_off_knot)
    throw InputError(
        where, fmt::format("has its surface at z = {:.6g} m, inside of a cell", ground.surface),
        "the height of an end of a cell",
        "let the fine stretch of the z axis be a whole number of cells below the surface and above "
        "it");
  return grid;
}

std::vector<WaveSpeeds> speeds_of_levels(const Grid& grid, const std::vector<GroundLevel>& levels,
                                         const GroundParameters& ground) {
  std::vector<WaveSpeeds> speeds;
  for (int k = 0; k < grid.nodes(2); ++k) {
    const auto nearest = std::min_element(
        levels.begin(), levels.end(), [&](const GroundLevel& a, const GroundLevel& b) {
          return std::abs(a.z - grid.axis(2).node(k)) < std::abs(b.z - grid.axis(2).node(k));
        });
    const Material& law = *ground.layers[nearest->layer].law;
    const ElasticModuli moduli = law.moduli(nearest->state);
    const double density = law.current_density(nearest->state);
    speeds.push_back({std::sqrt(moduli.wave() / density), std::sqrt(moduli.shear / density)});
  }
  return speeds;
}

/// Levels of particles from the surface down.
std::vector<GroundLevel> make_levels(const Grid& grid, const GroundParameters& ground) {
  std::vector<GroundLevel> levels;
  const Axis& z = grid.axis(2);
  const int count = ground.particles_per_cell[2];
  for (int cell = z.cells() - 1; cell >= 0; --cell) {
    if (z.knot(cell) + 0.5 * z.length(cell) > ground.surface) continue;
    for (int n = count - 1; n >= 0; --n) {
      GroundLevel level;
      level.z = z.knot(cell) + (n + 0.5) * z.length(cell) / count;
      level.half = 0.5 * z.length(cell) / count;
      levels.push_back(level);
    }
  }
  find_overburden(ground, levels);
  return levels;
}

}  // namespace

MpmGround::MpmGround(const GroundParameters& parameters, const Communicator& ranks,
                     const std::string& where)
    : parameters_(parameters),
      where_(where),
      grid_(make_grid(parameters, where)),
      levels_(make_levels(grid_, parameters)),
      partition_(ranks, grid_.axis(0).cells()),
      faces_(grid_, parameters.faces, parameters.particles_per_cell,
             speeds_of_levels(grid_, levels_, parameters)),
      kernels_(transfer_kernels()),
      gradient_(9 * chunk),
      weights_(batches(chunk)),
      focus_(0.5 * (parameters.x.lower + parameters.x.upper)),
      start_(parameters.x.lower) {
  if (parameters.window && (parameters.faces[x_lower] == FaceKind::absorbing ||
                            parameters.faces[x_upper] == FaceKind::absorbing))
    throw InputError(where, "moves along x and absorbs there",
                     "smooth, rough or free faces across x for ground that moves");
  for (const GroundLayer& layer : parameters_.layers)
    phases_.push_back({layer.law, Particles(*layer.law)});
  if (parameters.window && parameters.sheet)
    throw InputError(where, "moves along x and carries a sheet", "one of the two",
                     "grains on moving ground would be left behind");
  fill();
  if (parameters.sheet) lay_sheet();
  if (!faces_.captured()) {
    set_references(0.0);
    start_grid();
    partition_.sum_shared(grid_);
    faces_.capture(grid_, partition_.touched(), parameters_.gravity);
  }
}

void MpmGround::fill() {
  const int cells = grid_.axis(0).cells();
  partition_.balance(std::vector<double>(static_cast<std::size_t>(cells), 1.0));
  for (int cell = 0; cell < cells; ++cell) add_column(cell);
  initial_ = internal_energy();
  sort();
}

void MpmGround::lay_sheet() {
  const auto& per_cell = parameters_.particles_per_cell;
  const auto columns = static_cast<std::size_t>(grid_.axis(0).cells() * per_cell[0]),
             rows = static_cast<std::size_t>(grid_.axis(1).cells() * per_cell[1]);
  std::vector<double> top(columns * rows);
  for (std::size_t n = 0; n < top.size(); ++n)
    top[n] = static_cast<double>(n * levels_.size());  // the order of add_column()
  sheet_ = GroundSheet(std::move(top), rows, columns);
  sheet_.find(phases_);
  move_sheet();
}

void MpmGround::move_sheet() {
  sheet_.follow(phases_, [&](double* numbers, std::size_t count) { ranks().sum(numbers, count); });
}

/// The undisturbed particles of a column of cells across y and z, if it is this rank's. Ids are
/// counted on all ranks.
void MpmGround::add_column(int cell) {
  const Axis &x = grid_.axis(0), &y = grid_.axis(1);
  const auto& per_cell = parameters_.particles_per_cell;
  const bool mine = partition_.owner(cell) == ranks().rank();
  for (int i = 0; i < per_cell[0]; ++i)
    for (int row = 0; row < y.cells(); ++row)
      for (int j = 0; j < per_cell[1]; ++j)
        for (const GroundLevel& level : levels_) {
          const double id = next_id_++;
          if (!mine) continue;
          Particles& particles = phases_[level.layer].particles;
          const std::size_t p = particles.append(1);
          const double half_x = 0.5 * x.length(cell) / per_cell[0],
                       half_y = 0.5 * y.length(row) / per_cell[1];
          const double position[3] = {x.knot(cell) + (2 * i + 1) * half_x,
                                      y.knot(row) + (2 * j + 1) * half_y, level.z};
          const double half[3] = {half_x, half_y, level.half};
          for (std::size_t a = 0; a < 3; ++a) {
            particles.data(column::x + a)[p] = position[a];
            particles.data(column::home_x + a)[p] = position[a];
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
/// the place of 3 K; cfl makes up for that (coupling/fix_terrain_continuum.md).
double MpmGround::stable_time_step() const {
  double fastest = 0.0;
  for (const GroundPhase& phase : phases_) {
    if (phase.particles.size() == 0) continue;
    std::vector<double*> pointers;
    const_cast<Particles&>(phase.particles).state_pointers(0, pointers);
    PointBlock block;
    block.size = phase.particles.size();
    block.state = pointers.data();
    fastest = std::max(fastest, phase.law->largest_wave_speed(block));
  }
  return parameters_.cfl * grid_.shortest_cell() / ranks().max(fastest + largest_speed_);
}

void MpmGround::advance(double dt) {
  if (sheet_.exists())
    sheet_.hand_over(phases_, [&](const GroundPoint& near, const Vector3& force,
                                  const Vector3& point) { push(near, force, point); });
  if (!in_cycle()) begin_cycle(dt);
  give_pushes();
  partition_.sum_shared(grid_);
  grid_.accelerate(partition_.touched(), dt, parameters_.gravity);
  faces_.apply(grid_, partition_.touched(), partition_.owned(), dt);
  totals_ = grid_.move(partition_.touched(), partition_.owned(), dt);
  gravity_work_ += dt * parameters_.gravity.dot(totals_.momentum);
  lagging_ = true;
  deform(dt);
  count_contact_work(dt);
  const double way = ranks().max(largest_speed_) * dt;
  drift_ += way;
  travel_ += way;
  // A push can make the ground faster than it was when the cycle began.
  if (--steps_left_ == 0 || travel_ > 2.0 * most_travel * grid_.shortest_cell()) end_cycle();
  if (sheet_.exists()) {
    update_particles();
    move_sheet();
  }
}

/// Long enough that mapping takes little, short enough that the weights fit: the more a particle is
/// compacted, the thinner is what it stands for, and the less it may travel.
void MpmGround::begin_cycle(double dt) {
  double square = 0.0, square_over_ratio = 0.0;
  for (const GroundPhase& phase : phases_) {
    const double *v = phase.particles.data(column::velocity),
                 *ratio = phase.particles.data(column::state + field::volume_ratio);
    for (std::size_t p = 0; p < phase.particles.size(); ++p) {
      const double own =
          v[4 * p] * v[4 * p] + v[4 * p + 1] * v[4 * p + 1] + v[4 * p + 2] * v[4 * p + 2];
      square = std::max(square, own);
      square_over_ratio = std::max(square_over_ratio, own / (ratio[p] * ratio[p]));
    }
  }
  largest_speed_ = std::sqrt(square);
  travel_ = 0.0;
  const double pace = ranks().max(std::sqrt(square_over_ratio)), most = parameters_.cycle,
               steps = pace > 0.0 ? most_travel * grid_.shortest_cell() / (pace * dt) : most;
  steps_left_ = std::max(1, static_cast<int>(std::min(steps, most)));
  set_references(0.5 * (steps_left_ - 1) * dt);
  grid_.clear_displacement(partition_.touched());
  start_grid();
}

/// A fresh grid: masses, velocities and the forces of the stress.
void MpmGround::start_grid() {
  grid_.clear_sums(partition_.touched());
  const GridView view = local_view();
  for (GroundPhase& phase : phases_)
    if (kernels_.scatter_momentum(view, phase.particles.view(0, phase.particles.size()),
                                  phase.law->density()) > 0)
      report_outside(phase);
  partition_.sum_shared(grid_);
  grid_.start(partition_.touched());
  give_forces();
}

/// Weights are taken where particles will be after a time; where that is beyond a face, which stops
/// them first, where they are.
void MpmGround::set_references(double time) {
  for (GroundPhase& phase : phases_) {
    const double* v = phase.particles.data(column::velocity);
    for (std::size_t a = 0; a < 3; ++a) {
      const double* x = phase.particles.data(column::x + a);
      double* reference = phase.particles.data(column::reference_x + a);
      const double lower = grid_.axis(static_cast<int>(a)).lower(),
                   upper = grid_.axis(static_cast<int>(a)).upper();
      for (std::size_t p = 0; p < phase.particles.size(); ++p) {
        const double later = x[p] + time * v[4 * p + a];
        reference[p] = later >= lower && later <= upper ? later : x[p];
      }
    }
  }
}

void MpmGround::end_cycle() {
  steps_left_ = 0;
  update_particles();
  move_window();
  if (drift_ > most_drift * grid_.shortest_cell()) sort();
}

void MpmGround::update_particles() {
  if (!lagging_) return;
  lagging_ = false;
  const GridView view = local_view();
  for (GroundPhase& phase : phases_)
    kernels_.gather_motion(view, phase.particles.view(0, phase.particles.size()));
  grid_.clear_displacement(partition_.touched());
}

std::vector<GroundPhase>& MpmGround::phases() {
  update_particles();
  return phases_;
}

/// Particles may be in this rank's slab and one cell beyond.
GridView MpmGround::local_view() {
  GridView view = grid_.view();
  view.axis[0].from = grid_.axis(0).knot(partition_.first_cell());
  view.axis[0].to = grid_.axis(0).knot(partition_.last_cell() + 1);
  return view;
}

/// Of the stress, with weights found anew; in a cycle deform() does it with those of the strain.
void MpmGround::give_forces() {
  const GridView view = local_view();
  for (GroundPhase& phase : phases_)
    for (std::size_t first = 0; first < phase.particles.size(); first += chunk) {
      const ParticleView particles =
          phase.particles.view(first, std::min(chunk, phase.particles.size() - first));
      kernels_.find_weights(view, particles, weights_.data());
      kernels_.scatter_force(view, particles, weights_.data());
    }
}

void MpmGround::give_pushes() {
  point_forces_.clear();
  for (const Push& push : pushes_) {
    const Vector3 reference = phases_[push.near.phase].particles.reference(push.near.particle),
                  &force = push.force, lever = push.point - reference;
    point_forces_.push_back({{reference[0], reference[1], reference[2]},
                             {force[0], force[1], force[2]},
                             {lever[0], lever[1], lever[2]}});
  }
  kernels_.scatter_point_forces(local_view(), point_forces_.data(), point_forces_.size());
}

/// Strain, law and, while the weights stay, the force that the new stress has in the next step.
void MpmGround::deform(double dt) {
  const bool last = steps_left_ == 1;
  const GridView view = local_view();
  std::array<double*, 9> gradient;
  for (std::size_t g = 0; g < 9; ++g) gradient[g] = gradient_.data() + g * chunk;
  report_ = {};
  for (GroundPhase& phase : phases_)
    for (std::size_t first = 0; first < phase.particles.size(); first += chunk) {
      const std::size_t count = std::min(chunk, phase.particles.size() - first);
      const ParticleView particles = phase.particles.view(first, count);
      kernels_.find_weights(view, particles, weights_.data());
      kernels_.gather_strain(view, particles, weights_.data(), dt, gradient.data());
      // By the mean of the stresses before and after the step: with either alone the audit of a
      // vibrating body drifts by O(dt).
      stress_work_ += 0.5 * kernels_.stress_work(particles, gradient.data());
      PointBlock block;
      block.size = count;
      std::copy(gradient.begin(), gradient.end(), block.gradient.begin());
      phase.particles.state_pointers(first, state_pointers_);
      block.state = state_pointers_.data();
      try {
        report_ += phase.law->update_block(block);
      } catch (const PointError& error) {
        const Vector3 x = phase.particles.position(first + error.point);
        throw StateError(fmt::format("the particle at {:.4g} {:.4g} {:.4g} m: {}", x[0], x[1], x[2],
                                     error.what()));
      }
      stress_work_ += 0.5 * kernels_.stress_work(particles, gradient.data());
      if (!last) kernels_.scatter_force(view, particles, weights_.data());
    }
}

// ---- contact ------------------------------------------------------------------------------------

void MpmGround::push(const GroundPoint& near, const Vector3& force, const Vector3& point) {
  pushes_.push_back({near, force, point});
}

void MpmGround::probe(const std::vector<GroundPoint>& points, std::vector<GroundMotion>& motions) {
  motions.resize(points.size());
  if (!lagging_) {
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Particles& particles = phases_[points[n].phase].particles;
      const std::size_t p = points[n].particle;
      const Vector3 x = particles.position(p);
      motions[n] = {x, in_cycle() ? particles.reference(p) : x, particles.velocity(p),
                    particles.affine(p)};
    }
    return;
  }
  point_motions_.resize(points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    Eigen::Map<Vector3>(point_motions_[n].position) =
        phases_[points[n].phase].particles.reference(points[n].particle);
  kernels_.probe(local_view(), point_motions_.data(), points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const PointMotion& point = point_motions_[n];
    motions[n].reference = Eigen::Map<const Vector3>(point.position);
    motions[n].position = phases_[points[n].phase].particles.position(points[n].particle) +
                          Eigen::Map<const Vector3>(point.displacement);
    motions[n].velocity = Eigen::Map<const Vector3>(point.velocity);
    motions[n].affine = Eigen::Map<const Eigen::Matrix<double, 4, 3>>(point.affine).topRows<3>();
  }
}

void MpmGround::count_contact_work(double dt) {
  if (pushes_.empty()) return;
  pushed_.clear();
  for (const Push& push : pushes_) pushed_.push_back(push.near);
  probe(pushed_, pushed_motions_);
  for (std::size_t n = 0; n < pushes_.size(); ++n) {
    contact_work_ += dt * pushes_[n].force.dot(pushed_motions_[n].velocity_at(pushes_[n].point));
    largest_speed_ = std::max(largest_speed_, pushed_motions_[n].velocity.norm());
  }
  pushes_.clear();
}

// ---- errors and balance -------------------------------------------------------------------------

void MpmGround::report_outside(const GroundPhase& phase) const {
  for (std::size_t p = 0; p < phase.particles.size(); ++p) {
    const Vector3 x = phase.particles.position(p);
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

double MpmGround::energy(std::size_t kind) const {
  double sum = 0.0;
  for (const GroundPhase& phase : phases_) {
    const double *volume = phase.particles.data(column::volume),
                 *energy = phase.particles.data(column::state + kind);
    for (std::size_t p = 0; p < phase.particles.size(); ++p) sum += volume[p] * energy[p];
  }
  return sum;
}

double MpmGround::internal_energy() const {
  return energy(field::stored_energy) + energy(field::frozen_energy) +
         energy(field::dissipated_energy);
}

Vector3 MpmGround::particle_momentum() const {
  Vector3 momentum = Vector3::Zero();
  for (const GroundPhase& phase : phases_)
    for (std::size_t p = 0; p < phase.particles.size(); ++p)
      momentum += phase.law->density() * phase.particles.data(column::volume)[p] *
                  phase.particles.velocity(p);
  return momentum;
}

Balance MpmGround::balance() const {
  const double dissipated = energy(field::dissipated_energy) + dropped_dissipated_;
  const Vector3 momentum = lagging_ ? totals_.momentum : particle_momentum();
  const double kinetic = totals_.kinetic_energy + dropped_kinetic_,
               load = gravity_work_ + faces_.work();
  double sums[] = {kinetic,      internal_energy() - initial_ + dropped_internal_ - dissipated,
                   dissipated,   contact_work_,
                   load,         contact_work_ + load - stress_work_ - kinetic,
                   momentum.x(), momentum.y(),
                   momentum.z()};
  ranks().sum(sums, std::size(sums));
  Balance balance;
  balance.kinetic_energy = sums[0];
  balance.stored_energy = sums[1];
  balance.dissipated_energy = sums[2];
  balance.contact_work = sums[3];
  balance.load_work = sums[4];
  balance.numerical_loss = sums[5];
  balance.momentum = {sums[6], sums[7], sums[8]};
  return balance;
}

Vector3 MpmGround::face_impulse(FacePlace face) const {
  Vector3 impulse = faces_.impulse(face);
  ranks().sum(impulse.data(), 3);
  return impulse;
}

double MpmGround::particle_count() const {
  double count = 0.0;
  for (const GroundPhase& phase : phases_) count += static_cast<double>(phase.particles.size());
  return ranks().sum(count);
}

}  // namespace furrow
