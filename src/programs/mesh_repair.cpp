// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/geometry/weld.h"
#include "furrow/geometry/winding_number.h"

namespace furrow {

namespace {

namespace cgal = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Polygons = std::vector<std::array<std::size_t, 3>>;

// A facet is nearly without area with an angle above the first, or with sides whose lengths differ
// by more than the second and a short side below the share of the mesh's size.
const double flat_angle = std::cos(radians(179.0));
constexpr double side_ratio = 200.0, short_side = 1e-4;
constexpr double sharp_edge = 20.0;         // degrees, kept by new facets
constexpr double new_edge = 0.02;           // of new facets, over the mesh's size
constexpr std::size_t maximum_parts = 300;  // parts that are united one by one
constexpr double offset_of_wrap = 0.025;    // of the wrap from the mesh, over the detail

Vector3 vector_of(const Point& p) { return {p.x(), p.y(), p.z()}; }
Point point_of(const Vector3& x) { return {x.x(), x.y(), x.z()}; }

Surface surface_of(Mesh mesh) {
  mesh.collect_garbage();
  Surface surface;
  surface.resize(mesh.number_of_vertices());
  for (const auto vertex : mesh.vertices())
    surface.x.col(static_cast<Eigen::Index>(vertex.idx())) = vector_of(mesh.point(vertex));
  for (const auto face : mesh.faces()) {
    Vector3i nodes;
    int corner = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      nodes[corner++] = static_cast<int>(vertex.idx());
    surface.triangles.push_back(nodes);
  }
  return surface;
}

class Repair {
 public:
  Repair(const Surface& mesh, const RepairLimits& limits) : limits_(limits) {
    const auto [lower, upper] = mesh.bounds();
    size_ = (upper - lower).norm();
    build(mesh);
    clean();
    close_holes();
  }

  std::vector<std::string> changes() const {
    std::vector<std::string> all = changes_;
    all.insert(all.end(), steps_.begin(), steps_.end());
    return all;
  }

  /// The cleaned mesh, if its parts enclose volumes and do not meet. A part inside another one is a
  /// cavity if its facets point into it; else the other one contains it already.
  std::optional<Mesh> cleaned() {
    if (!CGAL::is_closed(mesh_) || cgal::does_self_intersect(mesh_)) return {};
    std::vector<Mesh> parts;
    cgal::split_connected_components(mesh_, parts);
    std::vector<Surface> surfaces;
    for (const Mesh& part : parts) surfaces.push_back(surface_of(part));
    Mesh whole;
    std::size_t inside = 0;
    for (std::size_t n = 0; n < parts.size(); ++n) {
      const Vector3 point = surfaces[n].x.col(0);
      bool enclosed = false;
      for (std::size_t other = 0; other < parts.size(); ++other)
        enclosed |= other != n && std::abs(winding_number(surfaces[other], point)) > 0.5;
      const bool outwards = cgal::is_outward_oriented(parts[n]);
      if (enclosed && outwards) {
        ++inside;
        continue;
      }
      if (!enclosed && !outwards) cgal::reverse_face_orientations(parts[n]);
      CGAL::copy_face_graph(parts[n], whole);
    }
    if (inside > 0) steps_.push_back(fmt::format("dropped      {} solids inside others", inside));
    return whole;
  }

  /// The union of closed parts that meet.
  std::optional<Mesh> united() {
    if (!CGAL::is_closed(mesh_)) return {};
    std::vector<Mesh> parts;
    cgal::split_connected_components(mesh_, parts);
    if (parts.size() < 2 || parts.size() > maximum_parts) return {};
    Mesh whole;
    for (Mesh& part : parts) {
      if (cgal::does_self_intersect(part)) return {};
      if (!cgal::is_outward_oriented(part)) cgal::reverse_face_orientations(part);
      if (whole.is_empty()) {
        whole = std::move(part);
        continue;
      }
      Mesh both;
      if (!cgal::corefine_and_compute_union(whole, part, both)) return {};
      whole = std::move(both);
    }
    drop_slivers(whole);
    if (cgal::does_self_intersect(whole)) return {};
    steps_.push_back(fmt::format("united       {} parts", parts.size()));
    return whole;
  }

  /// New facets between the sharp edges.
  std::optional<Mesh> with_new_facets(Mesh mesh) {
    auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
    cgal::detect_sharp_edges(mesh, sharp_edge, sharp);
    cgal::isotropic_remeshing(faces(mesh), new_edge * size_, mesh,
                              CGAL::parameters::number_of_iterations(3)
                                  .edge_is_constrained_map(sharp)
                                  .protect_constraints(false));
    if (cgal::does_self_intersect(mesh)) return {};
    changes_.push_back(
        fmt::format("new facets   with edges of {:.4g} between edges sharper than "
                    "{:g} degrees",
                    new_edge * size_, sharp_edge));
    return mesh;
  }

  std::optional<Mesh> wrapped() {
    std::vector<Point> points;
    Polygons facets;
    cgal::polygon_mesh_to_polygon_soup(mesh_, points, facets);
    Mesh wrap;
    CGAL::alpha_wrap_3(points, facets, limits_.detail, offset_of_wrap * limits_.detail, wrap);
    steps_.assign(
        1,
        fmt::format("wrapped      at a distance of {:.4g}; gaps narrower than {:.4g} are bridged",
                    offset_of_wrap * limits_.detail, limits_.detail));
    return wrap;
  }

 private:
  void build(const Surface& mesh) {
    const std::vector<int> same = weld_nodes(mesh.x, Vector3::Zero(), limits_.merge);
    std::size_t merged = 0;
    for (std::size_t node = 0; node < same.size(); ++node)
      merged += same[node] != static_cast<int>(node) ? 1 : 0;
    std::vector<Point> points;
    for (const auto& x : mesh.x.colwise()) points.push_back(point_of(x));
    Polygons facets;
    std::set<std::array<std::size_t, 3>> known;
    std::size_t flat = 0, doubled = 0;
    for (const Vector3i& triangle : mesh.triangles) {
      std::array<std::size_t, 3> nodes{};
      for (std::size_t corner = 0; corner < 3; ++corner)
        nodes[corner] = static_cast<std::size_t>(
            same[static_cast<std::size_t>(triangle[static_cast<Eigen::Index>(corner)])]);
      std::array<std::size_t, 3> sorted = nodes;
      std::sort(sorted.begin(), sorted.end());
      if (sorted[0] == sorted[1] || sorted[1] == sorted[2])
        ++flat;
      else if (!known.insert(sorted).second)
        ++doubled;
      else
        facets.push_back(nodes);
    }
    add("merged       {} corners nearer than {:.4g}", merged, limits_.merge);
    add("dropped      {} facets whose corners coincide", flat);
    add("dropped      {} doubled facets", doubled);
    cgal::orient_polygon_soup(points, facets);
    cgal::polygon_soup_to_polygon_mesh(points, facets, mesh_);
  }

  void clean() {
    cgal::stitch_borders(mesh_);
    const std::size_t before = mesh_.number_of_faces();
    drop_slivers(mesh_);
    add("dropped      {} facets without area",
        before - std::min<std::size_t>(before, mesh_.number_of_faces()));
    cgal::stitch_borders(mesh_);
    mesh_.collect_garbage();
  }

  void drop_slivers(Mesh& mesh) const {
    cgal::remove_degenerate_faces(mesh);
    cgal::experimental::remove_almost_degenerate_faces(faces(mesh), mesh, flat_angle, side_ratio,
                                                       short_side * size_);
    mesh.collect_garbage();
  }

  void close_holes() {
    std::vector<Mesh::Halfedge_index> holes;
    cgal::extract_boundary_cycles(mesh_, std::back_inserter(holes));
    std::size_t closed = 0;
    double largest = 0.0;
    for (const auto hole : holes) {
      CGAL::Bbox_3 box;
      for (const auto edge : CGAL::halfedges_around_face(hole, mesh_))
        box += mesh_.point(mesh_.target(edge)).bbox();
      const double size =
          std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
      if (size > limits_.hole) continue;
      std::vector<Mesh::Face_index> patch;
      cgal::triangulate_hole(mesh_, hole, std::back_inserter(patch));
      if (patch.empty()) continue;
      ++closed;
      largest = std::max(largest, size);
    }
    add("closed       {} holes, the largest {:.4g} across", closed, largest);
    if (closed > 0) drop_slivers(mesh_);
  }

  template <class... Values>
  void add(const char* text, std::size_t count, Values... values) {
    if (count > 0) changes_.push_back(fmt::format(fmt::runtime(text), count, values...));
  }

  RepairLimits limits_;
  double size_ = 0.0;
  Mesh mesh_;
  std::vector<std::string> changes_;  // changes that are reported first
  std::vector<std::string> steps_;    // of the repair that is taken
};

}  // namespace

RepairedMesh repair_mesh(const Surface& mesh, const RepairLimits& limits,
                         const std::function<bool(const Surface&)>& accept) {
  Repair repair(mesh, limits);
  std::optional<Mesh> found;
  // CGAL throws where a mesh does not meet the needs of an algorithm: the next one has fewer.
  const auto found_by = [&](auto attempt) {
    try {
      if (std::optional<Mesh> next = attempt()) found = std::move(next);
      return found && accept(surface_of(*found));
    } catch (const CGAL::Failure_exception&) {
      return false;
    }
  };
  const auto result = [&] { return RepairedMesh{surface_of(*found), repair.changes()}; };
  if (found_by([&] { return repair.cleaned(); })) return result();
  if (!found && found_by([&] { return repair.united(); })) return result();
  if (found && found_by([&] { return repair.with_new_facets(*found); })) return result();
  if (found_by([&] { return repair.wrapped(); })) return result();
  throw StateError("no repair gives a solid; repair the mesh in the program that made it");
}

double largest_distance(const Surface& nodes_of, const Surface& from) {
  std::vector<Kernel::Triangle_3> triangles;
  for (const Vector3i& nodes : from.triangles)
    triangles.emplace_back(point_of(from.x.col(nodes[0])), point_of(from.x.col(nodes[1])),
                           point_of(from.x.col(nodes[2])));
  using Primitive =
      CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.cbegin(), triangles.cend());
  double largest = 0.0;
  for (const auto& x : nodes_of.x.colwise())
    largest = std::max(largest, std::sqrt(tree.squared_distance(point_of(x))));
  return largest;
}

}  // namespace furrow
