// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Drives one material point of any law along a path of controlled strains and stresses.
///
/// Unknown are the deformation variables of the stress-controlled components. Each step solves
///   sigma_c(e) = target_c for these c,    |residual| <= tolerance * (largest stress of the step),
/// (8 epsilon of the P-wave modulus is added for rounding) by Newton's method with a difference
/// Jacobian and a line search; a step that fails is cut in halves, and the run stops with the cause
/// when that does not help.

#include <functional>
#include <string>
#include <vector>

#include "furrow/material/material.h"
#include "furrow/material/point/point_path.h"

namespace furrow {

/// The point at the end of a step.
struct PointRecord {
  int segment = 0;                     ///< 0 for the start, then 1, 2, ...
  int step = 0;                        ///< in the segment
  double time = 0.0;                   ///< since the start [s]
  Vector6 variable = Vector6::Zero();  ///< e of the path's motion
  Vector6 strain = Vector6::Zero();    ///< ln V, V = sqrt(F F^T)
  VectorX state;                       ///< of the law
  Branch branch = Branch::elastic;     ///< of the last update
};

/// Effort of the solver along the path.
struct PointCost {
  long steps = 0;  ///< of the path
  long cuts = 0;   ///< halvings of a step
  long newton_iterations = 0;
  int max_newton_iterations = 0;  ///< of one step or its part
  double largest_residual = 0.0;  ///< of accepted steps: controlled stress minus target, relative
                                  ///< to the step's largest stress
  UpdateReport updates;           ///< accepted updates by branch, and limits that were met
};

struct PointHistory {
  std::vector<PointRecord> records;  ///< the start and every step
  PointCost cost;
};

/// A quantity of a record.
struct PointChannel {
  std::string name, unit, meaning;
  std::function<double(const PointRecord&)> value;
};

/// strain_xx ... , stress_xx ..., axial_strain, axial_stress, shear_strain, shear_stress, eps_vol,
/// p, q, density, branch, yield_function, and what the law keeps; time if the law depends on the
/// rate. Axial is z and compression positive; shear is xz.
std::vector<PointChannel> point_channels(const Material& material);
/// @throws InputError listing the names
PointChannel find_point_channel(const Material& material, const std::string& name);

/// @throws InputError for a law that depends on the rate on a path without duration;
///         StateError naming segment and step when a target cannot be reached, with the nearest
///         stress and the cause
PointHistory drive_point(const Material& material, const PointPath& path);

/// A warning about strains that no ground reaches; empty without.
std::string strain_warning(const PointHistory& history);

/// Error of the step size: comparison with the same path with every step halved, at the ends of the
/// segments.
struct StepError {
  double p = 0.0;        ///< largest change of p, relative to the largest p or q of the run
  double q = 0.0;        ///< largest change of q, relative to the largest p or q of the run
  double eps_vol = 0.0;  ///< largest change of the volume strain
};
StepError step_error(const Material& material, const PointPath& path, const PointHistory& history);

}  // namespace furrow
