// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/loads/grain_loads.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace furrow::coupling {

void GrainLoads::add(Body& body, const std::string& name) {
  loads_.push_back({&body, name});
  const auto restored = restored_works_.find(name);
  if (restored == restored_works_.end()) return;
  loads_.back().work = restored->second.work;
  if (ranks_.rank() == 0) loads_.back().work_of_step = restored->second.work_of_step;
}

void GrainLoads::remove(const Body& body) {
  loads_.erase(std::remove_if(loads_.begin(), loads_.end(),
                              [&](const GrainLoad& load) { return load.body == &body; }),
               loads_.end());
}

GrainLoad* GrainLoads::find(const Body& body) {
  const auto found = std::find_if(loads_.begin(), loads_.end(),
                                  [&](const GrainLoad& load) { return load.body == &body; });
  return found == loads_.end() ? nullptr : &*found;
}

void GrainLoads::begin_step() {
  for (GrainLoad& load : loads_) {
    const Surface& surface = load.body->surface();
    load.ledger = {};
    load.contacts.clear();
    if (surface.node_count() > 0) load.reference = surface.x.rowwise().mean();
  }
}

void GrainLoads::sum_over_ranks() {
  for (GrainLoad& load : loads_) load.ledger.work_before = std::exchange(load.work_of_step, {});
  if (ranks_.size() == 1) return;
  buffer_.clear();
  for (const GrainLoad& load : loads_) {
    const Matrix3X& f = load.body->surface().f;
    buffer_.insert(buffer_.end(), f.data(), f.data() + f.size());
    const auto ledger = load.ledger.numbers();
    buffer_.insert(buffer_.end(), ledger.begin(), ledger.end());
  }
  ranks_.sum(buffer_.data(), buffer_.size());
  const double* next = buffer_.data();
  for (GrainLoad& load : loads_) {
    Matrix3X& f = load.body->surface().f;
    std::copy(next, next + f.size(), f.data());
    next += f.size();
    load.ledger = ContactLedger::from(next);
    next += ContactLedger::size;
  }
}

void GrainLoads::audit(long step) {
  for (GrainLoad& load : loads_) {
    load.audit.add(load.ledger, load.body->surface(), load.reference, load.name, step);
    load.work += load.ledger.work_before;
  }
}

void GrainLoads::mark_touched_bodies() {
  for (GrainLoad& load : loads_) load.touched = load.touched || !load.body->surface().f.isZero(0.0);
}

void GrainLoads::find_works(const LAMMPS_NS::Atom& atom, double dt) {
  for (GrainLoad& load : loads_) load.work_of_step = work_of(load.contacts, atom, dt);
}

void GrainLoads::gather_works_of_step() {
  for (GrainLoad& load : loads_) {
    auto numbers = load.work_of_step.numbers();
    ranks_.sum(numbers.data(), numbers.size());
    load.work_of_step = ranks_.rank() == 0 ? ContactWork::from(numbers.data()) : ContactWork();
  }
}

void GrainLoads::checkpoint(Checkpoint& state) {
  std::string names;
  std::vector<double> numbers;
  for (const GrainLoad& load : loads_) {
    names += load.name + '\n';
    for (const ContactWork& work : {load.work_of_step, load.work})
      for (const double number : work.numbers()) numbers.push_back(number);
  }
  state.value("bodies", names);
  state.values("contact_works", numbers);
  if (state.saving()) return;
  std::istringstream lines(names);
  const double* next = numbers.data();
  for (std::string name; std::getline(lines, name); next += 2 * ContactWork::size)
    restored_works_[name] = {ContactWork::from(next), ContactWork::from(next + ContactWork::size)};
}

}  // namespace furrow::coupling
