// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_chain_energy.h"

#include <cmath>

namespace furrow {

SidewallChainEnergy::SidewallChainEnergy(const SidewallParameters& parameters)
    : parameters_(parameters),
      n_(static_cast<Eigen::Index>(parameters.segments())),
      L_(parameters.length / static_cast<double>(n_)) {
  check(parameters_);
}

double SidewallChainEnergy::bending(const VectorX& angles, double phi) const {
  const double rim = angles[0] - parameters_.rim_angle;
  const double tread = angles[n_ - 1] - parameters_.tread_angle - phi;
  double energy =
      0.5 * (parameters_.rim_stiffness * rim * rim + parameters_.tread_stiffness * tread * tread);
  for (Eigen::Index i = 0; i + 1 < n_; ++i) {
    const auto hinge = static_cast<std::size_t>(i);
    const double rotation = angles[i + 1] - angles[i] - parameters_.curvature[hinge] * L_;
    energy += 0.5 * parameters_.bending[hinge] / L_ * rotation * rotation;
  }
  return energy;
}

double SidewallChainEnergy::potential(const VectorX& angles, const SegmentDirections& directions,
                                      double phi, double pressure) const {
  double a = 0.0, r = 0.0, G = 0.0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double da = L_ * directions.cosine[i];
    const double dr = L_ * directions.sine[i];
    G += strip_area(a, r, a + da, r + dr);
    a += da;
    r += dr;
  }
  return bending(angles, phi) - pressure * G;
}

double SidewallChainEnergy::area(const VectorX& angles) const {
  double a = 0.0, r = 0.0, G = 0.0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double da = L_ * std::cos(angles[i]);
    const double dr = L_ * std::sin(angles[i]);
    G += strip_area(a, r, a + da, r + dr);
    a += da;
    r += dr;
  }
  return G - chord_area(a, r);
}

/// Part of G under one straight piece: the integral of (bead_width + taper r) a dr.
double SidewallChainEnergy::strip_area(double a0, double r0, double a1, double r1) const {
  return (r1 - r0) * (0.5 * parameters_.bead_width * (a0 + a1) +
                      parameters_.taper / 6.0 * (2.0 * (a0 * r0 + a1 * r1) + a0 * r1 + a1 * r0));
}

double SidewallChainEnergy::chord_area(double a, double r) const {
  return a * r * (0.5 * parameters_.bead_width + parameters_.taper * r / 3.0);
}

Eigen::Matrix2Xd SidewallChainEnergy::nodes(const VectorX& angles) const {
  Eigen::Matrix2Xd nodes(2, n_ + 1);
  nodes.col(0).setZero();
  for (Eigen::Index i = 0; i < n_; ++i)
    nodes.col(i + 1) = nodes.col(i) + L_ * Vector2(std::cos(angles[i]), std::sin(angles[i]));
  return nodes;
}

void SidewallChainEnergy::derivatives(const VectorX& angles, const SegmentDirections& directions,
                                      double phi, double pressure, VectorX& gradient,
                                      Eigen::MatrixXd& hessian) const {
  set_pressure_derivatives(directions, pressure, gradient, hessian);
  add_spring_derivatives(angles, phi, gradient, hessian);
}

/// -p times gradient and Hessian of G.
/// G is a sum over segments of g(x_i, x_(i+1)). Angle k moves the nodes beyond segment k by
/// t_k = L (-sin, cos), so with p_j the node's gradient, D_j its own second derivatives and C_m
/// those between nodes m and m + 1,
///   dG/dtheta_k = t_k . P_k,                          P_k = sum_(j>k) p_j
///   d2G/(dtheta_k dtheta_m) = t_k . (T_m + C_m) t_m   for k < m, T_m = sum over nodes and pairs
///                                                     beyond m
///   d2G/dtheta_k^2 = t_k . T_k t_k - L (cos, sin) . P_k.
void SidewallChainEnergy::set_pressure_derivatives(const SegmentDirections& directions,
                                                   double pressure, VectorX& gradient,
                                                   Eigen::MatrixXd& hessian) const {
  const VectorX& cosine = directions.cosine;
  const VectorX& sine = directions.sine;
  const double L = L_;
  const double w0 = 0.5 * parameters_.bead_width;
  const double w1 = parameters_.taper / 6.0;
  double a1 = 0.0, r1 = 0.0;
  for (Eigen::Index k = 0; k < n_; ++k) {
    a1 += L * cosine[k];
    r1 += L * sine[k];
  }
  Vector2 P = Vector2::Zero();  // from the last segment back to the first
  double T_ar = 0.0, T_rr = 0.0;
  for (Eigen::Index m = n_ - 1; m >= 0; --m) {
    const double c = cosine[m], s = sine[m];
    const double a0 = a1 - L * c, r0 = r1 - L * s;
    // Segment m's share of the gradient at its far node, and of the second derivatives there
    P += Vector2(w0 * (r1 - r0) + w1 * (2.0 * r1 * r1 - r0 * r1 - r0 * r0),
                 w0 * (a0 + a1) + w1 * (a0 * (r0 + 2.0 * r1) + a1 * (4.0 * r1 - r0)));
    T_ar += w0 + w1 * (4.0 * r1 - r0);
    T_rr += w1 * (2.0 * a0 + 4.0 * a1);
    const double C_ar = w0 + w1 * (r0 + 2.0 * r1);
    const double C_ra = -w0 - w1 * (r1 + 2.0 * r0);
    const double C_rr = w1 * (a0 - a1);
    gradient[m] = -pressure * L * (c * P[1] - s * P[0]);
    hessian(m, m) =
        -pressure * (L * L * (c * c * T_rr - 2.0 * s * c * T_ar) - L * (c * P[0] + s * P[1]));
    // (T + C) t_m
    const double y_a = L * c * (T_ar + C_ar);
    const double y_r = L * (-s * (T_ar + C_ra) + c * (T_rr + C_rr));
    for (Eigen::Index k = 0; k < m; ++k)
      hessian(k, m) = hessian(m, k) = -pressure * L * (cosine[k] * y_r - sine[k] * y_a);
    // Segment m's share at its near node, and in the second derivatives between both nodes
    P += Vector2(w0 * (r1 - r0) + w1 * (r0 * r1 + r1 * r1 - 2.0 * r0 * r0),
                 -w0 * (a0 + a1) + w1 * (a0 * (r1 - 4.0 * r0) - a1 * (r1 + 2.0 * r0)));
    T_ar += -w0 + w1 * (r1 - 4.0 * r0) + C_ar + C_ra;
    T_rr += -w1 * (4.0 * a0 + 2.0 * a1) + 2.0 * C_rr;
    a1 = a0;
    r1 = r0;
  }
}

void SidewallChainEnergy::add_spring_derivatives(const VectorX& angles, double phi,
                                                 VectorX& gradient,
                                                 Eigen::MatrixXd& hessian) const {
  for (Eigen::Index i = 0; i + 1 < n_; ++i) {
    const auto hinge = static_cast<std::size_t>(i);
    const double stiffness = parameters_.bending[hinge] / L_;
    const double moment =
        stiffness * (angles[i + 1] - angles[i] - parameters_.curvature[hinge] * L_);
    gradient[i] -= moment;
    gradient[i + 1] += moment;
    hessian(i, i) += stiffness;
    hessian(i + 1, i + 1) += stiffness;
    hessian(i, i + 1) -= stiffness;
    hessian(i + 1, i) -= stiffness;
  }
  gradient[0] += parameters_.rim_stiffness * (angles[0] - parameters_.rim_angle);
  gradient[n_ - 1] +=
      parameters_.tread_stiffness * (angles[n_ - 1] - parameters_.tread_angle - phi);
  hessian(0, 0) += parameters_.rim_stiffness;
  hessian(n_ - 1, n_ - 1) += parameters_.tread_stiffness;
}

}  // namespace furrow
