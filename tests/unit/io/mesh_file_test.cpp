// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/mesh_file.h"

#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/io/files/replace_file.h"
#include "furrow/io/formats/vtk_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"
#include "tests/support/meshes.h"

namespace furrow::mesh_file_test {
namespace {

using test::box;
using test::error_of;
using ::testing::HasSubstr;

// Sides that a float holds exactly.
const Surface brick = box(Vector3(-0.5, 0.25, 0), Vector3(1.5, 2.25, 4));

std::string binary_stl(const Surface& surface, const std::string& head) {
  std::string bytes = head;
  bytes.resize(80, ' ');
  const auto put = [&bytes](const auto& number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  put(static_cast<std::uint32_t>(surface.triangle_count()));
  for (const Vector3i& triangle : surface.triangles) {
    for (int k = 0; k < 3; ++k) put(0.0F);
    for (const int node : triangle)
      for (int k = 0; k < 3; ++k) put(static_cast<float>(surface.x(k, node)));
    put(std::uint16_t(0));
  }
  return bytes;
}

/// Eight nodes and the same corners of every facet.
void expect_brick(const SolidMesh& mesh) {
  EXPECT_EQ(mesh.surface.node_count(), 8u);
  ASSERT_EQ(mesh.surface.triangle_count(), 12u);
  for (std::size_t t = 0; t < 12; ++t)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(mesh.surface.x.col(mesh.surface.triangles[t][corner]),
                brick.x.col(brick.triangles[t][corner]))
          << t;
}

TEST(MeshFile, EveryFormatGivesTheSameSurface) {
  const Scratch scratch;
  test::write_stl(scratch.path("a.stl"), brick);
  expect_brick(read_mesh_file(scratch.path("a.stl")));
  // some programs begin binary files as if they were text
  const SolidMesh binary = read_mesh_file(scratch.file("b.STL", binary_stl(brick, "solid brick")));
  expect_brick(binary);
  EXPECT_EQ(binary.facets.back(), 12);

  std::string text = "# brick\r\no brick\r\n";
  for (const auto& x : brick.x.colwise())
    text += fmt::format("v {} {} {} 1\r\n", x.x(), x.y(), x.z());
  for (const Vector3i& t : brick.triangles)
    text += fmt::format("f {}/1/1 {}//2 {}\r\n", t[0] + 1, t[1] - 8, t[2] + 1);
  expect_brick(read_mesh_file(scratch.file("c.obj", text)));

  write_vtp(scratch.path("d.vtp"), brick);
  expect_brick(read_mesh_file(scratch.path("d.vtp")));
}

TEST(MeshFile, PolygonsOfAnObjFileAreDividedAndKeepTheirNumber) {
  const Scratch scratch;
  const std::string file = scratch.file("a.obj",
                                        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\n"
                                        "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  const SolidMesh pyramid = read_mesh_file(file);
  EXPECT_THAT(pyramid.facets, testing::ElementsAre(1, 1, 2, 3, 4, 5));
  EXPECT_NO_THROW(check_solid(pyramid));
  EXPECT_NEAR(pyramid.surface.enclosed_volume(), 1.0 / 3.0, 1e-15);
}

// Corners of neighbours that were rounded to seven digits.
TEST(MeshFile, NodesThatDifferByRoundingAreMerged) {
  const Scratch scratch;
  Surface rounded = brick;
  test::write_stl(scratch.path("a.stl"), rounded);
  const std::string text =
      with(read_text_file(scratch.path("a.stl")), "vertex 1.5", "vertex 1.5000001");
  const SolidMesh mesh = read_mesh_file(scratch.file("a.stl", text));
  EXPECT_EQ(mesh.surface.node_count(), 8u);
  EXPECT_NO_THROW(check_solid(mesh));
}

TEST(MeshFile, BadFilesAreRefusedWithPlaceAndRemedy) {
  const Scratch scratch;
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\n";
  const std::string binary = binary_stl(brick, "binary");
  std::string not_finite = binary;
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(not_finite.data() + 84 + 50 + 12, &infinite, 4);
  const struct {
    const char* name;
    std::string content;
    const char* message;
  } cases[] = {
      {"a.step", "",
       "a.step is no mesh file by its name; allowed: names that end in .stl, .obj or .vtp"},
      {"a.stl", "", "is no STL file; allowed: text that begins with 'solid', or 84 bytes and 50"},
      {"a.stl", binary.substr(0, 300), "is no STL file"},
      {"a.stl", not_finite, "a.stl, facet 2 has a corner at inf"},
      {"a.stl", "solid part\nendsolid part\n", "has no facets; allowed: the mesh of a solid"},
      {"a.stl", "solid part\n" + facet + "vertex 1 1 1\n", "line 9 has a vertex that no facet"},
      {"a.stl", "solid part\nfacet normal 0 0 1\nvertex 1 1 1\nendfacet\n",
       "line 4 ends a facet of 1 vertices; allowed: three"},
      {"a.stl", "solid part\n" + facet + "facet normal 0 0 1\n", "ends inside a facet"},
      {"a.stl", "solid part\nfacet normal 0 0 1\nfacet normal 0 0 1\n",
       "line 3 begins a facet inside a facet"},
      {"a.stl", "solid part\nfacet normal 0 0 1\nvertex 1 1,5 1\n",
       "line 3 has '1,5' as a coordinate; allowed: a number up to 1e+09"},
      {"a.stl", "solid part\nfacet normal 0 0 1\nvertex 1 nan 1\n", "has 'nan' as a coordinate"},
      {"a.stl", "solid part\nfacet normal 0 0 1\nvertex 1 1\n",
       "line 3 has fewer than three coordinates"},
      {"a.stl", "solid part\nfaces 12\n", "line 2 begins with 'faces'"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
       "line 4 has '4' as a corner; allowed: the number of a vertex above, 1 to 3"},
      {"a.obj", "v 0 0 0\nf 1 2\n", "line 2 has a facet of fewer than three corners"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "has '0' as a corner"},
      {"a.obj", "v 0 0 0\n", "has no facets"},
      {"a.vtp", "<VTKFile type=\"ImageData\"/>", "is no VTP file"},
  };
  for (const auto& one : cases) {
    const std::string file = scratch.file(one.name, one.content);
    EXPECT_THAT(error_of<InputError>([&] { read_mesh_file(file); }), HasSubstr(one.message));
  }
  EXPECT_THAT(error_of<InputError>([&] { read_mesh_file(scratch.path("absent.stl")); }),
              HasSubstr("absent.stl does not exist; allowed: a mesh file, STL, OBJ or VTP"));
}

}  // namespace
}  // namespace furrow::mesh_file_test
