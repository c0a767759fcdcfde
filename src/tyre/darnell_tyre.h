// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The tyre of Shoop and Darnell (TR-01-16): a shell for the tread, sidewalls by chain or table, a
/// rigid rim.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bodies/rigid_plane.h"
#include "bodies/wheel_hub.h"
#include "shell/kinetic_damping.h"
#include "shell/shell4.h"
#include "tyre/sidewall_ring.h"
#include "tyre/sidewall_table.h"

namespace furrow {

/// How a tyre is computed.
struct DarnellTyreSettings {
  int across = 6;       ///< elements across the whole tread
  int around = 72;      ///< elements around
  bool half = false;    ///< only y >= 0, mirrored: for straight travel on symmetric ground
  bool direct = false;  ///< solve the chain at every station instead of looking it up
  /// rows of nodes on each side between bead and tread, for contact; 0: the tread alone can touch
  int sidewall_points = 4;
  double damping_rate = 100.0;  ///< [1/s] of motion relative to the rim, c in f = -c m (v - v_rim)
};

/// Makes the lookup table of a sidewall, or fetches one that was made before (io/sidewall_cache.h).
using SidewallTableMaker = std::function<std::unique_ptr<Sidewall>(
    const SidewallParameters&, double pressure, const SidewallTableGrid&)>;

/// How a tyre is brought to rest.
struct SettleOptions {
  /// largest unbalanced force on a node over the pressure's force on a node
  double tolerance = 1e-3;
  long max_steps = 400000;
  std::optional<double> axle_height = {};  ///< [m] where the axle goes, instead of a load
};

/// Rim and whatever else moves with it: everything but the tread band.
struct DarnellTyreHub {
  HubInertia inertia;
  Vector3 centre = Vector3::Zero();  ///< [m] of the axle at the start
};

/// Forces on the tread nodes: shell4.h, pressure, sidewall_ring.h, damping. What they sum up to
/// acts on the rim with the opposite sign, so momentum is kept to round-off. They have the
/// potential U_shell + sum w W - p V; the stored energy is counted from the state as made, so
/// inflating it is work of the pressure (load_work).
///
/// Damping is proportional to mass and acts on motion relative to the rim turning as a rigid body:
/// it neither resists rolling of an undeformed tyre nor falling. What it takes is the balance's
/// dissipated_energy.
///
/// The surface is the tread's mid-surface in triangles and, on each side, rows of nodes on the arc
/// of the sidewall's length over its chord. A force on such a node at the share s of the way from
/// bead to tread goes with s to the tread node and with 1 - s to the rim, and the rim takes the
/// moment that is left, so force and moment are kept. Its velocity v is the one that makes the
/// force's power the power of what it is handed to: v = s v_tread + (1 - s) V + Omega x (x - C - s
/// (x_tread - C)).
///
/// Weight of the tread: as everywhere in a rig the load on the axle includes it (rig/wheel_rig.h);
/// the tread knows no gravity.
class DarnellTyre : public WheelHub {
 public:
  /// @param make_table where the sidewalls' tables come from; without it they are made
  /// @throws InputError for settings or parameters that cannot be
  DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
              const DarnellTyreHub& hub, const std::string& where = "tyre",
              const SidewallTableMaker& make_table = {});

  const TyreParameters& parameters() const { return tyre_; }
  const DarnellTyreSettings& settings() const { return settings_; }
  double nominal_radius() const override { return tyre_.tread.radius; }
  double lowest_point() const override;  ///< of the undeformed tread about the present axle
  double total_mass() const override;
  Wrench ground_wrench() const override;

  double pressure() const { return pressure_; }
  /// Inflates to another pressure; the change of stored energy at the present shape is counted as
  /// load work. @throws StateError
  void set_pressure(double pressure);

  double stable_time_step() const override { return stable_step_; }
  void advance(double dt) override;
  using Body::surface;
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override;
  bool half_model() const override { return settings_.half; }
  void checkpoint(Checkpoint& state) override;

  /// Brings the tyre to rest under its pressure and its load (if z is free) on a plane, which may
  /// be null: dynamic relaxation. First the load, or the way of the axle, is applied gradually
  /// while the tread is damped viscously, near the critical rate of its edges, so that nothing
  /// swings far beyond its rest; then kinetic damping until the unbalanced force is below the
  /// tolerance. Time, works and dissipation are not counted; surface().f is as before.
  /// @throws StateError when max_steps do not suffice, and as advance()
  Relaxation settle(RigidPlane* plane, const SettleOptions& options = {});

  const ShellNodes& tread() const { return nodes_; }
  /// i around from the lowest point towards +x, j across towards +y
  int tread_node(int i, int j) const;
  int rows() const { return rows_; }  ///< elements across that are computed
  const Shell4& shell() const { return shell_; }
  std::vector<SidewallRing>& sidewalls() { return rings_; }
  RimPose rim() const { return {centre(), attitude()}; }
  /// [m^3] that the pressure acts on, but for a constant; whole tyre
  double air_volume() const { return volume_; }
  /// Largest width of the sidewalls' profiles, between both sides [m].
  double section_width();
  double largest_sidewall_chord() const;  ///< of the length: near 1 a sidewall is nearly stretched
  /// Force and moment about the axle centre of the tread on the rim, of the last step [N, N m]; of
  /// the whole tyre.
  const Vector3& rim_force() const { return rim_force_; }
  const Vector3& rim_moment() const { return rim_moment_; }

 private:
  struct Mesh;
  DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
              const DarnellTyreHub& hub, const SidewallTableMaker& make_table, Mesh mesh);
  // fills nodes_.force, nodes_.moment, potential_, rim_force_, rim_moment_
  void compute_internal();
  void add_damping();  // likewise
  void disturb();
  void add_contact();  // surface forces to nodes and to the rim
  double potential() const;
  void place_surface();
  void follow_placement(const Vector3& old_centre, const Matrix3& old_attitude) override;
  void follow_velocity() override;
  double kinetic_energy() const override;
  Vector3 rigid_velocity(const Vector3& at) const {
    return velocity() + angular_velocity().cross(at - centre());
  }
  void mirror(Vector3& force, Vector3& moment) const;  // of the computed half to the whole

  TyreParameters tyre_;
  DarnellTyreSettings settings_;
  int rows_;
  double share_;  // computed parts in the whole: 2 for a half model
  ShellNodes nodes_;
  Matrix3X reference_;  // tread nodes about the axle centre
  Shell4 shell_;
  std::vector<SidewallRing> rings_;
  Surface surface_;
  double pressure_ = 0.0, stable_step_ = 0.0, force_scale_ = 1.0;

  // internal, of the whole tyre
  Vector3 rim_force_ = Vector3::Zero(), rim_moment_ = Vector3::Zero();
  // handed to the rim by sidewall nodes
  Vector3 contact_on_rim_ = Vector3::Zero(), contact_moment_ = Vector3::Zero();
  Matrix3X damping_force_, damping_moment_, contact_;
  double volume_ = 0.0, stored_ = 0.0, zero_ = 0.0;
  double contact_work_ = 0.0, inflation_work_ = 0.0, damped_ = 0.0;
};

}  // namespace furrow
