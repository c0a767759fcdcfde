// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/closing_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "furrow/core/error.h"
#include "furrow/io/formats/hdf5_file.h"

namespace furrow {

namespace {

using NumberMember = std::pair<const char*, double Audit::*>;

// The numbers of /audit, by attribute
const NumberMember audit_numbers[] = {
    {"energy_residual", &Audit::energy_residual},   {"energy_scale", &Audit::energy_scale},
    {"force_imbalance", &Audit::force_imbalance},   {"force_scale", &Audit::force_scale},
    {"moment_imbalance", &Audit::moment_imbalance}, {"moment_scale", &Audit::moment_scale}};

std::string join_lines(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return lines;
}

}  // namespace

void write_closing(Hdf5File& file, const RunClosing& closing) {
  file.remove("/audit");
  file.create_group("/audit");
  for (const auto& [name, member] : audit_numbers)
    file.set_attribute("/audit", name, closing.audit.*member);
  std::vector<double> energies;
  std::vector<std::string> terms;
  for (const EnergyTerm& term : closing.audit.energies) {
    energies.push_back(term.value);
    terms.push_back(term.name);
  }
  file.write("/audit/energies", energies);
  file.set_attribute("/audit/energies", "terms", join_lines(terms));
  file.set_attribute("/audit/energies", "unit", "J");

  file.remove("/cost");
  file.create_group("/cost");
  file.set_attribute("/cost", "wall_time", closing.cost.wall_time);
  file.set_attribute("/cost", "simulated_time", closing.cost.simulated_time);
  file.set_attribute("/cost", "steps", double(closing.cost.steps));
  file.set_attribute("/cost", "grains", double(closing.cost.grains));
  file.set_attribute("/cost", "ranks", closing.cost.ranks);
  file.set_attribute("/cost", "memory", closing.cost.memory);
  file.write("/warnings", join_lines(closing.warnings));
}

RunClosing read_closing(const Hdf5File& file) {
  if (!file.exists("/cost"))
    throw Error(fmt::format("{}: has no /cost; the run did not come to its end", file.path()));
  RunClosing closing;
  for (const auto& [name, member] : audit_numbers)
    closing.audit.*member = file.number_attribute("/audit", name);
  const std::vector<double> energies = file.read_numbers("/audit/energies");
  const std::vector<std::string> terms =
      split_lines(file.text_attribute("/audit/energies", "terms"));
  if (energies.size() != terms.size())
    throw Error(fmt::format("{}: /audit/energies and its names differ in number", file.path()));
  for (std::size_t i = 0; i < terms.size(); ++i)
    closing.audit.energies.push_back({terms[i], energies[i]});
  closing.cost.wall_time = file.number_attribute("/cost", "wall_time");
  closing.cost.simulated_time = file.number_attribute("/cost", "simulated_time");
  closing.cost.steps = std::lround(file.number_attribute("/cost", "steps"));
  closing.cost.grains = std::lround(file.number_attribute("/cost", "grains"));
  closing.cost.ranks = int(file.number_attribute("/cost", "ranks"));
  closing.cost.memory = file.number_attribute("/cost", "memory");
  closing.warnings = split_lines(file.read_text("/warnings"));
  return closing;
}

}  // namespace furrow
