// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that makes a contact of a body with a height field.

#include "coupling/base/roles/fix_scm.h"
#include "coupling/contact/fix_ground_contact.h"

namespace furrow::coupling {

class FixFieldContact : public FixContactWith<FixScm> {
 protected:
  FixFieldContact(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema)
      : FixContactWith(lammps, narg, arg, schema, "scm") {}

  /// The key `terrain`.
  static void declare_field(Schema& schema) {
    schema.text("terrain", "id of the fix of the height field");
  }

  HeightField& field() { return terrain_fix().field(); }
};

}  // namespace furrow::coupling
