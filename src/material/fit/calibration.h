// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Fits parameters of a law to measured curves by least squares (Levenberg–Marquardt of MINPACK, in
/// Eigen) and reports how well the data determine each of them.
///
/// Residuals: r = (model - measured)/deviation, or ln(model/measured)/deviation for relative data.
/// Positive parameters are fitted in their logarithm; bounds are kept by a smooth map.
/// Uncertainties come from the Jacobian J of the residuals with respect to the scaled parameters z
/// at the solution: covariance = s^2 (J^T J)^-1. If the deviation of the data is unknown, s^2 = sum
/// r^2/(data - parameters), else s = 1. The covariance is linear: it is valid near the solution,
/// for small errors.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "material/fit/point_driver.h"
#include "material/registry.h"

namespace furrow {

/// A value of a law that may change.
struct FitParameter {
  /// "law.d", "elasticity.E", or one of a list: "hardening.p[2]", counted from 1
  std::string name;
  std::optional<double> start;  ///< else the material's value
  /// bounds in addition to the key's declared range
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// A measured curve: the path's segments end at the measured points.
struct FitCurve {
  std::string name;
  PointPath path;
  std::string channel;           ///< of point_channels(): what was measured
  std::vector<double> measured;  ///< at the end of each segment; NaN where there is none
  bool relative = false;         ///< compare logarithms
  /// standard deviation of a value (of its logarithm when relative); 0: unknown, the same for all
  double deviation = 0.0;
};

struct FitProblem {
  MaterialModel model;
  MaterialSections sections;
  std::vector<FitParameter> parameters;
  std::vector<FitCurve> curves;
};

/// One parameter after the fit.
struct FittedParameter {
  std::string name, unit;
  double start = 0.0, value = 0.0;
  bool logarithmic = false;
  /// standard deviation of z: of ln(value), or of value/scale; infinite when undetermined
  double scaled_deviation = 0.0;
  double deviation = 0.0;  ///< standard deviation of the value, linearised
  bool determined = true;
  std::string remark;  ///< why it is not determined, or that it stands at a bound
};

struct FitResult {
  std::vector<FittedParameter> parameters;
  MaterialSections sections;  ///< with the fitted values
  std::vector<std::vector<double>> model_start,
      model;  ///< the curves at the measured points, NaN where nothing was measured
  std::size_t data = 0;
  double rms_start = 0.0, rms = 0.0;  ///< of the residuals
  double scatter = 1.0;               ///< s
  Eigen::MatrixXd correlation;        ///< of the determined part
  VectorX singular_values;            ///< of J, largest first
  /// column k: the scaled parameters' direction of singular value k
  Eigen::MatrixXd directions;
  int evaluations = 0;
  std::string end;  ///< why the iteration ended
  bool converged = false;
};

/// @throws InputError for an unknown parameter or channel, fewer data than parameters, relative
/// data that are not positive;
///         StateError when the curves cannot be computed at the start
FitResult fit_material(const FitProblem& problem);

}  // namespace furrow
