// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base of tyres that are nodes around a rigid rim: motion, equilibrium and energy balance,
/// independent of the elements.

#include <vector>

#include "furrow/shell/shell_nodes.h"
#include "furrow/tyre/node_step.h"
#include "furrow/tyre/tyre.h"

namespace furrow {

/// Internal forces of elements and pressure, and the damping (node_step.h), act on the nodes. The
/// rim takes the opposite of their sum, so momentum is conserved to rounding. Without damping they
/// have the potential U - p V (theory: tyres, eq. 5). The stored energy counts from the state as
/// made, so the inflation is work of the pressure (load_work).
///
/// Beads are nodes that move with the rim: forces on them act on the rim, and the rim's mass
/// includes theirs.
///
/// Weight: the load on the axle includes that of the tyre (rig/wheel_rig.h); nodes know no gravity.
class NodalTyre : public Tyre {
 public:
  const ShellNodes& nodes() const { return nodes_; }

  // Body
  void advance(double dt) override;
  EnergyBudget energy_budget() const override;
  bool half_model() const override { return tread_grid().half; }
  void begin_interval(bool touched) override;
  void end_interval() override;

  // WheelHub
  double lowest_point() const override;  ///< of the undeformed tread about the present axle
  double total_mass() const override;
  Wrench ground_wrench() const override;

  // Tyre
  double pressure() const override { return pressure_; }
  void set_pressure(double pressure) override;

 protected:
  /// Shape, pressure and damping from which a tyre is made.
  struct Making {
    Matrix3X reference;         ///< [m] stress-free nodes about the axle centre
    double pressure = 0.0;      ///< [Pa]
    double damping_rate = 0.0;  ///< [1/s] c of node_step.h
  };
  NodalTyre(const HubParameters& hub, const Making& making);
  /// Completes a constructor, when masses and supports are set.
  /// @throws InputError for a rim too light for its tyre
  void start();

  /// Energy and volume of the computed part.
  struct Internal {
    double energy = 0.0;  ///< [J] elastic
    double volume = 0.0;  ///< [m^3] of the air, but for a constant
  };
  /// Adds the forces of elements and of pressure() to nodes_. @throws StateError
  virtual Internal add_internal_forces() = 0;
  /// Called when the pressure has changed.
  virtual void follow_pressure() {}
  /// Sets positions and velocities of the surface from those of nodes and rim.
  virtual void place_surface() = 0;
  /// Distributes surface().f over nodes and rim.
  /// @param on_nodes [N] out: one column for each node
  /// @returns force and moment on the rim, of the computed part
  virtual Wrench hand_over(Matrix3X& on_nodes) = 0;

  virtual double tread_area() const = 0;  ///< [m^2] of the whole tyre
  /// Point of a line of the unloaded tread's nodes, about the axle centre [m].
  virtual Vector3 unloaded_tread_point(int line) const = 0;
  /// Nodes on whose positions the internal force of each node depends.
  virtual NodeNeighbours neighbours() const = 0;
  /// Number among nodes() of a node of tread_grid().
  virtual Eigen::Index tread_node(int k) const = 0;
  /// Time step that is stable during the whole relaxation [s].
  virtual double relaxation_step() const { return stable_time_step(); }

  /// Direction of the circumference at a point about the axle centre, as made.
  static Vector3 circumferential(const Vector3& at) { return {-at.z(), 0.0, at.x()}; }
  void hold_in_symmetry_plane(Eigen::Index node);
  void carry_by_rim(Eigen::Index node);                    ///< turns the node into a bead
  double copies() const { return tread_grid().copies(); }  ///< computed parts in the whole
  const Matrix3X& reference() const { return reference_; }
  void checkpoint_nodes(Checkpoint& state);

  ShellNodes nodes_;

 private:
  class Relaxing;  // the tyre as a structure of shell/dynamic_relaxation.h

  void step(double dt);
  void compute_internal();
  void compute_contact();
  Wrench internal_on_rim() const;
  Wrench internal_on_beads() const;
  void place_beads();
  double potential() const { return elastic_ - pressure_ * volume_; }
  void count_stored_energy() { stored_ = potential() - zero_; }
  Wrench to_whole(const Wrench& computed) const;

  Relaxation relax(RigidPlane* plane, const SettleOptions& options) override;
  NaturalModes modes_with(const std::vector<int>& held, int count) override;
  void follow_placement(const Vector3& old_centre, const Matrix3& old_attitude) override;
  void follow_velocity() override;
  double kinetic_energy() const override;

  Matrix3X reference_;  // [m] stress-free nodes about the axle centre
  double pressure_;     // [Pa]
  NodeStep node_step_;
  std::vector<Eigen::Index> beads_;

  bool surface_follows_ = true;  // in every step

  // State of the present step, of the whole tyre
  double elastic_ = 0.0;   // [J]
  double volume_ = 0.0;    // [m^3] of the air, but for a constant
  Wrench contact_on_rim_;  // handed over by the surface
  Matrix3X contact_;       // [N] on the nodes

  // Energies of the whole tyre [J]
  double zero_ = 0.0;    // potential in the state as made
  double stored_ = 0.0;  // potential beyond it
  double contact_work_ = 0.0;
  double inflation_work_ = 0.0;
  double damped_ = 0.0;
};

}  // namespace furrow
