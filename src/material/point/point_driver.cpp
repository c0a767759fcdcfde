// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/point/point_driver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

bool is_diagonal(const Vector6& e) { return e.tail<3>().isZero(0.0); }

Matrix3 exponential(const Vector6& e) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(to_matrix(e));
  return eigen.eigenvectors() * eigen.eigenvalues().array().exp().matrix().asDiagonal() *
         eigen.eigenvectors().transpose();
}

Matrix3 deformation(Motion motion, const Vector6& e) {
  if (motion == Motion::stretch) return exponential(e);
  Matrix3 f = e.head<3>().array().exp().matrix().asDiagonal();
  f(0, 1) = e[3];
  f(1, 2) = e[4];
  f(0, 2) = e[5];
  return f;
}

/// H = F_1 F_0^-1 - I. Without shears the exact difference of logarithms is used, so that small
/// steps lose no digits.
Matrix3 step_gradient(Motion motion, const Vector6& from, const Vector6& to) {
  if (is_diagonal(from) && is_diagonal(to)) {
    Matrix3 h = Matrix3::Zero();
    for (int i = 0; i < 3; ++i) h(i, i) = std::expm1(to[i] - from[i]);
    return h;
  }
  const Matrix3 old = deformation(motion, from);
  return (deformation(motion, to) - old) * old.inverse();
}

Vector6 spatial_strain(Motion motion, const Vector6& e) {
  if (motion == Motion::stretch || is_diagonal(e)) return e;
  const Matrix3 f = deformation(motion, e);
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(f * f.transpose());
  return to_vector6(eigen.eigenvectors() *
                    (0.5 * eigen.eigenvalues().array().log()).matrix().asDiagonal() *
                    eigen.eigenvectors().transpose());
}

/// The point and its place on the path; one step at a time.
class Stepper {
 public:
  Stepper(const Material& material, const PointPath& path)
      : material_(material), path_(path), state_(material.initial_state()) {}

  const VectorX& state() const { return state_; }
  const Vector6& variable() const { return variable_; }
  Branch branch() const { return branch_; }
  double time() const { return time_; }
  const PointCost& cost() const { return cost_; }

  /// Takes the controlled values to `target` over this step of time_step seconds. @throws
  /// StateError
  void advance(const std::array<Control, 6>& control, const Vector6& target, double time_step) {
    Vector6 start;
    for (int c = 0; c < 6; ++c)
      start[c] = control[std::size_t(c)] == Control::strain ? variable_[c] : state_[c];
    const std::string cause = advance_part(control, start, target, time_step, 0);
    if (!cause.empty()) throw StateError(cause);
    ++cost_.steps;
    time_ += time_step;
  }
  /// Forgets the rate of the last step: the direction of the path changes.
  void turn() { last_change_.setZero(); }

 private:
  static constexpr int max_iterations = 40, max_halvings = 10;

  struct Trial {
    Vector6 variable = Vector6::Zero();
    VectorX state;
    UpdateReport report;
    Branch branch = Branch::elastic;
  };

  /// Updates the state by a step to `variable`; false with the message of the law when the law
  /// refuses it.
  bool update(const Vector6& variable, double time_step, Trial& trial, std::string& refusal) const {
    trial.variable = variable;
    trial.state = state_;
    try {
      trial.report = material_.update_point(step_gradient(path_.motion, variable_, variable),
                                            trial.state, &trial.branch, time_step);
    } catch (const StateError& error) {
      refusal = error.what();
      return false;
    }
    return true;
  }

  /// One step of the solver; cut in halves where it fails. Empty when it succeeded, else the cause.
  std::string advance_part(const std::array<Control, 6>& control, const Vector6& from,
                           const Vector6& to, double time_step, int depth) {
    std::string cause;
    // first guess: on as before; second: unknown strains stay
    for (const bool follow : {true, false}) {
      Vector6 guess = follow ? Vector6(variable_ + last_change_ * std::pow(0.5, depth)) : variable_;
      cause = solve(control, to, time_step, guess);
      if (cause.empty()) return cause;
      if (last_change_.isZero(0.0)) break;
    }
    if (depth == max_halvings) return cause;
    ++cost_.cuts;
    const Vector6 middle = 0.5 * (from + to);
    const std::string first = advance_part(control, from, middle, 0.5 * time_step, depth + 1);
    return first.empty() ? advance_part(control, middle, to, 0.5 * time_step, depth + 1) : first;
  }

  std::string solve(const std::array<Control, 6>& control, const Vector6& target, double time_step,
                    Vector6 e) {
    std::vector<int> unknown;
    for (int c = 0; c < 6; ++c) {
      if (control[std::size_t(c)] == Control::strain)
        e[c] = target[c];
      else
        unknown.push_back(c);
    }
    const auto n = static_cast<Eigen::Index>(unknown.size());
    const auto residual_of = [&](const Trial& trial) {
      VectorX r(n);
      for (Eigen::Index i = 0; i < n; ++i)
        r[i] = trial.state[unknown[std::size_t(i)]] - target[unknown[std::size_t(i)]];
      return r;
    };
    const double modulus = material_.moduli(state_).wave();
    double target_size = 0.0;
    for (const int c : unknown) target_size = std::max(target_size, std::abs(target[c]));
    const auto size_of = [&](const Trial& trial) {
      const double stress = std::max(stress_of(state_).lpNorm<Eigen::Infinity>(),
                                     stress_of(trial.state).lpNorm<Eigen::Infinity>());
      return std::max({stress, target_size, std::numeric_limits<double>::min()});
    };
    // Rounding of a deformation of order one shows in the stress as this much.
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * modulus;

    std::string refusal;
    Trial trial;
    if (!update(e, time_step, trial, refusal)) return refusal;
    VectorX r = residual_of(trial);
    int iteration = 0;
    while (n > 0 && r.lpNorm<Eigen::Infinity>() > path_.tolerance * size_of(trial) + rounding) {
      if (++iteration > max_iterations)
        return describe(unknown, target, trial,
                        fmt::format("no convergence in {} Newton iterations", max_iterations));
      Eigen::MatrixXd jacobian(n, n);
      for (Eigen::Index j = 0; j < n; ++j) {
        // the stresses are known to about 1e-16 of a modulus: the derivative to 1e-9 of it
        const double h = 1e-7;
        Vector6 up = e, down = e;
        up[unknown[std::size_t(j)]] += h;
        down[unknown[std::size_t(j)]] -= h;
        Trial ahead, behind;
        const bool has_ahead = update(up, time_step, ahead, refusal);
        const bool has_behind = update(down, time_step, behind, refusal);
        if (!has_ahead && !has_behind) return refusal;
        const Trial& high = has_ahead ? ahead : trial;
        const Trial& low = has_behind ? behind : trial;
        jacobian.col(j) =
            (residual_of(high) - residual_of(low)) / (h * (int(has_ahead) + int(has_behind)));
      }
      Eigen::FullPivLU<Eigen::MatrixXd> factors(jacobian);
      factors.setThreshold(1e-13);
      if (factors.rank() < n)
        return describe(unknown, target, trial,
                        "the stiffness of the controlled components vanishes");
      VectorX change = factors.solve(-r);
      const double longest = change.lpNorm<Eigen::Infinity>();
      if (!(longest < std::numeric_limits<double>::infinity()))
        return describe(unknown, target, trial, "the Newton step is not finite");
      if (longest > 0.5) change *= 0.5 / longest;
      bool better = false;
      double factor = 1.0;
      for (int halving = 0; halving < 30 && !better; ++halving, factor *= 0.5) {
        Vector6 next = e;
        for (Eigen::Index i = 0; i < n; ++i) next[unknown[std::size_t(i)]] += factor * change[i];
        Trial candidate;
        if (!update(next, time_step, candidate, refusal)) continue;
        const VectorX new_r = residual_of(candidate);
        if (new_r.norm() < (1.0 - 1e-4 * factor) * r.norm()) {
          e = next;
          trial = std::move(candidate);
          r = new_r;
          better = true;
        }
      }
      if (!better)
        return describe(unknown, target, trial, "no step along Newton's direction comes nearer");
    }
    cost_.newton_iterations += iteration;
    cost_.max_newton_iterations = std::max(cost_.max_newton_iterations, iteration);
    if (n > 0)
      cost_.largest_residual =
          std::max(cost_.largest_residual, r.lpNorm<Eigen::Infinity>() / size_of(trial));
    cost_.updates += trial.report;
    last_change_ = trial.variable - variable_;
    variable_ = trial.variable;
    state_ = std::move(trial.state);
    branch_ = trial.branch;
    return {};
  }

  static std::string describe(const std::vector<int>& unknown, const Vector6& target,
                              const Trial& trial, const std::string& cause) {
    std::string text;
    for (const int c : unknown)
      text += fmt::format("{}stress_{} = {:.6g} Pa (nearest {:.6g})", text.empty() ? "" : ", ",
                          component_names[std::size_t(c)], target[c], trial.state[c]);
    return fmt::format(
        "cannot reach {}: {} (beyond a strength, or while the point softens, control strains "
        "instead)",
        text, cause);
  }

  const Material& material_;
  const PointPath& path_;
  VectorX state_;
  Vector6 variable_ = Vector6::Zero();
  Vector6 last_change_ = Vector6::Zero();
  Branch branch_ = Branch::elastic;
  double time_ = 0.0;  // [s]
  PointCost cost_;
};

}  // namespace

PointHistory drive_point(const Material& material, const PointPath& path) {
  if (path.segments.empty())
    throw InputError("path " + path.type, "has no segment", "at least one target");
  const bool takes_time = std::any_of(path.segments.begin(), path.segments.end(),
                                      [](const PathSegment& s) { return s.duration > 0.0; });
  if (material.rate_dependent() && !takes_time)
    throw InputError("path " + path.type,
                     fmt::format("has no duration, and the stress of law {} depends on the rate",
                                 material.name()),
                     "duration > 0 [s] of a piece of the path");
  Stepper point(material, path);
  PointHistory history;
  const auto record = [&](int segment, int step) {
    history.records.push_back({segment, step, point.time(), point.variable(),
                               spatial_strain(path.motion, point.variable()), point.state(),
                               point.branch()});
  };
  record(0, 0);
  Vector6 origin = Vector6::Zero();  // of strain targets
  std::array<Control, 6> before = path.segments.front().control;
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const PathSegment& segment = path.segments[s];
    Vector6 from, to;
    for (int c = 0; c < 6; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const bool strain = segment.control[k] == Control::strain;
      if (path.strain_from_switch && strain && before[k] == Control::stress)
        origin[c] = point.variable()[c];
      from[c] = strain ? point.variable()[c] : point.state()[c];
      to[c] = segment.target[c] + (strain ? origin[c] : 0.0);
    }
    before = segment.control;
    point.turn();
    for (int step = 1; step <= segment.steps; ++step) {
      const double part = static_cast<double>(step) / segment.steps;
      const Vector6 target = step == segment.steps ? to : Vector6(from + part * (to - from));
      try {
        point.advance(segment.control, target, segment.duration / segment.steps);
      } catch (const StateError& error) {
        const Invariants now = invariants(stress_of(point.state()));
        throw StateError(
            fmt::format("path {}, segment {}, step {} of {}: {}; the point is at p = {:.6g} "
                        "Pa, q = {:.6g} Pa, density {:.6g} kg/m3",
                        path.type, s + 1, step, segment.steps, error.what(), now.p, now.q,
                        material.current_density(point.state())));
      }
      record(static_cast<int>(s) + 1, step);
    }
  }
  history.cost = point.cost();
  return history;
}

std::vector<PointChannel> point_channels(const Material& material) {
  std::vector<PointChannel> channels;
  const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning,
                       auto value) {
    channels.push_back({name, unit, meaning, value});
  };
  add("segment", "", "piece of the path, 0 at the start",
      [](const PointRecord& r) { return double(r.segment); });
  add("step", "", "in the segment", [](const PointRecord& r) { return double(r.step); });
  add("axial_strain", "", "-(ln V)_zz, compression positive",
      [](const PointRecord& r) { return -r.strain[2]; });
  add("axial_stress", "Pa", "-sigma_zz, compression positive",
      [](const PointRecord& r) { return -r.state[2]; });
  add("shear_strain", "", "the path's variable xz: gamma = dx/dz of level planes, or (ln U)_xz",
      [](const PointRecord& r) { return r.variable[5]; });
  add("shear_stress", "Pa", "sigma_xz", [](const PointRecord& r) { return r.state[5]; });
  add("eps_vol", "", "-ln J, compression positive",
      [](const PointRecord& r) { return -std::log(r.state[field::volume_ratio]); });
  add("p", "Pa", "pressure, compression positive",
      [](const PointRecord& r) { return invariants(stress_of(r.state)).p; });
  add("q", "Pa", "Mises stress",
      [](const PointRecord& r) { return invariants(stress_of(r.state)).q; });
  add("stress_ratio", "", "q/p; 0 without pressure", [](const PointRecord& r) {
    const Invariants stress = invariants(stress_of(r.state));
    return stress.p > 0.0 ? stress.q / stress.p : 0.0;
  });
  add("density", "kg/m3", "rho0/J",
      [&material](const PointRecord& r) { return material.current_density(r.state); });
  add("branch", "", "0 elastic, 1 shear, 2 transition, 3 cap, 4 tension: of the step",
      [](const PointRecord& r) { return double(r.branch); });
  add("yield_function", "Pa", "<= 0 inside; -inf for a law that never yields",
      [&material](const PointRecord& r) { return material.yield_function(r.state); });
  if (material.rate_dependent())
    add("time", "s", "since the start", [](const PointRecord& r) { return r.time; });
  for (int c = 0; c < 6; ++c)
    add(fmt::format("strain_{}", component_names[std::size_t(c)]), "",
        "component of ln V, tension positive", [c](const PointRecord& r) { return r.strain[c]; });
  const std::vector<StateField>& fields = material.state_fields();
  for (std::size_t f = 0; f < fields.size(); ++f)
    add(fields[f].name, fields[f].unit, fields[f].meaning,
        [f](const PointRecord& r) { return r.state[static_cast<Eigen::Index>(f)]; });
  return channels;
}

PointChannel find_point_channel(const Material& material, const std::string& name) {
  std::vector<std::string> names;
  for (PointChannel& channel : point_channels(material)) {
    if (channel.name == name) return channel;
    names.push_back(channel.name);
  }
  throw InputError(fmt::format("law {}", material.name()), fmt::format("has no channel '{}'", name),
                   fmt::format("{}", fmt::join(names, ", ")));
}

/// Fresh snow of 100 kg/m3 is ice after -2.2; a shear strain gamma of 20 is 3.
std::string strain_warning(const PointHistory& history) {
  constexpr double large = 3.0;
  const PointRecord* worst = nullptr;
  Eigen::Index component = 0;
  double largest = large;
  for (const PointRecord& record : history.records) {
    Eigen::Index at = 0;
    const double strain = record.strain.cwiseAbs().maxCoeff(&at);
    if (!(strain > largest)) continue;
    largest = strain;
    worst = &record;
    component = at;
  }
  if (!worst) return "";
  return fmt::format(
      "segment {} comes to a logarithmic strain {} of {:.4g}, and no ground beyond {:g}: lengths "
      "change by a factor of {:.3g}; targets are numbers, not per cent",
      worst->segment, component_names[static_cast<std::size_t>(component)],
      worst->strain[component], large, std::exp(largest));
}

StepError step_error(const Material& material, const PointPath& path, const PointHistory& history) {
  PointPath finer = path;
  for (PathSegment& segment : finer.segments) segment.steps *= 2;
  const PointHistory other = drive_point(material, finer);
  StepError error;
  double scale = std::numeric_limits<double>::min();
  std::size_t i = 0;
  for (const PointRecord& record : history.records) {
    const Invariants a = invariants(stress_of(record.state));
    scale = std::max({scale, std::abs(a.p), a.q});
    const bool ends =
        record.segment > 0 && record.step == path.segments[std::size_t(record.segment) - 1].steps;
    if (!ends) continue;
    while (other.records[i].segment != record.segment || other.records[i].step != 2 * record.step)
      ++i;
    const PointRecord& fine = other.records[i];
    const Invariants b = invariants(stress_of(fine.state));
    error.p = std::max(error.p, std::abs(a.p - b.p));
    error.q = std::max(error.q, std::abs(a.q - b.q));
    error.eps_vol = std::max(error.eps_vol, std::abs(std::log(record.state[field::volume_ratio] /
                                                              fine.state[field::volume_ratio])));
  }
  error.p /= scale;
  error.q /= scale;
  return error;
}

}  // namespace furrow
