// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/darnell/tyre_surface.h"

namespace furrow {

namespace {

/// Calls visit(node, its tread node, its share s) for all nodes of the sidewalls.
template <class Visit>
void for_sidewall_nodes(const std::vector<SidewallRing>& rings, int rows, Eigen::Index first,
                        Visit visit) {
  Eigen::Index node = first;
  for (const SidewallRing& ring : rings)
    for (std::size_t i = 0; i < ring.stations(); ++i)
      for (int k = 0; k < rows; ++k, ++node)
        visit(node, Eigen::Index{ring.edge()[i]}, static_cast<double>(k) / rows);
}

}  // namespace

TyreSurface::TyreSurface(const TreadMesh& tread, const std::vector<SidewallRing>& rings, int rows)
    : tread_nodes_(tread.x.cols()), rows_(rows) {
  const int on_ring = tread.grid.around * rows;
  const int tread_nodes = tread.grid.count();
  surface_.resize(static_cast<std::size_t>(tread_nodes + static_cast<int>(rings.size()) * on_ring));
  add_tread(tread);
  for (std::size_t r = 0; r < rings.size() && rows > 0; ++r)
    add_sidewall(rings[r], tread_nodes + static_cast<int>(r) * on_ring);
}

/// Two triangles of a quadrilateral that runs counter-clockwise seen from outside, cut along the
/// diagonal from b to d, or else from a to c.
void TyreSurface::add_quad(int a, int b, int c, int d, bool along_bd) {
  if (along_bd) {
    surface_.triangles.emplace_back(a, b, d);
    surface_.triangles.emplace_back(b, c, d);
  } else {
    surface_.triangles.emplace_back(a, b, c);
    surface_.triangles.emplace_back(a, c, d);
  }
}

/// Diagonals are mirror images about the middle of the tread.
void TyreSurface::add_tread(const TreadMesh& tread) {
  for (std::size_t e = 0; e < tread.quads.size(); ++e) {
    const Shell4::Quad& q = tread.quads[e];
    const int row = static_cast<int>(e) % tread.grid.rows;
    add_quad(q[0], q[1], q[2], q[3], tread.grid.half || 2 * row >= tread.grid.rows);
  }
}

/// @param first its first node
void TyreSurface::add_sidewall(const SidewallRing& ring, int first) {
  const int n = static_cast<int>(ring.stations());
  const auto node = [&](int i, int k) {
    i %= n;
    return k == rows_ ? ring.edge()[static_cast<std::size_t>(i)] : first + i * rows_ + k;
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < rows_; ++k) {
      if (ring.side() > 0)
        add_quad(node(i, k), node(i + 1, k), node(i + 1, k + 1), node(i, k + 1), false);
      else
        add_quad(node(i, k), node(i, k + 1), node(i + 1, k + 1), node(i + 1, k), false);
    }
}

void TyreSurface::place(const ShellNodes& tread, const std::vector<SidewallRing>& rings,
                        const WheelHub& rim) {
  surface_.x.leftCols(tread_nodes_) = tread.x;
  surface_.v.leftCols(tread_nodes_) = tread.v;
  if (rows_ == 0) return;
  const RimPose pose{rim.centre(), rim.attitude()};
  Eigen::Index first = tread_nodes_;
  for (const SidewallRing& ring : rings) {
    ring.arcs(rows_, tread, pose, surface_.x, first);
    first += static_cast<Eigen::Index>(ring.stations()) * rows_;
  }
  for_sidewall_nodes(
      rings, rows_, tread_nodes_, [&](Eigen::Index node, Eigen::Index edge, double s) {
        const Vector3 arm =
            surface_.x.col(node) - rim.centre() - s * (tread.x.col(edge) - rim.centre());
        surface_.v.col(node) =
            s * tread.v.col(edge) + (1.0 - s) * rim.velocity() + rim.angular_velocity().cross(arm);
      });
}

Wrench TyreSurface::hand_over(const ShellNodes& tread, const std::vector<SidewallRing>& rings,
                              const WheelHub& rim, Matrix3X& on_tread) const {
  on_tread = surface_.f.leftCols(tread_nodes_);
  Wrench on_rim;
  for_sidewall_nodes(
      rings, rows_, tread_nodes_, [&](Eigen::Index node, Eigen::Index edge, double s) {
        const Vector3 f = surface_.f.col(node);
        if (f.isZero(0.0)) return;
        on_tread.col(edge) += s * f;
        on_rim.force += (1.0 - s) * f;
        on_rim.moment +=
            Vector3(surface_.x.col(node) - rim.centre() - s * (tread.x.col(edge) - rim.centre()))
                .cross(f);
      });
  return on_rim;
}

}  // namespace furrow
