// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/touch_check.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/bodies/fix_mesh_body.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/contact/fix_contact_plane.h"
#include "coupling/contact/fix_wall_gran_body.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "domain.h"
#include "fix_move_mesh.h"

namespace furrow::coupling {

namespace {

constexpr double large_overlap = 0.5;  // of the smaller of two boxes around bodies

bool in_a_wall(const LAMMPS_NS::Modify& modify, const FixMeshBody& mesh) {
  const auto walls = fixes_of<const FixWallGranBody>(modify);
  return std::any_of(walls.begin(), walls.end(),
                     [&](const FixWallGranBody* wall) { return wall->uses(mesh); });
}

bool has_contact(const LAMMPS_NS::Modify& modify, const FixBody& fix) {
  const auto contacts = fixes_of<const FixContact>(modify);
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const FixContact* contact) { return contact->uses(fix); });
}

}  // namespace

bool touches_grains(const LAMMPS_NS::LAMMPS& lammps, const FixBody& body) {
  const auto meshes = fixes_of<const FixMeshBody>(*lammps.modify);
  return std::any_of(meshes.begin(), meshes.end(), [&](const FixMeshBody* mesh) {
    return mesh->uses(body) && in_a_wall(*lammps.modify, *mesh);
  });
}

void check_mesh_walls(const LAMMPS_NS::LAMMPS& lammps) {
  for (const auto* wall : fixes_of<const LAMMPS_NS::FixWallGran>(*lammps.modify)) {
    if (!wall->is_mesh_wall() || dynamic_cast<const FixWallGranBody*>(wall)) continue;
    for (int m = 0; m < wall->n_meshes(); ++m)
      if (const auto* mesh = dynamic_cast<const FixMeshBody*>(wall->mesh_list()[m]))
        throw InputError(fmt::format("fix {} '{}'", wall->style, wall->id),
                         fmt::format("holds the mesh/body '{}', and would not hand the forces of "
                                     "the grains on to its body",
                                     mesh->id),
                         "a mesh/body in a wall/gran/body",
                         "write 'wall/gran/body' in place of 'wall/gran' in that line");
  }
}

void check_mesh_motion(const LAMMPS_NS::LAMMPS& lammps) {
  for (auto* motion : fixes_of<LAMMPS_NS::FixMoveMesh>(*lammps.modify))
    if (const auto* mesh = dynamic_cast<const FixMeshBody*>(motion->fixMesh()))
      throw InputError(
          fmt::format("fix {} '{}'", motion->style, motion->id),
          fmt::format("moves the mesh/body '{}', which goes where its body is", mesh->id),
          "a mesh that no body has", "drive the body: by a wheel/rig, or as a plate/rigid");
}

void warn_of_bodies_that_touch_nothing(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  const LAMMPS_NS::Modify& modify = *lammps.modify;
  for (const auto* mesh : fixes_of<const FixMeshBody>(modify))
    if (!in_a_wall(modify, *mesh))
      warn(
          fmt::format("fix mesh/body '{}' is in no wall/gran/body: grains do not feel it; add 'fix "
                      "<id> all wall/gran/body <contact> mesh n_meshes 1 meshes {}'",
                      mesh->id, mesh->id));
  for (auto* body : fixes_of<FixBody>(modify)) {
    const bool grains = touches_grains(lammps, *body);
    if (const auto* terrain = dynamic_cast<const FixTerrainContinuum*>(body)) {
      if (!has_contact(modify, *body) && !grains && !terrain->options().flag("sheet"))
        warn(fmt::format("nothing presses on {}: no contact/continuum names it", body->name()));
      if (terrain->options().flag("sheet") && !grains)
        warn(
            fmt::format("{} has a sheet that no wall/gran/body holds: grains fall through it; add "
                        "a mesh/body of it",
                        body->name()));
      if (terrain->half_model() && grains && lammps.domain->boxlo[1] < 0.0)
        warn(
            fmt::format("{} is there for y >= 0 only: grains at y < 0 have nothing below them; "
                        "write 'symmetry no', or a box and walls that keep them at y >= 0",
                        body->name()));
    } else if (!grains && !has_contact(modify, *body)) {
      warn(
          fmt::format("{} touches nothing: there is no contact/continuum or contact/plane of it, "
                      "and no mesh/body of it in a wall/gran/body; it will feel no force",
                      body->name()));
    }
  }
}

void warn_of_bodies_in_one_place(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  std::vector<const FixBody*> bodies;
  for (const auto* body : fixes_of<const FixBody>(*lammps.modify))
    if (!dynamic_cast<const FixTerrainContinuum*>(body)) bodies.push_back(body);
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const auto [lower, upper] = bodies[a]->body().surface().bounds();
      const auto [other_lower, other_upper] = bodies[b]->body().surface().bounds();
      const Vector3 common = upper.cwiseMin(other_upper) - lower.cwiseMax(other_lower);
      const double smaller = std::min((upper - lower).prod(), (other_upper - other_lower).prod());
      if (common.minCoeff() > 0.0 && common.prod() > large_overlap * smaller)
        warn(
            fmt::format("{} and {} are in one place, and do not feel one another; move one of "
                        "them or remove its lines",
                        bodies[a]->name(), bodies[b]->name()));
    }
}

/// A road below the base is a hard bottom; above it, it carries what the terrain should.
void warn_of_planes_in_terrain(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  for (const auto* plane : fixes_of<FixContactPlane>(*lammps.modify))
    for (auto* contact : fixes_of<FixContactContinuum>(*lammps.modify)) {
      if (&contact->body_fix() != &plane->body_fix()) continue;
      const double level = plane->options().number("level"),
                   base = contact->terrain_fix().terrain().grid().axis(2).lower();
      if (level <= base) continue;
      warn(
          fmt::format("{} is {:.4g} m, above the base of terrain '{}' at z = {:.4g} m: '{}' stands "
                      "on both; remove one of the contacts",
                      plane->options().where("level"), level, contact->terrain_fix().id, base,
                      plane->body_fix().id));
    }
}

}  // namespace furrow::coupling
