// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/boundary.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

struct FaceLoop {
  // the directions along the face; x is slow whenever it is one of them
  int axis, plane, slow, fast;
};

FaceLoop loop_of(const Grid& grid, Face face) {
  const int axis = face / 2;
  return {axis, face % 2 == 0 ? 0 : grid.nodes(axis) - 1, axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

using Place = std::array<int, 3>;  // of a node, along x, y, z

/// Calls visit(number on the face, place in the grid) for the nodes of a face inside the planes.
template <class Visit>
void for_face(const Grid& grid, const FaceLoop& loop, const PlaneRange& planes, Visit visit) {
  Place at;
  const auto axis = static_cast<std::size_t>(loop.axis), slow = static_cast<std::size_t>(loop.slow),
             fast = static_cast<std::size_t>(loop.fast);
  at[axis] = loop.plane;
  std::size_t number = 0;
  for (int s = 0; s < grid.nodes(loop.slow); ++s)
    for (int f = 0; f < grid.nodes(loop.fast); ++f, ++number) {
      at[slow] = s;
      at[fast] = f;
      if (planes.contains(at[0])) visit(number, at);
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

Boundary::Boundary(const Grid& grid, const std::array<BoundaryKind, face_count>& kinds,
                   const std::array<int, 3>& particles_per_cell,
                   std::vector<WaveSpeeds> speeds_of_level)
    : kinds_(kinds), speeds_(std::move(speeds_of_level)) {
  impulse_.fill(Vector3::Zero());
  captured_ = true;
  for (int f = 0; f < face_count; ++f) {
    if (kinds_[static_cast<std::size_t>(f)] != BoundaryKind::absorbing) continue;
    captured_ = false;
    const FaceLoop loop = loop_of(grid, static_cast<Face>(f));
    const Axis& axis = grid.axis(loop.axis);
    FarField& far = far_[static_cast<std::size_t>(f)];
    far.axis = loop.axis;
    far.plane = loop.plane;
    far.count[0] = grid.nodes(loop.slow);
    far.count[1] = grid.nodes(loop.fast);
    // A node's mass is summed over particles: the midpoint rule for the integral of (1 - xi)^2 over
    // the outermost cell.
    const double n = particles_per_cell[static_cast<std::size_t>(loop.axis)],
                 cell = axis.length(loop.plane == 0 ? 0 : axis.cells() - 1);
    far.inverse_extent = 1.0 / (cell * (1.0 / 3.0 - 1.0 / (12.0 * n * n)));
    // A load in the middle of the top: the far field begins half a width away sideways, and a depth
    // away downwards.
    far.inverse_length = (loop.axis == 2 ? 1.0 : 2.0) / (axis.upper() - axis.lower());
    far.hold.assign(static_cast<std::size_t>(3 * far.count[0] * far.count[1]), 0.0);
    far.displacement = far.hold;
  }
}

void Boundary::capture(Grid& grid, const PlaneRange& planes, const Vector3& gravity) {
  captured_ = true;
  for (int f = 0; f < face_count; ++f) {
    if (kinds_[static_cast<std::size_t>(f)] != BoundaryKind::absorbing) continue;
    FarField& far = far_[static_cast<std::size_t>(f)];
    for_face(grid, loop_of(grid, static_cast<Face>(f)), planes,
             [&](std::size_t number, const Place& at) {
               NodeSum& sum = grid.sum(at[0], at[1], at[2]);
               double& mass = grid.motion(at[0], at[1], at[2]).mass;
               for (int c = 0; c < 3; ++c)
                 far.hold[3 * number + static_cast<std::size_t>(c)] =
                     -sum.total[c] - mass * gravity[c];
               sum = NodeSum{};  // held: not by another face again
               mass = 0.0;
             });
  }
}

void Boundary::apply(Grid& grid, const PlaneRange& planes, const PlaneRange& owned, double dt) {
  for (int f = 0; f < face_count; ++f)
    if (kinds_[static_cast<std::size_t>(f)] == BoundaryKind::absorbing)
      absorb(grid, static_cast<Face>(f), planes, owned, dt);
  for (int f = 0; f < face_count; ++f) constrain(grid, static_cast<Face>(f), planes, owned);
}

void Boundary::constrain(Grid& grid, Face face, const PlaneRange& planes, const PlaneRange& owned) {
  if (kinds_[face] != BoundaryKind::smooth && kinds_[face] != BoundaryKind::rough) return;
  const FaceLoop loop = loop_of(grid, face);
  for_face(grid, loop, planes, [&](std::size_t, const Place& at) {
    NodeMotion& node = grid.motion(at[0], at[1], at[2]);
    for (int c = 0; c < 3; ++c) {
      if (kinds_[face] == BoundaryKind::smooth && c != loop.axis) continue;
      if (owned.contains(at[0])) impulse_[face][c] -= node.mass * node.velocity[c];
      node.velocity[c] = 0.0;
    }
  });
}

/// Whether a smooth or rough face holds a component of a node's velocity.
bool Boundary::is_held(const Grid& grid, const std::array<int, 3>& at, int component) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const BoundaryKind kind = kinds_[2 * axis + (upper ? 1 : 0)];
      if (at[axis] != (upper ? grid.nodes(static_cast<int>(axis)) - 1 : 0)) continue;
      if (kind == BoundaryKind::rough ||
          (kind == BoundaryKind::smooth && static_cast<int>(axis) == component))
        return true;
    }
  return false;
}

void Boundary::absorb(Grid& grid, Face face, const PlaneRange& planes, const PlaneRange& owned,
                      double dt) {
  FarField& far = far_[face];
  for_face(grid, loop_of(grid, face), planes, [&](std::size_t number, const Place& at) {
    NodeMotion& node = grid.motion(at[0], at[1], at[2]);
    if (!(node.mass > 0.0)) return;
    const WaveSpeeds& speeds = speeds_[static_cast<std::size_t>(at[2])];
    for (int c = 0; c < 3; ++c) {
      if (is_held(grid, at, c)) continue;
      const double speed = c == far.axis ? speeds.pressure : speeds.shear;
      const std::size_t n = 3 * number + static_cast<std::size_t>(c);
      const double before = node.velocity[c];
      const double pull =
          dt * (far.hold[n] / node.mass -
                speed * speed * far.inverse_extent * far.inverse_length * far.displacement[n]);
      const double after = (before + pull) / (1.0 + dt * speed * far.inverse_extent);
      node.velocity[c] = after;
      far.displacement[n] += dt * after;
      if (owned.contains(at[0])) {
        const double impulse = node.mass * (after - before);
        impulse_[face][c] += impulse;
        work_ += impulse * after;
      }
    }
  });
}

void Boundary::shift_x(int cells) {
  for (FarField& far : far_) {
    if (far.hold.empty()) continue;
    if (far.axis == 0) throw Error("a face across x that absorbs cannot move");
    // The two outermost rows of nodes at each end stay (their splines are those of the ends); rows
    // between move. Fresh ground stands as that which entered last did at the start: its holding
    // force, no displacement.
    const long row = 3L * far.count[1], gone = row * cells;
    const std::vector<double> hold(far.hold.end() - 3 * row, far.hold.end() - 2 * row),
        still(hold.size(), 0.0);
    for (auto [values, fresh] :
         {std::pair{&far.hold, &hold}, std::pair{&far.displacement, &still}}) {
      values->erase(values->begin() + 2 * row, values->begin() + 2 * row + gone);
      for (int i = 0; i < cells; ++i)
        values->insert(values->end() - 2 * row, fresh->begin(), fresh->end());
    }
  }
}

void Boundary::synchronise(const Communicator& ranks, const PlaneRange& owned) {
  if (ranks.size() == 1) return;
  for (FarField& far : far_) {
    if (far.hold.empty()) continue;
    for (std::vector<double>* values : {&far.hold, &far.displacement}) {
      const std::size_t row = 3 * static_cast<std::size_t>(far.count[1]);
      for (std::size_t n = 0; n < values->size(); ++n) {
        const int plane = far.axis == 0 ? far.plane : static_cast<int>(n / row);
        if (!owned.contains(plane)) (*values)[n] = 0.0;
      }
      ranks.sum(values->data(), values->size());
    }
  }
}

void Boundary::collect(const Communicator& ranks) {
  for (Vector3& impulse : impulse_) ranks.sum(impulse.data(), 3);
  work_ = ranks.sum(work_);
}

void Boundary::checkpoint(Checkpoint& state, bool keep_sums) {
  state.value("captured", captured_);
  state.value("work", work_);
  for (Vector3& impulse : impulse_) state.values("impulse", impulse);
  if (!state.saving() && !keep_sums) {
    work_ = 0.0;
    impulse_.fill(Vector3::Zero());
  }
  for (FarField& far : far_) {
    if (far.hold.empty()) continue;
    state.values("holding_force", far.hold.data(), far.hold.size());
    state.values("far_displacement", far.displacement.data(), far.displacement.size());
  }
}

}  // namespace furrow
