// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/point_results.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "furrow/core/error.h"
#include "furrow/io/formats/csv_file.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/files/make_folder.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/files/version.h"

namespace furrow {

namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

/// Text of a share of 1: 4.5e-05 is "0.0045 %".
std::string percent(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

/// Text of a pressure: 1.3e6 Pa is "1.3 MPa", with four digits.
std::string pascals(double value) {
  const double size = std::abs(value);
  if (size >= 1e9) return fmt::format("{:.4g} GPa", value * 1e-9);
  if (size >= 1e6) return fmt::format("{:.4g} MPa", value * 1e-6);
  if (size >= 1e3) return fmt::format("{:.4g} kPa", value * 1e-3);
  return fmt::format("{:.4g} Pa", value);
}

std::vector<double> column_of(const PointChannel& channel, const PointHistory& history) {
  std::vector<double> values;
  for (const PointRecord& record : history.records) values.push_back(channel.value(record));
  return values;
}

std::string run_text(const PointRun& run) {
  std::string title = run.title;
  for (std::size_t at = 0; (at = title.find('\'', at)) != std::string::npos; at += 2)
    title.insert(at, 1, '\'');
  return fmt::format("title: '{}'\nmaterial: material.yaml\n{}", title, run.path_text);
}

}  // namespace

void write_point_run(const std::string& folder, const PointRun& run, const Material& material,
                     const PointHistory& history) {
  make_folder(folder);
  const auto in_folder = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  write_text_file(in_folder("material.yaml"),
                  material_file_text(run.material.title, run.material.model, run.material.options));
  write_text_file(in_folder("run.yaml"), run_text(run));

  const std::vector<PointChannel> channels = point_channels(material);
  std::vector<std::string> names, comments{fmt::format("{} (furrow {})", run.title, version())};
  std::vector<std::vector<double>> columns;
  for (const PointChannel& channel : channels) {
    names.push_back(channel.name);
    columns.push_back(column_of(channel, history));
    comments.push_back(
        fmt::format("{}: {}", with_unit(channel.name, channel.unit), channel.meaning));
  }
  write_text_file(in_folder("point.csv"), csv_text(comments, names, columns));

  replace_file(in_folder("point.h5"), [&](const std::string& part) {
    Hdf5File file(part, Hdf5File::Mode::create);
    file.create_group("/point");
    for (const auto& [name, value] :
         {std::pair{"title", run.title}, std::pair{"law", material.name()},
          std::pair{"material", run.material.title}, std::pair{"path", run.path.type},
          std::pair{"version", version()}})
      file.set_attribute("/point", name, value);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const std::string dataset = "/point/" + channels[c].name;
      file.write(dataset, columns[c]);
      file.set_attribute(dataset, "unit", channels[c].unit);
      file.set_attribute(dataset, "meaning", channels[c].meaning);
    }
    file.create_group("/yield_surface");
    int number = 0;
    for (const PointRecord& record : history.records) {
      const bool ends = record.segment == 0 ||
                        record.step == run.path.segments[std::size_t(record.segment) - 1].steps;
      const std::vector<Vector2> line =
          ends ? material.yield_surface(record.state) : std::vector<Vector2>{};
      if (line.empty()) continue;
      std::vector<double> p, q;
      for (const Vector2& point : line) p.push_back(point.x()), q.push_back(point.y());
      const std::string group = fmt::format("/yield_surface/{}", number++);
      file.write(group + "/p", p);
      file.write(group + "/q", q);
      file.set_attribute(group, "segment", double(record.segment));
    }
    file.close();
  });
}

std::string run_report(const PointRun& run, const Material& material, const PointHistory& history,
                       const StepError* error) {
  const PointRecord& last = history.records.back();
  const Invariants end = invariants(stress_of(last.state));
  double max_p = end.p, max_q = end.q, max_density = 0.0;
  for (const PointRecord& record : history.records) {
    const Invariants now = invariants(stress_of(record.state));
    max_p = std::max(max_p, now.p);
    max_q = std::max(max_q, now.q);
    max_density = std::max(max_density, material.current_density(record.state));
  }
  const PointCost& cost = history.cost;
  std::string text = fmt::format(
      "{}\n  material      {} ({})\n  path          {}, {} segment(s), {} steps\n", run.title,
      run.material.title, material.name(), run.path.type, run.path.segments.size(), cost.steps);
  text += fmt::format(
      "  reached       p = {}, q = {}, density {:.5g} kg/m3, volume strain {:.5g} (compression "
      "positive)\n",
      pascals(end.p), pascals(end.q), material.current_density(last.state),
      -std::log(last.state[field::volume_ratio]));
  text +=
      fmt::format("  stress        xx {}, yy {}, zz {}, xy {}, yz {}, xz {} (tension positive)\n",
                  pascals(last.state[0]), pascals(last.state[1]), pascals(last.state[2]),
                  pascals(last.state[3]), pascals(last.state[4]), pascals(last.state[5]));
  text += fmt::format("  largest       p = {}, q = {}, density {:.5g} kg/m3\n", pascals(max_p),
                      pascals(max_q), max_density);
  std::vector<std::string> branches;
  for (std::size_t b = 0; b < branch_count; ++b)
    if (cost.updates.points[b] > 0)
      branches.push_back(
          fmt::format("{} {}", to_string(static_cast<Branch>(b)), cost.updates.points[b]));
  text += fmt::format("  updates       {}\n", fmt::join(branches, ", "));
  if (cost.updates.beyond_data > 0)
    text +=
        fmt::format("  WARNING       {} updates were beyond the hardening data, by extrapolation\n",
                    cost.updates.beyond_data);
  if (cost.updates.beyond_ice > 0 && material.density() < ice_density)
    text += fmt::format("  WARNING       {} updates were denser than ice ({} kg/m3)\n",
                        cost.updates.beyond_ice, ice_density);
  text += fmt::format(
      "  control       {} Newton iterations (most {} a step), {} step(s) cut, largest residual "
      "{:.1e} of the step's "
      "stress\n",
      cost.newton_iterations, cost.max_newton_iterations, cost.cuts, cost.largest_residual);
  if (!error)
    return text + "  step error    not known: with halved steps the path could not be followed\n";
  text += fmt::format(
      "  step error    p {}, q {}, volume strain {:.1e}: change at the segments' ends when every "
      "step is halved\n",
      percent(error->p), percent(error->q), error->eps_vol);
  return text;
}

nlohmann::ordered_json finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

std::string measured_description(const std::vector<MeasuredColumn>& columns) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const MeasuredColumn& column : columns) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (const double value : column.values) values.push_back(finite(value));
    json.push_back({{"heading", column.heading},
                    {"name", column.name},
                    {"unit", column.unit},
                    {"si", column.si},
                    {"values", values}});
  }
  return json.dump();
}

std::string fit_description(const PointFit& fit) {
  nlohmann::ordered_json json;
  json["title"] = fit.title;
  json["material"] = fit.material.title;
  json["law"] = fit.material.model.name;
  json["warnings"] = fit.material.warnings;
  for (const FitParameter& parameter : fit.parameters)
    json["parameters"].push_back({{"name", parameter.name()},
                                  {"unit", parameter.unit()},
                                  {"start", parameter.start()},
                                  {"lower", finite(parameter.lower())},
                                  {"upper", finite(parameter.upper())}});
  const auto material = fit.material.make();
  for (const FitCurve& curve : fit.curves) {
    nlohmann::ordered_json measured;
    for (const double value : curve.measured) measured.push_back(finite(value));
    const PointChannel channel = find_point_channel(*material, curve.channel);
    json["curves"].push_back({{"name", curve.name},
                              {"path", curve.path.type},
                              {"driven_by", with_unit(curve.driven_by, curve.driven_unit)},
                              {"driven", curve.driven},
                              {"channel", channel.name},
                              {"compared", with_unit(channel.name, channel.unit)},
                              {"measured", measured},
                              {"relative", curve.relative},
                              {"deviation", curve.deviation}});
  }
  return json.dump();
}

std::string channel_values(const Material& material, const PointHistory& history) {
  nlohmann::ordered_json json;
  for (const PointChannel& channel : point_channels(material))
    json[channel.name] = column_of(channel, history);
  return json.dump();
}

std::string fitted_material(const PointFit& fit, const MaterialSections& sections) {
  return nlohmann::json(material_file_text(fit.material.title + ", fitted: " + fit.title,
                                           fit.material.model,
                                           read_sections(fit.material.model, sections)))
      .dump();
}

}  // namespace furrow
