// SPDX-License-Identifier: GPL-2.0-or-later
// furrow-resistance: steady sinkage, motion resistance and torque of finished runs, with their
// standard errors. The same code that writes a run's summary; furrow-post resistance calls it.

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/error.h"
#include "io/summary.h"

namespace {

void print_csv_header() {
  fmt::print("folder,steady,begin_s,end_s,distance_m");
  for (const char* name : {"sinkage", "force_z", "resistance_coefficient", "drawbar_pull",
                           "drawbar_coefficient", "drive_torque", "slip"})
    fmt::print(",{0},{0}_error,{0}_steady", name);
  fmt::print("\n");
}

void print_csv(const std::string& folder, const furrow::Resistance& r) {
  fmt::print("{},{},{:.9g},{:.9g},{:.9g}", folder, r.steady ? 1 : 0, r.window.begin, r.window.end,
             r.window.distance);
  for (const furrow::SteadyValue& v : r.values)
    fmt::print(",{:.9g},{:.9g},{}", v.mean, v.standard_error, v.steady ? 1 : 0);
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Steady sinkage, motion resistance and torque of wheel runs, with standard errors by block "
      "averaging."};
  std::vector<std::string> folders;
  std::vector<double> window, distance;
  bool csv = false, write = false;
  app.add_option("results", folders, "results folders, each with a history.h5")->required();
  auto* by_time =
      app.add_option("--window", window, "begin and end [s] instead of the automatic window")
          ->expected(2);
  app.add_option("--distance", distance, "the same by travel [m]")->expected(2)->excludes(by_time);
  app.add_flag("--csv", csv, "one line a folder, comma separated");
  app.add_flag("--write", write, "write summary.txt and summary.json into the folders");
  CLI11_PARSE(app, argc, argv);

  furrow::ResistanceOptions options;
  if (!window.empty()) options.window.from_time = window[0], options.window.to_time = window[1];
  if (!distance.empty())
    options.window.from_distance = distance[0], options.window.to_distance = distance[1];

  int status = 0;
  if (csv) print_csv_header();
  for (const std::string& folder : folders) {
    try {
      const furrow::Summary summary = furrow::summarise(folder, options);
      if (write) furrow::write_summary(folder, summary);
      if (!summary.trouble.empty()) throw furrow::Error(summary.trouble);
      if (csv) {
        print_csv(folder, summary.resistance);
      } else {
        fmt::print("{}\n", furrow::summary_text(summary));
      }
    } catch (const std::exception& error) {
      fmt::print(stderr, "furrow-resistance: {}: {}\n", folder, error.what());
      status = 1;
    }
  }
  return status;
}
