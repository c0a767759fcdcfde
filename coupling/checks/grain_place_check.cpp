// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/grain_place_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/bodies/fix_mesh_body.h"
#include "coupling/checks/grain_motion_check.h"
#include "coupling/checks/lost_grains_check.h"
#include "coupling/checks/touch_check.h"
#include "coupling/contact/fix_wall_gran_body.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "domain.h"
#include "fix_gravity.h"
#include "primitive_wall.h"

namespace furrow::coupling {

namespace {

bool is_wall(const LAMMPS_NS::Fix& fix) { return std::string(fix.style).rfind("wall/", 0) == 0; }

bool are_pulled_down(const LAMMPS_NS::LAMMPS& lammps) {
  Vector3 sum = Vector3::Zero();
  for (auto* fix : fixes_of<LAMMPS_NS::FixGravity>(*lammps.modify)) {
    Vector3 weight;
    fix->get_gravity(weight.data());
    sum += weight;
  }
  return sum.z() < 0.0;
}

/// Planes, which do not end; cylinders along x or y have a lower half.
bool is_below(LAMMPS_NS::PrimitiveWall& wall, double* x) {
  double to_wall[3] = {0.0, 0.0, 0.0};
  wall.resolveContact(x, 0.0, to_wall);
  return to_wall[2] < 0.0 || (to_wall[2] != 0.0 && (to_wall[0] != 0.0 || to_wall[1] != 0.0));
}

/// What may hold up a grain that is above it.
struct Floors {
  std::vector<LAMMPS_NS::PrimitiveWall*> walls;
  std::vector<std::pair<Vector3, Vector3>> bodies;  // corners of the boxes around them
  bool others = false;                              // whose place is not looked at
  double period = 0.0;                              // of the box along x [m]; 0: it has ends

  bool hold(double* x) const {
    return std::any_of(walls.begin(), walls.end(),
                       [&](auto* wall) { return is_below(*wall, x); }) ||
           std::any_of(bodies.begin(), bodies.end(), [&](const auto& corners) {
             const auto& [lower, upper] = corners;
             return is_along(x[0], lower.x(), upper.x()) && x[1] > lower.y() && x[1] < upper.y() &&
                    x[2] > lower.z();
           });
  }
  /// Bodies that go with a wheel may be any number of periods away from the box.
  bool is_along(double x, double lower, double upper) const {
    const double off = x - 0.5 * (lower + upper);
    return std::abs(period > 0.0 ? std::remainder(off, period) : off) <= 0.5 * (upper - lower);
  }
};

Floors find_floors(const LAMMPS_NS::LAMMPS& lammps) {
  Floors floors;
  if (lammps.domain->xperiodic) floors.period = lammps.domain->prd[0];
  for (auto* fix : fixes_of<LAMMPS_NS::Fix>(*lammps.modify)) {
    auto* wall = dynamic_cast<LAMMPS_NS::FixWallGran*>(fix);
    if (!wall)
      floors.others |= is_wall(*fix) || freezes_grains(*fix);
    else if (!wall->is_mesh_wall() && wall->primitiveWall())
      floors.walls.push_back(wall->primitiveWall());
    else
      for (int m = 0; m < wall->n_meshes(); ++m) {
        if (const auto* mesh = dynamic_cast<const FixMeshBody*>(wall->mesh_list()[m]))
          floors.bodies.push_back(mesh->body().surface().bounds());
        else
          floors.others = true;
      }
  }
  return floors;
}

/// Bits of the groups that a fix moves.
int moved_groups(const LAMMPS_NS::Modify& modify) {
  int groups = 0;
  for (const auto* fix : fixes_of<const LAMMPS_NS::Fix>(modify))
    if (moves_grains(*fix)) groups |= fix->groupbit;
  return groups;
}

}  // namespace

void check_grains_in_terrain(LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  if (FixCoupledSystem::of(lammps).time() > 0.0) return;
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  for (const auto* terrain : fixes_of<const FixTerrainContinuum>(*lammps.modify)) {
    double inside = 0.0;
    for (int i = 0; i < atom.nlocal; ++i)
      inside += terrain->contains(Eigen::Map<const Vector3>(atom.x[i])) ? 1.0 : 0.0;
    inside = Communicator(&lammps.world).sum(inside);
    if (inside == 0.0) continue;
    const std::string count = fmt::format("{:.0f} of {:.0f} grains", inside, count_grains(lammps));
    if (touches_grains(lammps, *terrain))
      throw InputError(
          terrain->name(), fmt::format("has {} inside, below the sheet that carries them", count),
          "grains above the surface of the terrain", "put the grains higher, or lower 'surface'");
    warn(
        fmt::format("{} are inside {}, and neither feels the other: two grounds in one place; move "
                    "one of them, or give the terrain 'sheet yes' and a mesh/body, and put the "
                    "grains above it",
                    count, terrain->name()));
  }
}

void warn_of_grains_without_floor(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  if (lammps.atom->natoms == 0 || lammps.domain->zperiodic || !are_pulled_down(lammps)) return;
  const Floors floors = find_floors(lammps);
  if (floors.others) return;
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  const int moved = moved_groups(*lammps.modify);
  double falling = 0.0, still = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) {
    if (!(atom.mask[i] & moved))
      still += 1.0;
    else if (!floors.hold(atom.x[i]))
      falling += 1.0;
  }
  const Communicator ranks(&lammps.world);
  falling = ranks.sum(falling);
  still = ranks.sum(still);
  if (falling == 0.0 || still > 0.0) return;
  warn(
      fmt::format("nothing is below {:.0f} of {:.0f} grains: they fall until they leave the box; "
                  "write 'fix floor all wall/gran <contact> primitive type 1 zplane <z>', or put "
                  "them above a mesh",
                  falling, count_grains(lammps)));
}

}  // namespace furrow::coupling
