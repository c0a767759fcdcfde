// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/meshes/solid_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/geometry/winding_number.h"

namespace furrow {

namespace {

constexpr double coplanar = 1e-9;  // sine of the angle between two normals

using Corners = std::array<Vector3, 3>;

enum class Fault { flat, open, shared, turned, folded, meeting, inwards, inside };
constexpr std::array fault_names{"facets without area",
                                 "edges without a neighbour",
                                 "edges with three or more facets",
                                 "edges of neighbours with opposite orientations",
                                 "edges where facets are folded onto each other",
                                 "facets that meet others",
                                 "shells that point inwards",
                                 "solids inside others"};

struct EdgeUse {
  int lower, higher;  // nodes
  int triangle;
  bool upwards;  // runs from the lower to the higher node
};

/// Checks of one mesh, with the facets' numbers in the messages.
class SolidCheck {
 public:
  explicit SolidCheck(const SolidMesh& mesh)
      : mesh_(mesh), surface_(mesh.surface), count_(static_cast<int>(mesh.facets.size())) {
    const auto [lower, upper] = surface_.bounds();
    tolerance_ = solid_mesh_tolerance * (upper - lower).norm();
  }

  /// Checks for inner walls and turned shells only where the surface is closed: these faults may be
  /// consequences of the others.
  void check() {
    check_degenerate();
    check_edges();
    check_intersections();
    if (!first_) check_orientation();
    if (!first_) return;
    throw InputError(first_->place, first_->problem, first_->allowed,
                     fmt::format("{}, or write a repaired mesh with 'furrow-tyre mesh {}'; all "
                                 "faults: {}",
                                 first_->remedy, mesh_.file, list()));
  }

 private:
  Corners corners(int triangle) const {
    const Vector3i& nodes = nodes_of(triangle);
    return {surface_.x.col(nodes[0]), surface_.x.col(nodes[1]), surface_.x.col(nodes[2])};
  }
  const Vector3i& nodes_of(int triangle) const {
    return surface_.triangles[static_cast<std::size_t>(triangle)];
  }
  Vector3 normal(int triangle) const {
    return surface_.area_vector(static_cast<std::size_t>(triangle)).normalized();
  }
  int facet(int triangle) const { return mesh_.facets[static_cast<std::size_t>(triangle)]; }
  std::string place(int triangle) const {
    const Corners x = corners(triangle);
    const Vector3 middle = (x[0] + x[1] + x[2]) / 3.0;
    return fmt::format("{}, facet {} at {:.4g} {:.4g} {:.4g}", mesh_.file, facet(triangle),
                       middle.x(), middle.y(), middle.z());
  }
  /// The first fault of all is written out.
  void note(Fault fault, int triangle, const std::string& problem, const std::string& allowed,
            const std::string& remedy) {
    ++counts_[static_cast<std::size_t>(fault)];
    if (!first_) first_ = {place(triangle), problem, allowed, remedy};
  }
  std::string list() const {
    std::string text;
    for (std::size_t fault = 0; fault < counts_.size(); ++fault)
      if (counts_[fault] > 0)
        text +=
            fmt::format("{}{} {}", text.empty() ? "" : ", ", counts_[fault], fault_names[fault]);
    return text;
  }

  void check_degenerate() {
    for (int t = 0; t < count_; ++t) {
      const Corners x = corners(t);
      const double longest =
          std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
      const double height =
          2.0 * surface_.area_vector(static_cast<std::size_t>(t)).norm() / longest;
      if (!(longest > tolerance_ && height > tolerance_))
        note(Fault::flat, t, "is degenerate: its three corners lie on a line",
             fmt::format("facets of a height of at least {:g} of the mesh", solid_mesh_tolerance),
             "merge vertices and remove degenerate faces in the program that made the mesh");
    }
  }

  void check_edges() {
    std::vector<EdgeUse> uses;
    for (int t = 0; t < count_; ++t)
      for (int corner = 0; corner < 3; ++corner) {
        const int from = nodes_of(t)[corner], to = nodes_of(t)[(corner + 1) % 3];
        uses.push_back({std::min(from, to), std::max(from, to), t, from < to});
      }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.lower, a.higher, a.triangle) < std::tie(b.lower, b.higher, b.triangle);
    });
    for (auto first = uses.begin(); first != uses.end();) {
      const auto last = std::find_if(first, uses.end(), [&](const EdgeUse& use) {
        return use.lower != first->lower || use.higher != first->higher;
      });
      check_edge(first, last);
      first = last;
    }
  }

  template <class Iterator>
  void check_edge(Iterator first, Iterator last) {
    const auto users = last - first;
    if (users == 1)
      return note(Fault::open, first->triangle,
                  "has an edge without a neighbour: the surface is open there",
                  "a watertight surface", "close the holes and merge vertices");
    if (users > 2)
      return note(Fault::shared, first->triangle,
                  fmt::format("shares an edge with {} other facets", users - 1),
                  "one neighbour at each edge",
                  "remove double facets and inner walls, or unite the parts of the solid");
    const auto other = first + 1;
    if (first->upwards == other->upwards)
      return note(Fault::turned, first->triangle,
                  fmt::format("and its neighbour, facet {}, have opposite orientations",
                              facet(other->triangle)),
                  "corners in counter-clockwise order, seen from outside",
                  "make the normals consistent");
    const Vector3 normal_here = normal(first->triangle), normal_there = normal(other->triangle);
    if (normal_here.dot(normal_there) < 0.0 && normal_here.cross(normal_there).norm() < coplanar)
      note(Fault::folded, first->triangle,
           fmt::format("is folded onto facet {}", facet(other->triangle)),
           "a surface that encloses a volume", "remove one of them, or give the part a thickness");
  }

  /// The pairs whose boxes overlap, by a sweep along the longest side.
  void check_intersections() {
    const auto [lower, upper] = surface_.bounds();
    int axis = 0;
    (upper - lower).maxCoeff(&axis);
    struct Box {
      Vector3 lower, upper;
      int triangle;
    };
    std::vector<Box> boxes;
    for (int t = 0; t < count_; ++t) {
      const Corners x = corners(t);
      boxes.push_back({x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2]), t});
    }
    std::sort(boxes.begin(), boxes.end(), [axis](const Box& a, const Box& b) {
      return std::make_pair(a.lower[axis], a.triangle) < std::make_pair(b.lower[axis], b.triangle);
    });
    std::vector<int> met(boxes.size(), -1);  // the lowest facet that each one meets
    for (std::size_t a = 0; a < boxes.size(); ++a)
      for (std::size_t b = a + 1; b < boxes.size() && boxes[b].lower[axis] <= boxes[a].upper[axis];
           ++b) {
        const int one = boxes[a].triangle, other = boxes[b].triangle;
        int &of_one = met[static_cast<std::size_t>(one)],
            &of_other = met[static_cast<std::size_t>(other)];
        if ((of_one < 0 || of_other < 0) &&
            (boxes[a].lower.array() <= boxes[b].upper.array()).all() &&
            (boxes[b].lower.array() <= boxes[a].upper.array()).all() && meet(one, other)) {
          if (of_one < 0 || other < of_one) of_one = other;
          if (of_other < 0 || one < of_other) of_other = one;
        }
      }
    for (int t = 0; t < count_; ++t)
      if (const int other = met[static_cast<std::size_t>(t)]; other >= 0)
        note(Fault::meeting, t,
             fmt::format("meets facet {}, which is not its neighbour", facet(other)),
             "a surface that does not intersect itself",
             "unite the parts of the solid (Boolean union)");
  }

  bool meet(int a, int b) const { return an_edge_crosses(a, b) || an_edge_crosses(b, a); }

  /// True if an edge of one triangle crosses the other. Edges from a common node do not count.
  bool an_edge_crosses(int one, int other) const {
    const Vector3i &nodes = nodes_of(one), &others = nodes_of(other);
    const Corners x = corners(one), y = corners(other);
    const Vector3 n = normal(other);
    const auto is_common = [&](int node) { return (others.array() == node).any(); };
    for (int corner = 0; corner < 3; ++corner) {
      const int next = (corner + 1) % 3;
      if (is_common(nodes[corner]) || is_common(nodes[next])) continue;
      const Vector3 &from = x[static_cast<std::size_t>(corner)],
                    &to = x[static_cast<std::size_t>(next)];
      const double before = n.dot(from - y[0]), after = n.dot(to - y[0]);
      if (std::min(before, after) > -tolerance_ || std::max(before, after) < tolerance_) continue;
      if (holds(y, n, from + before / (before - after) * (to - from))) return true;
    }
    return false;
  }

  /// True if a point in the plane of a triangle is inside it, edges included.
  bool holds(const Corners& x, const Vector3& unit_normal, const Vector3& point) const {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3 along = x[(corner + 1) % 3] - x[corner];
      if (unit_normal.dot(along.cross(point - x[corner])) < -tolerance_ * along.norm())
        return false;
    }
    return true;
  }

  /// The triangles that share nodes, and the number of the first.
  struct Shell {
    Surface surface;
    int first = -1;
  };

  std::vector<Shell> shells() const {
    std::vector<int> root(surface_.node_count());
    std::iota(root.begin(), root.end(), 0);
    const auto at = [&](int node) -> int& { return root[static_cast<std::size_t>(node)]; };
    const auto find = [&](int node) {
      while (at(node) != node) node = at(node) = at(at(node));
      return node;
    };
    for (int t = 0; t < count_; ++t)
      for (int corner = 1; corner < 3; ++corner)
        at(find(nodes_of(t)[corner])) = find(nodes_of(t)[0]);

    std::map<int, std::vector<int>> nodes;           // of each root
    std::vector<int> number(surface_.node_count());  // of each node in its shell
    for (int node = 0; node < static_cast<int>(number.size()); ++node) {
      std::vector<int>& members = nodes[find(node)];
      number[static_cast<std::size_t>(node)] = static_cast<int>(members.size());
      members.push_back(node);
    }
    std::map<int, Shell> found;
    for (const auto& [first, members] : nodes)
      found[first].surface.x = surface_.x(Eigen::all, members);
    for (int t = 0; t < count_; ++t) {
      Shell& shell = found[find(nodes_of(t)[0])];
      if (shell.first < 0) shell.first = t;
      shell.surface.triangles.push_back(
          nodes_of(t).unaryExpr([&](int node) { return number[static_cast<std::size_t>(node)]; }));
    }
    std::vector<Shell> list;
    for (auto& [first, shell] : found) list.push_back(std::move(shell));
    return list;
  }

  void check_orientation() {
    const std::vector<Shell> all = shells();
    for (const Shell& shell : all) {
      const bool outwards = shell.surface.enclosed_volume() > 0.0;
      const Vector3 point = shell.surface.x.col(0);
      double around = 0.0;  // winding number of the other shells
      for (const Shell& other : all) {
        const auto [lower, upper] = other.surface.bounds();
        if (&other != &shell && (point.array() > lower.array()).all() &&
            (point.array() < upper.array()).all())
          around += winding_number(other.surface, point);
      }
      const bool enclosed = around > 0.5;
      if (!outwards && !enclosed)
        note(Fault::inwards, shell.first, "points inwards, as all facets of its shell do",
             "corners in counter-clockwise order, seen from outside",
             "flip the normals of the mesh or of this part");
      if (outwards && enclosed)
        note(Fault::inside, shell.first, "belongs to a solid inside another solid",
             "solids that are apart",
             "remove the inner solid, or flip its normals if it is a cavity");
    }
  }

  struct Written {
    std::string place, problem, allowed, remedy;
  };

  const SolidMesh& mesh_;
  const Surface& surface_;
  int count_;
  double tolerance_ = 0.0;
  std::array<int, fault_names.size()> counts_{};
  std::optional<Written> first_;
};

}  // namespace

void check_solid(const SolidMesh& mesh) { SolidCheck(mesh).check(); }

// Over a tetrahedron (0, a, b, c) of volume V: integral of x x^T = V/20 (s s^T + a a^T + b b^T +
// c c^T) with s = a + b + c. Taken about the first node, so that a solid far from the origin loses
// no digits.
MassProperties mass_properties(const Surface& surface) {
  MassProperties of;
  if (surface.triangles.empty()) return of;
  const Vector3 origin = surface.x.col(0);
  Vector3 first_moment = Vector3::Zero();
  Matrix3 second_moment = Matrix3::Zero();
  for (const Vector3i& nodes : surface.triangles) {
    const Vector3 a = surface.x.col(nodes[0]) - origin, b = surface.x.col(nodes[1]) - origin,
                  c = surface.x.col(nodes[2]) - origin, s = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6.0;
    of.volume += volume;
    first_moment += volume / 4.0 * s;
    second_moment +=
        volume / 20.0 *
        (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  const Vector3 offset = first_moment / of.volume;
  of.centre = origin + offset;
  second_moment += of.volume * (of.centre * of.centre.transpose() - offset * offset.transpose());
  of.inertia = second_moment.trace() * Matrix3::Identity() - second_moment;
  return of;
}

}  // namespace furrow
