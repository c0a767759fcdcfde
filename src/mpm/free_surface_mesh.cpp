// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/free_surface_mesh.h"

#include <algorithm>

#include "mpm/continuum_terrain.h"

namespace furrow {

FreeSurfaceMesh::FreeSurfaceMesh(std::vector<double> ids, std::size_t rows, std::size_t columns)
    : ids_(std::move(ids)), numbers_(6 * ids_.size()) {
  surface_.resize(ids_.size());
  reach_.setZero(3, surface_.x.cols());
  reach_.row(2).setOnes();
  const auto node = [&](std::size_t column, std::size_t row) {
    return static_cast<int>(column * rows + row);
  };
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t r = 0; r < rows; ++r) {
      reach_(0, node(c, r)) = c == 0 ? -1.0 : c + 1 == columns ? 1.0 : 0.0;
      reach_(1, node(c, r)) = r == 0 ? -1.0 : r + 1 == rows ? 1.0 : 0.0;
    }
  for (std::size_t c = 0; c + 1 < columns; ++c)
    for (std::size_t r = 0; r + 1 < rows; ++r) {
      // Diagonals in turns: no direction is preferred.
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

void FreeSurfaceMesh::relocate(const std::vector<ParticleGroup>& groups) {
  attachments_.clear();
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const double* id = groups[k].particles.data(column::id);
    for (std::size_t p = 0; p < groups[k].particles.size(); ++p) {
      const auto found = std::lower_bound(ids_.begin(), ids_.end(), id[p]);
      if (found != ids_.end() && *found == id[p])
        attachments_.push_back({found - ids_.begin(), k, p});
    }
  }
}

Vector3 FreeSurfaceMesh::offset(const std::vector<ParticleGroup>& groups,
                                const NodeAttachment& attachment) const {
  const Particles& particles = groups[attachment.group].particles;
  const std::size_t p = attachment.particle;
  Vector3 half(
      particles.data(column::half_x)[p], particles.data(column::half_y)[p],
      particles.data(column::half_z)[p] * particles.data(column::state + field::volume_ratio)[p]);
  return half.cwiseProduct(reach_.col(attachment.node));
}

Vector3 FreeSurfaceMesh::point_of(const std::vector<ParticleGroup>& groups,
                                  const NodeAttachment& attachment) const {
  return groups[attachment.group].particles.position(attachment.particle) +
         offset(groups, attachment);
}

void FreeSurfaceMesh::pack(const std::vector<ParticleGroup>& groups) {
  std::fill(numbers_.begin(), numbers_.end(), 0.0);
  for (const NodeAttachment& attachment : attachments_) {
    const Particles& particles = groups[attachment.group].particles;
    const Vector3 arm = offset(groups, attachment),
                  x = particles.position(attachment.particle) + arm,
                  v = particles.velocity(attachment.particle) +
                      particles.affine(attachment.particle) * arm;
    double* numbers = numbers_.data() + 6 * attachment.node;
    std::copy_n(x.data(), 3, numbers);
    std::copy_n(v.data(), 3, numbers + 3);
  }
}

void FreeSurfaceMesh::unpack() {
  for (Eigen::Index n = 0; n < surface_.x.cols(); ++n) {
    surface_.x.col(n) = Eigen::Map<const Vector3>(numbers_.data() + 6 * n);
    surface_.v.col(n) = Eigen::Map<const Vector3>(numbers_.data() + 6 * n + 3);
  }
}

}  // namespace furrow
