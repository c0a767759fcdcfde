// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/brick/brick_tyre_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/tyre/brick/section_curve.h"

namespace furrow {

namespace {

// Faces of a brick, counter-clockwise seen from outside; the first lies on what is below.
constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Values of s at the nodes of half a section.
std::vector<double> half_stations(const BrickTyreParameters& tyre, double length, double size) {
  std::vector<double> stations = {0.0};
  for (const double end : places_of_change(tyre, length)) {
    const double start = stations.back();
    if (end - start < same_place) continue;
    const int count = std::max(1, static_cast<int>(std::lround((end - start) / size)));
    for (int k = 1; k <= count; ++k) stations.push_back(start + (end - start) * k / count);
  }
  return stations;
}

class Builder {
 public:
  Builder(const BrickTyreParameters& tyre, int sections, bool half)
      : tyre_(tyre),
        curve_(tyre.carcass.axial, tyre.carcass.radius),
        sections_(sections),
        half_(half),
        levels_(tyre.tread.layers + (tyre.tread.voids.empty() ? 0 : tyre.tread.rib_layers)) {
    const double size = brick_tyre_aspect * 2.0 * pi * tyre.radius() / sections;
    const std::vector<double> positive = half_stations(tyre, curve_.length(), size);
    if (!half)
      for (auto s = positive.rbegin(); s + 1 != positive.rend(); ++s) stations_.push_back(-*s);
    stations_.insert(stations_.end(), positive.begin(), positive.end());
    mesh_.stations = count();
    for (int j = 0; j < count(); ++j)
      if (std::abs(at(j)) < tyre.tread.end() + same_place) {
        if (first_ < 0) first_ = j;
        mesh_.tread_end = j;
      }
  }

  BrickTyreMesh build() {
    add_carcass();
    add_tread();
    mesh_.x.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t n = 0; n < points_.size(); ++n)
      mesh_.x.col(static_cast<Eigen::Index>(n)) = points_[n];
    if (half_)
      for (std::size_t n = 0; n < points_.size(); ++n)
        if (points_[n].y() == 0.0) mesh_.in_symmetry_plane.push_back(static_cast<int>(n));
    add_grid();
    add_surface();
    return std::move(mesh_);
  }

 private:
  int count() const { return static_cast<int>(stations_.size()); }
  double at(int j) const { return stations_[static_cast<std::size_t>(j)]; }
  int wrapped(int i) const { return i % sections_; }
  int carcass_node(int i, int j) const { return wrapped(i) * count() + j; }

  /// Place of a station, at a height above the carcass [m].
  Vector3 place(int i, int j, double height) const {
    const double s = std::abs(at(j));
    const Vector2 in_section = curve_.point(s) + height * curve_.normal(s);
    const double angle = 2.0 * pi * i / sections_;
    const double side = at(j) < 0.0 ? -1.0 : 1.0;
    return {in_section[1] * std::sin(angle), s == 0.0 ? 0.0 : side * in_section[0],
            -in_section[1] * std::cos(angle)};
  }

  void add_carcass() {
    mesh_.quads.resize(tyre_.carcass.zones.size());
    for (int i = 0; i < sections_; ++i)
      for (int j = 0; j < count(); ++j) {
        points_.push_back(place(i, j, 0.0));
        if (j + 1 == count()) {
          mesh_.beads.push_back(carcass_node(i, j));
          continue;
        }
        if (j == 0 && !half_) mesh_.beads.push_back(carcass_node(i, j));
        mesh_.quads[zone(j)].push_back(quad(i, j));
      }
    mesh_.carcass_nodes = static_cast<int>(points_.size());
  }
  Shell4::Quad quad(int i, int j) const {
    return {carcass_node(i, j), carcass_node(i, j + 1), carcass_node(i + 1, j + 1),
            carcass_node(i + 1, j)};
  }
  /// Zone of the elements between stations j and j + 1
  std::size_t zone(int j) const {
    const double middle = 0.5 * std::abs(at(j) + at(j + 1));
    std::size_t zone = 0;
    while (zone + 1 < tyre_.carcass.zones.size() && middle > tyre_.carcass.zones[zone].end) ++zone;
    return zone;
  }

  /// The node of a level, 0 on the carcass; made when it is first asked for. Without thickness all
  /// levels are the carcass's node.
  int tread_node(int i, int j, int level) {
    i = wrapped(i);
    const double s = std::abs(at(j));
    const double thickness = s < tyre_.tread.end() - same_place ? tyre_.tread.thickness_at(s) : 0.0;
    if (level == 0 || thickness == 0.0) return carcass_node(i, j);
    const auto [entry, made] = tread_nodes_.try_emplace({i, j, level}, 0);
    if (made) {
      entry->second = static_cast<int>(points_.size());
      points_.push_back(place(i, j, height(s, thickness, level)));
    }
    return entry->second;
  }
  double height(double s, double thickness, int level) const {
    const int layers = tyre_.tread.layers;
    const double depth = tyre_.tread.depth_at(s);
    const double base = std::max(thickness - depth, 0.5 * thickness);
    if (tyre_.tread.voids.empty()) return thickness * level / layers;
    if (level <= layers) return base * level / layers;
    return base + (thickness - base) * (level - layers) / tyre_.tread.rib_layers;
  }
  bool cut_away(int i, int j) const {
    const double middle = 0.5 * std::abs(at(j) + at(j + 1));
    for (const TreadVoid& cut : tyre_.tread.voids) {
      if (middle < cut.from || middle > cut.to) continue;
      if (cut.pitches == 0) return true;
      const int of_pitch = sections_ / cut.pitches;
      return i % of_pitch < static_cast<int>(std::lround(cut.share * of_pitch));
    }
    return false;
  }

  void add_tread() {
    for (int i = 0; i < sections_; ++i)
      for (int j = first_; j < mesh_.tread_end; ++j)
        for (int level = 0; level < levels_; ++level) {
          if (level >= tyre_.tread.layers && cut_away(i, j)) break;
          mesh_.bricks.push_back({tread_node(i, j, level), tread_node(i, j + 1, level),
                                  tread_node(i + 1, j + 1, level), tread_node(i + 1, j, level),
                                  tread_node(i, j, level + 1), tread_node(i, j + 1, level + 1),
                                  tread_node(i + 1, j + 1, level + 1),
                                  tread_node(i + 1, j, level + 1)});
        }
  }

  /// The outermost nodes of the stations where the tread has thickness.
  void add_grid() {
    const int first = half_ ? first_ : first_ + 1;
    mesh_.grid = {sections_, mesh_.tread_end - 1 - first, half_};
    for (int i = 0; i < sections_; ++i)
      for (int j = first; j < mesh_.tread_end; ++j) {
        int level = levels_;
        while (!tread_nodes_.count({i, j, level})) --level;
        add_surface_node(tread_nodes_.at({i, j, level}));
      }
    for (int j = first; j + 1 < mesh_.tread_end; ++j) {
      const Vector3 a = place(0, j, tyre_.tread.thickness_at(std::abs(at(j))));
      const Vector3 b = place(0, j + 1, tyre_.tread.thickness_at(std::abs(at(j + 1))));
      mesh_.tread_area += (half_ ? 2.0 : 1.0) * (b - a).norm() * pi * -(a.z() + b.z());
    }
  }

  int add_surface_node(int node) {
    const auto [entry, made] =
        on_surface_.try_emplace(node, static_cast<int>(mesh_.surface_nodes.size()));
    if (made) mesh_.surface_nodes.push_back(node);
    return entry->second;
  }
  /// @param corners counter-clockwise seen from outside; some may be the same
  void add_face(const std::array<int, 4>& corners) {
    std::vector<int> distinct;
    for (const int corner : corners)
      if (std::find(distinct.begin(), distinct.end(), corner) == distinct.end())
        distinct.push_back(corner);
    for (std::size_t k = 1; k + 1 < distinct.size(); ++k)
      mesh_.triangles.emplace_back(add_surface_node(distinct[0]), add_surface_node(distinct[k]),
                                   add_surface_node(distinct[k + 1]));
  }

  /// Faces that only one brick has, but for those on the carcass and in the plane of symmetry, and
  /// the carcass next to the tread.
  void add_surface() {
    std::map<std::set<int>, int> uses;
    const auto corners = [](const Brick8::Hexahedron& brick, int face) {
      std::array<int, 4> nodes;
      for (std::size_t k = 0; k < 4; ++k)
        nodes[k] = brick[static_cast<std::size_t>(faces[face][k])];
      return nodes;
    };
    for (const Brick8::Hexahedron& brick : mesh_.bricks)
      for (int face = 0; face < 6; ++face) {
        const auto nodes = corners(brick, face);
        ++uses[{nodes.begin(), nodes.end()}];
      }
    for (const Brick8::Hexahedron& brick : mesh_.bricks)
      for (int face = 0; face < 6; ++face) {
        const auto nodes = corners(brick, face);
        const std::set<int> distinct(nodes.begin(), nodes.end());
        const bool on_carcass = *distinct.rbegin() < mesh_.carcass_nodes;
        const bool in_plane = half_ && std::all_of(nodes.begin(), nodes.end(), [&](int node) {
                                return points_[static_cast<std::size_t>(node)].y() == 0.0;
                              });
        if (distinct.size() > 2 && uses.at(distinct) == 1 && !on_carcass && !in_plane)
          add_face(nodes);
      }
    for (int i = 0; i < sections_; ++i)
      for (int j = 0; j + 1 < count(); ++j)
        if (j >= mesh_.tread_end || (!half_ && j < first_)) add_face(quad(i, j));
  }

  const BrickTyreParameters& tyre_;
  SectionCurve curve_;
  int sections_;
  bool half_;
  int levels_;                                     // of bricks where nothing is cut away
  std::vector<double> stations_;                   // s [m], < 0 at y < 0
  int first_ = -1;                                 // station at which the tread begins
  std::vector<Vector3> points_;                    // [m]
  std::map<std::array<int, 3>, int> tread_nodes_;  // by section, station and level
  std::map<int, int> on_surface_;                  // surface node of a node
  BrickTyreMesh mesh_;
};

/// The pitches of voids are whole numbers of sections, gaps and bars one section at least.
void check_pitches(const BrickTyreParameters& tyre, int sections, const std::string& where) {
  for (const TreadVoid& cut : tyre.tread.voids) {
    if (cut.pitches == 0) continue;
    const int of_pitch = sections / cut.pitches;
    const long gap = std::lround(cut.share * of_pitch);
    if (sections % cut.pitches != 0 || gap < 1 || gap >= of_pitch)
      throw InputError(where,
                       fmt::format("has {} sections for {} pitches with a share of {:g} cut away",
                                   sections, cut.pitches, cut.share),
                       "a multiple of the pitches, with a section at least for gap and bar");
  }
}

}  // namespace

BrickTyreMesh make_brick_tyre_mesh(const BrickTyreParameters& tyre, int sections, bool half,
                                   const std::string& where) {
  check_pitches(tyre, sections, where);
  return Builder(tyre, sections, half).build();
}

}  // namespace furrow
