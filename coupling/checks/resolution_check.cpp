// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/resolution_check.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/liggghts/fixes_of.h"
#include "coupling/bodies/fix_tyre_brick.h"
#include "coupling/bodies/fix_wheel_hub.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/terrain/fix_terrain_continuum.h"

namespace furrow::coupling {

namespace {

constexpr double round_off = 1e-6;  // of a length
// Cells across a body, and in the radius of a wheel.
constexpr double min_cells = 2.0, good_cells = 4.0;
// A polygon is a little narrower than its circle.
constexpr double nearly = 0.98;

struct Span {
  double lower, upper;  // [m]
  double length() const { return upper - lower; }
};

/// What the check knows of a contact.
struct Pair {
  const FixBody& body;
  const FixTerrainContinuum& terrain;
  Span body_x, body_y, terrain_x, terrain_y;
};

/// A half model stands for the whole.
Pair describe(FixContactContinuum& contact) {
  const Body& body = contact.body_fix().body();
  const FixTerrainContinuum& terrain = contact.terrain_fix();
  const Grid& grid = contact.terrain_fix().terrain().grid();
  const auto [lower, upper] = body.surface().bounds();
  const Span y{grid.axis(1).lower(), grid.axis(1).upper()};
  return {contact.body_fix(),
          terrain,
          {lower[0], upper[0]},
          {body.half_model() ? -upper[1] : lower[1], upper[1]},
          {grid.axis(0).lower(), grid.axis(0).upper()},
          {terrain.half_model() ? 2.0 * y.lower - y.upper : y.lower, y.upper}};
}

bool is_wheel(const FixBody& body) { return dynamic_cast<const FixWheelHub*>(&body) != nullptr; }

void check_width(const Pair& pair) {
  const double body = pair.body_y.length(), ground = pair.terrain_y.length();
  if (body > (1.0 + round_off) * ground)
    throw InputError(pair.terrain.options().where("width"),
                     fmt::format("is {:.4g} m, and '{}', which presses on it, is {:.4g} m wide",
                                 ground, pair.body.id, body),
                     "ground wider than the body", "two or three times as wide is usual");
}

/// A wheel touches with less than its diameter.
void check_length(const Pair& pair, const Warn& warn) {
  const double body = pair.body_x.length(), ground = pair.terrain_x.length();
  const double needed = is_wheel(pair.body) ? 0.5 * body : body;
  const std::string where = pair.terrain.options().where("length"),
                    problem = fmt::format(
                        "is {:.4g} m, and '{}', which presses on it, is {:.4g} m "
                        "long",
                        ground, pair.body.id, body);
  if (needed > (1.0 + round_off) * ground)
    throw InputError(where, problem, "ground longer than the body", "make it longer");
  if (body > (1.0 + round_off) * ground)
    warn(fmt::format("{} {}; its ends will hold the ground: make it longer", where, problem));
}

/// A wheel may stand over an end of the ground, but not over its side.
void check_overhang(const Pair& pair, const Warn& warn) {
  const double slack = round_off * pair.body_y.length();
  const bool over_side = pair.body_y.lower < pair.terrain_y.lower - slack ||
                         pair.body_y.upper > pair.terrain_y.upper + slack;
  const bool over_end = !is_wheel(pair.body) && (pair.body_x.lower < pair.terrain_x.lower - slack ||
                                                 pair.body_x.upper > pair.terrain_x.upper + slack);
  if (over_side || over_end)
    warn(
        fmt::format("'{}' stands over the edge of terrain '{}': it spans x = {:.4g} to {:.4g} m, "
                    "y = {:.4g} to {:.4g} m, the terrain {:.4g} to {:.4g} m, {:.4g} to {:.4g} m",
                    pair.body.id, pair.terrain.id, pair.body_x.lower, pair.body_x.upper,
                    pair.body_y.lower, pair.body_y.upper, pair.terrain_x.lower,
                    pair.terrain_x.upper, pair.terrain_y.lower, pair.terrain_y.upper));
}

/// Cells of an axis within a span, fractions included.
double cells_within(const Axis& axis, const Span& span) {
  double count = 0.0;
  for (int c = 0; c < axis.cells(); ++c) {
    const double lower = std::max(axis.knot(c), span.lower),
                 upper = std::min(axis.knot(c + 1), span.upper);
    count += std::max(0.0, upper - lower) / axis.length(c);
  }
  return count;
}

void check_cells(const Pair& pair, const Grid& grid, const Warn& warn) {
  // Half of the ground has half of the cells.
  const double across =
      (pair.terrain.half_model() ? 2.0 : 1.0) * cells_within(grid.axis(1), pair.body_y);
  const double along = pair.body_x.length() / grid.axis(0).shortest();
  const bool wheel = is_wheel(pair.body);
  const double fewest = std::min(across, wheel ? 0.5 * along : along);
  if (fewest >= nearly * good_cells) return;
  const std::string problem = fmt::format(
      "is {:.4g} m: {:.2g} cells across '{}' and {:.2g} {}", pair.terrain.options().number("cell"),
      across, pair.body.id, wheel ? 0.5 * along : along, wheel ? "in its radius" : "along it");
  const std::string remedy = "choose smaller cells, and a larger fine_width if there is one";
  if (fewest < nearly * min_cells)
    throw InputError(pair.terrain.options().where("cell"), problem,
                     fmt::format("at least {:g} of both", min_cells), remedy);
  warn(fmt::format("{} {} (recommended: at least {:g}): forces will be coarse; {}",
                   pair.terrain.options().where("cell"), problem, good_cells, remedy));
}

/// Ground enters a groove, or the gap between two bars, with particles that are narrower.
void check_voids(const Pair& pair, const Warn& warn) {
  const auto* tyre = dynamic_cast<const FixTyreBrick*>(&pair.body);
  if (tyre == nullptr) return;
  const BrickTyreParameters& parameters = tyre->tyre().parameters();
  const double groove = parameters.tread.narrowest_void(parameters.radius());
  const double rib = parameters.tread.narrowest_rib(parameters.radius());
  const ContinuumTerrain& terrain = pair.terrain.terrain();
  const int count = terrain.parameters().particles_per_cell[1];
  const double spacing = terrain.grid().axis(1).shortest() / count;
  const double narrowest = std::min(groove, rib);
  if (spacing < narrowest) return;
  warn(fmt::format(
      "{} is {:.4g} m: particles are {:.3g} m apart under '{}', whose narrowest groove "
      "is {:.3g} m wide and its narrowest rib {:.3g} m: ground bridges the grooves, and "
      "the tread acts nearly as a smooth one; choose cells narrower than {:.3g} m, or a "
      "smooth tread",
      pair.terrain.options().where("cell"), pair.terrain.options().number("cell"), spacing,
      pair.body.id, groove, rib, count * narrowest));
}

}  // namespace

void check_ground_under_bodies(const LAMMPS_NS::LAMMPS& lammps, const Warn& warn) {
  for (auto* contact : fixes_of<FixContactContinuum>(*lammps.modify)) {
    const Pair pair = describe(*contact);
    check_width(pair);
    check_length(pair, warn);
    check_cells(pair, contact->terrain_fix().terrain().grid(), warn);
    check_overhang(pair, warn);
    check_voids(pair, warn);
  }
}

}  // namespace furrow::coupling
