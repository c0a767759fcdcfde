// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Ground as the other jobs see it. A Ground is the bed of grains (grain_bed.h) or a Terrain, which
/// a line terrain/... makes: the continuum (fix_terrain.h) or the height field (fix_scm.h).
/// Contacts press on it, a rig tilts its gravity, terrain/history records it, checks compare it
/// with bodies. Each class adds the functions that it alone has.

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/core/options/options.h"
#include "furrow/core/options/outputs.h"
#include "furrow/core/types.h"
#include "furrow/geometry/surface.h"
#include "lammps.h"
#include "furrow/material/ground_contact.h"
#include "furrow/mpm/terrain_snapshot.h"

namespace furrow::coupling {

/// The level of something under a body, and how well it is known.
struct Level {
  double z;          ///< [m]
  double tolerance;  ///< [m]
  std::string what;  ///< for messages: "the surface of terrain 'soil'"
};
/// An exact level under a body.
Level exact_level(const Body& body, double z, const std::string& what);
/// Largest edge of the box around a body [m].
double size_of_body(const Body& body);

/// Gravity as one line of the script gives it.
struct GivenGravity {
  std::string where;  ///< that line, for messages
  Vector3 vector;     ///< [m/s^2]
};

class Ground {
 public:
  virtual ~Ground() = default;
  /// Extent of the undisturbed ground along x, y or z [m].
  virtual std::pair<double, double> extent(int direction) const = 0;
  /// True if the ground follows a body, and drops what lies behind it.
  virtual bool moves() const { return false; }
  /// Level of the undisturbed ground under a body; none without ground there. Collective.
  virtual std::optional<Level> level_under(const Body& body) const = 0;
  /// Every gravity that this ground depends on.
  virtual std::vector<GivenGravity> gravities() const = 0;
  /// Size of its state in a checkpoint [bytes]. Collective.
  virtual double checkpoint_size() const = 0;
};

/// The kinds of style whose fix is a Terrain.
inline const std::vector<std::string> terrain_kinds = {"terrain", "scm"};

class Terrain : public Ground {
 public:
  virtual const Options& line() const = 0;
  std::optional<Level> level_under(const Body& body) const override;
  virtual double level() const = 0;  ///< z of the undisturbed surface, without its relief [m]

  // ---- resolution
  virtual Vector3 shortest_cell() const = 0;  ///< along x, y and z [m]
  /// Cells along x, y and z that a box spans, fractions included; NaN along z without such cells.
  virtual Vector3 cells_across(const Vector3& lower, const Vector3& upper) const = 0;
  virtual std::string finer_cells() const = 0;  ///< remedy for cells that are too large

  /// Contact of bodies with the upper layer or the first patch.
  struct KnownContact {
    std::string source;  ///< name of that soil
    GroundContact values;
  };
  virtual KnownContact known_contact() const = 0;
  /// Turns the gravity of the line; ground without weight ignores it.
  virtual void tilt_gravity(const Matrix3&) {}
  /// Particles that every sub-step updates. Collective.
  virtual double particle_count() const { return 0.0; }
  /// Those of this rank, by material, as the last transfer left them.
  virtual std::vector<ParticleGroup*> particle_groups() { return {}; }

  // ---- results. Functions are collective.
  virtual std::string title() const = 0;
  /// Name of files: <series>.h5 and vtk/<series>.pvd.
  virtual std::string series() const = 0;
  virtual std::vector<Channel> channels() const = 0;
  virtual std::vector<double> values() = 0;  ///< of the channels now
  /// Particles, or the surface; on the first rank.
  virtual std::variant<TerrainSnapshot, Surface> snapshot() = 0;
  /// Points of the surface where the terrain was dropped, on the first rank.
  virtual std::vector<RutPoint> rut() const { return {}; }
  /// None without a balance of energies.
  virtual std::optional<EnergyBudget> energy_budget() const { return {}; }
  /// Nodes and triangles of the surface now; none if nothing shows it. Valid until the next call.
  virtual const Surface& surface() = 0;
};

/// True if two terrains share more than a face.
bool overlap(const Terrain& a, const Terrain& b);

}  // namespace furrow::coupling
