// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/wheel_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

namespace {

constexpr double largest_aspect = 4.0;  // element length over the smallest feature of a grouser
constexpr double largest_skew = radians(60);
constexpr int largest_triangle_count = 500'000;

void require_positive(double value, const char* what, const std::string& where) {
  if (!(std::isfinite(value) && value > 0.0))
    throw InputError(where, fmt::format("has {} {} m", what, value), "a number > 0");
}

void check(const WheelGeometry& wheel, const std::string& where) {
  require_positive(wheel.diameter, "diameter", where);
  require_positive(wheel.width, "width", where);
  if (!(wheel.shoulder >= 0.0 && wheel.shoulder <= 0.5 * wheel.width &&
        wheel.shoulder < wheel.radius()))
    throw InputError(where, fmt::format("has shoulder {} m", wheel.shoulder),
                     fmt::format("0 to half the width, {} m, and below the radius, {} m",
                                 0.5 * wheel.width, wheel.radius()));
  if (wheel.segments < 12)
    throw InputError(where, fmt::format("has {} segments", wheel.segments), "an integer >= 12");
  if (!(std::isfinite(wheel.element_size) && wheel.element_size >= 0.0))
    throw InputError(where, fmt::format("has element_size {} m", wheel.element_size),
                     "a number > 0, or 0 for one and a half facets");
}

void check(const Grousers& bars, const WheelGeometry& wheel, const std::string& where) {
  if (bars.number < 0)
    throw InputError(where, fmt::format("has {} grousers", bars.number), "an integer >= 0");
  if (bars.number == 0) return;
  require_positive(bars.height, "grouser_height", where);
  require_positive(bars.thickness, "grouser_thickness", where);
  if (!(std::abs(bars.angle) <= largest_skew))
    throw InputError(where, fmt::format("has grouser_angle {} degrees", degrees(bars.angle)),
                     "-60 to 60 degrees");
  if (!(wheel.tread_width() > 0.0))
    throw InputError(
        where, "has grousers but no flat tread to carry them",
        fmt::format("grousers on a shoulder below half the width, {} m", 0.5 * wheel.width),
        "reduce the shoulder");
  const double along = bars.thickness / std::cos(bars.angle),
               pitch = 2.0 * pi * wheel.radius() / bars.number;
  if (along >= pitch || along >= wheel.radius())
    throw InputError(where,
                     fmt::format("has {} grousers that overlap: each takes {:.4g} m of the "
                                 "circumference, their pitch is {:.4g} m",
                                 bars.number, along, pitch),
                     "bars narrower than their pitch and than the radius",
                     "reduce their number, thickness or angle");
}

int parts(double length, double size) {
  return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9)));
}
int nearest_parts(double length, double size) {
  return std::max(1, static_cast<int>(std::lround(length / size)));
}

/// The angles of the nodes around a ring, and which of its segments carry a bar.
struct Circumference {
  struct Bar {
    int first = 0, last = 0;  // columns of its two edges
    double centre = 0.0;      // [rad]
  };
  std::vector<double> angles;  // [rad]
  std::vector<Bar> bars;
  double node_radius = 0.0;  // [m] of the polygon with the area of the circle

  int columns() const { return static_cast<int>(angles.size()); }
  bool under_bar(int column) const {
    return std::any_of(bars.begin(), bars.end(),
                       [&](const Bar& bar) { return column >= bar.first && column < bar.last; });
  }
};

/// Radius of the nodes that gives their polygon the area of the circle: R'^2 sum of sin(step) / 2 =
/// pi R^2.
double equal_area_radius(const std::vector<double>& angles, double radius) {
  double sines = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i)
    sines += std::sin((i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * pi) - angles[i]);
  return radius * std::sqrt(2.0 * pi / sines);
}

Circumference plain_circumference(const WheelGeometry& wheel) {
  Circumference around;
  for (int i = 0; i < wheel.segments; ++i) around.angles.push_back(2.0 * pi * i / wheel.segments);
  around.node_radius = equal_area_radius(around.angles, wheel.radius());
  return around;
}

/// The bar is as wide as the chord between its edges, which depends on the node radius: a few
/// passes settle both.
Circumference grouser_circumference(const WheelGeometry& wheel, double size) {
  const Grousers& bars = wheel.grousers;
  const double chord = bars.thickness / std::cos(bars.angle), pitch = 2.0 * pi / bars.number;
  Circumference around;
  around.node_radius = wheel.radius();
  for (int pass = 0; pass < 20; ++pass) {
    const double half = std::asin(0.5 * chord / around.node_radius), gap = pitch - 2.0 * half;
    const int bar_parts = parts(chord, size), gap_parts = parts(gap * wheel.radius(), size);
    around.angles.clear();
    around.bars.clear();
    for (int bar = 0; bar < bars.number; ++bar) {
      const double centre = bar * pitch;
      const int first = around.columns();
      for (int i = 0; i < bar_parts; ++i)
        around.angles.push_back(centre - half + 2.0 * half * i / bar_parts);
      around.bars.push_back({first, around.columns(), centre});
      for (int i = 0; i < gap_parts; ++i)
        around.angles.push_back(centre + half + gap * i / gap_parts);
    }
    around.node_radius = equal_area_radius(around.angles, wheel.radius());
  }
  return around;
}

/// Builds one wheel; nodes appear when first asked for, so that none is left unused.
class WheelMesh {
 public:
  explicit WheelMesh(const WheelGeometry& wheel, const std::string& where) : wheel_(wheel) {
    const Grousers& bars = wheel.grousers;
    const double facet = 2.0 * pi * wheel.radius() / wheel.segments;
    double size = facet;
    across_ = wheel.element_size > 0.0 ? wheel.element_size : 1.5 * facet;
    if (bars.number > 0) {
      const double along = bars.thickness / std::cos(bars.angle);
      const double gap = 2.0 * pi * wheel.radius() / bars.number - along;
      const double longest = largest_aspect * std::min({bars.thickness, bars.height, gap});
      size = std::min(size, longest);
      across_ = std::min(across_, longest);
      levels_ = parts(bars.height, std::min(size, across_));
    }
    rows_ = wheel.tread_width() > 0.0 ? nearest_parts(wheel.tread_width(), across_) : 0;
    shoulder_rows_ =
        wheel.shoulder > 0.0 ? std::max(2, nearest_parts(0.5 * pi * wheel.shoulder, across_)) : 0;
    const double estimate =
        2.0 * (2.0 * pi * wheel.radius() / size) * (rows_ + 2.0 * shoulder_rows_ + 4.0);
    if (!(estimate < largest_triangle_count))
      throw InputError(where, fmt::format("would have about {:.2g} triangles", estimate),
                       fmt::format("at most {}", largest_triangle_count),
                       "give fewer segments, larger elements or thicker grousers");
    around_ = bars.number > 0 ? grouser_circumference(wheel, size) : plain_circumference(wheel);

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
    double radius = 0.0, y = 0.0;
  };

  int add(const Vector3& point) {
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
  }

  double row_y(int row) const {
    return rows_ == 0 ? 0.0 : wheel_.tread_width() * (static_cast<double>(row) / rows_ - 0.5);
  }
  /// The grid of a ring is turned by the skew of the bars [rad].
  double turn(double y) const { return y * std::tan(wheel_.grousers.angle) / wheel_.radius(); }
  static Vector3 on_circle(double angle, double radius, double y) {
    return {radius * std::sin(angle), y, radius * std::cos(angle)};
  }
  int column(int i) const { return (i + around_.columns()) % around_.columns(); }

  int tread_node(int i, int row) {
    const auto [found, fresh] = tread_nodes_.try_emplace({column(i), row}, -1);
    if (fresh)
      found->second =
          add(on_circle(around_.angles[static_cast<std::size_t>(column(i))] + turn(row_y(row)),
                        around_.node_radius, row_y(row)));
    return found->second;
  }

  /// A node of a bar: level 0 is the tread, the top is the tread moved outwards along the middle
  /// line of the bar.
  int bar_node(int bar, int i, int row, int level) {
    if (level == 0) return tread_node(i, row);
    const auto [found, fresh] = bar_nodes_.try_emplace({bar, i, row, level}, -1);
    if (fresh) {
      const double y = row_y(row), rise = wheel_.grousers.height * level / levels_;
      const double angle = around_.angles[static_cast<std::size_t>(column(i))] + turn(y);
      const double centre = around_.bars[static_cast<std::size_t>(bar)].centre + turn(y);
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
    const double edge_y = row_y(edge_row), scale = around_.node_radius / wheel_.radius();
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
        next.nodes.push_back(add(on_circle(angle + turn(edge_y), next.radius, next.y)));
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
    // of the elements: size of the next ring, depth over size
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

  /// a, b, c as they run clockwise seen from outside on the side y > 0; on the other side they are
  /// turned round.
  void add_on_side(int a, int b, int c, int side) {
    if (side > 0)
      triangles_.push_back({a, c, b});
    else
      triangles_.push_back({a, b, c});
  }

  WheelGeometry wheel_;
  Circumference around_;
  double across_ = 0.0;  // [m] element size across
  int rows_ = 0, shoulder_rows_ = 0, levels_ = 0;
  std::vector<Vector3> points_;
  std::vector<Vector3i> triangles_;
  std::map<std::pair<int, int>, int> tread_nodes_;           // column, row
  std::map<std::tuple<int, int, int, int>, int> bar_nodes_;  // bar, column, row, level
};

}  // namespace

// Support function of the Minkowski sum of a cylinder (radius R - s, half width w/2 - s) and a ball
// of radius s.
double WheelGeometry::depth_below_centre(const Vector3& axle) const {
  const double up = std::min(1.0, std::abs(axle.z()));
  return (radius() - shoulder) * std::sqrt(1.0 - up * up) + (0.5 * width - shoulder) * up +
         shoulder;
}

Surface make_wheel_mesh(const WheelGeometry& geometry, const std::string& where) {
  check(geometry, where);
  check(geometry.grousers, geometry, where);
  Surface surface = WheelMesh(geometry, where).surface();
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
