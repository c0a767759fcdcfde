// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/tangent_stiffness.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// Size of a difference: a turn [rad], or a displacement over the length that a turn of one node
// moves its mass by. Rounding and curvature of the forces are then both below 1e-8 of a stiffness.
constexpr double difference = 1e-6;
// Share of the forces in a motion of all nodes that the error of the differences may reach
constexpr double unexplained = 1e-4;

/// Colours such that nodes of one colour have no neighbour in common.
std::vector<std::vector<int>> independent_nodes(const NodeNeighbours& neighbours) {
  std::vector<int> colour(neighbours.size(), -1);
  std::vector<std::vector<int>> groups;
  std::vector<char> taken;
  for (std::size_t node = 0; node < neighbours.size(); ++node) {
    taken.assign(groups.size() + 1, 0);
    for (const int near : neighbours[node])
      for (const int other : neighbours[static_cast<std::size_t>(near)])
        if (const int used = colour[static_cast<std::size_t>(other)]; used >= 0)
          taken[static_cast<std::size_t>(used)] = 1;
    const auto free =
        static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (free == groups.size()) groups.emplace_back();
    groups[free].push_back(static_cast<int>(node));
    colour[node] = static_cast<int>(free);
  }
  return groups;
}

/// Forces of a structure that is moved a little to either side and put back.
class Differences {
 public:
  Differences(RelaxingStructure& structure, const FreeComponents& free)
      : structure_(structure), free_(free), rest_(structure.nodes()) {}

  /// Resistance [N, N m]: minus the change of the forces for `by`.
  VectorX resistance(const VectorX& by) {
    const VectorX ahead = forces(by);
    const VectorX behind = forces(-by);
    structure_.nodes() = rest_;
    return 0.5 * (behind - ahead);
  }

 private:
  VectorX forces(const VectorX& by) {
    structure_.nodes() = rest_;
    free_.move(by, structure_.nodes());
    structure_.compute_forces();
    return free_.forces(structure_.nodes());
  }

  RelaxingStructure& structure_;
  const FreeComponents& free_;
  const ShellNodes rest_;
};

void check_neighbours(Differences& differences, const Eigen::SparseMatrix<double>& stiffness,
                      const VectorX& step) {
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  VectorX motion(step.size());
  for (Eigen::Index i = 0; i < step.size(); ++i) motion[i] = share(random) * step[i];
  const VectorX resistance = differences.resistance(motion);
  const double error = (stiffness * motion - resistance).norm();
  if (error > unexplained * resistance.norm())
    throw StateError(fmt::format(
        "tangent stiffness: {:.2g} of the forces of a small motion of all nodes are not those of "
        "the stiffness between neighbours; the forces jump, or act between nodes that are not "
        "neighbours",
        error / resistance.norm()));
}

}  // namespace

FreeComponents::FreeComponents(const ShellNodes& nodes)
    : index_(static_cast<std::size_t>(6 * nodes.count()), -1) {
  std::vector<double> mass;
  for (Eigen::Index n = 0; n < nodes.count(); ++n)
    for (int k = 0; k < 6; ++k) {
      const bool moves =
          k < 3 ? nodes.free_to_move(k, n) != 0.0 : nodes.free_to_turn(k - 3, n) != 0.0;
      if (!moves) continue;
      index_[static_cast<std::size_t>(6 * n + k)] = count();
      component_.push_back(6 * n + k);
      mass.push_back(k < 3 ? nodes.mass[n] : nodes.inertia[n]);
    }
  mass_ = Eigen::Map<VectorX>(mass.data(), count());
}

VectorX FreeComponents::forces(const ShellNodes& nodes) const {
  VectorX f(count());
  for (Eigen::Index i = 0; i < count(); ++i) {
    const Eigen::Index at = component_[static_cast<std::size_t>(i)];
    f[i] = at % 6 < 3 ? nodes.force(at % 6, at / 6) : nodes.moment(at % 6 - 3, at / 6);
  }
  return f;
}

void FreeComponents::move(const VectorX& by, ShellNodes& nodes) const {
  for (Eigen::Index n = 0; n < nodes.count(); ++n) {
    Vector3 turn = Vector3::Zero();
    for (int k = 0; k < 6; ++k) {
      const Eigen::Index i = index(n, k);
      if (i < 0) continue;
      if (k < 3)
        nodes.x(k, n) += by[i];
      else
        turn[k - 3] = by[i];
    }
    const double angle = turn.norm();
    if (angle > 0.0)
      nodes.set_rotation(n, Quaternion(Eigen::AngleAxisd(angle, turn / angle)) *
                                nodes.q[static_cast<std::size_t>(n)]);
  }
}

Matrix3X FreeComponents::displacements(const VectorX& values, Eigen::Index nodes) const {
  Matrix3X u = Matrix3X::Zero(3, nodes);
  for (Eigen::Index n = 0; n < nodes; ++n)
    for (int k = 0; k < 3; ++k)
      if (const Eigen::Index i = index(n, k); i >= 0) u(k, n) = values[i];
  return u;
}

NodeNeighbours neighbours_of(const std::vector<Shell4::Quad>& quads, Eigen::Index nodes) {
  NodeNeighbours neighbours(static_cast<std::size_t>(nodes));
  add_neighbours(quads, neighbours);
  return neighbours;
}

TangentStiffness tangent_stiffness(RelaxingStructure& structure, const FreeComponents& free,
                                   const NodeNeighbours& neighbours) {
  const ShellNodes& nodes = structure.nodes();
  const double length = std::sqrt(nodes.inertia.sum() / nodes.mass.sum());
  VectorX step(free.count());
  for (Eigen::Index n = 0; n < nodes.count(); ++n)
    for (int k = 0; k < 6; ++k)
      if (const Eigen::Index i = free.index(n, k); i >= 0)
        step[i] = difference * (k < 3 ? length : 1.0);

  Differences differences(structure, free);
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::vector<int>& group : independent_nodes(neighbours))
    for (int k = 0; k < 6; ++k) {
      VectorX motion = VectorX::Zero(free.count());
      for (const int node : group)
        if (const Eigen::Index i = free.index(node, k); i >= 0) motion[i] = step[i];
      if (motion.isZero(0.0)) continue;
      const VectorX resistance = differences.resistance(motion);
      for (const int node : group) {
        const Eigen::Index column = free.index(node, k);
        if (column < 0) continue;
        for (const int near : neighbours[static_cast<std::size_t>(node)])
          for (int c = 0; c < 6; ++c)
            if (const Eigen::Index row = free.index(near, c); row >= 0)
              entries.emplace_back(row, column, resistance[row] / step[column]);
      }
    }
  Eigen::SparseMatrix<double> raw(free.count(), free.count());
  raw.setFromTriplets(entries.begin(), entries.end());
  check_neighbours(differences, raw, step);

  TangentStiffness tangent;
  const Eigen::SparseMatrix<double> transpose = raw.transpose();
  tangent.matrix = 0.5 * (raw + transpose);
  const Eigen::SparseMatrix<double> skew = raw - transpose;
  tangent.asymmetry = skew.coeffs().cwiseAbs().maxCoeff() / raw.coeffs().cwiseAbs().maxCoeff();
  return tangent;
}

}  // namespace furrow
