// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/material/hardening/hardening.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// ln of the compaction, which no ground exceeds
const Range possible_strain = Range::closed(-5.0, 5.0);
const Range possible_row_density = {0.0, 5000.0, true, false};  // [kg/m3] up to ore

/// The keys of a table in addition to its column of strains or densities.
void declare_strengths(Schema& schema) {
  schema.numbers("p", 0, "Pa", Range::positive(), "hydrostatic yield strengths p_b, increasing");
  schema.choice("interpolation", {"linear", "log"},
                "between rows: straight in p, or in ln p, over eps_vol_pl");
  schema.choice("beyond", {"extrapolate", "stop"}, "rule for strains beyond the last row");
  schema
      .choice("below", {"extrapolate", "stop"},
              "rule for strains below the first row: decay to zero strength, or stop")
      .by_default("extrapolate");
}

}  // namespace

SectionSchema hardening_section() {
  Schema table("hardening table");
  table.numbers("eps_vol_pl", 0, "", possible_strain,
                "volumetric plastic strains of the strengths, compression positive, increasing");
  declare_strengths(table);
  Schema by_density("hardening by_density");
  by_density.numbers("rho", 0, "kg/m3", possible_row_density,
                     "densities of the strengths, without load, increasing: one curve for every "
                     "initial density in them");
  declare_strengths(by_density);
  Schema exponential("hardening exponential");
  exponential.number("pc0", "Pa", Range::positive(),
                     "hydrostatic yield strength at zero volumetric plastic strain");
  exponential.number(
      "lambda", "", Range::positive(),
      "logarithmic hardening modulus: slope of void ratio against ln p in first loading");
  exponential.number("kappa", "", Range::non_negative(),
                     "logarithmic bulk modulus: the same slope in unloading; below lambda");
  exponential.number("e0", "", Range::positive(), "initial void ratio");
  return {"hardening",
          {{"table", "strengths at given volumetric plastic strains", table},
           {"by_density", "strengths at given densities", by_density},
           {"exponential", "straight in void ratio against ln p", exponential}}};
}

namespace {

/// @param key  of the column that the strengths belong to
/// @param eps  its volumetric plastic strains
HardeningParameters make_table(const Options& o, const std::string& key,
                               const std::vector<double>& eps) {
  const std::vector<double>& p = o.numbers("p");
  const std::vector<double>& column = o.numbers(key);
  const std::size_t rows = p.size();
  const std::size_t max_rows = HardeningParameters::max_segments + 1;
  if (rows != eps.size())
    throw InputError(o.where(key), fmt::format("has {} values for {} of 'p'", eps.size(), rows),
                     "as many as of 'p'");
  if (rows < 2 || rows > max_rows)
    throw InputError(o.where("p"), fmt::format("has {} row(s)", rows),
                     fmt::format("2 to {} rows", max_rows));
  HardeningParameters h;
  const bool log = o.text("interpolation") == "log";
  h.kind = log ? HardeningParameters::Kind::log_table : HardeningParameters::Kind::linear_table;
  h.segments = static_cast<int>(rows) - 1;
  for (std::size_t k = 0; k + 1 < rows; ++k) {
    for (const auto& [name, values] : {std::pair{std::string("p"), &p}, std::pair{key, &column}})
      if ((*values)[k + 1] <= (*values)[k])
        throw InputError(o.where(name),
                         fmt::format("does not increase: row {} is {}, row {} is {}", k + 1,
                                     (*values)[k], k + 2, (*values)[k + 1]),
                         "strictly increasing values", "sort the rows, remove equal ones");
    h.start[k] = eps[k];
    h.base[k] = log ? std::log(p[k]) : p[k];
    h.slope[k] = ((log ? std::log(p[k + 1]) : p[k + 1]) - h.base[k]) / (eps[k + 1] - eps[k]);
  }
  h.first = eps.front();
  h.last = eps.back();
  h.first_value = p.front();
  h.decay = log ? h.slope[0] : h.slope[0] / p.front();
  h.stop_beyond = o.text("beyond") == "stop";
  h.stop_below = o.text("below") == "stop";
  return h;
}

/// eps_vol_pl = ln(rho/density): compaction from the density at the start.
HardeningParameters make_by_density(const Options& o, double density) {
  const std::vector<double>& rho = o.numbers("rho");
  if (!rho.empty() && (density < rho.front() || density > rho.back()))
    throw InputError(o.where("rho"),
                     fmt::format("reaches from {} to {} kg/m3, without the density of the law, {}",
                                 rho.front(), rho.back(), density),
                     "densities around it", "add a row, or change the law's density");
  std::vector<double> eps(rho.size());
  std::transform(rho.begin(), rho.end(), eps.begin(),
                 [&](double row) { return std::log(row / density); });
  return make_table(o, "rho", eps);
}

HardeningParameters make_exponential(const Options& o, double offset, bool includes_offset) {
  HardeningParameters h;
  h.kind = HardeningParameters::Kind::exponential;
  h.scale = o.number("pc0") + (includes_offset ? 0.0 : offset);
  h.offset = offset;
  h.c = 1.0 + o.number("e0");
  h.lambda = o.number("lambda");
  h.kappa = o.number("kappa");
  if (h.lambda <= h.kappa)
    throw InputError(o.where("lambda"),
                     fmt::format("is {}, not above kappa = {}", h.lambda, h.kappa),
                     "lambda > kappa");
  h.first_value = h.scale - offset;
  if (h.first_value <= 0.0)
    throw InputError(o.where("pc0"),
                     fmt::format("is {} Pa, which includes the tensile strength", h.scale),
                     fmt::format("above {} Pa", offset));
  h.decay = h.scale * h.c / (h.lambda - h.kappa) / h.first_value;
  return h;
}

}  // namespace

HardeningParameters make_hardening(const SectionOptions& section, double density, double offset,
                                   bool includes_offset) {
  const Options& o = section.options;
  if (section.type == "table") return make_table(o, "eps_vol_pl", o.numbers("eps_vol_pl"));
  if (section.type == "by_density") return make_by_density(o, density);
  return make_exponential(o, offset, includes_offset);
}

double strength_at(const HardeningParameters& h, double eps) {
  if (eps < h.first) return h.first_value * std::exp(std::max(h.decay * (eps - h.first), -80.0));
  if (h.kind == HardeningParameters::Kind::exponential) {
    const double ratio = std::exp(-eps);
    return h.scale * std::exp(h.c * (1.0 - ratio) / (h.lambda - h.kappa * ratio)) - h.offset;
  }
  int k = 0;
  while (k + 1 < h.segments && eps >= h.start[k + 1]) ++k;
  const double value = h.base[k] + h.slope[k] * (eps - h.start[k]);
  return h.kind == HardeningParameters::Kind::log_table ? std::exp(value) : value;
}

void check_initial(const HardeningParameters& h, const Options& options, const std::string& key) {
  const double eps = options.number(key);
  if (eps < h.first || eps > h.last)
    throw InputError(options.where(key), fmt::format("is {}, outside the hardening data", eps),
                     fmt::format("in [{}, {}]", h.first, h.last));
}

}  // namespace furrow
