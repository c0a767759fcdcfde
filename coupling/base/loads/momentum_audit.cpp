// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/loads/momentum_audit.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow::coupling {

namespace {

// Tolerance over the force scale: round-off of the sums, nothing else
constexpr double momentum_tolerance = 1e-10;

}  // namespace

std::array<double, ContactLedger::size> ContactLedger::numbers() const {
  return {grain_force.x(),   grain_force.y(),  grain_force.z(),      grain_moment.x(),
          grain_moment.y(),  grain_moment.z(), lever_gap.x(),        lever_gap.y(),
          lever_gap.z(),     force_scale,      moment_scale,         contacts,
          work_before.press, work_before.push, work_before.friction, work_before.contact};
}

ContactLedger ContactLedger::from(const double* n) {
  return {{n[0], n[1], n[2]},       {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9], n[10], n[11],
          ContactWork::from(n + 12)};
}

void MomentumAudit::add(const ContactLedger& ledger, const Surface& surface,
                        const Vector3& reference, const std::string& body, long step) {
  if (ledger.force_scale == 0.0) return;
  const double force_now = (surface.total_force() + ledger.grain_force).norm();
  const double moment_now = (surface.total_moment(reference) + ledger.grain_moment).norm();
  const double force_defect = force_now / ledger.force_scale;
  const double moment_defect = moment_now / ledger.moment_scale;
  // Comparison written so that NaN fails too.
  if (!(force_defect < momentum_tolerance) || !(moment_defect < momentum_tolerance))
    throw StateError(fmt::format(
        "body '{}': forces on its nodes and on the grains do not cancel at step {}: relative "
        "defect {:.3g} in force, {:.3g} in moment (limit {:g}); a contact force is not finite or "
        "was lost",
        body, step, force_defect, moment_defect, momentum_tolerance));
  force_imbalance = std::max(force_imbalance, force_now);
  force_scale = std::max(force_scale, ledger.force_scale);
  moment_imbalance = std::max(moment_imbalance, moment_now);
  moment_scale = std::max(moment_scale, ledger.moment_scale);
  force = std::max(force, force_defect);
  moment = std::max(moment, moment_defect);
  lever_gap = std::max(lever_gap, ledger.lever_gap.norm() / ledger.moment_scale);
}

}  // namespace furrow::coupling
