// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/furrow_fix.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "comm.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/base/read_options.h"
#include "coupling/base/restart_record.h"
#include "coupling/base/checks/settings_check.h"

namespace furrow::coupling {

FurrowFix::FurrowFix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema)
    : Fix(lammps, narg, arg), options_(read_options(*lammps, schema, narg, arg)) {
  check_settings(*lammps, schema.subject());
}

const Outputs<FurrowFix>& FurrowFix::outputs() {
  static const Outputs<FurrowFix> none;
  return none;
}

bool FurrowFix::uses(const LAMMPS_NS::Fix& other) const {
  if (needs_system() && dynamic_cast<const FixCoupledSystem*>(&other)) return true;
  return std::find(used_.begin(), used_.end(), &other) != used_.end();
}

void FurrowFix::post_create() {
  if (!needs_system()) return;
  FixCoupledSystem& system = FixCoupledSystem::of(*lmp);
  for (const Part& part : parts_) std::visit([&](auto* p) { system.add(*p, id); }, part);
}

void FurrowFix::pre_delete(bool unfixing) {
  if (!unfixing) return;  // LIGGGHTS deletes all fixes
  collectively([&] { forbid_removal_while_used(*modify, *this); });
  if (parts_.empty()) return;
  FixCoupledSystem& system = FixCoupledSystem::of(*lmp);
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part)
    std::visit([&](auto* p) { system.remove(*p); }, *part);
}

/// Collective where a body is spread over the ranks.
void FurrowFix::write_restart(FILE* file) {
  collectively([&] {
    Checkpoint state(name());
    match_options(state);
    checkpoint(state);
    if (comm->me == 0) write_record(file, state);
  });
}

void FurrowFix::restart(char* buffer) {
  collectively([&] {
    Checkpoint state = read_record(name(), buffer);
    match_options(state);
    checkpoint(state);
    state.finish();
    restored_ = true;
  });
}

/// Numbers are compared as numbers: 0.2 is 0.20.
std::vector<std::pair<std::string, std::string>> FurrowFix::settings_of(const Options& options) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Key& key : options.keys()) {
    if (key.may_change) continue;
    const bool numbers = key.kind == Key::Kind::number || key.kind == Key::Kind::numbers;
    if (!options.has(key.name))
      list.emplace_back(key.name, "not given");
    else if (numbers)
      list.emplace_back(key.name, fmt::format("{}", fmt::join(options.numbers(key.name), " ")));
    else
      list.emplace_back(key.name, options.text(key.name));
  }
  return list;
}

std::vector<std::pair<std::string, std::string>> FurrowFix::settings() const {
  return settings_of(options_);
}

void FurrowFix::match_options(Checkpoint& state) const {
  if (!state_needs_options()) return;
  for (const auto& [key, value] : settings()) state.match(fmt::format("keyword '{}'", key), value);
}

void FurrowFix::announce_vector(std::size_t size) {
  vector_flag = 1;
  size_vector = static_cast<int>(size);
  global_freq = 1;
  extvector = 0;
}

double FurrowFix::compute_vector(int n) {
  double value = 0.0;
  collectively([&] { value = compute_(static_cast<std::size_t>(n)); });
  return value;
}

}  // namespace furrow::coupling
