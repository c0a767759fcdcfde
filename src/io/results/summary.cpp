// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/summary.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "furrow/core/error.h"
#include "furrow/io/results/history_file.h"
#include "furrow/io/files/replace_file.h"

namespace furrow {

namespace {

/// Standard error to so many digits and the value to the same place: "0.01712 +- 0.00043".
std::string with_error(double value, double error, int digits = 2) {
  constexpr double rounding = 1e-12;  // of what vanishes by symmetry, or is prescribed
  if (std::abs(value) < rounding && error < rounding) return "0";
  if (!(error > rounding * std::abs(value))) return fmt::format("{:.6g}", value);
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(error))));
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
}

/// Heads of tables state what their errors are.
constexpr char over_time[] = "± over time only";

constexpr char verdict_head[] = "Verdict: ";
constexpr std::size_t longest_verdict = 91;  // length of a line of 100 characters without its head

/// Number of characters of a text in UTF-8.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string clock_text(double seconds) {
  return seconds < 60.0 ? fmt::format("{:.1f} s", seconds)
                        : fmt::format("{} min {:02} s", static_cast<long>(seconds) / 60,
                                      std::lround(seconds) % 60);
}

std::string row_of(const std::string& name, const SteadyValue& v, const std::string& word) {
  return fmt::format("  {:<26} {:>24} {:<5}  {}\n", name, with_error(v.mean, v.standard_error),
                     v.unit, word);
}

std::string state_of(const SteadyValue& value) {
  return value.imposed ? "imposed by the scene" : value.steady ? "steady" : "not steady";
}

/// Table of the main results of a run, which comes first.
std::string answer_table(const Resistance& r) {
  std::string text = fmt::format("Main values, {}\n", over_time);
  for (const std::string& name :
       {std::string("hub_drop"), std::string("tyre_deflection"), std::string("rut_depth"),
        r.coefficient().name, std::string("slip"), std::string(r.driven ? "drive_torque" : "")})
    if (r.has(name)) text += row_of(plain_name(name), r.value(name), state_of(r.value(name)));
  return text;
}

/// Text of a value: "hub drop 101.1 ± 0.2 mm"; depths in mm, errors of two digits below 1.5 alone.
std::string value_text(const SteadyValue& value) {
  const bool depth = value.unit == "m";
  const double scale = depth ? 1e3 : 1.0, error = scale * value.standard_error;
  const double first = error > 0.0 ? error / std::pow(10.0, std::floor(std::log10(error))) : 0.0;
  const std::string unit = depth ? " mm" : value.unit.empty() ? "" : " " + value.unit;
  return fmt::format("{} {}{}", plain_name(value.name),
                     with_error(scale * value.mean, error, first < 1.5 ? 2 : 1), unit);
}

std::string steady_table(const Resistance& r) {
  std::string text;
  if (!r.reasons.empty()) text += "Not steady\n";
  for (const std::string& reason : r.reasons) text += "  " + reason + "\n";
  text += fmt::format("Window: {:.4g} s to {:.4g} s, {:.4g} m of travel ({})\n\nAll values, {}\n",
                      r.window.begin, r.window.end, r.window.distance, r.window.how, over_time);
  const std::string other = r.driven ? "resistance_coefficient" : "net_traction_coefficient";
  for (const SteadyValue& v : r.values)
    if (v.name != other)
      text +=
          row_of(plain_name(v.name), v,
                 v.imposed || !v.steady ? state_of(v)
                 : v.independent_samples < static_cast<double>(SteadyCriteria{}.min_blocks)
                     ? "steady, hardly changes"
                     : fmt::format("steady, {:.0f} independent samples", v.independent_samples));
  return text;
}

std::string passes_table(const std::vector<Resistance>& passes) {
  if (passes.empty()) return "";
  std::string text = fmt::format(
      "\nPasses in the same rut, {} (all else here is of the first)\n"
      "  pass         hub drop [m]     resistance coefficient   verdict\n",
      over_time);
  for (std::size_t n = 0; n < passes.size(); ++n) {
    const SteadyValue &z = passes[n].value("hub_drop"),
                      &c = passes[n].value("resistance_coefficient");
    text += fmt::format("  {:>4} {:>21} {:>26}   {}\n", n + 1, with_error(z.mean, z.standard_error),
                        with_error(c.mean, c.standard_error),
                        passes[n].steady ? "steady" : "not steady");
  }
  return text;
}

std::string parts_table(const ResistanceParts& parts) {
  if (!parts.known()) return "";
  const auto row = [&](const std::string& name, double force) {
    const double share = 100.0 * force / parts.whole;  // of a wheel without resistance: no number
    return fmt::format("  {:<38} {:>14.4g} N  {:>8}\n", name, force,
                       std::abs(share) < 1e4 ? fmt::format("{:.1f} %", share) : "");
  };
  std::string text = "\nWhat the resistance is made of (energy over travel, in the window)\n";
  for (const ResistancePart& part : parts.parts) text += row(part.name, part.force);
  text += row("not accounted for", parts.unexplained);
  text += row("whole: put in by axle and load", parts.whole);
  if (!parts.given_to_grains.empty()) text += "The wheel gave the grains their parts:\n";
  for (const ResistancePart& part : parts.given_to_grains) text += row(part.name, part.force);
  return text;
}

nlohmann::ordered_json json_of(const ResistanceParts& parts) {
  nlohmann::ordered_json json;
  json["unit"] = "N";
  json["whole"] = parts.whole;
  for (const ResistancePart& part : parts.parts) json["parts"][part.name] = part.force;
  json["unexplained"] = parts.unexplained;
  for (const ResistancePart& part : parts.given_to_grains)
    json["given_to_grains"][part.name] = part.force;
  return json;
}

std::string audit_text(const Audit& audit) {
  std::string text =
      "Audit (energies add up to zero: what the wheel receives is positive, what it keeps or loses "
      "negative)\n";
  for (const EnergyTerm& term : audit.energies)
    text += fmt::format("  {:<38} {:>14.6g} J\n", term.name, term.value);
  text += fmt::format(
      "  {:<38} {:>14.3g} J  ({:.1e} of the largest)\n", "not accounted for", audit.energy_residual,
      audit.energy_scale > 0.0 ? std::abs(audit.energy_residual) / audit.energy_scale : 0.0);
  text += fmt::format("  {:<38} {:>14.3g} N  of {:.4g} N\n", "forces on nodes + on grains, largest",
                      audit.force_imbalance, audit.force_scale);
  text += fmt::format("  {:<38} {:>14.3g} N m of {:.4g} N m\n", "their moments, largest",
                      audit.moment_imbalance, audit.moment_scale);
  return text;
}

std::string cost_text(const Cost& cost) {
  return fmt::format(
      "Cost\n  {} for {:.4g} s simulated ({:.3g} simulated seconds per wall second), {} steps\n"
      "  {} rank(s), {} grains, {:.2f} million grain steps per second, {:.0f} MB\n",
      clock_text(cost.wall_time), cost.simulated_time, cost.simulated_per_wall_second(), cost.steps,
      cost.ranks, cost.grains, 1e-6 * cost.particle_steps_per_second(), 1e-6 * cost.memory);
}

nlohmann::ordered_json json_of(const SteadyValue& v) {
  return {{"mean", v.mean},
          {"standard_error", v.standard_error},
          {"unit", v.unit},
          {"steady", v.steady},
          {"imposed", v.imposed},
          {"verdict", v.verdict},
          {"minimum", v.minimum},
          {"maximum", v.maximum},
          {"standard_deviation", v.deviation},
          {"correlation_time", v.correlation_time},
          {"independent_samples", v.independent_samples},
          {"blocks", v.blocks},
          {"drift", v.drift},
          {"drift_error", v.drift_error}};
}

}  // namespace

Summary summarise(const std::string& folder, const ResistanceOptions& options) {
  const std::string path = folder + "/history.h5";
  Summary summary;
  summary.info = read_run_info(path);
  summary.closed = has_closing(path);
  if (summary.closed) summary.closing = read_closing(path);
  const History history = read_history(path);
  for (const Channel& channel : history.channels())
    summary.definitions[channel.name] = channel.meaning;
  try {
    if (count_passes(history) > 1 && !options.window.given())
      summary.passes = measure_passes(history, options);
    summary.resistance =
        summary.passes.empty() ? measure_resistance(history, options) : summary.passes.front();
  } catch (const InputError&) {
    throw;  // the user asked for a window that is not there
  } catch (const Error& error) {
    summary.trouble = error.what();
  }
  return summary;
}

std::string verdict_of(const Summary& s) {
  if (!s.trouble.empty()) {
    const std::string text = "no steady values, " + s.trouble;
    return characters(text) > longest_verdict ? text.substr(0, text.find_first_of(":;(")) : text;
  }
  const SteadyValue &answer = s.resistance.answer(), &drop = s.resistance.value("hub_drop");
  const bool steady = answer.steady && drop.steady && s.resistance.window.warning.empty();
  const std::string text = (steady ? "steady, " : "not steady, ") + value_text(answer);
  const std::string both = text + ", " + value_text(drop), of_time = "; ± over time";
  return (characters(both + of_time) <= longest_verdict ? both : text) + of_time;
}

std::string error_note(const std::string& folder) {
  return fmt::format(
      "± is over time alone, without cells or grains, ground, packing, material and model.\n"
      "With them: furrow-post budget {}\n",
      folder);
}

std::string summary_text(const Summary& s) {
  std::string text = fmt::format("{}\n{}\n\n", s.info.title, std::string(s.info.title.size(), '='));
  if (!s.closed)
    text += "THE RUN DID NOT COME TO ITS END: what follows is what there was when it stopped.\n\n";
  text += verdict_head + verdict_of(s) + "\n";
  if (s.trouble.empty()) text += error_note("<folder of this file>");
  text += "\n";
  text += s.trouble.empty() ? answer_table(s.resistance) + "\n" + steady_table(s.resistance) +
                                  passes_table(s.passes) + parts_table(s.resistance.parts)
                            : fmt::format("No steady values: {}\n", s.trouble);
  if (s.closed) text += "\n" + audit_text(s.closing.audit) + "\n" + cost_text(s.closing.cost);
  for (const std::string& warning : s.closing.warnings) text += "\nWARNING: " + warning + "\n";
  text += fmt::format("\nFurrow {}, script {}, started {}\n", s.info.version, s.info.script,
                      s.info.started);
  text +=
      "Depths: hub drop = ground level - lowest point of the unloaded wheel; rut depth = hub drop "
      "- "
      "tyre deflection, below\n"
      "the loaded wheel. Of a rigid wheel the hub drop is the rut depth.\n"
      "Signs: force_z carries the wheel; drawbar pull > 0 pulls the vehicle forward; resistance "
      "coefficient (towed wheel) =\n"
      "-force_x/force_z; net traction coefficient (driven wheel) = drawbar pull/force_z;\n"
      "slip > 0 when driving; moments of the ground about the axle centre: overturning > 0 tips "
      "the "
      "top to the right,\n"
      "aligning > 0 turns to the left.\n"
      "Frames: tractive force (forward) and lateral force (to the left) are in the frame of the "
      "wheel; force_x and force_y are\n"
      "in the frame of the travel. Without a slip angle they agree.\n";
  if (const auto slip = s.definitions.find("slip"); slip != s.definitions.end())
    text += "Slip: " + slip->second + ".\n";
  text += "Effective input: /run/effective_input of history.h5.\n";
  return text;
}

std::string summary_json(const Summary& s) {
  nlohmann::ordered_json json;
  json["title"] = s.info.title;
  json["version"] = s.info.version;
  json["script"] = s.info.script;
  json["started"] = s.info.started;
  json["complete"] = s.closed;
  json["verdict"] = verdict_of(s);
  if (s.trouble.empty()) {
    const Resistance& r = s.resistance;
    json["steady"] = r.steady;
    json["reasons"] = r.reasons;
    json["window"] = {{"start", r.window.begin},
                      {"end", r.window.end},
                      {"distance", r.window.distance},
                      {"how", r.window.how},
                      {"warning", r.window.warning}};
    for (const SteadyValue& v : r.values) {
      json["quantities"][v.name] = json_of(v);
      const auto meaning = s.definitions.find(v.name);
      if (meaning != s.definitions.end())
        json["quantities"][v.name]["definition"] = meaning->second;
    }
    for (const Resistance& pass : s.passes) {
      nlohmann::ordered_json values;
      for (const SteadyValue& v : pass.values) values[v.name] = json_of(v);
      nlohmann::ordered_json& of_pass = json["passes"].emplace_back();
      of_pass = {{"steady", pass.steady}, {"reasons", pass.reasons}, {"quantities", values}};
      if (pass.parts.known()) of_pass["resistance_parts"] = json_of(pass.parts);
    }
    if (r.parts.known()) json["resistance_parts"] = json_of(r.parts);
  } else {
    json["steady"] = false;
    json["reasons"] = {s.trouble};
  }
  if (s.closed) {
    const Audit& a = s.closing.audit;
    for (const EnergyTerm& term : a.energies) json["audit"]["energies"][term.name] = term.value;
    json["audit"]["energy_residual"] = a.energy_residual;
    json["audit"]["energy_scale"] = a.energy_scale;
    json["audit"]["force_imbalance"] = a.force_imbalance;
    json["audit"]["force_scale"] = a.force_scale;
    json["audit"]["moment_imbalance"] = a.moment_imbalance;
    json["audit"]["moment_scale"] = a.moment_scale;
    const Cost& c = s.closing.cost;
    json["cost"] = {{"wall_time", c.wall_time},
                    {"simulated_time", c.simulated_time},
                    {"steps", c.steps},
                    {"grains", c.grains},
                    {"ranks", c.ranks},
                    {"memory", c.memory},
                    {"particle_steps_per_second", c.particle_steps_per_second()},
                    {"simulated_per_wall_second", c.simulated_per_wall_second()}};
  }
  json["warnings"] = s.closing.warnings;
  json["effective_input"] = s.info.effective_input;
  return json.dump(2) + "\n";
}

std::string vehicle_text(const std::vector<std::string>& folders,
                         const ResistanceOptions& options) {
  std::vector<History> histories;
  for (const std::string& folder : folders)
    histories.push_back(read_history(folder + "/history.h5"));
  const VehicleResistance vehicle = measure_vehicle(histories, options);
  std::string text = fmt::format(
      "Wheels that roll together, {:.4g} s to {:.4g} s, {:.4g} m of travel, {}\n"
      "          load [N]          hub drop [m]     resistance coefficient   wheel\n",
      vehicle.window.begin, vehicle.window.end, vehicle.window.distance, over_time);
  for (std::size_t w = 0; w < folders.size(); ++w) {
    const auto cell = [&](const char* name) {
      const SteadyValue& value = vehicle.wheels[w].value(name);
      return with_error(value.mean, value.standard_error);
    };
    text += fmt::format("  {:>16} {:>21} {:>26}   {}, {}\n", cell("force_z"), cell("hub_drop"),
                        cell("resistance_coefficient"), folders[w],
                        vehicle.wheels[w].steady ? "steady" : "not steady");
  }
  text += fmt::format("\nTogether, {}\n", over_time);
  for (const SteadyValue& v : vehicle.values)
    text += row_of(plain_name(v.name), v, v.steady ? "steady" : "not steady");
  return text + parts_table(vehicle.parts);
}

void write_summary(const std::string& folder, const Summary& summary) {
  write_text_file(folder + "/summary.txt", summary_text(summary));
  write_text_file(folder + "/summary.json", summary_json(summary));
}

}  // namespace furrow
