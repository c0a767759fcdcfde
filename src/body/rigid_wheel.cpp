#include "body/rigid_wheel.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <fmt/format.h>

#include "body/closed_surface.h"
#include "core/error.h"

namespace furrow {

namespace {

constexpr double largest_camber = radians(85);  // the spin and the yaw become one at 90 degrees

constexpr bool is_translation(RigidWheel::Coordinate coordinate) { return coordinate <= RigidWheel::z; }
constexpr int angle_index(RigidWheel::Coordinate coordinate) { return coordinate - RigidWheel::spin; }

/// Axes of the carrier in space: columns e_x, a, e_n.
Matrix3 carrier(double yaw, double camber) {
  return (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(camber, Vector3::UnitX())).toRotationMatrix();
}

/// Rates of spin, yaw and camber (rows) from the quasi-velocities w.
Matrix3 rates_from_w(double camber) {
  const double sine = std::sin(camber), cosine = std::cos(camber);
  Matrix3 rates;
  rates << 0.0, 1.0, -sine / cosine, 0.0, 0.0, 1.0 / cosine, 1.0, 0.0, 0.0;
  return rates;
}

RigidWheelParameters parameters_from(const Options& options) {
  RigidWheelParameters wheel;
  wheel.geometry.diameter = options.number("diameter");
  wheel.geometry.width = options.number("width");
  wheel.geometry.shoulder = options.number("shoulder");
  wheel.geometry.segments = static_cast<int>(options.integer("segments"));
  if (options.has("element_size")) wheel.geometry.element_size = options.number("element_size");
  wheel.mass = options.number("mass");
  wheel.axle_inertia = options.number("inertia");
  // exact for any distribution of mass that is the same in every plane across the axle
  wheel.diametral_inertia = options.has("inertia_diametral")
                                ? options.number("inertia_diametral")
                                : 0.5 * wheel.axle_inertia + wheel.mass * std::pow(wheel.geometry.width, 2) / 12.0;
  const std::vector<double>& axle = options.numbers("axle");
  wheel.axle_centre = {axle[0], axle[1], axle[2]};

  Grousers& bars = wheel.geometry.grousers;
  bars.number = static_cast<int>(options.integer("grousers"));
  for (const char* key : {"grouser_height", "grouser_thickness"}) {
    if (bars.number > 0 && !options.has(key))
      throw InputError(options.where(key), "is missing", "a number > 0 [m]", "every grouser needs it");
    if (bars.number == 0 && options.has(key))
      throw InputError(options.where(key), "is given to a wheel without grousers", "only with grousers > 0",
                       "add 'grousers <number>' or remove it");
  }
  if (bars.number > 0) {
    bars.height = options.number("grouser_height");
    bars.thickness = options.number("grouser_thickness");
    bars.angle = radians(options.number("grouser_angle"));
  }
  return wheel;
}

void check(const RigidWheelParameters& wheel, const std::string& where) {
  const auto positive = [&](double value, const char* key, const char* unit) {
    if (!(std::isfinite(value) && value > 0.0))
      throw InputError(fmt::format("{}, keyword '{}'", where, key), fmt::format("is {} {}", value, unit), "a number > 0");
  };
  positive(wheel.mass, "mass", "kg");
  positive(wheel.axle_inertia, "inertia", "kg m^2");
  positive(wheel.diametral_inertia, "inertia_diametral", "kg m^2");
  const double reach = wheel.geometry.radius() + wheel.geometry.grousers.height;
  if (wheel.axle_inertia > wheel.mass * reach * reach)
    throw InputError(where + ", keyword 'inertia'", fmt::format("is {} kg m^2", wheel.axle_inertia),
                     fmt::format("at most {:.6g} kg m^2, with all of the mass at the rim", wheel.mass * reach * reach),
                     "check inertia, mass and diameter");
  if (2.0 * wheel.diametral_inertia < wheel.axle_inertia)
    throw InputError(where + ", keyword 'inertia_diametral'", fmt::format("is {} kg m^2", wheel.diametral_inertia),
                     fmt::format("at least half of inertia, {} kg m^2", 0.5 * wheel.axle_inertia));
  if (!wheel.axle_centre.allFinite()) throw InputError(where + ", keyword 'axle'", "is not finite", "three numbers [m]");
}

}  // namespace

Schema RigidWheel::schema(const std::string& subject) {
  Schema schema(subject);
  schema.number("diameter", "m", Range::positive(), "diameter of the tread, without grousers");
  schema.number("width", "m", Range::positive(), "width from side to side");
  schema.number("shoulder", "m", Range::non_negative(), "radius of the shoulders between tread and sides").by_default(0.0);
  schema.number("mass", "kg", Range::positive(), "mass that moves with the axle centre");
  schema.number("inertia", "kg m^2", Range::positive(), "moment of inertia about the axle");
  schema
      .number("inertia_diametral", "kg m^2", Range::positive(),
              "moment of inertia across the axle, for free yaw or camber; by default inertia/2 + mass width^2/12")
      .optional();
  schema.integer("segments", Range::closed(12, 5000), "facets around the tread").by_default("64");
  schema.number("element_size", "m", Range::positive(), "size of the elements across; by default one and a half facets")
      .optional();
  schema.integer("grousers", Range::closed(0, 1000), "number of straight bars across the tread").by_default("0");
  schema.number("grouser_height", "m", Range::positive(), "height of the bars above the tread").optional();
  schema.number("grouser_thickness", "m", Range::positive(), "thickness of the bars, square to them").optional();
  schema
      .number("grouser_angle", "degrees", Range::closed(-60, 60),
              "skew of the bars against the axle; > 0: the end at +y runs ahead")
      .by_default(0.0);
  schema.numbers("axle", 3, "m", Range::any(), "axle centre at the start: x y z").by_default(std::vector<double>{0, 0, 0});
  return schema;
}

RigidWheel::RigidWheel(const Options& options) : RigidWheel(parameters_from(options), options.subject()) {}

RigidWheel::RigidWheel(const RigidWheelParameters& parameters, const std::string& where)
    : parameters_(parameters), centre_(parameters.axle_centre) {
  check(parameters, where);
  surface_ = make_wheel_mesh(parameters.geometry, where);
  check_closed(surface_, where);
  reference_ = surface_.x;
  motion_.fill(Motion::held);
  place_nodes();
}

void RigidWheel::hold(Coordinate coordinate) {
  motion_[coordinate] = Motion::held;
  prescribed_[coordinate] = 0.0;
}

void RigidWheel::release(Coordinate coordinate) {
  motion_[coordinate] = Motion::free;
  prescribed_[coordinate] = 0.0;
}

void RigidWheel::prescribe(Coordinate coordinate, double velocity) {
  if (!std::isfinite(velocity)) throw StateError(fmt::format("rigid wheel: prescribed velocity is {}", velocity));
  motion_[coordinate] = Motion::prescribed;
  prescribed_[coordinate] = velocity;
}

void RigidWheel::set_vertical_damping(double coefficient) {
  if (!(std::isfinite(coefficient) && coefficient >= 0.0))
    throw Error(fmt::format("rigid wheel: vertical damping is {} N s/m; allowed: a number >= 0", coefficient));
  vertical_damping_ = coefficient;
}

void RigidWheel::place(const Vector3& axle_centre, double yaw_angle, double camber_angle) {
  if (!(axle_centre.allFinite() && std::isfinite(yaw_angle) && std::abs(camber_angle) < largest_camber))
    throw Error(fmt::format("rigid wheel: cannot be placed at {} {} {} m with yaw {} and camber {} degrees", axle_centre.x(),
                            axle_centre.y(), axle_centre.z(), degrees(yaw_angle), degrees(camber_angle)));
  centre_ = axle_centre;
  angles_ = {0.0, yaw_angle, camber_angle};
  for (Vector3* motion : {&velocity_, &w_, &rates_, &omega_}) motion->setZero();
  place_nodes();
}

void RigidWheel::set_velocity(const Vector3& velocity, const Vector3& rates) {
  if (!(velocity.allFinite() && rates.allFinite())) throw StateError("rigid wheel: a velocity to be set is not finite");
  const double before = kinetic_energy();
  velocity_ = velocity;
  w_ = {rates[2], rates[0] + rates[1] * std::sin(angles_[2]), rates[1] * std::cos(angles_[2])};
  rates_ = rates;
  omega_ = carrier(angles_[1], angles_[2]) * w_;
  drive_work_ += kinetic_energy() - before;
  place_nodes();
}

double RigidWheel::position(Coordinate coordinate) const {
  return is_translation(coordinate) ? centre_[coordinate] : angles_[angle_index(coordinate)];
}

double RigidWheel::rate(Coordinate coordinate) const {
  return is_translation(coordinate) ? velocity_[coordinate] : rates_[angle_index(coordinate)];
}

Vector3 RigidWheel::axle() const { return carrier(angles_[1], angles_[2]).col(1); }
double RigidWheel::lowest_point() const { return centre_.z() - parameters_.geometry.depth_below_centre(axle()); }

double RigidWheel::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

void RigidWheel::advance(double dt) {
  if (!(std::isfinite(dt) && dt > 0.0)) throw StateError(fmt::format("rigid wheel: a step of {} s", dt));
  const Vector3 force = surface_.total_force(), moment = surface_.total_moment(centre_);
  if (!(force.allFinite() && moment.allFinite() && load_.allFinite() && std::isfinite(axle_torque_)))
    throw StateError(fmt::format(
        "rigid wheel: not finite: force {} {} {} N, moment {} {} {} N m, load {} {} {} N, torque {} N m", force.x(),
        force.y(), force.z(), moment.x(), moment.y(), moment.z(), load_.x(), load_.y(), load_.z(), axle_torque_));
  advance_translation(dt, force);
  advance_rotation(dt, moment);
  if (!(std::abs(angles_[2]) < largest_camber))
    throw StateError(fmt::format("rigid wheel: fell over, its camber is {:.4g} degrees; hold the camber or guide the wheel",
                                 degrees(angles_[2])));
  place_nodes();
  surface_.check_finite("rigid wheel");
}

void RigidWheel::advance_translation(double dt, const Vector3& force) {
  for (const Coordinate axis : {x, y, z}) {
    const double inertia = parameters_.mass / dt, damping = axis == z ? vertical_damping_ : 0.0;
    const double before = velocity_[axis], applied = force[axis] + load_[axis];
    const double after = motion_[axis] == Motion::free
                             ? ((inertia - 0.5 * damping) * before + applied) / (inertia + 0.5 * damping)
                             : prescribed_[axis];
    const double mean = 0.5 * (before + after);
    constraint_[axis] = motion_[axis] == Motion::free ? 0.0 : inertia * (after - before) - applied + damping * mean;
    contact_work_ += force[axis] * mean * dt;
    load_work_ += load_[axis] * mean * dt;
    drive_work_ += constraint_[axis] * mean * dt;
    dissipated_ += damping * mean * mean * dt;
    velocity_[axis] = after;
    centre_[axis] += after * dt;
  }
}

// M (w1 - w0) + dt S (w0 + w1)/2 = dt (moment + D^T torques) at t_n,  D_c w1 = prescribed rates at t_n+1/2, where D are the rates
// per w, with the gyroscopic S = k (e_n e_x^T - e_x e_n^T), k = C w_a - A w_n tan(camber), of (w0 + w1)/2. S does no work.
void RigidWheel::advance_rotation(double dt, const Vector3& moment) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const Matrix3 to_rates = rates_from_w(angles_[2]);
  const Vector3 inertia(parameters_.diametral_inertia, parameters_.axle_inertia, parameters_.diametral_inertia);
  const Vector3 contact = carrier(angles_[1], angles_[2]).transpose() * moment;
  const double motor = motion_[spin] == Motion::free ? axle_torque_ : 0.0;
  const Vector3 applied = contact + motor * to_rates.row(0).transpose();

  Vector3 after = w_, torques = Vector3::Zero();  // of the constraints on spin, yaw, camber
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
    for (const Coordinate angle : {spin, yaw, camber}) {
      const int row = angle_index(angle);
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

  const Vector3 mean = 0.5 * (w_ + after), mean_rates = to_rates * mean;
  contact_work_ += contact.dot(mean) * dt;
  drive_work_ += (torques.dot(mean_rates) + motor * mean_rates[0]) * dt;
  for (const Coordinate angle : {spin, yaw, camber}) constraint_[angle] = torques[angle_index(angle)];
  constraint_[spin] += motor;

  w_ = after;
  rates_ = to_rates_after * w_;
  for (const Coordinate angle : {spin, yaw, camber})
    if (motion_[angle] != Motion::free) rates_[angle_index(angle)] = prescribed_[angle];  // exactly
  const Vector3 half_way = angles_ + 0.5 * dt * rates_;
  omega_ = carrier(half_way[1], half_way[2]) * w_;
  angles_ += dt * rates_;
}

void RigidWheel::place_nodes() {
  const Matrix3 attitude =
      carrier(angles_[1], angles_[2]) * Eigen::AngleAxisd(angles_[0], Vector3::UnitY()).toRotationMatrix();
  for (Eigen::Index node = 0; node < reference_.cols(); ++node) {
    const Vector3 arm = attitude * reference_.col(node);
    surface_.x.col(node) = centre_ + arm;
    surface_.v.col(node) = velocity_ + omega_.cross(arm);
  }
}

double RigidWheel::kinetic_energy() const {
  const double diametral = parameters_.diametral_inertia, axial = parameters_.axle_inertia;
  return 0.5 *
         (parameters_.mass * velocity_.squaredNorm() + diametral * (w_[0] * w_[0] + w_[2] * w_[2]) + axial * w_[1] * w_[1]);
}

Balance RigidWheel::balance() const {
  Balance balance;
  balance.momentum = parameters_.mass * velocity_;
  balance.kinetic_energy = kinetic_energy();
  balance.dissipated_energy = dissipated_;
  balance.contact_work = contact_work_;
  balance.load_work = load_work_;
  balance.drive_work = drive_work_;
  return balance;
}

std::vector<double> RigidWheel::fingerprint() const {
  const WheelGeometry& shape = parameters_.geometry;
  const Grousers& bars = shape.grousers;
  const auto number = [](auto count) { return static_cast<double>(count); };
  // clang-format off
  return {shape.diameter, shape.width, shape.shoulder, number(bars.number), bars.height, bars.thickness, bars.angle,
          parameters_.mass, parameters_.axle_inertia, parameters_.diametral_inertia, number(surface_.node_count())};
  // clang-format on
}

std::vector<double> RigidWheel::state() const {
  std::vector<double> state = fingerprint();
  const auto add = [&](const auto& values) { state.insert(state.end(), values.data(), values.data() + values.size()); };
  for (const Vector3& vector : {centre_, velocity_, angles_, w_, rates_, omega_, load_}) add(vector);
  for (const Motion motion : motion_) state.push_back(static_cast<double>(motion));
  add(prescribed_);
  add(constraint_);
  for (const double number : {axle_torque_, vertical_damping_, contact_work_, load_work_, drive_work_, dissipated_})
    state.push_back(number);
  add(surface_.f);
  return state;
}

void RigidWheel::restore(const std::vector<double>& state) {
  const std::vector<double> mine = fingerprint();
  if (state.size() != this->state().size() || !std::equal(mine.begin(), mine.end(), state.begin()))
    throw Error(
        "rigid wheel: the saved state belongs to another wheel; restart with the dimensions, mass and inertia of the first "
        "run");
  const double* next = state.data() + mine.size();
  const auto take = [&](auto& values) {
    std::copy(next, next + values.size(), values.data());
    next += values.size();
  };
  for (Vector3* vector : {&centre_, &velocity_, &angles_, &w_, &rates_, &omega_, &load_}) take(*vector);
  for (Motion& motion : motion_) motion = static_cast<Motion>(*next++);
  take(prescribed_);
  take(constraint_);
  for (double* number : {&axle_torque_, &vertical_damping_, &contact_work_, &load_work_, &drive_work_, &dissipated_})
    *number = *next++;
  take(surface_.f);
  place_nodes();
}

}  // namespace furrow
