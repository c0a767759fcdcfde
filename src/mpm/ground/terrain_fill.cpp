// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/terrain_fill.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double minimum_cells = 2.0;  // below a relief, and one above it
constexpr double max_off_knot = 1e-6;  // of the cell: the surface is where two cells meet

/// Levels of particles from the surface down, with their state.
std::vector<ParticleLevel> make_levels(const TerrainParameters& parameters, const Grid& grid) {
  std::vector<ParticleLevel> levels;
  const Axis& z = grid.axis(2);
  const int count = parameters.particles_per_cell[2];
  for (int cell = z.cells() - 1; cell >= 0; --cell) {
    if (z.knot(cell) + 0.5 * z.length(cell) > parameters.surface) continue;
    for (int n = count - 1; n >= 0; --n) {
      ParticleLevel level;
      level.z = z.knot(cell) + (n + 0.5) * z.length(cell) / count;
      level.half = 0.5 * z.length(cell) / count;
      levels.push_back(level);
    }
  }
  // The same levels, counted from the surface, reach the base below the highest relief.
  const double lowest = z.lower() - (z.upper() - parameters.surface);
  while (!parameters.relief.flat() && levels.back().z > lowest) {
    levels.push_back(levels.back());
    levels.back().z -= 2.0 * levels.back().half;
  }
  find_overburden(parameters, parameters.trough ? 0.0 : parameters.surcharge, levels);
  return levels;
}

std::vector<std::optional<std::size_t>> fields_of_band_width(
    const std::vector<TerrainLayer>& layers) {
  std::vector<std::optional<std::size_t>> fields;
  for (const TerrainLayer& layer : layers)
    fields.push_back(layer.material->find_field("band_width"));
  return fields;
}

/// Levels of particles in the layers of each patch.
std::vector<std::vector<ParticleLevel>> make_patch_levels(
    const TerrainParameters& parameters, const std::vector<ParticleLevel>& levels) {
  std::vector<std::vector<ParticleLevel>> of_patches;
  for (std::size_t patch = 1; patch <= parameters.patches.size(); ++patch) {
    of_patches.push_back(levels);
    find_overburden(parameters, parameters.surcharge, of_patches.back(), patch);
  }
  return of_patches;
}

std::vector<double> begins_of(const std::vector<TerrainPatch>& patches) {
  std::vector<double> begins;
  for (const TerrainPatch& patch : patches) begins.push_back(patch.begin);
  return begins;
}

/// Levels of particles from the bottom of a trough down; none without a trough.
std::vector<ParticleLevel> make_levels_below(const TroughPlace& trough,
                                             const TerrainParameters& parameters,
                                             const std::vector<ParticleLevel>& beside) {
  if (!parameters.trough) return {};
  std::vector<ParticleLevel> levels(beside.begin() + static_cast<std::ptrdiff_t>(trough.levels),
                                    beside.end());
  find_overburden(parameters, parameters.surcharge, levels);
  return levels;
}

/// A layer thinner than the particles are apart may fall between them.
void check_layers(const TerrainParameters& parameters, const std::vector<ParticleLevel>& levels,
                  std::size_t patch, const std::string& where) {
  const auto [first, last] = parameters.layers_of(patch);
  for (std::size_t n = first; n <= last; ++n) {
    const auto in_layer = [n](const ParticleLevel& level) { return level.layer == n; };
    if (std::any_of(levels.begin(), levels.end(), in_layer)) continue;
    const double spacing = levels.empty() ? 0.0 : 2.0 * levels.front().half;
    throw InputError(
        where,
        fmt::format("has no particles in layer {} from the top, {:.4g} m thick: particles are "
                    "{:.4g} m apart",
                    n - first + 1, parameters.layers[n].thickness, spacing),
        "layers thicker than the spacing of the particles",
        fmt::format("make the layer at least {:.4g} m thick within the depth, or the cells "
                    "smaller",
                    spacing));
  }
}

}  // namespace

double band_width(const std::array<int, 3>& particles_per_cell, const Vector3& half) {
  return 2.0 * std::cbrt(particles_per_cell[0] * particles_per_cell[1] * particles_per_cell[2] *
                         half[0] * half[1] * half[2]);
}

Grid make_grid(const TerrainParameters& parameters, const std::string& where) {
  Grid grid(Axis(parameters.x, where + ", x axis"), Axis(parameters.y, where + ", y axis"),
            Axis(parameters.z, where + ", z axis"), parameters.velocity_fields());
  const Axis& z = grid.axis(2);
  const double surface = parameters.surface;
  const int cell = z.cell_of(surface);
  const double off =
      cell < 0 ? 1.0
               : std::min(surface - z.knot(cell), z.knot(cell + 1) - surface) / z.length(cell);
  if (off > max_off_knot)
    throw InputError(
        where, fmt::format("has its surface at z = {:.6g} m, inside of a cell", surface),
        "the height of an end of a cell",
        "let the fine stretch of the z axis be a whole number of cells below the surface and above "
        "it");
  return grid;
}

TerrainFill::TerrainFill(const TerrainParameters& parameters, const Grid& grid,
                         const std::string& where)
    : where_(where),
      layers_(parameters.layers),
      band_widths_(fields_of_band_width(parameters.layers)),
      relief_(parameters.relief),
      base_(grid.axis(2).lower()),
      depth_(parameters.surface - base_),
      clearance_(grid.axis(2).upper() - parameters.surface),
      shortest_cell_(grid.axis(2).shortest()),
      slide_(parameters.slide),
      particles_per_cell_(parameters.particles_per_cell),
      levels_(make_levels(parameters, grid)),
      patch_axis_(parameters.patch_axis),
      patch_begins_(begins_of(parameters.patches)),
      patch_levels_(make_patch_levels(parameters, levels_)),
      trough_(place_trough(parameters, grid.axis(1), levels_, where)),
      levels_below_trough_(make_levels_below(trough_, parameters, levels_)),
      ids_per_particle_(1 << parameters.halvings) {
  check_layers(parameters, levels_, 0, where);
  for (std::size_t patch = 0; patch < patch_levels_.size(); ++patch)
    check_layers(parameters, patch_levels_[patch], patch + 1, where);
}

std::vector<WaveSpeeds> TerrainFill::wave_speeds(const Grid& grid) const {
  std::vector<WaveSpeeds> speeds;
  for (int k = 0; k < grid.nodes(2); ++k) {
    const double z = grid.axis(2).node(k);
    const auto nearest = std::min_element(levels_.begin(), levels_.end(),
                                          [z](const ParticleLevel& a, const ParticleLevel& b) {
                                            return std::abs(a.z - z) < std::abs(b.z - z);
                                          });
    speeds.push_back(wave_speeds(*nearest));
  }
  return speeds;
}

WaveSpeeds TerrainFill::wave_speeds(const ParticleLevel& level) const {
  const Material& material = *layers_[level.layer].material;
  const ElasticModuli moduli = material.moduli(level.state);
  const double density = material.current_density(level.state);
  return {std::sqrt(moduli.wave() / density), std::sqrt(moduli.shear / density)};
}

double TerrainFill::slowest_wave_speed() const {
  std::vector<double> largest(layers_.size(), 0.0);
  const auto add = [&](const std::vector<ParticleLevel>& levels) {
    for (const ParticleLevel& level : levels)
      largest[level.layer] = std::max(largest[level.layer], wave_speeds(level).pressure);
  };
  add(levels_);
  for (const std::vector<ParticleLevel>& levels : patch_levels_) add(levels);
  return *std::min_element(largest.begin(), largest.end());
}

void TerrainFill::fill(Discretisation& discretisation) {
  const Axis& x = discretisation.grid.axis(0);
  if (ids_per_particle_ == 1) {
    for (int cell = 0; cell < x.cells(); ++cell)
      add_layer(x.knot(cell), x.length(cell), discretisation);
    return;
  }
  const double thickness = stride(discretisation.grid);
  const long layers = std::lround((x.upper() - x.lower()) / thickness);
  for (long n = 0; n < layers; ++n)
    add_layer(x.lower() + static_cast<double>(n) * thickness, thickness, discretisation);
}

void TerrainFill::add_ahead(Discretisation& discretisation) {
  const Axis& x = discretisation.grid.axis(0);
  const int last = x.cells() - 1;
  if (ids_per_particle_ == 1)
    add_layer(x.knot(last), x.length(last), discretisation);
  else
    add_layer(x.upper() - stride(discretisation.grid), stride(discretisation.grid), discretisation);
}

void TerrainFill::add_layer(double lower, double thickness, Discretisation& discretisation) {
  const Axis& x = discretisation.grid.axis(0);
  const Axis& y = discretisation.grid.axis(1);
  const Partition& partition = discretisation.partition;
  const int rows = particles_per_cell_[1];
  const double half_x = 0.5 * thickness / particles_per_cell_[0];
  for (int i = 0; i < particles_per_cell_[0]; ++i) {
    const double x_place = lower + (2 * i + 1) * half_x;
    const int x_cell = x.cell_of(x_place);
    for (int y_cell = 0; y_cell < y.cells(); ++y_cell) {
      const bool mine = partition.owner(x_cell, y_cell) == partition.ranks().rank();
      const double half_y = 0.5 * y.length(y_cell) / rows;
      for (int j = 0; j < rows; ++j) {
        const std::array<double, 2> place = {x_place, y.knot(y_cell) + (2 * j + 1) * half_y};
        const double height = height_at(place);
        if (mine)
          add_stack(place, {half_x, half_y}, height, static_cast<std::size_t>(y_cell * rows + j),
                    discretisation);
        next_id_ += static_cast<double>(levels_.size());
      }
    }
  }
}

const std::vector<ParticleLevel>& TerrainFill::levels_at(const std::array<double, 2>& place) const {
  const double along = place[static_cast<std::size_t>(patch_axis_)];
  const auto next = std::upper_bound(patch_begins_.begin(), patch_begins_.end(), along);
  if (next == patch_begins_.begin()) return levels_;
  return patch_levels_[static_cast<std::size_t>(next - patch_begins_.begin()) - 1];
}

/// Height of the relief [m]. Every rank asks for every place, so that all of them throw.
double TerrainFill::height_at(const std::array<double, 2>& place) const {
  const double height = relief_.height(place[0], place[1]);
  const double lowest = minimum_cells * shortest_cell_ - depth_,
               highest = clearance_ - shortest_cell_;
  if (relief_.flat() || (height >= lowest && height <= highest)) return height;
  throw InputError(
      where_,
      fmt::format("has its surface {:.4g} m {} 'surface' at x = {:.4g}, y = {:.4g} m",
                  std::abs(height), height < 0.0 ? "below" : "above", place[0], place[1]),
      fmt::format("heights from {:.4g} to {:.4g} m within depth and clearance", lowest, highest),
      fmt::format("raise '{}', or give all heights in m",
                  height < 0.0 ? "depth" : "clearance_above"));
}

/// The particles of a place (x, y), which stand for ground of two half spacings [m]. A relief lifts
/// the levels by its height; the lowest one that it leaves reaches down to the base.
void TerrainFill::add_stack(const std::array<double, 2>& place,
                            const std::array<double, 2>& half_spacing, double height,
                            std::size_t row, Discretisation& discretisation) {
  const std::size_t first = first_level(row);
  const std::vector<ParticleLevel>& levels = first > 0 ? levels_below_trough_ : levels_at(place);
  bool lowest = false;
  for (std::size_t n = 0; n < levels.size() && !lowest; ++n) {
    const ParticleLevel& level = levels[n];
    double position[3] = {place[0], place[1], level.z + height};
    double half[3] = {half_spacing[0], half_spacing[1], level.half};
    if (const double left = position[2] + half[2] - base_;
        !relief_.flat() && left < 3.0 * half[2]) {
      half[2] = 0.5 * left;
      position[2] = base_ + half[2];
      lowest = true;
    }
    const std::size_t side = slide_ ? slide_->side(Eigen::Map<const Vector3>(position)) : 0;
    Particles& particles = discretisation.groups[side * layers_.size() + level.layer].particles;
    const std::size_t p = particles.append(1);
    for (std::size_t a = 0; a < 3; ++a) {
      particles.data(column::x + a)[p] = position[a];
      particles.data(column::initial_x + a)[p] = position[a];
      particles.data(column::half_x + a)[p] = half[a];
    }
    particles.data(column::volume)[p] =
        8.0 * half[0] * half[1] * half[2] / level.state[field::volume_ratio];
    particles.data(column::id)[p] = ids_per_particle_ * (next_id_ + static_cast<double>(first + n));
    particles.set_state(p, level.state);
    if (const auto width = band_widths_[level.layer])
      particles.data(column::state + *width)[p] =
          band_width(particles_per_cell_, {half[0], half[1], half[2]});
  }
}

std::size_t TerrainFill::columns(const Grid& grid) const {
  return static_cast<std::size_t>(grid.axis(0).cells() * particles_per_cell_[0]);
}

std::size_t TerrainFill::rows(const Grid& grid) const {
  return static_cast<std::size_t>(grid.axis(1).cells() * particles_per_cell_[1]);
}

std::size_t TerrainFill::first_level(std::size_t row) const {
  return trough_.contains(row) ? trough_.levels : 0;
}

/// Id of a particle as add_layer() counts: the levels of a place follow one another, those that a
/// trough leaves out too.
double TerrainFill::id(const Grid& grid, std::size_t column, std::size_t row,
                       std::size_t level) const {
  return static_cast<double>((column * rows(grid) + row) * levels_.size() + level);
}

std::size_t TerrainFill::column_of(const Grid& grid, double id) const {
  return static_cast<std::size_t>(id) / (rows(grid) * levels_.size());
}

void TerrainFill::checkpoint(Checkpoint& state) {
  relief_.match(state);
  for (const double begin : patch_begins_) state.match("begin of a patch", begin);
  state.value("next_id", next_id_);
}

}  // namespace furrow
