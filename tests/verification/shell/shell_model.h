// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Shells for tests: a mesh of a parameter square mapped into space, its supports and loads.

#include <cmath>
#include <functional>

#include "tests/support/linear_static.h"
#include "furrow/shell/shell4.h"

namespace furrow::test {

struct ShellModel {
  ShellModel(Matrix3X x, std::vector<Shell4::Quad> quads, const ShellSection& section,
             const std::function<Vector3(const Vector3&)>& fibre,
             Shell4Turning turning = Shell4Turning::polar)
      : shell(x, std::move(quads), section, fibre, turning),
        nodes(x),
        load(Matrix6X::Zero(6, x.cols())),
        stiffness(assemble_stiffness(x, shell.quads(), section, fibre)) {
    nodes.mass = shell.mass();
    nodes.inertia = shell.rotary_inertia();
  }
  Shell4 shell;
  ShellNodes nodes;
  Matrix6X load;                          // [N], [N m]
  Eigen::SparseMatrix<double> stiffness;  // of the stress-free state

  /// Symmetry about the plane normal to an axis for the nodes that the predicate picks.
  void symmetry(int axis, const std::function<bool(const Vector3&)>& pick) {
    for (Eigen::Index n = 0; n < nodes.count(); ++n)
      if (pick(nodes.x.col(n)))
        for (int k = 0; k < 3; ++k)
          (k == axis ? nodes.free_to_move : nodes.free_to_turn)(k, n) = 0.0;
  }
  Eigen::Index nearest(const Vector3& point) const {
    Eigen::Index best = 0;
    (nodes.x.colwise() - point).colwise().squaredNorm().minCoeff(&best);
    return best;
  }
  Matrix6X solve() const { return solve_linear(stiffness, nodes, load); }
  void compute(double pressure = 0.0) {
    nodes.force.setZero();
    nodes.moment.setZero();
    shell.add_forces(nodes, pressure);
  }
};

/// (n + 1) x (m + 1) nodes of map(s, t), s and t from 0 to 1; quads run s first, so the normal is
/// map_s x map_t.
inline ShellModel mapped_shell(int n, int m, const std::function<Vector3(double, double)>& map,
                               const ShellSection& section,
                               const std::function<Vector3(const Vector3&)>& fibre) {
  Matrix3X x(3, (n + 1) * (m + 1));
  std::vector<Shell4::Quad> quads;
  const auto node = [&](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) x.col(node(i, j)) = map(double(i) / n, double(j) / m);
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i)
      quads.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  return ShellModel(x, std::move(quads), section, fibre);
}

/// A ring round the y axis, normals outwards: n elements around, m across.
inline ShellModel ring(double R, double width, int n, int m, const ShellSection& section) {
  Matrix3X x(3, n * (m + 1));
  std::vector<Shell4::Quad> quads;
  const auto node = [&](int i, int j) { return (i % n) * (m + 1) + j; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= m; ++j) {
      const double angle = 2.0 * pi * i / n;
      x.col(node(i, j)) << R * std::sin(angle), width * (double(j) / m - 0.5), -R * std::cos(angle);
      if (j < m) quads.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  // The sense must make outward normals: checked by the volume below.
  for (Shell4::Quad& quad : quads) {
    const Vector3 normal =
        Vector3(x.col(quad[1]) - x.col(quad[0])).cross(Vector3(x.col(quad[3]) - x.col(quad[0])));
    if (normal.dot(Vector3(x(0, quad[0]), 0.0, x(2, quad[0]))) < 0.0) std::swap(quad[1], quad[3]);
  }
  return ShellModel(x, quads, section,
                    [](const Vector3& at) { return Vector3(-at.z(), 0.0, at.x()); });
}

}  // namespace furrow::test
