// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that makes a contact of a body with something other than grains.

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/base/roles/loss_ledger.h"
#include "coupling/base/fix_body.h"
#include "coupling/base/checks/high_friction.h"
#include "coupling/liggghts/styles/script.h"

namespace furrow::coupling {

class FixContact : public FurrowFix, public LossLedger {
 public:
  FixBody& body_fix() const { return body_fix_; }

 protected:
  /// @param schema with the key of declare_body()
  FixContact(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema)
      : FurrowFix(lammps, narg, arg, schema), body_fix_(use<FixBody>("body", {"wheel", "body"})) {
    if (body().surface().triangle_count() == 0)
      throw InputError(options().where("body"),
                       fmt::format("is '{}', which has no surface", options().text("body")),
                       "a wheel, a tyre or a plate");
    if (options().given("friction") && is_high_friction(options().number("friction")))
      warn(*lmp, high_friction(options().where("friction"), options().number("friction")));
    keep_state();
  }

  /// The key `body`.
  static void declare_body(Schema& schema) {
    schema.text("body", "id of the fix of the wheel, tyre or plate");
  }

  Body& body() const { return body_fix_.body(); }
  /// Factor from a sum over the computed half to outputs, which are those of the whole body.
  double symmetry_factor() const { return body().half_model() ? 2.0 : 1.0; }
  /// A force on the whole body, from that on the part that is computed.
  Vector3 to_whole(const Vector3& force) const {
    return body().half_model() ? Vector3(2.0 * force.x(), 0.0, 2.0 * force.z()) : force;
  }

 private:
  FixBody& body_fix_;
};

}  // namespace furrow::coupling
