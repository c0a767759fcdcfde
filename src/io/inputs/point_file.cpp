// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/point_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/io/formats/csv_file.h"
#include "furrow/io/inputs/input_kind.h"
#include "furrow/material/point/point_driver.h"

namespace furrow {

namespace {

constexpr double maximum_steps = 2e6;  // of a path; half a gigabyte

Schema head_schema(const std::string& subject) {
  Schema schema(subject);
  schema.text("title", "of plots and reports").optional();
  schema.text("material", "a material file, from the folder of this file");
  return schema;
}

Schema parameter_schema() {
  Schema schema("parameter of a fit");
  schema.text("name", "section.key of the material, or section.key[n] for one of a list, n from 1");
  schema.number("start", "", Range::any(), "first value; the material's unless given").optional();
  schema.number("lower", "", Range::any(), "bound, besides the key's own range").optional();
  schema.number("upper", "", Range::any(), "bound, besides the key's own range").optional();
  return schema;
}

Schema curve_schema() {
  Schema schema("curve of a fit");
  schema.text("title", "of plots and reports").optional();
  schema.text("data", "a table of comma-separated values, from the folder of this file");
  schema.choice("scale", {"linear", "log"}, "compare values, or their logarithms")
      .by_default("linear");
  schema
      .number("deviation", "", Range::positive(),
              "standard deviation of a measured value in the unit of its column, of its logarithm "
              "with scale: log; from the scatter unless given")
      .optional();
  return schema;
}

std::string beside(const std::string& file, const std::string& name) {
  return (std::filesystem::path(file).parent_path() / name).lexically_normal().string();
}

std::string title_of(const std::string& path, const Options& head) {
  return head.given("title") ? head.text("title") : std::filesystem::path(path).stem().string();
}

std::string path_type_of(const YamlTree& map) {
  const YamlTree* type = map.find("type");
  std::vector<std::string> names;
  for (const PathType& known : path_types()) names.push_back(known.name);
  const std::string allowed = fmt::format("one of: {}, table", fmt::join(names, ", "));
  if (!type || type->kind != YamlTree::Kind::text)
    throw InputError(fmt::format("{}: path, keyword 'type'", type ? type->origin : map.origin),
                     type ? "is not a word" : "is missing", allowed);
  for (const std::string& name : names)
    if (name == type->text) return name;
  if (type->text != "table")
    throw InputError(fmt::format("{}: path, keyword 'type'", type->origin),
                     fmt::format("is '{}'", type->text), allowed);
  return type->text;
}

/// Errors of a path's builder, which know the key's line or only the path.
template <class Action>
auto in_path(const YamlTree& map, Action action) {
  try {
    return action();
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.find(", line ") < text.find(": ")) throw;
    throw InputError(map.origin + ": " + text);
  }
}

std::string flow_text(const Schema& schema, const Options& options, const std::string& indent,
                      const std::string& separator) {
  std::string text;
  for (const Entry& entry : options.effective()) {
    const bool list = schema.find(entry.key)->kind == Key::Kind::numbers;
    text += fmt::format(list ? "{}{}: [{}]{}" : "{}{}: {}{}", indent, entry.key,
                        fmt::join(entry.values, ", "), separator);
  }
  return text;
}

PointPath checked_length(PointPath path) {
  double steps = 0.0;
  for (const PathSegment& segment : path.segments) steps += segment.steps;
  if (steps > maximum_steps)
    throw InputError(
        fmt::format("path {}", path.type),
        fmt::format("has {:.6g} steps in {} pieces", steps, path.segments.size()),
        fmt::format("at most {:.6g} in all: every one is kept in memory", maximum_steps),
        "lower 'steps'");
  return path;
}

PointPath read_path(const YamlTree& map, std::string* effective) {
  const std::string type = path_type_of(map);
  if (type != "table") {
    const PathType& known = find_path_type(type);
    const Options options = read_map(known.schema, map, {"type"});
    if (effective)
      *effective =
          fmt::format("path:\n  type: {}\n{}", type, flow_text(known.schema, options, "  ", "\n"));
    return in_path(map, [&] { return checked_length(known.build(options)); });
  }
  const Schema path_schema = table_path_schema(), row_schema = table_row_schema();
  const Options options = read_map(path_schema, map, {"type", "rows"});
  std::vector<Options> rows;
  std::string rows_text;
  for (const YamlTree& row :
       map.list("rows",
                "a list of rows with strain_xx ... or stress_xx ... of the components that change")
           .items) {
    rows.push_back(read_map(row_schema, row));
    std::string keys = flow_text(row_schema, rows.back(), "", ", ");
    if (!keys.empty()) keys.resize(keys.size() - 2);
    rows_text += fmt::format("    - {{{}}}\n", keys);
  }
  if (effective)
    *effective = fmt::format("path:\n  type: table\n{}  rows:\n{}",
                             flow_text(path_schema, options, "  ", "\n"), rows_text);
  return in_path(map, [&] { return checked_length(table_path(options, rows)); });
}

/// Reads a map of one key and one text: {density: rho_kgm3}.
std::pair<std::string, const YamlTree*> one_pair(const YamlTree& curve, const std::string& key,
                                                 const std::string& meaning) {
  const YamlTree& map = curve.map(key, meaning);
  if (map.keys.size() != 1 || map.keys.front().second.kind != YamlTree::Kind::text)
    throw InputError(fmt::format("{}: '{}'", map.origin, key), "is not one key with one column",
                     meaning);
  return {map.keys.front().first, &map.keys.front().second};
}

MeasuredColumn column_of(const CsvTable& table, const YamlTree& name, const std::string& si) {
  return in_path(name, [&] { return table.measured(name.text, si); });
}

/// Reads the values that only the sample of this curve has: "sample: {law.e0: 0.58}".
void read_sample(const YamlTree& map, PointFit& fit, const MaterialOptions& values,
                 FitCurve& curve) {
  if (!map.find("sample")) return;
  const YamlTree& sample = map.map("sample", "{section.key: a value that this curve has}");
  in_path(sample, [&] {
    for (const Entry& entry : entries_of(sample)) {
      const auto fitted = [&](const FitParameter& p) { return p.name() == entry.key; };
      const std::string where = fmt::format("sample, '{}'", entry.key);
      if (std::any_of(fit.parameters.begin(), fit.parameters.end(), fitted))
        throw InputError(where, "is a parameter of the fit", "what is not fitted",
                         "remove it from 'parameters' or from 'sample'");
      if (entry.values.size() != 1)
        throw InputError(where, fmt::format("has {} values", entry.values.size()), "one number");
      curve.sample.emplace_back(
          MaterialNumber("sample,", entry.key, fit.material.model, values, fit.sections),
          entry.values.front());
    }
    MaterialSections sections = fit.sections;
    for (const auto& [number, value] : curve.sample) number.put(sections, value);
    make_material(fit.material.model, sections);
  });
}

FitCurve read_curve(const std::string& file, const YamlTree& map, const Material& material) {
  const Options options = read_map(curve_schema(), map, {"sample", "path", "drive", "compare"});
  const CsvTable table =
      in_path(map, [&] { return CsvTable::read(beside(file, options.text("data"))); });
  FitCurve curve;
  curve.name = options.given("title")
                   ? options.text("title")
                   : std::filesystem::path(options.text("data")).parent_path().stem().string();
  curve.relative = options.text("scale") == "log";
  curve.deviation = options.given("deviation") ? options.number("deviation") : 0.0;

  const auto [target, driving] =
      one_pair(map, "drive", "{a list of targets of the path: a column of the data}");
  const auto [channel, measured] =
      one_pair(map, "compare", "{a channel of the point: a column of the data}");
  YamlTree path = map.map("path", "a path without the targets that the data give");
  const PathType* type =
      path_type_of(path) == "table" ? nullptr : &find_path_type(path_type_of(path));
  const Key* key = type ? type->schema.find(target) : nullptr;
  if (!key || key->kind != Key::Kind::numbers) {
    std::vector<std::string> lists;
    for (const Key& known : type ? type->schema.keys() : std::vector<Key>{})
      if (known.kind == Key::Kind::numbers) lists.push_back(known.name);
    throw InputError(
        fmt::format("{}: 'drive'", driving->origin),
        fmt::format("names '{}', no list of targets of this path", target),
        lists.empty()
            ? "a path with a list of targets: hydrostatic, confined, triaxial, simple_shear"
            : fmt::format("{}", fmt::join(lists, ", ")));
  }
  curve.driven = column_of(table, *driving, key->unit).values;
  curve.driven_by = target;
  curve.driven_unit = key->unit;
  const PointChannel compared =
      in_path(*measured, [&, &name = channel] { return find_point_channel(material, name); });
  const MeasuredColumn of_channel = column_of(table, *measured, compared.unit);
  curve.measured = of_channel.values;
  if (!curve.relative) curve.deviation *= of_channel.factor;
  YamlTree targets;
  targets.kind = YamlTree::Kind::list;
  targets.origin = driving->origin;
  for (const double value : curve.driven) {
    if (std::isnan(value))
      throw InputError(driving->origin,
                       fmt::format("takes column '{}', which has an empty cell", driving->text),
                       "a number in every row");
    YamlTree item;
    item.text = fmt::format("{:.17g}", value);
    item.origin = driving->origin;
    targets.items.push_back(item);
  }
  path.keys.emplace_back(target, targets);
  curve.path = read_path(path, nullptr);
  curve.channel = channel;
  for (const double value : curve.measured)
    if (curve.relative && value <= 0.0)
      throw InputError(measured->origin,
                       fmt::format("takes column '{}', which has the value {} and is compared in "
                                   "logarithms",
                                   measured->text, value),
                       "values > 0", "use scale: linear");
  return curve;
}

FitParameter read_parameter(const YamlTree& map, PointFit& fit, const MaterialOptions& values) {
  const Options options = read_map(parameter_schema(), map);
  FitParameterInput input;
  input.name = options.text("name");
  if (options.given("start")) input.start = options.number("start");
  if (options.given("lower")) input.lower = options.number("lower");
  if (options.given("upper")) input.upper = options.number("upper");
  return in_path(map, [&] {
    for (const FitParameter& other : fit.parameters)
      if (other.name() == input.name)
        throw InputError(fmt::format("parameter '{}'", input.name), "is given twice",
                         "each parameter once");
    return FitParameter(fit.material.model, values, fit.sections, input);
  });
}

}  // namespace

PointRun read_point_run(const std::string& path) {
  const YamlTree file = read_yaml(path);
  check_kind(file, InputKind::point_run);
  const Options head = read_map(head_schema("run"), file, {"path"});
  PointRun run;
  run.title = title_of(path, head);
  run.material = read_material_file(beside(path, head.text("material")));
  run.path =
      read_path(file.map("path", "the section 'path' with its type and targets"), &run.path_text);
  return run;
}

PointFit read_point_fit(const std::string& path) {
  const YamlTree file = read_yaml(path);
  check_kind(file, InputKind::point_fit);
  const Options head = read_map(head_schema("fit"), file, {"parameters", "curves"});
  PointFit fit;
  fit.title = title_of(path, head);
  fit.material = read_material_file(beside(path, head.text("material")));
  fit.sections = fit.material.sections;
  const MaterialOptions values = read_sections(fit.material.model, fit.sections);
  for (const YamlTree& map :
       file.list("parameters", "a list of {name: section.key, start, lower, upper}").items)
    fit.parameters.push_back(read_parameter(map, fit, values));
  const auto material = fit.material.make();
  std::size_t data = 0;
  for (const YamlTree& map :
       file.list("curves", "a list of curves with data, path, drive, compare").items) {
    fit.curves.push_back(read_curve(path, map, *material));
    read_sample(map, fit, values, fit.curves.back());
    for (const double value : fit.curves.back().measured) data += std::isnan(value) ? 0 : 1;
  }
  if (data < fit.parameters.size())
    throw InputError(path + ": fit",
                     fmt::format("has {} parameters for {} data", fit.parameters.size(), data),
                     "at least as many data as parameters");
  return fit;
}

MaterialSections sections_with(const PointFit& fit, const std::vector<std::string>& values) {
  if (values.size() != fit.parameters.size())
    throw InputError("line", fmt::format("has {} values", values.size()),
                     fmt::format("{}, one of each parameter", fit.parameters.size()));
  MaterialSections sections = fit.sections;
  for (std::size_t i = 0; i < values.size(); ++i) fit.parameters[i].put(sections, values[i]);
  return sections;
}

std::vector<double> curves_of(const PointFit& fit, const MaterialSections& sections) {
  struct Driven {
    const FitCurve& first;
    std::unique_ptr<Material> material;
    PointHistory history;
  };
  std::vector<Driven> paths;
  std::vector<double> points;
  for (const FitCurve& curve : fit.curves) {
    auto driven = std::find_if(paths.begin(), paths.end(),
                               [&](const Driven& each) { return share_a_path(each.first, curve); });
    if (driven == paths.end()) {
      MaterialSections of_sample = sections;
      for (const auto& [number, value] : curve.sample) number.put(of_sample, value);
      auto material = make_material(fit.material.model, of_sample);
      PointHistory history = drive_point(*material, curve.path);
      paths.push_back({curve, std::move(material), std::move(history)});
      driven = std::prev(paths.end());
    }
    for (const double value : curve_of(*driven->material, driven->history, curve))
      points.push_back(value);
  }
  return points;
}

std::string path_tables() {
  std::string text;
  for (const PathType& type : path_types())
    text += fmt::format("path {}: {}\n{}\n", type.name, type.meaning, type.schema.table());
  text += fmt::format(
      "path table: any control of each component, row by row\n{}  rows: a list of\n{}\n",
      table_path_schema().table(), table_row_schema().table());
  text += fmt::format(
      "fit: parameters, a list of\n{}\nfit: curves, a list of sample, path, drive, compare and\n{}",
      parameter_schema().table(), curve_schema().table());
  return text;
}

}  // namespace furrow
