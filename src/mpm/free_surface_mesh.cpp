// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/free_surface_mesh.h"

#include <algorithm>

namespace furrow {

namespace {

/// Places of nodes among `count` particles: 0, every, 2 every ..., count - 1.
std::vector<std::size_t> places_of_nodes(std::size_t count, std::size_t every) {
  std::vector<std::size_t> places;
  for (std::size_t n = 0; n + 1 < count; n += every) places.push_back(n);
  places.push_back(count - 1);
  return places;
}

/// Direction outwards: -1 at the first of a row, 1 at its last, 0 between them.
double outwards(std::size_t n, std::size_t last) { return n == 0 ? -1.0 : n == last ? 1.0 : 0.0; }

}  // namespace

/// Nodes from the first row to the last, along level stretches and up or down between them.
std::vector<FreeSurfaceMesh::SectionNode> FreeSurfaceMesh::nodes_across(const TerrainFill& fill,
                                                                        std::size_t rows,
                                                                        std::size_t every) {
  std::vector<SectionNode> nodes;
  for (std::size_t from = 0, to = 0; from < rows; from = to) {
    const std::size_t level = fill.first_level(from);
    while (to < rows && fill.first_level(to) == level) ++to;
    const std::vector<std::size_t> places = places_of_nodes(to - from, every);
    for (const std::size_t n : places)
      nodes.push_back({from + n, level, outwards(n, places.back()), 1.0});
    if (to == rows) break;
    // corners between stretches belong to the level ones
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

FreeSurfaceMesh::FreeSurfaceMesh(const TerrainFill& fill, const Grid& grid, std::size_t every,
                                 std::size_t slabs)
    : slabs_(slabs),
      columns_of_slab_(fill.columns(grid) / slabs),
      along_(places_of_nodes(columns_of_slab_, every)),
      across_(nodes_across(fill, fill.rows(grid), every)) {
  const std::size_t nodes = slabs_ * along_.size() * across_.size();
  surface_.resize(nodes);
  motion_.resize(6 * nodes);
  for (std::size_t patch = 0; patch < slabs_; ++patch) add_triangles(patch);
  place(fill, grid, 0);
}

void FreeSurfaceMesh::add_triangles(std::size_t patch) {
  for (std::size_t c = 0; c + 1 < along_.size(); ++c)
    for (std::size_t r = 0; r + 1 < across_.size(); ++r) {
      // Diagonals alternate: no direction is preferred.
      const auto at = [&](std::size_t column, std::size_t row) {
        return static_cast<int>(node(patch, column, row));
      };
      const int a = at(c, r), b = at(c + 1, r), d = at(c, r + 1), e = at(c + 1, r + 1);
      if ((c + r) % 2 == 0) {
        surface_.triangles.emplace_back(a, b, e);
        surface_.triangles.emplace_back(a, e, d);
      } else {
        surface_.triangles.emplace_back(a, b, d);
        surface_.triangles.emplace_back(b, e, d);
      }
    }
}

void FreeSurfaceMesh::place(const TerrainFill& fill, const Grid& grid, std::size_t dropped_slabs) {
  nodes_.clear();
  for (std::size_t slab = dropped_slabs; slab < dropped_slabs + slabs_; ++slab)
    for (std::size_t c = 0; c < along_.size(); ++c) {
      const std::size_t column = slab * columns_of_slab_ + along_[c];
      const double along_x = outwards(c, along_.size() - 1);
      const bool meets_another = (along_x < 0.0 && slab > dropped_slabs) ||
                                 (along_x > 0.0 && slab + 1 < dropped_slabs + slabs_);
      for (std::size_t r = 0; r < across_.size(); ++r) {
        const SectionNode& section = across_[r];
        const auto add = [&](std::size_t column_of_particle, double share, double from_particle) {
          nodes_.push_back({fill.id(grid, column_of_particle, section.row, section.level),
                            node(slab % slabs_, c, r), share,
                            Vector3(from_particle, section.beside, section.above)});
        };
        add(column, meets_another ? 0.5 : 1.0, along_x);
        if (meets_another) add(along_x < 0.0 ? column - 1 : column + 1, 0.5, -along_x);
      }
    }
  std::sort(nodes_.begin(), nodes_.end(), [](const auto& a, const auto& b) {
    return a.id != b.id ? a.id < b.id : a.node < b.node;
  });
}

void FreeSurfaceMesh::attach(const std::vector<ParticleGroup>& groups) {
  attachments_.clear();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double* id = groups[g].particles.data(column::id);
    for (std::size_t p = 0; p < groups[g].particles.size(); ++p) {
      auto found = std::lower_bound(
          nodes_.begin(), nodes_.end(), id[p],
          [](const NodeOfParticle& node, double number) { return node.id < number; });
      for (; found != nodes_.end() && found->id == id[p]; ++found)
        attachments_.push_back({static_cast<std::size_t>(found - nodes_.begin()), {g, p}});
    }
  }
}

Vector3 FreeSurfaceMesh::offset(const std::vector<ParticleGroup>& groups,
                                const NodeAttachment& attachment) const {
  const Particles& particles = groups[attachment.particle.group].particles;
  Vector3 half = particles.half_spacing(attachment.particle.particle);
  half.z() *= particles.volume_ratio(attachment.particle.particle);
  return half.cwiseProduct(nodes_[attachment.of].offset);
}

void FreeSurfaceMesh::update(const std::vector<ParticleGroup>& groups, PointLoads& loads,
                             const Communicator& ranks) {
  particles_.clear();
  for (const NodeAttachment& attachment : attachments_) particles_.push_back(attachment.particle);
  loads.interpolate_motion(particles_, particle_motions_);
  std::fill(motion_.begin(), motion_.end(), 0.0);
  for (std::size_t n = 0; n < attachments_.size(); ++n) {
    const NodeAttachment& attachment = attachments_[n];
    const Vector3 x = particle_motions_[n].position + offset(groups, attachment);
    const Vector3 v = particle_motions_[n].velocity_at(x);
    const NodeOfParticle& of_node = nodes_[attachment.of];
    double* node = motion_.data() + 6 * of_node.node;
    Eigen::Map<Vector3>(node) += of_node.share * x;
    Eigen::Map<Vector3>(node + 3) += of_node.share * v;
  }
  // A share of a node is added on one rank; there are no more than two.
  ranks.sum(motion_.data(), motion_.size());
  for (Eigen::Index n = 0; n < surface_.x.cols(); ++n) {
    surface_.x.col(n) = Eigen::Map<const Vector3>(motion_.data() + 6 * n);
    surface_.v.col(n) = Eigen::Map<const Vector3>(motion_.data() + 6 * n + 3);
  }
}

void FreeSurfaceMesh::add_forces_to(PointLoads& loads, const std::vector<ParticleGroup>& groups,
                                    const Matrix3X& forces) const {
  for (const NodeAttachment& attachment : attachments_) {
    const NodeOfParticle& of_node = nodes_[attachment.of];
    const Vector3 force = of_node.share * forces.col(of_node.node);
    if (!(force.squaredNorm() > 0.0)) continue;
    const ParticleIndex& particle = attachment.particle;
    const Vector3 point =
        groups[particle.group].particles.position(particle.particle) + offset(groups, attachment);
    loads.add(particle, force, point);
  }
}

}  // namespace furrow
