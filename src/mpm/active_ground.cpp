// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/active_ground.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

constexpr int tile_cells = 8;       // edge of a tile, about
constexpr int margin_cells = 4;     // around a body
constexpr int period_steps = 160;   // steps in which a wave crosses a tile several times
constexpr double cautious = 0.1;    // of the force limit, for a tile that falls asleep
constexpr int longest_wait = 64;    // periods
constexpr std::size_t chunk = 256;  // particles per batch of weights

enum : char { awake_node = 1, resting_node = 2 };

Vector3 force_on(const NodeSum& sum) { return Eigen::Map<const Vector3>(sum.total); }

}  // namespace

ActiveGround::ActiveGround(double tolerance, const Vector3& gravity, Discretisation& discretisation,
                           Boundary& boundary, const TerrainEnergy& energy)
    : tolerance_(tolerance),
      gravity_(gravity),
      discretisation_(discretisation),
      boundary_(boundary),
      energy_(energy) {
  for (std::size_t a : {0, 1})
    count_[a] = std::max(
        1, (discretisation.grid.axis(static_cast<int>(a)).cells() + tile_cells / 2) / tile_cells);
  tiles_.resize(static_cast<std::size_t>(count_[0] * count_[1]));
  motion_.resize(tiles_.size());
  resting_reaction_.fill(Vector3::Zero());
  for (ParticleGroup& group : discretisation.groups) group.awake.emplace();
  discretisation.awake_nodes.emplace();
}

// ---- tiles ----------------------------------------------------------------------------------

int ActiveGround::tile_of_cell(int axis, int cell) const {
  const int cells = discretisation_.grid.axis(axis).cells();
  return ((std::clamp(cell, 0, cells - 1) + 1) * count_[static_cast<std::size_t>(axis)] - 1) /
         cells;
}

/// The tile of the cell in the middle of its spline.
std::size_t ActiveGround::tile_of_node(int i, int j) const {
  return number(tile_of_cell(0, i - 1), tile_of_cell(1, j - 1));
}

CellRange ActiveGround::cells_of(int axis, int tile) const {
  const int cells = discretisation_.grid.axis(axis).cells(),
            count = count_[static_cast<std::size_t>(axis)];
  return {tile * cells / count, (tile + 1) * cells / count};
}

template <class Visit>
void ActiveGround::for_tiles(Visit&& visit) {
  for (int a = 0; a < count_[0]; ++a)
    for (int b = 0; b < count_[1]; ++b) visit(a, b, tiles_[number(a, b)]);
}

/// Calls visit(from, to) for this rank's particles of sleeping or awake tiles, in their order.
template <class Visit>
void ActiveGround::for_particles(const ParticleGroup& group, bool asleep, Visit&& visit) const {
  const CellRange x = discretisation_.partition.own_cells(0),
                  y = discretisation_.partition.own_cells(1);
  for (int i = x.from; i < x.to; ++i)
    for (int b = 0; b < count_[1]; ++b) {
      if (tiles_[number(tile_of_cell(0, i), b)].asleep != asleep) continue;
      const CellRange tile = cells_of(1, b);
      const CellRange mine = {std::max(tile.from, y.from), std::min(tile.to, y.to)};
      if (mine.from >= mine.to) continue;
      const auto start = group.column_start.begin() + (i - x.from) * y.size() - y.from;
      if (start[mine.from] < start[mine.to]) visit(start[mine.from], start[mine.to]);
    }
}

/// Calls visit(number of the column) for this rank's columns of cells.
template <class Visit>
void ActiveGround::for_own_columns(Visit&& visit) const {
  const CellRange x = discretisation_.partition.own_cells(0),
                  y = discretisation_.partition.own_cells(1);
  for (int i = x.from; i < x.to; ++i)
    for (int j = y.from; j < y.to; ++j)
      visit(static_cast<std::size_t>(i * discretisation_.grid.axis(1).cells() + j));
}

bool ActiveGround::asleep(double x, double y) const {
  const Grid& grid = discretisation_.grid;
  return tiles_[number(tile_of_cell(0, grid.axis(0).cell_of(x)),
                       tile_of_cell(1, grid.axis(1).cell_of(y)))]
      .asleep;
}

double ActiveGround::awake_share() const {
  double count[2] = {0.0, 0.0};  // number of all and of awake particles
  for (const ParticleGroup& group : discretisation_.groups) {
    count[0] += static_cast<double>(group.particles.size());
    group.for_awake(
        [&](std::size_t from, std::size_t to) { count[1] += static_cast<double>(to - from); });
  }
  discretisation_.ranks().sum(count, 2);
  return count[0] > 0.0 ? count[1] / count[0] : 1.0;
}

void ActiveGround::keep_awake(const Vector3& lower, const Vector3& upper) {
  int from[2], to[2];
  for (int a : {0, 1}) {
    const Axis& axis = discretisation_.grid.axis(a);
    const auto cell_near = [&](double x) {
      return axis.cell_of(std::clamp(x, axis.lower(), axis.upper()));
    };
    from[a] = tile_of_cell(a, cell_near(lower[a]) - margin_cells);
    to[a] = tile_of_cell(a, cell_near(upper[a]) + margin_cells);
  }
  for (int a = from[0]; a <= to[0]; ++a)
    for (int b = from[1]; b <= to[1]; ++b) tiles_[number(a, b)].near_body = true;
}

// ---- parts of a step ------------------------------------------------------------------------

void ActiveGround::stop_border() {
  for (HeldNode& held : held_) {
    NodeMotion& motion = discretisation_.grid.motion(held.node[0], held.node[1], held.node[2]);
    held.momentum = motion.mass * Eigen::Map<const Vector3>(motion.velocity);
    std::fill_n(motion.velocity, 3, 0.0);
  }
}

void ActiveGround::hold_border(double dt) {
  ++steps_;
  interval_ += dt;
  const NodeBlock owned = discretisation_.partition.owned_nodes();
  FaceArray<Vector3> reactions = resting_reaction_;
  for (HeldNode& held : held_) {
    const auto [i, j, k] = held.node;
    const double mass = discretisation_.grid.motion(i, j, k).mass + held.resting_mass;
    NodeSum& sum = discretisation_.grid.sum(i, j, k);
    const Vector3 force = force_on(sum) + held.resting_force + mass * gravity_ + held.momentum / dt;
    sum = {};
    held.momentum.setZero();
    if (owned.contains(i, j))
      motion_[held.tile].held_impulse +=
          dt * boundary_.hold(discretisation_.grid, held.node, mass, force, reactions);
  }
  boundary_.add_impulses(reactions, dt);
}

void ActiveGround::add_motion() {
  for (Motion& one : motion_) one.kinetic = 0.0;
  Grid& grid = discretisation_.grid;
  discretisation_.for_moving_nodes([&](const NodeBlock&, const NodeBlock& owned) {
    for (int i = owned.x.from; i < owned.x.to; ++i)
      for (int j = owned.y.from; j < owned.y.to; ++j) {
        Motion& one = motion_[tile_of_node(i, j)];
        for (int k = 0; k < grid.nodes(2); ++k) {
          const NodeMotion& node = grid.motion(i, j, k);
          one.kinetic += 0.5 * node.mass * Eigen::Map<const Vector3>(node.velocity).squaredNorm();
          one.moved += node.mass * Eigen::Map<const Vector3>(grid.displacement(i, j, k).u);
        }
      }
  });
}

// ---- decisions ------------------------------------------------------------------------------

/// Replaces motions, loads and losses of this rank since the last decision by those of all ranks.
void ActiveGround::sum_over_ranks() {
  std::vector<double> sums;
  for (const Motion& one : motion_) {
    sums.push_back(one.kinetic);
    sums.insert(sums.end(), one.moved.begin(), one.moved.end());
    sums.insert(sums.end(), one.held_impulse.begin(), one.held_impulse.end());
  }
  sums.insert(sums.end(), load_impulse_.begin(), load_impulse_.end());
  sums.push_back(lost_energy_);
  sums.push_back(energy_.contact_work());
  discretisation_.ranks().sum(sums.data(), sums.size());
  const double* next = sums.data();
  for (Tile& one : tiles_) {
    one.largest_kinetic = std::max(one.largest_kinetic, next[0]);
    one.moved += Eigen::Map<const Vector3>(next + 1);
    one.held_impulse += Eigen::Map<const Vector3>(next + 4);
    next += Motion::numbers;
  }
  const Vector3 load_impulse = Eigen::Map<const Vector3>(next);
  contact_impulse_ += load_impulse;
  if (load_impulse.squaredNorm() > 0.0) contact_time_ += interval_;
  neglect_.energy += next[3];
  contact_work_ = next[4];
  elapsed_ += interval_;
  interval_ = lost_energy_ = 0.0;
  load_impulse_.setZero();
  motion_.assign(tiles_.size(), Motion());
}

double ActiveGround::force_limit() const {
  return contact_time_ > 0.0 ? tolerance_ * contact_impulse_.norm() / contact_time_ : 0.0;
}

/// Sum over the tiles, mean over the period so far, with nothing for the rest of it [N].
double ActiveGround::held_force() const {
  double impulse = 0.0;
  for (const Tile& one : tiles_)
    if (one.asleep) impulse += one.held_impulse.norm();
  return impulse / (elapsed_ * std::max(1.0, static_cast<double>(period_steps) / steps_));
}

void ActiveGround::wake(Tile& one, bool for_a_body) {
  one.asleep = false;
  one.last_wait = for_a_body ? 1 : std::clamp(2 * one.last_wait, 2, longest_wait);
  one.wait = one.last_wait;
  one.held_impulse.setZero();
}

bool ActiveGround::wake_near_bodies() {
  bool any = false;
  for (Tile& one : tiles_)
    if (one.asleep && one.near_body) {
      wake(one, true);
      any = true;
    }
  return any;
}

bool ActiveGround::wake_for_gravity() {
  bool any = false;
  for (Tile& one : tiles_)
    if (gravity_changed_ && one.asleep) {
      wake(one, true);
      any = true;
    }
  return any;
}

bool ActiveGround::wake_for_force() {
  bool any = false;
  double force = held_force();
  neglect_.largest_force = std::max(neglect_.largest_force, force);
  for (; force > force_limit(); force = held_force()) {
    Tile* largest = nullptr;
    for (Tile& one : tiles_)
      if (one.asleep &&
          (!largest || one.held_impulse.squaredNorm() > largest->held_impulse.squaredNorm()))
        largest = &one;
    wake(*largest, false);
    any = true;
  }
  return any;
}

bool ActiveGround::fall_asleep() {
  double speed = 0.0;
  for (const ParticleGroup& group : discretisation_.groups)
    group.for_awake([&](std::size_t from, std::size_t to) {
      speed = std::max(speed, group.largest_wave_speed(from, to));
    });
  speed = discretisation_.ranks().max(speed);
  if (!(contact_time_ > 0.0)) return false;
  const double periods = std::max(1.0, contact_time_ / elapsed_);
  double energy =
      std::min(tolerance_ * contact_work_ / periods,  // energy that may be lost in this period [J]
               tolerance_ * contact_work_ - neglect_.energy);
  bool any = false;
  for_tiles([&](int a, int b, Tile& one) {
    if (one.asleep || one.near_body || one.wait > 0) return;
    const CellRange x = cells_of(0, a), y = cells_of(1, b);
    const Axis &along_x = discretisation_.grid.axis(0), &along_y = discretisation_.grid.axis(1);
    const double edge = std::min(along_x.knot(x.to) - along_x.knot(x.from),
                                 along_y.knot(y.to) - along_y.knot(y.from));
    const double force = one.moved.norm() * std::pow(speed / edge, 2);
    if (force > cautious * force_limit() || one.largest_kinetic > energy) return;
    energy -= one.largest_kinetic;
    one.asleep = any = true;
  });
  return any;
}

void ActiveGround::begin_period() {
  steps_ = 0;
  elapsed_ = 0.0;
  for (Tile& one : tiles_) {
    one.wait = std::max(0, one.wait - 1);
    one.largest_kinetic = 0.0;
    one.moved.setZero();
    one.held_impulse.setZero();
  }
}

bool ActiveGround::decide() {
  sum_over_ranks();
  bool changes = wake_near_bodies();
  changes |= wake_for_gravity();
  changes |= wake_for_force();
  if (steps_ >= period_steps) {
    neglect_.force = held_force();
    if (!gravity_changed_) changes |= fall_asleep();
    begin_period();
  }
  for (Tile& one : tiles_) one.near_body = false;
  gravity_changed_ = false;
  return changes;
}

// ---- what is awake --------------------------------------------------------------------------

void ActiveGround::rebuild() {
  find_awake_particles();
  bring_to_rest();
  find_nodes();
  find_resting_sums();
}

void ActiveGround::find_awake_particles() {
  for (ParticleGroup& group : discretisation_.groups) {
    std::vector<ParticleRange>& awake = *group.awake;
    awake.clear();
    for_particles(group, false, [&](std::size_t from, std::size_t to) {
      if (!awake.empty() && awake.back().to == from)
        awake.back().to = to;
      else
        awake.push_back({from, to});
    });
  }
}

/// Stops the particles of sleeping tiles, with those that entered from awake tiles.
void ActiveGround::bring_to_rest() {
  const Grid& grid = discretisation_.grid;
  for (ParticleGroup& group : discretisation_.groups) {
    Particles& particles = group.particles;
    for_particles(group, true, [&](std::size_t from, std::size_t to) {
      for (std::size_t p = from; p < to; ++p) {
        double* velocity = particles.data(column::velocity) + 4 * p;
        double* affine = particles.data(column::affine) + 12 * p;
        for (std::size_t a = 0; a < 3; ++a)
          particles.data(column::quadrature_x + a)[p] = particles.data(column::x + a)[p];
        if (velocity[0] == 0.0 && velocity[1] == 0.0 && velocity[2] == 0.0) continue;
        double square = particles.velocity(p).squaredNorm();
        const Matrix3 C = particles.affine(p);
        for (int a = 0; a < 3; ++a) {
          const Axis& axis = grid.axis(a);
          const double cell = axis.length(axis.cell_of(particles.position(p)[a]));
          square += 0.25 * cell * cell * C.col(a).squaredNorm();
        }
        lost_energy_ += 0.5 * group.mass(p) * square;
        std::fill_n(velocity, 4, 0.0);
        std::fill_n(affine, 12, 0.0);
        std::fill_n(particles.data(column::residual) + 8 * p, 8, 0.0);
      }
    });
  }
}

/// Columns of nodes that awake particles reach, a cell further than when they were sorted, and
/// those that sleeping ones reach. Nodes that both reach are held.
void ActiveGround::find_nodes() {
  Grid& grid = discretisation_.grid;
  const int nx = grid.nodes(0), ny = grid.nodes(1);
  node_state_.assign(static_cast<std::size_t>(nx * ny), 0);
  for_tiles([&](int a, int b, const Tile& one) {
    const int drift = one.asleep ? 0 : 1;
    const CellRange x = cells_of(0, a), y = cells_of(1, b);
    for (int i = std::max(0, x.from - drift); i < std::min(nx, x.to + 2 + drift); ++i)
      for (int j = std::max(0, y.from - drift); j < std::min(ny, y.to + 2 + drift); ++j)
        node_state_[static_cast<std::size_t>(i * ny + j)] |= one.asleep ? resting_node : awake_node;
  });
  discretisation_.awake_nodes->all = find_blocks([](char state) { return state & awake_node; });
  discretisation_.awake_nodes->moving = find_blocks([](char state) { return state == awake_node; });
  const NodeBlock local = discretisation_.partition.local_nodes();
  for (int i = local.x.from; i < local.x.to; ++i)
    for (int j = local.y.from; j < local.y.to; ++j)
      if (state_of(i, j) == resting_node)
        for (int k = 0; k < grid.nodes(2); ++k) grid.motion(i, j, k) = NodeMotion{};
}

/// Index of a sleeping tile that reaches a column of nodes.
std::size_t ActiveGround::sleeping_tile_at(int i, int j) const {
  std::size_t tile = 0;
  for (const int shift_x : {0, 2, 1})
    for (const int shift_y : {0, 2, 1}) {
      const std::size_t other = number(tile_of_cell(0, i - shift_x), tile_of_cell(1, j - shift_y));
      if (tiles_[other].asleep) tile = other;
    }
  return tile;
}

/// Rectangles that together are the columns of nodes whose state passes.
template <class Pass>
std::vector<NodeBlock> ActiveGround::find_blocks(Pass pass) const {
  const int nx = discretisation_.grid.nodes(0), ny = discretisation_.grid.nodes(1);
  std::vector<NodeBlock> blocks;
  std::vector<NodeRange> previous, row;
  for (int i = 0; i < nx; ++i) {
    row.clear();
    for (int j = 0; j < ny; ++j) {
      if (!pass(state_of(i, j))) continue;
      if (row.empty() || row.back().to != j) row.push_back({j, j});
      row.back().to = j + 1;
    }
    if (row == previous)
      for (auto n = blocks.end() - static_cast<long>(row.size()); n != blocks.end(); ++n) ++n->x.to;
    else
      for (const NodeRange& range : row) blocks.push_back({{i, i + 1}, range});
    previous = row;
  }
  return blocks;
}

/// Sums what stays constant while the tiles sleep: mass and stress of the sleeping particles at the
/// nodes that are held, and the reactions of the faces on the other sleeping nodes.
void ActiveGround::find_resting_sums() {
  Grid& grid = discretisation_.grid;
  const TransferKernels& kernels = transfer_kernels();
  const GridView view = discretisation_.local_view();
  const Partition& partition = discretisation_.partition;
  const NodeBlock local = partition.local_nodes(), owned = partition.owned_nodes();
  const auto sum_resting = [&](auto&& visit) {
    grid.clear_sums(local);
    for (ParticleGroup& group : discretisation_.groups)
      for_particles(group, true, [&](std::size_t from, std::size_t to) { visit(group, from, to); });
    NodeExchange().add_shared_sums(grid,
                                   partition);  // sums that do not count as traffic of the steps
  };
  const auto for_resting_nodes = [&](auto&& visit) {
    std::size_t n = 0;
    for (int i = local.x.from; i < local.x.to; ++i)
      for (int j = local.y.from; j < local.y.to; ++j)
        if (state_of(i, j) & resting_node)
          for (int k = 0; k < grid.nodes(2); ++k) visit(std::array{i, j, k}, n++);
  };
  resting_wave_speed_ = 0.0;
  sum_resting([&](ParticleGroup& group, std::size_t from, std::size_t to) {
    resting_wave_speed_ = std::max(resting_wave_speed_, group.largest_wave_speed(from, to));
    kernels.scatter_momentum(view, group.particles.view(from, to - from),
                             group.material->density());
  });
  std::vector<double> masses;
  for_resting_nodes([&](const std::array<int, 3>& node, std::size_t) {
    masses.push_back(grid.sum(node[0], node[1], node[2]).mass);
  });
  std::vector<Weights> weights(batches(chunk));
  sum_resting([&](ParticleGroup& group, std::size_t from, std::size_t to) {
    for (std::size_t first = from; first < to; first += chunk) {
      const ParticleView some = group.particles.view(first, std::min(chunk, to - first));
      kernels.find_weights(view, some, weights.data());
      kernels.scatter_force(view, some, weights.data());
    }
  });
  held_.clear();
  resting_reaction_.fill(Vector3::Zero());
  for_resting_nodes([&](const std::array<int, 3>& node, std::size_t n) {
    const auto [i, j, k] = node;
    const Vector3 force = force_on(grid.sum(i, j, k));
    if (state_of(i, j) & awake_node)
      held_.push_back({node, sleeping_tile_at(i, j), masses[n], force});
    else if (owned.contains(i, j))
      boundary_.hold(grid, node, masses[n], force + masses[n] * gravity_, resting_reaction_);
  });
  grid.clear_sums(local);
}

/// Sums over the ranks, which the first rank goes on with; the particles in the columns of cells.
void ActiveGround::checkpoint(Checkpoint& state) {
  const Communicator& ranks = discretisation_.ranks();
  for (Tile& one : tiles_) {
    state.value("asleep", one.asleep);
    state.value("near_body", one.near_body);
    state.value("wait", one.wait);
    state.value("last_wait", one.last_wait);
    state.value("largest_kinetic", one.largest_kinetic);
    state.values("moved", one.moved);
    state.values("held_impulse", one.held_impulse);
  }
  state.values("gravity", gravity_);
  state.value("gravity_changed", gravity_changed_);
  state.value("steps", steps_);
  state.value("elapsed", elapsed_);
  state.value("interval", interval_);
  state.values("contact_impulse", contact_impulse_);
  state.value("contact_time", contact_time_);
  state.value("neglected_force", neglect_.force);
  state.value("largest_neglected_force", neglect_.largest_force);
  state.value("neglected_energy", neglect_.energy);

  std::vector<double*> mine = {&lost_energy_};
  for (int c = 0; c < 3; ++c) mine.push_back(&load_impulse_[c]);
  for (Motion& one : motion_)
    for (int c = 0; c < 3; ++c) {
      mine.push_back(&one.moved[c]);
      mine.push_back(&one.held_impulse[c]);
    }
  std::vector<double> sums;
  for (const double* number : mine) sums.push_back(*number);
  if (state.saving()) ranks.sum(sums.data(), sums.size());
  state.values("since_decision", sums.data(), sums.size());
  for (std::size_t n = 0; n < mine.size(); ++n) *mine[n] = ranks.rank() == 0 ? sums[n] : 0.0;

  for (ParticleGroup& group : discretisation_.groups) {
    std::vector<double> count = state.saving() ? count_in_columns(group) : std::vector<double>();
    state.values("particles_in_columns", count);
    if (state.saving()) continue;
    saved_counts_.push_back(std::move(count));
    group.column_start.clear();
  }
}

/// Particles of all ranks in each column of cells, y running fastest.
std::vector<double> ActiveGround::count_in_columns(const ParticleGroup& group) const {
  const Grid& grid = discretisation_.grid;
  const int ny = grid.axis(1).cells();
  std::vector<double> count(static_cast<std::size_t>(grid.axis(0).cells() * ny), 0.0);
  auto start = group.column_start.begin();
  for_own_columns([&](std::size_t column) {
    count[column] = static_cast<double>(*(start + 1) - *start);
    ++start;
  });
  discretisation_.ranks().sum(count.data(), count.size());
  return count;
}

/// Particles that another number of ranks saved have been sorted since.
void ActiveGround::resume() {
  auto saved = saved_counts_.begin();
  for (ParticleGroup& group : discretisation_.groups) {
    const std::vector<double>& count = *saved++;
    if (!group.column_start.empty()) continue;
    group.column_start = {0};
    for_own_columns([&](std::size_t column) {
      group.column_start.push_back(group.column_start.back() +
                                   static_cast<std::size_t>(count[column]));
    });
  }
  saved_counts_.clear();
  find_awake_particles();
  find_nodes();
  find_resting_sums();
}

}  // namespace furrow
