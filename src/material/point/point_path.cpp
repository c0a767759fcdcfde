// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/point/point_path.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

enum { xx, yy, zz, xy, yz, xz };

Schema path_schema(const std::string& name) { return Schema("path " + name); }

void add_common_keys(Schema& schema) {
  schema.integer("steps", Range::closed(1, 1e7), "steps of each straight piece of the path")
      .by_default("100");
  schema
      .number("tolerance", "", Range::closed(1e-13, 1e-3),
              "of controlled stresses, relative to the largest stress of the step")
      .by_default(1e-10);
  schema
      .number("duration", "s", Range::non_negative(),
              "of each straight piece of the path, for laws that depend on the rate")
      .optional();
}

PointPath path_of(const Options& options, const std::string& type,
                  Motion motion = Motion::stretch) {
  PointPath path;
  path.type = type;
  path.motion = motion;
  path.tolerance = options.number("tolerance");
  return path;
}

/// A segment like the last one of the path, or one of zero strains when it is the first.
PathSegment& next_segment(PointPath& path, const Options& options) {
  path.segments.push_back(path.segments.empty() ? PathSegment{} : path.segments.back());
  path.segments.back().steps = static_cast<int>(options.integer("steps"));
  path.segments.back().duration = options.given("duration") ? options.number("duration") : 0.0;
  return path.segments.back();
}

void set(PathSegment& segment, int component, Control control, double target) {
  segment.control[static_cast<std::size_t>(component)] = control;
  segment.target[component] = target;
}

void set_normal(PathSegment& segment, Control control, double target) {
  for (const int component : {xx, yy, zz}) set(segment, component, control, target);
}

/// Requires exactly one of two lists of targets. @return whether it is the first
bool first_of(const Options& o, const std::string& first, const std::string& second) {
  if (o.given(first) == o.given(second))
    throw InputError(
        o.subject(),
        fmt::format(o.given(first) ? "has both '{}' and '{}'" : "has neither '{}' nor '{}'", first,
                    second),
        fmt::format("exactly one of {}, {}", first, second));
  return o.given(first);
}

PathType hydrostatic() {
  Schema schema = path_schema("hydrostatic");
  schema
      .numbers("pressure", 0, "Pa", Range::any(),
               "targets of p, one after the other; all three normal stresses are controlled")
      .optional();
  schema
      .numbers("volume_strain", 0, "", Range::open(-20.0, 20.0),
               "targets of -ln J, compression positive, instead of pressure; equal stretches")
      .optional();
  add_common_keys(schema);
  return {"hydrostatic", "isotropic compression and unloading", schema, [](const Options& o) {
            PointPath path = path_of(o, "hydrostatic");
            if (first_of(o, "pressure", "volume_strain")) {
              for (const double p : o.numbers("pressure"))
                set_normal(next_segment(path, o), Control::stress, -p);
            } else {
              for (const double eps : o.numbers("volume_strain"))
                set_normal(next_segment(path, o), Control::strain, -eps / 3.0);
            }
            return path;
          }};
}

PathType confined() {
  Schema schema = path_schema("confined");
  schema
      .numbers("stress", 0, "Pa", Range::any(),
               "targets of the axial stress sigma_1 = -sigma_zz, one after the other")
      .optional();
  schema
      .numbers("strain", 0, "", Range::open(-20.0, 20.0),
               "targets of the axial logarithmic strain, compression positive, instead of stress")
      .optional();
  add_common_keys(schema);
  return {"confined", "uniaxial strain: the oedometer", schema, [](const Options& o) {
            PointPath path = path_of(o, "confined");
            const bool stress = first_of(o, "stress", "strain");
            for (const double value : o.numbers(stress ? "stress" : "strain"))
              set(next_segment(path, o), zz, stress ? Control::stress : Control::strain, -value);
            return path;
          }};
}

PathType triaxial() {
  Schema schema = path_schema("triaxial");
  schema.number("confinement", "Pa", Range::non_negative(),
                "pressure of the first, isotropic piece; then kept as lateral stress");
  schema.numbers("axial_strain", 0, "", Range::open(-20.0, 20.0),
                 "targets of the axial logarithmic strain added after the isotropic piece, "
                 "compression positive");
  add_common_keys(schema);
  return {"triaxial", "isotropic consolidation, then axial strain at constant lateral stress",
          schema, [](const Options& o) {
            PointPath path = path_of(o, "triaxial");
            set_normal(next_segment(path, o), Control::stress, -o.number("confinement"));
            for (const double strain : o.numbers("axial_strain"))
              set(next_segment(path, o), zz, Control::strain, -strain);
            return path;
          }};
}

PathType simple_shear() {
  Schema schema = path_schema("simple_shear");
  schema.number("normal_stress", "Pa", Range::any(),
                "-sigma_zz of the first piece; then kept (volume: free) or not (volume: fixed)");
  schema.numbers("shear", 0, "", Range::any(),
                 "targets of the shear gamma = dx/dz, one after the other");
  schema
      .choice("consolidation", {"confined", "isotropic"},
              "of the first piece: no lateral strain, or all normal stresses equal")
      .by_default("confined");
  schema
      .choice("volume", {"free", "fixed"},
              "while shearing: constant normal stress, or constant height")
      .by_default("free");
  add_common_keys(schema);
  return {"simple_shear", "compression, then shear of level planes without lateral strain", schema,
          [](const Options& o) {
            PointPath path = path_of(o, "simple_shear", Motion::shear);
            PathSegment& first = next_segment(path, o);
            set(first, zz, Control::stress, -o.number("normal_stress"));
            if (o.text("consolidation") == "isotropic")
              set_normal(first, Control::stress, -o.number("normal_stress"));
            for (const double gamma : o.numbers("shear")) {
              PathSegment& segment = next_segment(path, o);
              for (const int lateral : {xx, yy}) set(segment, lateral, Control::strain, 0.0);
              if (o.text("volume") == "fixed") set(segment, zz, Control::strain, 0.0);
              set(segment, xz, Control::strain, gamma);
            }
            return path;
          }};
}

PathType cyclic() {
  Schema schema = path_schema("cyclic");
  schema.number("upper", "Pa", Range::any(), "upper axial stress -sigma_zz of a cycle");
  schema.number("lower", "Pa", Range::any(), "lower axial stress -sigma_zz of a cycle")
      .by_default(0.0);
  schema.integer("cycles", Range::closed(1, 100000),
                 "number of cycles; the path ends at the lower stress");
  schema
      .choice("lateral", {"fixed", "free"},
              "no lateral strain, or lateral stress kept at `confinement`")
      .by_default("fixed");
  schema
      .number("confinement", "Pa", Range::non_negative(),
              "lateral pressure with lateral: free, 0 unless given; an isotropic piece comes first")
      .optional();
  add_common_keys(schema);
  return {"cyclic", "axial stress up and down, with or without lateral strain", schema,
          [](const Options& o) {
            if (o.number("upper") <= o.number("lower"))
              throw InputError(
                  o.where("upper"),
                  fmt::format("is {}, not above lower = {}", o.number("upper"), o.number("lower")),
                  "upper > lower");
            PointPath path = path_of(o, "cyclic");
            if (o.text("lateral") == "free") {
              set_normal(next_segment(path, o), Control::stress,
                         o.given("confinement") ? -o.number("confinement") : 0.0);
            } else if (o.given("confinement")) {
              throw InputError(o.where("confinement"), "is given, but the lateral strain is fixed",
                               "confinement only with lateral: free");
            }
            for (long cycle = 0; cycle < o.integer("cycles"); ++cycle)
              for (const char* target : {"upper", "lower"})
                set(next_segment(path, o), zz, Control::stress, -o.number(target));
            return path;
          }};
}

PathType tension() {
  Schema schema = path_schema("tension");
  schema.number("strain", "", Range::open(0.0, 20.0),
                "axial logarithmic strain at the end; hydrostatic: of each axis");
  schema
      .choice("lateral", {"free", "fixed", "hydrostatic"},
              "no lateral stress, no lateral strain, or equal stretch of all axes")
      .by_default("free");
  add_common_keys(schema);
  return {"tension", "pulling along one axis or all", schema, [](const Options& o) {
            PointPath path = path_of(o, "tension");
            PathSegment& segment = next_segment(path, o);
            set(segment, zz, Control::strain, o.number("strain"));
            for (const int lateral : {xx, yy}) {
              if (o.text("lateral") == "free") set(segment, lateral, Control::stress, 0.0);
              if (o.text("lateral") == "hydrostatic")
                set(segment, lateral, Control::strain, o.number("strain"));
            }
            return path;
          }};
}

}  // namespace

const std::vector<PathType>& path_types() {
  static const std::vector<PathType> types{hydrostatic(),  confined(), triaxial(),
                                           simple_shear(), cyclic(),   tension()};
  return types;
}

const PathType& find_path_type(const std::string& name) {
  std::vector<std::string> names;
  for (const PathType& type : path_types()) {
    if (type.name == name) return type;
    names.push_back(type.name);
  }
  throw InputError("path, keyword 'type'", fmt::format("is '{}'", name),
                   fmt::format("one of: {}, table", fmt::join(names, ", ")));
}

Schema table_path_schema() {
  Schema schema = path_schema("table");
  schema
      .choice("motion", {"stretch", "shear"},
              "strains are components of ln U without rotation, or stretches and shears of level "
              "planes")
      .by_default("stretch");
  add_common_keys(schema);
  return schema;
}

Schema table_row_schema() {
  Schema schema("row of path table");
  for (const char* component : component_names)
    schema
        .number(fmt::format("strain_{}", component), "", Range::open(-20.0, 20.0),
                "deformation at the row's end, tension positive")
        .optional();
  for (const char* component : component_names)
    schema
        .number(fmt::format("stress_{}", component), "Pa", Range::any(),
                "Cauchy stress at the row's end, tension positive")
        .optional();
  schema.integer("steps", Range::closed(1, 1e7), "steps of this row; else the path's").optional();
  schema.number("duration", "s", Range::non_negative(), "of this row; else the path's").optional();
  return schema;
}

PointPath table_path(const Options& options, const std::vector<Options>& rows) {
  PointPath path = path_of(options, "table",
                           options.text("motion") == "stretch" ? Motion::stretch : Motion::shear);
  path.strain_from_switch = false;
  for (const Options& row : rows) {
    PathSegment& segment = next_segment(path, options);
    if (row.given("steps")) segment.steps = static_cast<int>(row.integer("steps"));
    if (row.given("duration")) segment.duration = row.number("duration");
    for (int c = 0; c < 6; ++c) {
      const std::string strain = fmt::format("strain_{}", component_names[std::size_t(c)]),
                        stress = fmt::format("stress_{}", component_names[std::size_t(c)]);
      if (row.given(strain) && row.given(stress))
        throw InputError(row.where(stress), "controls a component whose strain is given too",
                         "one of " + strain + ", " + stress);
      if (row.given(strain)) set(segment, c, Control::strain, row.number(strain));
      if (row.given(stress)) set(segment, c, Control::stress, row.number(stress));
    }
  }
  return path;
}

}  // namespace furrow
