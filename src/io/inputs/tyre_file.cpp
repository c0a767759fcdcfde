// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/tyre_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/core/types.h"
#include "furrow/io/inputs/input_kind.h"
#include "furrow/io/formats/yaml_tree.h"

namespace furrow {

namespace {

// Wider than any tyre needs, and narrow enough to find a wrong unit
const Range length = {0.0, 10.0, true, false};          // [m]
const Range shell_thickness = {0.0, 0.1, true, false};  // [m]
const Range modulus = Range::closed(1.0, 1e13);         // [Pa]
const Range spring = Range::closed(0.0, 1e7);           // [N m/rad/m]

Schema tyre_schema() {
  Schema schema("tyre");
  schema.number("pressure", "Pa", Range::closed(0.0, largest_inflation),
                "inflation pressure above atmospheric pressure");
  schema.number("bead_radius", "m", length, "radius at which the sidewalls begin");
  schema.number("bead_spacing", "m", length, "distance of the two beads along the axle");
  schema
      .numbers(
          "link", 2, "m", Range::closed(-1.0, 1.0),
          "rigid arm from the tread's edge to the sidewall's end: axial (outwards) and radial part")
      .by_default(std::vector<double>{0.0, 0.0});
  return schema;
}

Schema tread_schema() {
  Schema schema("tread");
  schema.number("radius", "m", length, "radius of the belts, without pressure");
  schema.number("half_width", "m", length, "half the width of the tread");
  schema
      .number("crown", "m", Range::non_negative(), "radius at the middle minus radius at the edge")
      .by_default(0.0);
  schema.number("thickness", "m", shell_thickness,
                "thickness of the equivalent shell: EI = E h^3/12 per unit width");
  schema.number("E1", "Pa", modulus, "modulus along the circumference");
  schema.number("E2", "Pa", modulus, "modulus across");
  schema.number("nu12", "", Range::open(-1.0, 1.0),
                "Poisson's ratio: strain across for stress along");
  schema.number("G12", "Pa", modulus, "shear modulus");
  schema.number("areal_mass", "kg/m2", Range::closed(0.01, 1e4),
                "mass of the real tread per area, rubber and belts");
  return schema;
}

Schema sidewall_schema() {
  Schema schema("sidewall");
  schema.number("length", "m", length, "length of the whole chain of equal segments");
  schema.numbers(
      "bending", 0, "N m", Range::closed(0.0, 1e6),
      "stiffness EI per width of each hinge, from bead to tread: one fewer than segments");
  schema.numbers("curvature", 0, "1/m", Range::any(), "stress-free curvature at each hinge");
  schema.number("rim_angle", "degree", Range::closed(-180.0, 180.0),
                "of the first segment, from outwards to upwards, where the rim's spring is free");
  schema.number("tread_angle", "degree", Range::closed(-180.0, 180.0),
                "of the last segment, where the tread's spring is free");
  schema.number("rim_stiffness", "N m/rad/m", spring,
                "rotational spring between rim and sidewall; 0: a pin");
  schema.number("tread_stiffness", "N m/rad/m", spring,
                "rotational spring between sidewall and tread; 0: a pin");
  schema
      .choice("strip", {"sector", "even"},
              "width of the strip under pressure: `sector`: narrower towards the rim, between two "
              "meridians; `even`: that of the tread")
      .by_default("sector");
  return schema;
}

/// A sidewall leaves the rim outwards and comes back to the tread.
void check_angles(const Options& sidewall) {
  const double rim = sidewall.number("rim_angle"), tread = sidewall.number("tread_angle");
  const double larger = std::max(std::abs(rim), std::abs(tread));
  const bool radians = larger > 0.0 && larger <= 2.0 * pi;
  if (radians || tread < rim)
    throw InputError(
        sidewall.where("tread_angle"),
        fmt::format("is {:g} degrees, and rim_angle {:g}: {}", tread, rim,
                    radians ? "they look like radians" : "the sidewall would turn backwards"),
        "a tread_angle above the rim_angle, in degrees",
        "a quarter circle from the rim on has 0 and 90");
}

}  // namespace

TyreSchemas tyre_schemas() {
  return {{"tyre", tyre_schema()}, {"tread", tread_schema()}, {"sidewall", sidewall_schema()}};
}

TyreParameters read_tyre_file(const std::string& path) {
  const YamlTree file = read_yaml(path);
  check_kind(file, InputKind::tyre);
  refuse_other_keys(file, {"title", "tyre", "tread", "sidewall"});
  const auto read = [&](const Schema& schema, const std::string& meaning) {
    return read_map(schema, file.map(schema.subject(), meaning));
  };
  const Options tyre = read(tyre_schema(), "the section 'tyre' with pressure and beads");
  const Options tread =
      read(tread_schema(), "the section 'tread' with dimensions, stiffnesses and mass");
  const Options sidewall =
      read(sidewall_schema(), "the section 'sidewall' with length, hinges and end springs");

  TyreParameters result;
  result.title = tyre_title(file, path);
  result.pressure = tyre.number("pressure");
  result.bead_radius = tyre.number("bead_radius");
  result.bead_spacing = tyre.number("bead_spacing");
  result.link = {tyre.numbers("link")[0], tyre.numbers("link")[1]};
  result.tread = {
      tread.number("radius"),    tread.number("half_width"), tread.number("crown"),
      tread.number("thickness"), tread.number("E1"),         tread.number("E2"),
      tread.number("nu12"),      tread.number("G12"),        tread.number("areal_mass")};
  result.sidewall = {sidewall.number("length"),
                     sidewall.numbers("bending"),
                     sidewall.numbers("curvature"),
                     radians(sidewall.number("rim_angle")),
                     radians(sidewall.number("tread_angle")),
                     sidewall.number("rim_stiffness"),
                     sidewall.number("tread_stiffness")};
  if (sidewall.text("strip") == "sector") {
    const double edge = result.tread.radius - result.tread.crown;
    result.sidewall.bead_width = result.bead_radius / edge;
    result.sidewall.taper = 1.0 / edge;
  }
  check_angles(sidewall);
  check(result, fmt::format("{}: tyre '{}'", path, result.title));
  return result;
}

std::string tyre_file_text(const TyreParameters& tyre) {
  const TreadParameters& tread = tyre.tread;
  const SidewallParameters& sidewall = tyre.sidewall;
  const auto list = [](const std::vector<double>& values) {
    return fmt::format("[{}]", fmt::join(values, ", "));
  };
  const TyreValues values = {{"tyre",
                              {{"pressure", fmt::to_string(tyre.pressure)},
                               {"bead_radius", fmt::to_string(tyre.bead_radius)},
                               {"bead_spacing", fmt::to_string(tyre.bead_spacing)},
                               {"link", list({tyre.link[0], tyre.link[1]})}}},
                             {"tread",
                              {{"radius", fmt::to_string(tread.radius)},
                               {"half_width", fmt::to_string(tread.half_width)},
                               {"crown", fmt::to_string(tread.crown)},
                               {"thickness", fmt::to_string(tread.thickness)},
                               {"E1", fmt::to_string(tread.E1)},
                               {"E2", fmt::to_string(tread.E2)},
                               {"nu12", fmt::to_string(tread.nu12)},
                               {"G12", fmt::to_string(tread.G12)},
                               {"areal_mass", fmt::to_string(tread.areal_mass)}}},
                             {"sidewall",
                              {{"length", fmt::to_string(sidewall.length)},
                               {"bending", list(sidewall.bending)},
                               {"curvature", list(sidewall.curvature)},
                               {"rim_angle", fmt::to_string(degrees(sidewall.rim_angle))},
                               {"tread_angle", fmt::to_string(degrees(sidewall.tread_angle))},
                               {"rim_stiffness", fmt::to_string(sidewall.rim_stiffness)},
                               {"tread_stiffness", fmt::to_string(sidewall.tread_stiffness)},
                               {"strip", sidewall.taper > 0.0 ? "sector" : "even"}}}};
  return tyre_sections_text(tyre.title, tyre_schemas(), values);
}

}  // namespace furrow
