// SPDX-License-Identifier: GPL-2.0-or-later
/// furrow-point: drives one material point along a path, lists the laws, computes the curves of a
/// fit. furrow-point fit: the fit, by furrow-post.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "end_output.h"
#include "figure.h"
#include "furrow/io/formats/csv_file.h"
#include "furrow/io/results/law_json.h"
#include "furrow/io/inputs/point_file.h"
#include "furrow/io/results/point_results.h"
#include "furrow/io/files/version.h"
#include "furrow/material/registry.h"
#include "parse_options.h"

namespace {

void show_warning(const std::string& warning) {
  std::cerr << "furrow-point: warning: " << warning << '\n';
}

void show_warnings(const furrow::MaterialFile& material) {
  for (const std::string& warning : material.warnings) show_warning(warning);
}

std::string folder_for(const std::string& wish, const std::string& input) {
  return wish.empty()
             ? (std::filesystem::path("results") / std::filesystem::path(input).stem()).string()
             : wish;
}

void run(const std::string& input, const std::string& output, bool plot) {
  const furrow::PointRun run = furrow::read_point_run(input);
  show_warnings(run.material);
  const auto material = run.material.make();
  const furrow::PointHistory history = furrow::drive_point(*material, run.path);
  if (const std::string warning = furrow::strain_warning(history); !warning.empty())
    show_warning(fmt::format("{}: {}", input, warning));
  const std::string folder = folder_for(output, input);
  furrow::write_point_run(folder, run, *material, history);
  std::optional<furrow::StepError> error;
  try {
    error = furrow::step_error(*material, run.path, history);
  } catch (const furrow::StateError&) {
    // The run itself is valid; its report marks the error as unknown.
  }
  std::cout << furrow::run_report(run, *material, history, error ? &*error : nullptr)
            << "  results       " << folder << '\n';
  if (plot) furrow::draw_figure("point", folder);
}

/// A line of curves for a line of parameter values; of "material VALUE ..." a material file, as
/// text of JSON.
std::string answer(const furrow::PointFit& fit, const std::string& line) {
  std::istringstream words(line);
  std::vector<std::string> values{std::istream_iterator<std::string>(words), {}};
  const bool file = !values.empty() && values.front() == "material";
  if (file) values.erase(values.begin());
  const furrow::MaterialSections sections = furrow::sections_with(fit, values);
  if (file) return furrow::fitted_material(fit, sections);
  return fmt::format("{:.17g}", fmt::join(furrow::curves_of(fit, sections), " "));
}

/// A line of output for each line of the input, until it ends.
void answer_lines(const std::function<std::string(const std::string&)>& answer) {
  for (std::string line; std::getline(std::cin, line);) {
    try {
      std::cout << answer(line) << std::endl;
    } catch (const furrow::Error& error) {
      std::string text = error.what();
      std::replace(text.begin(), text.end(), '\n', ' ');
      std::cout << "error: " << text << std::endl;
    }
  }
}

/// Parameter values on the input, curves on the output.
void curves(const std::string& input) {
  const furrow::PointFit fit = furrow::read_point_fit(input);
  std::cout << furrow::fit_description(fit) << std::endl;
  answer_lines([&](const std::string& line) { return answer(fit, line); });
}

/// Names of run files on the input, channels along their paths on the output.
void channels() {
  answer_lines([](const std::string& file) {
    const furrow::PointRun run = furrow::read_point_run(file);
    const auto material = run.material.make();
    return furrow::channel_values(*material, furrow::drive_point(*material, run.path));
  });
}

/// Measurements in SI units for other programs.
/// @param as  "heading=unit" of columns whose kind is known; without, all as their headings have
/// them
void table(const std::string& file, const std::vector<std::string>& as) {
  const furrow::CsvTable table = furrow::CsvTable::read(file);
  std::vector<furrow::MeasuredColumn> columns;
  for (const std::string& text : as) {
    const std::size_t equals = std::min(text.rfind('='), text.size());
    columns.push_back(
        table.measured(text.substr(0, equals), text.substr(std::min(equals + 1, text.size()))));
  }
  std::cout << furrow::measured_description(as.empty() ? table.all_measured() : columns) << '\n';
}

/// The effective values of a material file with its bases.
void show(const std::string& input, bool json, double pressure) {
  const furrow::MaterialFile file = furrow::read_material_file(input);
  if (json) {
    std::cout << furrow::material_json(file, pressure) << '\n';
    return;
  }
  show_warnings(file);
  std::cout << furrow::material_file_text(file.title, file.model, file.options);
}

furrow::MaterialModels laws_named(const std::string& name) {
  if (name.empty()) return furrow::material_models();
  return {furrow::find_material_model(name)};
}

void list_laws(const std::string& name) {
  for (const furrow::MaterialModel& model : laws_named(name)) {
    std::cout << model.name << ": " << model.meaning << '\n';
    for (const furrow::SectionSchema& section : model.sections)
      for (const furrow::SectionChoice& choice : section.choices) {
        const std::string type = section.name == "law" ? model.name : choice.type;
        std::cout << ' ' << section.name << (type.empty() ? "" : ", type: " + type)
                  << (choice.meaning.empty() ? "" : "  (" + choice.meaning + ")") << '\n'
                  << choice.schema.table();
      }
    std::cout << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("One material point of a law: along a path, or fitted to measured curves.",
               "furrow-point");
  app.set_version_flag("--version", furrow::version());
  app.footer(
      "Examples:\n"
      "  furrow-point run inputs/points/mccormick_triaxial.yaml\n"
      "  furrow-point fit inputs/points/fit_abele_gow.yaml -o results/oedometer");
  app.require_subcommand(0, 1);  // CLI11 does not name a word that is none

  std::string input, output, law;
  bool no_plot = false;
  CLI::App* run_command =
      app.add_subcommand("run", "drive a point along the path of a file (inputs/points/*.yaml)");
  run_command->add_option("-o,--output", output,
                          "the results folder; results/<name of the file> unless given");
  run_command->add_flag("--no-plot", no_plot, "no figure");
  app.add_subcommand(
      "fit",
      "fit parameters of a law to measured curves (inputs/points/fit_*.yaml); see fit --help");
  CLI::App* curves_command = app.add_subcommand(
      "curves", "curves of a fit: one line of output for each line of parameter values");
  CLI::App* table_command = app.add_subcommand(
      "table", "columns of a table of measurements in SI units, as one line of JSON");
  table_command->add_option("file", input, "a CSV file")->required();
  std::vector<std::string> as;
  table_command->add_option("--as", as, "columns and their SI units: 'q=Pa', 'strain='");
  for (CLI::App* command : {run_command, curves_command})
    command->add_option("file", input, "a YAML file; furrow-point paths lists its keys")
        ->required();
  CLI::App* channels_command = app.add_subcommand(
      "channels",
      "channels along paths: one line of output for each file named by a line of input");
  CLI::App* laws_command =
      app.add_subcommand("laws", "list the laws with their keys, units, ranges and meanings");
  laws_command->add_option("name", law, "only this law");
  CLI::App* show_command = app.add_subcommand(
      "show", "print the effective values of a material file, with those of its bases");
  show_command->add_option("file", input, "a material file (inputs/materials/*.yaml)")->required();
  bool json = false;
  for (CLI::App* command : {laws_command, show_command})
    command->add_flag("--json", json, "as JSON");
  double pressure = 0.0;
  show_command->add_option("--pressure", pressure,
                           "[Pa] for the elastic constants in JSON; 0 unless given");
  CLI::App* usual_command =
      app.add_subcommand("usual", "print values that soils and snow have, by key, as JSON");
  CLI::App* paths_command = app.add_subcommand("paths", "list the paths and the keys of a fit");
  const bool fit = argc > 1 && std::string(argv[1]) == "fit";
  if (!fit)
    if (const auto status = furrow::parse_options(app, argc, argv)) return *status;
  if (!fit && app.get_subcommands().empty()) {
    std::cerr << "furrow-point: needs one of the commands run, fit, curves, channels, table, laws, "
                 "show, usual or paths; see --help\n";
    return 1;
  }

  try {
    if (fit) furrow::become_furrow_post({"fit", "law"}, argc - 2, argv + 2);
    if (*run_command) run(input, output, !no_plot);
    if (*curves_command) curves(input);
    if (*channels_command) channels();
    if (*table_command) table(input, as);
    if (*laws_command) {
      if (json)
        std::cout << furrow::laws_json(laws_named(law)) << '\n';
      else
        list_laws(law);
    }
    if (*show_command) show(input, json, pressure);
    if (*usual_command) std::cout << furrow::usual_ranges_json() << '\n';
    if (*paths_command) std::cout << furrow::path_tables();
    furrow::end_output();
    return 0;
  } catch (const std::exception& error) {
    std::cout << std::flush;
    std::cerr << "furrow-point: " << error.what() << '\n';
    return 1;
  }
}
