// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/vtk_file.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "furrow/core/error.h"
#include "furrow/io/formats/mesh_file.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/formats/terrain_fields.h"

namespace furrow {

namespace {

namespace fs = std::filesystem;

/// A copy of the columns of a matrix as an array of n tuples.
template <class Derived>
vtkSmartPointer<vtkDoubleArray> array_of(const char* name,
                                         const Eigen::DenseBase<Derived>& columns) {
  const auto components = Derived::RowsAtCompileTime == 3 ? Eigen::Index(3) : Eigen::Index(1);
  const Eigen::Index tuples = columns.size() / components;
  vtkSmartPointer<vtkDoubleArray> array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(int(components));
  array->SetNumberOfTuples(tuples);
  std::copy_n(columns.derived().data(), columns.size(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkPoints> points_of(const Matrix3X& x) {
  vtkSmartPointer<vtkPoints> points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetData(array_of("Points", x));
  return points;
}

vtkSmartPointer<vtkCellArray> vertices_of(std::size_t points) {
  vtkSmartPointer<vtkCellArray> vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->AllocateExact(vtkIdType(points), vtkIdType(points));
  for (vtkIdType i = 0; i < vtkIdType(points); ++i) vertices->InsertNextCell(1, &i);
  return vertices;
}

void write_poly_data(const std::string& path, vtkPolyData* data) {
  replace_file(path, [&](const std::string& part) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(part.c_str());
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    if (!writer->Write() || fs::is_empty(part))
      throw Error(fmt::format("{}: cannot be written", path));
  });
}

}  // namespace

MeshFacets read_vtp(const std::string& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  MeshFacets read;
  if (!reader->CanReadFile(path.c_str()))
    throw InputError(path, "is no VTP file", "PolyData of VTK in XML", "export the mesh again");
  reader->SetFileName(path.c_str());
  reader->GlobalWarningDisplayOff();
  reader->Update();
  const bool failed = reader->GetErrorCode() != 0;
  reader->GlobalWarningDisplayOn();
  if (failed)
    throw InputError(path, "cannot be read as a VTP file", "PolyData of VTK in XML",
                     "the file may be cut short: export the mesh again");
  vtkPolyData* data = reader->GetOutput();
  for (vtkIdType n = 0; n < data->GetNumberOfPoints(); ++n)
    read.points.emplace_back(data->GetPoint(n)[0], data->GetPoint(n)[1], data->GetPoint(n)[2]);
  vtkNew<vtkIdList> corners;
  for (vtkIdType n = 0; n < data->GetNumberOfPolys(); ++n) {
    data->GetPolys()->GetCellAtId(n, corners);
    read.add_polygon({corners->begin(), corners->end()}, static_cast<int>(n) + 1);
  }
  return read;
}

void write_vtp(const std::string& path, const Surface& surface) {
  write_vtp(path, surface, {{"velocity", surface.v}, {"force", surface.f}});
}

void write_vtp(const std::string& path, const Surface& surface,
               const std::vector<NodeField>& fields) {
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(vtkIdType(surface.triangle_count()),
                           3 * vtkIdType(surface.triangle_count()));
  for (const Vector3i& triangle : surface.triangles) {
    const vtkIdType nodes[3] = {triangle[0], triangle[1], triangle[2]};
    triangles->InsertNextCell(3, nodes);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(surface.x));
  data->SetPolys(triangles);
  for (const NodeField& field : fields)
    data->GetPointData()->AddArray(array_of(field.name.c_str(), field.values));
  write_poly_data(path, data);
}

void write_vtp(const std::string& path, const Grains& grains, const Grains* reference) {
  grains.check();
  vtkNew<vtkIdTypeArray> id;
  id->SetName("id");
  id->SetNumberOfTuples(vtkIdType(grains.size()));
  std::copy(grains.id.begin(), grains.id.end(), id->GetPointer(0));

  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(grains.x));
  data->SetVerts(vertices_of(grains.size()));
  data->GetPointData()->AddArray(id);
  data->GetPointData()->AddArray(array_of("radius", grains.radius));
  data->GetPointData()->AddArray(array_of("velocity", grains.v));
  if (reference)
    data->GetPointData()->AddArray(array_of("displacement", grains.displacement_from(*reference)));
  write_poly_data(path, data);
}

void write_vtp(const std::string& path, const TerrainSnapshot& terrain) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(terrain.x));
  data->SetVerts(vertices_of(terrain.size()));
  data->GetPointData()->AddArray(
      array_of("displacement", Matrix3X(terrain.x - terrain.initial_position)));
  data->GetPointData()->AddArray(array_of("velocity", terrain.v));
  data->GetPointData()->AddArray(array_of("principal_stress", terrain.principal_stress));
  data->GetPointData()->AddArray(array_of("tension_axis", terrain.tension_axis));
  data->GetPointData()->AddArray(array_of("compression_axis", terrain.compression_axis));
  for (const auto& field : scalar_terrain_fields) {
    const std::vector<double>& values = terrain.*field.values;
    data->GetPointData()->AddArray(array_of(
        field.name, Eigen::Map<const VectorX>(values.data(), Eigen::Index(values.size()))));
  }
  write_poly_data(path, data);
}

VtkSeries VtkSeries::create(const std::string& folder, const std::string& name) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw Error(fmt::format("{}: the folder cannot be made ({})", folder, failed.message()));
  VtkSeries series(folder, name);
  series.write_pvd();
  return series;
}

VtkSeries VtkSeries::resume(const std::string& folder, const std::string& name, double time) {
  VtkSeries series(folder, name);
  const std::string path = series.pvd();
  if (!fs::exists(path))
    throw Error(fmt::format("{}: is missing, the series cannot be continued", path));
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection) throw Error(fmt::format("{}: is not a collection of ParaView", path));
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    double frame_time = 0.0;
    const char* file = entry->GetAttribute("file");
    if (!file || !entry->GetScalarAttribute("timestep", frame_time))
      throw Error(fmt::format("{}: frame {} lacks 'timestep' or 'file'", path, i));
    if (frame_time <= time) series.frames_.push_back({frame_time, file});
  }
  series.write_pvd();
  return series;
}

std::string VtkSeries::pvd() const { return (fs::path(folder_) / (name_ + ".pvd")).string(); }

std::vector<double> VtkSeries::times() const {
  std::vector<double> times;
  for (const Frame& frame : frames_) times.push_back(frame.time);
  return times;
}

std::string VtkSeries::next_file(double time) const {
  if (!frames_.empty() && time <= frames_.back().time)
    throw StateError(fmt::format("{}: a frame of t = {:.9g} s follows one of t = {:.9g} s", pvd(),
                                 time, frames_.back().time));
  return fmt::format("{}_{:06d}.vtp", name_, frames_.size());
}

void VtkSeries::list(double time, const std::string& file) {
  frames_.push_back({time, file});
  write_pvd();
}

void VtkSeries::add(double time, const Surface& surface) {
  const std::string file = next_file(time);
  write_vtp((fs::path(folder_) / file).string(), surface);
  list(time, file);
}

void VtkSeries::add(double time, const Grains& grains, const Grains* reference) {
  const std::string file = next_file(time);
  write_vtp((fs::path(folder_) / file).string(), grains, reference);
  list(time, file);
}

void VtkSeries::add(double time, const TerrainSnapshot& terrain) {
  const std::string file = next_file(time);
  write_vtp((fs::path(folder_) / file).string(), terrain);
  list(time, file);
}

void VtkSeries::write_pvd() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const Frame& frame : frames_)
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", frame.time,
                        frame.file);
  text += "  </Collection>\n</VTKFile>\n";
  write_text_file(pvd(), text);
}

}  // namespace furrow
