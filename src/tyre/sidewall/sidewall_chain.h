// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The equilibrium of a sidewall: a planar chain of inextensible segments with bending springs
/// under follower pressure.

#include "furrow/tyre/sidewall/null_space.h"
#include "furrow/tyre/sidewall/sidewall.h"
#include "furrow/tyre/sidewall/sidewall_chain_energy.h"

namespace furrow {

/// Finds the angles of the N segments that minimise Phi (sidewall_chain_energy.h) among chains that
/// end at (a, r). W = Phi + p g, so S = G - g.
///
/// Newton's method on the manifold of chains that end at (a, r): steps along its tangent plane
/// (null_space.h), modified Cholesky of the reduced Hessian, line search on Phi, and a step limit.
/// A search therefore descends and never crosses a ridge. The solution is a stable equilibrium: a
/// reduced Hessian that is not positive definite is an error. The branch is that of the circular
/// arc, the equilibrium without bending stiffness.
///
/// An object holds its working space: use one per thread.
class SidewallChain {
 public:
  /// @throws InputError for parameters that check() refuses
  explicit SidewallChain(const SidewallParameters& parameters);

  const SidewallParameters& parameters() const { return energy_.parameters(); }
  const SidewallChainEnergy& energy() const { return energy_; }

  /// Equilibrium at an end.
  /// @param pressure >= 0 [Pa]
  /// @param angles [rad] in: the start, such as a solution nearby, or empty for the arc; out: the
  /// solution. If the start does not lead to a chain like the arc, the search begins again from the
  /// arc
  /// @throws StateError: an end that is not finite, beyond the length, or at the bead; no stable
  /// equilibrium found
  SidewallResponse solve(const SidewallEnd& end, double pressure, VectorX& angles,
                         bool with_stiffness = true);

  /// The inscribed arc that bulges outwards. @throws StateError as solve
  void arc(const SidewallEnd& end, VectorX& angles);

  /// Equilibrium in detail at an end. @throws StateError as solve
  SidewallShape shape(const SidewallEnd& end, double pressure);

 private:
  void check_end(const SidewallEnd& end, double pressure) const;
  bool resembles_arc(const SidewallEnd& end, const VectorX& angles) const;
  bool restore_end(const SidewallEnd& end, VectorX& angles);
  void linearise(const VectorX& angles, double phi, double pressure);
  double potential(const VectorX& angles, double phi, double pressure) const {
    return energy_.potential(angles, directions_, phi, pressure);
  }
  double force_scale(double pressure) const;
  void find_step(double scale);
  bool search_line(const SidewallEnd& end, double pressure, VectorX& angles);
  bool descend(const SidewallEnd& end, double pressure, VectorX& angles);
  Matrix3 stiffness(const SidewallEnd& end, double pressure);

  SidewallChainEnergy energy_;
  Eigen::Index n_;

  // Working space of one linearisation
  SegmentDirections directions_;
  NullSpace axes_;
  VectorX gradient_;         // dPhi/dtheta, in the axes
  Eigen::MatrixXd hessian_;  // of the Lagrangian, in the axes
  Vector2 multiplier_;       // dPhi/d(a, r)
  VectorX step_;
  VectorX trial_;
};

}  // namespace furrow
