// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for where things are: box, grains, bodies and the level of the ground.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/base/checks/grain_check.h"
#include "coupling/base/roles/grain_bed.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/checks/scene_checks.h"
#include "coupling/contact/fix_contact_scm.h"
#include "coupling/terrain/bed/fix_bed_window.h"
#include "domain.h"
#include "furrow/geometry/winding_number.h"
#include "primitive_wall.h"

namespace furrow::coupling {

namespace {

constexpr int shrink_wrapped = 2;       // of Domain::nonperiodic
constexpr double large_overlap = 0.02;  // of the smaller of two boxes around bodies
constexpr double inside = 0.5;          // winding number
constexpr double deep_start = 0.05;     // of the height of a body
constexpr double near_base = 0.1;       // of the depth of a terrain

bool changes_on_purpose(const LAMMPS_NS::LAMMPS& lammps) {
  const auto fixes = fixes_of<const LAMMPS_NS::Fix>(*lammps.modify);
  return lammps.domain->nonperiodic == shrink_wrapped ||
         !fixes_of<const FixBedWindow>(*lammps.modify).empty() ||
         std::any_of(fixes.begin(), fixes.end(), [](const LAMMPS_NS::Fix* fix) {
           return fix->box_change_size || fix->box_change_shape || fix->box_change_domain;
         });
}

std::string text(const Box& box) {
  return fmt::format("({:g} {:g} {:g}) to ({:g} {:g} {:g})", box[0], box[1], box[2], box[3], box[4],
                     box[5]);
}

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

/// True for a point above a plane, which does not end, or above the lower half of a cylinder along
/// x or y.
bool is_below(LAMMPS_NS::PrimitiveWall& wall, double* x) {
  double to_wall[3] = {0.0, 0.0, 0.0};
  wall.resolveContact(x, 0.0, to_wall);
  return to_wall[2] < 0.0 || (to_wall[2] != 0.0 && (to_wall[0] != 0.0 || to_wall[1] != 0.0));
}

/// Walls and bodies that may hold up a grain above them.
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
  /// True for an x within a body's box. Bodies that follow a wheel may be any number of periods
  /// away.
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

/// The first node of the surface mesh inside of the surface; -1 for none.
Eigen::Index node_inside(const Surface& surface, const Surface& mesh) {
  const auto [lower, upper] = surface.bounds();
  for (Eigen::Index n = 0; n < mesh.x.cols(); ++n) {
    const Vector3 node = mesh.x.col(n);
    if ((node.array() > lower.array()).all() && (node.array() < upper.array()).all() &&
        winding_number(surface, node) > inside)
      return n;
  }
  return -1;
}

std::vector<Level> levels_under(LAMMPS_NS::LAMMPS& lammps, const FixBody& fix) {
  std::vector<Level> levels;
  const auto add = [&](const std::optional<Level>& level) {
    if (level) levels.push_back(*level);
  };
  for (auto* contact : fixes_of<FixGroundContact>(*lammps.modify))
    if (&contact->body_fix() == &fix) add(contact->ground().level_under(fix.body()));
  for (auto* contact : fixes_of<FixContactPlane>(*lammps.modify))
    if (&contact->body_fix() == &fix)
      add(exact_level(fix.body(), contact->options().number("level"),
                      fmt::format("the level of fix contact/plane '{}'", contact->id)));
  if (touches_grains(lammps, fix)) add(GrainBed(lammps).level_under(fix.body()));
  return levels;
}

/// Difference of a level from a given one, beyond the tolerance of the level.
double excess(const Level& level, double given) {
  return std::abs(given - level.z) - level.tolerance;
}

/// Level under a body that sets off in this run; of several, the one nearest to a given level.
std::optional<Level> level_at_start(const Scene& scene, const DrivenBody& driven, double given) {
  const double start = driven.options.number("start") + 0.5 * scene.step();
  if (scene.time() > start || scene.end() <= start) return std::nullopt;
  const auto levels = levels_under(scene.lammps, driven.body);
  const auto nearest = std::min_element(
      levels.begin(), levels.end(),
      [&](const Level& a, const Level& b) { return excess(a, given) < excess(b, given); });
  return nearest == levels.end() ? std::nullopt : std::optional(*nearest);
}

/// A keyword that gives the level of the ground under a body that sets off.
CheckResult judge_level(const Scene& scene, const DrivenBody& driven, const Options& options,
                        const std::string& key, const std::string& use) {
  const double given = options.number(key), size = size_of_body(driven.body.body());
  const auto level = level_at_start(scene, driven, given);
  if (!level || excess(*level, given) <= 0.0) return {};
  const std::string problem =
      fmt::format("is {:.6g} m, and {} is at z = {:.6g} m", given, level->what, level->z);
  const std::string remedy = fmt::format("{}; write '{} {:.6g}'", use, key, level->z);
  if (excess(*level, given) > size)
    return refusal(options.where(key), problem,
                   fmt::format("the level of the ground, at least within {:.3g} m, the size of "
                               "the body",
                               size),
                   remedy);
  return warning(fmt::format("{} {}; {}", options.where(key), problem, remedy));
}

}  // namespace

Box edges_of_box(const LAMMPS_NS::LAMMPS& lammps) {
  const double *lower = lammps.domain->boxlo, *upper = lammps.domain->boxhi;
  return {lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]};
}

double count_grains(const LAMMPS_NS::LAMMPS& lammps) {
  return Communicator(&lammps.world).sum(lammps.atom->nlocal);
}

/// Boxes that follow their grains, or that a fix deforms, change on purpose.
CheckResult box_is_as_it_was(const Scene& scene) {
  const Box now = edges_of_box(scene.lammps);
  if (now == scene.box_of_bodies || fixes_of<const FixBody>(*scene.lammps.modify).empty() ||
      changes_on_purpose(scene.lammps))
    return {};
  return warning(
      fmt::format("the box was {} when the first body was made, and is {}: bodies and terrain have "
                  "stayed where they were; change the box before their lines",
                  text(scene.box_of_bodies), text(now)));
}

/// Checked before the first step of a scene.
CheckResult grains_are_above_terrain(const Scene& scene, FixTerrain& terrain) {
  if (scene.time() > 0.0) return {};
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  double below = 0.0;
  for (int i = 0; i < atom.nlocal; ++i)
    below += terrain.contains(Eigen::Map<const Vector3>(atom.x[i])) ? 1.0 : 0.0;
  below = Communicator(&scene.lammps.world).sum(below);
  if (below == 0.0) return {};
  const std::string count = fmt::format("{:.0f} of {:.0f} grains", below, scene.grains);
  if (touches_grains(scene.lammps, terrain))
    return refusal(terrain.name(), fmt::format("has {} inside, below its surface mesh", count),
                   "grains above the surface of the terrain",
                   "put the grains higher, or lower 'surface'");
  return warning(
      fmt::format("{} are inside {} and do not interact with it; move one of the two, or give the "
                  "terrain 'surface_mesh yes' and a mesh/body, and put the "
                  "grains above it",
                  count, terrain.name()));
}

CheckResult grains_have_a_floor(const Scene& scene) {
  const LAMMPS_NS::LAMMPS& lammps = scene.lammps;
  if (lammps.atom->natoms == 0 || lammps.domain->zperiodic || !are_pulled_down(lammps)) return {};
  const Floors floors = find_floors(lammps);
  if (floors.others) return {};
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
  if (falling == 0.0 || still > 0.0) return {};
  return warning(
      fmt::format("nothing is below {:.0f} of {:.0f} grains: they fall until they leave the box; "
                  "write 'fix floor all wall/gran <contact> primitive type 1 zplane <z>', or put "
                  "them above a mesh",
                  falling, count_grains(lammps)));
}

/// A bed/window removes grains on purpose.
CheckResult grains_stay_in_the_box(const Scene& scene) {
  const double lost = scene.grains - count_grains(scene.lammps);
  if (lost <= 0.0 || !fixes_of<const FixBedWindow>(*scene.lammps.modify).empty()) return {};
  return warning(
      fmt::format("{:.0f} of {:.0f} grains have left the box in this run; if they were not meant "
                  "to, look for a time step that is too large or for a wall that is missing",
                  lost, scene.grains));
}

CheckResult body_starts_above_the_field(const Scene& scene, FixContactScm& contact) {
  const auto [lower, upper] = contact.body_fix().body().surface().bounds();
  const double sinkage = contact.contact().step().sinkage;
  if (scene.lammps.update->ntimestep > 1 || sinkage <= deep_start * (upper.z() - lower.z()))
    return {};
  return warning(
      fmt::format("'{}' starts {:.3g} m inside terrain '{}': its rut there is that of the start, "
                  "not of the load; let it start just above the ground",
                  contact.body_fix().id, sinkage, contact.terrain_fix().id));
}

CheckResult axle_stays_above_the_field(const Scene&, FixContactScm& contact) {
  if (!dynamic_cast<const FixWheelHub*>(&contact.body_fix())) return {};
  const auto [lower, upper] = contact.body_fix().body().surface().bounds();
  if (contact.contact().step().sinkage <= 0.5 * (upper.z() - lower.z())) return {};
  return warning(
      fmt::format("'{}' has sunk into terrain '{}' to its axle, where the soil contact model does "
                  "not hold; make the load smaller, or look at the strength of the ground",
                  contact.body_fix().id, contact.terrain_fix().id));
}

CheckResult bodies_are_apart(const Scene& scene, const FixBody& body) {
  const auto is_terrain = [](const FixBody& fix) {
    return dynamic_cast<const Ground*>(&fix) != nullptr;
  };
  if (is_terrain(body)) return {};
  const auto bodies = fixes_of<const FixBody>(*scene.lammps.modify);
  const auto [lower, upper] = body.body().surface().bounds();
  for (auto other = std::find(bodies.begin(), bodies.end(), &body) + 1; other != bodies.end();
       ++other) {
    if (is_terrain(**other)) continue;
    const auto [other_lower, other_upper] = (*other)->body().surface().bounds();
    const Vector3 common = upper.cwiseMin(other_upper) - lower.cwiseMax(other_lower);
    const double smaller = std::min((upper - lower).prod(), (other_upper - other_lower).prod());
    if (common.minCoeff() > 0.0 && common.prod() > large_overlap * smaller)
      return warning(
          fmt::format("{} and {} overlap and do not interact; move one of them or remove its lines",
                      body.name(), (*other)->name()));
  }
  return {};
}

CheckResult plane_is_below_terrain(const Scene& scene, FixContactContinuum& contact) {
  for (const auto* plane : fixes_of<FixContactPlane>(*scene.lammps.modify)) {
    const double level = plane->options().number("level"),
                 base = contact.terrain_fix().terrain().grid().axis(2).lower();
    if (&contact.body_fix() != &plane->body_fix() || level <= base) continue;
    return warning(
        fmt::format("{} is {:.4g} m, above the base of terrain '{}' at z = {:.4g} m: '{}' stands "
                    "on both; remove one of the contacts",
                    plane->options().where("level"), level, contact.terrain_fix().id, base,
                    plane->body_fix().id));
  }
  return {};
}

CheckResult body_starts_at_the_ground(const Scene& scene, const DrivenBody& driven) {
  const auto level = level_at_start(scene, driven, driven.options.number("ground_level"));
  const auto [lower, upper] = driven.body.body().surface().bounds();
  if (!level) {
    const double start = driven.options.number("start") + 0.5 * scene.step();
    const bool sets_off = scene.time() <= start && scene.end() > start;
    if (sets_off && touches_grains(scene.lammps, driven.body) && scene.grains > 0.0)
      return warning(fmt::format("'{}' is not above the grains: none is between its ends and sides",
                                 driven.body.id));
    return {};
  }
  const double gap = lower[2] - level->z;
  if (upper[2] < level->z)
    return warning(
        fmt::format("'{}' starts below the ground: it reaches up to z = "
                    "{:.4g} m, and {} is at z = {:.4g} m; let it start above",
                    driven.body.id, upper[2], level->what, level->z));
  if (driven.options.has("release") && driven.options.text("release") == "in_air" &&
      gap > level->tolerance)
    return warning(
        fmt::format("'{}' starts {:.4g} m above the ground and falls, because {} is in_air: it "
                    "strikes the ground and rests deeper than its load presses it; write 'release "
                    "on_ground' to lower it",
                    driven.body.id, gap, driven.options.where("release")));
  if (gap > size_of_body(driven.body.body()))
    return warning(
        fmt::format("'{}' starts {:.4g} m above the ground, more than its own size: it may not "
                    "come down in time; let it start just above z = {:.4g} m",
                    driven.body.id, gap, level->z));
  return {};
}

CheckResult ground_level_is_the_ground(const Scene& scene, const DrivenBody& driven) {
  return judge_level(scene, driven, driven.options, "ground_level",
                     "it is the datum of the sinkage");
}

CheckResult track_is_at_the_ground(const Scene& scene, const FixGrainWork& work) {
  for (const DrivenBody& driven : driven_bodies(*scene.lammps.modify))
    if (work.uses(driven.body))
      return judge_level(scene, driven, work.options(), "level", "the track begins there");
  return {};
}

CheckResult body_stays_off_the_base(const Scene&, FixContactContinuum& contact) {
  const ContinuumTerrain& terrain = contact.terrain_fix().terrain();
  const Options& options = contact.terrain_fix().options();
  const std::string& kind = options.text("base");
  if (kind != "rough" && kind != "smooth") return {};
  const double base = terrain.grid().axis(2).lower(),
               left = contact.body_fix().body().surface().bounds().first.z() - base;
  if (std::abs(left) > near_base * options.number("depth")) return {};
  return warning(fmt::format(
      "'{}' stands within {:.2g} of the depth above the base of terrain '{}': the base "
      "carries it, and not the ground; make the terrain deeper, or look at its strength",
      contact.body_fix().id, near_base, contact.terrain_fix().id));
}

/// All ranks agree, because surfaces are replicated.
CheckResult body_stays_off_the_surface_mesh(const Scene&, const FixWallGranBody& wall) {
  const std::vector<const Body*> bodies = wall.bodies();
  const auto is_terrain = [](const Body* body) {
    return dynamic_cast<const ContinuumTerrain*>(body) != nullptr;
  };
  for (const Body* terrain : bodies)
    for (const Body* body : bodies) {
      if (!is_terrain(terrain) || is_terrain(body)) continue;
      const Surface& mesh = terrain->surface();
      const Eigen::Index node = node_inside(body->surface(), mesh);
      if (node < 0) continue;
      Finding found = warning(
          fmt::format("fix wall/gran/body '{}': a body has come through the grains to the surface "
                      "mesh of the terrain, at {:.4g} {:.4g} {:.4g} m, and does not interact with "
                      "it; make the layer of grains deeper, or the trough wider",
                      wall.id, mesh.x(0, node), mesh.x(1, node), mesh.x(2, node)));
      found.stops = true;
      return found;
    }
  return {};
}

}  // namespace furrow::coupling
