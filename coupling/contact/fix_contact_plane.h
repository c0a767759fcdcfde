// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix contact/plane: a body on a rigid level floor, without grains. See fix_contact_plane.md.

#include "furrow/bodies/rigid_plane.h"
#include "coupling/contact/fix_contact.h"

namespace furrow::coupling {

class FixContactPlane : public FixContact {
 public:
  FixContactPlane(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static const Outputs<FixContactPlane>& outputs();

  void add_losses(const Body& wheel, GroundLosses& losses) const override {
    if (&wheel == &body()) losses.friction += symmetry_factor() * contact_.plane.friction_loss();
  }
  void init() override {
    collectively([&] { check_tyre_stability(); });
  }

 private:
  struct PlaneContact : public Contact {
    PlaneContact(Body& touching, const Options& options);
    /// @throws StateError when the body starts in the floor, or sinks into it
    void apply(double dt) override;

    Body& body;
    RigidPlane plane;
    bool begun = false;  ///< the body did not start inside the floor
  };
  void check_tyre_stability();
  void checkpoint(Checkpoint& state) override {
    contact_.plane.checkpoint(state);
    state.value("begun", contact_.begun);
  }

  PlaneContact contact_;
};

}  // namespace furrow::coupling
