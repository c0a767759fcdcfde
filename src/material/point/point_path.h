// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Loading paths of one material point, and the named tests of a laboratory as such paths.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "furrow/core/options/options.h"
#include "furrow/material/material.h"

namespace furrow {

/// Mapping of the six deformation variables e = (xx, yy, zz, xy, yz, xz) to the deformation
/// gradient F.
enum class Motion {
  stretch,  ///< F = exp(E), E symmetric with the components e: logarithmic strain, no rotation
  /// F = diag(exp(e_xx), exp(e_yy), exp(e_zz)) with F_xy = e_xy, F_yz = e_yz, F_xz = e_xz: level
  /// planes stay level
  shear
};

enum class Control { strain, stress };

/// A straight piece of a path: every component goes linearly from its value to its target.
struct PathSegment {
  std::array<Control, 6> control{};  ///< of xx, yy, zz, xy, yz, xz
  /// deformation variable e [-], or Cauchy stress, tension positive [Pa]
  Vector6 target = Vector6::Zero();
  int steps = 1;
  double duration = 0.0;  ///< [s]; 0: infinitely fast. For laws that depend on the rate
};

struct PointPath {
  std::string type;  ///< "triaxial"; chooses what a plot shows
  Motion motion = Motion::stretch;
  /// targets of a strain count from its value where its component's stress control ended
  bool strain_from_switch = true;
  std::vector<PathSegment> segments;
  double tolerance = 1e-10;  ///< of a controlled stress, relative to the largest stress of the step
};

/// A named test. In its keys compression is positive, as the literature of soil testing has it; z
/// is the axis.
struct PathType {
  std::string name;
  std::string meaning;
  Schema schema;  ///< the last key of all lists is `steps`: of each segment
  std::function<PointPath(const Options&)> build;
};

/// hydrostatic, confined, triaxial, simple_shear, cyclic, tension. The general path is `table`:
/// table_path().
const std::vector<PathType>& path_types();
/// @throws InputError listing the names
const PathType& find_path_type(const std::string& name);

/// Keys of a general path other than its rows, and of one row: strain_xx ... or stress_xx ... of
/// each component, tension positive. A component that a row does not name keeps its control and
/// value; at the start all six have zero strain.
Schema table_path_schema();
Schema table_row_schema();
/// @throws InputError for a component with both strain and stress
PointPath table_path(const Options& path, const std::vector<Options>& rows);

}  // namespace furrow
