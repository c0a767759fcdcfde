// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/grains/fix_wall_gran_body.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "atom.h"
#include "contact_interface.h"
#include "furrow/core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/styles/configured_style.h"
#include "coupling/base/checks/settings_check.h"
#include "coupling/contact/grains/fix_mesh_body.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/errors.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/liggghts/data/wall_meshes.h"
#include "fix_neighlist_mesh.h"
#include "furrow/geometry/winding_number.h"
#include "furrow/mpm/continuum_terrain.h"
#include "neighbor.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// Overlap over the radius of a grain: one that overlaps a body by more before the first step would
// be shot out of the bed
constexpr double max_overlap_at_start = 0.1;

}  // namespace

const StyleRow wall_gran_body_style =
    fix_style<FixWallGranBody>("wall/gran/body", "wall", "contact/grains/fix_wall_gran_body.md");

FixWallGranBody::FixWallGranBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixWallGran(lammps, checked(*lammps, narg, arg), arg) {
  if (!is_mesh_wall())
    throw InputError("fix wall/gran/body", "has no mesh", "mesh n_meshes N meshes id1 id2 ...",
                     "use fix wall/gran for primitive walls");
  if (store_force_contact() || store_force_contact_stress())
    throw InputError("fix wall/gran/body, keyword 'store_force_contact'", "is given",
                     "it is not for meshes of bodies",
                     "use store_force for the wall's force on every grain, or the history of the "
                     "body for the sum");
  for (int m = 0; m < n_FixMesh_; ++m)
    if (!dynamic_cast<FixMeshBody*>(FixMesh_list_[m])) stock_meshes_.push_back(FixMesh_list_[m]);
}

/// The words after "n_meshes N meshes"; LIGGGHTS does not say which of them is no mesh.
/// @return narg
int FixWallGranBody::checked(const LAMMPS_NS::LAMMPS& lammps, int narg, char** arg) {
  const std::string where = "fix wall/gran/body";
  check_settings(lammps, where);
  const auto word = [&](int i) { return i >= 0 && i < narg ? std::string(arg[i]) : ""; };
  int first = 0;
  while (first < narg && word(first) != "meshes") ++first;
  const int count = std::atoi(word(first - 1).c_str()), last = first + 1 + count;
  if (first < narg && last > narg)
    throw InputError(where + ", keyword 'n_meshes'",
                     fmt::format("is {}, and {} id(s) follow", count, narg - first - 1),
                     "as many ids as n_meshes", "write 'mesh n_meshes N meshes id1 ... idN'");
  for (int i = first + 1; i < last; ++i) {
    LAMMPS_NS::Fix* fix = lammps.modify->find_fix_id(arg[i]);
    if (!dynamic_cast<LAMMPS_NS::FixMeshSurface*>(fix)) {
      std::string ids;
      for (const auto* mesh : fixes_of<LAMMPS_NS::FixMeshSurface>(*lammps.modify))
        ids += (ids.empty() ? "" : ", ") + std::string(mesh->id);
      throw InputError(where + ", keyword 'meshes'",
                       fix ? fmt::format("has '{}', which is a fix {}", arg[i], style_of(*fix))
                           : fmt::format("has '{}', and no fix has that id", arg[i]),
                       "ids of meshes, here " + (ids.empty() ? "none yet" : "of: " + ids),
                       "write that mesh/body before this line");
    }
    check_single(where, lammps, arg, first + 1, i);
  }
  return narg;
}

/// A body whose surface is in the wall twice would feel each grain twice.
void FixWallGranBody::check_single(const std::string& where, const LAMMPS_NS::LAMMPS& lammps,
                                   char** arg, int first, int last) {
  const auto* mesh = dynamic_cast<FixMeshBody*>(lammps.modify->find_fix_id(arg[last]));
  for (int i = first; mesh && i < last; ++i) {
    const auto* other = dynamic_cast<FixMeshBody*>(lammps.modify->find_fix_id(arg[i]));
    if (other && &other->body() == &mesh->body())
      throw InputError(where + ", keyword 'meshes'",
                       other == mesh ? fmt::format("has '{}' twice", mesh->id)
                                     : fmt::format("has '{}' and '{}', two meshes of one body",
                                                   other->id, mesh->id),
                       "one mesh of each body", "leave one of them out");
  }
}

bool FixWallGranBody::uses(const LAMMPS_NS::Fix& other) const {
  return dynamic_cast<const FixMeshBody*>(&other) &&
         std::find(FixMesh_list_, FixMesh_list_ + n_FixMesh_, &other) != FixMesh_list_ + n_FixMesh_;
}

void FixWallGranBody::setup(int vflag) {
  starting_ = FixCoupledSystem::of(*lmp).time() == 0.0;
  for (int m = 0; m < n_FixMesh_; ++m)
    if (auto* mesh_fix = dynamic_cast<FixMeshBody*>(FixMesh_list_[m])) {
      const auto [check, fresh] = grain_bed_checks_.try_emplace(
          m, *lmp, fmt::format("fix wall/gran/body '{}', mesh '{}'", id, mesh_fix->id));
      if (fresh) check->second.start(mesh_fix->body(), carrying_terrain());
    }
  FixWallGran::setup(vflag);
  if (starting_)
    with_collective_errors(*error, [&] {
      refuse_deep_start();
      refuse_grains_inside();
    });
  starting_ = false;
}

void FixWallGranBody::refuse_deep_start() const {
  const double deepest = FixCoupledSystem::of(*lmp).communicator().max(deepest_);
  if (deepest > max_overlap_at_start)
    throw StateError(
        fmt::format("fix wall/gran/body '{}': a body starts inside the bed: a grain overlaps it by "
                    "{:.3g} of its radius (limit {:g}); start the body higher, just above the "
                    "surface of the bed",
                    id, deepest, max_overlap_at_start));
}

/// Refuses grains inside a body, too far from its surface to touch it: it would never let them out.
void FixWallGranBody::refuse_grains_inside() const {
  constexpr double inside = 0.5;  // winding number above which a point is inside
  for (int m = 0; m < n_FixMesh_; ++m) {
    const auto* mesh = dynamic_cast<const FixMeshBody*>(FixMesh_list_[m]);
    if (!mesh) continue;
    const Surface& surface = mesh->body().surface();
    const auto [lower, upper] = surface.bounds();
    double count = 0.0;
    for (int i = 0; i < atom->nlocal; ++i) {
      const Vector3 centre = Eigen::Map<const Vector3>(atom->x[i]);
      if ((centre.array() > lower.array()).all() && (centre.array() < upper.array()).all() &&
          winding_number(surface, centre) > inside)
        count += 1.0;
    }
    count = FixCoupledSystem::of(*lmp).communicator().sum(count);
    if (count > 0.0)
      throw StateError(
          fmt::format("fix wall/gran/body '{}': {:.0f} grain(s) start inside the body of mesh "
                      "'{}'; start the body where no grains are, just above the surface of the bed",
                      id, count, mesh->id));
  }
}

std::vector<const Body*> FixWallGranBody::bodies() const {
  std::vector<const Body*> found;
  for (int m = 0; m < n_FixMesh_; ++m)
    if (const auto* mesh = dynamic_cast<const FixMeshBody*>(FixMesh_list_[m]))
      found.push_back(&mesh->body());
  return found;
}

/// The first whose surface mesh is in this wall; null without one.
const Body* FixWallGranBody::carrying_terrain() const {
  for (const Body* body : bodies())
    if (dynamic_cast<const ContinuumTerrain*>(body)) return body;
  return nullptr;
}

void FixWallGranBody::post_force_mesh(int vflag) {
  deepest_ = 0.0;
  if (!stock_meshes_.empty()) post_force_stock_meshes(vflag);
  for (int m = 0; m < n_FixMesh_; ++m)
    if (auto* mesh_fix = dynamic_cast<FixMeshBody*>(FixMesh_list_[m]))
      post_force_body(*mesh_fix, m);
}

/// LIGGGHTS wants all meshes in one wall fix; those that are not ours get its own detection.
void FixWallGranBody::post_force_stock_meshes(int vflag) {
  const WallMeshes stock(FixMesh_list_, n_FixMesh_, stock_meshes_);
  FixWallGran::post_force_mesh(vflag);
}

GrainBedCheck* FixWallGranBody::check_of(int mesh_number) {
  const auto found = grain_bed_checks_.find(mesh_number);
  return found == grain_bed_checks_.end() ? nullptr : &found->second;
}

void FixWallGranBody::post_force_body(FixMeshBody& mesh_fix, int mesh_number) {
  FixCoupledSystem& system = FixCoupledSystem::of(*lmp);
  const Body& body = mesh_fix.body();
  const MeshAtWork mesh{mesh_fix,
                        mesh_number,
                        system.moment_reference(body),
                        system.ledger(body),
                        system.contacts(body),
                        check_of(mesh_number)};
  atom_type_wall_ = mesh_fix.atomTypeWall();  // type that the contact model reads
  LAMMPS_NS::FixContactHistoryMesh* history = mesh_fix.contactHistory();
  if (history) history->markAllContacts();

  collect_candidates(mesh_fix);
  // Not in the order in which LIGGGHTS happens to hold its triangles: sums, and so restarts, are
  // the same to the last bit.
  std::sort(touched_.begin(), touched_.end());
  for (const int grain : touched_) {
    of_grain_.clear();
    for (int c = first_[grain]; c >= 0; c = next_[c]) of_grain_.push_back(candidates_[c]);
    first_[grain] = -1;
    selection_.select(of_grain_, atom->radius[grain]);
    for (const ContactCandidate& contact : of_grain_) {
      const double overlap = atom->radius[grain] - contact.point.distance;
      deepest_ = std::max(deepest_, overlap / atom->radius[grain]);
      // setup() refuses it; its force may not even be a number
      const bool refused = starting_ && overlap > max_overlap_at_start * atom->radius[grain];
      if (!refused) apply(mesh, grain, contact);
    }
  }
  if (history) history->cleanUpContacts();
  if (mesh.check) mesh.check->finish_step(body.surface());
}

void FixWallGranBody::collect_candidates(FixMeshBody& mesh_fix) {
  BodyMesh& mesh = mesh_fix.body_mesh();
  const Surface& surface = mesh.body_surface();
  LAMMPS_NS::FixNeighlistMesh& neighbours = *mesh_fix.meshNeighlist();
  // > 1 for models that act before contact
  const double reach_factor = neighbor->contactDistanceFactor;

  candidates_.clear();
  next_.clear();
  touched_.clear();
  if (first_.size() < static_cast<std::size_t>(atom->nlocal)) first_.resize(atom->nmax, -1);

  const double* positions =
      atom->nlocal > 0 ? atom->x[0] : nullptr;  // positions of grains are contiguous
  const int triangles = mesh.sizeLocal() + mesh.sizeGhost();
  for (int t = 0; t < triangles; ++t) {
    const std::vector<int>& grains = neighbours.get_contact_list(t);
    if (grains.empty()) continue;
    const int id_of_triangle = mesh.id(t);
    const Vector3i& nodes = surface.triangles[static_cast<std::size_t>(id_of_triangle)];
    const Vector3 a = surface.x.col(nodes[0]) + mesh.image_shift(t);
    const Vector3 b = surface.x.col(nodes[1]) + mesh.image_shift(t);
    const Vector3 c = surface.x.col(nodes[2]) + mesh.image_shift(t);
    const Vector3 normal = (b - a).cross(c - a).normalized();
    const Vector3 middle = (a + b + c) / 3.0;
    const double bound = std::sqrt(std::max(
        {(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}));

    for (const int grain : grains) {
      if (grain >= atom->nlocal) continue;  // a ghost: its owner has the contact
      const double reach = atom->radius[grain] * reach_factor;
      const Vector3 centre = Eigen::Map<const Vector3>(positions + 3 * grain);
      if (std::abs(normal.dot(centre - a)) > reach) continue;
      if ((centre - middle).squaredNorm() > (reach + bound) * (reach + bound)) continue;
      const ClosestPoint point = closest_point_on_triangle(centre, a, b, c);
      if (!(point.distance <= reach)) continue;
      if (first_[grain] < 0) touched_.push_back(grain);
      candidates_.push_back({point, id_of_triangle, mesh.welded(nodes), t});
      next_.push_back(first_[grain]);
      first_[grain] = static_cast<int>(candidates_.size()) - 1;
    }
  }
}

/// The stored history of this contact. A contact that has just moved over from a neighbouring
/// triangle takes its history along: a grain that slides or rolls over an edge keeps its tangential
/// spring.
double* FixWallGranBody::history_of(LAMMPS_NS::FixContactHistoryMesh& history, const BodyMesh& mesh,
                                    int grain, const ContactCandidate& contact,
                                    bool touching) const {
  const int slots = history.nneighs(grain);
  bool known = false;
  for (int j = 0; j < slots; ++j) known |= history.partner(grain, j) == contact.triangle;

  double* values = nullptr;
  history.handleContact(grain, contact.triangle, values, touching, false);
  if (known || dnum_ == 0) return values;

  int best_slot = -1, max_shared = 0;
  for (int j = 0; j < slots; ++j) {
    const int other = history.partner(grain, j);
    if (other < 0 || other == contact.triangle || contact_seen(history, grain, j)) continue;
    const Vector3i nodes =
        mesh.welded(mesh.body_surface().triangles[static_cast<std::size_t>(other)]);
    int shared = 0;
    for (int k = 0; k < 3; ++k) shared += (nodes.array() == contact.nodes[k]).any();
    if (shared > max_shared) {
      max_shared = shared;
      best_slot = j;
    }
  }
  if (best_slot >= 0) std::copy_n(history.contacthistory(grain, best_slot), dnum_, values);
  return values;
}

/// Computes one contact: its force goes to the grain and, by the weights of the contact point, to
/// the three nodes.
void FixWallGranBody::apply(const MeshAtWork& at_work, int grain, const ContactCandidate& contact) {
  FixMeshBody& mesh_fix = at_work.fix;
  BodyMesh& mesh = mesh_fix.body_mesh();
  Surface& surface = mesh_fix.body().surface();
  const Vector3i& nodes = surface.triangles[static_cast<std::size_t>(contact.triangle)];
  const double radius = atom->radius[grain];
  const double overlap = radius - contact.point.distance;
  const bool touching = overlap >= 0.0;

  LIGGGHTS::ContactModels::SurfacesIntersectData data;
  data.is_wall = true;
  data.i = grain;
  data.radi = radius;
  data.mesh = &mesh;
  data.fix_mesh = &mesh_fix;
  data.deltan = overlap;
  for (int k = 0; k < 3; ++k) data.delta[k] = contact.point.separation[k];
  if (LAMMPS_NS::FixContactHistoryMesh* history = mesh_fix.contactHistory())
    data.contact_history = history_of(*history, mesh, grain, contact, touching);

  Vector3 wall_velocity = Vector3::Zero();
  for (int j = 0; j < 3; ++j)
    wall_velocity += contact.point.barycentric[j] * surface.v.col(nodes[j]);

  Eigen::Map<Vector3> grain_force(atom->f[grain]), grain_torque(atom->torque[grain]);
  const Vector3 force_before = grain_force, torque_before = grain_torque;
  impl->compute_force(this, data, touching, wall_velocity.data(), &mesh_fix, at_work.number, &mesh,
                      contact.tag);
  const Vector3 contact_force = grain_force - force_before;
  const Vector3 contact_torque = grain_torque - torque_before;

  if (!contact_force.allFinite())
    with_local_errors(*error, [&] {
      throw StateError(fmt::format(
          "fix wall/gran/body '{}': the force between grain {} and triangle {} is not finite at "
          "step {}: the grain overlaps the body, which moves there at {:.3g} m/s, by {:.3g} of its "
          "radius; likely causes: a load or sinkage that these grains cannot carry, a speed or "
          "time "
          "step that is too large, a wheel too light for its load",
          id, atom->tag[grain], contact.triangle, update->ntimestep, wall_velocity.norm(),
          overlap / radius));
    });

  // By the weights of the contact point: the three nodes get the force and, because the point is on
  // the triangle, its moment.
  for (int j = 0; j < 3; ++j)
    surface.f.col(nodes[j]) -= contact.point.barycentric[j] * contact_force;

  const Vector3 centre = Eigen::Map<const Vector3>(atom->x[grain]) - mesh.image_shift(contact.tag);
  const Vector3 contact_point = centre - contact.point.separation;
  if (at_work.check) at_work.check->contact(overlap, radius, contact_point, contact_force);
  const Vector3 arm = contact_point - at_work.moment_reference;
  ContactLedger& ledger = at_work.ledger;
  ledger.grain_force += contact_force;
  ledger.grain_moment += arm.cross(contact_force);
  // The grain's own balance: its torque about its centre against the force at the contact point.
  ledger.lever_gap += contact_torque + contact.point.separation.cross(contact_force);
  ledger.force_scale += contact_force.norm();
  ledger.moment_scale += arm.norm() * contact_force.norm();
  ledger.contacts += 1.0;
  const Vector3 normal = contact.point.separation.normalized();
  // LIGGGHTS's arm
  at_work.contacts.push_back({grain, contact_force, contact_torque, normal, contact_point,
                              -(radius - 0.5 * overlap) * normal, wall_velocity});
}

}  // namespace furrow::coupling
