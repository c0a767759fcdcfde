// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/boundary.h"

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "terrain_scene.h"

namespace furrow::boundary_test {
namespace {

using testing_terrain::even;

constexpr double mass = 2.0, dt = 1e-3;
const Vector3 weightless = Vector3::Zero();

Grid small_grid() {
  Grid grid(Axis(even(0, 4, 1), "x"), Axis(even(0, 3, 1), "y"), Axis(even(0, 2, 1), "z"));
  grid.store(grid.all_nodes());
  return grid;
}

template <class Visit>
void for_nodes(Grid& grid, Visit visit) {
  for (int i = 0; i < grid.nodes(0); ++i)
    for (int j = 0; j < grid.nodes(1); ++j)
      for (int k = 0; k < grid.nodes(2); ++k) visit(grid.motion(i, j, k), i, j, k);
}

void give_velocity(Grid& grid, const Vector3& v) {
  for_nodes(grid, [&](NodeMotion& n, int, int, int) {
    Eigen::Map<Vector3>(n.velocity) = v;
    n.mass = mass;
  });
}

void give_sums(Grid& grid, const Vector3& force) {
  for (int i = 0; i < grid.nodes(0); ++i)
    for (int j = 0; j < grid.nodes(1); ++j)
      for (int k = 0; k < grid.nodes(2); ++k) {
        Eigen::Map<Vector3>(grid.sum(i, j, k).total) = force;
        grid.motion(i, j, k).mass = mass;
      }
}

FaceArray<BoundaryKind> only(Face face, BoundaryKind kind) {
  FaceArray<BoundaryKind> kinds;
  kinds.fill(BoundaryKind::free);
  kinds[face] = kind;
  return kinds;
}

std::vector<WaveSpeeds> speeds(const Grid& grid) {
  return std::vector<WaveSpeeds>(static_cast<std::size_t>(grid.nodes(2)), {300.0, 150.0});
}

TEST(Boundary, NamesFollowTheKinds) {
  EXPECT_EQ(boundary_kind("free"), BoundaryKind::free);
  EXPECT_EQ(boundary_kind("absorbing"), BoundaryKind::absorbing);
  EXPECT_THROW(boundary_kind("sticky"), Error);
}

TEST(Boundary, SmoothWallStopsNormalMotionAndRoughWallAllMotion) {
  const Vector3 v(1.0, 2.0, 3.0);
  for (const Face face : all_faces)
    for (const BoundaryKind kind : {BoundaryKind::smooth, BoundaryKind::rough}) {
      Grid grid = small_grid();
      give_velocity(grid, v);
      Boundary boundary(grid, only(face, kind), {2, 2, 2}, speeds(grid));
      EXPECT_TRUE(boundary.has_initial_tractions());
      boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
      const int axis = axis_of(face), plane = is_upper(face) ? grid.nodes(axis) - 1 : 0;
      Vector3 expected = Vector3::Zero();
      for_nodes(grid, [&](const NodeMotion& n, int i, int j, int k) {
        const int at[3] = {i, j, k};
        Vector3 after = v;
        if (at[axis] == plane) {
          if (kind == BoundaryKind::rough) after.setZero();
          after[axis] = 0.0;
          expected += mass * (after - v);
        }
        EXPECT_EQ(Vector3(Eigen::Map<const Vector3>(n.velocity)), after);
      });
      EXPECT_LT((boundary.impulse(face) - expected).norm(), 1e-12);
      EXPECT_EQ(boundary.work(), 0.0);
    }
}

/// v' = (v - dt c^2/(l L) u)/(1 + dt c/l) with u the displacement before: dashpot and spring of one
/// node across the face, taken implicitly.
TEST(Boundary, AbsorbingFaceIsDashpotAndSpring) {
  Grid grid = small_grid();
  Boundary boundary(grid, only(Face::x_upper, BoundaryKind::absorbing), {2, 2, 2}, speeds(grid));
  EXPECT_FALSE(boundary.has_initial_tractions());
  boundary.capture_initial_tractions(grid, grid.all_nodes(), weightless);  // nothing to hold
  EXPECT_TRUE(boundary.has_initial_tractions());
  // [m] (0.75^2 + 0.25^2)/2 of the spline at two particles a cell
  const double extent = 0.3125, length = 0.5 * 4.0;
  Vector3 u = Vector3::Zero(), v(1.0, 2.0, 3.0);
  double work = 0.0;
  for (int step = 0; step < 3; ++step) {
    give_velocity(grid, v);
    boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
    Vector3 after;
    for (int c = 0; c < 3; ++c) {
      const double speed = c == 0 ? 300.0 : 150.0;
      after[c] =
          (v[c] - dt * speed * speed / (extent * length) * u[c]) / (1.0 + dt * speed / extent);
    }
    u += dt * after;
    EXPECT_LT((Eigen::Map<const Vector3>(grid.motion(5, 2, 1).velocity) - after).norm(), 1e-14);
    EXPECT_EQ(Vector3(Eigen::Map<const Vector3>(grid.motion(4, 2, 1).velocity)), v);
    work += grid.nodes(1) * grid.nodes(2) * mass * (after - v).dot(after);
    v = after;
  }
  EXPECT_NEAR(boundary.work(), work, 1e-12 * std::abs(work));
}

/// The far field of a half model (theory: continuum, eq. 8) is that of the whole: L is the distance
/// from the plane of symmetry.
TEST(Boundary, HalfModelHasTheFarFieldOfTheWhole) {
  const auto velocity_after = [](double lower, BoundaryKind middle) {
    Grid grid(Axis(even(0, 4, 1), "x"), Axis(even(lower, 3, 1), "y"), Axis(even(0, 2, 1), "z"));
    grid.store(grid.all_nodes());
    FaceArray<BoundaryKind> kinds = only(Face::y_upper, BoundaryKind::absorbing);
    kinds[Face::y_lower] = middle;
    Boundary boundary(grid, kinds, {2, 2, 2}, speeds(grid));
    boundary.capture_initial_tractions(grid, grid.all_nodes(), weightless);
    for (int step = 0; step < 3; ++step) {
      give_velocity(grid, Vector3(1.0, 2.0, 3.0));
      boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
    }
    return Vector3(Eigen::Map<const Vector3>(grid.motion(2, grid.nodes(1) - 1, 1).velocity));
  };
  const Vector3 whole = velocity_after(-3, BoundaryKind::absorbing);
  const Vector3 half = velocity_after(0, BoundaryKind::smooth);
  EXPECT_LT((half - whole).norm(), 1e-14);
}

/// Forces that held the ground at the start hold it on: a node on several faces is held once.
TEST(Boundary, InitialForcesAreHeld) {
  for (const int count : {1, 2, 3}) {
    FaceArray<BoundaryKind> kinds;
    kinds.fill(BoundaryKind::free);
    const Face absorbing[3] = {Face::x_upper, Face::y_upper, Face::z_lower};
    for (int n = 0; n < count; ++n) kinds[absorbing[n]] = BoundaryKind::absorbing;
    Grid grid = small_grid();
    Boundary boundary(grid, kinds, {2, 2, 2}, speeds(grid));
    const Vector3 pull(10.0, -20.0, 30.0);  // [N] on every node
    const Vector3 gravity(0.0, 1.0, -9.0), stress = pull - mass * gravity;
    give_sums(grid, stress);
    boundary.capture_initial_tractions(grid, grid.all_nodes(), gravity);
    for (int step = 0; step < 5; ++step) {
      give_velocity(grid, dt * pull / mass);
      boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
      for_nodes(grid, [&](const NodeMotion& n, int i, int j, int k) {
        const bool held = i == grid.nodes(0) - 1 || (count > 1 && j == grid.nodes(1) - 1) ||
                          (count > 2 && k == 0);
        const Vector3 expected = held ? Vector3(0, 0, 0) : Vector3(dt * pull / mass);
        EXPECT_LT((Eigen::Map<const Vector3>(n.velocity) - expected).norm(), 1e-14)
            << count << " faces, node " << i << " " << j << " " << k;
      });
    }
  }
}

/// A node that a wall holds does not move, so the far field that meets the wall there does no work
/// on it and holds nothing.
TEST(Boundary, AbsorbingFaceDoesNothingAtNodesOfAWall) {
  Grid grid = small_grid();
  FaceArray<BoundaryKind> kinds = only(Face::x_upper, BoundaryKind::absorbing);
  kinds[Face::z_lower] = BoundaryKind::rough;
  kinds[Face::y_lower] = BoundaryKind::smooth;
  Boundary boundary(grid, kinds, {2, 2, 2}, speeds(grid));
  boundary.capture_initial_tractions(grid, grid.all_nodes(), weightless);
  const Vector3 v(1.0, 2.0, 3.0);
  double work = 0.0;
  for (int step = 0; step < 2; ++step) {
    give_velocity(grid, v);
    boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
  }
  for_nodes(grid, [&](const NodeMotion& n, int i, int j, int k) {
    if (k == 0 || j == 0) {
      EXPECT_EQ(n.velocity[1], 0.0);
    }
    if (k == 0) {
      EXPECT_EQ(n.velocity[0], 0.0);
    }
    static_cast<void>(i);
  });
  // The whole impulse on the nodes of the rough floor is the floor's.
  const double floor = -2.0 * mass * grid.nodes(0) * grid.nodes(1);
  EXPECT_NEAR(boundary.impulse(Face::z_lower).x(), floor * v.x(), 1e-9);
  EXPECT_NEAR(boundary.impulse(Face::z_lower).z(), floor * v.z(), 1e-9);
  // Nodes of the absorbing face that are free to move along x: without those of the floor.
  const double c = 300.0, extent = 0.3125, length = 2.0, cs = 150.0;
  double u[3] = {0, 0, 0};
  for (int step = 0; step < 2; ++step)
    for (int d = 0; d < 3; ++d) {
      const double speed = d == 0 ? c : cs,
                   after = (v[d] - dt * speed * speed / (extent * length) * u[d]) /
                           (1.0 + dt * speed / extent);
      u[d] += dt * after;
      const int rows = d == 1 ? grid.nodes(1) - 1 : grid.nodes(1);
      work += rows * (grid.nodes(2) - 1) * mass * (after - v[d]) * after;
    }
  EXPECT_NEAR(boundary.work(), work, 1e-12 * std::abs(work));
}

std::vector<char> state_of(Boundary& boundary) {
  Checkpoint state("boundary");
  boundary.checkpoint(state, true);
  return state.bytes();
}

void restore(Boundary& boundary, const std::vector<char>& bytes, bool keep_sums) {
  Checkpoint state("boundary", bytes.data(), bytes.size());
  boundary.checkpoint(state, keep_sums);
  state.finish();
}

/// Last numbers that were saved.
std::vector<double> last_numbers(const std::vector<char>& bytes, std::size_t count) {
  std::vector<double> numbers(count);
  const std::size_t size = count * sizeof(double);
  std::memcpy(numbers.data(), bytes.data() + bytes.size() - size, size);
  return numbers;
}

TEST(Boundary, StateIsRestoredAndMovesWithTheGrid) {
  Grid grid = small_grid();
  Boundary boundary(grid, only(Face::y_upper, BoundaryKind::absorbing), {2, 2, 2}, speeds(grid));
  give_velocity(grid, {1, 2, 3});
  boundary.capture_initial_tractions(grid, grid.all_nodes(), weightless);
  for_nodes(grid, [&](NodeMotion& n, int i, int, int) {
    Eigen::Map<Vector3>(n.velocity) = Vector3(i, 0, 0);
    n.mass = mass;
  });
  boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
  const std::vector<char> saved = state_of(boundary);

  Boundary other(grid, only(Face::y_upper, BoundaryKind::absorbing), {2, 2, 2}, speeds(grid));
  restore(other, saved, true);
  EXPECT_EQ(state_of(other), saved);
  restore(other, saved, false);
  EXPECT_EQ(other.impulse(Face::y_upper), Vector3::Zero());
  EXPECT_EQ(other.work(), 0.0);

  const auto row = static_cast<std::size_t>(3 * grid.nodes(2)),
             rows = static_cast<std::size_t>(grid.nodes(0));
  // Rows between the ends move by one; the one that enters has no displacement. Displacements are
  // the last numbers of the state.
  boundary.shift_x(1);
  const std::vector<double> before_move = last_numbers(saved, row * rows),
                            after_move = last_numbers(state_of(boundary), row * rows);
  const double* before = before_move.data();
  const double* after = after_move.data();
  for (std::size_t r = 0; r < rows; ++r) {
    const double expected = r < 2 || r + 2 >= rows ? before[r * row]
                            : r + 3 < rows         ? before[(r + 1) * row]
                                                   : 0.0;
    EXPECT_EQ(after[r * row], expected) << "row " << r;
  }
}

/// Ahead, the displacement of the far field falls off over L = 2 m by each cell of 1 m.
TEST(Boundary, FaceAheadMeetsUndisturbedGround) {
  Grid grid = small_grid();
  Boundary boundary(grid, only(Face::x_upper, BoundaryKind::absorbing), {2, 2, 2}, speeds(grid));
  give_sums(grid, {7, 8, 9});
  boundary.capture_initial_tractions(grid, grid.all_nodes(), weightless);
  give_velocity(grid, {1, 2, 3});
  boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
  const auto count = static_cast<std::size_t>(6 * grid.nodes(1) * grid.nodes(2));
  const std::vector<double> before = last_numbers(state_of(boundary), count);
  boundary.shift_x(2);
  const std::vector<double> after = last_numbers(state_of(boundary), count);
  for (std::size_t n = 0; n < count / 2; ++n) {
    EXPECT_EQ(after[n], before[n]) << "t_0";
    EXPECT_NE(before[count / 2 + n], 0.0);
    EXPECT_NEAR(after[count / 2 + n] / before[count / 2 + n], std::exp(-1.0), 1e-14) << "u";
  }
}

/// Behind, the face holds any force that the ground carries there: nodes at rest stay at rest, also
/// those that another face held; nodes that move go on.
TEST(Boundary, FaceBehindHoldsTheForceOfTheGround) {
  Grid grid = small_grid();
  FaceArray<BoundaryKind> kinds = only(Face::x_lower, BoundaryKind::absorbing);
  kinds[Face::y_upper] = BoundaryKind::absorbing;
  Boundary boundary(grid, kinds, {2, 2, 2}, speeds(grid));
  give_sums(grid, {1, 2, 3});
  boundary.capture_initial_tractions(grid, grid.all_nodes(), weightless);
  give_velocity(grid, {1, 2, 3});
  boundary.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
  boundary.shift_x(1);
  const Vector3 force(10, -20, 30), gravity(0, 1, -9);
  for (const Vector3& v : {Vector3(0, 0, 0), Vector3(0.1, -0.2, 0.3)}) {
    Boundary here = boundary;
    give_sums(grid, force);
    give_velocity(grid, v);
    here.renew_tractions(grid, grid.all_nodes(), gravity);
    grid.accelerate(grid.all_nodes(), dt, gravity);
    here.apply(grid, grid.all_nodes(), grid.all_nodes(), dt);
    for (int k = 0; k < grid.nodes(2); ++k) {
      const double at_face = (Eigen::Map<const Vector3>(grid.motion(0, 2, k).velocity) - v).norm(),
                   at_edge = Eigen::Map<const Vector3>(grid.motion(0, 4, k).velocity).norm();
      EXPECT_LT(at_face, 1e-14);
      // there the dashpot of the other face slows what moves
      EXPECT_LE(at_edge, v.norm() + 1e-14);
    }
  }
}

}  // namespace
}  // namespace furrow::boundary_test
