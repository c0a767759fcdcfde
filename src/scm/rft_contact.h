// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of a rigid body with sand by three-dimensional resistive force theory (theory: rft).

#include "furrow/bodies/body.h"
#include "furrow/bodies/contact.h"
#include "furrow/scm/height_field.h"

namespace furrow {

/// The force on a face depends on its depth below the height field, on its normal and on the
/// direction in which it has moved lately. The field stays as it is. The body must be replicated
/// and its surface closed: every rank computes the same.
class RftContact : public Contact {
 public:
  struct Settings {
    double strength = 0.0;     ///< xi [N/m^3]
    double friction = 0.0;     ///< of the body's surface and the sand
    double slip_length = 0.0;  ///< K [m], by which a face moves until the sand resists
    bool records = true;       ///< true if this rank adds forces to the contact record of the body
  };
  /// Results of the last apply().
  struct Step {
    Vector3 force = Vector3::Zero();  ///< on the body [N]
    double area = 0.0;                ///< of the faces that press on sand [m^2]
    double pressure = 0.0;            ///< largest of a face [Pa]
    double sinkage = 0.0;             ///< largest depth of a node [m]
  };
  /// Losses since the start [J].
  struct Losses {
    double pressure = 0.0;  ///< work of the pressure
    double shear = 0.0;     ///< work of the stress along the faces
  };

  /// Body and field must outlive the contact.
  RftContact(Body& body, const HeightField& field, const Settings& settings);

  /// @throws StateError when the body reaches an edge of the field
  void apply(double dt) override;
  const Step& step() const { return step_; }
  const Losses& losses() const { return losses_; }
  void checkpoint(Checkpoint& state);

 private:
  void find_depths();
  void press(std::size_t triangle, double dt);

  Body& body_;
  const HeightField& field_;
  Settings settings_;
  Step step_;
  Losses losses_;
  double longest_edge_ = 0.0;  // [m]
  VectorX depth_;              // of each node below the surface [m]; near it exact
  Matrix3X direction_;  // direction of motion of each triangle; shorter than 1 after a recent start
};

}  // namespace furrow
