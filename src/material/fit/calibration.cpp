// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/fit/calibration.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/SVD>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "core/error.h"
#include "material/fit/fit_variable.h"

namespace furrow {

namespace {

/// A direction with a singular value below this part of the largest is within the noise of the
/// differences.
constexpr double min_singular_ratio = 1e-5;
/// A parameter known no better than this (of ln, or of its scale) is not determined: a factor of e
/// either way.
constexpr double max_deviation = 1.0;

/// Residuals of all curves as a function of the parameters.
class Residuals {
 public:
  explicit Residuals(const FitProblem& problem) : problem_(problem), sections_(problem.sections) {
    const MaterialOptions options = read_sections(problem.model, problem.sections);
    for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        if (problem.parameters[j].name == problem.parameters[i].name)
          throw InputError(fmt::format("parameter '{}'", problem.parameters[i].name),
                           "is given twice", "each parameter once");
      variables_.emplace_back(problem.model, options, sections_, problem.parameters[i]);
    }
    const auto material = make_material(problem.model, problem.sections);
    for (const FitCurve& curve : problem.curves) {
      find_point_channel(*material, curve.channel);
      if (curve.measured.size() != curve.path.segments.size())
        throw InputError("curve " + curve.name,
                         fmt::format("has {} values for {} segments", curve.measured.size(),
                                     curve.path.segments.size()),
                         "a value for each segment");
      for (const double value : curve.measured) {
        if (std::isnan(value)) continue;
        if (curve.relative && value <= 0.0)
          throw InputError("curve " + curve.name,
                           fmt::format("has the value {} and is compared in logarithms", value),
                           "values > 0", "use scale: linear");
        ++count_;
      }
    }
    if (variables_.empty()) throw InputError("fit", "has no parameter", "at least one");
    if (count_ < variables_.size())
      throw InputError("fit",
                       fmt::format("has {} parameters for {} data", variables_.size(), count_),
                       "at least as many data as parameters");
  }

  const std::vector<FitVariable>& variables() const { return variables_; }
  Eigen::Index parameters() const { return static_cast<Eigen::Index>(variables_.size()); }
  Eigen::Index data() const { return static_cast<Eigen::Index>(count_); }
  int evaluations() const { return evaluations_; }
  MaterialSections sections_at(const VectorX& z) const {
    MaterialSections sections = sections_;
    for (std::size_t i = 0; i < variables_.size(); ++i)
      variables_[i].put(sections, z[static_cast<Eigen::Index>(i)]);
    return sections;
  }
  VectorX z_of_t(const VectorX& t) const {
    VectorX z(t.size());
    for (Eigen::Index i = 0; i < t.size(); ++i) z[i] = variables_[std::size_t(i)].z_of_t(t[i]);
    return z;
  }

  /// @throws StateError, InputError when the parameters are no material or the path cannot be
  /// followed
  std::vector<std::vector<double>> curves_at(const VectorX& z) const {
    ++evaluations_;
    const auto material = make_material(problem_.model, sections_at(z));
    std::vector<std::vector<double>> curves;
    for (const FitCurve& curve : problem_.curves) {
      const PointHistory history = drive_point(*material, curve.path);
      const PointChannel channel = find_point_channel(*material, curve.channel);
      std::vector<double> values;
      for (const PointRecord& record : history.records)
        if (record.segment > 0 &&
            record.step == curve.path.segments[std::size_t(record.segment) - 1].steps) {
          const double measured = curve.measured[values.size()];
          values.push_back(std::isnan(measured) ? measured : channel.value(record));
        }
      curves.push_back(std::move(values));
    }
    return curves;
  }
  /// @throws as curves_at; StateError for a negative value compared in logarithms
  VectorX at(const VectorX& z) const {
    VectorX r(data());
    Eigen::Index row = 0;
    const auto curves = curves_at(z);
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const FitCurve& curve = problem_.curves[c];
      for (std::size_t i = 0; i < curves[c].size(); ++i) {
        const double model = curves[c][i], measured = curve.measured[i];
        if (std::isnan(measured)) continue;
        if (curve.relative && model <= 0.0)
          throw StateError(
              fmt::format("curve {}: {} is {} at point {} and is compared in logarithms",
                          curve.name, curve.channel, model, i + 1));
        const double difference = curve.relative ? std::log(model / measured) : model - measured;
        r[row++] = difference / (curve.deviation > 0.0 ? curve.deviation : 1.0);
      }
    }
    return r;
  }
  /// Derivative with respect to z by central differences, one-sided at a bound. False where a
  /// parameter can go neither way.
  bool slope(const VectorX& z, Eigen::MatrixXd& jacobian) const {
    jacobian.resize(data(), parameters());
    for (Eigen::Index j = 0; j < z.size(); ++j) {
      VectorX behind = z, ahead = z;
      std::tie(behind[j], ahead[j]) = variables_[std::size_t(j)].around(z[j], 1e-4);
      VectorX low, high;
      if (!try_at(behind, low) && !try_at(behind = z, low)) return false;
      if (!try_at(ahead, high) && !try_at(ahead = z, high)) return false;
      if (ahead[j] == behind[j]) return false;
      jacobian.col(j) = (high - low) / (ahead[j] - behind[j]);
    }
    return true;
  }
  bool try_at(const VectorX& z, VectorX& r) const {
    try {
      r = at(z);
      return r.allFinite();
    } catch (const Error&) {
      return false;
    }
  }

 private:
  const FitProblem& problem_;
  MaterialSections sections_;
  std::vector<FitVariable> variables_;
  std::size_t count_ = 0;
  mutable int evaluations_ = 0;
};

/// The interface of Eigen's Levenberg–Marquardt, in the unbounded variables t.
struct Functor : Eigen::DenseFunctor<double> {
  Functor(const Residuals& r, double large_value)
      : Eigen::DenseFunctor<double>(int(r.parameters()), int(r.data())),
        residuals(r),
        large(large_value) {}

  int operator()(const VectorX& t, VectorX& r) const {
    if (!residuals.try_at(residuals.z_of_t(t), r))
      r = VectorX::Constant(residuals.data(), large);  // the step is refused and shortened
    return 0;
  }
  int df(const VectorX& t, Eigen::MatrixXd& jacobian) const {
    if (!residuals.slope(residuals.z_of_t(t), jacobian)) return -1;
    for (Eigen::Index j = 0; j < t.size(); ++j) {
      const FitVariable& variable = residuals.variables()[std::size_t(j)];
      jacobian.col(j) *= (variable.z_of_t(t[j] + 1e-5) - variable.z_of_t(t[j] - 1e-5)) / 2e-5;
    }
    return 0;
  }
  const Residuals& residuals;
  double large;
};

double rms(const VectorX& r) { return std::sqrt(r.squaredNorm() / double(r.size())); }

/// Uncertainties at the solution, and what the data leave open.
void judge(const FitProblem& problem, const Residuals& residuals, const VectorX& z,
           FitResult& result) {
  const Eigen::Index n = residuals.parameters(), m = residuals.data();
  Eigen::MatrixXd jacobian;
  if (!residuals.slope(z, jacobian))
    throw StateError("fit: the curves cannot be computed on either side of the solution");
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  result.singular_values = svd.singularValues();
  result.directions = svd.matrixV();
  const double largest = result.singular_values[0];

  bool all_known = true;
  for (const FitCurve& curve : problem.curves) all_known = all_known && curve.deviation > 0.0;
  result.scatter =
      all_known || m == n ? 1.0 : std::sqrt(residuals.at(z).squaredNorm() / double(m - n));
  const bool no_scatter = !all_known && m == n;

  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  std::vector<std::string> open(static_cast<std::size_t>(n));  // why a parameter is not determined
  for (Eigen::Index k = 0; k < n; ++k) {
    const VectorX v = svd.matrixV().col(k);
    if (largest > 0.0 && result.singular_values[k] > min_singular_ratio * largest) {
      covariance += v * v.transpose() * std::pow(result.scatter / result.singular_values[k], 2);
    } else {
      std::vector<std::string> partners;
      for (Eigen::Index i = 0; i < n; ++i)
        if (std::abs(v[i]) > 0.1) partners.push_back(problem.parameters[std::size_t(i)].name);
      for (Eigen::Index i = 0; i < n; ++i)
        if (std::abs(v[i]) > 0.1)
          open[std::size_t(i)] = partners.size() == 1
                                     ? "the curves do not depend on it"
                                     : fmt::format("the curves depend only on a combination of {}",
                                                   fmt::join(partners, ", "));
    }
  }
  result.correlation = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      if (i != j && covariance(i, i) > 0.0 && covariance(j, j) > 0.0)
        result.correlation(i, j) =
            covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));

  for (Eigen::Index i = 0; i < n; ++i) {
    const FitVariable& variable = residuals.variables()[std::size_t(i)];
    FittedParameter p;
    p.name = problem.parameters[std::size_t(i)].name;
    p.unit = variable.unit();
    p.start = variable.start();
    p.value = variable.value_of(z[i]);
    p.logarithmic = variable.logarithmic();
    p.scaled_deviation = !open[std::size_t(i)].empty() ? std::numeric_limits<double>::infinity()
                                                       : std::sqrt(covariance(i, i));
    p.deviation = p.scaled_deviation * (p.logarithmic ? p.value : variable.scale());
    if (!open[std::size_t(i)].empty()) {
      p.determined = false;
      p.remark = open[std::size_t(i)];
    } else if (p.scaled_deviation > max_deviation) {
      p.determined = false;
      p.remark = p.logarithmic ? "known to no better than a factor of e"
                               : "known no better than its range or size";
    } else if (no_scatter) {
      p.remark =
          "as many data as parameters: no scatter to judge by, unless the deviation of the data is "
          "given";
      p.scaled_deviation = p.deviation = std::numeric_limits<double>::quiet_NaN();
    }
    const std::string bound = variable.bound_met(z[i]);
    if (!bound.empty()) {
      p.determined = false;
      p.remark = bound;
    }
    result.parameters.push_back(p);
  }
}

}  // namespace

FitResult fit_material(const FitProblem& problem) {
  const Residuals residuals(problem);
  VectorX t(residuals.parameters());
  for (Eigen::Index i = 0; i < t.size(); ++i)
    t[i] = residuals.variables()[std::size_t(i)].start_t();
  FitResult result;
  result.data = std::size_t(residuals.data());
  const VectorX at_start = residuals.at(residuals.z_of_t(t));  // throws with the cause
  if (!at_start.allFinite()) throw StateError("fit: a curve is not finite at the start");
  result.rms_start = rms(at_start);
  result.model_start = residuals.curves_at(residuals.z_of_t(t));

  Functor functor(residuals, 1e3 * (at_start.lpNorm<Eigen::Infinity>() + 1.0));
  Eigen::LevenbergMarquardt<Functor> method(functor);
  // the curves themselves are known to the paths' tolerance, 1e-10 unless changed
  method.setFtol(1e-12);
  method.setXtol(1e-9);
  method.setGtol(0.0);
  method.setMaxfev(400);
  const auto status = method.minimize(t);
  using Status = Eigen::LevenbergMarquardtSpace::Status;
  switch (status) {
    case Status::RelativeReductionTooSmall:
      result.end = "the sum of squares no longer falls";
      break;
    case Status::RelativeErrorTooSmall:
    case Status::RelativeErrorAndReductionTooSmall:
      result.end = "the parameters no longer change";
      break;
    case Status::CosinusTooSmall:
    case Status::GtolTooSmall:
      result.end = "the residuals are normal to the slopes";
      break;
    case Status::FtolTooSmall:
    case Status::XtolTooSmall:
      result.end = "the precision of the numbers is reached";
      break;
    case Status::TooManyFunctionEvaluation:
      result.end = "400 evaluations were not enough";
      break;
    default:
      result.end = "the curves cannot be computed around the last parameters";
  }
  result.converged = status != Status::TooManyFunctionEvaluation && status != Status::UserAsked &&
                     status != Status::ImproperInputParameters;

  const VectorX z = residuals.z_of_t(t);
  result.rms = rms(residuals.at(z));
  result.model = residuals.curves_at(z);
  result.sections = residuals.sections_at(z);
  judge(problem, residuals, z, result);
  result.evaluations = residuals.evaluations();
  return result;
}

}  // namespace furrow
