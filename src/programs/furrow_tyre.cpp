// SPDX-License-Identifier: GPL-2.0-or-later
// furrow-tyre: a tyre at rest, inflated and pressed on a rigid plane: deflection, footprint,
// section, forces.

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/os.h>

#include "core/error.h"
#include "io/tyre_file.h"
#include "io/vtk_file.h"
#include "tyre/contact_patch.h"

namespace {

using namespace furrow;

/// One line of results; the unloaded inflated tyre has load 0.
struct Row {
  double pressure = 0.0, load = 0.0, deflection = 0.0, width = 0.0, radius = 0.0, chord = 0.0,
         residual = 0.0;
  long steps = 0;
  ContactPatch patch;
};

constexpr const char* header =
    "pressure_kPa,load_N,deflection_cm,perimeter_area_cm2,nodal_area_cm2,patch_length_cm,patch_"
    "width_cm,mean_pressure_kPa,"
    "largest_pressure_kPa,section_width_cm,crown_radius_cm,lifted_share,sidewall_chord,steps,"
    "residual";

std::string line(const Row& r) {
  const ContactPatch& p = r.patch;
  return fmt::format(
      "{:.6g},{:.6g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.6g},{:.3g},{:.4g},{"
      "},{:.2g}",
      1e-3 * r.pressure, r.load, 100 * r.deflection, 1e4 * p.perimeter_area, 1e4 * p.nodal_area,
      100 * p.length, 100 * p.width, 1e-3 * p.mean_pressure, 1e-3 * p.largest_pressure,
      100 * r.width, 100 * r.radius, p.lifted_share, r.chord, r.steps, r.residual);
}

double crown_radius(const DarnellTyre& tyre) {
  double sum = 0.0;
  const int n = tyre.settings().around, middle = tyre.settings().half ? 0 : tyre.rows() / 2;
  for (int i = 0; i < n; ++i) {
    const Vector3 arm = tyre.tread().x.col(tyre.tread_node(i, middle)) - tyre.centre();
    sum += std::hypot(arm.x(), arm.z()) / n;
  }
  return sum;
}

/// Position from the middle of the footprint and pressure of every touching tread node.
void write_pressures(const std::string& path, const DarnellTyre& tyre, const RigidPlane& plane) {
  auto file = fmt::output_file(path);
  file.print("x_m,y_m,pressure_Pa,area_m2\n");
  for (Eigen::Index n = 0; n < tyre.tread().count(); ++n)
    if (plane.pressure()[n] > 0.0)
      file.print("{:.6g},{:.6g},{:.6g},{:.6g}\n", tyre.tread().x(0, n), tyre.tread().x(1, n),
                 plane.pressure()[n], plane.area()[n]);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Brings a tyre to rest: inflated, then pressed on a rigid plane under each load. One comma "
      "separated line a state."};
  std::string path, folder;
  std::vector<double> pressures, loads, link;
  std::vector<int> mesh{6, 72};
  double tolerance = 1e-3, friction = 0.0, rim_stiffness = -1.0, tread_stiffness = -1.0;
  bool half = false, direct = false;
  app.add_option("file", path, "tyre file")->required();
  app.add_option("--pressure", pressures,
                 "inflation pressures [kPa]; by default that of the tyre file");
  app.add_option("--load", loads, "loads [N], each from the one before");
  app.add_option("--mesh", mesh, "elements across and around")->expected(2)->capture_default_str();
  app.add_flag("--half", half, "only half of the tyre, mirrored");
  app.add_flag("--direct", direct, "solve the sidewall's chain instead of looking it up");
  app.add_option("--friction", friction, "of the plane")->capture_default_str();
  app.add_option("--tolerance", tolerance,
                 "largest unbalanced force over the pressure's force on a node")
      ->capture_default_str();
  app.add_option("--rim-stiffness", rim_stiffness, "instead of the tyre file's [N m/rad/m]");
  app.add_option("--tread-stiffness", tread_stiffness, "instead of the tyre file's [N m/rad/m]");
  app.add_option("--link", link, "instead of the tyre file's: axial and radial [m]")->expected(2);
  app.add_option("--folder", folder, "writes shapes (VTK) and contact pressures (CSV) here");
  CLI11_PARSE(app, argc, argv);

  try {
    TyreParameters parameters = read_tyre_file(path);
    if (rim_stiffness >= 0.0) parameters.sidewall.rim_stiffness = rim_stiffness;
    if (tread_stiffness >= 0.0) parameters.sidewall.tread_stiffness = tread_stiffness;
    if (!link.empty()) parameters.link = {link[0], link[1]};
    if (pressures.empty()) pressures = {1e-3 * parameters.pressure};
    if (!folder.empty()) std::filesystem::create_directories(folder);
    DarnellTyreSettings settings;
    settings.across = mesh[0];
    settings.around = mesh[1];
    settings.half = half;
    settings.direct = direct;
    // on a plane the tread alone touches, and its nodes' areas are the tread's
    settings.sidewall_points = 0;
    fmt::print("{}\n", header);
    for (const double kilopascal : pressures) {
      parameters.pressure = 1e3 * kilopascal;
      DarnellTyre tyre(parameters, settings, {{30.0, 1.0, 0.6}, Vector3::Zero()}, path);
      const SettleOptions options{tolerance};
      RigidPlaneParameters plane_parameters;
      plane_parameters.friction = friction;
      const auto report = [&](double load, const Relaxation& relaxation, const RigidPlane* plane,
                              double from) {
        Row row{parameters.pressure,
                load,
                from - tyre.centre().z(),
                tyre.section_width(),
                crown_radius(tyre),
                tyre.largest_sidewall_chord(),
                relaxation.residual,
                relaxation.steps,
                {}};
        if (plane) row.patch = contact_patch(tyre, *plane);
        fmt::print("{}\n", line(row));
        std::fflush(stdout);
        if (folder.empty()) return;
        const std::string name = fmt::format("{}/{:.0f}kPa_{:.0f}N", folder, kilopascal, load);
        write_vtp(name + ".vtp", tyre.surface());
        if (plane) write_pressures(name + "_pressure.csv", tyre, *plane);
      };
      report(0.0, tyre.settle(nullptr, options), nullptr, 0.0);
      plane_parameters.height = tyre.tread().x.row(2).minCoeff();
      RigidPlane plane(plane_parameters, tyre.surface());
      tyre.release(WheelHub::z);
      for (const double load : loads) {
        tyre.set_load({0.0, 0.0, -load});
        report(load, tyre.settle(&plane, options), &plane, 0.0);
      }
    }
  } catch (const furrow::Error& error) {
    fmt::print(stderr, "furrow-tyre: {}\n", error.what());
    return 1;
  }
  return 0;
}
