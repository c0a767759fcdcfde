// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for what touches what: bodies and grains, bodies and a continuum.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/wheels/fix_plate_rigid.h"
#include "coupling/wheels/fix_tyre_brick.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/checks/scene_checks.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "domain.h"
#include "furrow/mpm/ground/boundary_effect.h"
#include "furrow/mpm/discontinuities/divided_ground.h"
#include "furrow/mpm/ground/ground_under_wheel.h"
#include "primitive_wall.h"
#include "furrow/tyre/darnell/darnell_tyre.h"

namespace furrow::coupling {

namespace {

constexpr double round_off = 1e-6;  // of a length
// Cells across a body, and in the radius of a wheel.
constexpr double min_cells = 2.0, good_cells = 4.0;
// A polygon is a little narrower than its circle.
constexpr double nearly = 0.98;
// A plane in the place of a surface mesh: cosine between both normals, share of the mesh's area,
// and distance behind the mesh in radii of a grain.
constexpr double aligned = 0.7, covered_share = 0.05, behind = 0.5;
// Size of terrain under a wheel, in lengths of the wheel.
constexpr double longest_window = 30.0, longest_track = 200.0, widest_terrain = 30.0,
                 deepest_terrain = 10.0;
constexpr double largest_pull = 1.0;  // over the vertical force: sand of 45 degrees
// Largest vertical part of a tool's direction, and radial part of a grouser's normal
constexpr double sideways = 0.5;
constexpr double beyond_rim = 1.01;  // distance of a grouser's corner from the axle, in radii
constexpr double near_end = 0.75;    // diameters of the wheel
// Ratio of surcharge and weight of the grains, either over the other.
constexpr double surcharge_ratio = 2.0;
// Force on the steep faces of a wheel along its axle, over the vertical force on the wheel
constexpr double small_side_force = 0.03;

struct Span {
  double lower, upper;  // [m]
  double length() const { return upper - lower; }
};

/// Body and terrain of a contact, with their extents.
struct Pair {
  const FixBody& body;
  const FixTerrain& terrain;
  Span body_x, body_y, terrain_x, terrain_y;
};

/// Corners of the box around a body; those of a half model are of the whole.
std::pair<Vector3, Vector3> whole_bounds(const Body& body) {
  auto corners = body.surface().bounds();
  if (body.half_model()) corners.first.y() = -corners.second.y();
  return corners;
}

/// Extents of a half model are those of the whole.
Pair describe(FixContactContinuum& contact) {
  const FixTerrain& terrain = contact.terrain_fix();
  const auto [lower, upper] = whole_bounds(contact.body_fix().body());
  const auto [x_lower, x_upper] = terrain.extent(0);
  const auto [y_lower, y_upper] = terrain.extent(1);
  return {
      contact.body_fix(),     terrain,
      {lower.x(), upper.x()}, {lower.y(), upper.y()},
      {x_lower, x_upper},     {terrain.half_model() ? 2.0 * y_lower - y_upper : y_lower, y_upper}};
}

bool is_wheel(const FixBody& body) { return dynamic_cast<const FixWheelHub*>(&body) != nullptr; }

bool in_a_wall(const LAMMPS_NS::Modify& modify, const FixMeshBody& mesh) {
  const auto walls = fixes_of<const FixWallGranBody>(modify);
  return std::any_of(walls.begin(), walls.end(),
                     [&](const FixWallGranBody* wall) { return wall->uses(mesh); });
}

bool has_contact(const LAMMPS_NS::Modify& modify, const FixBody& fix) {
  const auto contacts = fixes_of<const FixContact>(modify);
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const FixContact* contact) { return contact->uses(fix); });
}

struct Radii {
  double smallest, largest;  // [m] of all ranks; no grains: infinity and 0
};

Radii radii_of_grains(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  Radii radii{std::numeric_limits<double>::infinity(), 0.0};
  for (int i = 0; i < atom.nlocal; ++i) {
    radii.smallest = std::min(radii.smallest, atom.radius[i]);
    radii.largest = std::max(radii.largest, atom.radius[i]);
  }
  const Communicator ranks(&lammps.world);
  return {-ranks.max(-radii.smallest), ranks.max(radii.largest)};
}

/// True if a wall lies where a grain on the triangle would rest, or so close above that none fits
/// between.
bool replaces(LAMMPS_NS::PrimitiveWall& wall, const Vector3& centre, const Vector3& normal,
              const Radii& radii) {
  Vector3 point = centre, to_wall = Vector3::Zero();
  const double off = behind * radii.smallest;
  point -= off * normal;  // a point in the plane of the mesh has no direction
  wall.resolveContact(point.data(), 0.0, to_wall.data());
  const double along = to_wall.dot(normal);
  return along >= aligned * to_wall.norm() && along > 0.0 && along - off <= 2.0 * radii.largest;
}

}  // namespace

bool touches_grains(const LAMMPS_NS::LAMMPS& lammps, const FixBody& body) {
  const auto meshes = fixes_of<const FixMeshBody>(*lammps.modify);
  return std::any_of(meshes.begin(), meshes.end(), [&](const FixMeshBody* mesh) {
    return mesh->uses(body) && in_a_wall(*lammps.modify, *mesh);
  });
}

CheckResult stock_wall_has_no_body(const Scene&, const LAMMPS_NS::FixWallGran& wall) {
  if (!wall.is_mesh_wall() || dynamic_cast<const FixWallGranBody*>(&wall)) return {};
  for (int m = 0; m < wall.n_meshes(); ++m)
    if (const auto* mesh = dynamic_cast<const FixMeshBody*>(wall.mesh_list()[m]))
      return refusal(fmt::format("fix {} '{}'", wall.style, wall.id),
                     fmt::format("holds the mesh/body '{}', and would not hand the forces of "
                                 "the grains on to its body",
                                 mesh->id),
                     "a mesh/body in a wall/gran/body",
                     "write 'wall/gran/body' in place of 'wall/gran' in that line");
  return {};
}

/// LIGGGHTS runs one mesh wall; its own error says no more.
CheckResult one_wall_has_all_meshes(const Scene& scene, const FixWallGranBody& wall) {
  for (const auto* other : fixes_of<LAMMPS_NS::FixWallGran>(*scene.lammps.modify))
    if (other != &wall && other->is_mesh_wall())
      return refusal(
          fmt::format("fix {} '{}'", other->style, other->id),
          fmt::format("is a wall of meshes next to fix wall/gran/body '{}'", wall.id),
          "one wall for all meshes of a scene",
          fmt::format("list its meshes in 'meshes' of '{}' and remove its line", wall.id));
  return {};
}

CheckResult mesh_is_in_a_wall(const Scene& scene, const FixMeshBody& mesh) {
  if (in_a_wall(*scene.lammps.modify, mesh)) return {};
  return warning(
      fmt::format("fix mesh/body '{}' is in no wall/gran/body: grains do not feel it; add 'fix "
                  "<id> all wall/gran/body <contact> mesh n_meshes 1 meshes {}'",
                  mesh.id, mesh.id));
}

CheckResult something_presses_on_terrain(const Scene& scene, const FixTerrain& terrain) {
  if (has_contact(*scene.lammps.modify, terrain) || touches_grains(scene.lammps, terrain) ||
      terrain.options().flag("surface_mesh"))
    return {};
  return warning(
      fmt::format("nothing presses on {}: no contact/continuum names it", terrain.name()));
}

CheckResult surface_mesh_is_in_a_wall(const Scene& scene, const FixTerrain& terrain) {
  if (!terrain.options().flag("surface_mesh") || touches_grains(scene.lammps, terrain)) return {};
  return warning(
      fmt::format("{} has a surface mesh that no wall/gran/body lists: grains fall through it; add "
                  "a mesh/body of it",
                  terrain.name()));
}

CheckResult no_wall_replaces_the_surface_mesh(const Scene& scene, const FixTerrain& terrain) {
  if (!touches_grains(scene.lammps, terrain)) return {};
  const Surface& mesh = terrain.body().surface();
  const Radii radii = radii_of_grains(scene.lammps);
  if (radii.largest == 0.0) return {};
  for (auto* wall : fixes_of<LAMMPS_NS::FixWallGran>(*scene.lammps.modify)) {
    if (wall->is_mesh_wall() || !wall->primitiveWall()) continue;
    double area = 0.0, replaced = 0.0;
    for (const Vector3i& nodes : mesh.triangles) {
      const Vector3 a = mesh.x.col(nodes[0]), b = mesh.x.col(nodes[1]), c = mesh.x.col(nodes[2]);
      const Vector3 twice = (b - a).cross(c - a);
      area += twice.norm();
      if (replaces(*wall->primitiveWall(), (a + b + c) / 3.0, twice.normalized(), radii))
        replaced += twice.norm();
    }
    if (replaced <= covered_share * area) continue;
    return refusal(fmt::format("fix {} '{}'", wall->style, wall->id),
                   fmt::format("lies in {:.2g} of the surface mesh of terrain '{}': grains would "
                               "rest on the wall and not on the terrain",
                               replaced / area, terrain.id),
                   "walls away from that mesh",
                   fmt::format("write 'unfix {}' before the first run", wall->id));
  }
  return {};
}

/// A continuum that starts with another load than its grains settles, or springs back.
CheckResult surcharge_is_the_grains_weight(const Scene& scene, const FixTerrain& terrain) {
  const double surcharge = terrain.options().number("surcharge");
  if (surcharge == 0.0 || scene.time() > 0.0 || !touches_grains(scene.lammps, terrain)) return {};
  const TerrainParameters& parameters = terrain.terrain().parameters();
  const auto [x_lower, x_upper] = terrain.extent(0);
  auto [y_lower, y_upper] = terrain.extent(1);
  if (parameters.trough) {
    const double middle = 0.5 * (y_lower + y_upper), half = 0.5 * parameters.trough->width;
    y_lower = middle - half;
    y_upper = middle + half;
  }
  const LAMMPS_NS::Atom& atom = *scene.lammps.atom;
  double mass = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) {
    const double* x = atom.x[i];
    if (x[0] > x_lower && x[0] < x_upper && x[1] > y_lower && x[1] < y_upper) mass += atom.rmass[i];
  }
  mass = Communicator(&scene.lammps.world).sum(mass);
  const double weight =
      mass * parameters.gravity.norm() / ((x_upper - x_lower) * (y_upper - y_lower));
  if (weight == 0.0 ||
      (surcharge <= surcharge_ratio * weight && weight <= surcharge_ratio * surcharge))
    return {};
  return warning(
      fmt::format("{} is {:.4g} Pa, and the grains above weigh {:.4g} Pa: the terrain does not "
                  "start in equilibrium; write 'surcharge {:.4g}' [Pa]",
                  terrain.options().where("surcharge"), surcharge, weight, weight));
}

CheckResult half_terrain_has_half_the_grains(const Scene& scene, const FixTerrain& terrain) {
  if (!terrain.half_model() || !touches_grains(scene.lammps, terrain) ||
      scene.lammps.domain->boxlo[1] >= 0.0)
    return {};
  return warning(
      fmt::format("{} is there for y >= 0 only: grains at y < 0 have nothing below them; "
                  "write 'symmetry no', or a box and walls that keep them at y >= 0",
                  terrain.name()));
}

CheckResult body_touches_something(const Scene& scene, FixBody& body) {
  if (dynamic_cast<const Ground*>(&body) || touches_grains(scene.lammps, body) ||
      has_contact(*scene.lammps.modify, body))
    return {};
  return warning(fmt::format(
      "{} touches nothing: there is no contact/continuum, contact/scm, contact/rft or "
      "contact/plane of it, and no mesh/body of it in a wall/gran/body; it will feel no force",
      body.name()));
}

namespace {

PressedBy tool_of(const FixBody& body) {
  return is_wheel(body) ? PressedBy::wheel : PressedBy::plate;
}

GroundKind kind_of(const FixTerrain& terrain) {
  return ground_kind(*terrain.terrain().parameters().layers.front().material);
}

/// Text of the expected effects: "12 % less hub drop and 0.02 less net traction coefficient".
std::string expected(const BoundaryEffects& effects, double x, PressedBy tool) {
  const double response = effects.response.at(x), traction = effects.traction.at(x);
  const auto side = [](double change) { return change > 0.0 ? "more" : "less"; };
  std::vector<std::string> parts;
  if (response != 0.0)
    parts.push_back(fmt::format("{:.2g} % {} {}", 100.0 * std::abs(response), side(response),
                                tool == PressedBy::wheel ? "hub drop" : "force"));
  if (traction != 0.0)
    parts.push_back(
        fmt::format("{:.2g} {} net traction coefficient", std::abs(traction), side(traction)));
  return fmt::format("{}", fmt::join(parts, " and "));
}

/// Text of the source of the expectation, and of its remaining part after the remedy.
std::string source(GroundKind kind) {
  return fmt::format("estimate of the study ground_size on {}; its limits are 2 % and 0.01",
                     name_of(kind));
}

}  // namespace

/// Over a hard base the stress of a load fades within the depth (ground_under_wheel.h).
CheckResult terrain_is_wide_enough(const Scene&, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  const Options& options = pair.terrain.options();
  const double body = pair.body_y.length(), ground = pair.terrain_y.length();
  const PressedBy tool = tool_of(pair.body);
  const GroundKind kind = kind_of(pair.terrain);
  const BoundaryEffects effects = effects_of_sides(kind, tool);
  const double enough =
      rounded_up(body + 2.0 * std::min(effects.enough() * body, options.number("depth")));
  if ((1.0 + round_off) * ground >= enough) return {};
  const std::string where = options.where("width"),
                    problem =
                        fmt::format("is {:.4g} m, and '{}', which presses on it, is {:.4g} m wide",
                                    ground, pair.body.id, body);
  if (body > (1.0 + round_off) * ground)
    return refusal(where, problem, "ground wider than the body",
                   fmt::format("write 'width {:.2g}'", enough));
  return warning(fmt::format(
      "{} {}; its sides hold the ground as walls do: expect up to {}; write at least {:.2g} m ({})",
      where, problem, expected(effects, 0.5 * (ground / body - 1.0), tool), enough, source(kind)));
}

/// A line that names its base states what lies below.
CheckResult terrain_is_deep_enough(const Scene&, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  const Options& options = pair.terrain.options();
  const double depth = options.number("depth"), body = pair.body_y.length();
  const PressedBy tool = tool_of(pair.body);
  const GroundKind kind = kind_of(pair.terrain);
  const BoundaryEffects effects = effects_of_base(kind, tool);
  const double enough = effects.enough() > 0.0 ? rounded_up(effects.enough() * body) : 0.0;
  if (options.given("base") || (1.0 + round_off) * depth >= enough) return {};
  return warning(fmt::format(
      "{} is {:.4g} m, {:.2g} widths of '{}'; a hard base bears a part of its load: expect up to "
      "{}; "
      "make the ground at least {:.2g} m deep ({}), or write 'base rough' if it lies on something "
      "hard",
      options.where("depth"), depth, depth / body, pair.body.id,
      expected(effects, depth / body, tool), enough, source(kind)));
}

namespace {

/// Travel along x from now to the end of the run [m]; nothing for a body whose speed is an answer.
std::optional<double> planned_travel(const Scene& scene, const FixBody& body) {
  for (const auto* rig : fixes_of<const FixWheelRig>(*scene.lammps.modify))
    if (&rig->wheel_fix() == &body) return rig->rig().travel(scene.time(), scene.end());
  return {};
}

}  // namespace

/// Grousers that cells do not resolve act as a smooth rim of some radius between rim and tip.
CheckResult cells_show_the_grousers(const Scene&, FixGroundContact& contact) {
  const FixBody& body = contact.body_fix();
  const Options& ground = contact.ground().line();
  const auto* wheel = dynamic_cast<const WheelHub*>(&body.body());
  if (!wheel || !contact.needs_fine_cells()) return {};
  const Vector3 cell = contact.ground().shortest_cell();
  const WheelDetails details = details_of(*wheel);
  const double high = details.grouser_height, apart = details.grouser_spacing;
  if (high >= cells_of_a_grouser * cell.z() && apart >= cells_of_a_grouser * cell.x()) return {};
  return warning(fmt::format(
      "{} is {:.4g} m, and the grousers of '{}' are {:.3g} m high and {:.3g} m apart: the ground "
      "does not resolve them; write at most 'cell {:.2g}' ({:g} cells in height and spacing), or "
      "compare with a wheel without grousers",
      ground.where("cell"), ground.number("cell"), body.id, high, apart,
      std::min(high / cells_of_a_grouser * ground.number("cell") / cell.z(),
               apart / cells_of_a_grouser * ground.number("cell") / cell.x()),
      cells_of_a_grouser));
}

/// Blades, and grousers: ground reaches both sides of no other part.
CheckResult thin_parts_divide_the_ground(const Scene&, FixContactContinuum& contact) {
  const TerrainParameters& parameters = contact.terrain_fix().terrain().parameters();
  const FixBody& body = contact.body_fix();
  const auto* tool = dynamic_cast<const FixPlateRigid*>(&body);
  const auto* wheel = dynamic_cast<const WheelHub*>(&body.body());
  const bool pushes = tool != nullptr && std::abs(tool->direction().z()) < sideways;
  if (parameters.thin_parts || (!pushes && !wheel)) return {};
  const Matrix3X& x = body.body().surface().x;
  const auto divides = [&](const ThinPart& part) {
    if (pushes) return true;
    return std::any_of(part.facets.begin(), part.facets.end(), [&](const auto& facet) {
      const Vector3 a = x.col(facet.nodes[0]) - wheel->centre(),
                    b = x.col(facet.nodes[1]) - wheel->centre(),
                    c = x.col(facet.nodes[2]) - wheel->centre(),
                    normal = (b - a).cross(c - a).normalized();
      const auto radius = [&](const Vector3& arm) { return arm.cross(wheel->axle()).norm(); };
      const Vector3 radial = (a + b + c).cross(wheel->axle()).cross(wheel->axle()).normalized();
      return std::max({radius(a), radius(b), radius(c)}) > beyond_rim * wheel->nominal_radius() &&
             std::abs(normal.dot(radial)) < sideways;
    });
  };
  const auto parts = DividedGround::parts_of(body.body().surface(), parameters.x.cell);
  const auto count = std::count_if(parts.begin(), parts.end(), divides);
  if (count == 0) return {};
  return warning(fmt::format(
      "'{}' has {} thinner than {:g} cells: ground before and behind moves as one and pushes up to "
      "3 times too hard; write 'thin_parts yes' in the line of terrain '{}'",
      body.id, count == 1 ? "a part" : fmt::format("{} parts", count),
      DividedGround::largest_thickness, contact.terrain_fix().id));
}

/// Checked after a run in which the wheel has rolled.
CheckResult cells_show_the_sinkage(const Scene& scene, FixContactContinuum& contact) {
  const FixTerrain& terrain = contact.terrain_fix();
  const TerrainParameters& parameters = terrain.terrain().parameters();
  if (!is_wheel(contact.body_fix()) || !parameters.relief.flat()) return {};
  for (const DrivenBody& driven : driven_bodies(*scene.lammps.modify)) {
    if (&driven.body != &contact.body_fix() || scene.time() < driven.full_speed) continue;
    const double sinkage =
                     parameters.surface - contact.body_fix().body().surface().bounds().first.z(),
                 cell = contact.terrain_fix().terrain().grid().axis(2).shortest();
    if (sinkage <= 0.0 || sinkage >= cell) return {};
    return warning(fmt::format(
        "{} is {:.4g} m, and '{}' has sunk by {:.2g} m at the end: less than a cell, so "
        "that sinkage and resistance depend on the cells; write 'cell {:.2g}' or less",
        terrain.options().where("cell"), terrain.options().number("cell"), contact.body_fix().id,
        sinkage, 0.5 * sinkage * terrain.options().number("cell") / cell));
  }
  return {};
}

CheckResult travel_stays_on_terrain(const Scene& scene, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  const std::optional<double> travel = planned_travel(scene, pair.body);
  if (!travel || pair.terrain.moves()) return {};
  const double end = 0.5 * (pair.body_x.lower + pair.body_x.upper) + *travel,
               limit = pair.terrain_x.upper - near_end * pair.body_x.length();
  if (end <= limit || end - *travel > limit) return {};  // the body stops there during the run
  return warning(fmt::format(
      "this run brings the axle of '{}' to x = {:.4g} m, and near the end of terrain '{}' at x = "
      "{:.4g} m the end resists it; shorten the run by {:.3g} m of travel, lengthen the ground, or "
      "write 'follow {}'",
      pair.body.id, end, pair.terrain.id, pair.terrain_x.upper, end - limit, pair.body.id));
}

CheckResult travel_stays_on_the_field(const Scene& scene, FixFieldContact& contact) {
  const std::optional<double> travel = planned_travel(scene, contact.body_fix());
  if (!travel) return {};
  const auto [lower, upper] = contact.body_fix().body().surface().bounds();
  const double end = 0.5 * (lower.x() + upper.x()) + *travel,
               limit = contact.terrain_fix().field().upper().x();
  if (end <= limit) return {};
  return warning(fmt::format(
      "this run brings the axle of '{}' to x = {:.4g} m, beyond the end of the height "
      "field '{}' at x = {:.4g} m, where the run will stop; shorten the run by {:.3g} m of "
      "travel, or lengthen the field",
      contact.body_fix().id, end, contact.terrain_fix().id, limit, end - limit));
}

/// LIGGGHTS loses a mesh that leaves the box.
CheckResult travel_stays_in_the_box(const Scene& scene, const FixMeshBody& mesh) {
  const LAMMPS_NS::Domain& domain = *scene.lammps.domain;
  const LAMMPS_NS::Modify& modify = *scene.lammps.modify;
  if (domain.xperiodic || !in_a_wall(modify, mesh) || !fixes_of<const FixBedWindow>(modify).empty())
    return {};
  for (const auto* rig : fixes_of<const FixWheelRig>(modify)) {
    if (&rig->wheel_fix().body() != &mesh.body()) continue;
    const double end = mesh.body().surface().bounds().second.x() +
                       rig->rig().travel(scene.time(), scene.end()).value_or(0.0);
    if (end <= domain.boxhi[0]) return {};
    return warning(fmt::format(
        "this run brings the mesh '{}' to x = {:.4g} m, out of the simulation box, which ends at x "
        "= "
        "{:.4g} m, where the run will stop; shorten the run by {:.3g} m of travel, or make the box "
        "longer",
        mesh.id, end, domain.boxhi[0], end - domain.boxhi[0]));
  }
  return {};
}

/// In 0.3 radii more the resistance on dry sand grows by a tenth, at one radius 2 times.
CheckResult wheel_stays_off_the_end(const Scene&, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  if (!is_wheel(pair.body) || pair.terrain.moves()) return {};
  const double left = pair.terrain_x.upper - 0.5 * (pair.body_x.lower + pair.body_x.upper);
  if (left >= near_end * pair.body_x.length()) return {};
  return warning(
      fmt::format("{}: the axle of '{}' has come within {:.2g} diameters of the end of the ground "
                  "at x = {:.4g} m: the end resists it from here on; make the ground longer or the "
                  "run shorter",
                  contact.options().subject(), pair.body.id, near_end, pair.terrain_x.upper));
}

/// Compares lengths; a wheel may touch with less than its diameter.
CheckResult terrain_is_long_enough(const Scene&, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  const double body = pair.body_x.length(), ground = (1.0 + round_off) * pair.terrain_x.length();
  if (body <= ground) return {};
  const std::string where = pair.terrain.options().where("length"),
                    problem =
                        fmt::format("is {:.4g} m, and '{}', which presses on it, is {:.4g} m long",
                                    pair.terrain_x.length(), pair.body.id, body);
  if ((is_wheel(pair.body) ? 0.5 * body : body) > ground)
    return refusal(where, problem, "ground longer than the body", "make it longer");
  return warning(
      fmt::format("{} {}; its ends restrain the ground: make it longer", where, problem));
}

CheckResult terrain_has_the_size_of_a_wheels(const Scene&, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  if (!is_wheel(pair.body)) return {};
  const Options& options = pair.terrain.options();
  const double wheel = pair.body_x.length();
  const std::pair<const char*, double> sizes[] = {
      {"length", pair.terrain.moves() ? longest_window : longest_track},
      {"width", widest_terrain},
      {"depth", deepest_terrain}};
  for (const auto& [key, most] : sizes)
    if (options.has(key) && options.number(key) > most * wheel)
      return warning(fmt::format(
          "{} is {:g} m, {:.3g} times the length of '{}', {:.4g} m; ground that matters has at "
          "most {:g}; give m, not cm",
          options.where(key), options.number(key), options.number(key) / wheel, pair.body.id, wheel,
          most));
  return {};
}

/// Counts cells across a body, and in the radius of a wheel or along a plate.
CheckResult cells_show_the_body(const Scene&, FixGroundContact& contact) {
  if (!contact.needs_fine_cells()) return {};
  const FixBody& body = contact.body_fix();
  const Options& ground = contact.ground().line();
  const auto [lower, upper] = whole_bounds(body.body());
  const Vector3 cells = contact.ground().cells_across(lower, upper);
  double across = cells.y(), along = (is_wheel(body) ? 0.5 : 1.0) * cells.x();
  // A tool that moves sideways shows its height in place of its thickness.
  const auto* tool = dynamic_cast<const FixPlateRigid*>(&body);
  if (tool && std::abs(tool->direction().z()) < sideways && !std::isnan(cells.z()))
    (std::abs(tool->direction().x()) > std::abs(tool->direction().y()) ? along : across) =
        cells.z();
  const double fewest = std::min(across, along);
  if (fewest >= nearly * good_cells) return {};
  const std::string where = ground.where("cell"), remedy = contact.ground().finer_cells();
  const std::string problem =
      fmt::format("is {:.4g} m: {:.2g} cells across '{}' and {:.2g} {}", ground.number("cell"),
                  across, body.id, along, is_wheel(body) ? "in its radius" : "along it");
  if (fewest < nearly * min_cells)
    return refusal(where, problem, fmt::format("at least {:g} of both", min_cells), remedy);
  return warning(fmt::format("{} {} (recommended: at least {:g}): forces will be coarse; {}", where,
                             problem, good_cells, remedy));
}

CheckResult wheel_on_a_field_has_no_camber(const Scene& scene, FixContactScm& contact) {
  for (const DrivenBody& driven : driven_bodies(*scene.lammps.modify))
    if (&driven.body == &contact.body_fix() && driven.options.has("camber") &&
        driven.options.number("camber") != 0.0)
      return refusal(
          driven.options.where("camber"),
          fmt::format("is {:g} degrees, and '{}' stands on '{}': the soil contact model "
                      "does not compute the force on its lower side",
                      driven.options.number("camber"), driven.body.id, contact.terrain_fix().id),
          "0 degrees", "use terrain/continuum or grains for a wheel with camber");
  return {};
}

CheckResult sides_on_a_field_carry_little(const Scene&, FixContactScm& contact) {
  const auto* wheel = dynamic_cast<const WheelHub*>(&contact.body_fix().body());
  if (!wheel || wheel->half_model()) return {};
  const ScmContact::Step& step = contact.contact().step();
  if (std::abs(step.of_steep_faces.dot(wheel->axle())) <= small_side_force * step.force.z())
    return {};
  const std::string finding = fmt::format("{}: steep faces of '{}' lie in the soil",
                                          contact.options().subject(), contact.body_fix().id);
  return warning(fmt::format(
      "{}, and their force along the axle is more than {:g} of the vertical force; the soil "
      "contact model does not compute it, so lateral forces are wrong; remove camber, use a "
      "mesh with upright sides, or terrain/continuum",
      finding, small_side_force));
}

/// Resistive force theory adds the forces of all grousers, however close they are.
CheckResult sand_pulls_less_than_the_load(const Scene&, FixContactRft& contact) {
  const auto* wheel = dynamic_cast<const WheelHub*>(&contact.body_fix().body());
  if (!wheel) return {};
  const Vector3 along(wheel->velocity().x(), wheel->velocity().y(), 0.0);
  const Vector3& force = contact.contact().step().force;
  if (along.dot(force) <= largest_pull * along.norm() * force.z()) return {};
  return warning(fmt::format(
      "{}: the sand pulls '{}' with more than {:g} of the vertical force, which no sand does: "
      "resistive force theory does not compute that grousers shield one another; model a wheel "
      "with close grousers as a wheel of the radius of their tips without grousers",
      contact.options().subject(), contact.body_fix().id, largest_pull));
}

CheckResult card_reaches_the_sinkage(const Scene&, FixContactScm& contact) {
  const std::optional<SoilCard>& card = contact.terrain_fix().card();
  if (!card || contact.contact().step().sinkage <= card->deepest) return {};
  return warning(
      fmt::format("{}: '{}' sinks deeper than the plates of the soil card, {:.3g} m: the pressure "
                  "is extrapolated; use terrain/continuum, or parameters from deeper plates",
                  contact.options().subject(), contact.body_fix().id, card->deepest));
}

CheckResult card_reaches_the_pressure(const Scene&, FixContactScm& contact) {
  const std::optional<SoilCard>& card = contact.terrain_fix().card();
  if (!card || contact.contact().step().pressure <= card->largest_pressure) return {};
  return warning(
      fmt::format("{}: '{}' presses harder than the plates of the soil card, {:.3g} Pa: the "
                  "sinkage is extrapolated; use terrain/continuum, or parameters from plates under "
                  "higher pressure",
                  contact.options().subject(), contact.body_fix().id, card->largest_pressure));
}

/// A wheel may stand over an end of the ground, but not over its side.
CheckResult body_is_over_terrain(const Scene&, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  const double slack = round_off * pair.body_y.length();
  const auto over = [&](const Span& body, const Span& ground) {
    return body.lower < ground.lower - slack || body.upper > ground.upper + slack;
  };
  if (!over(pair.body_y, pair.terrain_y) &&
      (is_wheel(pair.body) || !over(pair.body_x, pair.terrain_x)))
    return {};
  return warning(
      fmt::format("'{}' extends beyond terrain '{}': it spans x = {:.4g} to {:.4g} m, "
                  "y = {:.4g} to {:.4g} m, the terrain {:.4g} to {:.4g} m, {:.4g} to {:.4g} m",
                  pair.body.id, pair.terrain.id, pair.body_x.lower, pair.body_x.upper,
                  pair.body_y.lower, pair.body_y.upper, pair.terrain_x.lower, pair.terrain_x.upper,
                  pair.terrain_y.lower, pair.terrain_y.upper));
}

CheckResult sidewalls_touch_the_terrain(const Scene&, FixContactContinuum& contact) {
  const FixBody& fix = contact.body_fix();
  const auto* tyre = dynamic_cast<const DarnellTyre*>(&fix.body());
  if (tyre == nullptr || tyre->settings().sidewall_rows > 0) return {};
  Finding open = warning(fmt::format(
      "{} is 0: only the tread of '{}' touches '{}', and ground that flows over its edges stops "
      "the run; write 1 to 50 (4 is usual)",
      fix.options().where("sidewall_rows"), fix.id, contact.terrain_fix().id));
  open.explains_errors = true;
  return open;
}

/// Ground enters a groove, or the gap between two bars, with particles that are narrower.
CheckResult cells_enter_grooves(const Scene&, FixContactContinuum& contact) {
  const Pair pair = describe(contact);
  const auto* tyre = dynamic_cast<const FixTyreBrick*>(&pair.body);
  if (tyre == nullptr) return {};
  const BrickTyreParameters& parameters = tyre->tyre().parameters();
  const double groove = parameters.tread.narrowest_void(parameters.radius());
  const double rib = parameters.tread.narrowest_rib(parameters.radius());
  const ContinuumTerrain& terrain = pair.terrain.terrain();
  const int count = terrain.parameters().particles_per_cell[1];
  const double spacing = terrain.grid().axis(1).shortest() / count;
  const double narrowest = std::min(groove, rib);
  if (spacing < narrowest) return {};
  return warning(fmt::format(
      "{} is {:.4g} m: particles are {:.3g} m apart under '{}', whose narrowest groove "
      "is {:.3g} m wide and its narrowest rib {:.3g} m: ground bridges the grooves, and "
      "the tread acts nearly as a smooth one; choose cells narrower than {:.3g} m, or a "
      "smooth tread",
      pair.terrain.options().where("cell"), pair.terrain.options().number("cell"), spacing,
      pair.body.id, groove, rib, count * narrowest));
}

CheckResult turning_plate_has_whole_terrain(const Scene&, FixContactContinuum& contact) {
  const auto* plate = dynamic_cast<const FixPlateRigid*>(&contact.body_fix());
  if (plate == nullptr || !plate->turns() || !contact.terrain_fix().half_model()) return {};
  return refusal(plate->options().where("spin"),
                 fmt::format("is {:g} rad/s, and half a terrain mirrors the torque away",
                             plate->options().number("spin")),
                 "0 on half a terrain", "write 'symmetry no' in the line of the terrain");
}

}  // namespace furrow::coupling
