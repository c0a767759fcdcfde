// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/grains/fix_mesh_body.h"

#include <cmath>

#include <fmt/format.h>

#include "atom.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "furrow/geometry/weld.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/styles/find_fix.h"
#include "coupling/base/read_options.h"
#include "coupling/base/fix_body.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/errors.h"
#include "domain.h"
#include "neighbor.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// Nodes nearer than this are one, of the diagonal of the surface's box.
constexpr double weld_distance = 1e-9;
// LIGGGHTS refuses 0.057 degrees, and without more tolerance 0.26 degrees.
constexpr double sharpest_corner = radians(0.06);
// Share of the skin that a node may move before neighbour lists are made again, as LIGGGHTS has it.
constexpr double skin_share = 0.5;

}  // namespace

const StyleRow mesh_body_style =
    fix_style<FixMeshBody>("mesh/body", "mesh", "contact/grains/fix_mesh_body.md");

BodyMesh::BodyMesh(LAMMPS_NS::LAMMPS* lammps, const char* id, const Surface& surface,
                   const Matrix3X& nodes_as_made)
    : TriMesh(lammps), surface_(surface) {
  setMeshID(id);
  setCurvatureTolerant(true);
  if (const double corner = surface.minimum_angle(); corner < sharpest_corner)
    throw InputError(
        fmt::format("mesh '{}'", id),
        fmt::format("has a facet with a corner of {:.2g} degrees", degrees(corner)),
        fmt::format("corners of at least {:g} degrees among grains", degrees(sharpest_corner)),
        "write a mesh without such facets: 'furrow-tyre mesh FILE'");
  // Every triangle on every rank: LIGGGHTS keeps those it owns. Its triangle ids then are our
  // triangle numbers.
  for (const Vector3i& triangle : surface.triangles) {
    const Vector3 shift = shift_into_box(
        (surface.x.col(triangle[0]) + surface.x.col(triangle[1]) + surface.x.col(triangle[2])) /
        3.0);
    double nodes[3][3];
    double* pointers[3] = {nodes[0], nodes[1], nodes[2]};
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) nodes[j][k] = surface.x(k, triangle[j]) + shift[k];
    addElement(pointers, -1);
  }
  if (static_cast<std::size_t>(sizeLocal()) != surface.triangle_count())
    throw StateError(
        fmt::format("mesh '{}': LIGGGHTS took {} of {} triangles; the surface has degenerate or "
                    "double triangles",
                    id, sizeLocal(), surface.triangle_count()));
  velocity_ = prop().addElementProperty<LAMMPS_NS::MultiVectorContainer<double, 3, 3>>(
      "v", "comm_exchange_borders", "frame_invariant", "restart_no");
  velocity_->setAll(0.0);
  const Vector3 period(domain->xperiodic ? domain->prd[0] : 0.0,
                       domain->yperiodic ? domain->prd[1] : 0.0,
                       domain->zperiodic ? domain->prd[2] : 0.0);
  const auto [lower, upper] = surface.bounds();
  weld_ = weld_nodes(nodes_as_made, period, weld_distance * (upper - lower).norm());
  remember_rebuild();
}

/// Shift by whole periods that brings a centre into the box: LIGGGHTS takes no triangle whose
/// centre is outside, and a checkpoint may bring a body that is periods away.
Vector3 BodyMesh::shift_into_box(const Vector3& centre) const {
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  Vector3 shift = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    if (periodic[k])
      shift[k] = -std::floor((centre[k] - domain->boxlo[k]) / domain->prd[k]) * domain->prd[k];
  return shift;
}

void BodyMesh::follow_surface() {
  const int count = sizeLocal() + sizeGhost();
  image_shift_.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) follow(i);
  bbox_.reset();
  for (Eigen::Index n = 0; n < surface_.x.cols(); ++n)
    bbox_.extendToContain(surface_.x.col(n).data());
}

void BodyMesh::follow(int i) {
  const Vector3i& triangle = surface_.triangles[static_cast<std::size_t>(id(i))];
  double* centre = center_(i);
  const Vector3 body_centre =
      (surface_.x.col(triangle[0]) + surface_.x.col(triangle[1]) + surface_.x.col(triangle[2])) /
      3.0;

  Vector3 shift = Vector3::Zero();
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int k = 0; k < 3; ++k)
    if (periodic[k])
      shift[k] = std::round((centre[k] - body_centre[k]) / domain->prd[k]) * domain->prd[k];
  image_shift_[static_cast<std::size_t>(i)] = shift;

  double bound_squared = 0.0;
  for (int k = 0; k < 3; ++k) centre[k] = body_centre[k] + shift[k];
  for (int j = 0; j < 3; ++j) {
    double* node = node_(i)[j];
    double* velocity = (*velocity_)(i)[j];
    double distance_squared = 0.0;
    for (int k = 0; k < 3; ++k) {
      node[k] = surface_.x(k, triangle[j]) + shift[k];
      velocity[k] = surface_.v(k, triangle[j]);
      distance_squared += (node[k] - centre[k]) * (node[k] - centre[k]);
    }
    bound_squared = std::max(bound_squared, distance_squared);
  }
  rBound_(i) = std::sqrt(bound_squared);
  area(i) = calcArea(i);
}

void BodyMesh::derive_edges() {
  for (int i = 0; i < sizeLocal() + sizeGhost(); ++i) derive_edges(i);
}

void BodyMesh::derive_edges(int i) {
  calcEdgeVecLen(i, edgeLen(i), edgeVec(i));
  calcSurfaceNorm(i, surfaceNorm(i));
  calcEdgeNormals(i, edgeNorm(i));
  obtuseAngleIndex(i) = NO_OBTUSE_ANGLE;
  for (int j = 0; j < 3; ++j) {
    const double* ahead = edgeVec(i)[j];
    const double* behind = edgeVec(i)[(j + 2) % 3];
    if (ahead[0] * behind[0] + ahead[1] * behind[1] + ahead[2] * behind[2] > 0.0)
      obtuseAngleIndex(i) = j;
  }
}

void BodyMesh::remember_rebuild() {
  x_at_rebuild_ = surface_.x;
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::max()), upper = -lower;
  double radius = 0.0;
  for (int i = 0; i < atom->nlocal; ++i) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], atom->x[i][k]);
      upper[k] = std::max(upper[k], atom->x[i][k]);
    }
    radius = std::max(radius, atom->radius[i]);
  }
  double extremes[7] = {-lower[0], -lower[1], -lower[2], upper[0], upper[1], upper[2], radius};
  MPI_Allreduce(MPI_IN_PLACE, extremes, 7, MPI_DOUBLE, MPI_MAX, world);
  const double margin = extremes[6] * neighbor->contactDistanceFactor + neighbor->skin;
  for (int k = 0; k < 3; ++k) {
    reach_lower_[k] = -extremes[k] - margin;
    reach_upper_[k] = extremes[3 + k] + margin;
  }
}

/// As LIGGGHTS: half a skin of motion since the lists were made. But a node counts only if one of
/// its triangles overlaps the box of all grains: the upper half of a fast wheel must not force new
/// lists. Replicated data, so all ranks agree.
bool BodyMesh::decideRebuild() {
  const double limit = skin_share * neighbor->skin * (skin_share * neighbor->skin);
  // Along a periodic axis the box of the grains says nothing.
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  const Matrix3X& x = surface_.x;
  for (const Vector3i& t : surface_.triangles) {
    bool within_reach = true;
    for (int k = 0; k < 3; ++k) {
      if (periodic[k]) continue;
      const double a = x(k, t[0]), b = x(k, t[1]), c = x(k, t[2]);
      within_reach &=
          std::max({a, b, c}) >= reach_lower_[k] && std::min({a, b, c}) <= reach_upper_[k];
    }
    if (!within_reach) continue;
    for (int j = 0; j < 3; ++j)
      if ((x.col(t[j]) - x_at_rebuild_.col(t[j])).squaredNorm() > limit) return true;
  }
  return false;
}

Schema FixMeshBody::schema() {
  Schema schema("fix mesh/body");
  schema.text(
      "body",
      "id of the fix of the body: a wheel, tyre or plate, or a terrain with a surface mesh");
  schema.integer("type", Range::at_least(1),
                 "atom type of the surface; selects the contact properties");
  return schema;
}

FixMeshBody::Arguments::Arguments(LAMMPS_NS::LAMMPS& lammps, int narg, char** arg)
    : options(read_options(lammps, schema(), narg, arg)),
      body_fix(find_fix<FixBody>(lammps, options, "body", {"wheel", "body", "terrain"})),
      words{arg[0],
            arg[1],
            "mesh/surface",
            "fix",
            options.text("body"),
            "type",
            std::to_string(options.integer("type"))} {
  for (std::string& word : words) pointers.push_back(word.data());
  if (body_fix.body().half_model())
    throw InputError(options.where("body"),
                     fmt::format("is '{}', which is a half model", options.text("body")),
                     "a whole body", "grains have no plane of symmetry: give the body 'half no'");
  // LIGGGHTS would read properties beyond their end
  if (options.integer("type") > lammps.atom->ntypes)
    throw InputError(options.where("type"), fmt::format("is {}", options.integer("type")),
                     fmt::format("1 to {}, the types of create_box", lammps.atom->ntypes));
}

FixMeshBody::FixMeshBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixMeshBody(lammps, Arguments(*lammps, narg, arg)) {}

FixMeshBody::FixMeshBody(LAMMPS_NS::LAMMPS* lammps, Arguments arguments)
    : FixMeshSurface(lammps, static_cast<int>(arguments.pointers.size()),
                     arguments.pointers.data()),
      options_(arguments.options),
      body_fix_(arguments.body_fix),
      body_(arguments.body_fix.body()),
      body_mesh_(new BodyMesh(lammps, id, body_.surface(), body_fix_.nodes_as_made())) {
  replace_mesh(*this, body_mesh_);
  restart_global = 0;  // the body keeps its own state
}

bool FixMeshBody::uses(const LAMMPS_NS::Fix& other) const { return &other == &body_fix_; }

void FixMeshBody::pre_delete(bool unfixing) {
  if (unfixing) with_collective_errors(*error, [&] { forbid_removal_while_used(*modify, *this); });
  FixMeshSurface::pre_delete(unfixing);
}

int FixMeshBody::setmask() {
  return FixMeshSurface::setmask() | LAMMPS_NS::FixConst::INITIAL_INTEGRATE;
}

void FixMeshBody::check_inside_box() const {
  const auto [lower, upper] = body_.surface().bounds();
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int k = 0; k < 3; ++k)
    if (!periodic[k] && (lower[k] < domain->boxlo[k] || upper[k] > domain->boxhi[k]))
      throw StateError(
          fmt::format("mesh '{}' leaves the simulation box in {} at step {}: it spans {:.6g} to "
                      "{:.6g} m, the box {:.6g} "
                      "to {:.6g} m; make the region of create_box larger or the travel shorter",
                      id, std::string("xyz").at(static_cast<std::size_t>(k)), update->ntimestep,
                      lower[k], upper[k], domain->boxlo[k], domain->boxhi[k]));
}

void FixMeshBody::setup_pre_force(int vflag) {
  with_collective_errors(*error, [&] { check_inside_box(); });
  FixMeshSurface::setup_pre_force(vflag);
  body_mesh_->follow_surface();
  body_mesh_->derive_edges();
  body_mesh_->remember_rebuild();
}

void FixMeshBody::initial_integrate(int) {
  with_collective_errors(*error, [&] { check_inside_box(); });
  body_mesh_->follow_surface();
}

void FixMeshBody::pre_exchange() { exchanged_ = true; }

/// In place of FixMesh::pre_force: node data are known on every rank, so nothing is sent between
/// rebuilds.
void FixMeshBody::pre_force(int) {
  if (exchanged_) {
    body_mesh_->pbcExchangeBorders(0);
    body_mesh_->follow_surface();
    body_mesh_->derive_edges();
    body_mesh_->remember_rebuild();
    exchanged_ = false;
  } else if (body_mesh_->decideRebuild()) {
    next_reneighbor = update->ntimestep + 1;
  }
  body_mesh_->clearReverse();
}

}  // namespace furrow::coupling
