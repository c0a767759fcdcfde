// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/thin_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "furrow/geometry/closest_feature.h"
#include "furrow/geometry/triangle_search.h"

namespace furrow {

namespace {

constexpr double opposite_cosine = -0.8;    // of the normals of a part's two faces
constexpr double smooth_cosine = 0.87;      // of the normals of neighbours in one face
constexpr double minimum_width = 1.2;       // of a face over the thickness
constexpr double convex_sine = -1e-3;       // of the angle by which a neighbour bends backwards
constexpr double on_edge = 1e-9;            // a ray through an edge meets both triangles
constexpr std::size_t corners_of_gap = 64;  // of a part that measure its gap to another one
constexpr int none = -1;

/// Distance along the ray from a point to a triangle, or infinity.
double along_ray(const Surface& surface, std::size_t triangle, const Vector3& from,
                 const Vector3& direction) {
  const Vector3i& n = surface.triangles[triangle];
  const Vector3 a = surface.x.col(n[0]), ab = surface.x.col(n[1]) - a, ac = surface.x.col(n[2]) - a,
                q = direction.cross(ac);
  const double determinant = ab.dot(q);
  constexpr double missed = std::numeric_limits<double>::infinity();
  if (determinant == 0.0) return missed;
  const Vector3 r = from - a;
  const double u = r.dot(q) / determinant, v = direction.dot(r.cross(ab)) / determinant;
  if (u < -on_edge || v < -on_edge || u + v > 1.0 + on_edge) return missed;
  const double t = ac.dot(r.cross(ab)) / determinant;
  return t > 0.0 ? t : missed;
}

/// Surface with the thickness, neighbours and face of each triangle, for the search for thin parts.
struct Search {
  explicit Search(const Surface& of)
      : surface(of),
        normal(of.triangle_count()),
        thickness(of.triangle_count(), 0.0),
        opposite(of.triangle_count(), none),
        neighbour(of.triangle_count(), {none, none, none}),
        face(of.triangle_count(), none) {
    std::map<std::pair<int, int>, std::pair<int, int>> open;  // edge: triangle and corner
    for (std::size_t t = 0; t < normal.size(); ++t) {
      normal[t] = surface.area_vector(t).normalized();
      for (int c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(surface.triangles[t][(c + 1) % 3],  //
                                             surface.triangles[t][(c + 2) % 3]);
        const auto [other, is_new] = open.insert({{low, high}, {static_cast<int>(t), c}});
        if (is_new) continue;
        neighbour[t][static_cast<std::size_t>(c)] = other->second.first;
        neighbour[static_cast<std::size_t>(other->second.first)]
                 [static_cast<std::size_t>(other->second.second)] = static_cast<int>(t);
      }
    }
  }

  void measure(double largest);
  void join_faces();
  bool is_wide(int number) const;
  bool bends_backwards(std::size_t triangle, std::size_t corner) const;
  std::vector<int> parts_by_area();
  void drop_carriers(std::vector<int>& parts) const;
  ThinPart make_part(int number) const;

  const Surface& surface;
  std::vector<Vector3> normal;
  std::vector<double> thickness;              // [m]; 0: not thin
  std::vector<int> opposite;                  // triangles at which the ray leaves
  std::vector<std::array<int, 3>> neighbour;  // across from each corner
  std::vector<int> face;                      // of each triangle
  std::vector<std::vector<int>> faces;        // their triangles
  std::vector<double> areas;                  // of each face [m^2]
  std::vector<int> part;                      // of each face: the face that stands for it
};

void Search::measure(double largest) {
  const auto [lower, upper] = surface.bounds();
  const Vector3 margin = Vector3::Constant(largest);
  const TriangleSearch bins(surface, largest, lower - margin, upper + margin);
  for (std::size_t t = 0; t < normal.size(); ++t) {
    const Vector3i& n = surface.triangles[t];
    const Vector3 middle = (surface.x.col(n[0]) + surface.x.col(n[1]) + surface.x.col(n[2])) / 3.0;
    double nearest = largest;
    const auto [first, last] = bins.near(middle);
    for (const int* other = first; other != last; ++other) {
      const auto o = static_cast<std::size_t>(*other);
      if (o == t) continue;
      const double distance = along_ray(surface, o, middle, -normal[t]);
      if (distance >= nearest) continue;
      nearest = distance;
      opposite[t] = normal[o].dot(normal[t]) < opposite_cosine ? *other : none;
    }
    if (opposite[t] != none) thickness[t] = nearest;
  }
}

void Search::join_faces() {
  for (std::size_t t = 0; t < face.size(); ++t) {
    if (opposite[t] == none || face[t] != none) continue;
    const int number = static_cast<int>(faces.size());
    std::vector<int> triangles = {static_cast<int>(t)};
    face[t] = number;
    for (std::size_t n = 0; n < triangles.size(); ++n) {
      const auto from = static_cast<std::size_t>(triangles[n]);
      for (const int next : neighbour[from]) {
        if (next == none) continue;
        const auto to = static_cast<std::size_t>(next);
        if (opposite[to] == none || face[to] != none ||
            normal[from].dot(normal[to]) < smooth_cosine)
          continue;
        face[to] = number;
        triangles.push_back(next);
      }
    }
    double area = 0.0;
    for (const int n : triangles) area += surface.area_vector(static_cast<std::size_t>(n)).norm();
    areas.push_back(area);
    faces.push_back(std::move(triangles));
  }
}

/// Wider than the part is thick, by more than rounding: its area over its length.
bool Search::is_wide(int number) const {
  const std::vector<int>& triangles = faces[static_cast<std::size_t>(number)];
  Vector3 middle = Vector3::Zero();
  double largest = 0.0;
  for (const int t : triangles) {
    largest = std::max(largest, thickness[static_cast<std::size_t>(t)]);
    for (const int n : surface.triangles[static_cast<std::size_t>(t)]) middle += surface.x.col(n);
  }
  middle /= 3.0 * static_cast<double>(triangles.size());
  double half_length = 0.0;
  for (const int t : triangles)
    for (const int n : surface.triangles[static_cast<std::size_t>(t)])
      half_length = std::max(half_length, (surface.x.col(n) - middle).norm());
  return areas[static_cast<std::size_t>(number)] > minimum_width * largest * 2.0 * half_length;
}

/// Over the edge across from a corner, to the neighbour's corner that is not on the edge.
bool Search::bends_backwards(std::size_t triangle, std::size_t corner) const {
  const Vector3i& nodes = surface.triangles[triangle];
  const auto other = static_cast<std::size_t>(neighbour[triangle][corner]);
  double bend = 0.0, length = 0.0;
  for (const int n : surface.triangles[other]) {
    const Vector3 d = surface.x.col(n) - surface.x.col(nodes[(static_cast<int>(corner) + 1) % 3]);
    if (std::abs(normal[triangle].dot(d)) <= std::abs(bend)) continue;
    bend = normal[triangle].dot(d);
    length = d.norm();
  }
  return bend < convex_sine * length;
}

/// The larger face of each part stands for it.
std::vector<int> Search::parts_by_area() {
  std::vector<std::pair<double, int>> by_area;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    if (is_wide(f)) by_area.push_back({-areas[static_cast<std::size_t>(f)], f});
  std::stable_sort(by_area.begin(), by_area.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  part.assign(faces.size(), none);
  std::vector<int> parts;
  for (const auto& [smaller, f] : by_area) {
    if (part[static_cast<std::size_t>(f)] != none) continue;
    parts.push_back(f);
    part[static_cast<std::size_t>(f)] = f;
    for (const int t : faces[static_cast<std::size_t>(f)]) {
      const int across = opposite[static_cast<std::size_t>(t)];
      const int other = face[static_cast<std::size_t>(across)];
      if (other != none) part[static_cast<std::size_t>(other)] = f;
    }
  }
  return parts;
}

/// Where two parts meet, the larger one carries the smaller: a rim its grousers. Three regions of
/// space meet there, and a node has two copies.
void Search::drop_carriers(std::vector<int>& parts) const {
  std::vector<bool> carries(faces.size(), false);
  const auto part_of = [&](int triangle) {
    const int f = triangle == none ? none : face[static_cast<std::size_t>(triangle)];
    return f == none ? none : part[static_cast<std::size_t>(f)];
  };
  for (std::size_t t = 0; t < face.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const int mine = part_of(static_cast<int>(t)), theirs = part_of(neighbour[t][c]);
      if (mine == none || theirs == none || mine == theirs || bends_backwards(t, c)) continue;
      const auto a = static_cast<std::size_t>(mine), b = static_cast<std::size_t>(theirs);
      carries[areas[a] > areas[b] ? a : b] = true;
    }
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                             [&](int f) { return carries[static_cast<std::size_t>(f)]; }),
              parts.end());
}

/// An edge to another face ends the part where the surface bends backwards. Where it bends forwards
/// the part goes on into the body that carries it.
ThinPart Search::make_part(int number) const {
  ThinPart part;
  std::vector<int> end_nodes;
  for (const int triangle : faces[static_cast<std::size_t>(number)]) {
    const auto t = static_cast<std::size_t>(triangle);
    const Vector3i& nodes = surface.triangles[t];
    ThinPart::Facet facet{nodes, 0.5 * thickness[t], {}, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      const int other = neighbour[t][c];
      if (other != none && face[static_cast<std::size_t>(other)] == number) continue;
      if (other != none && !bends_backwards(t, c)) continue;
      facet.edge_ends[c] = true;
      end_nodes.push_back(nodes[(static_cast<int>(c) + 1) % 3]);
      end_nodes.push_back(nodes[(static_cast<int>(c) + 2) % 3]);
    }
    part.facets.push_back(facet);
  }
  std::sort(end_nodes.begin(), end_nodes.end());
  for (ThinPart::Facet& facet : part.facets)
    for (int c = 0; c < 3; ++c)
      facet.corner_ends[static_cast<std::size_t>(c)] =
          std::binary_search(end_nodes.begin(), end_nodes.end(), facet.nodes[c]);
  return part;
}

/// A gap between two parts: sides that face each other.
struct Gap {
  double width;      // [m]
  std::size_t a, b;  // sides: 2 part + (0 before, 1 behind)
};

/// The nearest corner of a part to another part.
Gap gap_between(const std::vector<ThinPart>& parts, std::size_t i, std::size_t j,
                const Matrix3X& x) {
  Gap gap{std::numeric_limits<double>::infinity(), 0, 0};
  const auto measure = [&](std::size_t from, std::size_t to) {
    double width = std::numeric_limits<double>::infinity(), height = 0.0;
    const std::vector<ThinPart::Facet>& facets = parts[from].facets;
    for (std::size_t f = 0; f < facets.size(); f += 1 + 3 * facets.size() / corners_of_gap)
      for (const int n : facets[f].nodes) {
        const PlaceAtPart place = parts[to].place(x, x.col(n));
        if (place.distance < width) {
          width = place.distance;
          height = place.height;
        }
      }
    gap.width = std::min(gap.width, width);
    return 2 * to + (height >= 0.0 ? 0 : 1);
  };
  gap.a = measure(j, i);
  gap.b = measure(i, j);
  return gap;
}

/// Sides that face each other across the narrowest gaps become one region, unless a part would have
/// it on both sides; then regions get numbers that differ across every part, if there are enough.
void number_regions(std::vector<ThinPart>& parts, const Matrix3X& x, double largest_gap,
                    int regions) {
  std::vector<std::size_t> of(2 * parts.size());
  std::iota(of.begin(), of.end(), std::size_t(0));
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const Gap gap = gap_between(parts, i, j, x); gap.width < largest_gap) gaps.push_back(gap);
  std::stable_sort(gaps.begin(), gaps.end(),
                   [](const Gap& a, const Gap& b) { return a.width < b.width; });
  for (const Gap& gap : gaps) {
    const std::size_t kept = of[gap.a], joined = of[gap.b];
    bool apart = true;
    for (std::size_t side = 0; side < of.size(); side += 2) {
      const auto is_one = [&](std::size_t s) { return of[s] == kept || of[s] == joined; };
      apart &= !(is_one(side) && is_one(side + 1));
    }
    if (apart) std::replace(of.begin(), of.end(), joined, kept);
  }
  std::vector<int> number(of.size(), none);
  for (std::size_t side = 0; side < of.size(); ++side) {
    if (number[of[side]] != none) continue;
    int candidate = 0;
    const auto is_taken = [&] {
      for (std::size_t s = 0; s < of.size(); ++s)
        if (of[s] == of[side] && number[of[s ^ 1u]] == candidate) return true;
      return false;
    };
    while (candidate + 1 < regions && is_taken()) ++candidate;
    number[of[side]] = candidate;
  }
  for (std::size_t side = 0; side < of.size(); ++side)
    parts[side / 2].region[side % 2] = number[of[side]];
}

}  // namespace

PlaceAtPart ThinPart::place(const Matrix3X& x, const Vector3& point) const {
  PlaceAtPart place;
  place.distance = std::numeric_limits<double>::infinity();
  for (const Facet& facet : facets) {
    const Vector3 a = x.col(facet.nodes[0]), b = x.col(facet.nodes[1]), c = x.col(facet.nodes[2]);
    const ClosestPoint closest = closest_point_on_triangle(point, a, b, c);
    if (!(closest.distance < place.distance)) continue;
    place.distance = closest.distance;
    place.normal = (b - a).cross(c - a).normalized();
    place.height = closest.separation.dot(place.normal) + facet.half_thickness;
    place.beside = true;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double share = closest.barycentric[static_cast<int>(corner)];
      if (closest.feature_nodes() == 2 && share == 0.0) place.beside = !facet.edge_ends[corner];
      if (closest.feature_nodes() == 1 && share > 0.0) place.beside = !facet.corner_ends[corner];
    }
  }
  return place;
}

std::pair<Vector3, Vector3> ThinPart::bounds(const Matrix3X& x) const {
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const Facet& facet : facets)
    for (const int n : facet.nodes) {
      lower = lower.cwiseMin(x.col(n));
      upper = upper.cwiseMax(x.col(n));
    }
  return {lower, upper};
}

std::vector<ThinPart> find_thin_parts(const Surface& surface, double largest_thickness,
                                      double largest_gap, int regions) {
  Search search(surface);
  search.measure(largest_thickness);
  search.join_faces();
  std::vector<int> stands = search.parts_by_area();
  search.drop_carriers(stands);
  std::sort(stands.begin(), stands.end());
  std::vector<ThinPart> parts;
  for (const int f : stands) parts.push_back(search.make_part(f));
  number_regions(parts, surface.x, largest_gap, regions);
  return parts;
}

/// A part is its regions and the number of its facets; a facet its nodes, its half thickness, and
/// its ends as bits.
void checkpoint_parts(Checkpoint& state, std::vector<ThinPart>& parts) {
  std::vector<double> numbers;
  for (const ThinPart& part : parts) {
    numbers.insert(numbers.end(),
                   {static_cast<double>(part.region[0]), static_cast<double>(part.region[1]),
                    static_cast<double>(part.facets.size())});
    for (const ThinPart::Facet& facet : part.facets) {
      int ends = 0;
      for (std::size_t c = 0; c < 3; ++c)
        ends += (facet.edge_ends[c] << c) + (facet.corner_ends[c] << (3 + c));
      for (const int node : facet.nodes) numbers.push_back(node);
      numbers.insert(numbers.end(), {facet.half_thickness, static_cast<double>(ends)});
    }
  }
  state.values("thin_parts", numbers);
  if (state.saving()) return;
  parts.clear();
  for (auto number = numbers.cbegin(); number != numbers.cend();) {
    ThinPart part;
    for (int& region : part.region) region = static_cast<int>(*number++);
    part.facets.resize(static_cast<std::size_t>(*number++));
    for (ThinPart::Facet& facet : part.facets) {
      for (int& node : facet.nodes) node = static_cast<int>(*number++);
      facet.half_thickness = *number++;
      const int ends = static_cast<int>(*number++);
      for (std::size_t c = 0; c < 3; ++c) {
        facet.edge_ends[c] = (ends >> c & 1) != 0;
        facet.corner_ends[c] = (ends >> (3 + c) & 1) != 0;
      }
    }
    parts.push_back(std::move(part));
  }
}

}  // namespace furrow
