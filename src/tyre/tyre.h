// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interface of tyres for fixes, rigs and programs, independent of their construction.
///
/// Another kind of tyre needs three parts: a class that derives from Tyre or NodalTyre
/// (nodal_tyre.h), a reader of its files (as io/inputs/tyre_file.h), and a fix style that derives
/// from coupling/wheels/fix_tyre.h. The parts in this folder that do not depend on the kind:
/// sidewalls (sidewall_ring.h), surface and contact hand-over (tyre_surface.h), damping
/// (node_step.h), footprint (contact_patch.h), and shell/dynamic_relaxation.h.

#include <optional>

#include "furrow/bodies/rigid_plane.h"
#include "furrow/bodies/wheel_hub.h"
#include "furrow/shell/dynamic_relaxation.h"
#include "furrow/shell/natural_modes.h"
#include "furrow/tyre/tread_grid.h"

namespace furrow {

/// Settings of the relaxation of a tyre to rest.
struct SettleOptions {
  /// largest unbalanced force on a node over the pressure's force on a node
  double tolerance = 1e-3;
  long max_steps = 400000;
  std::optional<double> axle_height = {};  ///< [m] final height of the axle, instead of a load
};

/// An inflated, deformable wheel on a rim, which is the hub. A half model (half_model()) computes
/// y >= 0 only; whatever it reports of forces, moments, energies and masses is that of the whole.
class Tyre : public WheelHub {
 public:
  virtual double pressure() const = 0;  ///< [Pa] above the atmosphere
  /// Inflates to another pressure; the change of stored energy at the present shape is counted as
  /// load work. @throws StateError
  virtual void set_pressure(double pressure) = 0;

  /// Brings the tyre to rest by dynamic relaxation, under its pressure and its load (if z is free)
  /// on a plane, which may be null. The load, or the travel of the axle, is applied gradually.
  /// Time, works and dissipation are not counted; surface().f is as before.
  /// @throws StateError when max_steps do not suffice, and as advance()
  Relaxation settle(RigidPlane* plane, const SettleOptions& options = {});

  /// Small undamped vibrations of the tread about the present state, in which the tyre is at rest,
  /// not turning; the rim is held, and so are nodes that press on a plane.
  /// @param plane that it stands on, or null
  /// @returns shapes at the nodes of tread_grid()
  /// @throws InputError for a half model, which has half of the modes, and as natural_modes() of
  /// shell/natural_modes.h
  NaturalModes natural_modes(const RigidPlane* plane, int count);

  /// Nodes of the outside of the tread. They are the first of surface(), in the grid's order.
  virtual const TreadGrid& tread_grid() const = 0;
  double lowest_tread_height() const;  ///< [m] z of the lowest node of the tread
  /// Deflection of the lowest node of the tread, from the unloaded tread about the present axle
  /// [m].
  double deflection() const override { return lowest_tread_height() - lowest_point(); }
  double crown_radius() const;              ///< [m] mean distance of the middle line from the axle
  virtual double section_width() = 0;       ///< [m] largest, from sidewall to sidewall
  virtual double tread_energy() const = 0;  ///< [J] elastic
  virtual double tread_mass() const = 0;    ///< mass of the tread per area [kg/m^2]
  /// chord over length of the sidewall that is stretched most: near 1 it is nearly straight
  virtual double largest_sidewall_chord() const = 0;

 protected:
  using WheelHub::WheelHub;

 private:
  /// settle() without the refusal of what has not converged.
  virtual Relaxation relax(RigidPlane* plane, const SettleOptions& options) = 0;
  /// natural_modes() with nodes of the tread held.
  virtual NaturalModes modes_with(const std::vector<int>& held, int count) = 0;
};

}  // namespace furrow
