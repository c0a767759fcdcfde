// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Checks in every step that forces on a body and on the grains it touches cancel.

#include <array>
#include <string>

#include "coupling/base/loads/contact_work.h"
#include "furrow/geometry/surface.h"

namespace furrow::coupling {

/// Forces of one body on the grains in one step: of this rank's contacts, then summed over ranks.
struct ContactLedger {
  Vector3 grain_force = Vector3::Zero();  ///< sum of contact forces on grains [N]
  /// sum of (contact point - reference) x force on grain [N m]
  Vector3 grain_moment = Vector3::Zero();
  /// moment that LIGGGHTS's shorter torque arm leaves out of the grains' balance [N m]
  Vector3 lever_gap = Vector3::Zero();
  double force_scale = 0.0;   ///< sum of |force| [N]
  double moment_scale = 0.0;  ///< sum of |contact point - reference| |force| [N m]
  double contacts = 0.0;
  ContactWork work_before = {};  ///< of the step before

  static constexpr std::size_t size = 12 + ContactWork::size;
  std::array<double, size> numbers() const;
  static ContactLedger from(const double* numbers);
};

/// Largest defects since the start of the run, each with its scale; a scale of zero means that
/// nothing has touched yet.
struct MomentumAudit {
  /// |nodal forces + grain forces|, sum of |contact force| [N]
  double force_imbalance = 0.0;
  double force_scale = 0.0;
  /// imbalance of moments about the middle of the body's nodes [N m]
  double moment_imbalance = 0.0;
  double moment_scale = 0.0;
  double force = 0.0;   ///< largest ratio of imbalance to scale in one step
  double moment = 0.0;  ///< largest ratio for moments
  /// |lever gap| / moment scale: not an error of the wall, see fix_wall_gran_body.md
  double lever_gap = 0.0;

  /// Takes one step into account. @param ledger of all ranks; moments are about reference
  /// @throws StateError when the defect is more than the rounding of the sums
  void add(const ContactLedger& ledger, const Surface& surface, const Vector3& reference,
           const std::string& body, long step);
};

}  // namespace furrow::coupling
