// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Brings a shell structure to rest under its loads, however large its deformation.
///
/// Dynamic relaxation follows a fictitious motion that ends in equilibrium. Here it has two phases:
///   loading     The load on the support, or its travel, is applied gradually (core/smooth_step.h)
///               while the nodes are damped viscously relative to the support, near the critical
///               rate of the structure's edges, so that nothing overshoots far.
///   relaxation  Kinetic damping [Barnes1999]: whenever the kinetic energy has passed a peak, near
///               which the potential energy is lowest, all motion is stopped. A little viscous
///               damping slows parts that snap through.
/// It ends when the largest unbalanced force is below the tolerance.

#include <cstddef>

#include "furrow/shell/shell_nodes.h"

namespace furrow {

/// Finds the peaks of the kinetic energy.
class KineticDamping {
 public:
  /// @param energy kinetic energy after a step [J]
  /// @returns true when motion should be stopped now
  bool peaked(double energy) {
    const bool falling = energy < last_;
    last_ = falling ? 0.0 : energy;
    stops_ += falling;
    return falling;
  }
  std::size_t stops() const { return stops_; }

 private:
  double last_ = 0.0;
  std::size_t stops_ = 0;
};

/// The structure to bring to rest: nodes of a shell and optionally a rigid support such as a rim,
/// which moves along z only.
class RelaxingStructure {
 public:
  virtual ~RelaxingStructure() = default;

  virtual ShellNodes& nodes() = 0;
  /// Sets force and moment of the nodes for the present positions. @throws StateError
  /// @returns unbalanced vertical force on the support [N]; used only if the support is free
  virtual double compute_forces() = 0;
  /// Called after the nodes have moved: the support and all parts attached to it follow.
  /// @param support_height z of the support [m]
  virtual void follow(double support_height) = 0;
  /// A further condition of rest, for a sum over all nodes.
  virtual bool carries_its_load(double /*tolerance*/) const { return true; }
};

/// Motion of the support while a structure settles.
struct RelaxationSupport {
  enum class Motion { held, free, prescribed };

  Motion motion = Motion::held;
  double height = 0.0;  ///< [m] z at the start
  double target = 0.0;  ///< [m] z at the end of the loading, where the motion is prescribed
  /// fictitious mass [kg]; one like that of all nodes converges fastest
  double mass = 1.0;
  double damping = 0.0;  ///< [1/s] of a free support during the loading
};

struct RelaxationSettings {
  double time_step = 0.0;           ///< [s] a stable one
  double force_scale = 1.0;         ///< [N] scale of unbalanced forces
  double tolerance = 1e-3;          ///< largest unbalanced force on a node over force_scale
  long max_steps = 400000;          ///< of both phases
  double loading_time = 0.0;        ///< [s]
  double loading_damping = 0.0;     ///< [1/s] of the nodes relative to the support
  double relaxation_damping = 0.0;  ///< [1/s] of the nodes, in addition to the kinetic damping
  /// [m/s] largest component of random velocities at the start, the same in every run; they prevent
  /// rest in an unstable symmetric shape. 0: none
  double disturbance = 0.0;
};

/// Result of a relaxation.
struct Relaxation {
  long steps = 0;
  std::size_t stops = 0;  ///< by kinetic damping
  double residual = 0.0;  ///< largest unbalanced force over the force scale
  bool converged = false;
};

/// Solves a structure for rest by dynamic relaxation; does not own the structure.
class DynamicRelaxation {
 public:
  DynamicRelaxation(RelaxingStructure& structure, const RelaxationSupport& support,
                    const RelaxationSettings& settings);

  /// Runs until the structure rests or max_steps are done; the nodes are left without velocity.
  /// @throws StateError as the structure's compute_forces()
  Relaxation run();

 private:
  void disturb();
  void compute_forces();
  bool at_rest() const;
  void kick();
  void damp_loading();
  bool damp_relaxation();
  void drift();

  bool loading() const { return result_.steps < loading_steps_; }
  double time() const { return static_cast<double>(result_.steps) * settings_.time_step; }
  /// share of the load, or of the travel, that is applied at a time [s]
  double applied(double time) const;

  RelaxingStructure& structure_;
  ShellNodes& nodes_;
  RelaxationSupport support_;
  RelaxationSettings settings_;
  double start_height_;  // [m] of the support
  long loading_steps_;
  double rotation_length_;          // [m] length that converts moments to forces for comparison
  double support_velocity_ = 0.0;   // [m/s] upwards
  double support_force_ = 0.0;      // [N] unbalanced now, of what is applied of the load
  double initial_imbalance_ = 0.0;  // [N] on the support at the start: the load to be applied
  KineticDamping kinetic_damping_;
  Relaxation result_;
};

}  // namespace furrow
