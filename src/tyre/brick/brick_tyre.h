// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A tyre with a tread of rubber, after the modal-analysis models of [Shoop2001]: a carcass of
/// shells from bead to bead, on it a tread of bricks, smooth, ribbed or lugged.

#include <algorithm>
#include <string>
#include <vector>

#include "furrow/tyre/brick/brick_tyre_mesh.h"
#include "furrow/tyre/nodal_tyre.h"

namespace furrow {

/// Mesh, symmetry and damping of a tyre.
struct BrickTyreSettings {
  int sections = 120;           ///< round the tyre; the mesh across follows (brick_tyre_mesh.h)
  bool half = false;            ///< only y >= 0, mirrored: for straight travel on symmetric ground
  double damping_rate = 100.0;  ///< [1/s] c of node_step.h
};

/// @throws InputError for settings that cannot be
void check(const BrickTyreSettings& settings, const std::string& where = "tyre");

/// Shells (shell4.h), one for each zone of the carcass, bricks (brick8.h) and the pressure inside
/// the carcass act on the nodes. The rim carries the beads. The pressure on carcass and rim
/// together has no resultant, so the rim takes the opposite of all forces on the nodes.
class BrickTyre : public NodalTyre {
 public:
  /// @param hub the rim and whatever else moves with it
  /// @param where names the tyre in errors
  /// @throws InputError for settings or parameters that cannot be
  BrickTyre(const BrickTyreParameters& tyre, const BrickTyreSettings& settings,
            const HubParameters& hub, const std::string& where = "tyre");

  const BrickTyreParameters& parameters() const { return tyre_; }
  const BrickTyreSettings& settings() const { return settings_; }
  /// Smallest volume of the rubber over its stress-free one, at a Gauss point.
  double minimum_volume_ratio() const { return bricks_.minimum_volume_ratio(); }

  // Body
  double stable_time_step() const override;
  using Body::surface;
  Surface& surface() override { return surface_; }
  void checkpoint(Checkpoint& state) override;

  // WheelHub
  double nominal_radius() const override { return tyre_.radius(); }
  double nominal_width() const override { return tyre_.width(); }
  double narrowest_groove() const override {
    return std::min(tyre_.tread.narrowest_void(tyre_.radius()),
                    tyre_.tread.narrowest_rib(tyre_.radius()));
  }

  // Tyre
  const TreadGrid& tread_grid() const override { return mesh_.grid; }
  double section_width() override;  ///< of the carcass's mid-surface
  double tread_energy() const override { return copies() * bricks_.energy(); }
  double tread_mass() const override { return tread_mass_; }
  double largest_sidewall_chord() const override;

 private:
  BrickTyre(const BrickTyreParameters& tyre, const BrickTyreSettings& settings,
            const HubParameters& hub, BrickTyreMesh mesh);

  Internal add_internal_forces() override;
  void place_surface() override;
  Wrench hand_over(Matrix3X& on_nodes) override;
  double tread_area() const override { return mesh_.tread_area; }
  Vector3 unloaded_tread_point(int line) const override;
  NodeNeighbours neighbours() const override;
  Eigen::Index tread_node(int k) const override {
    return mesh_.surface_nodes[static_cast<std::size_t>(k)];
  }
  double relaxation_step() const override;
  /// [s] @param reserve of the bricks' own step
  double step_with(double reserve) const;
  void set_tread_mass();

  BrickTyreParameters tyre_;
  BrickTyreSettings settings_;
  BrickTyreMesh mesh_;
  std::vector<Shell4> shells_;
  Brick8 bricks_;
  Surface surface_;
  double tread_mass_ = 0.0;  // [kg/m^2] least, of a node on the outside
};

}  // namespace furrow
