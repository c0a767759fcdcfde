#include "mpm/mpm_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

constexpr std::size_t chunk = 1024;     // particles between grid and law: their gradients stay in the second cache
constexpr double most_drift = 0.5;      // of the shortest cell between two sortings
constexpr double most_off_knot = 1e-6;  // of the cell: the surface is where two cells meet
constexpr double capture_step = 1e-6;   // [s] of any length: forces are momenta over it

Grid make_grid(const GroundParameters& ground, const std::string& where) {
  Grid grid(Axis(ground.x, where + ", x axis"), Axis(ground.y, where + ", y axis"), Axis(ground.z, where + ", z axis"));
  if (ground.window && !grid.axis(0).uniform())
    throw InputError(where, "moves along a graded x axis", "a uniform x axis for ground that moves");
  const Axis& z = grid.axis(2);
  const int cell = z.cell_of(ground.surface);
  const double off =
      cell < 0 ? 1.0 : std::min(ground.surface - z.knot(cell), z.knot(cell + 1) - ground.surface) / z.length(cell);
  if (off > most_off_knot)
    throw InputError(where, fmt::format("has its surface at z = {:.6g} m, inside of a cell", ground.surface),
                     "the height of an end of a cell",
                     "let the fine stretch of the z axis be a whole number of cells below the surface and above it");
  return grid;
}

std::vector<WaveSpeeds> speeds_of_levels(const Grid& grid, const std::vector<GroundLevel>& levels,
                                         const GroundParameters& ground) {
  std::vector<WaveSpeeds> speeds;
  for (int k = 0; k < grid.nodes(2); ++k) {
    const auto nearest = std::min_element(levels.begin(), levels.end(), [&](const GroundLevel& a, const GroundLevel& b) {
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

/// V sigma : H of some particles with their present stress [J]; @param gradient nine arrays for H, row by row
double stress_work(const ParticleView& particles, const std::array<double*, 9>& gradient) {
  const double* const* s = particles.stress;
  const auto& h = gradient;
  double work = 0.0;
  for (std::size_t p = 0; p < particles.size; ++p)
    work += particles.volume[p] * particles.volume_ratio[p] *
            (s[0][p] * h[0][p] + s[1][p] * h[4][p] + s[2][p] * h[8][p] + s[3][p] * (h[1][p] + h[3][p]) +
             s[4][p] * (h[5][p] + h[7][p]) + s[5][p] * (h[2][p] + h[6][p]));
  return work;
}

}  // namespace

MpmGround::MpmGround(const GroundParameters& parameters, const Communicator& ranks, const std::string& where)
    : parameters_(parameters),
      where_(where),
      grid_(make_grid(parameters, where)),
      levels_(make_levels(grid_, parameters)),
      partition_(ranks, grid_.axis(0).cells()),
      faces_(grid_, parameters.faces, parameters.particles_per_cell, speeds_of_levels(grid_, levels_, parameters)),
      kernels_(transfer_kernels()),
      gradient_(9 * chunk),
      focus_(0.5 * (parameters.x.lower + parameters.x.upper)),
      start_(parameters.x.lower) {
  if (parameters.window &&
      (parameters.faces[x_lower] == FaceKind::absorbing || parameters.faces[x_upper] == FaceKind::absorbing))
    throw InputError(where, "moves along x and absorbs there", "smooth, rough or free faces across x for ground that moves");
  for (const GroundLayer& layer : parameters_.layers) phases_.push_back({layer.law, Particles(*layer.law)});
  if (parameters.window && parameters.sheet)
    throw InputError(where, "moves along x and carries a sheet", "one of the two",
                     "grains on moving ground would be left behind");
  fill();
  if (parameters.sheet) lay_sheet();
  if (!faces_.captured()) {
    grid_.clear(partition_.touched());
    scatter(capture_step);
    partition_.sum_shared(grid_);
    faces_.capture(grid_, partition_.touched(), capture_step);
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

/// The undisturbed particles of a column of cells across y and z, if it is this rank's. Ids are counted on all ranks.
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
          const double half_x = 0.5 * x.length(cell) / per_cell[0], half_y = 0.5 * y.length(row) / per_cell[1];
          const double position[3] = {x.knot(cell) + (2 * i + 1) * half_x, y.knot(row) + (2 * j + 1) * half_y, level.z};
          const double half[3] = {half_x, half_y, level.half};
          for (std::size_t a = 0; a < 3; ++a) {
            particles.data(column::x + a)[p] = particles.data(column::home_x + a)[p] = position[a];
            particles.data(column::half_x + a)[p] = half[a];
          }
          particles.data(column::volume)[p] = 8.0 * half_x * half_y * level.half / level.state[field::volume_ratio];
          particles.data(column::id)[p] = id;
          particles.set_state(p, level.state);
        }
  ++generation_;
}

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

void MpmGround::push(std::size_t phase, std::size_t particle, const Vector3& force, const Vector3& lever) {
  pushes_.push_back({phase, particle, force, lever});
}

void MpmGround::advance(double dt) {
  if (sheet_.exists())
    sheet_.hand_over(phases_, [&](std::size_t phase, std::size_t particle, const Vector3& force, const Vector3& lever) {
      push(phase, particle, force, lever);
    });
  grid_.clear(partition_.touched());
  scatter(dt);
  partition_.sum_shared(grid_);
  grid_.solve(partition_.touched());
  faces_.apply(grid_, partition_.touched(), partition_.owned(), dt);
  gather(dt);
  move_window();
  drift_ += ranks().max(largest_speed_) * dt;
  if (drift_ > most_drift * grid_.shortest_cell()) sort();
  if (sheet_.exists()) move_sheet();
}

/// Particles may be in this rank's slab and one cell beyond.
GridView MpmGround::local_view() {
  GridView view = grid_.view();
  view.axis[0].from = grid_.axis(0).knot(partition_.first_cell());
  view.axis[0].to = grid_.axis(0).knot(partition_.last_cell() + 1);
  return view;
}

void MpmGround::scatter(double dt) {
  const GridView view = local_view();
  for (GroundPhase& phase : phases_)
    if (phase.particles.size() > 0 && kernels_.scatter(view, phase.particles.view(0, phase.particles.size()),
                                                       phase.law->density(), dt, parameters_.gravity.data()) > 0)
      report_outside(phase);
  impulses_.clear();
  for (const Push& push : pushes_) {
    const Vector3 x = phases_[push.phase].particles.position(push.particle), impulse = dt * push.force;
    impulses_.push_back(
        {{x[0], x[1], x[2]}, {impulse[0], impulse[1], impulse[2]}, {push.lever[0], push.lever[1], push.lever[2]}});
  }
  kernels_.scatter_impulses(view, impulses_.data(), impulses_.size());
}

void MpmGround::gather(double dt) {
  const GridView view = local_view();
  std::array<double*, 9> gradient;
  for (std::size_t g = 0; g < 9; ++g) gradient[g] = gradient_.data() + g * chunk;
  kinetic_ = largest_speed_ = 0.0;
  report_ = {};
  for (GroundPhase& phase : phases_)
    for (std::size_t first = 0; first < phase.particles.size(); first += chunk) {
      const std::size_t count = std::min(chunk, phase.particles.size() - first);
      const ParticleView particles = phase.particles.view(first, count);
      const TransferSums sums = kernels_.gather(view, particles, phase.law->density(), dt, gradient.data());
      if (sums.outside > 0) report_outside(phase);
      kinetic_ += sums.kinetic_energy;
      gravity_work_ += dt * parameters_.gravity.dot(Eigen::Map<const Vector3>(sums.momentum));
      largest_speed_ = std::max(largest_speed_, sums.largest_speed);
      PointBlock block;
      block.size = count;
      std::copy(gradient.begin(), gradient.end(), block.gradient.begin());
      phase.particles.state_pointers(first, state_pointers_);
      block.state = state_pointers_.data();
      try {
        report_ += phase.law->update_block(block);
      } catch (const StateError& error) {
        throw StateError(fmt::format("{} (particles from number {} of its layer, near x {:.3f} m, y {:.3f} m, z {:.3f} m)",
                                     error.what(), first, phase.particles.data(column::x)[first],
                                     phase.particles.data(column::y)[first], phase.particles.data(column::z)[first]));
      }
      // By the mean of the stresses before and after the step: with either alone the audit of a vibrating body drifts by O(dt).
      stress_work_ += 0.5 * (sums.stress_work + stress_work(particles, gradient));
    }
  for (const Push& push : pushes_) {
    const Particles& particles = phases_[push.phase].particles;
    contact_work_ += dt * push.force.dot(particles.velocity(push.particle) + particles.affine(push.particle) * push.lever);
  }
  pushes_.clear();
}

void MpmGround::report_outside(const GroundPhase& phase) const {
  for (std::size_t p = 0; p < phase.particles.size(); ++p) {
    const Vector3 x = phase.particles.position(p);
    for (int a = 0; a < 3; ++a)
      if (grid_.axis(a).cell_of(x[a]) < 0)
        throw StateError(
            fmt::format("a particle is at {:.4g} {:.4g} {:.4g} m, outside of the grid (x {:.4g} to {:.4g}, y {:.4g} to "
                        "{:.4g}, z {:.4g} to "
                        "{:.4g} m): give the ground more headroom or size, or look for an unstable contact",
                        x[0], x[1], x[2], grid_.axis(0).lower(), grid_.axis(0).upper(), grid_.axis(1).lower(),
                        grid_.axis(1).upper(), grid_.axis(2).lower(), grid_.axis(2).upper()));
  }
  throw StateError(
      fmt::format("particles moved more than a cell in {:.2g} m of expected drift: the ground has become unstable", drift_));
}

double MpmGround::energy(std::size_t kind) const {
  double sum = 0.0;
  for (const GroundPhase& phase : phases_) {
    const double *volume = phase.particles.data(column::volume), *energy = phase.particles.data(column::state + kind);
    for (std::size_t p = 0; p < phase.particles.size(); ++p) sum += volume[p] * energy[p];
  }
  return sum;
}

double MpmGround::internal_energy() const {
  return energy(field::stored_energy) + energy(field::frozen_energy) + energy(field::dissipated_energy);
}

Balance MpmGround::balance() const {
  const double dissipated = energy(field::dissipated_energy) + dropped_dissipated_;
  Vector3 momentum = Vector3::Zero();
  for (const GroundPhase& phase : phases_)
    for (std::size_t p = 0; p < phase.particles.size(); ++p)
      momentum += phase.law->density() * phase.particles.data(column::volume)[p] * phase.particles.velocity(p);
  const double kinetic = kinetic_ + dropped_kinetic_, load = gravity_work_ + faces_.work();
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

// ---- order and place of the particles -----------------------------------------------------------------------------------------

void MpmGround::sort() {
  drift_ = 0.0;
  ++generation_;
  migrate();
  const std::size_t ny = static_cast<std::size_t>(grid_.axis(1).cells()),
                    nz = static_cast<std::size_t>(grid_.axis(2).cells());
  std::vector<std::size_t> cell, start, order;
  for (GroundPhase& phase : phases_) {
    const std::size_t n = phase.particles.size();
    cell.resize(n);
    start.assign(static_cast<std::size_t>(grid_.axis(0).cells()) * ny * nz + 1, 0);
    for (std::size_t p = 0; p < n; ++p) {
      const Vector3 x = phase.particles.position(p);
      const int c[3] = {grid_.axis(0).cell_of(x[0]), grid_.axis(1).cell_of(x[1]), grid_.axis(2).cell_of(x[2])};
      if (c[0] < 0 || c[1] < 0 || c[2] < 0) report_outside(phase);
      cell[p] = (static_cast<std::size_t>(c[0]) * ny + static_cast<std::size_t>(c[1])) * nz + static_cast<std::size_t>(c[2]);
      ++start[cell[p] + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    order.resize(n);
    for (std::size_t p = 0; p < n; ++p) order[start[cell[p]]++] = p;
    phase.particles.reorder(order);
  }
  if (sheet_.exists()) sheet_.find(phases_);
}

/// Balances the slabs and sends every particle to the owner of its cell.
void MpmGround::migrate() {
  if (ranks().size() == 1) return;
  const Axis& x = grid_.axis(0);
  std::vector<double> count(static_cast<std::size_t>(x.cells()), 0.0);
  for (const GroundPhase& phase : phases_)
    for (std::size_t p = 0; p < phase.particles.size(); ++p) {
      const int cell = x.cell_of(phase.particles.data(column::x)[p]);
      if (cell < 0) report_outside(phase);
      ++count[static_cast<std::size_t>(cell)];
    }
  ranks().sum(count.data(), count.size());
  faces_.synchronise(ranks(), partition_.owned());
  partition_.balance(count);
  std::vector<std::size_t> staying;
  for (GroundPhase& phase : phases_) {
    std::vector<std::vector<double>> leaving(static_cast<std::size_t>(ranks().size()));
    staying.clear();
    for (std::size_t p = 0; p < phase.particles.size(); ++p) {
      const int owner = partition_.owner(x.cell_of(phase.particles.data(column::x)[p]));
      if (owner == ranks().rank())
        staying.push_back(p);
      else
        phase.particles.pack(p, leaving[static_cast<std::size_t>(owner)]);
    }
    phase.particles.reorder(staying);
    for (int r = 0; r < ranks().size(); ++r) {
      if (r == ranks().rank()) continue;
      const std::vector<double> arriving = ranks().exchange(r, leaving[static_cast<std::size_t>(r)]);
      for (std::size_t n = 0; n < arriving.size(); n += phase.particles.record_length())
        phase.particles.unpack(arriving.data() + n);
    }
  }
}

// ---- moving ground --------------------------------------------------------------------------------------------------------------

double MpmGround::travelled() const { return grid_.axis(0).lower() - start_; }

void MpmGround::move_window() {
  if (!parameters_.window) return;
  const Axis& x = grid_.axis(0);
  bool moved = false;
  while (focus_ > 0.5 * (x.lower() + x.upper()) + x.length(0)) {
    drop_behind();
    if (!moved) faces_.synchronise(ranks(), partition_.owned());  // rows go over from rank to rank
    grid_.shift_x(1);
    faces_.shift_x(1);
    ++shifts_;
    const double before = internal_energy();
    add_column(x.cells() - 1);
    initial_ += internal_energy() - before;
    moved = true;
  }
  if (moved) sort();
}

void MpmGround::drop_behind() {
  const Axis &x = grid_.axis(0), &y = grid_.axis(1);
  const double edge = x.knot(1);
  std::vector<double> top(static_cast<std::size_t>(y.cells()), -std::numeric_limits<double>::infinity()),
      mass(top.size(), 0.0), volume(top.size(), 0.0);
  const double before = internal_energy(), heat_before = energy(field::dissipated_energy);
  std::vector<std::size_t> kept;
  for (GroundPhase& phase : phases_) {
    const Particles& particles = phase.particles;
    kept.clear();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      if (particles.data(column::x)[p] >= edge) {
        kept.push_back(p);
        continue;
      }
      const auto row = static_cast<std::size_t>(y.cell_of(particles.data(column::y)[p]));
      const double ratio = particles.data(column::state + field::volume_ratio)[p],
                   reference = particles.data(column::volume)[p];
      top[row] = std::max(top[row], particles.data(column::z)[p] + particles.data(column::half_z)[p] * ratio);
      mass[row] += phase.law->density() * reference;
      volume[row] += reference * ratio;
      dropped_kinetic_ += 0.5 * phase.law->density() * reference * particles.velocity(p).squaredNorm();
    }
    phase.particles.reorder(kept);
  }
  dropped_internal_ += before - internal_energy();
  dropped_dissipated_ += heat_before - energy(field::dissipated_energy);
  for (std::size_t row = 0; row < top.size(); ++row)
    if (volume[row] > 0.0)
      rut_.push_back({0.5 * (x.lower() + edge), y.knot(static_cast<int>(row)) + 0.5 * y.length(static_cast<int>(row)),
                      top[row], mass[row] / volume[row]});
}

// ---- restart --------------------------------------------------------------------------------------------------------------------

std::vector<double> MpmGround::fingerprint() const {
  std::vector<double> numbers = {static_cast<double>(phases_.size())};
  for (int a = 0; a < 3; ++a)
    numbers.insert(numbers.end(), {static_cast<double>(grid_.axis(a).cells()), grid_.axis(a).shortest()});
  for (const GroundPhase& phase : phases_)
    numbers.insert(numbers.end(), {static_cast<double>(phase.particles.record_length()), phase.law->density()});
  numbers.insert(numbers.end(),
                 {static_cast<double>(faces_.state_length()), static_cast<double>(sheet_.surface().node_count())});
  return numbers;
}

std::vector<double> MpmGround::state() const {
  std::vector<double> state = fingerprint();
  double sums[] = {kinetic_,      initial_,         stress_work_,      contact_work_,
                   gravity_work_, dropped_kinetic_, dropped_internal_, dropped_dissipated_};
  ranks().sum(sums, std::size(sums));
  state.insert(state.end(), std::begin(sums), std::end(sums));
  state.insert(state.end(), {static_cast<double>(shifts_), focus_, next_id_, drift_, ranks().max(largest_speed_)});
  const Matrix3X& f = sheet_.surface().f;
  state.insert(state.end(), f.data(), f.data() + f.size());
  Faces faces = faces_;
  faces.synchronise(ranks(), partition_.owned());
  faces.collect(ranks());
  faces.save(state);
  for (const GroundPhase& phase : phases_) {
    std::vector<double> records;
    for (std::size_t p = 0; p < phase.particles.size(); ++p) phase.particles.pack(p, records);
    records = ranks().gather(records);
    state.push_back(static_cast<double>(records.size()));
    state.insert(state.end(), records.begin(), records.end());
  }
  return state;
}

void MpmGround::restore(const std::vector<double>& state) {
  const std::vector<double> mine = fingerprint();
  if (state.size() < mine.size() || !std::equal(mine.begin(), mine.end(), state.begin()))
    throw Error(fmt::format(
        "{}: the saved state belongs to other ground; restart with the materials, size and cells of the first run", where_));
  const double* next = state.data() + mine.size();
  for (double* sum : {&kinetic_, &initial_, &stress_work_, &contact_work_, &gravity_work_, &dropped_kinetic_,
                      &dropped_internal_, &dropped_dissipated_})
    *sum = ranks().rank() == 0 ? *next++ : (++next, 0.0);
  const int shifts = static_cast<int>(*next++);
  grid_.shift_x(shifts - shifts_);
  shifts_ = shifts;
  focus_ = *next++;
  next_id_ = *next++;
  drift_ = *next++;
  largest_speed_ = *next++;
  Matrix3X& f = sheet_.surface().f;
  std::copy_n(next, f.size(), f.data());
  next += f.size();
  next = faces_.restore(next, ranks().rank() == 0);
  for (GroundPhase& phase : phases_) {
    phase.particles.reorder({});
    const auto length = static_cast<std::size_t>(*next++);
    for (const double* end = next + length; next != end; next += phase.particles.record_length())
      if (partition_.owner(grid_.axis(0).cell_of(next[0])) == ranks().rank()) phase.particles.unpack(next);
  }
  const double drift = drift_;
  if (ranks().size() > 1) sort();
  drift_ = drift;
  ++generation_;
  if (!sheet_.exists()) return;
  sheet_.find(phases_);
  move_sheet();
}

}  // namespace furrow
