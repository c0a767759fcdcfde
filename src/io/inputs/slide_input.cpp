// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/slide_input.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// A node is reached from a cell and a half away: with less between two walls it would see both.
constexpr double min_cells_across = 3.0;

constexpr const char* shapes[] = {"slide_plane", "slide_cylinder", "slide_box"};

void check_extent(double extent, const char* key, const Options& options) {
  const double least = min_cells_across * options.number("cell");
  if (extent < least)
    throw InputError(
        options.where(key),
        fmt::format("is {:.4g} m across, {:.2g} cells", extent, extent / options.number("cell")),
        fmt::format("at least {:g} cells, {:.4g} m", min_cells_across, least),
        "make it wider, or 'cell' smaller");
}

SlidePlane read_plane(const Options& options) {
  const std::vector<double>& n = options.numbers("slide_plane");
  const Vector3 normal(n[3], n[4], n[5]);
  if (!(normal.norm() > 0.0))
    throw InputError(options.where("slide_plane"), "has a normal of length 0",
                     "x y z of a point, and three numbers of a normal that are not all 0");
  return {{n[0], n[1], n[2]}, normal.normalized()};
}

SlideCylinder read_cylinder(const Options& options) {
  const std::vector<double>& n = options.numbers("slide_cylinder");
  check_extent(2.0 * n[2], "slide_cylinder", options);
  return {n[0], n[1], n[2]};
}

SlideBox read_box(const Options& options) {
  const std::vector<double>& n = options.numbers("slide_box");
  check_extent(std::min(n[2], n[3]), "slide_box", options);
  return {n[0], n[1], n[2], n[3]};
}

}  // namespace

void declare_slide_surface(Schema& schema) {
  schema
      .numbers("slide_plane", 6, "m", Range::any(),
               "slide surface: x y z of a point of a plane, and its normal")
      .optional();
  schema
      .numbers("slide_cylinder", 3, "m", Range::any(),
               "slide surface: x y of the axis, and radius of a vertical cylinder")
      .optional();
  schema
      .numbers("slide_box", 4, "m", Range::any(),
               "slide surface: x y of the middle, length and width of a vertical box")
      .optional();
  schema
      .number("slide_friction", "", Range::non_negative(),
              "friction coefficient on the slide surface")
      .by_default(0.0);
}

std::optional<SlideSurface> read_slide_surface(const Options& options) {
  std::optional<SlideSurface> slide;
  std::string first;
  for (const char* key : shapes) {
    if (!options.given(key)) continue;
    if (slide)
      throw InputError(options.where(key), fmt::format("is given with '{}'", first),
                       "one slide surface", "leave one of the two out");
    first = key;
    slide.emplace();
  }
  if (!slide) {
    if (options.given("slide_friction"))
      throw InputError(options.where("slide_friction"), "is given without a surface",
                       "'slide_friction' with 'slide_plane', 'slide_cylinder' or 'slide_box'",
                       "give a slide surface, or remove 'slide_friction'");
    return slide;
  }
  slide->friction = options.number("slide_friction");
  if (first == "slide_plane")
    slide->shape = read_plane(options);
  else if (first == "slide_cylinder")
    slide->shape = read_cylinder(options);
  else
    slide->shape = read_box(options);
  return slide;
}

}  // namespace furrow
