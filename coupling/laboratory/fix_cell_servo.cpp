// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/laboratory/fix_cell_servo.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "atom.h"
#include "compute.h"
#include "furrow/core/communicator.h"
#include "furrow/core/error.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "domain.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr char temperature_id[] = "furrow_cell_temperature";
constexpr char pressure_id[] = "furrow_cell_pressure";
constexpr char axis_names[] = "xyz";
// Integral action over this many response times: the stress is met also while the cell moves,
// without ringing.
constexpr double integral_times = 4.0;
constexpr double largest_strain_of_step = 1e-3;
constexpr double largest_stress = 10.0;  // of the stiffness
constexpr double usual_stress = 1.0;     // [Pa] at least: a layer of grains of 0.1 mm
constexpr double min_steps_of_response = 5.0;

}  // namespace

const StyleRow cell_servo_style =
    fix_style<FixCellServo>("cell/servo", "laboratory", "laboratory/fix_cell_servo.md");

Schema FixCellServo::schema() {
  Schema schema("fix cell/servo");
  for (const char name : {'x', 'y', 'z'}) {
    schema
        .number(fmt::format("rate_{}", name), "1/s", Range::any(),
                "logarithmic strain rate along this axis, compression positive")
        .optional();
    schema
        .number(fmt::format("stress_{}", name), "Pa", Range::non_negative(),
                "normal stress along this axis, compression positive")
        .optional();
  }
  schema.number("rate_limit", "1/s", Range::positive(), "largest strain rate of the stress control")
      .by_default(0.5);
  schema
      .number("stiffness", "Pa", Range{0.0, 1e12, true, false},
              "upper estimate of the confined stiffness of the ground")
      .by_default(1e7);
  schema
      .number("response_time", "s", Range{0.0, 10.0, true, false},
              "time in which a stress error is removed; at least 5 steps")
      .by_default(2e-3);
  schema
      .number("ramp_time", "s", Range::non_negative(),
              "time in which the rates grow to their values")
      .by_default(0.0);
  return schema;
}

const Outputs<FixCellServo>& FixCellServo::outputs() {
  using Fix = FixCellServo;
  static const Outputs<Fix> list = {
      {"edge_x", "m", "length of the cell", [](Fix& fix) { return fix.domain->prd[0]; }},
      {"edge_y", "m", "width of the cell", [](Fix& fix) { return fix.domain->prd[1]; }},
      {"edge_z", "m", "height of the cell", [](Fix& fix) { return fix.domain->prd[2]; }},
      {"stress_x", "Pa", "normal stress, compression positive",
       [](Fix& fix) { return fix.stress_[0]; }},
      {"stress_y", "Pa", "normal stress, compression positive",
       [](Fix& fix) { return fix.stress_[1]; }},
      {"stress_z", "Pa", "normal stress, compression positive",
       [](Fix& fix) { return fix.stress_[2]; }},
      {"density", "kg/m^3", "mass over volume", [](Fix& fix) { return fix.density(); }},
      {"inertial_number", "",
       "largest rate x mean diameter x sqrt(grain density / mean stress); below 1e-3 the test is "
       "quasi-static",
       [](Fix& fix) { return fix.inertial_number(); }},
  };
  return list;
}

FixCellServo::FixCellServo(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()),
      rate_limit_(options().number("rate_limit")),
      stiffness_(options().number("stiffness")),
      response_time_(options().number("response_time")),
      ramp_time_(options().number("ramp_time")),
      box_(*lammps, groupbit) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string rate = fmt::format("rate_{}", axis_names[k]),
                      stress = fmt::format("stress_{}", axis_names[k]);
    if (options().given(rate) && options().given(stress))
      throw InputError(options().where(stress), "is given with " + rate,
                       "one of them for each axis",
                       "leave one out; without both, the edge keeps its length");
    if (options().given(rate)) axes_[k] = {Axis::Control::rate, options().number(rate)};
    if (options().given(stress)) axes_[k] = {Axis::Control::stress, options().number(stress)};
    if (axes_[k].control == Axis::Control::stress && axes_[k].target > 0.0 &&
        axes_[k].target < usual_stress)
      warn(*lammps, fmt::format("{} is {:g} Pa, less than a layer of grains weighs; give Pa, not "
                                "kPa or MPa",
                                options().where(stress), axes_[k].target));
  }
  if (!domain->xperiodic || !domain->yperiodic || !domain->zperiodic || domain->triclinic)
    throw InputError("fix cell/servo", "is used in a box that is not periodic along x, y and z",
                     "boundary p p p, no tilt",
                     "a cell has no walls; use plate/rigid for ground in a box");
  require_unique<FixCellServo>(*modify, options().subject(), "deforms the box",
                               "one cell/servo, which controls all three axes",
                               [](FixCellServo&) { return true; });
  box_change_size = 1;
  nevery = 1;
  keep_state();
  provide(outputs());
}

/// LIGGGHTS keeps the box.
void FixCellServo::checkpoint(Checkpoint& state) {
  state.value("elapsed", elapsed_);
  state.values("stress", stress_);
  for (std::size_t k = 0; k < 3; ++k) {
    state.value(fmt::format("rate_{}", axis_names[k]), axes_[k].rate);
    state.value(fmt::format("integral_{}", axis_names[k]), axes_[k].integral);
  }
}

int FixCellServo::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::END_OF_STEP;
}

void FixCellServo::post_create() {
  FurrowFix::post_create();
  add_compute(*lmp, {temperature_id, "all", "temp"});
  add_compute(*lmp, {pressure_id, "all", "pressure", temperature_id, "virial"});
}

std::array<double, 3> FixCellServo::rates() const {
  return {axes_[0].rate, axes_[1].rate, axes_[2].rate};
}

void FixCellServo::init() {
  box_.announce(rates());

  const Communicator ranks(&world);
  double sums[] = {0.0, 0.0, 0.0, 0.0};  // mass, solid volume, diameter, count
  for (int i = 0; i < atom->nlocal; ++i) {
    sums[0] += atom->rmass[i];
    sums[1] += atom->rmass[i] / atom->density[i];
    sums[2] += 2.0 * atom->radius[i];
    sums[3] += 1.0;
  }
  ranks.sum(sums, 4);
  mass_ = sums[0];
  grain_density_ = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
  mean_diameter_ = sums[3] > 0.0 ? sums[2] / sums[3] : 0.0;
  modify->compute[modify->find_compute(pressure_id)]->addstep(update->ntimestep + 1);
  collectively([&] {
    check_rates();
    check_stresses();
    check_other_box_changes();
  });
}

/// In a step a grain shall not pass its neighbours.
void FixCellServo::check_rates() const {
  for (std::size_t k = 0; k < 3; ++k) {
    const double largest = axes_[k].control == Axis::Control::rate     ? std::abs(axes_[k].target)
                           : axes_[k].control == Axis::Control::stress ? rate_limit_
                                                                       : 0.0;
    const double strain = largest * update->dt;
    if (strain <= largest_strain_of_step) continue;
    const std::string key = axes_[k].control == Axis::Control::rate
                                ? fmt::format("rate_{}", axis_names[k])
                                : "rate_limit";
    throw InputError(
        options().where(key),
        fmt::format("is {:g} 1/s, a strain of {:.3g} in one step of {:g} s", largest, strain,
                    update->dt),
        fmt::format("at most {:.3g} 1/s with this step", largest_strain_of_step / update->dt),
        "quasi-static tests have less than 1 1/s");
  }
}

/// A stress that is many times the stiffness is no stress of this ground.
void FixCellServo::check_stresses() const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (axes_[k].control != Axis::Control::stress) continue;
    const double most = largest_stress * stiffness_;
    if (axes_[k].target > most)
      throw InputError(
          options().where(fmt::format("stress_{}", axis_names[k])),
          fmt::format("is {:g} Pa, with a stiffness of {:g} Pa", axes_[k].target, stiffness_),
          fmt::format("at most {:g} Pa", most), "lower it, or give the ground's stiffness");
    if (response_time_ < min_steps_of_response * update->dt)
      throw InputError(options().where("response_time"), fmt::format("is {:g} s", response_time_),
                       fmt::format("at least {:g} s, {:g} steps",
                                   min_steps_of_response * update->dt, min_steps_of_response),
                       "the default is 2e-3 s");
  }
}

void FixCellServo::check_other_box_changes() const {
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(*modify))
    if (std::string(fix->style).rfind("deform", 0) == 0)
      throw InputError(
          name(),
          fmt::format("is used with fix {} '{}', which deforms the box too", fix->style, fix->id),
          "one of them", fmt::format("write 'unfix {}' before", fix->id));
}

/// The box moves before the grains: forces of this step belong to the new box.
void FixCellServo::initial_integrate(int) { move_box(); }

/// Proportional and integral: a ground of confined stiffness M answers a strain rate D with a
/// stress rate M D.
double FixCellServo::next_rate(Axis& axis, double stress) const {
  if (axis.control == Axis::Control::hold) return 0.0;
  const double ramp = ramp_time_ > 0.0 ? std::min(1.0, elapsed_ / ramp_time_) : 1.0;
  if (axis.control == Axis::Control::rate) return ramp * axis.target;
  const double limit = ramp * rate_limit_;
  const double proportional = (axis.target - stress) / (stiffness_ * response_time_);
  axis.integral = std::clamp(
      axis.integral + proportional * update->dt / (integral_times * response_time_), -limit, limit);
  return std::clamp(proportional + axis.integral, -limit, limit);
}

void FixCellServo::move_box() {
  double change[3];  // [1/s] of the stretching rate
  double middle[3];  // [m]
  for (std::size_t k = 0; k < 3; ++k) {
    Axis& axis = axes_[k];
    const double rate = next_rate(axis, stress_[k]);
    change[k] = axis.rate - rate;
    axis.rate = rate;
    middle[k] = 0.5 * (domain->boxlo[k] + domain->boxhi[k]);
  }
  box_.advance(rates(), update->dt);
  // A change of the rates takes all grains along at once, so that no wave starts at the faces.
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (int k = 0; k < 3; ++k) atom->v[i][k] += change[k] * (atom->x[i][k] - middle[k]);
  elapsed_ += update->dt;
}

void FixCellServo::end_of_step() { measure(); }

void FixCellServo::measure() {
  LAMMPS_NS::Compute& pressure = *modify->compute[modify->find_compute(pressure_id)];
  pressure.compute_vector();
  for (std::size_t k = 0; k < 3; ++k) stress_[k] = pressure.vector[k];
  pressure.addstep(update->ntimestep + 1);
  for (const double stress : stress_)
    if (!std::isfinite(stress))
      collectively([&] {
        throw StateError(
            fmt::format("{}: the stress is not finite at step {}", name(), update->ntimestep));
      });
}

double FixCellServo::density() const {
  return mass_ / (domain->prd[0] * domain->prd[1] * domain->prd[2]);
}

double FixCellServo::inertial_number() const {
  const double p = (stress_[0] + stress_[1] + stress_[2]) / 3.0;
  double largest = 0.0;
  for (const Axis& axis : axes_) largest = std::max(largest, std::abs(axis.rate));
  return p > 0.0 ? largest * mean_diameter_ * std::sqrt(grain_density_ / p) : 0.0;
}

}  // namespace furrow::coupling
