// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/fix_terrain_continuum.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "comm.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/styles/find_fix.h"
#include "coupling/base/read_options.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/base/checks/high_friction.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "domain.h"
#include "furrow/io/inputs/terrain_input.h"
#include "furrow/mpm/ground/terrain_size.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr int good_cells_in_depth = 4;
constexpr int maximum_empty_cells = 20;  // above the surface, over those below
constexpr double many_particles = 1e6;
constexpr double seconds_of_particle = 5e-8;  // of one core for a step, measured
constexpr long check_every = 100;             // steps between checks of the energy
// [J/kg] of the terrain, its weight lifted by 0.1 mm: below it an imbalance does not matter
constexpr double energy_floor = 1e-3;
constexpr double edge_refinement = 3.0;  // of the cells along the sides of a body
constexpr double same_length = 1e-6;     // of a cell: ground and period of the box
const std::vector<std::string> followable = {"wheel", "body"};

/// Size of ground that follows one wheel, from the wheel's line and not its place, so that it is
/// the same when a run is continued.
std::optional<GroundSize> size_by_wheel(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  if (!options.given("follow") || options.given("follow_last")) return {};
  const auto* wheel = dynamic_cast<const WheelHub*>(
      &find_fix<FixBody>(lammps, options, "follow", followable).body());
  if (!wheel) return {};
  const double depth = options.number("depth");
  const bool carries_grains = options.flag("surface_mesh");
  GroundSize size = ground_under_wheel(wheel->nominal_radius(), wheel->nominal_width(), depth);
  if (!options.given("cell") && !carries_grains)
    choose_cell(size, details_of(*wheel), depth, options.flag("thin_parts"));
  const double cell = options.given("cell") ? options.number("cell") : size.cell;
  if (options.given("width") || carries_grains)
    size.fine_width = 0.0;  // the whole ground has fine cells
  else                      // whole cells on either side, as long as they were asked for
    size.fine_width = 2.0 * cell * std::ceil(0.5 * size.fine_width / cell * (1.0 - same_length));
  return size;
}

Schema schema_of_line(LAMMPS_NS::LAMMPS& lammps, int narg, char** arg) {
  const Options options = FixTerrainContinuum::schema().read(args_after_style(narg, arg));
  return FixTerrainContinuum::schema(size_by_wheel(lammps, options));
}

/// Short cells where the body of the keyword 'edges' ends: at both sides of a wheel, which travels
/// along x; all around and below another body. A body that is as wide as the ground has no side.
void refine_edges(LAMMPS_NS::LAMMPS& lammps, const Options& options,
                  TerrainParameters& parameters) {
  if (!options.given("edges")) {
    if (!options.given("edge_cell")) return;
    throw InputError(options.where("edge_cell"), "is given without 'edges'",
                     "the length of cells along the sides of a body", "name the body by 'edges'");
  }
  const double cell = options.number("cell");
  const double shortest =
      options.given("edge_cell") ? options.number("edge_cell") : cell / edge_refinement;
  if (shortest > cell)
    throw InputError(options.where("edge_cell"), fmt::format("is {} m", shortest),
                     fmt::format("a length up to 'cell', {} m", cell));
  const Body& body = find_fix<FixBody>(lammps, options, "edges", followable).body();
  const auto [lower, upper] = body.surface().bounds();
  const auto refine = [&](AxisLayout& axis, std::vector<double> edges) {
    for (const double edge : edges)
      if (edge > axis.lower + same_length * cell && edge < axis.upper - same_length * cell)
        axis.edges.push_back(edge);
    axis.edge_cell = shortest;
  };
  refine(parameters.y, {lower.y(), upper.y()});
  if (dynamic_cast<const WheelHub*>(&body)) return;
  refine(parameters.x, {lower.x(), upper.x()});
  refine(parameters.z, {std::min(lower.z(), parameters.surface), parameters.surface});
}

/// x of the middle of bodies [m].
double middle_of(const std::vector<const Body*>& bodies) {
  double middle = 0.0;
  for (const Body* body : bodies) middle += body->surface().x.row(0).mean();
  return middle / static_cast<double>(bodies.size());
}

std::unique_ptr<Body> make_terrain(LAMMPS_NS::LAMMPS& lammps, const Options& options) {
  TerrainParameters parameters = read_terrain(options, script_folder(lammps));
  refine_edges(lammps, options, parameters);
  parameters.window = options.given("follow");
  if (parameters.window && options.given("fine_length") && parameters.x.edges.empty()) {
    const FollowingAxis axis = following_axis(parameters.x, options.where("fine_length"));
    parameters.x = axis.layout;
    parameters.halvings = axis.halvings;
  }
  for (const TerrainLayer& layer : parameters.layers)
    for (const std::string& warning : layer.warnings) warn(lammps, warning);
  for (const std::string& warning : parameters.relief.warnings(
           options.number("length"), options.number("cell"), options.given("follow")))
    warn(lammps, fmt::format("{}: {}", options.subject(), warning));
  if (const std::string note = parameters.relief.note(); !note.empty())
    warn(lammps, fmt::format("{}: {}", options.where("heightmap"), note));
  if (const double particles = size_of(parameters).particles; particles > many_particles) {
    if (!options.given("cell"))
      throw InputError(
          options.where("cell"),
          fmt::format("is missing, and cells of {} m by {} make about {:.2g} particles",
                      options.number("cell"), size_by_wheel(lammps, options)->cell_by, particles),
          "a number > 0 [m]",
          fmt::format("write 'cell {}' to compute that many, or longer cells",
                      options.number("cell")));
    warn(lammps,
         fmt::format("{} has about {:.2g} particles: a step takes about {:.1g} s on one core; if "
                     "length {:.4g} m, width {:.4g} m or depth {:.4g} m is in another unit, give m",
                     options.subject(), particles, seconds_of_particle * particles,
                     options.number("length"), options.number("width"), options.number("depth")));
  }
  if (options.given("slabs")) parameters.slabs = static_cast<std::size_t>(options.integer("slabs"));
  return std::make_unique<ContinuumTerrain>(parameters, Communicator(&lammps.world),
                                            options.subject());
}

}  // namespace

const StyleRow terrain_continuum_style = fix_style<FixTerrainContinuum>(
    "terrain/continuum", "terrain", "terrain/fix_terrain_continuum.md");

Schema FixTerrainContinuum::schema(const std::optional<GroundSize>& size) {
  Schema schema = terrain_schema("fix terrain/continuum", size);
  schema.text("follow", "id of the fix of the body that the terrain follows").optional();
  schema
      .text("follow_last",
            "last body of a convoy; the terrain follows the midpoint between it and `follow`")
      .optional();
  schema.text("edges", "id of the fix of a body; cells are short along its sides").optional();
  schema
      .number("edge_cell", "m", Range::positive(),
              "length of these cells across the side; by default a third of `cell`")
      .optional();
  schema
      .integer("slabs", Range::at_least(4),
               "slabs by which a terrain with a surface mesh moves, with `follow`")
      .optional();
  schema
      .number("energy_tolerance", "", Range{0.0, 1.0, true, false},
              "allowed error of the energy balance, relative to the largest work")
      .by_default(0.05)
      .may_change();
  return schema;
}

FixTerrainContinuum::FixTerrainContinuum(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixTerrain(lammps, narg, arg, schema_of_line(*lammps, narg, arg),
                 [lammps](const Options& options) { return make_terrain(*lammps, options); }) {
  if (options().given("follow_last") && !options().given("follow"))
    throw InputError(options().where("follow_last"), "is given without 'follow'",
                     "the other end of a row that 'follow' names the first of",
                     "for one body write 'follow' alone");
  for (const char* key : {"follow", "follow_last"})
    if (options().given(key)) followed_.push_back(&use<FixBody>(key, followable).body());
  if (options().given("slabs")) check_slabs();
  if (options().given("follow_last") && options().text("follow_last") == options().text("follow"))
    throw InputError(
        options().where("follow_last"),
        fmt::format("is '{}', which 'follow' names already", options().text("follow_last")),
        "the last body of a row whose first one 'follow' names",
        "name the other body, or remove 'follow_last'");
  refuse_overlap();
  contribute(static_cast<MotionController&>(*this));
  provide(outputs(), [this] { return TerrainReading(terrain()); });
  nevery = 1;
  report();
}

/// Ground that goes round with the grains that it carries, in a box that closes on itself.
void FixTerrainContinuum::check_slabs() const {
  const std::string where = options().where("slabs");
  const bool follows = options().given("follow");
  if (!follows || !options().flag("surface_mesh"))
    throw InputError(where,
                     fmt::format("is given without '{}'", follows ? "surface_mesh yes" : "follow"),
                     "slabs of ground that follows a body and carries grains",
                     "other ground that follows a body moves on cell by cell");
  if (options().given("follow_last"))
    throw InputError(
        where, "is given with 'follow_last'", "slabs of ground that follows one body",
        "remove 'follow_last': the bed behind the last of several bodies is renewed by "
        "bed/window");
  const double length = options().number("length"), period = domain->prd[0];
  if (!domain->xperiodic ||
      std::abs(length - period) > same_length * terrain().grid().axis(0).shortest())
    throw InputError(
        where,
        fmt::format("is given for ground {:.6g} m long in a box {}", length,
                    domain->xperiodic ? fmt::format("whose period is {:.6g} m", period)
                                      : "that is not periodic along x"),
        "ground as long as the period of the box",
        "use a bed that closes on itself, inputs/beds/sand_window.lig, and its length");
}

/// Two of them side by side, or one on top of the other, share a face.
void FixTerrainContinuum::refuse_overlap() {
  require_unique<FixTerrainContinuum>(*modify, options().subject(), "fills space with terrain",
                                      "terrains that do not overlap; layers of one terrain are in "
                                      "its keyword 'material'",
                                      [&](const auto& other) { return overlap(*this, other); });
}

bool FixTerrainContinuum::follows(const Body& body) const {
  return std::find(followed_.begin(), followed_.end(), &body) != followed_.end();
}

int FixTerrainContinuum::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP; }

void FixTerrainContinuum::report() {
  const Grid& grid = terrain().grid();
  const double particles = terrain().particle_count(), step = terrain().stable_time_step();
  const Partition& partition = terrain().partition();
  const std::string blocks =
      comm->nprocs == 1 ? ""
                        : fmt::format("; {} x {} blocks of cells on {} ranks", partition.blocks(0),
                                      partition.blocks(1), comm->nprocs);
  if (comm->me == 0 && screen)
    fmt::print(screen,
               "Continuum terrain: {:.4g} m long{}, {:.4g} m wide{}, {} x {} x {} cells, shortest "
               "{:.4g} m, {:.0f} particles; stable step {:.3g} s{}\n",
               grid.axis(0).upper() - grid.axis(0).lower(),
               options().given("length") ? "" : " by the wheel's radius and the depth",
               options().number("width"),
               options().given("width") ? "" : " by the wheel's width and the depth",
               grid.axis(0).cells(), grid.axis(1).cells(), grid.axis(2).cells(),
               grid.shortest_cell(), particles, step, blocks);
  if (comm->me == 0 && screen && !options().given("cell")) {
    const GroundKind kind = ground_kind(*terrain().parameters().layers.front().material);
    const std::optional<CellError> error = cell_error(kind);
    fmt::print(screen, "Cells of {} m by {}; their error for a driven smooth wheel on {}{}\n",
               options().number("cell"), size_by_wheel(*lmp, options())->cell_by, name_of(kind),
               error ? fmt::format(": hub drop {:.2g} %, pull {:.2g} of the load "
                                   "(inputs/guide/howto/cell_and_grain_size.md)",
                                   100.0 * error->hub_drop, error->pull)
                     : " is not known");
  }
  warn_of_extremes();
  const double scale = options().number("modulus_scale");
  if (scale != 1.0)
    warn(*lmp, fmt::format("{}: Young's modulus is scaled by {:g}: steps are {:.2g} times longer, "
                           "elastic strains {:.2g} times larger",
                           name(), scale, 1.0 / std::sqrt(scale), 1.0 / scale));
}

void FixTerrainContinuum::warn_of_extremes() {
  if (options().given("slide_friction") && is_high_friction(options().number("slide_friction")))
    warn(*lmp,
         high_friction(options().where("slide_friction"), options().number("slide_friction")));
  const Axis& z = terrain().grid().axis(2);
  const double surface = options().number("surface");
  int below = 0;
  while (below < z.cells() && z.knot(below) + 0.5 * z.length(below) < surface) ++below;
  const int above = z.cells() - below;
  if (below < good_cells_in_depth)
    warn(*lmp, fmt::format("{} is {:.4g} m: {} cells in the depth (recommended: at least {}); the "
                           "ground will be stiff and coarse; choose smaller cells",
                           options().where("cell"), options().number("cell"), below,
                           good_cells_in_depth));
  if (options().text("base") == "free" && options().number("gravity") > 0.0)
    warn(*lmp,
         fmt::format("{} is free: nothing supports the terrain, and it falls out of its grid; "
                     "write 'base rough' or 'smooth', or 'gravity 0'",
                     options().where("base")));
  for (const char* sides : {"ends", "sides"})
    if (options().text(sides) == "free" && options().number("gravity") > 0.0)
      warn(*lmp,
           fmt::format("{} is free: nothing holds the terrain there, and its weight pushes it "
                       "out; write '{} smooth' or 'rough', or 'gravity 0'",
                       options().where(sides), sides));
  for (const auto& [part, whole] :
       {std::pair("fine_length", "length"), std::pair("fine_width", "width"),
        std::pair("fine_depth", "depth")})
    if (options().has(part) && options().has(whole) &&
        options().number(part) > options().number(whole) &&
        !(options().given("follow") && part == std::string("fine_length")))
      warn(*lmp, fmt::format("{} is {:g} m, and '{}' {:g} m: all cells are as fine as 'cell'; "
                             "remove it, or give m, not cm",
                             options().where(part), options().number(part), whole,
                             options().number(whole)));
  if (options().given("follow") && options().given("fine_length") &&
      terrain().grid().axis(0).uniform())
    warn(*lmp,
         fmt::format("{} is {:g} m: 'length', {:.4g} m, has no room for longer cells outside "
                     "of it, and all cells are as fine as 'cell'; make it shorter, or remove it",
                     options().where("fine_length"), options().number("fine_length"),
                     options().number("length")));
  const Axis& x = terrain().grid().axis(0);
  if (!followed_.empty() && !x.uniform() &&
      middle_of(followed_) < 0.5 * (x.lower() + x.upper()) - x.length(0))
    warn(*lmp,
         fmt::format("{}: the body starts {:.3g} m behind the middle of the fine cells, which "
                     "do not move back; put 'centre' below the body",
                     options().where("follow"),
                     0.5 * (x.lower() + x.upper()) - middle_of(followed_)));
  if (options().number("surcharge") > 0.0 && !options().flag("surface_mesh"))
    warn(*lmp, fmt::format("{} is given without 'surface_mesh yes': no grains can lie on the "
                           "terrain, whose stress starts as if they did; remove it",
                           options().where("surcharge")));
  if (above > maximum_empty_cells * below)
    warn(*lmp, fmt::format("{}: {} layers of cells reach {:.4g} m above the surface, {} lie below: "
                           "they stay empty and cost time; make clearance_above smaller",
                           name(), above, z.upper() - surface, below));
}

void FixTerrainContinuum::apply(double, double) {
  if (followed_.empty()) return;
  const double middle = middle_of(followed_);
  if (options().given("slabs"))
    refuse_to_be_left(middle);
  else
    terrain().follow(middle);
}

/// Refuses a body that leaves ground with slabs, which moves on only with the grains of a
/// bed/window.
void FixTerrainContinuum::refuse_to_be_left(double middle) const {
  const Axis& x = terrain().grid().axis(0);
  const double slab = (x.upper() - x.lower()) / static_cast<double>(options().integer("slabs"));
  if (middle <= x.upper() - slab) return;
  throw StateError(
      fmt::format("the body that the terrain follows is at {:.4g} m, and the terrain, which ends "
                  "at {:.4g} m, does not follow it: write a line bed/window with 'terrain {}'",
                  middle, x.upper(), id));
}

void FixTerrainContinuum::end_of_step() {
  if (update->ntimestep % check_every == 0) collectively([&] { check_energy(); });
}

void FixTerrainContinuum::check_energy() {
  const EnergyBudget budget = terrain().energy_budget();
  double mass = 0.0;
  for (const ParticleGroup& layer : terrain().unsynchronised_groups())
    for (std::size_t p = 0; p < layer.particles.size(); ++p)
      mass += layer.material->density() * layer.particles.data(column::volume)[p];
  mass = terrain().ranks().sum(mass);
  const double scale = std::max({std::abs(budget.contact_work), std::abs(budget.load_work),
                                 std::abs(budget.dissipated_energy),
                                 std::abs(budget.kinetic_energy), energy_floor * mass});
  const double limit = options().number("energy_tolerance") * scale;
  const double residual = budget.residual();
  if (!(std::abs(residual) <= limit) || !(budget.numerical_loss >= -limit))
    throw StateError(fmt::format(
        "{}: the energy of the terrain does not balance at step {}: the error is {:.4g} J, the "
        "discretisation dissipated {:.4g} J (negative: created); allowed is {:.4g} J; "
        "the step is unstable or the load too sudden: lower 'cfl' or the LIGGGHTS step",
        name(), update->ntimestep, residual, budget.numerical_loss, limit));
}

}  // namespace furrow::coupling
