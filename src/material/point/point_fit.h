// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Input of a fit of a law to measured curves: parameters that may change, and the curves of a
/// material. furrow-point computes the curves, furrow-post minimises the difference.

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "furrow/material/point/point_driver.h"
#include "furrow/material/point/point_path.h"
#include "furrow/material/registry.h"

namespace furrow {

/// A parameter as a file declares it.
struct FitParameterInput {
  /// "law.d", "elasticity.E", or one of a list: "hardening.p[2]", counted from 1
  std::string name;
  std::optional<double> start;  ///< start value; by default that of the material
  /// bounds in addition to the key's declared range
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// A number of a material that may change.
class MaterialNumber {
 public:
  /// @param what      what errors call it: "parameter"
  /// @param options   the material's values
  /// @param sections  the same as text; the number's key is written into them, so that put() finds
  /// it
  /// @throws InputError for an unknown key, or a list without place
  MaterialNumber(const std::string& what, const std::string& name, const MaterialModel& model,
                 const MaterialOptions& options, MaterialSections& sections);

  /// Writes a value, as text, into the sections.
  void put(MaterialSections& sections, const std::string& value) const;

  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }
  const Range& range() const { return range_; }
  double value() const { return value_; }  ///< of the material

 private:
  std::string name_, section_, key_, unit_;
  std::size_t place_ = 0;  ///< in the key's values
  Range range_;
  double value_ = 0.0;
};

/// A number that a fit adjusts.
class FitParameter : public MaterialNumber {
 public:
  /// @throws InputError as MaterialNumber; for bounds or a start outside the key's range, and for a
  /// start at 0 whose size is not known
  FitParameter(const MaterialModel& model, const MaterialOptions& options,
               MaterialSections& sections, const FitParameterInput& input);

  double start() const { return start_; }
  double lower() const { return lower_; }  ///< -infinity without bound
  double upper() const { return upper_; }

 private:
  double start_ = 0.0, lower_ = 0.0, upper_ = 0.0;
};

/// A measured curve: the last segments of its path end at the measured points.
struct FitCurve {
  std::string name;
  /// values that only this sample has, with their text: "law.e0" and "0.58"
  std::vector<std::pair<MaterialNumber, std::string>> sample;
  PointPath path;
  std::string driven_by, driven_unit;  ///< the path's targets
  std::vector<double> driven;
  std::string channel;           ///< of point_channels(): what was measured
  std::vector<double> measured;  ///< NaN where there is none
  bool relative = false;         ///< compare logarithms
  /// standard deviation of a value (of its logarithm when relative); 0: unknown, the same for all
  double deviation = 0.0;
};

/// True if both curves belong to one path of one sample.
bool share_a_path(const FitCurve& one, const FitCurve& other);

/// The channel at the measured points of a path that was driven.
std::vector<double> curve_of(const Material& material, const PointHistory& history,
                             const FitCurve& curve);

}  // namespace furrow
