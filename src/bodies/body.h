// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interface of every solver in the coupled system: rigid wheel, tyre, continuum terrain.

#include <string>

#include "furrow/bodies/contact_record.h"
#include "furrow/core/checkpoint.h"
#include "furrow/geometry/surface.h"
#include "furrow/core/types.h"

namespace furrow {

/// Momentum and energy of a body, for the audit. Works are accumulated from the start of the run.
struct EnergyBudget {
  Vector3 momentum = Vector3::Zero();  ///< [kg m/s]
  double kinetic_energy = 0.0;         ///< [J]
  double stored_energy = 0.0;          ///< [J] elastic
  double dissipated_energy = 0.0;      ///< [J] inside the body
  double contact_work = 0.0;           ///< [J] done on the body by its surface forces
  double load_work = 0.0;              ///< [J] done on the body by loads and gravity
  /// work [J] on the body by the drive that prescribes its motion or torque
  double drive_work = 0.0;
  /// [J] kinetic energy that the discretisation removes; < 0: it adds energy
  double numerical_loss = 0.0;

  /// Zero for an exact integrator, up to the energy the body started with.
  double residual() const {
    return contact_work + load_work + drive_work - kinetic_energy - stored_energy -
           dissipated_energy - numerical_loss;
  }
};

/// A body advances under the forces on its surface and its own loads. Wheels and tyres are
/// replicated: every rank holds the whole body and computes the same values. The continuum terrain
/// is distributed over the ranks, and its functions are collective. The surface is always
/// replicated.
class Body {
 public:
  virtual ~Body() = default;

  /// Largest step that is stable with the present state [s]; infinity for a rigid body.
  virtual double stable_time_step() const = 0;
  /// Advances by one step under surface().f (held constant) and the body's own loads. @throws
  /// StateError
  virtual void advance(double dt) = 0;
  /// Called around the steps that make up an interval of the system: what a body reports of "the
  /// last step" is then the mean over the interval. Where it is touched, contacts read surface() in
  /// every step; else the surface need not follow until the end.
  virtual void begin_interval(bool /*touched*/) {}
  virtual void end_interval() {}
  virtual Surface& surface() = 0;
  const Surface& surface() const { return const_cast<Body*>(this)->surface(); }
  virtual EnergyBudget energy_budget() const = 0;
  /// True when the surface is the half y >= 0 of a body that is its own mirror image in y = 0;
  /// loads and energy budget are those of the whole.
  virtual bool half_model() const { return false; }

  /// Record that receives each contact of this body; not owned, may be null.
  void set_contact_record(ContactRecord* record) { contact_record_ = record; }
  ContactRecord* contact_record() const { return contact_record_; }

  /// Saves or restores everything needed to continue exactly. Collective for a distributed body.
  /// @throws Error when the saved state belongs to another body
  virtual void checkpoint(Checkpoint& state) = 0;

 private:
  ContactRecord* contact_record_ = nullptr;
};

}  // namespace furrow
