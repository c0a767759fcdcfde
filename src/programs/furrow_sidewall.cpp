// SPDX-License-Identifier: GPL-2.0-or-later
/// furrow-sidewall: the sidewall of a tyre file, solved and looked up: printed, tabulated and
/// drawn.

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "figure.h"
#include "io/sidewall_cache.h"
#include "io/sidewall_results.h"
#include "io/tyre_file.h"
#include "io/version.h"

namespace {

struct Wishes {
  std::string input, output;
  std::optional<double> pressure;  // [Pa]
  int nodes = 0;
  bool no_plot = false;
};

void run(const Wishes& wishes) {
  furrow::TyreParameters tyre = furrow::read_tyre_file(wishes.input);
  if (wishes.pressure) tyre.pressure = *wishes.pressure;
  furrow::check(tyre, "furrow-sidewall");
  furrow::SidewallTableGrid grid;
  if (wishes.nodes) {
    grid.chord_nodes = wishes.nodes;
    grid.direction_nodes = std::max(6, wishes.nodes / 2);
    grid.rotation_nodes = std::max(6, wishes.nodes / 4);
  }
  const auto table = furrow::open_sidewall_table(tyre.sidewall, tyre.pressure, grid);
  const furrow::SidewallSurvey survey = furrow::survey_sidewall(tyre, tyre.pressure, *table);
  const std::string folder =
      wishes.output.empty()
          ? (std::filesystem::path("results") / std::filesystem::path(wishes.input).stem()).string()
          : wishes.output;
  furrow::write_sidewall_survey(folder, survey);
  std::cout << furrow::sidewall_report(survey) << "  results       " << folder << '\n';
  if (!wishes.no_plot) furrow::draw_figure("sidewall", folder);
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
  app.require_subcommand(1);

  Wishes wishes;
  CLI::App* run_command =
      app.add_subcommand("run", "survey the sidewall of a tyre file (inputs/tyres/*.yaml)");
  run_command->add_option("file", wishes.input, "a tyre file; furrow-sidewall keys lists its keys")
      ->required();
  run_command->add_option("-p,--pressure", wishes.pressure,
                          "inflation pressure [Pa] instead of the file's");
  run_command
      ->add_option("-n,--nodes", wishes.nodes,
                   "of the table along the chord; half and a quarter as many along its other axes")
      ->check(CLI::Range(6, 200));
  run_command->add_option("-o,--output", wishes.output,
                          "the results folder; results/<name of the file> unless given");
  run_command->add_flag("--no-plot", wishes.no_plot, "no figure");
  CLI::App* keys_command =
      app.add_subcommand("keys", "list the keys of a tyre file with units, ranges and meanings");
  CLI11_PARSE(app, argc, argv);

  try {
    if (*run_command) run(wishes);
    if (*keys_command) list_keys();
  } catch (const std::exception& error) {
    std::cout << std::flush;
    std::cerr << "furrow-sidewall: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
