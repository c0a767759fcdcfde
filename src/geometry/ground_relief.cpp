// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/ground_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/checksum.h"
#include "furrow/core/error.h"
#include "furrow/geometry/bilinear.h"

namespace furrow {

namespace {

constexpr double reference_frequency = 0.1;  // n0 of ISO 8608 [cycles/m]
constexpr int waves = 256;                   // of a random profile, in equal bands of log(n)
constexpr double round_off = 1e-9;           // of a spacing
constexpr int map_samples = 200;             // along the middle of a ground
constexpr double steepest_mean = 1.0;        // slope, as height over length
// Wavelength of a washboard over the length of ground that stays and of ground that follows a
// wheel, and over a cell
constexpr double flattest = 5e-4;  // amplitude over wavelength
constexpr double longest_of_ground = 4.0, longest_of_window = 50.0, cells_of_wave = 4.0;
constexpr char best_road = 'A', worst_road = 'H';
constexpr double best_density = 16e-6;  // G(n0) of the best road [m^3]

/// Equal on every platform, unlike the distributions of the standard library.
double uniform(std::mt19937& generator) { return (generator() + 0.5) / 4294967296.0; }

}  // namespace

double Roughness::mean_density(char road_class) {
  return best_density * std::pow(4.0, road_class - best_road);
}

double Heightmap::height(double x, double y) const {
  const Vector2 first = lower - 0.5 * spacing;
  const Vector2 last = first + Vector2(columns * spacing.x(), rows * spacing.y());
  const Vector2 slack = round_off * spacing;
  if (x < first.x() - slack.x() || y < first.y() - slack.y() || x > last.x() + slack.x() ||
      y > last.y() + slack.y())
    throw InputError(
        name, fmt::format("does not cover x = {:.6g}, y = {:.6g} m of the ground", x, y),
        fmt::format("places with x from {:.6g} to {:.6g} and y from {:.6g} to {:.6g} m", first.x(),
                    last.x(), first.y(), last.y()),
        "give the file's x, y and z of the ground's origin as 'heightmap_origin', or a larger map");
  return bilinear({x, y}, lower, spacing, columns, rows, [&](int column, int row) {
    return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  });
}

GroundRelief::GroundRelief(ReliefParameters parameters, const std::string& where)
    : parameters_(std::move(parameters)) {
  const ReliefParameters& p = parameters_;
  flat_ = !p.heightmap && !p.washboard && !p.roughness && !p.trapezoid && !p.half_cylinder;
  need(!p.flat_until || p.washboard || p.roughness, where + ", keyword 'flat_until'",
       "is given without 'washboard', 'roughness' or 'road_class'", "the start of one of them",
       "remove it");
  need(!p.washboard || (*p.washboard)[0] > 0.0, where + ", keyword 'washboard'",
       "has a wavelength that is not > 0", "wavelength > 0 and amplitude [m]");
  need(!p.trapezoid || ((*p.trapezoid)[2] >= 0.0 && (*p.trapezoid)[3] > (*p.trapezoid)[2]),
       where + ", keyword 'trapezoid'", "has a top that is not shorter than its base",
       "x height top base [m], with 0 <= top < base");
  need(!p.half_cylinder || (*p.half_cylinder)[1] > 0.0, where + ", keyword 'half_cylinder'",
       "has a radius that is not > 0", "x and radius > 0 [m]");
  if (!p.roughness) return;
  need(p.roughness->lowest > 0.0 && p.roughness->highest > p.roughness->lowest,
       where + ", keyword 'roughness_band'",
       fmt::format("is {:g} {:g}", p.roughness->lowest, p.roughness->highest),
       "two frequencies > 0 [cycles/m], the lower one first");
  add_waves(*p.roughness);
}

/// One wave of each band has the power of the band, at a random place in it.
void GroundRelief::add_waves(const Roughness& roughness) {
  std::mt19937 generator(roughness.seed);
  const double ratio = roughness.highest / roughness.lowest;
  const double power = roughness.density * reference_frequency * reference_frequency;
  for (int n = 0; n < waves; ++n) {
    const double low = roughness.lowest * std::pow(ratio, static_cast<double>(n) / waves),
                 high = roughness.lowest * std::pow(ratio, (n + 1.0) / waves);
    const double frequency = low * std::pow(high / low, uniform(generator));
    waves_.push_back({std::sqrt(2.0 * power * (1.0 / low - 1.0 / high)), 2.0 * pi * frequency,
                      2.0 * pi * uniform(generator)});
  }
  if (parameters_.flat_until) waves_at_start_ = waves_at(*parameters_.flat_until);
}

double GroundRelief::waves_at(double x) const {
  double sum = 0.0;
  for (const Wave& wave : waves_)
    sum += wave.amplitude * std::sin(wave.wave_number * x + wave.phase);
  return sum;
}

std::string GroundRelief::note() const {
  return parameters_.heightmap ? parameters_.heightmap->note : "";
}

double GroundRelief::map_height(double x, double y) const {
  return parameters_.heightmap ? parameters_.heightmap->height(x, y) : 0.0;
}

void GroundRelief::check_map(const Vector2& lower, const Vector2& upper) const {
  if (!parameters_.heightmap) return;
  const Heightmap& map = *parameters_.heightmap;
  const double length = upper.x() - lower.x(), y = 0.5 * (lower.y() + upper.y());
  need(map.spacing.x() <= length, map.name,
       fmt::format("has a height every {:.4g} m, and the ground is {:.4g} m long", map.spacing.x(),
                   length),
       "several heights along the ground", "give x, y and z in m, or a finer map");
  double nearest = std::numeric_limits<double>::infinity(), lift = 0.0;
  double before = map.height(lower.x(), y);
  for (int n = 0; n <= map_samples; ++n) {
    const double height = map.height(lower.x() + length * n / map_samples, y);
    nearest = std::min(nearest, std::abs(height));
    lift += std::abs(height - before);
    before = height;
  }
  need(nearest <= length, map.name,
       fmt::format("has heights of {:.6g} m, and the ground is {:.4g} m long", before, length),
       "heights above the flat surface", "give the level of the site as z of 'heightmap_origin'");
  need(lift <= steepest_mean * length, map.name,
       fmt::format("climbs and falls {:.4g} m over the {:.4g} m of the ground", lift, length),
       fmt::format("a mean slope up to {:g}", steepest_mean), "give x, y and z in m");
}

double GroundRelief::profile(double x) const {
  const ReliefParameters& p = parameters_;
  double height = 0.0;
  if (p.trapezoid) {
    const Eigen::Vector4d& shape = *p.trapezoid;
    const double from_foot = 0.5 * shape[3] - std::abs(x - shape[0]);
    height += shape[1] * std::clamp(2.0 * from_foot / (shape[3] - shape[2]), 0.0, 1.0);
  }
  if (p.half_cylinder) {
    const double from_axis = x - (*p.half_cylinder)[0], radius = (*p.half_cylinder)[1];
    height += std::sqrt(std::max(0.0, radius * radius - from_axis * from_axis));
  }
  if (p.flat_until && x <= *p.flat_until) return height;
  if (p.washboard)
    height += (*p.washboard)[1] *
              std::sin(2.0 * pi * (x - p.flat_until.value_or(0.0)) / (*p.washboard)[0]);
  if (p.roughness) height += waves_at(x) - waves_at_start_;
  return height;
}

std::string GroundRelief::map_checksum() const {
  if (!parameters_.heightmap) return "";
  const Heightmap& map = *parameters_.heightmap;
  Checksum checksum;
  checksum.add(map.lower.data(), 2 * sizeof(double));
  checksum.add(map.spacing.data(), 2 * sizeof(double));
  checksum.add(map.heights.data(), map.heights.size() * sizeof(double));
  return fmt::format("{}x{} {:016x}", map.columns, map.rows, checksum.value());
}

std::vector<std::string> GroundRelief::warnings(double length, double cell, bool moves) const {
  std::vector<std::string> found;
  if (const auto& washboard = parameters_.washboard) {
    const double wave = (*washboard)[0], height = std::abs((*washboard)[1]);
    const double longest = (moves ? longest_of_window : longest_of_ground) * length;
    if (height > 0.5 * wave)
      found.push_back(
          fmt::format("'washboard' has a wavelength of {:g} m and an amplitude of {:g} m: it is "
                      "steeper than any "
                      "ground; write the wavelength first",
                      wave, height));
    else if (wave > longest)
      found.push_back(
          fmt::format("'washboard' has a wavelength of {:g} m on ground {:g} m long, which "
                      "is flat on this scale; give m, not mm",
                      wave, length));
    else if (height < flattest * wave)
      found.push_back(
          fmt::format("'washboard' has a wavelength of {:g} m and an amplitude of {:g} m, "
                      "which is flat; give m, not km",
                      wave, height));
    else if (wave < cells_of_wave * cell)
      found.push_back(fmt::format(
          "'washboard' has a wavelength of {:g} m, and a cell is {:g} m: the ground does "
          "not show it; write at most 'cell {:.2g}'",
          wave, cell, wave / cells_of_wave));
  }
  if (const auto& cylinder = parameters_.half_cylinder; cylinder && (*cylinder)[1] < 2.0 * cell)
    found.push_back(
        fmt::format("'half_cylinder' has a radius of {:g} m, and a cell is {:g} m: the "
                    "ground does not show it; write at most 'cell {:.2g}'",
                    (*cylinder)[1], cell, 0.5 * (*cylinder)[1]));
  if (const auto& bump = parameters_.trapezoid; bump && (*bump)[3] < 2.0 * cell)
    found.push_back(
        fmt::format("'trapezoid' has a base of {:g} m, and a cell is {:g} m: the ground "
                    "does not show it; write at most 'cell {:.2g}'",
                    (*bump)[3], cell, 0.5 * (*bump)[3]));
  return found;
}

void GroundRelief::match(Checkpoint& state) const {
  if (parameters_.heightmap) state.match("the nodes of the heightmap", map_checksum());
}

void declare_relief(Schema& schema) {
  schema
      .text("heightmap",
            "file of heights above the flat surface: ESRI ASCII grid, text with x y z, BMP or PNG "
            "picture; path relative to the script")
      .optional()
      .may_change();  // of place: checkpoints compare the heights
  schema
      .numbers("heightmap_origin", 3, "m", Range::any(), "x y z in the file of the ground's origin")
      .by_default(std::vector<double>{0.0, 0.0, 0.0});
  schema
      .numbers(
          "heightmap_picture", 4, "m", Range::any(),
          "of a BMP or PNG picture: length along x, width along y, height of black and of white")
      .optional();
  schema.numbers("washboard", 2, "m", Range::any(), "wavelength along x and amplitude of a sine")
      .optional();
  schema
      .number("roughness", "m^3", Range::positive(),
              "spectral density at 0.1 cycles/m of a random profile along x by ISO 8608")
      .optional();
  std::vector<std::string> classes;
  for (char letter = best_road; letter <= worst_road; ++letter) classes.emplace_back(1, letter);
  schema
      .choice("road_class", classes,
              "class of ISO 8608 in place of `roughness`: the geometric mean of its density")
      .optional();
  schema
      .numbers("roughness_band", 2, "cycles/m", Range::positive(),
               "lowest and highest spatial frequency of the random profile")
      .by_default(std::vector<double>{0.011, 2.83});
  schema.integer("roughness_seed", Range::closed(0.0, 4294967295.0), "seed of the random profile")
      .by_default("1");
  schema.number("flat_until", "m", Range::any(), "x where washboard and random profile begin")
      .optional();
  schema
      .numbers("trapezoid", 4, "m", Range::any(),
               "obstacle across x: x of its middle, height, length of top and of base; a ditch has "
               "a negative height")
      .optional();
  schema
      .numbers("half_cylinder", 2, "m", Range::any(), "obstacle across x: x of its axis and radius")
      .optional();
}

GroundRelief relief_from(const Options& options, std::shared_ptr<const Heightmap> heightmap) {
  ReliefParameters relief;
  relief.heightmap = std::move(heightmap);
  const auto numbers = [&](const char* key) { return options.numbers(key).data(); };
  if (options.given("washboard"))
    relief.washboard = Eigen::Map<const Vector2>(numbers("washboard"));
  if (options.given("trapezoid"))
    relief.trapezoid = Eigen::Map<const Eigen::Vector4d>(numbers("trapezoid"));
  if (options.given("half_cylinder"))
    relief.half_cylinder = Eigen::Map<const Vector2>(numbers("half_cylinder"));
  if (options.given("flat_until")) relief.flat_until = options.number("flat_until");
  need(!options.given("road_class") || !options.given("roughness"), options.where("road_class"),
       "is given with 'roughness'", "one of them: both set the density", "remove one of them");
  if (options.given("road_class") || options.given("roughness"))
    relief.roughness = Roughness{options.given("roughness")
                                     ? options.number("roughness")
                                     : Roughness::mean_density(options.text("road_class")[0]),
                                 numbers("roughness_band")[0], numbers("roughness_band")[1],
                                 static_cast<std::uint32_t>(options.integer("roughness_seed"))};
  for (const char* key : {"roughness_band", "roughness_seed"})
    need(!options.given(key) || relief.roughness, options.where(key),
         "is given without 'roughness' or 'road_class'", "a property of a random profile",
         "remove it");
  need(!options.given("heightmap_origin") || relief.heightmap, options.where("heightmap_origin"),
       "is given without 'heightmap'", "a place in a heightmap", "remove it");
  return GroundRelief(std::move(relief), options.subject());
}

}  // namespace furrow
