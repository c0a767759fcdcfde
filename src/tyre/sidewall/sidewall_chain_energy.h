// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The potential of a chain of segments under follower pressure, at any angles, with its
/// derivatives.

#include "furrow/tyre/tyre_parameters.h"

namespace furrow {

/// Unit vectors (cosine, sine) of the N segments along a and r.
struct SegmentDirections {
  VectorX cosine;
  VectorX sine;
};

/// Functions of the angles theta of the N segments [rad], which need not be in equilibrium:
///   Phi = E(theta, phi) - p G(theta),  E the bending energy     (theory: tyres, eq. 3)
///   G = integral of omega(r) a dr along the chain
/// The pressure's nodal forces are the gradient of p G at the inner nodes: for an even strip p/2
/// times the live normals of the two segments. The chord's own part of G is
///   g = a r (bead_width/2 + taper r/3).
class SidewallChainEnergy {
 public:
  /// @throws InputError for parameters that check() refuses
  explicit SidewallChainEnergy(const SidewallParameters& parameters);

  const SidewallParameters& parameters() const { return parameters_; }
  Eigen::Index segments() const { return n_; }
  double segment_length() const { return L_; }  ///< L [m]

  double bending(const VectorX& angles, double phi) const;  ///< E [J/m]
  /// Potential Phi [J/m]. @param directions of the angles
  double potential(const VectorX& angles, const SegmentDirections& directions, double phi,
                   double pressure) const;
  /// dPhi/dtheta [J/m] and d2Phi/dtheta2 [J/m].
  /// @param gradient N numbers, set @param hessian N x N, set
  void derivatives(const VectorX& angles, const SegmentDirections& directions, double phi,
                   double pressure, VectorX& gradient, Eigen::MatrixXd& hessian) const;
  /// S = G - g [m^2] between chain and chord, weighted by omega; positive where the chain bulges
  /// outwards.
  double area(const VectorX& angles) const;
  double chord_area(double a, double r) const;  ///< g [m^2]
  /// Positions of the chain's N + 1 nodes, one column each, from (0, 0) on [m].
  Eigen::Matrix2Xd nodes(const VectorX& angles) const;

 private:
  double strip_area(double a0, double r0, double a1, double r1) const;
  void set_pressure_derivatives(const SegmentDirections& directions, double pressure,
                                VectorX& gradient, Eigen::MatrixXd& hessian) const;
  void add_spring_derivatives(const VectorX& angles, double phi, VectorX& gradient,
                              Eigen::MatrixXd& hessian) const;

  SidewallParameters parameters_;
  Eigen::Index n_;
  double L_;
};

}  // namespace furrow
