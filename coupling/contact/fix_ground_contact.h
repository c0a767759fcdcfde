// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that makes a contact of a body with the ground of a line terrain/...

#include <string>

#include "coupling/base/roles/ground.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/contact/fix_contact.h"

namespace furrow::coupling {

class FixGroundContact : public FixContact {
 public:
  virtual const Terrain& ground() const = 0;
  /// True if forces converge with the cells of the ground.
  virtual bool needs_fine_cells() const { return true; }

 protected:
  using FixContact::FixContact;
};

/// Contact with ground of one class of fixes.
template <class TerrainFix>
class FixContactWith : public FixGroundContact {
 public:
  TerrainFix& terrain_fix() const { return terrain_fix_; }
  const Terrain& ground() const override { return terrain_fix_; }

 protected:
  /// @param schema with the keys of declare_body() and `terrain` @param kind of the ground's style
  FixContactWith(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
                 const char* kind)
      : FixGroundContact(lammps, narg, arg, schema),
        terrain_fix_(use<TerrainFix>("terrain", {kind})) {
    require_unique<FixContactWith>(
        *modify, options().subject(),
        fmt::format("presses '{}' on '{}'", body_fix().id, terrain_fix_.id),
        "one contact for each pair", [&](FixContactWith& other) {
          return &other.body_fix() == &body_fix() && &other.terrain_fix_ == &terrain_fix_;
        });
  }

 private:
  TerrainFix& terrain_fix_;
};

}  // namespace furrow::coupling
