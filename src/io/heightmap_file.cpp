// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/heightmap_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "io/input_text.h"

namespace furrow {

namespace {

constexpr std::uintmax_t largest_file = 400'000'000;  // [bytes]
constexpr double most_nodes = 5e7;
constexpr double regular = 1e-3;        // of a spacing: by which a coordinate may be off
constexpr double largest_height = 1e5;  // [m] what is larger marks a cell without data
constexpr const char* kind = "a heightmap";
constexpr const char* formats = "an ESRI ASCII grid, or lines of x y z";
constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Words {
  int line = 0;
  std::vector<std::string_view> words;
};

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {
    const std::string bytes = read_input_bytes(path, kind, largest_file).substr(0, 4);
    if (bytes == std::string("II*\0", 4) || bytes == std::string("MM\0*", 4) ||
        bytes == std::string("II+\0", 4) || bytes == std::string("MM\0+", 4))
      throw InputError(path, "is a GeoTIFF", formats,
                       "convert it: gdal_translate -of AAIGrid in.tif out.asc");
    text_ = read_input_text(path, kind, largest_file);
    rest_ = text_;
  }
  /// The next line that has words; none at the end.
  bool next(Words& line) {
    line.words.clear();
    while (!rest_.empty() && line.words.empty()) {
      line.line = ++number_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      split(rest_.substr(0, end), line.words);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
    }
    return !line.words.empty();
  }
  double number(const Words& line, std::size_t word) const {
    const std::string_view text = line.words[word];
    double value = none;
    const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || stop != text.data() + text.size())
      refuse(line.line, fmt::format("has '{}'", text.substr(0, 20)), "a number");
    return value;
  }
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& allowed,
                           const std::string& remedy = "") const {
    throw InputError(line > 0 ? fmt::format("{}, line {}", path_, line) : path_, problem, allowed,
                     remedy);
  }

 private:
  static void split(std::string_view line, std::vector<std::string_view>& words) {
    constexpr const char* blanks = " \t\r,;";
    line = line.substr(0, line.find('#'));
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;
         at = line.find_first_not_of(blanks, at)) {
      const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = end;
    }
  }

  std::string path_, text_;
  std::string_view rest_;
  int number_ = 0;
};

void check_count(const Reader& reader, double columns, double rows) {
  if (columns >= 1.0 && rows >= 1.0 && columns * rows <= most_nodes &&
      columns == std::floor(columns) && rows == std::floor(rows))
    return;
  reader.refuse(0, fmt::format("has {:g} columns and {:g} rows", columns, rows),
                fmt::format("whole numbers, at most {:g} heights", most_nodes));
}

void check_height(const Reader& reader, int line, double height, double x, double y) {
  if (std::abs(height) <= largest_height) return;
  reader.refuse(line, fmt::format("has no height at x = {:.10g}, y = {:.10g} m", x, y),
                fmt::format("a height up to {:g} m at every point", largest_height),
                "fill the gaps: gdal_fillnodata, or cut the map: gdal_translate -projwin");
}

std::string lower_case(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// From the north down; the header gives the corner or the centre of the cell in the south-west.
Heightmap read_grid(Reader& reader, Words line) {
  std::map<std::string, double> header;
  while (std::isalpha(static_cast<unsigned char>(line.words.front().front())) != 0 &&
         lower_case(line.words.front()) != "nan") {
    if (line.words.size() != 2)
      reader.refuse(line.line, "is no line of a header", "a key and a number");
    header[lower_case(line.words.front())] = reader.number(line, 1);
    if (!reader.next(line)) reader.refuse(0, "has no heights", formats);
  }
  const auto need = [&](const char* key, const char* other) {
    const auto found = header.count(key) ? header.find(key) : header.find(other);
    if (found == header.end())
      reader.refuse(0, fmt::format("has no '{}' in its header", key),
                    "ncols, nrows, xllcorner, yllcorner, cellsize",
                    "gdal_translate -of AAIGrid writes them");
    return found->second;
  };
  check_count(reader, need("ncols", "ncols"), need("nrows", "nrows"));
  Heightmap map;
  map.columns = static_cast<int>(need("ncols", "ncols"));
  map.rows = static_cast<int>(need("nrows", "nrows"));
  map.spacing = {need("cellsize", "dx"), need("cellsize", "dy")};
  if (!(map.spacing.minCoeff() > 0.0)) reader.refuse(0, "has a cellsize <= 0", "a number > 0 [m]");
  map.lower = {
      need("xllcorner", "xllcenter") + (header.count("xllcorner") ? 0.5 : 0.0) * map.spacing.x(),
      need("yllcorner", "yllcenter") + (header.count("yllcorner") ? 0.5 : 0.0) * map.spacing.y()};
  const double no_data = header.count("nodata_value") ? header["nodata_value"] : none;
  const auto columns = static_cast<std::size_t>(map.columns);
  map.heights.assign(columns * static_cast<std::size_t>(map.rows), 0.0);
  std::size_t count = 0;
  do
    for (std::size_t word = 0; word < line.words.size(); ++word, ++count) {
      if (count >= map.heights.size())
        reader.refuse(line.line, "has more heights than ncols x nrows", formats);
      const std::size_t row = static_cast<std::size_t>(map.rows) - 1 - count / columns;
      double height = reader.number(line, word);
      if (height == no_data) height = none;
      check_height(reader, line.line, height,
                   map.lower.x() + static_cast<double>(count % columns) * map.spacing.x(),
                   map.lower.y() + static_cast<double>(row) * map.spacing.y());
      map.heights[row * columns + count % columns] = height;
    }
  while (reader.next(line));
  if (count < map.heights.size())
    reader.refuse(0, fmt::format("has {} heights", count),
                  fmt::format("{}: ncols x nrows", map.heights.size()), "the file is cut short");
  return map;
}

/// The coordinates of a regular axis: its first one, spacing and count.
struct RegularAxis {
  double lower, spacing;
  int count;
};

RegularAxis regular_axis(const Reader& reader, std::vector<double> coordinates, const char* name) {
  std::sort(coordinates.begin(), coordinates.end());
  const double lower = coordinates.front(), length = coordinates.back() - lower;
  double spacing = 0.0;
  for (std::size_t n = 1; n < coordinates.size(); ++n)
    if (const double gap = coordinates[n] - coordinates[n - 1];
        gap > 1e-9 * length && (spacing == 0.0 || gap < spacing))
      spacing = gap;
  if (spacing == 0.0)
    reader.refuse(0, fmt::format("has a single {}", name), "at least two along x and along y");
  const double intervals = std::round(length / spacing);
  if (!(intervals < most_nodes))
    reader.refuse(0, fmt::format("has points {:.3g} m apart along {}", spacing, name),
                  "points of a regular grid");
  return {lower, length / intervals, static_cast<int>(intervals) + 1};
}

Heightmap read_points(Reader& reader, Words line) {
  std::vector<double> x, y, z;
  std::vector<int> lines;
  do {
    if (line.words.size() != 3)
      reader.refuse(line.line, fmt::format("has {} words", line.words.size()), "x y z");
    x.push_back(reader.number(line, 0));
    y.push_back(reader.number(line, 1));
    z.push_back(reader.number(line, 2));
    lines.push_back(line.line);
    check_height(reader, line.line, z.back(), x.back(), y.back());
    if (!std::isfinite(x.back()) || !std::isfinite(y.back()))
      reader.refuse(line.line, "has a coordinate that is not finite", "x y z");
  } while (reader.next(line));
  const RegularAxis along_x = regular_axis(reader, x, "x"), along_y = regular_axis(reader, y, "y");
  check_count(reader, along_x.count, along_y.count);
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
      reader.refuse(
          lines[n], "has a point that is not on a regular grid",
          fmt::format("x and y in steps of {:.6g} and {:.6g} m", map.spacing.x(), map.spacing.y()),
          "interpolate the points on a grid: gdal_grid");
    double& height = map.heights[static_cast<std::size_t>(std::lround(j)) *
                                     static_cast<std::size_t>(map.columns) +
                                 static_cast<std::size_t>(std::lround(i))];
    if (!std::isnan(height)) reader.refuse(lines[n], "repeats a point", "every point once");
    height = z[n];
  }
  for (std::size_t n = 0; n < map.heights.size(); ++n)
    check_height(reader, 0, map.heights[n],
                 map.lower.x() + static_cast<double>(n % static_cast<std::size_t>(map.columns)) *
                                     map.spacing.x(),
                 map.lower.y() + static_cast<double>(n / static_cast<std::size_t>(map.columns)) *
                                     map.spacing.y());
  return map;
}

}  // namespace

Heightmap read_heightmap(const std::string& path, const Vector3& origin) {
  Reader reader(path);
  Words line;
  if (!reader.next(line)) reader.refuse(0, "is empty", formats);
  const bool has_header =
      lower_case(line.words.front()) == "ncols" || lower_case(line.words.front()) == "nrows";
  Heightmap map = has_header ? read_grid(reader, line) : read_points(reader, line);
  map.name = path;
  map.lower -= origin.head<2>();
  for (double& height : map.heights) height -= origin.z();
  return map;
}

GroundRelief read_relief(const Options& options, const std::string& folder) {
  if (!options.given("heightmap")) return relief_from(options, {});
  const std::filesystem::path path = std::filesystem::path(folder) / options.text("heightmap");
  const std::vector<double>& origin = options.numbers("heightmap_origin");
  return relief_from(options,
                     read_heightmap(path.string(), Eigen::Map<const Vector3>(origin.data())));
}

}  // namespace furrow
