// SPDX-License-Identifier: GPL-2.0-or-later
// furrow-tyre mesh on meshes whose volume is a closed form, each with faults of CAD exports.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "../io/scratch.h"
#include "furrow/geometry/meshes/solid_mesh.h"
#include "furrow/io/formats/mesh_file.h"
#include "tests/support/meshes.h"
#include "tests/support/program.h"

namespace furrow::mesh_command_test {
namespace {

using test::box;
using test::joined;
using testing::HasSubstr;

using Facet = std::vector<Vector3>;

constexpr int corners = 24;
constexpr double radius = 0.2, width = 0.1;
const double disc_volume = 0.5 * corners * radius * radius * std::sin(2.0 * pi / corners) * width;

/// A disc of 24 corners with its axle along y, facet by facet as an STL file has it.
std::vector<Facet> disc() {
  const auto rim = [](int i, double y) {
    const double angle = 2.0 * pi * i / corners;
    return Vector3(radius * std::cos(angle), y, radius * std::sin(angle));
  };
  std::vector<Facet> facets;
  const double side = 0.5 * width;
  for (int i = 0; i < corners; ++i) {
    const Vector3 a = rim(i, -side), b = rim(i + 1, -side), c = rim(i + 1, side), d = rim(i, side);
    facets.insert(
        facets.end(),
        {{a, c, b}, {a, d, c}, {Vector3(0, -side, 0), a, b}, {Vector3(0, side, 0), c, d}});
  }
  return facets;
}

Surface surface_of(const std::vector<Facet>& facets) {
  Surface surface;
  surface.resize(3 * facets.size());
  Eigen::Index node = 0;
  for (const Facet& facet : facets) {
    surface.triangles.emplace_back(node, node + 1, node + 2);
    for (const Vector3& corner : facet) surface.x.col(node++) = corner;
  }
  return surface;
}

class MeshCommand : public testing::Test {
 protected:
  /// Repairs a file. @return what the program printed
  std::string repair(const std::string& file, const std::string& options = "") {
    const test::Outcome outcome =
        test::run_program(FURROW_TYRE " mesh " + file + " -o " + output() + " " + options);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return outcome.text;
  }
  std::string repair(const Surface& surface) {
    test::write_stl(scratch_.path("part.stl"), surface);
    return repair(scratch_.path("part.stl"));
  }
  std::string output() const { return scratch_.path("out.obj"); }
  /// Volume of the written solid.
  double volume() const {
    const SolidMesh mesh = read_mesh_file(output());
    EXPECT_NO_THROW(check_solid(mesh));
    return mesh.surface.enclosed_volume();
  }
  Scratch scratch_;
};

TEST_F(MeshCommand, FacetsWithoutAreaAndDoubledFacetsAreDropped) {
  std::vector<Facet> sliver = disc(), doubled = disc();
  // A corner on an edge, which a facet without area closes.
  const Facet first = sliver.front();
  const Vector3 middle = 0.5 * (first[0] + first[1]);
  sliver.front() = {first[0], middle, first[2]};
  sliver.push_back({middle, first[1], first[2]});
  sliver.push_back({first[0], first[1], middle});
  doubled.push_back({first[0], first[0], first[1]});
  doubled.push_back(first);
  EXPECT_THAT(repair(surface_of(sliver)), HasSubstr("all faults: 1 facets without area"));
  EXPECT_NEAR(volume(), disc_volume, 1e-6 * disc_volume);
  const std::string text = repair(surface_of(doubled));
  EXPECT_THAT(text, HasSubstr("dropped      1 facets whose corners coincide"));
  EXPECT_THAT(text, HasSubstr("dropped      1 doubled facets"));
  EXPECT_NEAR(volume(), disc_volume, 1e-6 * disc_volume);
}

TEST_F(MeshCommand, HolesUpToASizeAreClosed) {
  std::vector<Facet> open = disc();
  open.resize(open.size() - 3);
  test::write_stl(scratch_.path("open.stl"), surface_of(open));
  EXPECT_THAT(repair(scratch_.path("open.stl")), HasSubstr("closed       1 holes"));
  EXPECT_NEAR(volume(), disc_volume, 0.02 * disc_volume);
}

TEST_F(MeshCommand, PartsThatOverlapAreUnited) {
  const std::string text = repair(joined(box(Vector3(0, 0, 0), Vector3(1, 1, 1)),
                                         box(Vector3(0.5, 0.25, 0.25), Vector3(1.5, 0.75, 0.75))));
  EXPECT_THAT(text, HasSubstr("united       2 parts"));
  EXPECT_NEAR(volume(), 1.0 + 0.5 * 0.25, 1e-6);
}

TEST_F(MeshCommand, SolidInsideAnotherIsDropped) {
  const Surface outer = box(Vector3(0, 0, 0), Vector3(1, 1, 1)),
                inner = box(Vector3(0.2, 0.2, 0.2), Vector3(0.8, 0.8, 0.8));
  EXPECT_THAT(repair(joined(outer, inner)), HasSubstr("dropped      1 solids inside others"));
  EXPECT_NEAR(volume(), 1.0, 1e-6);
  repair(joined(outer, test::turned(inner)));
  EXPECT_NEAR(volume(), 1.0 - 0.216, 1e-6);
}

/// Sheets through a solid cannot be united with it.
TEST_F(MeshCommand, UnrepairableMeshIsWrapped) {
  std::vector<Facet> facets = disc();
  for (std::size_t n = 0; n < 8; ++n)  // sheets through the solid
    facets.push_back({Vector3(-0.1, 0, -0.1 + 0.02 * static_cast<double>(n)), Vector3(0.1, 0, 0),
                      Vector3(0.05, 0.04, 0.1)});
  EXPECT_THAT(repair(surface_of(facets)), HasSubstr("wrapped"));
  EXPECT_NEAR(volume(), disc_volume, 0.02 * disc_volume);
}

TEST_F(MeshCommand, PlyAndDaeAreRead) {
  const Surface brick = box(Vector3(-0.5, 0.25, 0), Vector3(0.5, 1.25, 0.5));
  std::string points, facets, positions, indices;
  for (const auto& x : brick.x.colwise()) {
    points += fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
    positions += fmt::format("{} {} {} ", x.x(), x.y(), x.z());
  }
  for (const Vector3i& t : brick.triangles) {
    facets += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    indices += fmt::format("{} {} {} ", t[0], t[1], t[2]);
  }
  repair(scratch_.file("a.ply",
                       "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float "
                       "y\nproperty float z\nelement face 12\nproperty list uchar int "
                       "vertex_indices\nend_header\n" +
                           points + facets));
  EXPECT_NEAR(volume(), 0.5, 1e-6);
  // in millimetres, by the unit of the file
  repair(scratch_.file(
      "a.dae",
      "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
      "version=\"1.4.1\"><asset><unit name=\"millimeter\" "
      "meter=\"0.001\"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry "
      "id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"24\">" +
          positions +
          "</float_array><technique_common><accessor source=\"#a\" count=\"8\" stride=\"3\"><param "
          "name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
          "type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input "
          "semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"12\"><input "
          "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" +
          indices +
          "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
          "<visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/></node></visual_scene>"
          "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>"));
  EXPECT_NEAR(volume(), 0.5e-9, 1e-14);
}

TEST_F(MeshCommand, PrintedLineHasUnitOriginAndAxis) {
  Surface drawn = surface_of(disc());
  drawn.x *= 1000.0;
  drawn.x.row(0).array() += 30.0;
  EXPECT_THAT(repair(drawn), HasSubstr("out.obj scale 0.001 origin 30 0 0 axis 0 1 0 mass MASS"));
}

}  // namespace
}  // namespace furrow::mesh_command_test
