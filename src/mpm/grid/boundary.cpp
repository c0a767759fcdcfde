// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/boundary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// The plane of nodes of a face, and the two axes along it; x is the slow one of them whenever it
/// is one.
struct FacePlane {
  int axis;
  int plane;
  int slow;
  int fast;
};

FacePlane plane_of(const Grid& grid, Face face) {
  const int axis = axis_of(face);
  return {axis, is_upper(face) ? grid.nodes(axis) - 1 : 0, axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

using NodeIndex = std::array<int, 3>;  // along x, y, z

/// Calls visit(number on the face, index in the grid) for the nodes of a face inside a block.
template <class Visit>
void for_face(const Grid& grid, const FacePlane& face, const NodeBlock& block, Visit visit) {
  const NodeRange inside[3] = {block.x, block.y, {0, grid.nodes(2)}};
  if (!inside[face.axis].contains(face.plane)) return;
  NodeIndex node;
  const auto slow = static_cast<std::size_t>(face.slow);
  const auto fast = static_cast<std::size_t>(face.fast);
  node[static_cast<std::size_t>(face.axis)] = face.plane;
  for (int s = inside[slow].from; s < inside[slow].to; ++s)
    for (int f = inside[fast].from; f < inside[fast].to; ++f) {
      node[slow] = s;
      node[fast] = f;
      visit(static_cast<std::size_t>(s * grid.nodes(face.fast) + f), node);
    }
}

}  // namespace

const std::vector<std::string>& boundary_kind_names() {
  static const std::vector<std::string> names = {"free", "smooth", "rough", "absorbing"};
  return names;
}

BoundaryKind boundary_kind(const std::string& name) {
  const auto& names = boundary_kind_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(fmt::format("there is no face of kind '{}'", name));
  return static_cast<BoundaryKind>(found - names.begin());
}

Boundary::Boundary(const Grid& grid, const FaceArray<BoundaryKind>& kinds,
                   const std::array<int, 3>& particles_per_cell,
                   std::vector<WaveSpeeds> speeds_of_level)
    : kinds_(kinds), speeds_(std::move(speeds_of_level)) {
  impulse_.fill(Vector3::Zero());
  far_.assign(static_cast<std::size_t>(grid.fields()), far_fields(grid, particles_per_cell));
  has_initial_tractions_ =
      std::find(kinds_.begin(), kinds_.end(), BoundaryKind::absorbing) == kinds_.end();
}

Boundary::FarFields Boundary::far_fields(const Grid& grid,
                                         const std::array<int, 3>& particles_per_cell) const {
  FarFields far_fields;
  for (const Face face : all_faces) {
    if (kinds_[face] != BoundaryKind::absorbing) continue;
    const FacePlane plane = plane_of(grid, face);
    const Axis& axis = grid.axis(plane.axis);
    FarField& far = far_fields[face];
    far.axis = plane.axis;
    far.plane = plane.plane;
    far.nodes[0] = grid.nodes(plane.slow);
    far.nodes[1] = grid.nodes(plane.fast);
    // A node's mass is summed over particles: the midpoint rule for the integral of (1 - xi)^2 over
    // the outermost cell.
    const double n = particles_per_cell[static_cast<std::size_t>(plane.axis)];
    const double cell = axis.length(plane.plane == 0 ? 0 : axis.cells() - 1);
    far.inverse_extent = 1.0 / (cell * (1.0 / 3.0 - 1.0 / (12.0 * n * n)));
    // For a load in the middle of the top, the far field begins half a width away sideways and a
    // depth away downwards. Ground that a smooth face ends, a plane of symmetry, is half of the
    // width.
    const bool whole = plane.axis == 2 || kinds_[opposite(face)] == BoundaryKind::smooth;
    far.inverse_length = (whole ? 1.0 : 2.0) / (axis.upper() - axis.lower());
    far.decay = std::exp(-cell * far.inverse_length);
    far.initial_force.assign(static_cast<std::size_t>(3 * far.nodes[0] * far.nodes[1]), 0.0);
    far.displacement = far.initial_force;
  }
  return far_fields;
}

/// Calls visit(far field) for the absorbing faces of each velocity field.
template <class Visit>
void Boundary::for_far_fields(Visit visit) {
  for (FarFields& of_field : far_)
    for (FarField& far : of_field)
      if (!far.initial_force.empty()) visit(far);
}

void Boundary::capture_initial_tractions(Grid& grid, const NodeBlock& local,
                                         const Vector3& gravity) {
  has_initial_tractions_ = true;
  for (int field = 0; field < grid.fields(); ++field)
    for (const Face face : all_faces) {
      if (kinds_[face] != BoundaryKind::absorbing) continue;
      FarField& far = far_[static_cast<std::size_t>(field)][face];
      for_face(grid, plane_of(grid, face), local, [&](std::size_t number, const NodeIndex& node) {
        NodeSum& sum = grid.sum(node[0], node[1], node[2], field);
        double& mass = grid.motion(node[0], node[1], node[2], field).mass;
        for (int c = 0; c < 3; ++c)
          far.initial_force[3 * number + static_cast<std::size_t>(c)] =
              -sum.total[c] - mass * gravity[c];
        sum = NodeSum{};  // a node on an edge is held by one face only
        mass = 0.0;
      });
    }
}

double Boundary::speed_of(const FarField& far, const NodeIndex& node, int component) const {
  const WaveSpeeds& speeds = speeds_[static_cast<std::size_t>(node[2])];
  return component == far.axis ? speeds.pressure : speeds.shear;
}

/// Acceleration by the spring and by t_0, in a component n of the far field [m/s^2].
double Boundary::held_acceleration(const FarField& far, std::size_t n, double speed, double mass) {
  return far.initial_force[n] / mass -
         speed * speed * far.inverse_extent * far.inverse_length * far.displacement[n];
}

/// A node on an edge is held by one face only: the others forget what they hold there.
void Boundary::release(const Grid& grid, FarFields& far_fields, Face holder,
                       const NodeIndex& node) const {
  const auto along = [&](int axis) { return node[static_cast<std::size_t>(axis)]; };
  for (const Face face : all_faces) {
    const FacePlane plane = plane_of(grid, face);
    if (face == holder || kinds_[face] != BoundaryKind::absorbing ||
        along(plane.axis) != plane.plane)
      continue;
    const auto number =
        static_cast<std::size_t>(along(plane.slow) * grid.nodes(plane.fast) + along(plane.fast));
    for (std::size_t n = 3 * number; n < 3 * number + 3; ++n)
      far_fields[face].initial_force[n] = far_fields[face].displacement[n] = 0.0;
  }
}

void Boundary::renew_tractions(Grid& grid, const NodeBlock& local, const Vector3& gravity) {
  if (!std::exchange(renewal_due_, false)) return;
  constexpr Face behind = Face::x_lower;
  for (int field = 0; field < grid.fields(); ++field) {
    FarFields& far_fields = far_[static_cast<std::size_t>(field)];
    FarField& far = far_fields[behind];
    for_face(grid, plane_of(grid, behind), local, [&](std::size_t number, const NodeIndex& node) {
      release(grid, far_fields, behind, node);
      const NodeSum& sum = grid.sum(node[0], node[1], node[2], field);
      const NodeMotion& motion = grid.motion(node[0], node[1], node[2], field);
      for (int c = 0; c < 3; ++c) {
        const std::size_t n = 3 * number + static_cast<std::size_t>(c);
        const double dashpot = speed_of(far, node, c) * far.inverse_extent * motion.velocity[c];
        far.initial_force[n] = motion.mass * (dashpot - gravity[c]) - sum.total[c];
        far.displacement[n] = 0.0;
      }
    });
  }
}

void Boundary::apply(Grid& grid, const NodeBlock& local, const NodeBlock& owned, double dt) {
  for (int field = 0; field < grid.fields(); ++field)
    for (const Face face : all_faces)
      if (kinds_[face] == BoundaryKind::absorbing) absorb(grid, field, face, local, owned, dt);
  for (const Face face : all_faces) constrain(grid, face, local, owned);
}

void Boundary::constrain(Grid& grid, Face face, const NodeBlock& local, const NodeBlock& owned) {
  if (kinds_[face] != BoundaryKind::smooth && kinds_[face] != BoundaryKind::rough) return;
  const FacePlane plane = plane_of(grid, face);
  for_face(grid, plane, local, [&](std::size_t, const NodeIndex& index) {
    for (int field = 0; field < grid.fields(); ++field) {
      NodeMotion& node = grid.motion(index[0], index[1], index[2], field);
      for (int c = 0; c < 3; ++c) {
        if (kinds_[face] == BoundaryKind::smooth && c != plane.axis) continue;
        if (owned.contains(index[0], index[1])) impulse_[face][c] -= node.mass * node.velocity[c];
        node.velocity[c] = 0.0;
      }
    }
  });
}

bool Boundary::is_fixed(const Grid& grid, const std::array<int, 3>& node, int component) const {
  for (const Face face : all_faces) {
    const FacePlane plane = plane_of(grid, face);
    if (node[static_cast<std::size_t>(plane.axis)] != plane.plane) continue;
    if (kinds_[face] == BoundaryKind::rough ||
        (kinds_[face] == BoundaryKind::smooth && plane.axis == component))
      return true;
  }
  return false;
}

Vector3 Boundary::hold(const Grid& grid, const NodeIndex& node, double mass, Vector3 force,
                       FaceArray<Vector3>& reactions) const {
  for (const Face face : all_faces) {
    const FacePlane plane = plane_of(grid, face);
    const auto along = [&](int axis) { return node[static_cast<std::size_t>(axis)]; };
    if (kinds_[face] == BoundaryKind::free || along(plane.axis) != plane.plane) continue;
    const bool absorbs = kinds_[face] == BoundaryKind::absorbing;
    const FarField& far = far_[0][face];
    const auto number =
        static_cast<std::size_t>(along(plane.slow) * grid.nodes(plane.fast) + along(plane.fast));
    for (int c = 0; c < 3; ++c) {
      double reaction = 0.0;
      if (kinds_[face] == BoundaryKind::rough || (!absorbs && c == plane.axis))
        reaction = -force[c];
      else if (absorbs && !is_fixed(grid, node, c)) {
        const std::size_t n = 3 * number + static_cast<std::size_t>(c);
        const double speed = speed_of(far, node, c);
        reaction = far.initial_force[n] - mass * speed * speed * far.inverse_extent *
                                              far.inverse_length * far.displacement[n];
      }
      reactions[face][c] += reaction;
      force[c] += reaction;
    }
  }
  return force;
}

void Boundary::add_impulses(const FaceArray<Vector3>& forces, double dt) {
  for (const Face face : all_faces) impulse_[face] += dt * forces[face];
}

void Boundary::absorb(Grid& grid, int field, Face face, const NodeBlock& local,
                      const NodeBlock& owned, double dt) {
  FarField& far = far_[static_cast<std::size_t>(field)][face];
  for_face(grid, plane_of(grid, face), local, [&](std::size_t number, const NodeIndex& index) {
    NodeMotion& node = grid.motion(index[0], index[1], index[2], field);
    if (!(node.mass > 0.0)) return;
    for (int c = 0; c < 3; ++c) {
      if (is_fixed(grid, index, c)) continue;
      const double speed = speed_of(far, index, c);
      const std::size_t n = 3 * number + static_cast<std::size_t>(c);
      const double before = node.velocity[c];
      const double pull = dt * held_acceleration(far, n, speed, node.mass);
      const double after = (before + pull) / (1.0 + dt * speed * far.inverse_extent);
      node.velocity[c] = after;
      far.displacement[n] += dt * after;
      if (owned.contains(index[0], index[1])) {
        const double impulse = node.mass * (after - before);
        impulse_[face][c] += impulse;
        work_ += impulse * after;
      }
    }
  });
}

void Boundary::shift_x(int cells) {
  for_far_fields([&](FarField& far) {
    if (far.axis == 0) {
      if (far.plane == 0) {
        renewal_due_ = true;
      } else {
        const double share = std::pow(far.decay, cells);
        for (double& u : far.displacement) u *= share;
      }
      return;
    }
    // The two outermost rows of nodes at each end stay, as their splines are those of the ends; the
    // rows between move with the ground. A row that enters ahead is undisturbed: it has the initial
    // force of the row beside it and no displacement.
    const long row = 3L * far.nodes[1];
    const long leaving = row * cells;
    const std::vector<double> force(far.initial_force.end() - 3 * row,
                                    far.initial_force.end() - 2 * row);
    const std::vector<double> zero(force.size(), 0.0);
    for (auto [values, entering] :
         {std::pair{&far.initial_force, &force}, std::pair{&far.displacement, &zero}}) {
      values->erase(values->begin() + 2 * row, values->begin() + 2 * row + leaving);
      for (int i = 0; i < cells; ++i)
        values->insert(values->end() - 2 * row, entering->begin(), entering->end());
    }
  });
}

void Boundary::synchronise(const Communicator& ranks, const NodeBlock& owned) {
  if (ranks.size() == 1) return;
  for_far_fields([&](FarField& far) {
    for (std::vector<double>* values : {&far.initial_force, &far.displacement}) {
      for (std::size_t n = 0; n < values->size(); ++n) {
        const int number = static_cast<int>(n / 3);
        const int slow = number / far.nodes[1], fast = number % far.nodes[1];
        const int x = far.axis == 0 ? far.plane : slow;
        const int y = far.axis == 0 ? slow : far.axis == 1 ? far.plane : fast;
        if (!owned.contains(x, y)) (*values)[n] = 0.0;
      }
      ranks.sum(values->data(), values->size());
    }
  });
}

void Boundary::sum_over_ranks(const Communicator& ranks) {
  for (Vector3& impulse : impulse_) ranks.sum(impulse.data(), 3);
  work_ = ranks.sum(work_);
}

void Boundary::checkpoint(Checkpoint& state, bool keep_sums) {
  state.value("has_initial_tractions", has_initial_tractions_);
  state.value("renewal_due", renewal_due_);
  state.value("work", work_);
  for (Vector3& impulse : impulse_) state.values("impulse", impulse);
  if (!keep_sums) {
    work_ = 0.0;
    impulse_.fill(Vector3::Zero());
  }
  for_far_fields([&](FarField& far) {
    state.values("initial_force", far.initial_force.data(), far.initial_force.size());
    state.values("far_displacement", far.displacement.data(), far.displacement.size());
  });
}

}  // namespace furrow
