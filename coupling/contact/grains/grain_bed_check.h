// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Do grains, speed and box leave the range in which results are known to hold? Warnings, never
/// errors.

#include <string>

#include "furrow/bodies/body.h"
#include "furrow/geometry/surface.h"
#include "lammps.h"

namespace furrow::coupling {

/// Limits with the study that shows them: inputs/validation/grains/README.md.
struct GrainBedLimits {
  static constexpr double min_grains = 100;  ///< fewer are no bed: a few grains meet a body
  static constexpr double overlap = 0.05;    ///< of a grain's diameter, elastic contacts
  /// overlap of clusters of snow (model snow/bond); beyond it they are denser than solid ice
  static constexpr double snow_overlap = 0.4;
  /// speed / length x diameter x sqrt(grain density / pressure) under a body
  static constexpr double inertial_number = 0.05;
  static constexpr double grains_per_width = 8.0;  ///< width of the body over mean diameter
  static constexpr double bed_widths = 2.0;        ///< width of the bed over width of the body
};

/// Watches the contact of one body with grains; each kind of warning comes once in a run.
class GrainBedCheck {
 public:
  /// @param where names the wall in messages
  GrainBedCheck(LAMMPS_NS::LAMMPS& lammps, std::string where)
      : lammps_(lammps), where_(std::move(where)) {}

  /// Size of grains and bed against the width of the body, but for terrain that carries the bed.
  /// Collective.
  /// @param terrain  that carries the bed, and may continue it beside the grains; may be null
  void start(const Body& body, const Body* terrain);
  /// Records a contact of this rank in this step.
  void contact(double overlap, double radius, const Vector3& point, const Vector3& force);
  /// Ends the contacts of a step; checks them every so many steps. Collective.
  void finish_step(const Surface& surface);

 private:
  void choose_overlap_limit();
  std::string overlap_remedy(double deepest) const;
  void warn(bool& done, const std::string& text);

  LAMMPS_NS::LAMMPS& lammps_;
  std::string where_;
  // overlap limit over a grain's diameter; infinite for plastic contacts, which overlap by design
  double overlap_limit_ = 0.0;
  double mean_diameter_ = 0.0, density_ = 0.0;
  double deepest_ = 0.0;
  Vector3 force_ = Vector3::Zero(), lower_, upper_;
  long steps_ = 0;
  bool looks_ = false, warned_overlap_ = false, warned_inertia_ = false;
};

}  // namespace furrow::coupling
