// SPDX-License-Identifier: GPL-2.0-or-later
// furrow-sidewall: the sidewall of a tyre file, solved and looked up: printed, tabulated and
// drawn. See furrow_sidewall.md.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "furrow/core/error.h"
#include "end_output.h"
#include "figure.h"
#include "furrow/io/inputs/sidewall_cache.h"
#include "furrow/io/results/sidewall_results.h"
#include "furrow/io/inputs/tyre_file.h"
#include "furrow/io/files/version.h"
#include "number_option.h"
#include "parse_options.h"

namespace {

/// Arguments of the command line.
struct Request {
  std::string input;
  std::string output;              // empty: results/<name of the input>
  std::optional<double> pressure;  // [Pa]
  int nodes = 0;                   // of the table along the chord; 0: the default grid
  bool no_plot = false;
};

void run(const Request& request) {
  furrow::TyreParameters tyre = furrow::read_tyre_file(request.input);
  if (request.pressure) tyre.pressure = *request.pressure;
  furrow::check(tyre, "furrow-sidewall");
  furrow::SidewallTableGrid grid;
  if (request.nodes) {
    grid.chord_nodes = request.nodes;
    grid.direction_nodes = std::max(6, request.nodes / 2);
    grid.rotation_nodes = std::max(6, request.nodes / 4);
  }
  const auto table = furrow::open_sidewall_table(tyre.sidewall, tyre.pressure, grid);
  const furrow::SidewallSurvey survey = furrow::survey_sidewall(tyre, tyre.pressure, *table);
  const std::string folder =
      request.output.empty()
          ? (std::filesystem::path("results") / std::filesystem::path(request.input).stem())
                .string()
          : request.output;
  furrow::write_sidewall_survey(folder, survey);
  std::cout << furrow::sidewall_report(survey) << "  results       " << folder << '\n';
  if (!request.no_plot) furrow::draw_figure("sidewall", folder);
}

void list_keys() {
  for (const auto& [section, schema] : furrow::tyre_schemas())
    std::cout << section << ":\n" << schema.table() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The sidewall of a tyre file: shape, forces and stiffness, solved and looked up.",
               "furrow-sidewall");
  app.set_version_flag("--version", furrow::version());
  app.footer(
      "Examples:\n"
      "  furrow-sidewall run inputs/tyres/p235_75r15.yaml\n"
      "  furrow-sidewall run inputs/tyres/p235_75r15.yaml -p 103e3 -o results/at_103_kPa");
  app.require_subcommand(0, 1);  // CLI11 does not name a word that is none

  Request request;
  CLI::App* run_command =
      app.add_subcommand("run", "survey the sidewall of a tyre file (inputs/tyres/*.yaml)");
  run_command->add_option("file", request.input, "a tyre file; furrow-sidewall keys lists its keys")
      ->required();
  run_command
      ->add_option("-p,--pressure", request.pressure,
                   "inflation pressure [Pa] instead of the file's")
      ->check(furrow::within(furrow::Range::closed(0.0, furrow::largest_inflation), "Pa"));
  run_command
      ->add_option("-n,--nodes", request.nodes,
                   "of the table along the chord; half and a quarter as many along its other axes")
      ->check(CLI::Range(6, 200));
  run_command->add_option("-o,--output", request.output,
                          "the results folder; results/<name of the file> unless given");
  run_command->add_flag("--no-plot", request.no_plot, "no figure");
  CLI::App* keys_command =
      app.add_subcommand("keys", "list the keys of a tyre file with units, ranges and meanings");
  if (const auto status = furrow::parse_options(app, argc, argv)) return *status;
  if (app.get_subcommands().empty()) {
    std::cerr << "furrow-sidewall: needs one of the commands run or keys; see --help\n";
    return 1;
  }

  try {
    if (*run_command) run(request);
    if (*keys_command) list_keys();
    furrow::end_output();
  } catch (const std::exception& error) {
    std::cout << std::flush;
    std::cerr << "furrow-sidewall: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
