// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/wheel_hub.h"

#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double largest_camber = radians(85);  // the spin and the yaw become one at 90 degrees

constexpr bool is_translation(Coordinate c) { return c <= Coordinate::z; }
/// Index of a translation among x, y, z, or of a rotation among spin, yaw, camber.
constexpr int component(Coordinate c) { return static_cast<int>(c) % 3; }

/// Axes of the carrier in space: columns e_x, a, e_n.
Matrix3 carrier(double yaw, double camber) {
  return (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(camber, Vector3::UnitX()))
      .toRotationMatrix();
}

/// Rates of spin, yaw and camber (rows) from the quasi-velocities w.
Matrix3 rates_from_w(double camber) {
  const double sine = std::sin(camber);
  const double cosine = std::cos(camber);
  Matrix3 rates;
  rates << 0.0, 1.0, -sine / cosine, 0.0, 0.0, 1.0 / cosine, 1.0, 0.0, 0.0;
  return rates;
}

}  // namespace

WheelHub::WheelHub(const HubParameters& parameters, const std::string& name)
    : name_(name), inertia_(parameters.inertia), centre_(parameters.centre) {
  motion_.values.fill(Motion::held);
}

void WheelHub::hold(Coordinate coordinate) {
  motion_[coordinate] = Motion::held;
  prescribed_[coordinate] = 0.0;
}

void WheelHub::release(Coordinate coordinate) {
  motion_[coordinate] = Motion::free;
  prescribed_[coordinate] = 0.0;
}

void WheelHub::prescribe(Coordinate coordinate, double velocity) {
  if (!std::isfinite(velocity))
    throw StateError(fmt::format("{}: prescribed velocity is {}", name_, velocity));
  motion_[coordinate] = Motion::prescribed;
  prescribed_[coordinate] = velocity;
}

void WheelHub::set_vertical_damping(double coefficient) {
  if (!(std::isfinite(coefficient) && coefficient >= 0.0))
    throw Error(fmt::format("{}: vertical damping is {} N s/m; allowed: a number >= 0", name_,
                            coefficient));
  vertical_damping_ = coefficient;
}

void WheelHub::set_dragged_mass(double mass) {
  if (!(std::isfinite(mass) && mass >= 0.0))
    throw Error(fmt::format("{}: the dragged mass is {} kg; allowed: a number >= 0", name_, mass));
  dragged_mass_ = mass;
}

void WheelHub::place(const Vector3& axle_centre, double yaw_angle, double camber_angle) {
  if (!(axle_centre.allFinite() && std::isfinite(yaw_angle) &&
        std::abs(camber_angle) < largest_camber))
    throw Error(fmt::format("{}: cannot be placed at {} {} {} m with yaw {} and camber {} degrees",
                            name_, axle_centre.x(), axle_centre.y(), axle_centre.z(),
                            degrees(yaw_angle), degrees(camber_angle)));
  const Vector3 old_centre = centre_;
  const Matrix3 old_attitude = attitude();
  angles_ = {0.0, yaw_angle, camber_angle};
  rest_at(axle_centre);
  follow_placement(old_centre, old_attitude);
}

void WheelHub::rest_at(const Vector3& centre) {
  centre_ = centre;
  for (Vector3* motion : {&velocity_, &w_, &rates_, &omega_}) motion->setZero();
}

void WheelHub::set_velocity(const Vector3& velocity, const Vector3& rates) {
  if (!(velocity.allFinite() && rates.allFinite()))
    throw StateError(fmt::format("{}: a velocity to be set is not finite", name_));
  const double before = kinetic_energy();
  velocity_ = velocity;
  w_ = {rates[2], rates[0] + rates[1] * std::sin(angles_[2]), rates[1] * std::cos(angles_[2])};
  rates_ = rates;
  omega_ = carrier(angles_[1], angles_[2]) * w_;
  follow_velocity();
  drive_work_ += kinetic_energy() - before;
}

double WheelHub::position(Coordinate coordinate) const {
  return is_translation(coordinate) ? centre_[component(coordinate)]
                                    : angles_[component(coordinate)];
}

double WheelHub::rate(Coordinate coordinate) const {
  return is_translation(coordinate) ? velocity_[component(coordinate)]
                                    : rates_[component(coordinate)];
}

Vector3 WheelHub::axle() const { return carrier(angles_[1], angles_[2]).col(1); }

Matrix3 WheelHub::attitude() const {
  return carrier(angles_[1], angles_[2]) *
         Eigen::AngleAxisd(angles_[0], Vector3::UnitY()).toRotationMatrix();
}

void WheelHub::begin_interval(bool /*touched*/) {
  interval_ = 0.0;
  constraint_impulse_.values.fill(0.0);
}

void WheelHub::end_interval() {
  if (interval_ > 0.0)
    for (std::size_t c = 0; c < constraint_.values.size(); ++c)
      constraint_.values[c] = constraint_impulse_.values[c] / interval_;
  interval_ = -1.0;
}

void WheelHub::advance_hub(double dt, const Vector3& force, const Vector3& moment) {
  if (!(std::isfinite(dt) && dt > 0.0))
    throw StateError(fmt::format("{}: a step of {} s", name_, dt));
  if (!(force.allFinite() && moment.allFinite() && load_.allFinite() &&
        std::isfinite(axle_torque_)))
    throw StateError(fmt::format(
        "{}: not finite: force {} {} {} N, moment {} {} {} N m, load {} {} {} N, torque {} N m",
        name_, force.x(), force.y(), force.z(), moment.x(), moment.y(), moment.z(), load_.x(),
        load_.y(), load_.z(), axle_torque_));
  advance_translation(dt, force);
  advance_rotation(dt, moment);
  if (interval_ >= 0.0) {
    interval_ += dt;
    for (std::size_t c = 0; c < constraint_.values.size(); ++c)
      constraint_impulse_.values[c] += dt * constraint_.values[c];
  }
  if (!(std::abs(angles_[2]) < largest_camber))
    throw StateError(fmt::format(
        "{}: fell over, its camber is {:.4g} degrees; fix the camber or guide the wheel", name_,
        degrees(angles_[2])));
}

void WheelHub::advance_translation(double dt, const Vector3& force) {
  for (const Coordinate axis : translations) {
    const int k = component(axis);
    const double inertia = inertia_.mass / dt;
    const double dragged = axis == Coordinate::z ? 0.0 : dragged_mass_ / dt;
    const double damping = axis == Coordinate::z ? vertical_damping_ : 0.0;
    const double before = velocity_[k];
    const double applied = force[k] + load_[k];
    const double after = motion_[axis] == Motion::free
                             ? ((inertia + dragged - 0.5 * damping) * before + applied) /
                                   (inertia + dragged + 0.5 * damping)
                             : prescribed_[axis];
    const double mean = 0.5 * (before + after);
    constraint_[axis] = motion_[axis] == Motion::free
                            ? dragged * (before - after)
                            : inertia * (after - before) - applied + damping * mean;
    given_work_ += force[k] * mean * dt;
    load_work_ += load_[k] * mean * dt;
    drive_work_ += constraint_[axis] * mean * dt;
    dissipated_ += damping * mean * mean * dt;
    velocity_[k] = after;
    centre_[k] += after * dt;
  }
}

// M (w1 - w0) + dt S (w0 + w1)/2 = dt (moment + D^T torques) at t_n,  D_c w1 = prescribed rates at
// t_n+1/2, where D are the rates per w, with the gyroscopic S = k (e_n e_x^T - e_x e_n^T), k = C
// w_a - A w_n tan(camber), of (w0 + w1)/2. S does no work.
void WheelHub::advance_rotation(double dt, const Vector3& moment) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const Matrix3 to_rates = rates_from_w(angles_[2]);
  const Vector3 inertia(inertia_.diametral, inertia_.axial, inertia_.diametral);
  const Vector3 contact = carrier(angles_[1], angles_[2]).transpose() * moment;
  const double motor = motion_[Coordinate::spin] == Motion::free ? axle_torque_ : 0.0;
  const Vector3 applied = contact + motor * to_rates.row(0).transpose();

  Vector3 after = w_;
  Vector3 torques = Vector3::Zero();  // of the constraints on spin, yaw, camber
  Matrix3 to_rates_after = to_rates;
  for (int pass = 0; pass < 3; ++pass) {  // each pass gains an order in dt
    const Vector3 middle = 0.5 * (w_ + after);
    const double k = inertia[1] * middle[1] - inertia[2] * middle[2] * std::tan(angles_[2]);
    Matrix3 gyroscopic = Matrix3::Zero();
    gyroscopic(0, 2) = -k;
    gyroscopic(2, 0) = k;
    to_rates_after = rates_from_w(angles_[2] + 0.5 * dt * after[0]);

    Matrix6 system = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    system.topLeftCorner<3, 3>() = 0.5 * dt * gyroscopic;
    system.topLeftCorner<3, 3>().diagonal() += inertia;
    right.head<3>() = inertia.cwiseProduct(w_) - 0.5 * dt * gyroscopic * w_ + dt * applied;
    for (const Coordinate angle : rotations) {
      const int row = component(angle);
      if (motion_[angle] == Motion::free) {
        system(3 + row, 3 + row) = 1.0;
      } else {
        system.block<3, 1>(0, 3 + row) = -to_rates.row(row).transpose();
        system.block<1, 3>(3 + row, 0) = to_rates_after.row(row);
        right[3 + row] = prescribed_[angle];
      }
    }
    const Vector6 solution = system.partialPivLu().solve(right);
    after = solution.head<3>();
    torques = solution.tail<3>() / dt;
  }

  const Vector3 mean = 0.5 * (w_ + after);
  const Vector3 mean_rates = to_rates * mean;
  given_work_ += contact.dot(mean) * dt;
  drive_work_ += (torques.dot(mean_rates) + motor * mean_rates[0]) * dt;
  for (const Coordinate angle : rotations) constraint_[angle] = torques[component(angle)];
  constraint_[Coordinate::spin] += motor;

  w_ = after;
  rates_ = to_rates_after * w_;
  for (const Coordinate angle : rotations)
    if (motion_[angle] != Motion::free) rates_[component(angle)] = prescribed_[angle];  // exactly
  const Vector3 half_way = angles_ + 0.5 * dt * rates_;
  omega_ = carrier(half_way[1], half_way[2]) * w_;
  angles_ += dt * rates_;
}

double WheelHub::hub_energy() const {
  return 0.5 *
         (inertia_.mass * velocity_.squaredNorm() +
          inertia_.diametral * (w_[0] * w_[0] + w_[2] * w_[2]) + inertia_.axial * w_[1] * w_[1]);
}

EnergyBudget WheelHub::hub_budget() const {
  EnergyBudget budget;
  budget.momentum = inertia_.mass * velocity_;
  budget.kinetic_energy = hub_energy();
  budget.dissipated_energy = dissipated_;
  budget.load_work = load_work_;
  budget.drive_work = drive_work_;
  return budget;
}

void WheelHub::checkpoint_hub(Checkpoint& state) {
  state.values("centre", centre_);
  state.values("velocity", velocity_);
  state.values("angles", angles_);
  state.values("quasi_velocities", w_);
  state.values("rates", rates_);
  state.values("angular_velocity", omega_);
  state.values("load", load_);
  for (Motion& motion : motion_.values) state.value("motion", motion);
  state.values("prescribed", prescribed_.values);
  state.values("constraint", constraint_.values);
  state.value("axle_torque", axle_torque_);
  state.value("vertical_damping", vertical_damping_);
  state.value("given_work", given_work_);
  state.value("load_work", load_work_);
  state.value("drive_work", drive_work_);
  state.value("dissipated", dissipated_);
}

}  // namespace furrow
