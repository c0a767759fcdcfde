// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/geometry/weld.h"
#include "furrow/io/formats/input_text.h"
#include "furrow/io/formats/text_lines.h"
#include "furrow/io/formats/vtk_file.h"

namespace furrow {

namespace {

constexpr std::uintmax_t largest_mesh_file = 200'000'000;  // [bytes]
constexpr std::size_t maximum_facets = 300'000;            // facets whose check takes seconds
constexpr double largest_mesh_coordinate = 1e9;            // in any unit
constexpr const char* mesh_kind = "a mesh file, STL, OBJ or VTP";

bool is_coordinate(double x) { return std::abs(x) <= largest_mesh_coordinate; }

class MeshLines : public TextLines {
 public:
  using TextLines::TextLines;

  /// Point of the three numbers after the first word of a line.
  Vector3 point() const {
    if (words().size() < 4) refuse("has fewer than three coordinates", "three numbers");
    Vector3 point;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words()[static_cast<std::size_t>(k) + 1];
      if (!parse(word, point[k]) || !is_coordinate(point[k]))
        refuse(fmt::format("has '{}' as a coordinate", short_word(word)),
               fmt::format("a number up to {:g}", largest_mesh_coordinate));
    }
    return point;
  }
  [[noreturn]] void refuse(const std::string& problem, const std::string& allowed) const {
    TextLines::refuse(line(), problem, allowed, "export the mesh again");
  }
};

MeshFacets read_ascii_stl(const std::string& path, const std::string& text) {
  MeshFacets read;
  MeshLines lines(path, text);
  int corners = -1;  // corners read of the present facet; -1 outside a facet
  while (lines.next()) {
    const std::string_view word = lines.words().front();
    if (word == "facet") {
      if (corners >= 0) lines.refuse("begins a facet inside a facet", "'endfacet' before");
      corners = 0;
    } else if (word == "vertex") {
      if (corners < 0 || corners == 3)
        lines.refuse("has a vertex that no facet has room for", "three vertices in each facet");
      read.points.push_back(lines.point());
      ++corners;
    } else if (word == "endfacet") {
      if (corners != 3)
        lines.refuse(fmt::format("ends a facet of {} vertices", std::max(corners, 0)), "three");
      const int last = static_cast<int>(read.points.size()) - 1;
      read.triangles.emplace_back(last - 2, last - 1, last);
      corners = -1;
    } else if (word != "solid" && word != "endsolid" && word != "outer" && word != "endloop") {
      lines.refuse(fmt::format("begins with '{}'", short_word(word)),
                   "the words of an ASCII STL file");
    }
  }
  if (corners >= 0) lines.refuse("ends inside a facet", "a whole file");
  read.facets.resize(read.triangles.size());
  std::iota(read.facets.begin(), read.facets.end(), 1);
  return read;
}

constexpr std::size_t stl_head = 84, stl_facet = 50;  // [bytes]

template <class Number>
Number number_at(const std::string& bytes, std::size_t place) {
  Number number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// Recognises binary STL by its length; the first word is no proof: some programs begin binary
/// files with "solid".
bool is_binary_stl(const std::string& bytes) {
  return bytes.size() >= stl_head &&
         bytes.size() == stl_head + stl_facet * std::size_t(number_at<std::uint32_t>(bytes, 80));
}

MeshFacets read_binary_stl(const std::string& path, const std::string& bytes) {
  MeshFacets read;
  const int count = static_cast<int>((bytes.size() - stl_head) / stl_facet);
  for (int facet = 0; facet < count; ++facet) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      // a normal, three corners and two bytes of attributes
      const std::size_t place =
          stl_head + stl_facet * static_cast<std::size_t>(facet) + 12 * (corner + 1);
      Vector3 point;
      for (int k = 0; k < 3; ++k)
        point[k] = number_at<float>(bytes, place + 4 * static_cast<std::size_t>(k));
      if (!std::all_of(point.begin(), point.end(), is_coordinate))
        throw InputError(fmt::format("{}, facet {}", path, facet + 1),
                         fmt::format("has a corner at {} {} {}", point.x(), point.y(), point.z()),
                         fmt::format("numbers up to {:g}", largest_mesh_coordinate),
                         "export the mesh again");
      read.points.push_back(point);
    }
    read.triangles.emplace_back(3 * facet, 3 * facet + 1, 3 * facet + 2);
    read.facets.push_back(facet + 1);
  }
  return read;
}

/// Number of a point from "7", "7/1/3" or "-1", which is counted back from the last point.
int obj_point(const MeshLines& lines, std::string_view word, std::size_t points) {
  const std::string_view digits = word.substr(0, word.find('/'));
  long number = 0;
  const bool whole = parse(digits, number);
  const long index = number < 0 ? static_cast<long>(points) + number : number - 1;
  if (!whole || index < 0 || index >= static_cast<long>(points))
    lines.refuse(fmt::format("has '{}' as a corner", short_word(word)),
                 fmt::format("the number of a vertex above, 1 to {}", points));
  return static_cast<int>(index);
}

MeshFacets read_obj(const std::string& path, const std::string& text) {
  MeshFacets read;
  MeshLines lines(path, text);
  for (int facet = 0; lines.next();) {
    const std::vector<std::string_view>& words = lines.words();
    if (words[0] == "v") read.points.push_back(lines.point());
    if (words[0] != "f") continue;
    if (words.size() < 4) lines.refuse("has a facet of fewer than three corners", "three or more");
    ++facet;
    std::vector<int> corners;
    for (std::size_t n = 1; n < words.size(); ++n)
      corners.push_back(obj_point(lines, words[n], read.points.size()));
    read.add_polygon(corners, facet);
  }
  return read;
}

/// Points that are equal to the last digit first: a file has each about six times.
SolidMesh welded(const std::string& path, const MeshFacets& read) {
  const auto less = [&](int a, int b) {
    const Vector3 &p = read.points[static_cast<std::size_t>(a)],
                  &q = read.points[static_cast<std::size_t>(b)];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::vector<int> order(read.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), less);
  std::vector<int> distinct(order.size());  // of each point
  std::vector<int> firsts;
  for (const int point : order) {
    if (firsts.empty() || less(firsts.back(), point)) firsts.push_back(point);
    distinct[static_cast<std::size_t>(point)] = static_cast<int>(firsts.size()) - 1;
  }
  Matrix3X x(3, static_cast<Eigen::Index>(firsts.size()));
  for (std::size_t n = 0; n < firsts.size(); ++n)
    x.col(static_cast<Eigen::Index>(n)) = read.points[static_cast<std::size_t>(firsts[n])];
  const double size = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  const std::vector<int> weld = weld_nodes(x, Vector3::Zero(), solid_mesh_tolerance * size);

  // Nodes that a triangle has, in the order of the file.
  SolidMesh mesh;
  mesh.file = path;
  mesh.facets = read.facets;
  std::vector<int> number(firsts.size(), -1), kept;
  for (const Vector3i& triangle : read.triangles)
    mesh.surface.triangles.push_back(triangle.unaryExpr([&](int point) {
      const int node = weld[static_cast<std::size_t>(distinct[static_cast<std::size_t>(point)])];
      int& named = number[static_cast<std::size_t>(node)];
      if (named < 0) {
        named = static_cast<int>(kept.size());
        kept.push_back(node);
      }
      return named;
    }));
  mesh.surface.resize(kept.size());
  mesh.surface.x = x(Eigen::all, kept);
  return mesh;
}

}  // namespace

void MeshFacets::add_polygon(const std::vector<int>& corners, int facet) {
  for (std::size_t n = 2; n < corners.size(); ++n) {
    triangles.emplace_back(corners[0], corners[n - 1], corners[n]);
    facets.push_back(facet);
  }
}

SolidMesh mesh_of_facets(const std::string& path, const MeshFacets& read) {
  if (read.triangles.empty())
    throw InputError(path, "has no facets", "the mesh of a solid", "export the mesh again");
  if (read.triangles.size() > maximum_facets)
    throw InputError(path, fmt::format("has {} facets", read.triangles.size()),
                     fmt::format("at most {}", maximum_facets), "export a coarser mesh");
  return welded(path, read);
}

SolidMesh read_mesh_file(const std::string& path) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  if (ending != ".stl" && ending != ".obj" && ending != ".vtp")
    throw InputError(path, "is no mesh file by its name", "names that end in .stl, .obj or .vtp",
                     "export the mesh in one of these formats; 'furrow-tyre mesh FILE' converts "
                     "others, such as PLY and DAE");
  MeshFacets read;
  if (ending == ".vtp") {
    read_input_bytes(path, mesh_kind, largest_mesh_file);  // refuses what is no file
    read = read_vtp(path);
  } else if (ending == ".obj") {
    read = read_obj(path, read_input_text(path, mesh_kind, largest_mesh_file));
  } else {
    std::string bytes = read_input_bytes(path, mesh_kind, largest_mesh_file);
    if (is_binary_stl(bytes)) {
      read = read_binary_stl(path, bytes);
    } else if (bytes.compare(0, 5, "solid") == 0) {
      read = read_ascii_stl(path, text_of_bytes(std::move(bytes), path, mesh_kind));
    } else {
      throw InputError(path, "is no STL file",
                       fmt::format("text that begins with 'solid', or {} bytes and {} for each "
                                   "facet",
                                   stl_head, stl_facet),
                       "the file may be cut short: export the mesh again");
    }
  }
  return mesh_of_facets(path, read);
}

}  // namespace furrow
