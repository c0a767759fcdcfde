// SPDX-License-Identifier: GPL-2.0-or-later
// furrow-resistance: steady hub drop, resistance and torque of finished runs, with their
// standard errors. The same code that writes a run's summary; furrow-post resistance calls it.

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "furrow/core/error.h"
#include "end_output.h"
#include "furrow/io/results/history_file.h"
#include "furrow/io/results/summary.h"
#include "furrow/io/files/version.h"
#include "number_option.h"
#include "parse_options.h"

namespace {

constexpr const char* quantities[] = {"hub_drop",
                                      "tyre_deflection",
                                      "rut_depth",
                                      "force_z",
                                      "resistance_coefficient",
                                      "drawbar_pull",
                                      "net_traction_coefficient",
                                      "drive_torque",
                                      "slip",
                                      "tractive_force",
                                      "lateral_force",
                                      "overturning_moment",
                                      "aligning_moment",
                                      "force_x",
                                      "force_y"};

void print_csv_header() {
  fmt::print("folder,steady,begin_s,end_s,distance_m");
  for (const char* name : quantities) fmt::print(",{0},{0}_error,{0}_steady", name);
  fmt::print("\n");
}

void print_csv(const std::string& folder, const furrow::Resistance& r) {
  fmt::print("{},{},{:.9g},{:.9g},{:.9g}", folder, r.steady ? 1 : 0, r.window.begin, r.window.end,
             r.window.distance);
  for (const char* name : quantities) {
    if (!r.has(name)) {
      fmt::print(",,,");
      continue;
    }
    const furrow::SteadyValue& v = r.value(name);
    fmt::print(",{:.9g},{:.9g},{}", v.mean, v.standard_error, v.steady ? 1 : 0);
  }
  fmt::print("\n");
}

/// Arguments of the command line.
struct Request {
  std::vector<std::string> folders;
  std::vector<double> window;    // [s] begin and end; empty: found
  std::vector<double> distance;  // [m] the same by travel
  bool together = false;         // the wheels of one vehicle
  bool csv = false;
  int curve = 0;  // stretches
  bool write = false;
};

using furrow::Range;
using furrow::within;

void declare(CLI::App& app, Request& request) {
  app.set_version_flag("--version", furrow::version());
  app.footer(
      "Examples:\n"
      "  furrow-resistance results/tyre_on_snow\n"
      "  furrow-resistance --window 0.62 0.68 results/tyre_on_snow");
  app.add_option("results", request.folders, "results folders, each with a history.h5")->required();
  CLI::Option* by_time =
      app.add_option("--window", request.window,
                     "begin and end of the window [s] instead of the one that is found")
          ->check(within(Range::any(), "s"))
          ->expected(2);
  app.add_option("--distance", request.distance, "the same by travel [m]")
      ->check(within(Range::any(), "m"))
      ->expected(2)
      ->excludes(by_time);
  CLI::Option* together =
      app.add_flag("--together", request.together,
                   "the wheels of one run together: sums, and what their resistance is made of");
  app.add_flag("--csv", request.csv, "one line of comma-separated values for each folder")
      ->excludes(together);
  app.add_option("--curve", request.curve,
                 "the values over so many equal stretches of the cruise, a line of comma-separated "
                 "values for each: the curve of a run with ramps")
      ->check(within(Range::closed(1, 10000), ""))
      ->excludes(by_time)
      ->excludes(together);
  app.add_flag("--write", request.write, "write summary.txt and summary.json into the folders")
      ->excludes(together);
}

furrow::ResistanceOptions options_of(const Request& request) {
  furrow::ResistanceOptions options;
  if (!request.window.empty()) {
    options.window.from_time = request.window[0];
    options.window.to_time = request.window[1];
  }
  if (!request.distance.empty()) {
    options.window.from_distance = request.distance[0];
    options.window.to_distance = request.distance[1];
  }
  return options;
}

void require_history(const std::string& folder) {
  if (folder.empty() ||
      !std::filesystem::is_regular_file(std::filesystem::path(folder) / "history.h5"))
    throw furrow::Error(
        "has no history.h5; name the results folder of a run with fix wheel/history");
}

/// A wheel would be summed twice, or have two rows.
void require_different(const std::vector<std::string>& folders) {
  std::error_code absent;
  for (std::size_t n = 1; n < folders.size(); ++n)
    for (std::size_t m = 0; m < n; ++m)
      if (std::filesystem::equivalent(folders[m], folders[n], absent))
        throw furrow::Error(fmt::format("'{}' and '{}' are one folder; give each folder once",
                                        folders[m], folders[n]));
}

void evaluate(const std::string& folder, const Request& request) {
  require_history(folder);
  if (request.curve > 0) {
    for (const furrow::Resistance& stretch :
         furrow::measure_curve(furrow::read_history(folder + "/history.h5"), request.curve))
      print_csv(folder, stretch);
    return;
  }
  const furrow::Summary summary = furrow::summarise(folder, options_of(request));
  if (request.write) furrow::write_summary(folder, summary);
  if (!summary.trouble.empty()) throw furrow::Error(summary.trouble);
  if (request.csv)
    print_csv(folder, summary.resistance);
  else
    fmt::print("{}\n", furrow::summary_text(summary));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Steady hub drop, resistance and torque of wheel runs, with standard errors by block "
      "averaging.",
      "furrow-resistance");
  Request request;
  declare(app, request);
  if (const auto status = furrow::parse_options(app, argc, argv)) return *status;

  try {
    require_different(request.folders);
  } catch (const furrow::Error& error) {
    fmt::print(stderr, "furrow-resistance: {}\n", error.what());
    return 1;
  }
  int status = 0;
  if (request.csv || request.curve > 0) print_csv_header();
  const auto attempt = [&](const std::string& what, const auto& action) {
    try {
      action();
    } catch (const std::exception& error) {
      fmt::print(stderr, "furrow-resistance: {}: {}\n", what, error.what());
      status = 1;
    }
  };
  for (const std::string& folder : request.folders)
    attempt(folder, [&] {
      if (request.together)
        require_history(folder);
      else
        evaluate(folder, request);
    });
  if (request.together && status == 0)
    attempt("--together", [&] {
      fmt::print("{}\n", furrow::vehicle_text(request.folders, options_of(request)));
    });
  try {
    furrow::end_output();
  } catch (const std::exception& error) {
    fmt::print(stderr, "furrow-resistance: {}\n", error.what());
    status = 1;
  }
  return status;
}
