// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/vtk_file.h"

#include <gmock/gmock.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>

#include "furrow/io/files/replace_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::vtk_file_test {
namespace {

using test::error_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Surface tetrahedron() {
  Surface surface;
  surface.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  surface.resize(4);
  surface.x << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  surface.v = 2.0 * surface.x;
  surface.f = -3.0 * surface.x;
  return surface;
}

Grains two_grains() {
  Grains grains;
  grains.resize(2);
  grains.id = {12, 4};
  grains.x << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
  grains.v << 1, 2, 3, 4, 5, 6;
  grains.radius << 0.01, 0.02;
  return grains;
}

vtkSmartPointer<vtkPolyData> read(const std::string& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

Vector3 tuple(vtkDataArray* array, vtkIdType i) {
  return Eigen::Map<const Vector3>(array->GetTuple3(i));
}

TEST(VtkFile, SurfaceIsReadBackExactly) {
  const Scratch scratch;
  const std::string path = scratch.path("surface.vtp");
  const Surface surface = tetrahedron();
  write_vtp(path, surface);
  const auto data = read(path);
  ASSERT_EQ(data->GetNumberOfPoints(), 4);
  ASSERT_EQ(data->GetNumberOfPolys(), 4);
  for (vtkIdType i = 0; i < 4; ++i) {
    EXPECT_EQ(tuple(data->GetPoints()->GetData(), i), Vector3(surface.x.col(i)));
    EXPECT_EQ(tuple(data->GetPointData()->GetArray("velocity"), i), Vector3(surface.v.col(i)));
    EXPECT_EQ(tuple(data->GetPointData()->GetArray("force"), i), Vector3(surface.f.col(i)));
    vtkIdType count;
    const vtkIdType* nodes;
    data->GetPolys()->GetCellAtId(i, count, nodes);
    ASSERT_EQ(count, 3);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(nodes[k], surface.triangles[std::size_t(i)][k]);
  }
}

TEST(VtkFile, GrainsCarryIdRadiusVelocityAndDisplacement) {
  const Scratch scratch;
  const std::string path = scratch.path("grains.vtp");
  const Grains reference = two_grains();
  Grains moved = reference;
  moved.x.col(1) += Vector3(0, 0, -0.125);
  write_vtp(path, moved, &reference);
  const auto data = read(path);
  ASSERT_EQ(data->GetNumberOfVerts(), 2);
  EXPECT_EQ(data->GetPointData()->GetArray("id")->GetTuple1(0), 12);
  EXPECT_EQ(data->GetPointData()->GetArray("radius")->GetTuple1(1), 0.02);
  EXPECT_EQ(tuple(data->GetPointData()->GetArray("velocity"), 1), Vector3(2, 4, 6));
  EXPECT_NEAR(data->GetPointData()->GetArray("displacement")->GetTuple3(1)[2], -0.125, 1e-15);

  write_vtp(path, moved);
  EXPECT_EQ(read(path)->GetPointData()->GetArray("displacement"), nullptr);
}

TEST(VtkFile, FailedWriteLeavesNoFileAndNamesThePath) {
  const Scratch scratch;
  write_vtp(scratch.path("surface.vtp"), tetrahedron());
  EXPECT_FALSE(std::filesystem::exists(scratch.path("surface.part.vtp")));
  vtkObject::GlobalWarningDisplayOff();
  const std::string path = scratch.path("no/such/folder.vtp");
  EXPECT_THAT(error_of([&] { write_vtp(path, tetrahedron()); }),
              HasSubstr(path + ": cannot be written"));
  vtkObject::GlobalWarningDisplayOn();
}

TEST(VtkSeries, ListsFramesAndContinuesAfterARestart) {
  const Scratch scratch;
  const std::string folder = scratch.path("vtk");
  {
    VtkSeries series = VtkSeries::create(folder, "wheel");
    // valid before the first frame
    EXPECT_THAT(read_text_file(series.pvd()), HasSubstr("</VTKFile>"));
    for (double time : {0.0, 0.1, 0.2, 0.3}) series.add(time, tetrahedron());
    EXPECT_THAT(error_of([&] { series.add(0.3, tetrahedron()); }),
                HasSubstr("a frame of t = 0.3 s follows one of t = 0.3 s"));
  }
  VtkSeries series = VtkSeries::resume(folder, "wheel", 0.2);
  EXPECT_THAT(series.times(), ElementsAre(0.0, 0.1, 0.2));
  series.add(0.25, tetrahedron());
  const std::string pvd = read_text_file(series.pvd());
  EXPECT_THAT(pvd, HasSubstr("timestep=\"0.25\" part=\"0\" file=\"wheel_000003.vtp\""));
  EXPECT_THAT(VtkSeries::resume(folder, "wheel", 9.0).times(), ElementsAre(0.0, 0.1, 0.2, 0.25));
  EXPECT_EQ(read(scratch.path("vtk/wheel_000003.vtp"))->GetNumberOfPolys(), 4);
}

TEST(VtkSeries, MissingSeriesCannotBeContinued) {
  const Scratch scratch;
  EXPECT_THAT(error_of([&] { VtkSeries::resume(scratch.folder(), "wheel", 0.0); }),
              HasSubstr("wheel.pvd: is missing, the series cannot be continued"));
  write_text_file(scratch.path("wheel.pvd"),
                  "<VTKFile><Collection><DataSet file=\"a.vtp\"/></Collection></VTKFile>");
  EXPECT_THAT(error_of([&] { VtkSeries::resume(scratch.folder(), "wheel", 0.0); }),
              HasSubstr("frame 0 lacks 'timestep'"));
}

}  // namespace
}  // namespace furrow::vtk_file_test
