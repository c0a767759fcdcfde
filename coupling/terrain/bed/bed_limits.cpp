// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/bed_limits.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>

#include "furrow/core/error.h"
#include "coupling/base/checks/high_friction.h"
#include "coupling/base/checks/time_step_check.h"

namespace furrow::coupling {

namespace {

constexpr double mean_volume = 1.045;    // over that of the mean diameter, of the same beds
constexpr double poured_share = 0.6;     // solid over volume, when nothing else is known
constexpr double bytes_of_grain = 3000;  // memory of a grain with contacts and neighbours, measured
constexpr double linear_step_limit =
    0.3;  // of half a period; 2 / pi would be the limit of one spring
constexpr double settled_level_tolerance = 0.5;                 // of the depth
constexpr double many_grains = 3e5, density_of_steel = 8000.0;  // steel [kg/m3]

/// Memory that is available on this machine and to this process [bytes].
double available_memory() {
  double available = std::numeric_limits<double>::infinity();
  std::ifstream file("/proc/meminfo");
  for (std::string name, rest; file >> name && std::getline(file, rest);)
    if (name == "MemAvailable:") available = 1024.0 * std::stod(rest);
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    available = std::min(available, static_cast<double>(limit.rlim_cur));
  return available;
}

bool has(const Options& options, const std::initializer_list<const char*>& names) {
  for (const char* name : names) {
    const auto& keys = options.keys();
    const auto found =
        std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
    if (found == keys.end() || found->kind != Key::Kind::number || !options.has(name)) return false;
  }
  return true;
}

void check_sizes(const Options& options) {
  if (!has(options, {"diameter"})) return;
  const double least = minimum_size * options.number("diameter");
  for (const char* name : {"length", "width", "depth"})
    if (has(options, {name}) && options.number(name) < least)
      throw InputError(options.where(name), fmt::format("is {:.4g} m", options.number(name)),
                       fmt::format("at least {:g} grains of diameter {:.4g} m: {:.4g} m",
                                   minimum_size, options.number("diameter"), least),
                       "make the bed larger or the grains smaller");
}

/// About how many grains a bed has; 0 when it is not known.
double count_of_grains(const Options& options) {
  if (!has(options, {"diameter", "length", "width", "depth"})) return 0.0;
  const double share = has(options, {"bulk", "density"})
                           ? options.number("bulk") / options.number("density")
                           : poured_share;
  return share * options.number("length") * options.number("width") * options.number("depth") /
         (M_PI / 6.0 * mean_volume * std::pow(options.number("diameter"), 3));
}

void check_memory(const Options& options) {
  const double grains = count_of_grains(options);
  const double needed = bytes_of_grain * grains, available = available_memory();
  if (needed > available || grains > std::numeric_limits<int>::max())
    throw InputError(
        options.where("diameter"),
        fmt::format("gives a bed of about {:.2g} grains, which need about {:.2g} GB", grains,
                    1e-9 * needed),
        fmt::format("at most {:.2g} GB, which this machine has free", 1e-9 * available),
        "make the bed smaller or the grains larger");
}

[[noreturn]] void refuse_step(const Options& options, double share, const std::string& of,
                              double time, double limit) {
  throw InputError(options.where("step"),
                   fmt::format("is {:.4g} s, {:.3g} of {} of the smallest grain, {:.4g} s",
                               options.number("step"), share, of, time),
                   fmt::format("at most {:g} of it: {:.3g} s", limit, limit * time),
                   "grains would fly apart: take a shorter step, or softer or larger grains");
}

void check_step(const Options& options) {
  if (!has(options, {"step", "diameter", "density"})) return;
  const double diameter = smallest_grain * options.number("diameter");
  const double density = options.number("density"), step = options.number("step");
  if (has(options, {"young", "poisson"})) {
    const double time =
        rayleigh_time(0.5 * diameter, density, options.number("young"), options.number("poisson"));
    if (!(step <= step_limit * time))
      refuse_step(options, step / time, "the Rayleigh time", time, step_limit);
  } else if (has(options, {"stiffness", "unloading"})) {
    const double mass = M_PI / 6.0 * density * std::pow(diameter, 3);
    const double stiffness =
        options.number("unloading") * options.number("stiffness") * options.number("diameter");
    const double time = M_PI * std::sqrt(0.5 * mass / stiffness);
    if (!(step <= linear_step_limit * time))
      refuse_step(options, step / time, "half a period of a contact", time, linear_step_limit);
  } else if (has(options, {"modulus"})) {
    const double time = snow_contact_time(0.5 * diameter, density, options.number("modulus"));
    if (!(step <= snow_step_limit * time))
      refuse_step(options, step / time, "the contact time", time, snow_step_limit);
  }
}

}  // namespace

void check_bed_parameters(const Options& options) {
  check_sizes(options);
  check_memory(options);
  check_step(options);
}

std::vector<std::string> bed_warnings(const Options& options) {
  std::vector<std::string> warnings;
  for (const Key& key : options.keys()) {
    const bool coefficient =
        key.kind == Key::Kind::number &&
        (key.name == "rolling" ||
         (key.name.size() >= 8 && key.name.compare(key.name.size() - 8, 8, "friction") == 0));
    if (coefficient && options.has(key.name) && is_high_friction(options.number(key.name)))
      warnings.push_back(high_friction(options.where(key.name), options.number(key.name)));
  }
  if (has(options, {"density"}) && options.number("density") > density_of_steel)
    warnings.push_back(
        fmt::format("{} is {:g} kg/m3, and steel has {:g}; give the density of one "
                    "grain in kg/m3",
                    options.where("density"), options.number("density"), density_of_steel));
  if (const double grains = count_of_grains(options); grains > many_grains)
    warnings.push_back(
        fmt::format("command bed makes about {:.2g} grains, which takes hours; look at "
                    "length, width, depth and diameter, or go on",
                    grains));
  return warnings;
}

void check_bed(const BedFacts& facts, const BedSurface& surface) {
  if (facts.grains < 1) throw StateError("command bed: no grain is left of the bed");
  const double level = surface.mean();
  if (!(std::abs(facts.level - level) <= settled_level_tolerance * level))
    throw StateError(
        fmt::format("command bed: the bed has its surface at {:.4g} m and was to have it at {:.4g} "
                    "m; it is not kept. Its grains have flown apart or collapsed: take a shorter "
                    "step, and look at the contact properties",
                    facts.level, level));
}

}  // namespace furrow::coupling
