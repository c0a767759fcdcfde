// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/grains/fix_grain_work.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "atom.h"
#include "compute.h"
#include "furrow/core/communicator.h"
#include "furrow/core/error.h"
#include "coupling/base/checkpoint_totals.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/base/roles/fix_rig.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/base/loads/snow_pairs.h"
#include "coupling/liggghts/data/global_properties.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/liggghts/data/vector.h"
#include "domain.h"
#include "fix_gravity.h"
#include "fix_property_global.h"
#include "force.h"
#include "pair_gran.h"
#include "update.h"

namespace furrow::coupling {

const StyleRow grain_work_style =
    fix_style<FixGrainWork>("grain/work", "bed", "grains/fix_grain_work.md");

Schema FixGrainWork::schema() {
  Schema schema("fix grain/work");
  schema.text("body", "id of the fix of the wheel whose track divides the grains");
  schema.number("level", "m", Range::any(), "z of the undisturbed ground");
  schema
      .integer("every", Range::at_least(1),
               "steps between two samples of the contacts; each costs about one step")
      .by_default(10);
  return schema;
}

const Outputs<FixGrainWork>& FixGrainWork::outputs() {
  using Fix = FixGrainWork;
  static const Outputs<Fix> list = {
      {"slide", "J",
       "work of tangential forces between grains: friction, and energy in their springs",
       [](Fix& fix) { return fix.over_ranks(fix.work_.slide); }},
      {"roll", "J", "work of rolling friction between grains",
       [](Fix& fix) { return fix.over_ranks(fix.work_.roll); }},
      {"normal", "J", "work of normal forces between grains: damping, and energy in their springs",
       [](Fix& fix) { return fix.over_ranks(fix.work_.square); }},
      {"below", "J", "part of these three at contacts below the track",
       [](Fix& fix) { return fix.over_ranks(fix.work_.below); }},
      {"ahead", "J", "part of these three at contacts ahead of the track, within its width",
       [](Fix& fix) { return fix.over_ranks(fix.work_.ahead); }},
      {"aside", "J", "part of these three at contacts at the sides of the track",
       [](Fix& fix) { return fix.over_ranks(fix.work_.aside); }},
      {"walls", "J", "work of grains on everything except grains and the wheel",
       [](Fix& fix) { return fix.over_ranks(fix.work_.walls); }},
      {"lifted", "J", "work of all grains against gravity",
       [](Fix& fix) { return fix.over_ranks(fix.work_.lifted); }},
      {"kinetic", "J", "present kinetic energy of all grains, rotation included",
       [](Fix& fix) { return fix.over_ranks(fix.kinetic_energy()); }},
  };
  return list;
}

FixGrainWork::FixGrainWork(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()),
      body_(use<FixBody>("body", {"wheel", "body"}).body()),
      level_(options().number("level")),
      every_(options().integer("every")) {
  require_unique<FixGrainWork>(*modify, options().subject(), "counts the work between grains",
                               "one fix grain/work", [](FixGrainWork&) { return true; });
  nevery = static_cast<int>(every_);
  provide(outputs());
  keep_state();
}

int FixGrainWork::setmask() { return LAMMPS_NS::FixConst::END_OF_STEP; }

void FixGrainWork::init() {
  collectively([&] {
    if (!dynamic_cast<LAMMPS_NS::PairGran*>(force->pair))
      throw InputError(name(), "has no contacts between grains", "pair_style gran ...",
                       "make a bed before this line");
    for (int c = 0; c < modify->ncompute; ++c)
      if (std::string(modify->compute[c]->style) == "pair/gran/local")
        throw InputError(
            name(),
            fmt::format("shares the contacts of grains with compute '{}', pair/gran/local",
                        modify->compute[c]->id),
            "one of the two in a run", "remove this fix, or that compute");
    friction_ = grains_are_snow(*lmp) ? nullptr : property_of_pairs(*lmp, "coefficientFriction");
  });
}

void FixGrainWork::end_of_step() {
  const double interval = static_cast<double>(every_) * update->dt;
  const Track where = track();
  double between_grains = 0.0;
  for_each_pair_contact(*lmp, [&](const PairContact& contact) {
    // another rank computes a contact with its grain too
    const double share = contact.j < atom->nlocal ? 1.0 : 0.5;
    const Taken power_taken = power(contact);
    work_.slide += share * interval * power_taken.slide;
    work_.roll += share * interval * power_taken.roll;
    work_.square += share * interval * power_taken.press;
    work_.*place_of(contact, where) += share * interval * power_taken.sum();
    between_grains += share * power_taken.sum();
  });
  const double lifting = lifting_power();
  work_.lifted += interval * lifting;
  work_.walls += interval * (power_of_wheel() - between_grains - lifting - power_of_all_forces());
}

void FixGrainWork::add_losses(const Body& wheel, GroundLosses& losses) const {
  if (&wheel != &body_) return;
  losses.grains = work_;
  losses.grains.kinetic = kinetic_energy();
  for (double* number : losses.grains.numbers()) *number = over_ranks(*number);
}

FixGrainWork::Track FixGrainWork::track() const {
  const Surface& surface = body_.surface();
  const auto [lower, upper] = surface.bounds();
  Track found{{0.5 * (lower[0] + upper[0]), 0.5 * (lower[1] + upper[1])},
              0.5 * (upper[1] - lower[1]),
              lower[0]};
  for (Eigen::Index n = 0; n < surface.x.cols(); ++n)
    if (surface.x(2, n) < level_) found.front = std::max(found.front, surface.x(0, n));
  found.front -= found.centre[0];
  return found;
}

FixGrainWork::Place FixGrainWork::place_of(const PairContact& contact, const Track& track) const {
  double x = 0.5 * (atom->x[contact.i][0] + atom->x[contact.j][0]) - track.centre[0];
  const double y = 0.5 * (atom->x[contact.i][1] + atom->x[contact.j][1]) - track.centre[1];
  if (domain->xperiodic) x -= domain->prd[0] * std::round(x / domain->prd[0]);
  if (std::abs(y) > track.half_width) return &GrainWork::aside;
  return x > track.front ? &GrainWork::ahead : &GrainWork::below;
}

double FixGrainWork::friction(const PairContact& contact) const {
  if (!friction_) return std::numeric_limits<double>::infinity();
  return friction_->compute_array(atom->type[contact.i] - 1, atom->type[contact.j] - 1);
}

// F on i, n from j to i, contact point at the radius less half the overlap from each centre
FixGrainWork::Taken FixGrainWork::power(const PairContact& contact) const {
  const int i = contact.i, j = contact.j;
  const Vector3 arm = vector(atom->x[i]) - vector(atom->x[j]);
  const double distance = arm.norm(), overlap = atom->radius[i] + atom->radius[j] - distance;
  const Vector3 n = arm / distance, velocity = vector(atom->v[i]) - vector(atom->v[j]),
                spin_i = vector(atom->omega[i]), spin_j = vector(atom->omega[j]);
  const double arm_i = atom->radius[i] - 0.5 * overlap, arm_j = atom->radius[j] - 0.5 * overlap;
  const double normal = contact.force.dot(n);
  Vector3 tangential = contact.force - normal * n;
  const Vector3 rolling = contact.torque + arm_i * n.cross(tangential);
  // LIGGGHTS has cut the spring of a sliding contact in this step, and would now add the damping of
  // one that sticks
  const double limit = friction(contact) * std::abs(normal);
  if (tangential.norm() > limit) tangential *= limit / tangential.norm();
  Taken taken;
  taken.press = -normal * velocity.dot(n);
  taken.slide = -tangential.dot(velocity - (arm_i * spin_i + arm_j * spin_j).cross(n));
  taken.roll = -rolling.dot(spin_i - spin_j);
  return taken;
}

/// A rig on a slope tilts the gravity of the scene.
double FixGrainWork::lifting_power() const {
  Vector3 momentum = Vector3::Zero(), gravity = Vector3::Zero();
  for (int i = 0; i < atom->nlocal; ++i) momentum += atom->rmass[i] * vector(atom->v[i]);
  for (auto* weight : fixes_of<LAMMPS_NS::FixGravity>(*modify)) {
    Vector3 one;
    weight->get_gravity(one.data());
    gravity += one;
  }
  for (const FixRig* fix : fixes_of<const FixRig>(*modify))
    if (fix->rig().on_slope())
      return -momentum.dot(fix->rig().tilt(FixCoupledSystem::of(*lmp).time()) * gravity);
  return -momentum.dot(gravity);
}

double FixGrainWork::power_of_all_forces() const {
  double power = 0.0;
  for (int i = 0; i < atom->nlocal; ++i)
    power += vector(atom->f[i]).dot(vector(atom->v[i])) +
             vector(atom->torque[i]).dot(vector(atom->omega[i]));
  return power;
}

double FixGrainWork::power_of_wheel() const {
  double power = 0.0;
  for (const GrainContact& contact : FixCoupledSystem::of(*lmp).contacts(body_))
    power += contact.force.dot(vector(atom->v[contact.grain])) +
             contact.torque.dot(vector(atom->omega[contact.grain]));
  return power;
}

double FixGrainWork::kinetic_energy() const {
  double energy = 0.0;
  for (int i = 0; i < atom->nlocal; ++i)
    energy += 0.5 * atom->rmass[i] *
              (vector(atom->v[i]).squaredNorm() +
               0.4 * atom->radius[i] * atom->radius[i] * vector(atom->omega[i]).squaredNorm());
  return energy;
}

double FixGrainWork::over_ranks(double value) const { return Communicator(&world).sum(value); }

void FixGrainWork::checkpoint(Checkpoint& state) {
  double sums[] = {work_.slide, work_.roll,  work_.square, work_.below,
                   work_.ahead, work_.aside, work_.walls,  work_.lifted};
  checkpoint_totals(state, Communicator(&world), sums);
  if (state.saving()) return;
  work_ = {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6], sums[7]};
}

}  // namespace furrow::coupling
