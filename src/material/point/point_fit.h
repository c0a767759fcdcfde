// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a fit of a law to measured curves asks of furrow-point: parameters that may change, and the
/// curves of a material. furrow-post minimises the difference.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "material/point/point_path.h"
#include "material/registry.h"

namespace furrow {

/// A parameter as a file declares it.
struct FitParameterInput {
  /// "law.d", "elasticity.E", or one of a list: "hardening.p[2]", counted from 1
  std::string name;
  std::optional<double> start;  ///< else the material's value
  /// bounds in addition to the key's declared range
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// A number of a material that may change.
class FitParameter {
 public:
  /// @param options   the material's values
  /// @param sections  the same as text; the parameter's key is written into them, so that put()
  /// finds it
  /// @throws InputError for an unknown key, a list without place, bounds or a start outside the
  /// key's range, a start at 0 whose size is not known
  FitParameter(const MaterialModel& model, const MaterialOptions& options,
               MaterialSections& sections, const FitParameterInput& input);

  /// Writes a value, as text, into the sections.
  void put(MaterialSections& sections, const std::string& value) const;

  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }
  double start() const { return start_; }
  double lower() const { return lower_; }  ///< -infinity without bound
  double upper() const { return upper_; }

 private:
  std::string name_, section_, key_, unit_;
  std::size_t place_ = 0;  ///< in the key's values
  double start_ = 0.0, lower_ = 0.0, upper_ = 0.0;
};

/// A measured curve: the last segments of its path end at the measured points.
struct FitCurve {
  std::string name;
  PointPath path;
  std::string driven_by, driven_unit;  ///< the path's targets
  std::vector<double> driven;
  std::string channel;           ///< of point_channels(): what was measured
  std::vector<double> measured;  ///< NaN where there is none
  bool relative = false;         ///< compare logarithms
  /// standard deviation of a value (of its logarithm when relative); 0: unknown, the same for all
  double deviation = 0.0;
};

/// The channel at the measured points. @throws StateError when the path cannot be followed
std::vector<double> curve_of(const Material& material, const FitCurve& curve);

}  // namespace furrow
