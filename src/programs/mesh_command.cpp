// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "furrow/bodies/mesh_bodies.h"
#include "furrow/core/error.h"
#include "end_output.h"
#include "furrow/geometry/meshes/solid_mesh.h"
#include "furrow/io/formats/mesh_file.h"
#include "furrow/io/files/replace_file.h"
#include "mesh_import.h"
#include "mesh_repair.h"
#include "number_option.h"
#include "parse_options.h"

namespace furrow {

namespace {

// Shares of the mesh's diagonal
constexpr double merge_share = solid_mesh_tolerance, hole_share = 1.0, detail_share = 1.0 / 120.0;
// LIGGGHTS refuses facets with a corner sharper than 0.057 degrees.
constexpr double sharpest_corner = radians(0.1);

constexpr char all_faults[] = "all faults";  // of the message of check_solid()

struct MeshRequest {
  std::string file, output;
  std::optional<double> merge, hole, detail;
};

void declare(CLI::App& app, MeshRequest& request) {
  app.footer(
      "Examples:\n"
      "  furrow-tyre mesh inputs/meshes/rover_wheel.stl\n"
      "  furrow-tyre mesh wheel.dae -o wheel.obj --hole 0.02");
  app.add_option("file", request.file, "mesh: STL, OBJ, VTP, PLY, DAE")->required();
  app.add_option("-o,--output", request.output, "OBJ file to write, by default FILE_solid.obj");
  const auto length = [&](const char* name, std::optional<double>& value, const char* meaning) {
    app.add_option(name, value, meaning)->check(within(Range::positive()));
  };
  length("--merge", request.merge,
         "corners nearer than this become one, in units of the file; by default 1e-6 of the size");
  length("--hole", request.hole, "largest hole that is closed; by default every one");
  length("--detail", request.detail,
         "gaps narrower than this are bridged where the mesh is wrapped; by default 1/120 of the "
         "size");
}

std::string fault_of(const SolidMesh& mesh) {
  try {
    check_solid(mesh);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// True for a sound mesh without sharp corners, which grains can touch too.
bool is_good(const SolidMesh& mesh) {
  return fault_of(mesh).empty() && mesh.surface.minimum_angle() >= sharpest_corner;
}

std::string obj_text(const Surface& surface) {
  fmt::memory_buffer text;
  for (const auto& x : surface.x.colwise())
    fmt::format_to(std::back_inserter(text), "v {:.9g} {:.9g} {:.9g}\n", x.x(), x.y(), x.z());
  for (const Vector3i& t : surface.triangles)
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return fmt::to_string(text);
}

std::string change(double before, double after) {
  return fmt::format("{:.6g} to {:.6g} ({:+.2g} %)", before, after, 100.0 * (after / before - 1.0));
}

void print_line(const std::string& file, const Surface& surface) {
  fmt::print("fix wheel all wheel/mesh file {} {} mass MASS axle 0 0 HEIGHT\n", file,
             keywords(propose_placement(surface)));
}

/// @return the written mesh, read back
SolidMesh write_repaired(const SolidMesh& mesh, const MeshRequest& request, double size) {
  const std::string part = request.output + ".part.obj";
  std::optional<SolidMesh> written;
  const auto accept = [&](const Surface& surface) {
    write_text_file(part, obj_text(surface));
    written = read_mesh_file(part);
    return is_good(*written);
  };
  try {
    const RepairedMesh repaired = repair_mesh(
        mesh.surface,
        {request.merge.value_or(merge_share * size), request.hole.value_or(hole_share * size),
         request.detail.value_or(detail_share * size)},
        accept);
    for (const std::string& line : repaired.changes) fmt::print("  {}\n", line);
  } catch (...) {
    std::filesystem::remove(part);
    throw;
  }
  std::filesystem::rename(part, request.output);
  return *written;
}

void repair(const MeshRequest& request) {
  const SolidMesh mesh = import_mesh(request.file);
  const auto [lower, upper] = mesh.surface.bounds();
  const double size = (upper - lower).norm();
  const std::string fault = fault_of(mesh);
  fmt::print("{}: {} facets, size {:.4g}\n", request.file, mesh.surface.triangle_count(), size);
  if (!fault.empty())
    fmt::print("  is no solid: {}\n", fault.substr(std::min(fault.find(all_faults), fault.size())));
  const SolidMesh solid = write_repaired(mesh, request, size);
  const double area = mesh.surface.total_area();
  if (fault.empty())
    fmt::print("  volume       {}\n",
               change(mesh.surface.enclosed_volume(), solid.surface.enclosed_volume()));
  else
    fmt::print("  volume       {:.6g}; the file encloses none\n", solid.surface.enclosed_volume());
  fmt::print("  area         {}\n", change(area, solid.surface.total_area()));
  fmt::print("  distance     new corners are up to {:.3g} off the facets of the file\n",
             largest_distance(solid.surface, mesh.surface));
  fmt::print("{}: written, {} facets, sharpest corner {:.2g} degrees\n", request.output,
             solid.surface.triangle_count(), degrees(solid.surface.minimum_angle()));
  print_line(request.output, solid.surface);
}

}  // namespace

int run_mesh_command(int argc, char** argv) {
  CLI::App app(
      "Reads the mesh of a wheel, repairs what keeps it from being a solid, prints what it "
      "changed, "
      "and prints the line of a script.",
      "furrow-tyre mesh");
  MeshRequest request;
  declare(app, request);
  if (const auto status = parse_options(app, argc, argv)) return *status;
  if (request.output.empty())
    request.output =
        std::filesystem::path(request.file).replace_extension().string() + "_solid.obj";
  try {
    repair(request);
    end_output();
  } catch (const std::exception& error) {
    fmt::print(stderr, "furrow-tyre: {}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace furrow
