// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The tyre of Shoop and Darnell [Shoop2001]: a shell for the tread, sidewalls by chain or table, a
/// rigid rim.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shell/shell4.h"
#include "tyre/rim_damping.h"
#include "tyre/sidewall_ring.h"
#include "tyre/sidewall_table.h"
#include "tyre/tread_mesh.h"
#include "tyre/tyre.h"
#include "tyre/tyre_surface.h"

namespace furrow {

/// How a tyre is computed.
struct DarnellTyreSettings {
  int across = 6;       ///< elements across the whole tread
  int around = 72;      ///< elements around
  bool half = false;    ///< only y >= 0, mirrored: for straight travel on symmetric ground
  bool direct = false;  ///< solve the chain at every station instead of looking it up
  /// rows of nodes on each side between bead and tread, for contact; 0: the tread alone can touch
  int sidewall_rows = 4;
  double damping_rate = 100.0;  ///< [1/s] c of rim_damping.h
};

/// @throws InputError for settings that cannot be
void check(const DarnellTyreSettings& settings, const std::string& where = "tyre");

/// Makes the lookup table of a sidewall, or fetches one that was made before (io/sidewall_cache.h).
using SidewallTableMaker = std::function<std::unique_ptr<Sidewall>(
    const SidewallParameters&, double pressure, const SidewallTableGrid&)>;

/// On the nodes of the tread act the shell (shell4.h), the pressure, the sidewalls
/// (sidewall_ring.h) and the damping (rim_damping.h). What these sum up to acts on the rim with the
/// opposite sign, so momentum is kept to round-off. Without the damping they have the potential
/// U_shell + sum w W - p V; the stored energy is counted from the state as made, so inflating the
/// tyre is work of the pressure (load_work).
///
/// Contact: tyre_surface.h. Weight: the load on the axle includes that of the tread
/// (rig/wheel_rig.h); the tread knows no gravity.
class DarnellTyre : public Tyre {
 public:
  /// @param hub the rim and whatever else moves with it: everything but the tread band
  /// @param where names the tyre in errors
  /// @param make_table where the sidewalls' tables come from; without it they are made
  /// @throws InputError for settings or parameters that cannot be
  DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
              const HubParameters& hub, const std::string& where = "tyre",
              const SidewallTableMaker& make_table = {});

  const TyreParameters& parameters() const { return tyre_; }
  const DarnellTyreSettings& settings() const { return settings_; }
  const ShellNodes& tread() const { return nodes_; }

  // Body
  double stable_time_step() const override { return stable_step_; }
  void advance(double dt) override;
  using Body::surface;
  Surface& surface() override { return surface_.surface(); }
  EnergyBudget energy_budget() const override;
  bool half_model() const override { return settings_.half; }
  void checkpoint(Checkpoint& state) override;

  // WheelHub
  double nominal_radius() const override { return tyre_.tread.radius; }
  double lowest_point() const override;  ///< of the undeformed tread about the present axle
  double total_mass() const override;
  Wrench ground_wrench() const override;

  // Tyre
  double pressure() const override { return pressure_; }
  void set_pressure(double pressure) override;
  const TreadGrid& tread_grid() const override { return grid_; }
  double section_width() override;
  double tread_energy() const override { return copies_ * shell_.energy(); }
  double tread_mass() const override { return tyre_.tread.areal_mass; }
  double largest_sidewall_chord() const override;

 private:
  void step(double dt);
  class Relaxing;  // as shell/dynamic_relaxation.h sees it

  DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
              const HubParameters& hub, const SidewallTableMaker& make_table, TreadMesh mesh);
  void hold_symmetry_plane();
  std::vector<SidewallRing> make_rings(const SidewallTableMaker& make_table) const;

  void compute_internal();
  void compute_contact();
  double potential() const;
  void count_stored_energy() { stored_ = potential() - zero_; }
  RimPose rim() const { return {centre(), attitude()}; }
  void place_surface() { surface_.place(nodes_, rings_, *this); }
  Wrench of_whole(const Wrench& computed) const;

  Relaxation relax(RigidPlane* plane, const SettleOptions& options) override;
  NaturalModes modes_with(const std::vector<int>& held, int count) override;
  void follow_placement(const Vector3& old_centre, const Matrix3& old_attitude) override;
  void follow_velocity() override;
  double kinetic_energy() const override;

  TyreParameters tyre_;
  DarnellTyreSettings settings_;
  TreadGrid grid_;
  double copies_;       // computed parts in the whole: 2 for a half model
  ShellNodes nodes_;    // of the tread
  Matrix3X reference_;  // [m] the same about the axle centre, stress-free
  Shell4 shell_;
  std::vector<SidewallRing> rings_;
  TyreSurface surface_;
  RimDamping damping_;
  double pressure_;     // [Pa]
  double stable_step_;  // [s]

  // Of the present step
  double volume_ = 0.0;     // [m^3] of the air, but for a constant; of the whole tyre
  Wrench internal_on_rim_;  // by shell, pressure and sidewalls, of the whole tyre
  Wrench contact_on_rim_;   // handed over by nodes of the sidewalls, of the whole tyre
  Matrix3X contact_;        // [N] on the nodes of the tread

  // [J] of the whole tyre
  double zero_ = 0.0;    // potential in the state as made
  double stored_ = 0.0;  // potential beyond it
  double contact_work_ = 0.0;
  double inflation_work_ = 0.0;
  double damped_ = 0.0;
};

}  // namespace furrow
