// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The equilibrium of a sidewall: a planar chain of inextensible segments with bending springs
/// under follower pressure.

#include "tyre/sidewall.h"
#include "tyre/tyre_parameters.h"

namespace furrow {

/// Finds the angles theta of the N segments that make  Phi = E(theta, phi) - p G(theta)  least
/// among chains to (a, r):
///   E = 1/2 sum EI/L (theta_(i+1) - theta_i - kappa_0 L)^2 + 1/2 k_rim (theta_1 - theta_rim)^2
///       + 1/2 k_tread (theta_N - theta_tread - phi)^2,    G = integral of omega(r) a dr along the
///       chain.
/// The pressure's nodal forces are the gradient of p G at the inner nodes: for an even strip p/2
/// times the live normals of the two segments. W = Phi + p g with the chord's own  g = a r
/// (bead_width/2 + taper r/3), so S = G - g.
///
/// Newton's method on the manifold of chains that end at (a, r): steps along its tangent plane (a
/// 2-column QR of the constraint's gradient), modified Cholesky of the reduced Hessian, line search
/// on Phi, and a step limit, so that a search goes downhill and never jumps over a ridge. What it
/// ends at is a stable equilibrium: the reduced Hessian is positive definite there, or it is
/// refused. The branch is the one that the circular arc relaxes to: the arc is the equilibrium
/// without bending stiffness. An object is its own working space: one for each thread.
class SidewallChain {
 public:
  /// @throws InputError for parameters that check() refuses
  explicit SidewallChain(const SidewallParameters& parameters);

  const SidewallParameters& parameters() const { return parameters_; }

  /// Equilibrium at an end.
  /// @param pressure >= 0 [Pa]
  /// @param angles [rad] in: where to start from, such as the solution nearby, or empty for the
  /// arc; out: the solution. Where a start
  ///        does not lead to a chain like the arc, the arc is taken
  /// @throws StateError: an end that is not finite, beyond the length, or at the bead; no stable
  /// equilibrium found
  SidewallResponse solve(const SidewallEnd& end, double pressure, VectorX& angles,
                         bool with_stiffness = true);

  /// The inscribed arc that bulges outwards. @throws StateError as solve
  void arc(const SidewallEnd& end, VectorX& angles);

  /// All that the chain tells at an end. @throws StateError as solve
  SidewallShape shape(const SidewallEnd& end, double pressure);

  // Of any angles, in equilibrium or not.
  /// from (0, 0); N + 1 columns [m]
  void nodes(const VectorX& angles, Eigen::Matrix2Xd& nodes) const;
  double bending_energy(const VectorX& angles, double phi) const;  ///< E [J/m]
  /// S between chain and chord, weighted by omega [m^2]
  double area(const VectorX& angles) const;
  /// rim spring, N - 1 hinges, tread spring [N m/m]
  VectorX moments(const VectorX& angles, double phi) const;
  int iterations() const { return iterations_; }  ///< of the last solve

 private:
  double segment() const { return parameters_.length / static_cast<double>(n_); }
  void check_end(const SidewallEnd& end, double pressure) const;
  bool descend(const SidewallEnd& end, double pressure, VectorX& angles);
  double strip(double a0, double r0, double a1, double r1) const;
  double chord_share(double a, double r) const;
  double functional(const VectorX& angles, double phi, double pressure) const;
  void add_pressure(double pressure);
  void linearise(const VectorX& angles, double phi, double pressure);
  bool resembles_arc(const SidewallEnd& end, const VectorX& angles) const;
  bool restore_end(const SidewallEnd& end, VectorX& angles);
  bool factorise(double shift);
  void reflect(VectorX& vector, bool transpose) const;
  void substitute(VectorX& reduced) const;

  SidewallParameters parameters_;
  Eigen::Index n_;
  int iterations_ = 0;

  // Working space of one linearisation
  VectorX cosine_, sine_;
  VectorX gradient_;  // dPhi/dtheta
  // of the Lagrangian, in the axes of the QR; Cholesky factor of its free part
  Eigen::MatrixXd hessian_, factor_;
  VectorX reflector_[2];      // Q = P0 P1, P = I - 2 v v^T
  Eigen::Matrix2d triangle_;  // J^T = Q [triangle; 0]
  Vector2 multiplier_;        // dPhi/d(a, r)
  VectorX step_, trial_, work_;
};

}  // namespace furrow
