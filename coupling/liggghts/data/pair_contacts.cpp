// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/pair_contacts.h"

#include <memory>

#include "compute_pair_gran_local.h"
#include "furrow/core/error.h"
#include "force.h"
#include "pair_gran.h"
#include "update.h"

namespace furrow::coupling {

namespace {

using Action = std::function<void(const PairContact&)>;

/// Stands where a compute pair/gran/local would, and gathers nothing.
class Visitor : public LAMMPS_NS::ComputePairGranLocal {
 public:
  Visitor(LAMMPS_NS::LAMMPS* lammps, int first, int narg, char** arg, const Action& action)
      : ComputePairGranLocal(lammps, first, narg, arg), action_(action) {}

  void add_pair(int i, int j, double fx, double fy, double fz, double tx, double ty, double tz,
                double*, const double*) override {
    action_({i, j, {fx, fy, fz}, {tx, ty, tz}});
  }
  void pair_finalize() override {}

 private:
  const Action& action_;
};

/// LIGGGHTS refuses to make the compute after the first run, which is of no matter to a visitor.
class BeforeFirstRun {
 public:
  explicit BeforeFirstRun(LAMMPS_NS::Update& update) : update_(update), step_(update.ntimestep) {
    update_.ntimestep = 0;
  }
  ~BeforeFirstRun() { update_.ntimestep = step_; }
  BeforeFirstRun(const BeforeFirstRun&) = delete;
  BeforeFirstRun& operator=(const BeforeFirstRun&) = delete;

 private:
  LAMMPS_NS::Update& update_;
  LAMMPS_NS::bigint step_;
};

std::unique_ptr<Visitor> make_visitor(LAMMPS_NS::LAMMPS& lammps, const Action& action) {
  char id[] = "furrow_pair_contacts", group[] = "all", style[] = "pair/gran/local";
  char* words[] = {id, group, style};
  const BeforeFirstRun first(*lammps.update);
  return std::make_unique<Visitor>(&lammps, 3, 3, words, action);
}

}  // namespace

void for_each_pair_contact(LAMMPS_NS::LAMMPS& lammps, const Action& action) {
  auto* pair = dynamic_cast<LAMMPS_NS::PairGran*>(lammps.force->pair);
  if (!pair)
    throw InputError("the contacts between grains", "are of no granular pair style",
                     "pair_style gran ...", "write one before the run");
  const std::unique_ptr<Visitor> visitor = make_visitor(lammps, action);
  int values = 0;
  pair->register_compute_pair_local(visitor.get(), values);
  pair->compute_pgl(0, 0);
  pair->unregister_compute_pair_local(visitor.get());
}

}  // namespace furrow::coupling
