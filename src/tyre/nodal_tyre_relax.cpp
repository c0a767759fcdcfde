// SPDX-License-Identifier: GPL-2.0-or-later
// Relaxation of a NodalTyre, and vibration about its rest: its nodes move, its rim is the support.

#include <algorithm>
#include <cmath>
#include <utility>

#include "furrow/tyre/nodal_tyre.h"

namespace furrow {

namespace {

constexpr double loading_time = 0.12;       // [s]
constexpr double loading_damping = 2000.0;  // [1/s] of the tread
constexpr double rim_damping = 60.0;        // [1/s]
// Damping rate of the tread after the loading [1/s]: wrinkles that snap must not swing
constexpr double wrinkle_damping = 200.0;
constexpr double disturbance = 1e-3;  // [m/s]
// Pressure [Pa] whose forces are the least scale of unbalanced ones
constexpr double minimum_pressure_scale = 1e3;

}  // namespace

class NodalTyre::Relaxing : public RelaxingStructure {
 public:
  Relaxing(NodalTyre& tyre, RigidPlane* plane, bool under_load)
      : tyre_(tyre), plane_(plane), under_load_(under_load), forces_of_others_(surface().f) {}

  ShellNodes& nodes() override { return tyre_.nodes_; }

  double compute_forces() override {
    tyre_.compute_internal();
    surface().f = forces_of_others_;
    if (plane_) plane_->press_on(surface());
    tyre_.compute_contact();
    const double internal = tyre_.internal_on_rim().force.z();
    nodes().force += tyre_.contact_;
    return internal + tyre_.contact_on_rim_.force.z() + tyre_.load().z();
  }

  void follow(double axle_height) override {
    tyre_.rest_at({tyre_.centre().x(), tyre_.centre().y(), axle_height});
    tyre_.place_beads();
    tyre_.place_surface();
  }

  bool carries_its_load(double tolerance) const override {
    if (!under_load_) return true;
    const double load = tyre_.load().z();
    const double carried = tyre_.copies() * tyre_.surface().f.row(2).sum() + load;
    return std::abs(carried) < tolerance * std::abs(load);
  }

  void finish() {
    surface().f = forces_of_others_;
    tyre_.count_stored_energy();
    tyre_.place_surface();
  }

 private:
  Surface& surface() { return tyre_.surface(); }

  NodalTyre& tyre_;
  RigidPlane* plane_;
  bool under_load_;
  Matrix3X forces_of_others_;  // [N]
};

Relaxation NodalTyre::relax(RigidPlane* plane, const SettleOptions& options) {
  RelaxationSupport rim;
  const bool under_load = motion(Coordinate::z) == Motion::free && !options.axle_height;
  if (under_load) rim.motion = RelaxationSupport::Motion::free;
  if (options.axle_height) rim.motion = RelaxationSupport::Motion::prescribed;
  rim.height = centre().z();
  rim.target = options.axle_height.value_or(rim.height);
  rim.mass = copies() * nodes_.mass.sum();
  rim.damping = rim_damping;

  RelaxationSettings settings;
  settings.time_step = relaxation_step();
  settings.force_scale = std::max(pressure_, minimum_pressure_scale) * tread_area() / copies() /
                         static_cast<double>(nodes_.count());
  settings.tolerance = options.tolerance;
  settings.max_steps = options.max_steps;
  settings.loading_time = loading_time;
  settings.loading_damping = loading_damping;
  settings.relaxation_damping = wrinkle_damping;
  settings.disturbance = disturbance;

  Relaxing structure(*this, plane, under_load);
  const Relaxation result = DynamicRelaxation(structure, rim, settings).run();
  structure.finish();
  return result;
}

NaturalModes NodalTyre::modes_with(const std::vector<int>& held, int count) {
  const ShellNodes rest = nodes_;
  for (const int k : held) nodes_.hold(tread_node(k));
  Relaxing structure(*this, nullptr, false);
  NaturalModes modes = furrow::natural_modes(structure, neighbours(), count);
  nodes_ = rest;
  compute_internal();
  for (Matrix3X& shape : modes.shape) {
    Matrix3X of_tread(3, tread_grid().count());
    for (int k = 0; k < tread_grid().count(); ++k) of_tread.col(k) = shape.col(tread_node(k));
    shape = std::move(of_tread);
  }
  return modes;
}

}  // namespace furrow
