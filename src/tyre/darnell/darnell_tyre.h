// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The tyre of Shoop and Darnell [Shoop2001]: a shell for the tread, sidewalls by chain or table, a
/// rigid rim.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "furrow/shell/shell4.h"
#include "furrow/tyre/nodal_tyre.h"
#include "furrow/tyre/sidewall/sidewall_ring.h"
#include "furrow/tyre/sidewall/sidewall_table.h"
#include "furrow/tyre/darnell/tread_mesh.h"
#include "furrow/tyre/darnell/tyre_surface.h"

namespace furrow {

/// Mesh, symmetry and damping of a tyre.
struct DarnellTyreSettings {
  int across = 6;       ///< elements across the whole tread
  int around = 72;      ///< elements around
  bool half = false;    ///< only y >= 0, mirrored: for straight travel on symmetric ground
  bool direct = false;  ///< solve the chain at every station instead of looking it up
  /// rows of nodes on each side between bead and tread, for contact; 0: the tread alone can touch
  int sidewall_rows = 4;
  double damping_rate = 100.0;  ///< [1/s] c of node_step.h
};

/// @throws InputError for settings that cannot be
void check(const DarnellTyreSettings& settings, const std::string& where = "tyre");

/// Makes the lookup table of a sidewall or reads a stored one (io/inputs/sidewall_cache.h).
using SidewallTableMaker = std::function<std::unique_ptr<Sidewall>(
    const SidewallParameters&, double pressure, const SidewallTableGrid&)>;

/// The nodes are those of the tread (nodal_tyre.h). The shell (shell4.h), the pressure and the
/// sidewalls (sidewall_ring.h) act on them. Contact: tyre_surface.h.
class DarnellTyre : public NodalTyre {
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
  const ShellNodes& tread() const { return nodes(); }

  // Body
  double stable_time_step() const override { return shell_.stable_time_step(); }
  using Body::surface;
  Surface& surface() override { return surface_.surface(); }
  void checkpoint(Checkpoint& state) override;

  // WheelHub
  double nominal_radius() const override { return tyre_.tread.radius; }
  double nominal_width() const override { return 2.0 * tyre_.tread.half_width; }

  // Tyre
  const TreadGrid& tread_grid() const override { return grid_; }
  double section_width() override;
  double tread_energy() const override { return copies() * shell_.energy(); }
  double tread_mass() const override { return tyre_.tread.areal_mass; }
  double largest_sidewall_chord() const override;

 private:
  DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
              const HubParameters& hub, const SidewallTableMaker& make_table, TreadMesh mesh);
  std::vector<SidewallRing> make_rings(const SidewallTableMaker& make_table) const;
  RimPose rim() const { return {centre(), attitude()}; }

  Internal add_internal_forces() override;
  void follow_pressure() override;
  void place_surface() override { surface_.place(nodes_, rings_, *this); }
  Wrench hand_over(Matrix3X& on_nodes) override;
  double tread_area() const override {
    return 2.0 * pi * tyre_.tread.radius * 2.0 * tyre_.tread.half_width;
  }
  Vector3 unloaded_tread_point(int line) const override {
    return reference().col(grid_.node(0, line));
  }
  NodeNeighbours neighbours() const override {
    return neighbours_of(shell_.quads(), nodes_.count());
  }
  Eigen::Index tread_node(int k) const override { return k; }

  TyreParameters tyre_;
  DarnellTyreSettings settings_;
  TreadGrid grid_;
  Shell4 shell_;
  std::vector<SidewallRing> rings_;
  TyreSurface surface_;
};

}  // namespace furrow
