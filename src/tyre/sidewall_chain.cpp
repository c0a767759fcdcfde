// SPDX-License-Identifier: GPL-2.0-or-later
#include "tyre/sidewall_chain.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

constexpr int max_iterations = 200;
constexpr double step_limit = 0.3;            // [rad] of any segment in one step
constexpr double gradient_tolerance = 1e-12;  // of the largest forces times lengths
// of the functional's terms: a difference below is none
constexpr double rounding = 1e-13;
// [rad] of any segment: a warm start that ends farther away is not trusted
constexpr double farthest_from_arc = 1.2;
constexpr double shortest_chord = 0.02;  // of the length

}  // namespace

SidewallChain::SidewallChain(const SidewallParameters& parameters)
    : parameters_(parameters), n_(static_cast<Eigen::Index>(parameters.segments())) {
  check(parameters_);
  hessian_.resize(n_, n_);
  factor_.resize(n_ - 2, n_ - 2);
  for (VectorX* vector :
       {&cosine_, &sine_, &gradient_, &reflector_[0], &reflector_[1], &step_, &trial_, &work_})
    vector->setZero(n_);
}

void SidewallChain::check_end(const SidewallEnd& end, double pressure) const {
  if (!std::isfinite(end.a) || !std::isfinite(end.r) || !std::isfinite(end.phi))
    throw StateError(fmt::format("sidewall: its tread end is at a = {} m, r = {} m, phi = {} rad",
                                 end.a, end.r, end.phi));
  if (!(pressure >= 0.0) || !std::isfinite(pressure))
    throw StateError(fmt::format("sidewall: the pressure is {} Pa; it must be >= 0", pressure));
  const double chord = std::hypot(end.a, end.r), length = parameters_.length;
  if (chord >= length * (1.0 - 1e-9))
    throw StateError(fmt::format(
        "sidewall: stretched past its length: its ends (a = {:.6g} m, r = {:.6g} m) are {:.6g} m "
        "apart, its length is {:.6g} m",
        end.a, end.r, chord, length));
  if (chord < shortest_chord * length)
    throw StateError(fmt::format(
        "sidewall: the tread edge lies on the bead: they are {:.3g} m apart (a = {:.3g} m, r = "
        "{:.3g} m)",
        chord, end.a, end.r));
}

void SidewallChain::arc(const SidewallEnd& end, VectorX& angles) {
  check_end(end, 0.0);
  // N chords of a circle, each turned by 2 alpha/N from the one before: chord/length =
  // sin(alpha)/(N sin(alpha/N)), falling in alpha.
  const double n = static_cast<double>(n_), share = std::hypot(end.a, end.r) / parameters_.length;
  double lower = 0.0, upper = pi;
  for (int i = 0; i < 60; ++i) {
    const double alpha = 0.5 * (lower + upper);
    (std::sin(alpha) > share * n * std::sin(alpha / n) ? lower : upper) = alpha;
  }
  const double direction = std::atan2(end.r, end.a), turn = (lower + upper) / n;
  angles.resize(n_);
  for (Eigen::Index i = 0; i < n_; ++i)
    angles[i] = direction + (static_cast<double>(i) - 0.5 * (n - 1.0)) * turn;
  restore_end(end, angles);
}

/// A chain with a curl in it, or bent the other way, has angles far from the arc's.
bool SidewallChain::resembles_arc(const SidewallEnd& end, const VectorX& angles) const {
  const double n = static_cast<double>(n_), direction = std::atan2(end.r, end.a);
  // Half the angle of the arc, sin(alpha)/alpha = chord/length, within 0.05
  const double uu = 1.0 - std::hypot(end.a, end.r) / parameters_.length;
  const double alpha = std::sqrt(6.0 * uu) * (1.0 + 0.15 * uu + 0.1325 * uu * uu),
               turn = 2.0 * alpha / n;
  for (Eigen::Index i = 0; i < n_; ++i)
    if (std::abs(angles[i] - direction - (static_cast<double>(i) - 0.5 * (n - 1.0)) * turn) >
        farthest_from_arc)
      return false;
  return true;
}

double SidewallChain::bending_energy(const VectorX& angles, double phi) const {
  const double L = segment(), rim = angles[0] - parameters_.rim_angle,
               tread = angles[n_ - 1] - parameters_.tread_angle - phi;
  double energy =
      0.5 * (parameters_.rim_stiffness * rim * rim + parameters_.tread_stiffness * tread * tread);
  for (Eigen::Index i = 0; i + 1 < n_; ++i) {
    const auto hinge = static_cast<std::size_t>(i);
    const double bend = angles[i + 1] - angles[i] - parameters_.curvature[hinge] * L;
    energy += 0.5 * parameters_.bending[hinge] / L * bend * bend;
  }
  return energy;
}

VectorX SidewallChain::moments(const VectorX& angles, double phi) const {
  const double L = segment();
  VectorX moments(n_ + 1);
  moments[0] = parameters_.rim_stiffness * (angles[0] - parameters_.rim_angle);
  moments[n_] = -parameters_.tread_stiffness * (angles[n_ - 1] - parameters_.tread_angle - phi);
  for (Eigen::Index i = 0; i + 1 < n_; ++i) {
    const auto hinge = static_cast<std::size_t>(i);
    moments[i + 1] = parameters_.bending[hinge] *
                     ((angles[i + 1] - angles[i]) / L - parameters_.curvature[hinge]);
  }
  return moments;
}

void SidewallChain::nodes(const VectorX& angles, Eigen::Matrix2Xd& nodes) const {
  nodes.resize(2, n_ + 1);
  nodes.col(0).setZero();
  for (Eigen::Index i = 0; i < n_; ++i)
    nodes.col(i + 1) = nodes.col(i) + segment() * Vector2(std::cos(angles[i]), std::sin(angles[i]));
}

/// Positive where the chain bulges outwards.
double SidewallChain::area(const VectorX& angles) const {
  const double L = segment();
  double a = 0.0, r = 0.0, G = 0.0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double da = L * std::cos(angles[i]), dr = L * std::sin(angles[i]);
    G += strip(a, r, a + da, r + dr);
    a += da;
    r += dr;
  }
  return G - chord_share(a, r);
}

/// Part of G under one straight piece: the integral of (omega_0 + taper r) a dr.
double SidewallChain::strip(double a0, double r0, double a1, double r1) const {
  return (r1 - r0) * (0.5 * parameters_.bead_width * (a0 + a1) +
                      parameters_.taper / 6.0 * (2.0 * (a0 * r0 + a1 * r1) + a0 * r1 + a1 * r0));
}

/// g = G of the chord.
double SidewallChain::chord_share(double a, double r) const {
  return a * r * (0.5 * parameters_.bead_width + parameters_.taper * r / 3.0);
}

/// Phi = E - p G. Uses the cosines and sines of the angles.
double SidewallChain::functional(const VectorX& angles, double phi, double pressure) const {
  const double L = segment();
  double a = 0.0, r = 0.0, G = 0.0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double da = L * cosine_[i], dr = L * sine_[i];
    G += strip(a, r, a + da, r + dr);
    a += da;
    r += dr;
  }
  return bending_energy(angles, phi) - pressure * G;
}

/// Newton's method with the shortest step; few and small where the angles nearly fit. False when it
/// does not end. Leaves the cosines and sines of the angles.
bool SidewallChain::restore_end(const SidewallEnd& end, VectorX& angles) {
  const double L = segment();
  for (int i = 0; i < 20; ++i) {
    double a = 0.0, r = 0.0, ss = 0.0, cc = 0.0, sc = 0.0;
    for (Eigen::Index k = 0; k < n_; ++k) {
      const double c = std::cos(angles[k]), s = std::sin(angles[k]);
      a += c, r += s, ss += s * s, cc += c * c, sc += s * c;
      cosine_[k] = c, sine_[k] = s;
    }
    const Vector2 gap(end.a / L - a, end.r / L - r);
    if (gap.norm() < 1e-14 * static_cast<double>(n_)) return true;
    // J = L (-s; c), J J^T = L^2 (ss, -sc; -sc, cc)
    const double determinant = ss * cc - sc * sc;
    if (!(determinant > 1e-20)) return false;
    const Vector2 y((cc * gap[0] + sc * gap[1]) / determinant,
                    (sc * gap[0] + ss * gap[1]) / determinant);
    double largest = 0.0;
    for (Eigen::Index k = 0; k < n_; ++k) {
      const double change = -sine_[k] * y[0] + cosine_[k] * y[1];
      angles[k] += change;
      largest = std::max(largest, std::abs(change));
    }
    if (!(largest < 1.0)) return false;
  }
  return false;
}

/// -p times gradient and Hessian of G with respect to the angles; sets gradient_ and hessian_.
/// G is a sum over segments of g(x_i, x_(i+1)). Angle k moves the nodes beyond segment k by t_k = L
/// (-sin, cos), so with p_j the node's gradient, D_j its own second derivatives and C_m those
/// between nodes m and m + 1,
///   dG/dtheta_k = t_k . P_k,  P_k = sum_(j>k) p_j;   d2G/(dtheta_k dtheta_m) = t_k . (T_m + C_m)
///   t_m for k < m, T_m = sum over nodes and pairs beyond m;         d2G/dtheta_k^2 = t_k . T_k t_k
///   - L (cos, sin) . P_k.
void SidewallChain::add_pressure(double pressure) {
  const double L = segment(), w0 = 0.5 * parameters_.bead_width, w1 = parameters_.taper / 6.0;
  double a1 = 0.0, r1 = 0.0;
  for (Eigen::Index k = 0; k < n_; ++k) a1 += L * cosine_[k], r1 += L * sine_[k];
  Vector2 P = Vector2::Zero();  // from the last segment back to the first
  double T_ar = 0.0, T_rr = 0.0;
  for (Eigen::Index m = n_ - 1; m >= 0; --m) {
    const double c = cosine_[m], s = sine_[m], a0 = a1 - L * c, r0 = r1 - L * s;
    // Segment m's share of the gradient at its far node, and of the second derivatives there
    P += Vector2(w0 * (r1 - r0) + w1 * (2.0 * r1 * r1 - r0 * r1 - r0 * r0),
                 w0 * (a0 + a1) + w1 * (a0 * (r0 + 2.0 * r1) + a1 * (4.0 * r1 - r0)));
    T_ar += w0 + w1 * (4.0 * r1 - r0);
    T_rr += w1 * (2.0 * a0 + 4.0 * a1);
    const double C_ar = w0 + w1 * (r0 + 2.0 * r1), C_ra = -w0 - w1 * (r1 + 2.0 * r0),
                 C_rr = w1 * (a0 - a1);
    gradient_[m] = -pressure * L * (c * P[1] - s * P[0]);
    hessian_(m, m) =
        -pressure * (L * L * (c * c * T_rr - 2.0 * s * c * T_ar) - L * (c * P[0] + s * P[1]));
    // (T + C) t_m
    const double y_a = L * c * (T_ar + C_ar), y_r = L * (-s * (T_ar + C_ra) + c * (T_rr + C_rr));
    for (Eigen::Index k = 0; k < m; ++k)
      hessian_(k, m) = hessian_(m, k) = -pressure * L * (cosine_[k] * y_r - sine_[k] * y_a);
    // ... at its near node, and between both
    P += Vector2(w0 * (r1 - r0) + w1 * (r0 * r1 + r1 * r1 - 2.0 * r0 * r0),
                 -w0 * (a0 + a1) + w1 * (a0 * (r1 - 4.0 * r0) - a1 * (r1 + 2.0 * r0)));
    T_ar += -w0 + w1 * (r1 - 4.0 * r0) + C_ar + C_ra;
    T_rr += -w1 * (4.0 * a0 + 2.0 * a1) + 2.0 * C_rr;
    a1 = a0, r1 = r0;
  }
}

/// Gradient, QR of the constraint, multiplier, and the Lagrangian's Hessian in the axes of the QR.
/// Uses the cosines and sines.
void SidewallChain::linearise(const VectorX& angles, double phi, double pressure) {
  const double L = segment();
  add_pressure(pressure);
  for (Eigen::Index i = 0; i + 1 < n_; ++i) {
    const auto hinge = static_cast<std::size_t>(i);
    const double stiffness = parameters_.bending[hinge] / L;
    const double moment =
        stiffness * (angles[i + 1] - angles[i] - parameters_.curvature[hinge] * L);
    gradient_[i] -= moment;
    gradient_[i + 1] += moment;
    hessian_(i, i) += stiffness;
    hessian_(i + 1, i + 1) += stiffness;
    hessian_(i, i + 1) -= stiffness;
    hessian_(i + 1, i) -= stiffness;
  }
  gradient_[0] += parameters_.rim_stiffness * (angles[0] - parameters_.rim_angle);
  gradient_[n_ - 1] +=
      parameters_.tread_stiffness * (angles[n_ - 1] - parameters_.tread_angle - phi);
  hessian_(0, 0) += parameters_.rim_stiffness;
  hessian_(n_ - 1, n_ - 1) += parameters_.tread_stiffness;

  // Householder's QR of J^T = L (-sin, cos)
  VectorX &first = reflector_[0], &second = reflector_[1];
  for (Eigen::Index k = 0; k < n_; ++k) first[k] = -L * sine_[k], second[k] = L * cosine_[k];
  triangle_.setZero();
  triangle_(0, 0) = first[0] > 0.0 ? -first.norm() : first.norm();
  first[0] -= triangle_(0, 0);
  first /= first.norm();
  second -= 2.0 * first.dot(second) * first;
  triangle_(0, 1) = second[0];
  second[0] = 0.0;
  triangle_(1, 1) = second[1] > 0.0 ? -second.norm() : second.norm();
  second[1] -= triangle_(1, 1);
  second /= second.norm();

  // Least-squares multiplier: exact in equilibrium
  reflect(gradient_, true);
  multiplier_[1] = gradient_[1] / triangle_(1, 1);
  multiplier_[0] = (gradient_[0] - triangle_(0, 1) * multiplier_[1]) / triangle_(0, 0);
  for (Eigen::Index k = 0; k < n_; ++k)
    hessian_(k, k) += L * (multiplier_[0] * cosine_[k] + multiplier_[1] * sine_[k]);

  // Q^T H Q, with P H P = H - 2 (v w^T + w v^T) + 4 (v.w) v v^T, w = H v
  for (const VectorX& v : reflector_) {
    work_.noalias() = hessian_ * v;
    const double vw = v.dot(work_);
    for (Eigen::Index m = 0; m < n_; ++m) {
      const double a = 4.0 * vw * v[m] - 2.0 * work_[m], b = -2.0 * v[m];
      for (Eigen::Index k = 0; k < n_; ++k) hessian_(k, m) += a * v[k] + b * work_[k];
    }
  }
}

/// Q x, or its transpose: Q = P0 P1.
void SidewallChain::reflect(VectorX& vector, bool transpose) const {
  for (const int i : {transpose ? 0 : 1, transpose ? 1 : 0})
    vector -= 2.0 * reflector_[i].dot(vector) * reflector_[i];
}

/// Cholesky of the Hessian's free part plus a shift. False when it is not positive definite.
bool SidewallChain::factorise(double shift) {
  const Eigen::Index m = n_ - 2;
  for (Eigen::Index j = 0; j < m; ++j) {
    double pivot = hessian_(j + 2, j + 2) + shift;
    for (Eigen::Index k = 0; k < j; ++k) pivot -= factor_(j, k) * factor_(j, k);
    if (!(pivot > 0.0)) return false;
    factor_(j, j) = std::sqrt(pivot);
    for (Eigen::Index i = j + 1; i < m; ++i) {
      double sum = hessian_(i + 2, j + 2);
      for (Eigen::Index k = 0; k < j; ++k) sum -= factor_(i, k) * factor_(j, k);
      factor_(i, j) = sum / factor_(j, j);
    }
  }
  return true;
}

/// Solves with the factor, in place, the entries 2 ... N - 1 of a vector in the axes of the QR.
void SidewallChain::substitute(VectorX& reduced) const {
  const Eigen::Index m = n_ - 2;
  for (Eigen::Index i = 0; i < m; ++i) {
    double sum = reduced[i + 2];
    for (Eigen::Index k = 0; k < i; ++k) sum -= factor_(i, k) * reduced[k + 2];
    reduced[i + 2] = sum / factor_(i, i);
  }
  for (Eigen::Index i = m - 1; i >= 0; --i) {
    double sum = reduced[i + 2];
    for (Eigen::Index k = i + 1; k < m; ++k) sum -= factor_(k, i) * reduced[k + 2];
    reduced[i + 2] = sum / factor_(i, i);
  }
}

/// Downhill to the nearest stable equilibrium; the last linearisation is the one there. False when
/// there is none.
bool SidewallChain::descend(const SidewallEnd& end, double pressure, VectorX& angles) {
  const double L = segment(), l = parameters_.length;
  const double hinge =
      *std::max_element(parameters_.bending.begin(), parameters_.bending.end()) / L;
  for (iterations_ = 0; iterations_ < max_iterations; ++iterations_) {
    linearise(angles, end.phi, pressure);
    const double scale = L * (multiplier_.norm() + pressure * l) + hinge +
                         std::max(parameters_.rim_stiffness, parameters_.tread_stiffness);
    const double residual = gradient_.tail(n_ - 2).lpNorm<Eigen::Infinity>();
    if (!std::isfinite(residual)) return false;
    if (residual <= gradient_tolerance * scale) return factorise(0.0);

    for (double shift = 0.0; !factorise(shift); shift = std::max(4.0 * shift, 1e-3 * scale)) {
    }
    step_ = -gradient_;
    step_.head(2).setZero();
    substitute(step_);
    const double slope = step_.tail(n_ - 2).dot(gradient_.tail(n_ - 2));
    reflect(step_, false);
    double length = std::min(1.0, step_limit / step_.lpNorm<Eigen::Infinity>());
    const double start = functional(angles, end.phi, pressure);
    const double slack = rounding * (std::abs(start) + (pressure * l + multiplier_.norm()) * l);
    for (;; length *= 0.5) {
      if (length < 1e-8) return false;
      trial_ = angles + length * step_;
      if (restore_end(end, trial_) &&
          functional(trial_, end.phi, pressure) <= start + 1e-4 * length * slope + slack)
        break;
    }
    angles = trial_;
  }
  return false;
}

SidewallResponse SidewallChain::solve(const SidewallEnd& end, double pressure, VectorX& angles,
                                      bool with_stiffness) {
  check_end(end, pressure);
  bool found = angles.size() == n_ && angles.allFinite() && restore_end(end, angles) &&
               descend(end, pressure, angles) && resembles_arc(end, angles);
  if (!found) {
    arc(end, angles);
    found = descend(end, pressure, angles);
  }
  if (!found)
    throw StateError(
        fmt::format("sidewall: no stable equilibrium at a = {:.6g} m, r = {:.6g} m, phi = {:.6g} "
                    "rad and {:.6g} Pa",
                    end.a, end.r, end.phi, pressure));

  SidewallResponse response;
  const double k_tread = parameters_.tread_stiffness, a = end.a, r = end.r;
  const double omega = parameters_.bead_width + parameters_.taper * r;
  // of the chord's pressure, at the tread
  const double share = 0.5 * parameters_.bead_width + parameters_.taper * r / 3.0;
  response.on_tread = {-multiplier_[0], -multiplier_[1] - pressure * a * omega,
                       k_tread * (angles[n_ - 1] - parameters_.tread_angle - end.phi)};
  response.force = response.on_tread - pressure * share * Vector3(r, -a, 0.0);
  response.potential = functional(angles, end.phi, pressure) + pressure * chord_share(a, r);
  if (!with_stiffness) return response;

  // Linearised equilibrium, in the axes of the QR: H (y, z) + e dphi = (triangle dlambda, 0) with
  // triangle^T y = d(a, r).
  VectorX &e = step_, &change = trial_;
  e.setZero();
  e[n_ - 1] = -k_tread;  // d2E/(dtheta_N dphi)
  reflect(e, true);
  const auto upper = triangle_.triangularView<Eigen::Upper>();
  for (int j = 0; j < 3; ++j) {
    Vector2 y = Vector2::Zero();
    if (j < 2) y = triangle_.transpose().triangularView<Eigen::Lower>().solve(Vector2::Unit(j));
    const double dphi = j == 2 ? 1.0 : 0.0;
    change = -dphi * e - y[0] * hessian_.col(0) - y[1] * hessian_.col(1);
    substitute(change);
    change.head(2) = y;
    const Vector2 force(hessian_.col(0).dot(change) + dphi * e[0],
                        hessian_.col(1).dot(change) + dphi * e[1]);
    response.stiffness.col(j).head(2) = upper.solve(force);
    response.stiffness(2, j) = e.dot(change) + dphi * k_tread;
  }
  response.stiffness(1, 0) += pressure * omega;
  response.stiffness(1, 1) += pressure * a * parameters_.taper;
  return response;
}

/// On the rim acts what moving the whole chain costs: p times the change of G, less what acts on
/// the tread.
SidewallShape SidewallChain::shape(const SidewallEnd& end, double pressure) {
  SidewallShape shape;
  const Vector3 on_tread = solve(end, pressure, shape.angles, false).on_tread;
  nodes(shape.angles, shape.nodes);
  shape.bending = bending_energy(shape.angles, end.phi);
  shape.area = area(shape.angles);
  double a_dr = 0.0;  // integral of a dr
  for (Eigen::Index i = 0; i < n_; ++i)
    a_dr += 0.5 * (shape.nodes(0, i) + shape.nodes(0, i + 1)) *
            (shape.nodes(1, i + 1) - shape.nodes(1, i));
  const double omega_0 = parameters_.bead_width, taper = parameters_.taper;
  shape.on_rim = {pressure * end.r * (omega_0 + 0.5 * taper * end.r) - on_tread[0],
                  pressure * (taper * a_dr - end.a * (omega_0 + taper * end.r)) - on_tread[1],
                  parameters_.rim_stiffness * (shape.angles[0] - parameters_.rim_angle)};
  return shape;
}

}  // namespace furrow
