// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/heightmap_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <vtkBMPReader.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/io/formats/input_text.h"
#include "furrow/io/formats/text_lines.h"

namespace furrow {

namespace {

constexpr std::uintmax_t largest_heightmap_file = 400'000'000;  // [bytes]
constexpr double maximum_nodes = 5e7;
constexpr double maximum_gaps = 4.0;        // largest ratio of nodes to points of a grid
constexpr double regular = 1e-3;            // of a spacing: by which a coordinate may be off
constexpr double largest_height = 1e5;      // [m] larger heights mark cells without data
constexpr double largest_coordinate = 1e9;  // [m]
constexpr const char* kind = "a heightmap";
constexpr const char* formats = "an ESRI ASCII grid, lines of x y z, or a BMP or PNG picture";
constexpr std::size_t minimum_scan = 50;  // points that may be resampled
constexpr double none = std::numeric_limits<double>::quiet_NaN();

double number(const TextLines& lines, std::size_t word) {
  double value = none;
  if (!parse(lines.words()[word], value))
    lines.refuse(lines.line(), fmt::format("has '{}'", short_word(lines.words()[word])),
                 "a number");
  return value;
}

std::string read_text(const std::string& path) {
  std::string bytes = read_input_bytes(path, kind, largest_heightmap_file);
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
  if (columns >= 1.0 && rows >= 1.0 && columns * rows <= maximum_nodes &&
      columns == std::floor(columns) && rows == std::floor(rows))
    return;
  lines.refuse(0, fmt::format("has {:g} columns and {:g} rows", columns, rows),
               fmt::format("whole numbers, at most {:g} heights", maximum_nodes));
}

void check_height(const TextLines& lines, int line, double height, double x, double y) {
  if (std::abs(height) <= largest_height) return;
  lines.refuse(line, fmt::format("has no height at x = {:.10g}, y = {:.10g} m", x, y),
               fmt::format("a height up to {:g} m at every point", largest_height),
               "fill the gaps: gdal_fillnodata, or cut the map: gdal_translate -projwin");
}

/// Checks the length of a text before memory is taken for its heights: one has a digit and a blank
/// at least, the last one a digit.
void check_length(const TextLines& lines, const std::string& text, double count) {
  const double most = std::floor(0.5 * (static_cast<double>(text.size()) + 1.0));
  if (count <= most) return;
  lines.refuse(
      0, fmt::format("has {} bytes, and its header announces {:.0f} heights", text.size(), count),
      "ncols x nrows heights of at least two bytes",
      "the file is cut short, or its header is wrong");
}

/// Reads rows from the north down; the header gives the corner or the centre of the cell in the
/// south-west.
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
  if (!(intervals < maximum_nodes))
    lines.refuse(0, fmt::format("has points {:.3g} m apart along {}", spacing, name),
                 "points of a regular grid");
  return {lower, length / intervals, static_cast<int>(intervals) + 1};
}

/// Words of a line that hold x, y and z, by the headings if there are any.
std::array<std::size_t, 3> find_columns(TextLines& lines) {
  std::array<std::size_t, 3> columns = {0, 1, 2};
  double value = none;
  const std::vector<std::string_view>& words = lines.words();
  if (words.empty() || parse(words.front(), value)) return columns;
  const std::array<std::vector<std::string>, 3> names = {
      std::vector<std::string>{"x", "easting", "east", "e"},
      {"y", "northing", "north", "n"},
      {"z", "height", "elevation", "h"}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto is_name = [&](std::string_view word) {
      // "X[m]", "//X" of CloudCompare
      std::string name =
          lower_case(word.substr(std::min(word.find_first_not_of("/\"'"), word.size())));
      name = name.substr(0, name.find_first_of("[(_\"'"));
      return std::find(names[k].begin(), names[k].end(), name) != names[k].end();
    };
    const auto found = std::find_if(words.begin(), words.end(), is_name);
    if (found == words.end())
      lines.refuse(lines.line(), fmt::format("has no heading '{}'", names[k].front()),
                   "headings x, y and z, or numbers");
    columns[k] = static_cast<std::size_t>(found - words.begin());
  }
  if (!lines.next()) lines.refuse(0, "has no points", formats);
  return columns;
}

struct Points {
  std::vector<double> x, y, z;
  std::vector<int> line_of;
};

Points read_xyz(TextLines& lines) {
  Points points;
  const std::array<std::size_t, 3> columns = find_columns(lines);
  const std::size_t words = lines.words().size();
  if (words < 3) lines.refuse(lines.line(), fmt::format("has {} words", words), "x y z");
  do {
    if (lines.words().size() != words)
      lines.refuse(lines.line(), fmt::format("has {} words", lines.words().size()),
                   fmt::format("{}, as the lines above; x y z", words));
    points.x.push_back(number(lines, columns[0]));
    points.y.push_back(number(lines, columns[1]));
    points.z.push_back(number(lines, columns[2]));
    points.line_of.push_back(lines.line());
    const double x = points.x.back(), y = points.y.back();
    check_height(lines, lines.line(), points.z.back(), x, y);
    if (!(std::abs(x) + std::abs(y) <= largest_coordinate))
      lines.refuse(lines.line(), fmt::format("has the point x = {:g}, y = {:g} m", x, y),
                   fmt::format("coordinates up to {:g} m", largest_coordinate));
  } while (lines.next());
  return points;
}

/// Sorts points by the node that is nearest to them.
class Bins {
 public:
  Bins(const Points& points, const Heightmap& map)
      : columns_(map.columns),
        rows_(map.rows),
        in_(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows)) {
    for (std::size_t n = 0; n < points.z.size(); ++n) {
      const long i = std::lround((points.x[n] - map.lower.x()) / map.spacing.x()),
                 j = std::lround((points.y[n] - map.lower.y()) / map.spacing.y());
      in_[at(static_cast<int>(i), static_cast<int>(j))].push_back(n);
    }
  }
  /// Calls visit(point) for all points within so many nodes.
  template <class Visit>
  void around(int column, int row, int reach, Visit visit) const {
    for (int j = std::max(0, row - reach); j <= std::min(rows_ - 1, row + reach); ++j)
      for (int i = std::max(0, column - reach); i <= std::min(columns_ - 1, column + reach); ++i)
        for (const std::size_t n : in_[at(i, j)]) visit(n);
  }

 private:
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(i);
  }
  int columns_, rows_;
  std::vector<std::vector<std::size_t>> in_;
};

/// Height at a node of the plane that fits the points around it best, near ones more.
/// @return not a number without points
double plane_height(const Points& points, const Heightmap& map, const Bins& bins, int column,
                    int row) {
  const double x = map.lower.x() + column * map.spacing.x(),
               y = map.lower.y() + row * map.spacing.y();
  for (const int reach : {1, 2, 3}) {
    Matrix3 normal = Matrix3::Zero();
    Vector3 right = Vector3::Zero();
    bins.around(column, row, reach, [&](std::size_t n) {
      const Vector3 basis(1.0, (points.x[n] - x) / map.spacing.x(),
                          (points.y[n] - y) / map.spacing.y());
      const double weight = std::exp(-2.0 * basis.tail<2>().squaredNorm());
      normal += weight * basis * basis.transpose();
      right += weight * points.z[n] * basis;
    });
    constexpr double well_placed = 1e-3;  // smallest over largest pivot
    const Eigen::LDLT<Matrix3> solver(normal);
    if (normal(0, 0) > 0.0 &&
        solver.vectorD().minCoeff() > well_placed * solver.vectorD().maxCoeff())
      return solver.solve(right)[0];
  }
  return none;
}

/// Heightmap of scattered points, on a regular grid of about as many nodes as points.
Heightmap resampled(const TextLines& lines, const Points& points) {
  const auto [left, right] = std::minmax_element(points.x.begin(), points.x.end());
  const auto [front, back] = std::minmax_element(points.y.begin(), points.y.end());
  const Vector2 size(*right - *left, *back - *front);
  const double spacing = std::sqrt(size.prod() / static_cast<double>(points.z.size()));
  Heightmap map;
  map.lower = {*left, *front};
  map.columns = static_cast<int>(std::lround(size.x() / spacing)) + 1;
  map.rows = static_cast<int>(std::lround(size.y() / spacing)) + 1;
  check_count(lines, map.columns, map.rows);
  map.spacing = size.array() / Eigen::Array2d(map.columns - 1, map.rows - 1);
  const Bins bins(points, map);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      map.heights.push_back(plane_height(points, map, bins, column, row));
      if (std::isnan(map.heights.back()))
        lines.refuse(0,
                     fmt::format("has no points within {:.4g} m of x = {:.10g}, y = {:.10g} m",
                                 3.5 * spacing, map.lower.x() + column * map.spacing.x(),
                                 map.lower.y() + row * map.spacing.y()),
                     "a scan without gaps over a rectangle along x and y",
                     "cut the scan to the ground of the run, or fill the gaps");
    }
  double squares = 0.0, largest = 0.0;
  for (std::size_t n = 0; n < points.z.size(); ++n) {
    const double error = map.height(points.x[n], points.y[n]) - points.z[n];
    squares += error * error;
    largest = std::max(largest, std::abs(error));
  }
  map.note = fmt::format(
      "{} points on no regular grid are resampled every {:.4g} m; the surface misses them by "
      "{:.2g} "
      "m (rms), at most {:.2g} m",
      points.z.size(), spacing, std::sqrt(squares / static_cast<double>(points.z.size())), largest);
  return map;
}

Heightmap read_points(TextLines& lines) {
  const Points points = read_xyz(lines);
  const std::vector<double>&x = points.x, &y = points.y, &z = points.z;
  const std::vector<int>& line_of = points.line_of;
  const auto is_scan = [&] {
    const auto [left, right] = std::minmax_element(x.begin(), x.end());
    const auto [front, back] = std::minmax_element(y.begin(), y.end());
    return z.size() >= minimum_scan && *right > *left && *back > *front;
  };
  const RegularAxis along_x = regular_axis(lines, x, "x"), along_y = regular_axis(lines, y, "y");
  const double nodes = static_cast<double>(along_x.count) * along_y.count;
  if (nodes > maximum_gaps * static_cast<double>(z.size()) && is_scan())
    return resampled(lines, points);
  check_count(lines, along_x.count, along_y.count);
  if (nodes > maximum_gaps * static_cast<double>(z.size()))
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
    const bool off = std::abs(i - std::round(i)) > regular || std::abs(j - std::round(j)) > regular;
    if (off && is_scan()) return resampled(lines, points);
    if (off)
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

/// True if commas are decimal ones: between digits, in words that blanks or semicolons separate,
/// without any decimal point.
bool has_decimal_commas(const std::string& text) {
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
  };
  bool commas = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '.' && is_digit(at + 1)) return false;
    if (text[at] != ',') continue;
    if (at == 0 || !is_digit(at - 1) || !is_digit(at + 1)) return false;
    commas = true;
  }
  // "1,2,3" has one word
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  const std::size_t line = text.find_last_of('\n', last) + 1;
  return commas && text.substr(line, last - line).find_first_of(" \t;") != std::string::npos;
}

/// Brightness of the pixels, from the height of black to that of white.
Heightmap read_picture(const std::string& path, const std::string& ending,
                       const std::optional<PictureSize>& size) {
  read_input_bytes(path, kind, largest_heightmap_file);  // refuses what is no file
  need(size.has_value(), path, "is a picture, which has no lengths",
       "the keyword 'heightmap_picture': length along x, width along y, height of black and of "
       "white, in m",
       "for Chrono's bump64.bmp on 8 m x 8 m: heightmap_picture 8 8 0 0.3");
  need((*size)[0] > 0.0 && (*size)[1] > 0.0, path + ", keyword 'heightmap_picture'",
       fmt::format("is {:g} m x {:g} m", (*size)[0], (*size)[1]), "lengths > 0");
  vtkSmartPointer<vtkImageReader2> reader;
  if (ending == ".png")
    reader = vtkSmartPointer<vtkPNGReader>::New();
  else
    reader = vtkSmartPointer<vtkBMPReader>::New();
  need(reader->CanReadFile(path.c_str()) != 0, path, "is no picture", formats);
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  Heightmap map;
  map.columns = image->GetDimensions()[0];
  map.rows = image->GetDimensions()[1];
  map.spacing = {(*size)[0] / map.columns, (*size)[1] / map.rows};
  map.lower = -0.5 * Vector2((*size)[0], (*size)[1]) + 0.5 * map.spacing;
  const double white = image->GetScalarTypeMax();
  const int colours = std::min(3, image->GetNumberOfScalarComponents());
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      double brightness = 0.0;
      for (int c = 0; c < (colours == 3 ? 3 : 1); ++c)
        brightness += image->GetScalarComponentAsDouble(column, row, 0, c);
      brightness /= (colours == 3 ? 3.0 : 1.0) * white;
      map.heights.push_back((*size)[2] + brightness * ((*size)[3] - (*size)[2]));
    }
  return map;
}

}  // namespace

Heightmap read_heightmap(const std::string& path, const Vector3& origin,
                         const std::optional<PictureSize>& picture) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  Heightmap map;
  if (ending == ".bmp" || ending == ".png") {
    map = read_picture(path, ending, picture);
  } else {
    need(!picture, path, "is no picture, and 'heightmap_picture' is given", "a BMP or PNG file");
    std::string text = read_text(path);
    if (has_decimal_commas(text)) std::replace(text.begin(), text.end(), ',', '.');
    TextLines lines(path, text, " \t\r,;", '#');
    if (!lines.next()) lines.refuse(0, "is empty", formats);
    const std::string first = lower_case(lines.words().front());
    map = first == "ncols" || first == "nrows" ? read_grid(lines, text) : read_points(lines);
  }
  map.name = path;
  map.lower -= origin.head<2>();
  for (double& height : map.heights) height -= origin.z();
  return map;
}

GroundRelief read_relief(const Options& options, const std::string& folder) {
  if (!options.given("heightmap")) {
    need(!options.given("heightmap_picture"), options.where("heightmap_picture"),
         "is given without 'heightmap'", "a picture");
    return relief_from(options, {});
  }
  const std::filesystem::path path = std::filesystem::path(folder) / options.text("heightmap");
  const std::vector<double>& origin = options.numbers("heightmap_origin");
  std::optional<PictureSize> picture;
  if (options.given("heightmap_picture"))
    picture = Eigen::Map<const PictureSize>(options.numbers("heightmap_picture").data());
  return relief_from(options,
                     std::make_shared<const Heightmap>(read_heightmap(
                         path.string(), Eigen::Map<const Vector3>(origin.data()), picture)));
}

}  // namespace furrow
