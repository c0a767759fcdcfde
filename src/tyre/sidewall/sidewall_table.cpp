// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/sidewall_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

std::array<GridAxis, 3> SidewallTableGrid::axes() const {
  if (!(chord_min > 0.0 && chord_max > chord_min && chord_max < 1.0))
    throw StateError(fmt::format(
        "sidewall table: chords from {} to {} of the length; allowed: between 0 and 1, increasing",
        chord_min, chord_max));
  return {GridAxis{std::sqrt(1.0 - chord_max), std::sqrt(1.0 - chord_min), chord_nodes},
          GridAxis{direction_min, direction_max, direction_nodes},
          GridAxis{rotation_min, rotation_max, rotation_nodes}};
}

namespace {

// largest rms error of the force over the rms of the force
constexpr double largest_error = 5e-3;

/// End of a sidewall at u, chi, phi.
SidewallEnd end_at(double u, double chi, double phi, double length) {
  const double chord = length * (1.0 - u * u);
  return {chord * std::cos(chi), chord * std::sin(chi), phi};
}

void check_pressure(double pressure) {
  if (!(pressure >= 0.0) || !std::isfinite(pressure))
    throw StateError(fmt::format("sidewall: the pressure is {} Pa; it must be >= 0", pressure));
}

}  // namespace

SidewallTable::SidewallTable(const SidewallParameters& parameters, double pressure,
                             const SidewallTableGrid& grid)
    : chain_(parameters), pressure_(pressure), grid_(grid) {
  check_pressure(pressure);
  build();
}

SidewallTable::SidewallTable(const SidewallParameters& parameters, double pressure,
                             const SidewallTableGrid& grid, std::vector<double> coefficients)
    : chain_(parameters),
      pressure_(pressure),
      grid_(grid),
      spline_(QuinticSpline3::of(grid.axes(), std::move(coefficients))) {
  check_pressure(pressure);
}

void SidewallTable::build() {
  const std::array<GridAxis, 3> axes = grid_.axes();
  std::vector<double> potential;
  potential.reserve(static_cast<std::size_t>(axes[0].nodes) * std::size_t(axes[1].nodes) *
                    std::size_t(axes[2].nodes));
  VectorX angles;
  for (int i = 0; i < axes[0].nodes; ++i)
    for (int j = 0; j < axes[1].nodes; ++j)
      for (int k = 0; k < axes[2].nodes; ++k) {
        const SidewallEnd end =
            end_at(axes[0].node(i), axes[1].node(j), axes[2].node(k), chain_.parameters().length);
        angles.resize(
            0);  // each node starts from the arc, so that the order does not select the branch
        potential.push_back(chain_.solve(end, pressure_, angles, false).potential);
      }
  spline_ = QuinticSpline3::through(axes, potential);
  // the potential has kinks where stiff springs make the chain snap; no smooth table follows them
  const Accuracy seen = accuracy(0.97, 5);
  if (seen.force_rms > largest_error * seen.force_scale)
    throw StateError(
        fmt::format("sidewall table at a pressure of {:.6g} Pa: its forces differ from the chain's "
                    "by {:.3g} N/m (rms of {} points; the force's rms is {:.3g} N/m): where the "
                    "pressure is low for the bending stiffness, the chain snaps through; raise the "
                    "pressure (2.4 bar or 35 psi are 241e3 Pa), or take more nodes, smaller ranges "
                    "or the direct solution",
                    pressure_, seen.force_rms, seen.points, seen.force_scale));
}

void SidewallTable::set_pressure(double pressure) {
  check_pressure(pressure);
  if (pressure == pressure_) return;
  pressure_ = pressure;
  build();
}

void SidewallTable::refuse(const SidewallEnd& end, std::size_t station) const {
  const double chord = std::hypot(end.a, end.r) / chain_.parameters().length,
               chi = std::atan2(end.r, end.a);
  std::string problem;
  const auto compare = [&](const char* name, double value, double lower, double upper,
                           const char* unit) {
    if (problem.empty() && !(value >= lower && value <= upper))
      problem = fmt::format("{} is {:.4g}{}, the table goes from {:.4g} to {:.4g}", name, value,
                            unit, lower, upper);
  };
  compare("the chord over the length", chord, grid_.chord_min, grid_.chord_max, "");
  compare("the chord's direction", degrees(chi), degrees(grid_.direction_min),
          degrees(grid_.direction_max), " degrees");
  compare("the tread's rotation", degrees(end.phi), degrees(grid_.rotation_min),
          degrees(grid_.rotation_max), " degrees");
  throw StateError(
      fmt::format("station {}: sidewall: {} (a = {:.6g} m, r = {:.6g} m); a tyre deformed that "
                  "much has a load, a sinkage or a speed beyond what it can take, or dimensions, "
                  "pressure or mass in other units; else it needs a wider table or the direct "
                  "solution",
                  station, problem, end.a, end.r));
}

void SidewallTable::evaluate(const SidewallEnd* ends, SidewallResponse* responses, std::size_t n,
                             bool with_stiffness) {
  const double per_length = 1.0 / chain_.parameters().length, p = pressure_;
  const double half = 0.5 * chain_.parameters().bead_width,
               third = chain_.parameters().taper / 3.0;  // of the chord's pressure
  const GridAxis &u_axis = spline_.axes()[0], &chi_axis = spline_.axes()[1],
                 &phi_axis = spline_.axes()[2];
  QuinticSpline3::Value W;
  for (std::size_t i = 0; i < n; ++i) {
    const SidewallEnd& end = ends[i];
    const double c = std::sqrt(end.a * end.a + end.r * end.r);
    const Vector3 x(std::sqrt(1.0 - c * per_length), std::atan2(end.r, end.a), end.phi);
    const bool inside = x[0] >= u_axis.lower && x[0] <= u_axis.upper && x[1] >= chi_axis.lower &&
                        x[1] <= chi_axis.upper && x[2] >= phi_axis.lower && x[2] <= phi_axis.upper;
    if (!inside) refuse(end, i);  // true also for NaN
    spline_.evaluate(x, W, with_stiffness);

    const double per_c = 1.0 / c, u_c = -0.5 * per_length / x[0];  // du/dc
    const Vector2 along(end.a * per_c, end.r * per_c), across(-along[1], along[0]);
    const double W_c = W.gradient[0] * u_c, W_chi = W.gradient[1] * per_c;
    SidewallResponse& out = responses[i];
    out.force.head<2>() = -W_c * along - W_chi * across;
    out.force[2] = -W.gradient[2];
    out.on_tread = out.force + p * (half + third * end.r) * Vector3(end.r, -end.a, 0.0);
    out.potential = W.f;
    if (!with_stiffness) continue;

    // grad c = along, grad chi = across/c; Hessians across across^T/c and -(along across^T + across
    // along^T)/c^2
    const double u_cc = -u_c * u_c / x[0];
    const double cc = W.hessian(0, 0) * u_c * u_c + W.gradient[0] * u_cc;
    const double tt = (W_c + W.hessian(1, 1) * per_c) * per_c,
                 ct = (W.hessian(0, 1) * u_c - W_chi) * per_c;
    const Vector2 mixed = W.hessian(0, 2) * u_c * along + W.hessian(1, 2) * per_c * across;
    out.stiffness.topLeftCorner<2, 2>() =
        cc * along * along.transpose() + tt * across * across.transpose() +
        ct * (along * across.transpose() + across * along.transpose());
    out.stiffness(0, 1) -= p * (half + 2.0 * third * end.r);
    out.stiffness(1, 0) += p * (half + third * end.r);
    out.stiffness(1, 1) += p * third * end.a;
    out.stiffness.topRightCorner<2, 1>() = mixed;
    out.stiffness.bottomLeftCorner<1, 2>() = mixed.transpose();
    out.stiffness(2, 2) = W.hessian(2, 2);
  }
}

SidewallTable::Accuracy SidewallTable::accuracy(double chord_limit, int every) {
  const std::array<GridAxis, 3>& axes = spline_.axes();
  Accuracy accuracy;
  VectorX angles;
  int count = 0;
  double scale = 0.0;
  for (int i = 0; i + 1 < axes[0].nodes; ++i)
    for (int j = 0; j + 1 < axes[1].nodes; ++j)
      for (int k = 0; k + 1 < axes[2].nodes; ++k) {
        const double u = axes[0].node(i) + 0.5 * axes[0].step();
        if (1.0 - u * u > chord_limit || count++ % every) continue;
        const SidewallEnd end =
            end_at(u, axes[1].node(j) + 0.5 * axes[1].step(),
                   axes[2].node(k) + 0.5 * axes[2].step(), chain_.parameters().length);
        SidewallResponse table;
        evaluate(&end, &table, 1, false);
        angles.resize(0);
        const Vector3 exact = chain_.solve(end, pressure_, angles, false).on_tread,
                      error = table.on_tread - exact;
        const double force = error.head<2>().norm(), moment = std::abs(error[2]);
        ++accuracy.points;
        accuracy.force_rms += force * force;
        accuracy.moment_rms += moment * moment;
        scale += exact.head<2>().squaredNorm();
        accuracy.force_max = std::max(accuracy.force_max, force);
        accuracy.moment_max = std::max(accuracy.moment_max, moment);
        accuracy.force_max_share =
            std::max(accuracy.force_max_share, force / exact.head<2>().norm());
      }
  const double n = static_cast<double>(std::max<std::size_t>(accuracy.points, 1));
  accuracy.force_rms = std::sqrt(accuracy.force_rms / n);
  accuracy.moment_rms = std::sqrt(accuracy.moment_rms / n);
  accuracy.force_scale = std::sqrt(scale / n);
  return accuracy;
}

}  // namespace furrow
