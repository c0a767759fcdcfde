// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Tangent stiffness of a shell structure about its present state, by differences of its forces.

#include <set>
#include <vector>

#include <Eigen/SparseCore>

#include "furrow/shell/dynamic_relaxation.h"
#include "furrow/shell/shell4.h"

namespace furrow {

/// The components of nodes that can move: x, y, z and turns about them, node by node, numbered
/// without those that are held.
class FreeComponents {
 public:
  explicit FreeComponents(const ShellNodes& nodes);

  Eigen::Index count() const { return static_cast<Eigen::Index>(component_.size()); }
  /// @param k 0 to 2: place, 3 to 5: turn @returns -1 where it is held
  Eigen::Index index(Eigen::Index node, int k) const {
    return index_[static_cast<std::size_t>(6 * node + k)];
  }
  /// Mass [kg] or inertia [kg m^2] of each component.
  const VectorX& mass() const { return mass_; }
  /// Force [N] or moment [N m] on each component.
  VectorX forces(const ShellNodes& nodes) const;
  /// Moves places by a value [m] and turns by a vector of rotation [rad].
  void move(const VectorX& by, ShellNodes& nodes) const;
  /// The displacement part, zero where nodes are held.
  Matrix3X displacements(const VectorX& values, Eigen::Index nodes) const;

 private:
  std::vector<Eigen::Index> component_;  // 6 node + k of each
  std::vector<Eigen::Index> index_;      // of 6 node + k
  VectorX mass_;
};

/// Nodes whose forces change when a node moves, itself included, for each node.
using NodeNeighbours = std::vector<std::set<int>>;

/// Adds nodes that share an element. @tparam Element indices of its nodes
template <class Element>
void add_neighbours(const std::vector<Element>& elements, NodeNeighbours& neighbours) {
  for (const Element& element : elements)
    for (const int node : element)
      neighbours[static_cast<std::size_t>(node)].insert(element.begin(), element.end());
}

/// Neighbours of the nodes in a structure of shells alone.
NodeNeighbours neighbours_of(const std::vector<Shell4::Quad>& quads, Eigen::Index nodes);

/// K = -df/du [N/m, N, N m] about the present state.
struct TangentStiffness {
  Eigen::SparseMatrix<double> matrix;  ///< symmetric: the mean of K and its transpose
  /// largest entry of K - K^T over the largest of K. If the forces have a potential, it measures
  /// the unbalanced moments and the error of the differences.
  double asymmetry = 0.0;
};

/// Tangent stiffness by central differences. Nodes without a common neighbour move together (A. R.
/// Curtis, M. J. D. Powell, J. K. Reid, J. Inst. Maths Applics 13, 117), so the number of force
/// evaluations does not depend on the mesh. A motion of all nodes at once checks the neighbours.
/// The nodes return to their places.
/// @throws StateError when forces depend on nodes that are not neighbours, and as compute_forces()
TangentStiffness tangent_stiffness(RelaxingStructure& structure, const FreeComponents& free,
                                   const NodeNeighbours& neighbours);

}  // namespace furrow
