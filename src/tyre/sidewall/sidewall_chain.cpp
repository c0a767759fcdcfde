// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_chain.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr int max_iterations = 200;
constexpr double step_limit = 0.3;            // [rad] of any segment in one step
constexpr double shortest_step = 1e-8;        // of Newton's
constexpr double sufficient_decrease = 1e-4;  // of what the slope promises (Armijo)
constexpr double gradient_tolerance = 1e-12;  // of the largest forces times lengths
// Difference of the potential over its terms, below which it is none
constexpr double rounding = 1e-13;
// [rad] of any segment: a warm start that ends farther away is not trusted
constexpr double farthest_from_arc = 1.2;
constexpr double shortest_chord = 0.02;  // of the length

}  // namespace

SidewallChain::SidewallChain(const SidewallParameters& parameters)
    : energy_(parameters),
      n_(energy_.segments()),
      directions_{VectorX::Zero(n_), VectorX::Zero(n_)},
      axes_(n_),
      gradient_(VectorX::Zero(n_)),
      hessian_(n_, n_),
      step_(VectorX::Zero(n_)),
      trial_(VectorX::Zero(n_)) {}

void SidewallChain::check_end(const SidewallEnd& end, double pressure) const {
  if (!std::isfinite(end.a) || !std::isfinite(end.r) || !std::isfinite(end.phi))
    throw StateError(fmt::format("sidewall: its tread end is at a = {} m, r = {} m, phi = {} rad",
                                 end.a, end.r, end.phi));
  if (!(pressure >= 0.0) || !std::isfinite(pressure))
    throw StateError(fmt::format("sidewall: the pressure is {} Pa; it must be >= 0", pressure));
  const double chord = std::hypot(end.a, end.r);
  const double length = parameters().length;
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
  // N chords of a circle, each rotated by 2 alpha/N against the last: chord/length =
  // sin(alpha)/(N sin(alpha/N)), which decreases in alpha.
  const double n = static_cast<double>(n_);
  const double share = std::hypot(end.a, end.r) / parameters().length;
  double lower = 0.0;
  double upper = pi;
  for (int i = 0; i < 60; ++i) {
    const double alpha = 0.5 * (lower + upper);
    (std::sin(alpha) > share * n * std::sin(alpha / n) ? lower : upper) = alpha;
  }
  const double direction = std::atan2(end.r, end.a);
  const double rotation = (lower + upper) / n;  // from segment to segment
  angles.resize(n_);
  for (Eigen::Index i = 0; i < n_; ++i)
    angles[i] = direction + (static_cast<double>(i) - 0.5 * (n - 1.0)) * rotation;
  restore_end(end, angles);
}

/// A chain with a curl in it, or curved the other way, has angles far from the arc's.
bool SidewallChain::resembles_arc(const SidewallEnd& end, const VectorX& angles) const {
  const double n = static_cast<double>(n_);
  const double direction = std::atan2(end.r, end.a);
  // Half the angle of the arc, sin(alpha)/alpha = chord/length, within 0.05 rad: a fitted series
  const double uu = 1.0 - std::hypot(end.a, end.r) / parameters().length;
  const double alpha = std::sqrt(6.0 * uu) * (1.0 + 0.15 * uu + 0.1325 * uu * uu);
  const double rotation = 2.0 * alpha / n;  // from segment to segment
  for (Eigen::Index i = 0; i < n_; ++i)
    if (std::abs(angles[i] - direction - (static_cast<double>(i) - 0.5 * (n - 1.0)) * rotation) >
        farthest_from_arc)
      return false;
  return true;
}

/// Newton's method with the shortest step; few and small where the angles nearly fit. False when it
/// does not converge. Sets directions_ to those of the angles.
bool SidewallChain::restore_end(const SidewallEnd& end, VectorX& angles) {
  const double L = energy_.segment_length();
  VectorX& cosine = directions_.cosine;
  VectorX& sine = directions_.sine;
  for (int i = 0; i < 20; ++i) {
    double a = 0.0, r = 0.0, ss = 0.0, cc = 0.0, sc = 0.0;
    for (Eigen::Index k = 0; k < n_; ++k) {
      const double c = std::cos(angles[k]), s = std::sin(angles[k]);
      a += c;
      r += s;
      ss += s * s;
      cc += c * c;
      sc += s * c;
      cosine[k] = c;
      sine[k] = s;
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
      const double change = -sine[k] * y[0] + cosine[k] * y[1];
      angles[k] += change;
      largest = std::max(largest, std::abs(change));
    }
    if (!(largest < 1.0)) return false;
  }
  return false;
}

/// Gradient, multiplier and the Lagrangian's Hessian in the axes of the constraint, which is
/// J = L (-sin; cos). Uses directions_.
void SidewallChain::linearise(const VectorX& angles, double phi, double pressure) {
  const double L = energy_.segment_length();
  energy_.derivatives(angles, directions_, phi, pressure, gradient_, hessian_);
  step_ = -L * directions_.sine;
  trial_ = L * directions_.cosine;
  axes_.set_constraints(step_, trial_);

  // Least-squares multiplier: exact in equilibrium
  axes_.to_axes(gradient_);
  const Eigen::Matrix2d& triangle = axes_.triangle();
  multiplier_[1] = gradient_[1] / triangle(1, 1);
  multiplier_[0] = (gradient_[0] - triangle(0, 1) * multiplier_[1]) / triangle(0, 0);
  for (Eigen::Index k = 0; k < n_; ++k)
    hessian_(k, k) +=
        L * (multiplier_[0] * directions_.cosine[k] + multiplier_[1] * directions_.sine[k]);
  axes_.to_axes(hessian_);
}

/// Largest moments at the segments [N m/m].
double SidewallChain::force_scale(double pressure) const {
  const double L = energy_.segment_length();
  const SidewallParameters& sidewall = parameters();
  const double hinge = *std::max_element(sidewall.bending.begin(), sidewall.bending.end()) / L;
  return L * (multiplier_.norm() + pressure * sidewall.length) + hinge +
         std::max(sidewall.rim_stiffness, sidewall.tread_stiffness);
}

/// Newton's step in the tangent plane, in the axes: the Hessian is shifted until it is positive
/// definite.
void SidewallChain::find_step(double scale) {
  for (double shift = 0.0; !axes_.factorise(hessian_, shift);
       shift = std::max(4.0 * shift, 1e-3 * scale)) {
  }
  step_ = -gradient_;
  step_.head(2).setZero();
  axes_.solve(step_);
}

/// Follows step_ while the potential decreases. False when it does not.
bool SidewallChain::search_line(const SidewallEnd& end, double pressure, VectorX& angles) {
  const double l = parameters().length;
  const double slope = step_.tail(n_ - 2).dot(gradient_.tail(n_ - 2));
  axes_.from_axes(step_);
  double length = std::min(1.0, step_limit / step_.lpNorm<Eigen::Infinity>());
  const double start = potential(angles, end.phi, pressure);
  const double slack = rounding * (std::abs(start) + (pressure * l + multiplier_.norm()) * l);
  for (;; length *= 0.5) {
    if (length < shortest_step) return false;
    trial_ = angles + length * step_;
    if (restore_end(end, trial_) && potential(trial_, end.phi, pressure) <=
                                        start + sufficient_decrease * length * slope + slack)
      break;
  }
  angles = trial_;
  return true;
}

/// Downhill to the nearest stable equilibrium; the last linearisation is the one there. False when
/// there is none.
bool SidewallChain::descend(const SidewallEnd& end, double pressure, VectorX& angles) {
  for (int i = 0; i < max_iterations; ++i) {
    linearise(angles, end.phi, pressure);
    const double scale = force_scale(pressure);
    const double residual = gradient_.tail(n_ - 2).lpNorm<Eigen::Infinity>();
    if (!std::isfinite(residual)) return false;
    if (residual <= gradient_tolerance * scale) return axes_.factorise(hessian_, 0.0);
    find_step(scale);
    if (!search_line(end, pressure, angles)) return false;
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
  const SidewallParameters& sidewall = parameters();
  const double a = end.a, r = end.r;
  const double omega = sidewall.bead_width + sidewall.taper * r;
  // Share of the chord's pressure that acts at the tread
  const double share = 0.5 * sidewall.bead_width + sidewall.taper * r / 3.0;
  response.on_tread = {
      -multiplier_[0], -multiplier_[1] - pressure * a * omega,
      sidewall.tread_stiffness * (angles[n_ - 1] - sidewall.tread_angle - end.phi)};
  response.force = response.on_tread - pressure * share * Vector3(r, -a, 0.0);
  response.potential = potential(angles, end.phi, pressure) + pressure * energy_.chord_area(a, r);
  if (with_stiffness) response.stiffness = stiffness(end, pressure);
  return response;
}

/// Linearised equilibrium at the last linearisation, in the axes: H (y, z) + e dphi = (triangle
/// dlambda, 0) with triangle^T y = d(a, r).
Matrix3 SidewallChain::stiffness(const SidewallEnd& end, double pressure) {
  const SidewallParameters& sidewall = parameters();
  const double k_tread = sidewall.tread_stiffness;
  VectorX& e = step_;
  VectorX& change = trial_;
  e.setZero();
  e[n_ - 1] = -k_tread;  // d2E/(dtheta_N dphi)
  axes_.to_axes(e);
  const Eigen::Matrix2d& triangle = axes_.triangle();
  Matrix3 stiffness;
  for (int j = 0; j < 3; ++j) {
    Vector2 y = Vector2::Zero();
    if (j < 2) y = triangle.transpose().triangularView<Eigen::Lower>().solve(Vector2::Unit(j));
    const double dphi = j == 2 ? 1.0 : 0.0;
    change = -dphi * e - y[0] * hessian_.col(0) - y[1] * hessian_.col(1);
    axes_.solve(change);
    change.head(2) = y;
    const Vector2 force(hessian_.col(0).dot(change) + dphi * e[0],
                        hessian_.col(1).dot(change) + dphi * e[1]);
    stiffness.col(j).head(2) = triangle.triangularView<Eigen::Upper>().solve(force);
    stiffness(2, j) = e.dot(change) + dphi * k_tread;
  }
  stiffness(1, 0) += pressure * (sidewall.bead_width + sidewall.taper * end.r);
  stiffness(1, 1) += pressure * end.a * sidewall.taper;
  return stiffness;
}

/// On the rim acts what moving the whole chain costs: p times the change of G, less what acts on
/// the tread.
SidewallShape SidewallChain::shape(const SidewallEnd& end, double pressure) {
  SidewallShape shape;
  const Vector3 on_tread = solve(end, pressure, shape.angles, false).on_tread;
  shape.nodes = energy_.nodes(shape.angles);
  shape.bending = energy_.bending(shape.angles, end.phi);
  shape.area = energy_.area(shape.angles);
  double a_dr = 0.0;  // integral of a dr
  for (Eigen::Index i = 0; i < n_; ++i)
    a_dr += 0.5 * (shape.nodes(0, i) + shape.nodes(0, i + 1)) *
            (shape.nodes(1, i + 1) - shape.nodes(1, i));
  const SidewallParameters& sidewall = parameters();
  const double omega_0 = sidewall.bead_width;
  const double taper = sidewall.taper;
  shape.on_rim = {pressure * end.r * (omega_0 + 0.5 * taper * end.r) - on_tread[0],
                  pressure * (taper * a_dr - end.a * (omega_0 + taper * end.r)) - on_tread[1],
                  sidewall.rim_stiffness * (shape.angles[0] - sidewall.rim_angle)};
  return shape;
}

}  // namespace furrow
