// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that makes a contact of a body with a height field.

#include "coupling/base/roles/fix_scm.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/contact/fix_contact.h"

namespace furrow::coupling {

class FixFieldContact : public FixContact {
 public:
  const FixScm& terrain_fix() const { return terrain_fix_; }

 protected:
  /// @param schema with the keys of declare_body() and declare_field()
  FixFieldContact(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema)
      : FixContact(lammps, narg, arg, schema), terrain_fix_(use<FixScm>("terrain", {"scm"})) {
    require_unique<FixFieldContact>(
        *modify, options().subject(),
        fmt::format("presses '{}' on '{}'", body_fix().id, terrain_fix_.id),
        "one contact for each pair", [&](FixFieldContact& other) {
          return &other.body_fix() == &body_fix() && &other.terrain_fix_ == &terrain_fix_;
        });
  }

  /// The key `terrain`.
  static void declare_field(Schema& schema) {
    schema.text("terrain", "id of the fix of the height field");
  }

  HeightField& field() { return terrain_fix_.field(); }

 private:
  FixScm& terrain_fix_;
};

}  // namespace furrow::coupling
