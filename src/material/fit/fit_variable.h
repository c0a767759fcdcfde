// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One parameter of a fit: its place among the values of a material, and the variables of the
/// method.
///
///   value  <->  z, scaled: ln(value) where only positive values are allowed, else value/scale
///   z      <->  t, unbounded: z = low + (high - low)(1 + tanh t)/2 between two bounds, else z = t
///   up to the one bound

#include <string>
#include <utility>

#include "material/fit/calibration.h"
#include "material/registry.h"

namespace furrow {

class FitVariable {
 public:
  /// @param options   the material's values
  /// @param sections  the same as text; the parameter's key is written into them, so that put()
  /// finds it
  /// @throws InputError for an unknown key, a list without place, bounds or a start outside the
  /// key's range
  FitVariable(const MaterialModel& model, const MaterialOptions& options,
              MaterialSections& sections, const FitParameter& parameter);

  double start_t() const;
  double z_of_t(double t) const;
  double value_of(double z) const;
  /// Writes the value of z into the sections.
  void put(MaterialSections& sections, double z) const;
  /// z - step and z + step, inside the bounds.
  std::pair<double, double> around(double z, double step) const;
  /// "stands at its upper bound 0.04", or empty
  std::string bound_met(double z) const;

  const std::string& unit() const { return unit_; }
  double start() const { return start_; }
  double scale() const { return scale_; }  ///< of z = value/scale
  bool logarithmic() const { return logarithmic_; }

 private:
  double z_of(double value) const;
  bool bounded() const;  ///< on both sides

  std::string section_, key_, unit_;
  std::size_t place_ = 0;  ///< in the key's values
  double start_ = 0.0, lower_ = 0.0, upper_ = 0.0, scale_ = 1.0;
  double low_ = 0.0, high_ = 0.0;  ///< lower and upper as z
  bool logarithmic_ = false;
};

}  // namespace furrow
