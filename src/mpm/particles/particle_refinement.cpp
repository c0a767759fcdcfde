// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/particles/particle_refinement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/mpm/ground/terrain_fill.h"

namespace furrow {

namespace {

// longer particles are divided: length over (length of the cell)/(particles per cell)
constexpr double longest_particle = 1.25;
// largest length of a united pair, which is not divided again after a small motion
constexpr double longest_pair = 1.1;
// Distance of two that are united, over their length along x and their spacing across
constexpr double furthest_along = 1.5;
constexpr double furthest_across = 0.5;
// Differences of two that are united, relative to the larger value
constexpr double density_tolerance = 0.05;
constexpr double state_tolerance = 0.1;
// negligible difference of a strain, and the strain of a negligible stress
constexpr double strain_floor = 2e-3;
constexpr double elastic_floor = 1e-5;

/// @throws InputError for parameters of a ground that is not laid in long particles
void check_refined_ground(const TerrainParameters& parameters, const std::string& where) {
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    throw InputError(where + ", keyword 'fine_length'", "is given with 'follow' and " + what,
                     "flat ground of one piece that carries no grains, without absorbing faces",
                     remedy + ", or remove 'fine_length'");
  };
  if (!parameters.relief.flat()) refuse("an uneven surface", "make the surface flat");
  if (parameters.surface_mesh) refuse("'surface_mesh yes'", "remove the surface mesh");
  if (parameters.slide) refuse("a slide surface", "remove the slide surface");
  for (const Face face : all_faces)
    if (parameters.boundary[face] == BoundaryKind::absorbing)
      refuse("an absorbing face", "write 'smooth' or 'rough' in place of 'absorbing'");
}

bool differ(double a, double b, double tolerance, double floor) {
  return !(std::abs(a - b) <= std::max(floor, tolerance * std::max(std::abs(a), std::abs(b))));
}

}  // namespace

FollowingAxis following_axis(const AxisLayout& wanted, const std::string& where) {
  const double cell = wanted.cell, middle = 0.5 * (wanted.lower + wanted.upper);
  const double cells = (wanted.upper - wanted.lower) / cell,
               fine_cells = (wanted.fine_upper - wanted.fine_lower) / cell;
  for (int halvings = static_cast<int>(std::log2(cells)); halvings > 0; --halvings) {
    const double stride = std::ldexp(1.0, halvings);  // in cells
    const double half = 0.5 * stride * std::round(cells / stride),
                 half_fine = std::ceil(0.5 * (fine_cells + stride) - 1e-9);
    if (half - half_fine < stride) continue;
    AxisLayout layout = wanted;
    layout.lower = middle - half * cell;
    layout.upper = middle + half * cell;
    layout.fine_lower = middle - half_fine * cell;
    layout.fine_upper = middle + half_fine * cell;
    layout.stepped = true;
    // the next shorter cell has 3/4 of a stride
    if (Axis(layout, where).length(0) > 0.9 * stride * cell) return {layout, halvings};
  }
  AxisLayout uniform = wanted;
  uniform.fine_lower = wanted.lower;
  uniform.fine_upper = wanted.upper;
  return {uniform, 0};
}

ParticleRefinement::ParticleRefinement(const TerrainParameters& parameters, const Grid& grid,
                                       const std::string& where)
    : x_(grid.axis(0)),
      particles_per_cell_(parameters.particles_per_cell),
      maximum_parts_(1L << parameters.halvings) {
  check_refined_ground(parameters, where);
}

long ParticleRefinement::parts(const Particles& particles, std::size_t p) const {
  return std::lround(2.0 * particles.data(column::half_x)[p] * particles_per_cell_[0] /
                     x_.fine_cell());
}

/// Length that fits the cell of a particle [m]; any outside of the grid.
double ParticleRefinement::length_wanted(const Particles& particles, std::size_t p) const {
  const int cell = x_.cell_of(particles.data(column::x)[p]);
  return cell < 0 ? 2.0 * particles.data(column::half_x)[p]
                  : x_.length(cell) / particles_per_cell_[0];
}

void ParticleRefinement::refine(std::vector<ParticleGroup>& groups) const {
  for (ParticleGroup& group : groups) {
    divide(group);
    while (unite(group)) continue;
  }
}

/// Halves keep velocity and affine velocity: momentum and angular momentum stay.
void ParticleRefinement::divide(ParticleGroup& group) const {
  Particles& particles = group.particles;
  const auto width = group.material->find_field("band_width");
  // the loop also reaches the halves that it appends
  for (std::size_t p = 0; p < particles.size(); ++p)
    while (parts(particles, p) > 1 && particles.is_idle(p) &&
           2.0 * particles.data(column::half_x)[p] >
               longest_particle * length_wanted(particles, p)) {
      const double half = 0.5 * particles.data(column::half_x)[p];
      particles.data(column::half_x)[p] = half;
      particles.data(column::volume)[p] *= 0.5;
      if (width)
        particles.data(column::state + *width)[p] =
            band_width(particles_per_cell_, particles.half_spacing(p));
      const std::size_t second = particles.duplicate(p);
      particles.data(column::id)[second] += static_cast<double>(parts(particles, p));
      for (const std::size_t place : {column::x, column::initial_x}) {
        particles.data(place)[p] -= half;
        particles.data(place)[second] += half;
      }
    }
}

/// Unites pairs of halves of one particle. @return whether there were any
bool ParticleRefinement::unite(ParticleGroup& group) const {
  Particles& particles = group.particles;
  struct Half {
    std::int64_t whole;  // id of the particle that was divided
    long parts;
    std::size_t index;
  };
  std::vector<Half> halves;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const long mine = parts(particles, p);
    if (mine < maximum_parts_ &&
        4.0 * particles.data(column::half_x)[p] <= longest_pair * length_wanted(particles, p))
      halves.push_back(
          {static_cast<std::int64_t>(particles.data(column::id)[p]) / (2 * mine), mine, p});
  }
  std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
    return std::tie(a.parts, a.whole, a.index) < std::tie(b.parts, b.whole, b.index);
  });
  std::vector<bool> gone(particles.size(), false);
  bool any = false;
  for (std::size_t n = 0; n + 1 < halves.size(); ++n) {
    const auto [whole, length, p] = halves[n];
    const std::size_t other = halves[n + 1].index;
    if (halves[n + 1].whole != whole || halves[n + 1].parts != length ||
        !may_unite(group, p, other))
      continue;
    const double id = std::min(particles.data(column::id)[p], particles.data(column::id)[other]);
    particles.average(p, other);
    particles.data(column::id)[p] = id;
    particles.data(column::half_x)[p] *= 2.0;
    particles.data(column::volume)[p] *= 2.0;
    gone[other] = any = true;
  }
  if (!any) return false;
  std::vector<std::size_t> kept;
  for (std::size_t p = 0; p < particles.size(); ++p)
    if (!gone[p]) kept.push_back(p);
  particles.reorder(kept);
  return true;
}

bool ParticleRefinement::may_unite(const ParticleGroup& group, std::size_t a, std::size_t b) const {
  const Particles& particles = group.particles;
  const Vector3 spacing = 2.0 * particles.half_spacing(a),
                offset = (particles.position(a) - particles.position(b)).cwiseAbs();
  return offset.x() < furthest_along * spacing.x() && offset.y() < furthest_across * spacing.y() &&
         offset.z() < furthest_across * spacing.z() && particles.is_idle(a) &&
         particles.is_idle(b) && are_alike(group, a, b);
}

bool are_alike(const ParticleGroup& group, std::size_t a, std::size_t b) {
  const VectorX one = group.particles.state(a), other = group.particles.state(b);
  if (differ(one[field::volume_ratio], other[field::volume_ratio], density_tolerance, 0.0))
    return false;
  const double stress_floor = elastic_floor * group.material->moduli(one).wave();
  const double stress = std::max(stress_of(one).norm(), stress_of(other).norm());
  if ((stress_of(one) - stress_of(other)).norm() > std::max(stress_floor, state_tolerance * stress))
    return false;
  const std::vector<StateField>& fields = group.material->state_fields();
  for (std::size_t f = field::internal; f < fields.size(); ++f) {
    const double floor = fields[f].unit == "Pa"   ? stress_floor
                         : fields[f].unit.empty() ? strain_floor
                                                  : 0.0;
    const auto n = static_cast<Eigen::Index>(f);
    if (differ(one[n], other[n], state_tolerance, floor)) return false;
  }
  return true;
}

}  // namespace furrow
