// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/heightmap_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "io/input_text.h"
#include "io/text_lines.h"

namespace furrow {

namespace {

constexpr std::uintmax_t largest_file = 400'000'000;  // [bytes]
constexpr double most_nodes = 5e7;
constexpr double most_gaps = 4.0;           // nodes over points; with more gaps it is no grid
constexpr double regular = 1e-3;            // of a spacing: by which a coordinate may be off
constexpr double largest_height = 1e5;      // [m] what is larger marks a cell without data
constexpr double largest_coordinate = 1e9;  // [m]
constexpr const char* kind = "a heightmap";
constexpr const char* formats = "an ESRI ASCII grid, or lines of x y z";
constexpr double none = std::numeric_limits<double>::quiet_NaN();

double number(const TextLines& lines, std::size_t word) {
  double value = none;
  if (!parse(lines.words()[word], value))
    lines.refuse(lines.line(), fmt::format("has '{}'", short_word(lines.words()[word])),
                 "a number");
  return value;
}

std::string read_text(const std::string& path) {
  std::string bytes = read_input_bytes(path, kind, largest_file);
  const std::string head = bytes.substr(0, 4);
  if (head == std::string("II*\0", 4) || head == std::string("MM\0*", 4) ||
      head == std::string("II+\0", 4) || head == std::string("MM\0+", 4))
    throw InputError(
        path, "is a GeoTIFF", formats,
        "convert it: gdal_translate -of AAIGrid in.tif out.asc; for heights in feet add "
        "-ot Float32 -scale 0 1 0 0.3048");
  return text_of_bytes(std::move(bytes), path, kind);
}

void check_count(const TextLines& lines, double columns, double rows) {
  if (columns >= 1.0 && rows >= 1.0 && columns * rows <= most_nodes &&
      columns == std::floor(columns) && rows == std::floor(rows))
    return;
  lines.refuse(0, fmt::format("has {:g} columns and {:g} rows", columns, rows),
               fmt::format("whole numbers, at most {:g} heights", most_nodes));
}

void check_height(const TextLines& lines, int line, double height, double x, double y) {
  if (std::abs(height) <= largest_height) return;
  lines.refuse(line, fmt::format("has no height at x = {:.10g}, y = {:.10g} m", x, y),
               fmt::format("a height up to {:g} m at every point", largest_height),
               "fill the gaps: gdal_fillnodata, or cut the map: gdal_translate -projwin");
}

std::string lower_case(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Before memory is taken for them: a height has a digit and a blank at least, the last one a
/// digit.
void check_length(const TextLines& lines, const std::string& text, double count) {
  const double most = std::floor(0.5 * (static_cast<double>(text.size()) + 1.0));
  if (count <= most) return;
  lines.refuse(
      0, fmt::format("has {} bytes, and its header announces {:.0f} heights", text.size(), count),
      "ncols x nrows heights of at least two bytes",
      "the file is cut short, or its header is wrong");
}

/// From the north down; the header gives the corner or the centre of the cell in the south-west.
Heightmap read_grid(TextLines& lines, const std::string& text) {
  std::map<std::string, double> header;
  while (std::isalpha(static_cast<unsigned char>(lines.words().front().front())) != 0 &&
         lower_case(lines.words().front()) != "nan") {
    if (lines.words().size() != 2)
      lines.refuse(lines.line(), "is no line of a header", "a key and a number");
    header[lower_case(lines.words().front())] = number(lines, 1);
    if (!lines.next()) lines.refuse(0, "has no heights", formats);
  }
  const auto need = [&](const char* key, const char* other) {
    const auto found = header.count(key) ? header.find(key) : header.find(other);
    if (found == header.end())
      lines.refuse(0, fmt::format("has no '{}' in its header", key),
                   "ncols, nrows, xllcorner, yllcorner, cellsize",
                   "gdal_translate -of AAIGrid writes them");
    return found->second;
  };
  const double columns_given = need("ncols", "ncols"), rows_given = need("nrows", "nrows");
  check_count(lines, columns_given, rows_given);
  check_length(lines, text, columns_given * rows_given);
  Heightmap map;
  map.columns = static_cast<int>(columns_given);
  map.rows = static_cast<int>(rows_given);
  map.spacing = {need("cellsize", "dx"), need("cellsize", "dy")};
  map.lower = {
      need("xllcorner", "xllcenter") + (header.count("xllcorner") ? 0.5 : 0.0) * map.spacing.x(),
      need("yllcorner", "yllcenter") + (header.count("yllcorner") ? 0.5 : 0.0) * map.spacing.y()};
  if (!(map.lower.cwiseAbs().sum() + map.spacing.sum() <= largest_coordinate))
    lines.refuse(0, "has a corner or a cellsize that is infinite, too large or no number",
                 fmt::format("numbers up to {:g} m", largest_coordinate));
  if (!(map.spacing.minCoeff() > 0.0)) lines.refuse(0, "has a cellsize <= 0", "a number > 0 [m]");
  const double no_data = header.count("nodata_value") ? header["nodata_value"] : none;
  const auto columns = static_cast<std::size_t>(map.columns);
  map.heights.assign(columns * static_cast<std::size_t>(map.rows), 0.0);
  std::size_t count = 0;
  do
    for (std::size_t word = 0; word < lines.words().size(); ++word, ++count) {
      if (count >= map.heights.size())
        lines.refuse(lines.line(), "has more heights than ncols x nrows", formats);
      const std::size_t row = static_cast<std::size_t>(map.rows) - 1 - count / columns;
      double height = number(lines, word);
      if (height == no_data) height = none;
      check_height(lines, lines.line(), height,
                   map.lower.x() + static_cast<double>(count % columns) * map.spacing.x(),
                   map.lower.y() + static_cast<double>(row) * map.spacing.y());
      map.heights[row * columns + count % columns] = height;
    }
  while (lines.next());
  if (count < map.heights.size())
    lines.refuse(0, fmt::format("has {} heights", count),
                 fmt::format("{}: ncols x nrows", map.heights.size()), "the file is cut short");
  return map;
}

/// The coordinates of a regular axis: its first one, spacing and count.
struct RegularAxis {
  double lower, spacing;
  int count;
};

RegularAxis regular_axis(const TextLines& lines, std::vector<double> coordinates,
                         const char* name) {
  std::sort(coordinates.begin(), coordinates.end());
  const double lower = coordinates.front(), length = coordinates.back() - lower;
  double spacing = 0.0;
  for (std::size_t n = 1; n < coordinates.size(); ++n)
    if (const double gap = coordinates[n] - coordinates[n - 1];
        gap > 1e-9 * length && (spacing == 0.0 || gap < spacing))
      spacing = gap;
  if (spacing == 0.0)
    lines.refuse(0, fmt::format("has a single {}", name), "at least two along x and along y");
  const double intervals = std::round(length / spacing);
  if (!(intervals < most_nodes))
    lines.refuse(0, fmt::format("has points {:.3g} m apart along {}", spacing, name),
                 "points of a regular grid");
  return {lower, length / intervals, static_cast<int>(intervals) + 1};
}

Heightmap read_points(TextLines& lines) {
  std::vector<double> x, y, z;
  std::vector<int> line_of;
  do {
    if (lines.words().size() != 3)
      lines.refuse(lines.line(), fmt::format("has {} words", lines.words().size()), "x y z");
    x.push_back(number(lines, 0));
    y.push_back(number(lines, 1));
    z.push_back(number(lines, 2));
    line_of.push_back(lines.line());
    check_height(lines, lines.line(), z.back(), x.back(), y.back());
    if (!(std::abs(x.back()) + std::abs(y.back()) <= largest_coordinate))
      lines.refuse(lines.line(),
                   fmt::format("has the point x = {:g}, y = {:g} m", x.back(), y.back()),
                   fmt::format("coordinates up to {:g} m", largest_coordinate));
  } while (lines.next());
  const RegularAxis along_x = regular_axis(lines, x, "x"), along_y = regular_axis(lines, y, "y");
  check_count(lines, along_x.count, along_y.count);
  if (const double nodes = static_cast<double>(along_x.count) * along_y.count;
      nodes > most_gaps * static_cast<double>(z.size()))
    lines.refuse(0,
                 fmt::format("has {} points for {:.0f} nodes of a regular grid", z.size(), nodes),
                 fmt::format("x and y in steps of {:.6g} and {:.6g} m, every point once",
                             along_x.spacing, along_y.spacing),
                 "interpolate the points on a grid: gdal_grid");
  Heightmap map;
  map.columns = along_x.count;
  map.rows = along_y.count;
  map.lower = {along_x.lower, along_y.lower};
  map.spacing = {along_x.spacing, along_y.spacing};
  map.heights.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows),
                     none);
  for (std::size_t n = 0; n < z.size(); ++n) {
    const double i = (x[n] - map.lower.x()) / map.spacing.x(),
                 j = (y[n] - map.lower.y()) / map.spacing.y();
    if (std::abs(i - std::round(i)) > regular || std::abs(j - std::round(j)) > regular)
      lines.refuse(
          line_of[n], "has a point that is not on a regular grid",
          fmt::format("x and y in steps of {:.6g} and {:.6g} m", map.spacing.x(), map.spacing.y()),
          "interpolate the points on a grid: gdal_grid");
    double& height = map.heights[static_cast<std::size_t>(std::lround(j)) *
                                     static_cast<std::size_t>(map.columns) +
                                 static_cast<std::size_t>(std::lround(i))];
    if (!std::isnan(height)) lines.refuse(line_of[n], "repeats a point", "every point once");
    height = z[n];
  }
  for (std::size_t n = 0; n < map.heights.size(); ++n)
    check_height(lines, 0, map.heights[n],
                 map.lower.x() + static_cast<double>(n % static_cast<std::size_t>(map.columns)) *
                                     map.spacing.x(),
                 map.lower.y() + static_cast<double>(n / static_cast<std::size_t>(map.columns)) *
                                     map.spacing.y());
  return map;
}

}  // namespace

Heightmap read_heightmap(const std::string& path, const Vector3& origin) {
  const std::string text = read_text(path);
  TextLines lines(path, text, " \t\r,;", '#');
  if (!lines.next()) lines.refuse(0, "is empty", formats);
  const std::string first = lower_case(lines.words().front());
  Heightmap map =
      first == "ncols" || first == "nrows" ? read_grid(lines, text) : read_points(lines);
  map.name = path;
  map.lower -= origin.head<2>();
  for (double& height : map.heights) height -= origin.z();
  return map;
}

GroundRelief read_relief(const Options& options, const std::string& folder) {
  if (!options.given("heightmap")) return relief_from(options, {});
  const std::filesystem::path path = std::filesystem::path(folder) / options.text("heightmap");
  const std::vector<double>& origin = options.numbers("heightmap_origin");
  return relief_from(options, std::make_shared<const Heightmap>(read_heightmap(
                                  path.string(), Eigen::Map<const Vector3>(origin.data()))));
}

}  // namespace furrow
