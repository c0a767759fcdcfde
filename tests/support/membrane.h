// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A light elastic skin: constant-strain triangles without bending stiffness, for inflated covers
/// and flexible walls.

#include <vector>

#include "furrow/bodies/body.h"

namespace furrow {

/// Material and thickness of a membrane.
struct MembraneMaterial {
  double young = 0.0;         ///< E [Pa]
  double poisson = 0.0;       ///< nu [-]
  double thickness = 0.0;     ///< h [m]
  double density = 0.0;       ///< rho [kg/m^3]; areal mass rho h
  double damping_rate = 0.0;  ///< mass-proportional damping c in f = -c m v [1/s]
};

/// Plane-stress St Venant-Kirchhoff membrane, total Lagrangian, lumped mass, explicit.
/// Second Piola-Kirchhoff stress S = E/(1 - nu^2) [(1 - nu) G + nu tr(G) I] of the in-plane Green
/// strain G = (F^T F - I)/2.
class Membrane : public Body {
 public:
  /// @param reference stress-free shape; its x is also the start
  /// @param fixed_nodes do not move
  /// @throws InputError for a material out of range, StateError for a degenerate triangle
  Membrane(Surface reference, const MembraneMaterial& material, std::vector<int> fixed_nodes);

  /// Follower pressure on the inner side: pushes along the outward normals [Pa].
  void set_pressure(double pressure) { pressure_ = pressure; }

  double stable_time_step() const override;
  void advance(double dt) override;
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override;
  void checkpoint(Checkpoint& state) override;

 private:
  struct Element {
    // gradients of the three shape functions in the element's plane axes [1/m]
    Eigen::Matrix<double, 2, 3> gradient;
    double volume;  // reference area times thickness [m^3]
  };
  void compute_forces();

  Surface surface_;
  MembraneMaterial material_;
  std::vector<Element> elements_;
  VectorX mass_;                        // [kg] lumped
  VectorX mobility_;                    // 1/mass, or zero for a fixed node
  Matrix3X internal_, pressure_force_;  // [N] at the start of the step
  double pressure_ = 0.0;
  double shortest_altitude_ = 0.0;
  double elastic_energy_ = 0.0;
  double contact_work_ = 0.0, pressure_work_ = 0.0, damped_ = 0.0;
};

}  // namespace furrow
