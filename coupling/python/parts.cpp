// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/python/parts.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "atom.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/python/arrays.h"

namespace furrow::coupling {

namespace py = pybind11;

namespace {

const std::array<std::string, 6> coordinate_names = {"x", "y", "z", "spin", "yaw", "camber"};

Coordinate coordinate_of(const std::string& name) {
  const auto found = std::find(coordinate_names.begin(), coordinate_names.end(), name);
  if (found == coordinate_names.end())
    throw InputError("coordinate", fmt::format("is '{}'", name),
                     fmt::format("{}", fmt::join(coordinate_names, ", ")));
  return static_cast<Coordinate>(found - coordinate_names.begin());
}

template <class Value>
Six six_of(Value&& value) {
  Six numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = value(static_cast<Coordinate>(i));
  return numbers;
}

/// A number as a script writes it, with all its digits.
std::string written(const py::handle& value) {
  return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
}

}  // namespace

void show_warnings(Session& session) {
  for (const std::string& text : session.take_warnings())
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

py::array BodyPart::nodes() const {
  const Surface& now = surface();
  return view_rows(owner(), now.x.data(), now.node_count());
}

py::array BodyPart::velocities() const {
  const Surface& now = surface();
  return view_rows(owner(), now.v.data(), now.node_count());
}

py::array BodyPart::forces() const {
  const Surface& now = surface();
  return view_rows(owner(), now.f.data(), now.node_count());
}

py::array BodyPart::triangles() const {
  const std::vector<Vector3i>& triangles = surface().triangles;
  static_assert(sizeof(Vector3i) == 3 * sizeof(int));
  return view_rows(owner(), reinterpret_cast<const int*>(triangles.data()), triangles.size());
}

Six WheelPart::position() const {
  return six_of([&](Coordinate c) { return hub().position(c); });
}

Six WheelPart::velocity() const {
  return six_of([&](Coordinate c) { return hub().rate(c); });
}

Six WheelPart::force() const {
  const Wrench wrench = hub().ground_wrench();
  const Vector3 &f = wrench.force, &m = wrench.moment;
  return {f.x(), f.y(), f.z(), m.x(), m.y(), m.z()};
}

Six WheelPart::constraint() const {
  return six_of([&](Coordinate c) { return hub().constraint(c); });
}

std::array<double, 3> WheelPart::load() const {
  const Vector3& load = hub().load();
  return {load.x(), load.y(), load.z()};
}

WheelHub& WheelPart::undriven_hub(const std::string& coordinate) const {
  for (FixWheelRig* rig : fixes_of<FixWheelRig>(*owner()->modify))
    if (&rig->wheel_fix() == &fix<FixWheelHub>() && rig->rig().sets(coordinate))
      throw Error(
          fmt::format("wheel '{}': fix {} sets {} in every step; change the targets of "
                      "that rig, or write the script without it",
                      id(), rig->id, coordinate));
  return hub();
}

/// @throws Error for a force or torque that a held or prescribed coordinate takes up
void WheelPart::require_free(const WheelHub& hub, Coordinate coordinate, const char* what) const {
  const std::string& name = coordinate_names[static_cast<std::size_t>(coordinate)];
  if (hub.motion(coordinate) != WheelHub::Motion::free)
    throw Error(fmt::format(
        "wheel '{}': {} has no effect, because {} is {}; call "
        "release('{}') before",
        id(), what, name, hub.motion(coordinate) == WheelHub::Motion::held ? "held" : "prescribed",
        name));
}

void WheelPart::set_load(const std::array<double, 3>& force) {
  WheelHub& wheel = undriven_hub("the load");
  constexpr Coordinate along[] = {Coordinate::x, Coordinate::y, Coordinate::z};
  constexpr const char* names[] = {"a load along x", "a load along y", "a load along z"};
  for (std::size_t i = 0; i < force.size(); ++i)
    if (force[i] != 0.0) require_free(wheel, along[i], names[i]);
  wheel.set_load({force[0], force[1], force[2]});
}

void WheelPart::set_axle_torque(double torque) {
  WheelHub& wheel = undriven_hub("the axle torque");
  if (torque != 0.0) require_free(wheel, Coordinate::spin, "an axle torque");
  wheel.set_axle_torque(torque);
}

void WheelPart::prescribe(const std::string& coordinate, double rate) {
  const Coordinate c = coordinate_of(coordinate);
  undriven_hub(coordinate).prescribe(c, rate);
}

void WheelPart::hold(const std::string& coordinate) {
  const Coordinate c = coordinate_of(coordinate);
  undriven_hub(coordinate).hold(c);
}

void WheelPart::release(const std::string& coordinate) {
  const Coordinate c = coordinate_of(coordinate);
  undriven_hub(coordinate).release(c);
}

py::list TerrainPart::particles() const {
  py::list materials;
  for (ParticleGroup* group : fix<Terrain>().particle_groups()) {
    Particles& particles = group->particles;
    const std::size_t count = particles.size();
    const auto one = [&](std::size_t column) {
      return view(owner(), particles.data(column), count);
    };
    py::dict columns;
    columns["x"] = one(column::x);
    columns["y"] = one(column::y);
    columns["z"] = one(column::z);
    columns["velocity"] = view_rows(owner(), particles.data(column::velocity), count, 4);
    columns["reference_volume"] = one(column::volume);
    columns["id"] = one(column::id);
    const std::vector<StateField>& fields = group->material->state_fields();
    for (std::size_t i = 0; i < fields.size(); ++i)
      columns[py::str(fields[i].name)] = one(column::state + i);
    materials.append(columns);
  }
  return materials;
}

void RigPart::set(const py::kwargs& targets) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : targets) entries.push_back({py::str(key), {written(value)}});
  session_->change([&] { fix().change_targets(entries); });
  show_warnings(*session_);
}

std::map<std::string, double> RigPart::targets() const {
  std::map<std::string, double> values;
  for (const std::string& key : WheelRig::targets())
    if (fix().options().has(key)) values[key] = fix().options().number(key);
  return values;
}

std::map<std::string, double> RigPart::measure() const {
  const std::vector<double> row = fix().rig().measure(session_->time());
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < row.size(); ++i) values[WheelRig::channels()[i].name] = row[i];
  return values;
}

py::dict grains(const Session& session) {
  const Owner owner = session.liggghts();
  const LAMMPS_NS::Atom& atom = *owner->atom;
  const auto count = static_cast<std::size_t>(atom.nlocal);
  py::dict columns;
  const auto add = [&](const char* name, const auto* data) {
    if (data) columns[name] = view(owner, data, count);
  };
  const auto add_rows = [&](const char* name, double** rows) {
    if (rows) columns[name] = view_rows(owner, count > 0 ? rows[0] : nullptr, count);
  };
  add("id", atom.tag);
  add("type", atom.type);
  add("radius", atom.radius);
  add("mass", atom.rmass);
  add_rows("position", atom.x);
  add_rows("velocity", atom.v);
  add_rows("angular_velocity", atom.omega);
  add_rows("force", atom.f);
  add_rows("torque", atom.torque);
  return columns;
}

}  // namespace furrow::coupling
