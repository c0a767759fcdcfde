// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/free_surface_mesh.h"

#include <algorithm>

namespace furrow {

namespace {

/// 0, every, 2 every ..., count - 1.
std::vector<std::size_t> places_of_nodes(std::size_t count, std::size_t every) {
  std::vector<std::size_t> places;
  for (std::size_t n = 0; n + 1 < count; n += every) places.push_back(n);
  places.push_back(count - 1);
  return places;
}

/// -1 at the first of a row, 1 at its last, 0 between them.
double outwards(std::size_t n, std::size_t last) { return n == 0 ? -1.0 : n == last ? 1.0 : 0.0; }

/// A node in the cross-section of the ground.
struct SectionNode {
  std::size_t row, level;  // of its particle
  double beside, above;    // of it, in half spacings along y and z
};

/// From the first row to the last, along level stretches and up or down between them.
std::vector<SectionNode> nodes_across(const TerrainFill& fill, std::size_t rows,
                                      std::size_t every) {
  std::vector<SectionNode> nodes;
  for (std::size_t from = 0, to = 0; from < rows; from = to) {
    const std::size_t level = fill.first_level(from);
    while (to < rows && fill.first_level(to) == level) ++to;
    const std::vector<std::size_t> places = places_of_nodes(to - from, every);
    for (const std::size_t n : places)
      nodes.push_back({from + n, level, outwards(n, places.back()), 1.0});
    if (to == rows) break;
    // The corners belong to the level stretches.
    const std::size_t next = fill.first_level(to);
    std::vector<std::size_t> heights =
        places_of_nodes(std::max(level, next) - std::min(level, next), every);
    const bool down = next > level;
    if (!down) std::reverse(heights.begin(), heights.end());
    for (std::size_t n = 1; n + 1 < heights.size(); ++n)
      nodes.push_back(
          {down ? to - 1 : to, std::min(level, next) + heights[n], down ? 1.0 : -1.0, 0.0});
  }
  return nodes;
}

}  // namespace

FreeSurfaceMesh::FreeSurfaceMesh(const TerrainFill& fill, const Grid& grid, std::size_t every) {
  const std::vector<std::size_t> along = places_of_nodes(fill.columns(grid), every);
  const std::vector<SectionNode> across = nodes_across(fill, fill.rows(grid), every);
  const std::size_t columns = along.size();
  const std::size_t rows = across.size();
  const auto node = [&](std::size_t column, std::size_t row) {
    return static_cast<int>(column * rows + row);
  };
  surface_.resize(columns * rows);
  motion_.resize(6 * columns * rows);
  offset_.resize(3, surface_.x.cols());
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t r = 0; r < rows; ++r) {
      const SectionNode& place = across[r];
      nodes_.push_back({fill.id(grid, along[c], place.row, place.level), node(c, r)});
      offset_.col(node(c, r)) << outwards(c, columns - 1), place.beside, place.above;
    }
  std::sort(nodes_.begin(), nodes_.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  for (std::size_t c = 0; c + 1 < columns; ++c)
    for (std::size_t r = 0; r + 1 < rows; ++r) {
      // Diagonals alternate: no direction is preferred.
      const int a = node(c, r), b = node(c + 1, r), d = node(c, r + 1), e = node(c + 1, r + 1);
      if ((c + r) % 2 == 0) {
        surface_.triangles.emplace_back(a, b, e);
        surface_.triangles.emplace_back(a, e, d);
      } else {
        surface_.triangles.emplace_back(a, b, d);
        surface_.triangles.emplace_back(b, e, d);
      }
    }
}

void FreeSurfaceMesh::attach(const std::vector<ParticleGroup>& groups) {
  attachments_.clear();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double* id = groups[g].particles.data(column::id);
    for (std::size_t p = 0; p < groups[g].particles.size(); ++p) {
      const auto found = std::lower_bound(
          nodes_.begin(), nodes_.end(), id[p],
          [](const NodeOfParticle& node, double number) { return node.id < number; });
      if (found != nodes_.end() && found->id == id[p])
        attachments_.push_back({found->node, {g, p}});
    }
  }
}

Vector3 FreeSurfaceMesh::offset(const std::vector<ParticleGroup>& groups,
                                const NodeAttachment& attachment) const {
  const Particles& particles = groups[attachment.particle.group].particles;
  Vector3 half = particles.half_spacing(attachment.particle.particle);
  half.z() *= particles.volume_ratio(attachment.particle.particle);
  return half.cwiseProduct(offset_.col(attachment.node));
}

void FreeSurfaceMesh::update(const std::vector<ParticleGroup>& groups, const Communicator& ranks) {
  std::fill(motion_.begin(), motion_.end(), 0.0);
  for (const NodeAttachment& attachment : attachments_) {
    const Particles& particles = groups[attachment.particle.group].particles;
    const std::size_t p = attachment.particle.particle;
    const Vector3 from_particle = offset(groups, attachment);
    const Vector3 x = particles.position(p) + from_particle;
    const Vector3 v = particles.velocity(p) + particles.affine(p) * from_particle;
    double* node = motion_.data() + 6 * attachment.node;
    std::copy_n(x.data(), 3, node);
    std::copy_n(v.data(), 3, node + 3);
  }
  // Each node is set on one rank and zero on the others.
  ranks.sum(motion_.data(), motion_.size());
  for (Eigen::Index n = 0; n < surface_.x.cols(); ++n) {
    surface_.x.col(n) = Eigen::Map<const Vector3>(motion_.data() + 6 * n);
    surface_.v.col(n) = Eigen::Map<const Vector3>(motion_.data() + 6 * n + 3);
  }
}

void FreeSurfaceMesh::add_forces_to(PointLoads& loads, const std::vector<ParticleGroup>& groups,
                                    const Matrix3X& forces) const {
  for (const NodeAttachment& attachment : attachments_) {
    const Vector3 force = forces.col(attachment.node);
    if (!(force.squaredNorm() > 0.0)) continue;
    const ParticleIndex& particle = attachment.particle;
    const Vector3 point =
        groups[particle.group].particles.position(particle.particle) + offset(groups, attachment);
    loads.add(particle, force, point);
  }
}

}  // namespace furrow
