// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The axle of a wheel: a rigid body of revolution with six coordinates, each free, held or
/// prescribed. Rigid wheels and the rims of tyres derive from it, and a rig drives both through it.

#include <array>
#include <limits>
#include <string>

#include "furrow/bodies/body.h"
#include "furrow/bodies/hub_parameters.h"

namespace furrow {

/// Coordinates of a hub: position of the axle centre [m], then angles [rad].
enum class Coordinate { x, y, z, spin, yaw, camber };

constexpr std::array<Coordinate, 3> translations{Coordinate::x, Coordinate::y, Coordinate::z};
constexpr std::array<Coordinate, 3> rotations{Coordinate::spin, Coordinate::yaw,
                                              Coordinate::camber};

/// One value for each coordinate of a hub.
template <class Value>
struct PerCoordinate {
  std::array<Value, 6> values{};

  Value& operator[](Coordinate c) { return values[static_cast<std::size_t>(c)]; }
  const Value& operator[](Coordinate c) const { return values[static_cast<std::size_t>(c)]; }
};

/// Force [N] and its moment about the axle centre [N m].
struct Wrench {
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
};

/// Attitude: R = Rz(yaw) Rx(camber) Ry(spin); the axle is a = R y. Coordinates q: x, y, z of the
/// axle centre, spin, yaw, camber.
///
/// One step is a leapfrog (theory: step, eqs. 1 and 2). Rotation is integrated in the angular
/// velocities w = (w_x, w_a, w_n) about the carrier's axes: e_x level and normal to the axle, a the
/// axle, e_n = e_x x a (theory: step, eq. 9). The carrier yaws and cambers with the axle but does
/// not spin. Works are forces times the mean of the velocities before and after, so the energy
/// balance is exact to rounding.
///
/// Every coordinate is held until release() or prescribe() says otherwise. Holding a moving
/// coordinate stops it within a step.
class WheelHub : public Body {
 public:
  using Body::surface;
  enum class Motion { free, held, prescribed };

  void hold(Coordinate coordinate);
  void release(Coordinate coordinate);
  /// @param velocity [m/s or rad/s] from the next step on
  void prescribe(Coordinate coordinate, double velocity);
  Motion motion(Coordinate coordinate) const { return motion_[coordinate]; }

  /// Force at the axle centre [N], weight included: the hub itself has no gravity.
  void set_load(const Vector3& force) { load_ = force; }
  /// Torque of a motor or brake between carrier and wheel, > 0 drives forward [N m]; has no effect
  /// while the spin is held or prescribed.
  void set_axle_torque(double torque) { axle_torque_ = torque; }
  /// Additional mass coupled to the hub's motion along x and y where it is free [kg]: the vehicle's
  /// share. Its inertial force is reported as the constraint, its kinetic energy as work of the
  /// drive.
  /// @throws Error for a negative mass
  void set_dragged_mass(double mass);
  double dragged_mass() const { return dragged_mass_; }  ///< [kg]
  /// Viscous resistance to vertical motion, taken implicitly [N s/m]; its loss is part of the
  /// balance's dissipated_energy.
  /// @throws Error for a negative coefficient
  void set_vertical_damping(double coefficient);

  /// Places the wheel without motion [m, rad, rad]; spin 0. For the start of a run: no work is
  /// counted.
  void place(const Vector3& axle_centre, double yaw, double camber);
  /// Sets the velocities of the whole wheel as of a rigid body [m/s; spin, yaw, camber rates
  /// rad/s]. The change of kinetic energy counts as drive work.
  void set_velocity(const Vector3& velocity, const Vector3& rates);

  const Vector3& centre() const { return centre_; }      ///< [m] of the axle
  const Vector3& velocity() const { return velocity_; }  ///< [m/s] half a step ago
  /// Position along a coordinate [m or rad]; the spin is not wrapped at 2 pi.
  double position(Coordinate coordinate) const;
  double rate(Coordinate coordinate) const;  ///< [m/s or rad/s] half a step ago
  /// unit vector, +y for an upright wheel that runs along x
  Vector3 axle() const;
  Matrix3 attitude() const;                                   ///< R
  const Vector3& angular_velocity() const { return omega_; }  ///< [rad/s] in space, half a step ago
  const Vector3& load() const { return load_; }               ///< [N]
  /// Velocity [m/s] of a point [m] that moves with the wheel as a rigid body, half a step ago.
  Vector3 velocity_at(const Vector3& point) const {
    return velocity_ + omega_.cross(point - centre_);
  }
  /// Constraint force [N] or torque [N m] on the wheel of a held or prescribed coordinate, mean of
  /// the last step or interval. For a free spin it is the axle torque, for a free x or y the
  /// inertial force of the dragged mass, for other free coordinates zero.
  double constraint(Coordinate coordinate) const { return constraint_[coordinate]; }
  /// Energy dissipated by the vertical damping since the start [J].
  double damping_loss() const { return dissipated_; }
  void begin_interval(bool touched) override;
  void end_interval() override;

  /// Radius of the unloaded wheel without grousers [m]; defines the rim speed.
  virtual double nominal_radius() const = 0;
  /// Largest distance of the unloaded wheel from its axle, grousers included [m].
  virtual double tip_radius() const { return nominal_radius(); }
  /// number of equal sectors of the wheel, each with a grouser; 0 for a smooth one
  virtual int grousers() const { return 0; }
  /// width of the narrowest groove or rib of the tread [m]; infinite where none is known
  virtual double narrowest_groove() const { return std::numeric_limits<double>::infinity(); }
  /// Width [m] of the part that rolls on the ground, unloaded: of a tyre its tread or carcass.
  virtual double nominal_width() const = 0;
  /// Lowest z of the unloaded shape without grousers [m]; defines the hub drop.
  virtual double lowest_point() const = 0;
  /// Height of the loaded surface above lowest_point() [m]; 0 for a rigid wheel.
  virtual double deflection() const { return 0.0; }
  /// Sum over all contacts of the wheel now; of a half model, for the whole.
  virtual Wrench ground_wrench() const {
    return {surface().total_force(), surface().total_moment(centre_)};
  }
  /// Mass of everything that moves with the wheel [kg].
  virtual double total_mass() const { return inertia_.mass; }

 protected:
  /// @param name names the wheel in errors
  WheelHub(const HubParameters& parameters, const std::string& name);

  /// Advances the hub by one step under a force and its moment about the axle centre [N, N m].
  /// @throws StateError for values that are not finite and for a wheel that fell over
  void advance_hub(double dt, const Vector3& force, const Vector3& moment);
  double hub_energy() const;  ///< kinetic [J]
  /// Work of the forces and moments passed to advance_hub [J].
  double given_work() const { return given_work_; }
  EnergyBudget hub_budget() const;  ///< without contact_work
  /// Called when the hub was placed elsewhere: all that moves with it follows as a rigid body,
  /// without velocity.
  virtual void follow_placement(const Vector3& old_centre, const Matrix3& old_attitude) = 0;
  virtual void follow_velocity() = 0;   ///< called when set_velocity() changed the motion
  void rest_at(const Vector3& centre);  ///< moves the hub alone, without velocity
  virtual double kinetic_energy() const { return hub_energy(); }
  void checkpoint_hub(Checkpoint& state);

 private:
  void advance_translation(double dt, const Vector3& force);
  void advance_rotation(double dt, const Vector3& moment);

  std::string name_;
  HubInertia inertia_;
  Vector3 centre_;
  Vector3 velocity_ = Vector3::Zero();
  Vector3 angles_ = Vector3::Zero();  // spin, yaw, camber [rad]
  Vector3 w_ = Vector3::Zero();       // about e_x, a, e_n [rad/s]
  Vector3 rates_ = Vector3::Zero();   // of the angles, from w_ at the attitude of its time [rad/s]
  Vector3 omega_ = Vector3::Zero();   // w_ in space, likewise [rad/s]

  PerCoordinate<Motion> motion_;
  PerCoordinate<double> prescribed_;          // [m/s or rad/s]
  PerCoordinate<double> constraint_;          // [N or N m]
  PerCoordinate<double> constraint_impulse_;  // of the interval so far [N s or N m s]
  double interval_ = -1.0;                    // [s] so far; < 0 outside of one
  Vector3 load_ = Vector3::Zero();            // [N]
  double axle_torque_ = 0.0;                  // [N m]
  double vertical_damping_ = 0.0;             // [N s/m]
  double dragged_mass_ = 0.0;                 // [kg] along x and y
  // work since the start [J]
  double given_work_ = 0.0;
  double load_work_ = 0.0;
  double drive_work_ = 0.0;
  double dissipated_ = 0.0;
};

}  // namespace furrow
