// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/meshes/wheel_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/geometry/meshes/wheel_circumference.h"

namespace furrow {

namespace {

constexpr double largest_aspect = 4.0;  // element length over the smallest feature of a grouser
constexpr int largest_triangle_count = 500'000;

int nearest_parts(double length, double size) {
  return std::max(1, static_cast<int>(std::lround(length / size)));
}

/// Builds one wheel; nodes appear when first asked for, so that none is left unused.
class WheelMeshBuilder {
 public:
  /// @throws InputError where the mesh would have too many triangles
  WheelMeshBuilder(const WheelGeometry& wheel, const std::string& where) : wheel_(wheel) {
    divide(where);
    build_tread();
    for (std::size_t bar = 0; bar < around_.bars.size(); ++bar) build_bar(static_cast<int>(bar));
    for (const int side : {-1, 1}) build_disc(build_shoulder(side), side);
  }

  Surface surface() const {
    Surface surface;
    surface.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i)
      surface.x.col(static_cast<Eigen::Index>(i)) = points_[i];
    surface.triangles = triangles_;
    return surface;
  }

 private:
  struct Ring {
    std::vector<int> nodes;
    double radius = 0.0;  // [m]
    double y = 0.0;       // [m]
  };

  /// Columns around, rows across the flat tread and the shoulders, levels of the bars.
  void divide(const std::string& where) {
    const Grousers& bars = wheel_.grousers;
    const double radius = wheel_.radius();
    const double facet = 2.0 * pi * radius / wheel_.segments;
    double along = facet;  // [m] element size around
    double across = wheel_.element_size > 0.0 ? wheel_.element_size : 1.5 * facet;
    if (bars.number > 0) {
      const double thickness = bars.thickness / std::cos(bars.angle);  // along the circumference
      const double gap = 2.0 * pi * radius / bars.number - thickness;
      const double longest = largest_aspect * std::min({bars.thickness, bars.height, gap});
      along = std::min(along, longest);
      across = std::min(across, longest);
      levels_ = parts(bars.height, std::min(along, across));
    }
    rows_ = wheel_.tread_width() > 0.0 ? nearest_parts(wheel_.tread_width(), across) : 0;
    shoulder_rows_ =
        wheel_.shoulder > 0.0 ? std::max(2, nearest_parts(0.5 * pi * wheel_.shoulder, across)) : 0;
    const double estimate =
        2.0 * (2.0 * pi * radius / along) * (rows_ + 2.0 * shoulder_rows_ + 4.0);
    if (!(estimate < largest_triangle_count))
      throw InputError(where, fmt::format("would have about {:.2g} triangles", estimate),
                       fmt::format("at most {}", largest_triangle_count),
                       "give fewer segments, larger elements or thicker grousers");
    around_ = bars.number > 0 ? grouser_circumference(wheel_, along) : plain_circumference(wheel_);
  }

  int add(const Vector3& point) {
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
  }

  double row_y(int row) const {
    return rows_ == 0 ? 0.0 : wheel_.tread_width() * (static_cast<double>(row) / rows_ - 0.5);
  }
  /// [rad] by which the skew of the bars shifts the grid of the ring at y.
  double shift(double y) const { return y * std::tan(wheel_.grousers.angle) / wheel_.radius(); }
  static Vector3 on_circle(double angle, double radius, double y) {
    return {radius * std::sin(angle), y, radius * std::cos(angle)};
  }
  int column(int i) const { return (i + around_.columns()) % around_.columns(); }

  int tread_node(int i, int row) {
    const auto [found, fresh] = tread_nodes_.try_emplace({column(i), row}, -1);
    if (fresh)
      found->second =
          add(on_circle(around_.angles[static_cast<std::size_t>(column(i))] + shift(row_y(row)),
                        around_.node_radius, row_y(row)));
    return found->second;
  }

  /// A node of a bar: level 0 is the tread, the top is the tread moved outwards along the middle
  /// line of the bar.
  int bar_node(int bar, int i, int row, int level) {
    if (level == 0) return tread_node(i, row);
    const auto [found, fresh] = bar_nodes_.try_emplace({bar, i, row, level}, -1);
    if (fresh) {
      const double y = row_y(row);
      const double rise = wheel_.grousers.height * level / levels_;
      const double angle = around_.angles[static_cast<std::size_t>(column(i))] + shift(y);
      const double centre = around_.bars[static_cast<std::size_t>(bar)].centre + shift(y);
      found->second = add(on_circle(angle, around_.node_radius, y) + on_circle(centre, rise, 0.0));
    }
    return found->second;
  }

  double distance(int a, int b) const {
    return (points_[static_cast<std::size_t>(a)] - points_[static_cast<std::size_t>(b)]).norm();
  }

  /// Two triangles of a quadrilateral given clockwise as seen from outside, cut along the shorter
  /// diagonal; of two equal ones along ac where odd, so that cuts alternate. Without skew all
  /// quadrilaterals are plane: the cut changes no shape.
  void quad(int a, int b, int c, int d, bool odd) {
    const double ac = distance(a, c), bd = distance(b, d);
    const bool cut_ac = std::abs(ac - bd) < 1e-6 * (ac + bd) ? odd : ac < bd;
    if (cut_ac) {
      triangles_.push_back({a, c, b});
      triangles_.push_back({a, d, c});
    } else {
      triangles_.push_back({a, d, b});
      triangles_.push_back({b, d, c});
    }
  }

  void build_tread() {
    for (int i = 0; i < around_.columns(); ++i) {
      if (around_.under_bar(i)) continue;
      for (int row = 0; row < rows_; ++row)
        quad(tread_node(i, row), tread_node(i, row + 1), tread_node(i + 1, row + 1),
             tread_node(i + 1, row), (i + row) % 2 != 0);
    }
  }

  void build_bar(int bar) {
    const auto [first, last, centre] = around_.bars[static_cast<std::size_t>(bar)];
    const auto at = [&](int i, int row, int level) { return bar_node(bar, i, row, level); };
    for (int row = 0; row < rows_; ++row) {
      for (int i = first; i < last; ++i)
        quad(at(i, row, levels_), at(i, row + 1, levels_), at(i + 1, row + 1, levels_),
             at(i + 1, row, levels_), (i + row) % 2 != 0);
      for (int level = 0; level < levels_; ++level) {
        const bool odd = (row + level) % 2 != 0;
        quad(at(first, row, level), at(first, row + 1, level), at(first, row + 1, level + 1),
             at(first, row, level + 1), odd);
        quad(at(last, row, level), at(last, row, level + 1), at(last, row + 1, level + 1),
             at(last, row + 1, level), odd);
      }
    }
    for (int i = first; i < last; ++i)
      for (int level = 0; level < levels_; ++level) {
        const bool odd = (i + level) % 2 != 0;
        quad(at(i, 0, level), at(i, 0, level + 1), at(i + 1, 0, level + 1), at(i + 1, 0, level),
             odd);
        quad(at(i, rows_, level), at(i + 1, rows_, level), at(i + 1, rows_, level + 1),
             at(i, rows_, level + 1), odd);
      }
  }

  /// The rings of one shoulder, outwards from the tread. @return the last one, where the side
  /// begins
  Ring build_shoulder(int side) {
    const int edge_row = side > 0 ? rows_ : 0;
    const double edge_y = row_y(edge_row);
    const double scale = around_.node_radius / wheel_.radius();
    Ring ring;
    for (int i = 0; i < around_.columns(); ++i) ring.nodes.push_back(tread_node(i, edge_row));
    ring.radius = around_.node_radius;
    ring.y = edge_y;
    for (int row = 1; row <= shoulder_rows_; ++row) {
      const double slope = 0.5 * pi * row / shoulder_rows_;
      Ring next;
      next.radius = scale * (wheel_.radius() - wheel_.shoulder * (1.0 - std::cos(slope)));
      next.y = edge_y + side * wheel_.shoulder * std::sin(slope);
      for (const double angle : around_.angles)
        next.nodes.push_back(add(on_circle(angle + shift(edge_y), next.radius, next.y)));
      for (int i = 0; i < around_.columns(); ++i) {
        const auto here = static_cast<std::size_t>(i),
                   ahead = static_cast<std::size_t>(column(i + 1));
        const bool odd = ((i + row) % 2 != 0) == (side > 0);
        if (side > 0)
          quad(ring.nodes[here], next.nodes[here], next.nodes[ahead], ring.nodes[ahead], odd);
        else
          quad(next.nodes[here], ring.nodes[here], ring.nodes[ahead], next.nodes[ahead], odd);
      }
      ring = std::move(next);
    }
    return ring;
  }

  /// The flat side: rings whose elements grow inwards, then a fan around the centre.
  void build_disc(Ring ring, int side) {
    // Size of elements over that in the ring before; depth of elements over their size
    constexpr double growth = 1.5, flatness = 0.9;
    constexpr int fan = 9;
    double size = 2.0 * pi * ring.radius / static_cast<double>(ring.nodes.size());
    while (ring.nodes.size() > fan) {
      Ring next;
      next.y = ring.y;
      next.radius = ring.radius - std::min(flatness * size, 0.6 * ring.radius);
      size *= growth;
      const int wanted = static_cast<int>(std::lround(2.0 * pi * next.radius / size));
      const int count = std::clamp(wanted, 6, static_cast<int>(ring.nodes.size()));
      const Vector3 start = points_[static_cast<std::size_t>(ring.nodes[0])];
      const double phase = std::atan2(start.x(), start.z());
      for (int i = 0; i < count; ++i)
        next.nodes.push_back(
            add(on_circle(phase + 2.0 * pi * (i + 0.5) / count, next.radius, next.y)));
      connect(ring, next, side);
      ring = std::move(next);
    }
    const int centre = add({0.0, ring.y, 0.0});
    for (std::size_t i = 0; i < ring.nodes.size(); ++i)
      add_on_side(ring.nodes[i], centre, ring.nodes[(i + 1) % ring.nodes.size()], side);
  }

  /// Fills the strip between two rings of any numbers of nodes, always by the shorter of the two
  /// possible edges.
  void connect(const Ring& outer, const Ring& inner, int side) {
    const std::size_t outer_count = outer.nodes.size(), inner_count = inner.nodes.size();
    std::size_t first = 0;
    for (std::size_t k = 1; k < inner_count; ++k)
      if (distance(outer.nodes[0], inner.nodes[k]) < distance(outer.nodes[0], inner.nodes[first]))
        first = k;
    const auto outer_node = [&](std::size_t i) { return outer.nodes[i % outer_count]; };
    const auto inner_node = [&](std::size_t k) { return inner.nodes[(first + k) % inner_count]; };
    for (std::size_t i = 0, k = 0; i < outer_count || k < inner_count;) {
      const double along_outer = i < outer_count ? distance(outer_node(i + 1), inner_node(k))
                                                 : std::numeric_limits<double>::max();
      const double along_inner = k < inner_count ? distance(outer_node(i), inner_node(k + 1))
                                                 : std::numeric_limits<double>::max();
      if (along_outer <= along_inner) {
        add_on_side(outer_node(i), inner_node(k), outer_node(i + 1), side);
        ++i;
      } else {
        add_on_side(outer_node(i), inner_node(k), inner_node(k + 1), side);
        ++k;
      }
    }
  }

  /// a, b, c run clockwise seen from outside on the side y > 0, and counter-clockwise on the other.
  void add_on_side(int a, int b, int c, int side) {
    if (side > 0)
      triangles_.push_back({a, c, b});
    else
      triangles_.push_back({a, b, c});
  }

  WheelGeometry wheel_;
  WheelCircumference around_;
  int rows_ = 0;           // of elements across the flat tread
  int shoulder_rows_ = 0;  // of elements from the tread to a side
  int levels_ = 0;         // of elements from the tread to the top of a bar
  std::vector<Vector3> points_;
  std::vector<Vector3i> triangles_;
  std::map<std::pair<int, int>, int> tread_nodes_;           // column, row
  std::map<std::tuple<int, int, int, int>, int> bar_nodes_;  // bar, column, row, level
};

}  // namespace

Surface make_wheel_mesh(const WheelGeometry& geometry, const std::string& where) {
  check(geometry, where);
  Surface surface = WheelMeshBuilder(geometry, where).surface();
  const double sharpest = surface.minimum_angle();
  if (sharpest < minimum_mesh_angle)
    throw InputError(where,
                     fmt::format("would have sliver triangles (sharpest corner {:.2g} degrees)",
                                 degrees(sharpest)),
                     fmt::format("corners of at least {:.0f} degrees", degrees(minimum_mesh_angle)),
                     "give more segments, another element_size, or a shoulder neither far smaller "
                     "than the facets nor close "
                     "to the radius");
  return surface;
}

}  // namespace furrow
