// SPDX-License-Identifier: GPL-2.0-or-later
// furrow-tyre: a tyre at rest, inflated and pressed on a rigid plane: deflection, footprint,
// section, forces, natural modes. furrow-tyre fit: a tyre file from a catalogue, by furrow-post.
// furrow-tyre mesh: a repaired mesh of a wheel.

#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/os.h>

#include "furrow/core/error.h"
#include "end_output.h"
#include "figure.h"
#include "furrow/io/inputs/brick_tyre_file.h"
#include "furrow/io/files/make_folder.h"
#include "furrow/io/results/mode_results.h"
#include "furrow/io/inputs/tyre_file.h"
#include "furrow/io/files/version.h"
#include "furrow/io/formats/vtk_file.h"
#include "mesh_command.h"
#include "number_option.h"
#include "parse_options.h"
#include "furrow/tyre/brick/brick_tyre.h"
#include "furrow/tyre/contact_patch.h"
#include "furrow/tyre/darnell/darnell_tyre.h"

namespace {

using namespace furrow;

// The rim is held or moves up and down only, so these do not matter to a tyre at rest.
const HubParameters rim{{30.0, 1.0, 0.6}, Vector3::Zero()};

/// Arguments of the command line.
struct Request {
  std::string file;
  std::vector<double> pressures;  // [kPa]
  std::vector<double> loads;      // [N]
  std::vector<int> mesh{6, 72};   // elements across and around
  int sections = BrickTyreSettings().sections;
  bool half = false;
  bool direct = false;
  double friction = 0.0;
  double tolerance = SettleOptions().tolerance;
  std::optional<double> rim_stiffness;    // [N m/rad/m]
  std::optional<double> tread_stiffness;  // [N m/rad/m]
  std::vector<double> link;               // [m] axial and radial; empty: the tyre file's
  std::string folder;                     // empty: nothing is written
  int modes = 0;                          // of each state
  bool no_plot = false;
};

constexpr int largest_mode_count = 200;

void declare(CLI::App& app, Request& request) {
  app.set_version_flag("--version", version());
  app.footer(
      "Examples:\n"
      "  furrow-tyre inputs/tyres/p235_75r15.yaml --mesh 4 36 --half --load 6227\n"
      "  furrow-tyre inputs/tyres/p235_75r15.yaml --mesh 4 36 --pressure 20 --folder results/modes "
      "--modes 10\n"
      "  furrow-tyre fit --help\n"
      "  furrow-tyre mesh --help");
  app.add_option("file", request.file, "tyre file (inputs/tyres/*.yaml)")->required();
  app.add_option("--pressure", request.pressures,
                 "inflation pressures [kPa]; by default that of the tyre file")
      ->check(within(Range::closed(0.0, 1e-3 * largest_inflation), "kPa"));
  app.add_option("--load", request.loads,
                 "loads on the plane [N], each applied to the state before")
      ->check(within(Range::positive(), "N"));
  app.add_option("--mesh", request.mesh, "elements across and around")
      ->expected(2)
      ->capture_default_str();
  app.add_option("--sections", request.sections,
                 "round a tyre with a tread of bricks, instead of --mesh")
      ->check(within(Range::closed(12, 1000)))
      ->capture_default_str();
  app.add_flag("--half", request.half, "only half of the tyre, mirrored");
  app.add_flag("--direct", request.direct,
               "solve the sidewall's chain instead of looking it up in a table");
  app.add_option("--friction", request.friction, "coefficient of the plane")
      ->check(within(Range::closed(0.0, 5.0)))
      ->capture_default_str();
  app.add_option("--tolerance", request.tolerance,
                 "largest unbalanced force over the pressure's force on a node")
      ->check(within(Range::closed(1e-9, 0.1)))
      ->capture_default_str();
  app.add_option("--rim-stiffness", request.rim_stiffness, "instead of the tyre file's [N m/rad/m]")
      ->check(within(Range::non_negative(), "N m/rad/m"));
  app.add_option("--tread-stiffness", request.tread_stiffness,
                 "instead of the tyre file's [N m/rad/m]")
      ->check(within(Range::non_negative(), "N m/rad/m"));
  app.add_option("--link", request.link, "instead of the tyre file's: axial and radial [m]")
      ->check(within(Range::closed(-1.0, 1.0), "m"))
      ->expected(2);
  app.add_option("--folder", request.folder,
                 "write shapes (VTK) and contact pressures (CSV) into this folder");
  app.add_option("--modes", request.modes,
                 "so many natural modes of each state, into --folder: table (CSV), shapes (VTK, "
                 "HDF5) and a figure")
      ->needs("--folder")
      ->excludes("--half")
      ->check(within(Range::closed(1, largest_mode_count)));
  app.add_flag("--no-plot", request.no_plot, "leave out the figure of the modes")->needs("--modes");
}

TyreParameters parameters_of(const Request& request) {
  TyreParameters tyre = read_tyre_file(request.file);
  if (request.rim_stiffness) tyre.sidewall.rim_stiffness = *request.rim_stiffness;
  if (request.tread_stiffness) tyre.sidewall.tread_stiffness = *request.tread_stiffness;
  if (!request.link.empty()) tyre.link = {request.link[0], request.link[1]};
  return tyre;
}

DarnellTyreSettings settings_of(const Request& request) {
  DarnellTyreSettings settings;
  settings.across = request.mesh[0];
  settings.around = request.mesh[1];
  settings.half = request.half;
  settings.direct = request.direct;
  // on a plane the tread alone touches, and its nodes' areas are the tread's
  settings.sidewall_rows = 0;
  return settings;
}

// [Pa] largest pressure that a tyre without air carries by its stiffness
constexpr double own_stiffness = 100e3;

constexpr const char* header =
    "pressure_kPa,load_N,deflection_cm,perimeter_area_cm2,nodal_area_cm2,patch_length_cm,"
    "patch_width_cm,mean_pressure_kPa,largest_pressure_kPa,section_width_cm,crown_radius_cm,"
    "lifted_share,sidewall_chord,steps,residual";

/// The line of a tyre at rest, below the header.
/// @param load [N] 0: inflated, without a plane
std::string line(Tyre& tyre, double load, const ContactPatch& patch, const Relaxation& rest) {
  return fmt::format(
      "{:.6g},{:.6g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.6g},{:.3g},{:.4g},"
      "{},{:.2g}",
      1e-3 * tyre.pressure(), load, 100 * (rim.centre.z() - tyre.centre().z()),
      1e4 * patch.perimeter_area, 1e4 * patch.nodal_area, 100 * patch.length, 100 * patch.width,
      1e-3 * patch.mean_pressure, 1e-3 * patch.largest_pressure, 100 * tyre.section_width(),
      100 * tyre.crown_radius(), patch.lifted_share, tyre.largest_sidewall_chord(), rest.steps,
      rest.residual);
}

/// Position from the middle of the footprint and pressure of every tread node that touches.
void write_pressures(const std::string& path, const Tyre& tyre, const RigidPlane& plane) {
  auto file = fmt::output_file(path);
  file.print("x_m,y_m,pressure_Pa,area_m2\n");
  const Matrix3X& x = tyre.surface().x;
  const PrintStress print = print_stress(tyre.surface(), plane);
  for (Eigen::Index n = 0; n < tyre.tread_grid().count(); ++n)
    if (print.pressure[n] > 0.0)
      file.print("{:.6g},{:.6g},{:.6g},{:.6g}\n", x(0, n), x(1, n), print.pressure[n],
                 print.area[n]);
}

/// Prints and writes one state. @param plane null for the inflated tyre
void report(Tyre& tyre, double load, const Relaxation& rest, const RigidPlane* plane,
            const Request& request) {
  const ContactPatch patch = plane ? contact_patch(tyre, *plane) : ContactPatch();
  fmt::print("{}\n", line(tyre, load, patch, rest));
  std::fflush(stdout);
  if (request.folder.empty()) return;
  const std::string name =
      fmt::format("{}/{:.0f}kPa_{:.0f}N", request.folder, 1e-3 * tyre.pressure(), load);
  write_vtp(name + ".vtp", tyre.surface());
  if (plane) write_pressures(name + "_pressure.csv", tyre, *plane);
  if (request.modes > 0)
    write_modes(name, tyre, tyre.natural_modes(plane, request.modes), request.file, load);
}

/// Brings a tyre to rest under a load [N]. @throws StateError with the remedy
Relaxation settle_under(double load, Tyre& tyre, RigidPlane& plane, const SettleOptions& options) {
  tyre.set_load({0.0, 0.0, -load});
  try {
    return tyre.settle(&plane, options);
  } catch (const StateError& error) {
    throw StateError(fmt::format(
        "--load {:.6g} at {:.6g} kPa: the tyre does not come to rest: {}; lower the load, reach "
        "it by several smaller ones, or raise --pressure",
        load, 1e-3 * tyre.pressure(), error.what()));
  }
}

/// @throws StateError that names the pressure
Relaxation inflate(Tyre& tyre, const SettleOptions& options) {
  try {
    return tyre.settle(nullptr, options);
  } catch (const StateError& error) {
    throw StateError(fmt::format(
        "--pressure {:.6g}: the tyre does not come to rest: {}; lower the pressure, or check the "
        "stiffnesses of the tyre file",
        1e-3 * tyre.pressure(), error.what()));
  }
}

/// Inflates a tyre and presses it down under one load after the other.
void press(Tyre& tyre, const Request& request) {
  const SettleOptions options{request.tolerance};
  report(tyre, 0.0, inflate(tyre, options), nullptr, request);
  RigidPlaneParameters floor;
  floor.height = tyre.lowest_tread_height();
  floor.friction = request.friction;
  RigidPlane plane(floor, tyre.surface());
  tyre.release(Coordinate::z);
  for (const double load : request.loads)
    report(tyre, load, settle_under(load, tyre, plane, options), &plane, request);
}

constexpr double minimum_share = 1e-3;  // of the largest load: below, the tyre hardly settles

/// Refuses a load that the pressure and the tyre's own stiffness cannot carry on the area of the
/// tread seen from above, and a load that is tiny compared with it, perhaps in kN.
/// @param width, diameter of the tread [m]
/// @param pressure [Pa]
void check_loads(double width, double diameter, double pressure, const Request& request) {
  const double largest = (pressure + own_stiffness) * width * diameter;
  for (const double load : request.loads)
    if (load > largest || load < minimum_share * largest)
      throw InputError(
          fmt::format("--load, at {:.6g} kPa,", 1e-3 * pressure), fmt::format("is {:.6g} N", load),
          fmt::format("a number in [{:.6g}, {:.6g}] [N], up to width times diameter of the tread "
                      "times the pressure and {:.6g} kPa for the tyre's own stiffness",
                      minimum_share * largest, largest, 1e-3 * own_stiffness),
          "give N, not kN or kg; a large load needs a higher --pressure");
}

/// @param make makes the tyre of the present pressure
template <class Parameters, class Make>
void press_all(Parameters& parameters, double width, double diameter, const Request& request,
               Make make) {
  std::vector<double> pressures = request.pressures;
  if (pressures.empty()) pressures = {1e-3 * parameters.pressure};
  for (const double kilopascal : pressures) check_loads(width, diameter, 1e3 * kilopascal, request);
  if (!request.folder.empty()) make_folder(request.folder);
  fmt::print("{}\n", header);
  for (const double kilopascal : pressures) {
    parameters.pressure = 1e3 * kilopascal;
    auto tyre = make();
    press(tyre, request);
  }
  if (request.modes > 0 && !request.no_plot) draw_figure("modes", request.folder);
}

// Options that only one kind of tyre has
constexpr std::array of_lookup{"--mesh", "--direct", "--rim-stiffness", "--tread-stiffness",
                               "--link"};
constexpr std::array of_bricks{"--sections"};

/// @throws InputError for the first of these options that is given
template <class Names>
void refuse_any(const CLI::App& app, const Names& names, const std::string& tyre,
                const std::string& instead) {
  for (const std::string name : names)
    if (app.count(name) > 0)
      throw InputError(name, "is given for " + tyre + ", which has no such thing", instead,
                       "leave it out");
}

void run(const CLI::App& app, const Request& request) {
  if (is_brick_tyre_file(request.file)) {
    refuse_any(app, of_lookup, "a tyre with a tread of bricks",
               "--sections for its mesh, and values in the tyre file");
    BrickTyreParameters parameters = read_brick_tyre_file(request.file);
    BrickTyreSettings settings;
    settings.sections = request.sections;
    settings.half = request.half;
    press_all(parameters, 2.0 * parameters.tread.end(), 2.0 * parameters.radius(), request, [&] {
      if (const std::string warning = wrinkling(parameters); !warning.empty())
        fmt::print(stderr, "furrow-tyre: warning: {}: {}\n", request.file, warning);
      return BrickTyre(parameters, settings, rim, request.file);
    });
    return;
  }
  refuse_any(app, of_bricks, "a tyre without a tread of bricks", "--mesh for its mesh");
  TyreParameters parameters = parameters_of(request);
  const DarnellTyreSettings settings = settings_of(request);
  press_all(parameters, 2.0 * parameters.tread.half_width, 2.0 * parameters.tread.radius, request,
            [&] { return DarnellTyre(parameters, settings, rim, request.file); });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Brings a tyre to rest: inflated, then pressed on a rigid plane under each load. Prints one "
      "line of comma-separated values for each state; --modes adds its natural modes.",
      "furrow-tyre");
  Request request;
  declare(app, request);
  const std::string command = argc > 1 ? argv[1] : "";
  const bool fit = command == "fit";
  if (command == "mesh") return run_mesh_command(argc - 1, argv + 1);
  if (!fit)
    if (const auto status = parse_options(app, argc, argv)) return *status;
  try {
    if (fit) become_furrow_post({"fit", "tyre"}, argc - 2, argv + 2);
    run(app, request);
    end_output();
  } catch (const std::exception& error) {
    fmt::print(stderr, "furrow-tyre: {}\n", error.what());
    return 1;
  }
  return 0;
}
