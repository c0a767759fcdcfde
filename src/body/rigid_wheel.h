#pragma once
/// A rigid wheel on an axle: six degrees of freedom, each free, held or prescribed.

#include <array>

#include "body/body.h"
#include "body/wheel_mesh.h"
#include "core/options.h"

namespace furrow {

/// Everything that makes a wheel.
struct RigidWheelParameters {
  WheelGeometry geometry;
  double mass = 0.0;                      ///< [kg] that moves with the axle centre
  double axle_inertia = 0.0;              ///< [kg m^2] about the axle, C
  double diametral_inertia = 0.0;         ///< [kg m^2] about any line across the axle through the centre, A
  Vector3 axle_centre = Vector3::Zero();  ///< [m] at the start
};

/// Attitude: R = Rz(yaw) Rx(camber) Ry(spin); the axle is a = R y. Coordinates q: x, y, z of the axle centre, spin, yaw, camber.
///
/// Rotation is integrated in the quasi-velocities w = (w_x, w_a, w_n) along the carrier's axes: e_x level and across the
/// axle, a the axle, e_n = e_x x a (the carrier yaws and cambers with the axle but does not spin). In them the kinetic
/// energy of a body of revolution has constant coefficients, T = (A w_x^2 + C w_a^2 + A w_n^2)/2, and
///   w_x = d(camber)/dt,  w_a = d(spin)/dt + d(yaw)/dt sin(camber),  w_n = d(yaw)/dt cos(camber).
///
/// One step is a leapfrog, as LIGGGHTS's velocity Verlet sees it: forces belong to t_n, velocities to t_n -+ dt/2:
///   v_n+1/2 = v_n-1/2 + dt F_n/m,  q_n+1 = q_n + dt (dq/dt)_n+1/2,
///   (A, C, A) dw/dt + gyroscopic terms = moments of forces and constraints.
/// All works are forces times the mean of the velocities before and after, which makes the energy balance exact to round-off.
/// Nodes are placed from the reference mesh by the attitude, never accumulated; their velocity is that of n+1/2.
///
/// Every coordinate is held until release() or prescribe() says otherwise. Holding a moving coordinate stops it within a step.
class RigidWheel : public Body {
 public:
  enum Coordinate { x, y, z, spin, yaw, camber };
  enum class Motion { free, held, prescribed };
  static constexpr int coordinates = 6;

  /// The keys of a wheel. @param subject names the owner in errors
  static Schema schema(const std::string& subject = "rigid wheel");
  /// @throws InputError for values that are each allowed and together impossible
  explicit RigidWheel(const Options& options);
  /// @param where names the wheel in errors
  explicit RigidWheel(const RigidWheelParameters& parameters, const std::string& where = "rigid wheel");

  void hold(Coordinate coordinate);
  void release(Coordinate coordinate);
  /// @param velocity [m/s or rad/s] from the next step on
  void prescribe(Coordinate coordinate, double velocity);
  Motion motion(Coordinate coordinate) const { return motion_[coordinate]; }

  /// Force at the axle centre, weight included: the wheel knows no gravity of its own [N].
  void set_load(const Vector3& force) { load_ = force; }
  /// Torque of a motor or brake between carrier and wheel, > 0 drives forward [N m]; of no effect while the spin is prescribed.
  void set_axle_torque(double torque) { axle_torque_ = torque; }
  /// Viscous resistance to vertical motion, taken implicitly [N s/m]; its loss is the balance's dissipated_energy.
  /// @throws Error for a negative coefficient
  void set_vertical_damping(double coefficient);

  /// Sets the wheel down without motion [m, rad, rad]; spin 0. Meant for the start of a run: no work is counted.
  void place(const Vector3& axle_centre, double yaw, double camber);
  /// Sets the velocities, work counted as drive work [m/s; spin, yaw, camber rates rad/s].
  void set_velocity(const Vector3& velocity, const Vector3& rates);

  const RigidWheelParameters& parameters() const { return parameters_; }
  const Vector3& centre() const { return centre_; }           ///< [m] of the axle
  const Vector3& velocity() const { return velocity_; }       ///< [m/s] half a step ago
  double position(Coordinate coordinate) const;               ///< [m or rad] the spin is not wrapped at 2 pi
  double rate(Coordinate coordinate) const;                   ///< [m/s or rad/s] half a step ago
  Vector3 axle() const;                                       ///< unit vector, +y for an upright wheel that runs along x
  const Vector3& angular_velocity() const { return omega_; }  ///< [rad/s] in space, half a step ago
  double lowest_point() const;                                ///< [m] z of the true circle and shoulders, without grousers
  const Vector3& load() const { return load_; }               ///< [N]
  double axle_torque() const { return axle_torque_; }         ///< [N m] as set
  /// Force [N] or torque [N m] with which whatever holds or prescribes a coordinate acts on the wheel, mean of the last step; for
  /// the spin of a free wheel this is the axle torque. Zero for other free coordinates.
  double constraint(Coordinate coordinate) const { return constraint_[coordinate]; }

  double stable_time_step() const override;  ///< infinity
  void advance(double dt) override;
  using Body::surface;
  Surface& surface() override { return surface_; }
  Balance balance() const override;
  std::vector<double> state() const override;
  void restore(const std::vector<double>& state) override;

 private:
  void advance_translation(double dt, const Vector3& force);
  void advance_rotation(double dt, const Vector3& moment);
  void place_nodes();
  double kinetic_energy() const;
  std::vector<double> fingerprint() const;

  RigidWheelParameters parameters_;
  Matrix3X reference_;  // nodes about the axle centre, unturned
  Surface surface_;

  Vector3 centre_, velocity_ = Vector3::Zero();
  Vector3 angles_ = Vector3::Zero();  // spin, yaw, camber [rad]
  Vector3 w_ = Vector3::Zero();       // about e_x, a, e_n [rad/s]
  Vector3 rates_ = Vector3::Zero();   // of the angles, from w_ at the attitude of its time [rad/s]
  Vector3 omega_ = Vector3::Zero();   // w_ in space, likewise [rad/s]

  std::array<Motion, coordinates> motion_;
  std::array<double, coordinates> prescribed_{};  // [m/s or rad/s]
  std::array<double, coordinates> constraint_{};  // [N or N m]
  Vector3 load_ = Vector3::Zero();
  double axle_torque_ = 0.0, vertical_damping_ = 0.0;
  double contact_work_ = 0.0, load_work_ = 0.0, drive_work_ = 0.0, dissipated_ = 0.0;  // [J]
};

}  // namespace furrow
