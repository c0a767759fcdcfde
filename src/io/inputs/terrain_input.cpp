// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/terrain_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/gravity.h"
#include "furrow/io/formats/heightmap_file.h"
#include "furrow/io/inputs/material_file.h"
#include "furrow/io/inputs/patch_input.h"
#include "furrow/io/inputs/slide_input.h"
#include "furrow/material/plausibility.h"

namespace furrow {

namespace {

// Default of clearance_above: room for what a wheel pushes up next to it and ahead.
constexpr double min_clearance_cells = 6.0;
constexpr double clearance_of_depth = 1.0;
constexpr double min_cells_in_depth = 2.0;
constexpr double round_off = 1e-6;  // of a length
constexpr double max_blocks = 1e6;
constexpr double minimum_triangles_across = 4.0;  // of a surface mesh that shows a rut

std::vector<std::string> split_list(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

/// Multiplies Young's modulus: longer steps for softer terrain.
void scale_modulus(MaterialFile& file, double factor, const std::string& where) {
  for (Entry& entry : file.sections["elasticity"])
    if (entry.key == "E") {
      entry.values[0] = fmt::format("{:.17g}", factor * std::stod(entry.values[0]));
      file.options = read_sections(file.model, file.sections);
      return;
    }
  throw InputError(where, fmt::format("is {}, and {} has no Young's modulus E", factor, file.path),
                   "1 for a material without E");
}

/// The law and every key that has a value, section by section.
std::vector<Entry> describe(const MaterialFile& file) {
  std::vector<Entry> description = {{"law", {file.model.name}}};
  for (const auto& [section, values] : file.options) {
    description.push_back({section, {values.type}});
    for (Entry entry : values.options.effective()) {
      entry.key = section + '.' + entry.key;
      description.push_back(std::move(entry));
    }
  }
  return description;
}

TerrainLayer load(const Options& options, const std::filesystem::path& path, double thickness) {
  MaterialFile file = read_material_file(path.string());
  const double factor = options.number("modulus_scale");
  if (factor != 1.0) scale_modulus(file, factor, options.where("modulus_scale"));
  std::unique_ptr<Material> material = file.make();
  check_plausible(*material);  // with the modulus as scaled
  const long interval = options.integer("transfer_interval");
  if (material->stress_has_jumps() && interval > 1)
    file.warnings.push_back(
        fmt::format("{} is {}, and the stress of the law {} jumps in waves, which only a transfer "
                    "in every step damps; write 'transfer_interval 1'",
                    options.where("transfer_interval"), interval, material->name()));
  return {std::move(material), thickness, describe(file), file.warnings, file.title, file.contact};
}

/// @param all_have_one the lowest as well, which could do without
void check_thicknesses(const std::vector<TerrainLayer>& layers, bool all_have_one,
                       const Options& options) {
  const double depth = options.number("depth");
  double sum = 0.0;
  for (std::size_t n = 0; n + (all_have_one ? 0 : 1) < layers.size(); ++n)
    sum += layers[n].thickness;
  const bool fits = all_have_one ? std::abs(sum - depth) <= round_off * depth : sum < depth;
  if (!fits)
    throw InputError(options.where("material"),
                     fmt::format("has layers of {:.6g} m in ground {:.6g} m deep", sum, depth),
                     all_have_one ? "layers that add up to the depth"
                                  : "layers above the lowest that leave room for it",
                     "change 'depth' or a thickness; the lowest layer needs none");
}

/// Reads layers "crust.yaml:0.03,snow.yaml" from the top, each but the last with its thickness.
/// @param key  that has them
std::vector<TerrainLayer> read_layers(const Options& options, const std::string& key,
                                      const std::string& text,
                                      const std::filesystem::path& folder) {
  std::vector<TerrainLayer> layers;
  const std::string where = options.where(key);
  const std::vector<std::string> parts = split_list(text, ',');
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const std::vector<std::string> words = split_list(parts[n], ':');
    const bool last = n + 1 == parts.size();
    double thickness = options.number("depth");
    if (words.size() == 2) {
      const auto [end, failed] =
          std::from_chars(words[1].data(), words[1].data() + words[1].size(), thickness);
      if (failed != std::errc() || end != words[1].data() + words[1].size() || !(thickness > 0.0))
        throw InputError(
            where, fmt::format("has the layer '{}', whose thickness is no number > 0", parts[n]),
            "file:thickness in metres");
    }
    if (words.size() > 2 || words[0].empty() || (words.size() == 1 && !last))
      throw InputError(where, fmt::format("has the layer '{}'", parts[n]),
                       "file:thickness,file:thickness,...,file from the top down",
                       "only the lowest layer needs no thickness");
    layers.push_back(load(options, folder / words[0], thickness));
  }
  const bool all_have_one = parts.back().find(':') != std::string::npos;
  check_thicknesses(layers, all_have_one, options);
  return layers;
}

/// Appends the layers of the patches. @throws InputError for a patch beyond the ground, and for
/// options that need uniform ground
void read_patches_of(const Options& options, const std::string& folder, TerrainParameters& ground) {
  const PatchesInput patches = read_patches(options);
  if (patches.list.empty()) return;
  const std::string where = options.where("patches");
  ground.patch_axis = patches.axis;
  const AxisLayout& axis = patches.axis == 0 ? ground.x : ground.y;
  for (const PatchInput& patch : patches.list) {
    if ((patches.axis == 1 || !options.given("follow")) &&
        !(patch.begin > axis.lower && patch.begin < axis.upper))
      throw InputError(where, fmt::format("begins a patch at {:g} m", patch.begin),
                       fmt::format("a place on the ground, {:g} to {:g} m", axis.lower, axis.upper),
                       options.flag("symmetry") ? "a half model has patches along only" : "");
    ground.patches.push_back({patch.begin, ground.layers.size()});
    for (TerrainLayer& layer : read_layers(options, "patches", patch.soil, folder))
      ground.layers.push_back(std::move(layer));
  }
  if (options.flag("symmetry") && patches.axis == 1)
    throw InputError(where, "has patches across a half model", "patches along x",
                     "both halves of a half model have the same soil");
  for (const char* key : {"surface_mesh", "trough"})
    if (key == std::string("trough") ? options.given(key) : options.flag(key))
      throw InputError(where, fmt::format("is given with '{}'", key), "ground without grains");
  for (const char* key : {"ends", "sides", "base"})
    if (options.text(key) == "absorbing")
      throw InputError(where, fmt::format("is given with '{} absorbing'", key),
                       "boundaries that do not depend on the soil", "write smooth or rough");
}

/// Fine stretches of less than a cell would make cells smaller than `cell`; what is shorter than a
/// cell would make a cell of another size.
void check_cells(const Options& options) {
  const double cell = options.number("cell"), enough = (1.0 - round_off) * cell;
  for (const char* key : {"length", "width", "depth", "fine_length", "fine_width", "fine_depth"}) {
    if (!options.has(key)) continue;
    const bool halved =
        options.flag("symmetry") && std::string(key).find("width") != std::string::npos;
    if ((halved ? 0.5 : 1.0) * options.number(key) < enough)
      throw InputError(options.where(key),
                       fmt::format("is {} m, less than a cell of {} m{}", options.number(key), cell,
                                   halved ? " on either side of the plane of symmetry" : ""),
                       "at least one cell", "make it longer, or 'cell' smaller");
  }
}

/// Checks that the depth has enough cells, by the cells of the finished axis.
void check_depth(const TerrainParameters& ground, const Options& options) {
  AxisLayout below = ground.z;
  below.upper = below.fine_upper = ground.surface;
  const double cells = Axis::cell_count(below);
  if (cells < min_cells_in_depth - round_off)
    throw InputError(options.where("cell"),
                     fmt::format("is {} m, and the depth is {} m: {:.3g} cell(s)",
                                 options.number("cell"), options.number("depth"), cells),
                     fmt::format("at least {:g} cells in the depth", min_cells_in_depth),
                     "choose smaller cells");
}

std::optional<BlockLayout> read_blocks(const Options& options) {
  if (!options.given("blocks")) return {};
  const std::vector<double>& numbers = options.numbers("blocks");
  for (const double number : numbers)
    if (number != std::floor(number))
      throw InputError(options.where("blocks"), fmt::format("has the number {}", number),
                       "two whole numbers: of blocks along x and along y");
  return BlockLayout{static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

/// @throws InputError for one that no grains can fill
std::optional<Trough> read_trough(const Options& options) {
  if (!options.given("trough")) return {};
  const std::string where = options.where("trough");
  if (!options.flag("surface_mesh"))
    throw InputError(where, "is given without 'surface_mesh yes'",
                     "a trough in a terrain that carries grains",
                     "without a surface mesh nothing supports the faces of the trough");
  if (options.flag("symmetry"))
    throw InputError(where, "is given with 'symmetry yes'", "whole ground",
                     "grains have no plane of symmetry");
  return Trough{options.numbers("trough")[0], options.numbers("trough")[1]};
}

/// Particles from node to node of the surface mesh. @throws InputError for a mesh of a few
/// triangles
std::size_t read_surface_mesh_every(const Options& options, const TerrainParameters& ground) {
  const auto every = static_cast<double>(options.integer("surface_mesh_every"));
  const std::string where = options.where("surface_mesh_every");
  if (options.given("surface_mesh_every") && !ground.surface_mesh)
    throw InputError(where, "is given without 'surface_mesh yes'",
                     "nodes of triangles that carry grains",
                     "remove it, or write 'surface_mesh yes'");
  const double across = std::min(Axis::cell_count(ground.x) * ground.particles_per_cell[0],
                                 Axis::cell_count(ground.y) * ground.particles_per_cell[1]);
  const double most = std::max(1.0, std::floor(across / minimum_triangles_across));
  if (ground.surface_mesh && every > most)
    throw InputError(
        where,
        fmt::format("is {:g}, and the terrain has {:.4g} particles from edge to edge", every,
                    across),
        fmt::format("1 to {:g}: at least {:g} triangles across", most, minimum_triangles_across));
  return static_cast<std::size_t>(every);
}

double residual_share(const Options& options, const std::vector<TerrainLayer>& layers) {
  if (options.given("residual_share")) return options.number("residual_share");
  const bool jumps = std::any_of(layers.begin(), layers.end(), [](const TerrainLayer& layer) {
    return layer.material->stress_has_jumps();
  });
  return jumps ? 0.0 : TransferScheme().residual_share;
}

AxisLayout layout(const Options& options, double lower, double upper, double middle,
                  const std::string& fine_key) {
  AxisLayout axis{lower, upper, options.number("cell"), lower, upper, options.number("growth")};
  if (!options.has(fine_key)) return axis;
  axis.fine_lower = std::max(lower, middle - 0.5 * options.number(fine_key));
  axis.fine_upper = std::min(upper, middle + 0.5 * options.number(fine_key));
  return axis;
}

/// Layout of the z axis: the surface lies between two cells, and so does the top.
AxisLayout vertical_layout(const Options& options) {
  const double surface = options.number("surface"), depth = options.number("depth"),
               cell = options.number("cell");
  const double fine =
      options.has("fine_depth") ? std::min(depth, options.number("fine_depth")) : depth;
  const double own_cell = fine / std::max(1.0, std::round(fine / cell));
  const double clearance = options.given("clearance_above")
                               ? options.number("clearance_above")
                               : std::max(min_clearance_cells * cell, clearance_of_depth * depth);
  const double top = surface + own_cell * std::ceil(clearance / own_cell - 1e-9);
  return {surface - depth, top, own_cell, surface - fine, top, options.number("growth")};
}

}  // namespace

Schema terrain_schema(const std::string& subject, const std::optional<GroundSize>& size) {
  Schema schema(subject);
  schema
      .text("material",
            "material file, or layers from the top down, `file:thickness,...,file`; paths relative "
            "to the script")
      .may_change();  // of place and name: checkpoints compare what is in it
  declare_patches(schema, "material");
  schema
      .number("length", "m", Range::positive(),
              "length along x; by default from the wheel's radius and the depth, with `follow`")
      .optional();
  if (size) schema.by_default(size->length);
  schema
      .number("width", "m", Range::positive(),
              "width along y, of both halves of a half model; by default from the wheel's width "
              "and the depth, with `follow`")
      .optional();
  if (size) schema.by_default(size->width);
  schema.number("depth", "m", Range::positive(), "depth of the terrain");
  schema
      .number("cell", "m", Range::positive(),
              "edge of the cells in the fine part; by default from the wheel and the depth, with "
              "`follow`")
      .optional();
  if (size && size->cell > 0.0) schema.by_default(size->cell);
  schema.numbers("centre", 2, "m", Range::any(), "x y of the middle")
      .by_default(std::vector<double>{0.0, 0.0});
  schema.number("surface", "m", Range::any(), "z of the undisturbed surface").by_default(0.0);
  declare_relief(schema);
  schema
      .number("clearance_above", "m", Range::positive(),
              "height of the grid above the surface; by default six cells or the depth, whichever "
              "is larger")
      .optional();
  schema
      .number("fine_length", "m", Range::positive(),
              "length along x, around the middle or the body of `follow`, with cells of size "
              "`cell`; by default all")
      .optional();
  schema
      .number("fine_width", "m", Range::positive(),
              "width along y, around the middle, with cells of size `cell`; by default all, or "
              "from the wheel's width and the depth if `width` is")
      .optional();
  if (size && size->fine_width > 0.0) schema.by_default(size->fine_width);
  schema
      .number("fine_depth", "m", Range::positive(),
              "depth below the surface with cells of size `cell`; by default all, or from the "
              "wheel's width if `cell` is")
      .optional();
  if (size && size->fine_depth > 0.0) schema.by_default(size->fine_depth);
  schema
      .number("growth", "", Range::closed(1.0, 1.5),
              "size ratio of neighbouring cells outside the fine part")
      .by_default(1.15);
  schema.integer("particles", Range::closed(1, 8), "particles per cell in each direction")
      .by_default("2");
  schema.flag("symmetry", "`yes`: only the half y > centre is computed, mirrored at its plane");
  schema.choice("ends", boundary_kind_names(), "boundary condition at both ends, across x")
      .by_default("smooth");
  schema.choice("sides", boundary_kind_names(), "boundary condition at both sides, across y")
      .by_default("smooth");
  schema.choice("base", boundary_kind_names(), "boundary condition at the base")
      .by_default("rough");
  schema
      .number("gravity", "m/s^2", Range::closed(0.0, admissible_gravity().upper),
              "acceleration of gravity, downwards")
      .by_default(standard_gravity);
  schema.flag("initial_stress", "start with the stress of the terrain's weight").by_default("yes");
  schema
      .number("surcharge", "Pa", Range::at_least(0.0),
              "weight of the grains on the surface, or in the trough, in the initial stress")
      .by_default(0.0);
  declare_slide_surface(schema);
  schema.flag("surface_mesh", "`yes`: the upper face carries a mesh, on which grains can lie");
  schema
      .integer("surface_mesh_every", Range::at_least(1),
               "particles per node of the surface mesh, along x and y")
      .by_default("1");
  schema
      .numbers("trough", 2, "m", Range::positive(),
               "width along y and depth of a channel along x for the grains")
      .optional();
  schema.flag("multirate", "one terrain step for as many grain steps as its stable step allows");
  schema
      .number("cfl", "", Range::closed(0.01, 1.0),
              "time step over the time in which a wave crosses the shortest cell")
      .by_default(0.4)
      .may_change();
  schema
      .integer("transfer_interval", Range::closed(1, 64),
               "largest number of steps between two transfers of the motion from grid to particles")
      .by_default("16");
  schema
      .flag("cell_average",
            "the particles of a cell share their volume change and their pressure: no "
            "volumetric locking")
      .by_default("yes");
  schema
      .number("residual_share", "", Range::closed(0.0, 1.0),
              "share of the velocity that the grid cannot show, which particles keep while a wave "
              "crosses 6.4 cells; by default 0.95, or 0 for a law whose stress jumps")
      .optional();
  schema
      .number("modulus_scale", "", Range::closed(0.01, 1.0),
              "factor on Young's modulus, for longer steps")
      .by_default(1.0);
  schema
      .number("sleep_tolerance", "", Range{0.0, 0.1, true, false},
              "leaves out ground at rest: allowed neglected force over the force of the contacts, "
              "and energy over their work; without: all is computed")
      .optional();
  schema
      .flag(
          "thin_parts",
          "ground before and behind blades, grousers and other parts thinner than 2.5 cells moves "
          "apart")
      .by_default("no");
  schema
      .numbers("blocks", 2, "", Range::closed(1.0, max_blocks),
               "blocks along x and along y that the ranks share; by default chosen by Furrow")
      .optional()
      .may_change();
  schema.alias("headroom", "clearance_above");
  schema.alias("weightless_start", "initial_stress", inverted_flag);
  schema.alias("cycle", "transfer_interval");
  schema.alias("remap_interval", "transfer_interval");
  schema.alias("sheet", "surface_mesh");
  schema.alias("sheet_every", "surface_mesh_every");
  schema.alias("soften", "modulus_scale");
  return schema;
}

TerrainParameters read_terrain(const Options& options, const std::string& folder) {
  for (const char* key : {"length", "width", "cell"})
    if (!options.has(key))
      throw InputError(options.where(key), "is missing", "a number > 0 [m]",
                       "only ground that follows one wheel can do without");
  TerrainParameters ground;
  check_cells(options);
  ground.layers = read_layers(options, "material", options.text("material"), folder);
  ground.surface = options.number("surface");
  ground.relief = read_relief(options, folder);
  const double x = options.numbers("centre")[0], y = options.numbers("centre")[1];
  const double half_length = 0.5 * options.number("length"),
               half_width = 0.5 * options.number("width");
  const bool half_model = options.flag("symmetry");
  ground.relief.check_map({x - half_length, half_model ? y : y - half_width},
                          {x + half_length, y + half_width});
  ground.x = layout(options, x - half_length, x + half_length, x, "fine_length");
  ground.y = layout(options, half_model ? y : y - half_width, y + half_width, y, "fine_width");
  ground.z = vertical_layout(options);
  read_patches_of(options, folder, ground);
  check_depth(ground, options);
  const BoundaryKind ends = boundary_kind(options.text("ends")),
                     sides = boundary_kind(options.text("sides")),
                     base = boundary_kind(options.text("base"));
  ground.boundary = {ends,  ends, half_model ? BoundaryKind::smooth : sides,
                     sides, base, BoundaryKind::free};
  const int particles = static_cast<int>(options.integer("particles"));
  ground.particles_per_cell = {particles, particles, particles};
  ground.gravity = {0.0, 0.0, -options.number("gravity")};
  ground.initial_stress = options.flag("initial_stress");
  ground.slide = read_slide_surface(options);
  ground.surcharge = options.number("surcharge");
  if (ground.surcharge > 0.0 && !ground.initial_stress)
    throw InputError(options.where("surcharge"), "is given with 'initial_stress no'",
                     "a surcharge of ground that starts with the stress of what it carries",
                     "remove one of the two");
  ground.surface_mesh = options.flag("surface_mesh");
  ground.surface_mesh_every = read_surface_mesh_every(options, ground);
  if (!ground.relief.flat() && ground.surface_mesh)
    throw InputError(options.where("surface_mesh"), "is given for ground that is not flat",
                     "flat ground below grains",
                     "remove the keywords of the relief, or 'surface_mesh'");
  ground.trough = read_trough(options);
  ground.multirate = options.flag("multirate");
  if (ground.multirate && !ground.surface_mesh)
    throw InputError(options.where("multirate"), "is given without 'surface_mesh yes'",
                     "'multirate yes' for ground that carries grains",
                     "ground without grains takes its own step anyway");
  ground.cfl = options.number("cfl");
  ground.remap_interval = static_cast<int>(options.integer("transfer_interval"));
  ground.scheme.cell_average = options.flag("cell_average");
  ground.scheme.residual_share = residual_share(options, ground.layers);
  if (options.given("sleep_tolerance")) ground.sleep_tolerance = options.number("sleep_tolerance");
  ground.thin_parts = options.flag("thin_parts");
  ground.blocks = read_blocks(options);
  return ground;
}

}  // namespace furrow
