// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/plane: a body on a rigid level floor, without grains. See fix_contact_plane.md.

#include "bodies/rigid_plane.h"
#include "coupling/contact/fix_contact.h"

namespace furrow::coupling {

class FixContactPlane : public FixContact {
 public:
  FixContactPlane(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixContactPlane>& outputs();

 private:
  struct PlaneContact : public Contact {
    PlaneContact(Body& touching, const Options& options);
    void apply(double) override { plane.press_on(body.surface()); }

    Body& body;
    RigidPlane plane;
  };
  /// Where nodes stick.
  void checkpoint(Checkpoint& state) override { contact_.plane.checkpoint(state); }

  PlaneContact contact_;
};

}  // namespace furrow::coupling
