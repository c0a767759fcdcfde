// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The parts of a scene as Python sees them. Each finds its fix by the id at every call, so that it
/// can outlive the fix.

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "furrow/bodies/wheel_hub.h"
#include "furrow/core/error.h"
#include "coupling/base/fix_body.h"
#include "coupling/base/roles/ground.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/session/session.h"
#include "modify.h"

namespace furrow::coupling {

template <class FixClass>
class Part {
 public:
  Part(std::shared_ptr<Session> session, std::string id)
      : session_(std::move(session)), id_(std::move(id)) {}
  const std::string& id() const { return id_; }

 protected:
  template <class Wanted = FixClass>
  Wanted& fix() const {
    auto* found = dynamic_cast<Wanted*>(session_->liggghts()->modify->find_fix_id(id_.c_str()));
    if (!found) throw Error("fix '" + id_ + "' is no longer part of the simulation");
    return *found;
  }
  std::shared_ptr<LAMMPS_NS::LAMMPS> owner() const { return session_->liggghts(); }

  std::shared_ptr<Session> session_;
  std::string id_;
};

/// A wheel, a tyre, a plate or a terrain: its surface. All arrays are views.
class BodyPart : public Part<FixBody> {
 public:
  using Part::Part;
  virtual ~BodyPart() = default;
  pybind11::array nodes() const;       ///< [m]
  pybind11::array velocities() const;  ///< [m/s]
  pybind11::array forces() const;      ///< [N]
  pybind11::array triangles() const;

 private:
  virtual const Surface& surface() const { return fix().body().surface(); }
};

/// Six numbers: x, y, z, spin, yaw, camber; or forces along and moments about x, y, z.
using Six = std::array<double, 6>;

class WheelPart : public BodyPart {
 public:
  using BodyPart::BodyPart;
  Six position() const;                ///< [m, rad]
  Six velocity() const;                ///< [m/s, rad/s] half a step ago
  Six force() const;                   ///< of the ground [N, N m]
  Six constraint() const;              ///< of what holds or moves the axle [N, N m]
  std::array<double, 3> load() const;  ///< [N]
  void set_load(const std::array<double, 3>& force);
  void set_axle_torque(double torque);  ///< [N m]
  void prescribe(const std::string& coordinate, double rate);
  void hold(const std::string& coordinate);
  void release(const std::string& coordinate);
  double radius() const { return hub().nominal_radius(); }  ///< [m]
  double mass() const { return hub().total_mass(); }        ///< [kg]

 private:
  WheelHub& hub() const { return fix<FixWheelHub>().hub(); }
  void require_free(const WheelHub& hub, Coordinate coordinate, const char* what) const;
  /// @throws Error where a rig sets this coordinate, the load or the torque in every step
  WheelHub& undriven_hub(const std::string& coordinate) const;
};

class TerrainPart : public BodyPart {
 public:
  using BodyPart::BodyPart;
  double level() const { return fix<Terrain>().level(); }  ///< [m]
  /// The particles of this rank, if the ground has some: for each material a view of each column.
  /// Positions and velocities may be those of the last transfer; bringing them up to date would
  /// change the run by rounding.
  pybind11::list particles() const;

 private:
  const Surface& surface() const override { return fix<Terrain>().surface(); }
};

class RigPart : public Part<FixWheelRig> {
 public:
  using Part::Part;
  void set(const pybind11::kwargs& targets);
  std::map<std::string, double> targets() const;
  std::map<std::string, double> measure() const;
};

/// Shows warnings as those of Python, where its caller stands. @throws error_already_set if they
/// are errors
void show_warnings(Session& session);

/// Grains of this rank. All arrays are views.
pybind11::dict grains(const Session& session);

}  // namespace furrow::coupling
