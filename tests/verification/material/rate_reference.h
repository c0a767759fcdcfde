// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// An independent integration of the cap law's rate equations ([Shoop2001] eq 12-16 with K = 1,
/// alpha = 0), for comparison with the implicit update of src/material. Nothing of src/material is
/// used: the elastoplastic rate equations with the consistency condition, explicit Runge-Kutta of
/// Dormand and Prince (J. Comput. Appl. Math. 6, 1980) with adaptive steps, the first yield located
/// by bisection. The deformation is given by its velocity gradient; the rate of stress is the
/// Jaumann rate.

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

namespace reference {

using Matrix3 = Eigen::Matrix3d;

struct Sand {  // McCormick Ranch sand, [Shoop2001] Tables 4 and 5
  double E = 689e6, nu = 0.25, d = 1.194e6, beta = 14.56, R = 0.1, eps_0 = 0.001;
  std::vector<double> pb{0.138e6, 0.172e6, 0.434e6, 0.896e6, 1.655e6,
                         2.758e6, 4.137e6, 6.895e6, 13.447e6};
  std::vector<double> eps{0, 0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.1};
};

/// Stress and volumetric plastic strain (compression positive).
struct State {
  Matrix3 sigma = Matrix3::Zero();
  double eps = 0.0;
  State operator+(const State& b) const { return {sigma + b.sigma, eps + b.eps}; }
  State operator*(double f) const { return {sigma * f, eps * f}; }
};

inline double pressure(const Matrix3& sigma) { return -sigma.trace() / 3; }
inline Matrix3 deviator(const Matrix3& a) { return a - a.trace() / 3 * Matrix3::Identity(); }
inline double mises(const Matrix3& sigma) { return std::sqrt(1.5) * deviator(sigma).norm(); }

class CapRates {
 public:
  explicit CapRates(Sand sand)
      : sand_(std::move(sand)), tan_beta_(std::tan(sand_.beta * std::acos(-1.0) / 180)) {
    K_ = sand_.E / (3 * (1 - 2 * sand_.nu));
    G_ = sand_.E / (2 * (1 + sand_.nu));
  }
  State initial() const { return {Matrix3::Zero(), sand_.eps_0}; }

  double yield(const State& y) const {
    const double p = pressure(y.sigma), q = mises(y.sigma), pa = top(y.eps),
                 Q = sand_.d + pa * tan_beta_;
    return p < pa ? q - p * tan_beta_ - sand_.d : std::hypot(p - pa, sand_.R * q) - sand_.R * Q;
  }

  /// d(state)/dt under the velocity gradient L. `plastic`: on the yield surface; returns through
  /// `multiplier` the plastic multiplier.
  State rate(const State& y, const Matrix3& L, bool plastic, double* multiplier = nullptr) const {
    const Matrix3 D = 0.5 * (L + L.transpose()), W = 0.5 * (L - L.transpose());
    Matrix3 Dp = Matrix3::Zero();
    double eps_rate = 0;
    if (plastic) {
      const double p = pressure(y.sigma), q = mises(y.sigma), pa = top(y.eps);
      const double pa_slope = slope(y.eps) / (1 + sand_.R * tan_beta_);
      double f_p, f_q, f_eps, g_p, g_q;
      if (p < pa) {
        f_p = -tan_beta_, f_q = 1, f_eps = 0;
        const double g = std::hypot((pa - p) * tan_beta_, q);
        g_p = -(pa - p) * tan_beta_ * tan_beta_ / g, g_q = q / g;
      } else {
        const double n = std::hypot(p - pa, sand_.R * q);
        f_p = (p - pa) / n, f_q = sand_.R * sand_.R * q / n;
        f_eps = -f_p * pa_slope - sand_.R * tan_beta_ * pa_slope;
        g_p = f_p, g_q = f_q;
      }
      // dq/dsigma
      const Matrix3 normal = q > 0 ? Matrix3(1.5 / q * deviator(y.sigma)) : Matrix3::Zero();
      // f' = f_p p' + f_q q' + f_eps eps' = 0 with p' = -K (tr D + lambda g_p), q' = 2 G normal:D -
      // 3 G lambda g_q, eps' = lambda g_p
      const double drive =
          -f_p * K_ * D.trace() + f_q * 2 * G_ * normal.cwiseProduct(deviator(D)).sum();
      const double lambda = drive / (f_p * K_ * g_p + 3 * G_ * f_q * g_q - f_eps * g_p);
      if (multiplier) *multiplier = lambda;
      eps_rate = lambda * g_p;
      Dp = lambda * (g_q * normal - g_p / 3 * Matrix3::Identity());
    }
    const Matrix3 De = D - Dp;
    return {
        K_ * De.trace() * Matrix3::Identity() + 2 * G_ * deviator(De) + W * y.sigma - y.sigma * W,
        eps_rate};
  }

 private:
  std::size_t segment(double eps) const {
    std::size_t k = 0;
    while (k + 2 < sand_.eps.size() && eps >= sand_.eps[k + 1]) ++k;
    return k;
  }
  double slope(double eps) const {
    const std::size_t k = segment(eps);
    return (sand_.pb[k + 1] - sand_.pb[k]) / (sand_.eps[k + 1] - sand_.eps[k]);
  }
  double top(double eps) const {
    const std::size_t k = segment(eps);
    return (sand_.pb[k] + slope(eps) * (eps - sand_.eps[k]) - sand_.R * sand_.d) /
           (1 + sand_.R * tan_beta_);
  }

  Sand sand_;
  double tan_beta_, K_, G_;
};

/// The velocity gradient that a path asks for; components of D in `held` (normal directions) adapt
/// so that their stress stays constant.
struct Control {
  Matrix3 L = Matrix3::Zero();
  std::array<bool, 3> held{false, false, false};
};

/// Integrates from time 0 to `duration`. The error of a step is kept below `tolerance` of the
/// stress level of 1 MPa.
class Integrator {
 public:
  Integrator(const CapRates& material, double tolerance)
      : material_(material), tolerance_(tolerance) {}

  State advance(State y, const Control& control, double duration) {
    double time = 0, h = std::min(step_, duration);
    while (time < duration * (1 - 1e-14)) {
      h = std::min(h, duration - time);
      if (plastic_) {
        double multiplier = 0;
        material_.rate(y, gradient(y, control, true), true, &multiplier);
        if (multiplier < 0) plastic_ = false;
      }
      State error;
      const State next = try_step(y, control, h, plastic_, error);
      const double size = error.sigma.norm() / 1e6 + std::abs(error.eps) * 100;
      if (size > tolerance_) {
        h *= std::max(0.2, 0.9 * std::pow(tolerance_ / size, 0.2));
        if (h < 1e-14 * duration)
          throw std::runtime_error("reference integration cannot meet its tolerance");
        continue;
      }
      if (!plastic_ && material_.yield(next) > 0) {  // the end of the elastic part: bisection
        double low = 0, high = h;
        for (int i = 0; i < 100; ++i) {
          const double middle = 0.5 * (low + high);
          (material_.yield(try_step(y, control, middle, false, error)) > 0 ? high : low) = middle;
        }
        y = try_step(y, control, low, false, error);
        time += low;
        plastic_ = true;
        continue;
      }
      y = next;
      time += h;
      step_ = h;
      h *= std::min(4.0, 0.9 * std::pow(tolerance_ / std::max(size, 1e-300), 0.2));
    }
    return y;
  }

 private:
  Matrix3 gradient(const State& y, const Control& control, bool plastic) const {
    // The rate of stress is linear in L for a given regime: solve for the held components by
    // columns.
    std::vector<int> free;
    for (int i = 0; i < 3; ++i)
      if (control.held[static_cast<std::size_t>(i)]) free.push_back(i);
    Matrix3 L = control.L;
    if (free.empty()) return L;
    const auto n = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd columns(n, n);
    Eigen::VectorXd base(n);
    const Matrix3 given = material_.rate(y, L, plastic).sigma;
    for (Eigen::Index i = 0; i < n; ++i)
      base[i] = given(free[std::size_t(i)], free[std::size_t(i)]);
    for (Eigen::Index j = 0; j < n; ++j) {
      Matrix3 unit = Matrix3::Zero();
      unit(free[std::size_t(j)], free[std::size_t(j)]) = 1;
      const Matrix3 response = material_.rate(y, L + unit, plastic).sigma - given;
      for (Eigen::Index i = 0; i < n; ++i)
        columns(i, j) = response(free[std::size_t(i)], free[std::size_t(i)]);
    }
    const Eigen::VectorXd solution = columns.fullPivLu().solve(-base);
    for (Eigen::Index i = 0; i < n; ++i)
      L(free[std::size_t(i)], free[std::size_t(i)]) += solution[i];
    return L;
  }

  State try_step(const State& y, const Control& control, double h, bool plastic,
                 State& error) const {
    static const double a[7][6] = {
        {},
        {1.0 / 5},
        {3.0 / 40, 9.0 / 40},
        {44.0 / 45, -56.0 / 15, 32.0 / 9},
        {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
        {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
        {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    static const double fourth[7] = {
        5179.0 / 57600, 0, 7571.0 / 16695, 393.0 / 640, -92097.0 / 339200, 187.0 / 2100, 1.0 / 40};
    std::array<State, 7> k;
    State result = y;
    for (int i = 0; i < 7; ++i) {
      State stage = y;
      for (int j = 0; j < i; ++j) stage = stage + k[std::size_t(j)] * (h * a[i][j]);
      if (i == 6) result = stage;
      k[std::size_t(i)] = material_.rate(stage, gradient(stage, control, plastic), plastic);
    }
    State other = y;
    for (int i = 0; i < 7; ++i) other = other + k[std::size_t(i)] * (h * fourth[i]);
    error = result + other * -1.0;
    return result;
  }

  const CapRates& material_;
  double tolerance_, step_ = 1e-4;
  bool plastic_ = false;
};

}  // namespace reference
