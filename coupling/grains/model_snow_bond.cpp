// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/grains/model_snow_bond.h"

#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/error.h"
#include "coupling/base/loads/snow_pairs.h"
#include "coupling/base/checks/time_step_check.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/grains/fix_snow_energy.h"
#include "coupling/grains/fix_snow_sinter.h"
#include "coupling/grains/snow_overlap_check.h"
#include "coupling/liggghts/styles/add_contact_model.h"
#include "coupling/liggghts/errors/errors.h"
#include "coupling/liggghts/data/global_properties.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/liggghts/data/vector.h"
#include "fix_property_global.h"
#include "force.h"
#include "furrow/grains/snow_bond.h"
#include "neighbor.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// LIGGGHTS tells a model that two grains have parted only within this share of their radii
constexpr double parting_distance = 1.02;

/// The parameters of two types of grains, from properties named by the keys of the law.
SnowBondParameters read_parameters(LAMMPS_NS::LAMMPS& lammps, int type, int other) {
  const Schema schema = ModelSnowBond::schema();
  const int types = lammps.atom->ntypes;
  std::vector<Entry> entries;
  for (const Key& key : schema.keys()) {
    const std::string where = fmt::format("{}, property '{}'", schema.subject(), key.name);
    const std::string remedy =
        fmt::format("write 'fix <id> all property/global {} peratomtypepair {} <{} values>'",
                    key.name, types, types * types);
    auto* property = property_of_pairs(lammps, key.name);
    if (!property) throw InputError(where, "is missing", key.allowed(), remedy);
    const double value = property->compute_array(type - 1, other - 1);
    if (!key.range.contains(value))
      throw InputError(where, fmt::format("is {:g} for types {} and {}", value, type, other),
                       key.allowed(), remedy);
    entries.push_back({key.name, {fmt::format("{}", value)}});
  }
  return SnowBondParameters::from(schema.read(entries));
}

}  // namespace

const StyleRow snow_bond_style = model_style<ModelSnowBond>("grains/model_snow_bond.md");

Schema ModelSnowBond::schema() { return SnowBondParameters::schema(); }

void ModelSnowBond::require(const LAMMPS_NS::LAMMPS& lammps, const std::string& where,
                            const std::string& lacking) {
  if (!grains_are_snow(lammps))
    throw InputError(where, "has no contacts " + lacking, "pair_style gran model snow/bond",
                     "write that pair style before the run");
}

}  // namespace furrow::coupling

namespace LIGGGHTS::ContactModels {

template <>
class NormalModel<furrow::coupling::snow_bond_id> : public NormalModelBase {
 public:
  NormalModel(LAMMPS* lammps, IContactHistorySetup* history, ContactModelBase* model);

  void registerSettings(Settings&) override {}
  void postSettings(IContactHistorySetup*, ContactModelBase*) override {}
  void connectToProperties(PropertyRegistry&) override;
  double stressStrainExponent() override { return 1.0; }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) override {
    if (!is_wall_) overlaps_.finish_step();
  }
  void surfacesIntersect(SurfacesIntersectData& touching, ForceData& on_i,
                         ForceData& on_j) override;
  void surfacesClose(SurfacesCloseData& parted, ForceData&, ForceData&) override;

 private:
  using Law = furrow::SnowBond;
  using State = furrow::SnowBondState;
  using Trial = furrow::SnowBondTrial;
  using Response = furrow::SnowBondResponse;

  const furrow::SnowBondParameters& law(int type, int other) const {
    return laws_[static_cast<std::size_t>(type * stride_ + other)];
  }
  furrow::SnowContact contact_of(const SurfacesIntersectData& touching) const;
  template <bool counts_energy>
  void advance(const SurfacesIntersectData& touching, ForceData& on_i, ForceData& on_j);
  void exert(const Response& response, const SurfacesIntersectData& touching, ForceData& on_i,
             ForceData& on_j) const;
  Response yield(const furrow::SnowBondParameters& parameters, const furrow::SnowContact& contact,
                 const Trial& trial, double* values, double share) const;
  Response stand(SurfacesIntersectData touching) const;
  /// True in a step; false when the forces are those before the first step of a run.
  static bool moves(const SurfacesIntersectData& touching) {
    return touching.computeflag && touching.shearupdate;
  }
  bool is_sintered(const SurfacesIntersectData& touching) const {
    return sinter_ && sinter_->sinters(touching.i, is_wall_ ? touching.i : touching.j);
  }
  /// Energy of a wall is half of that of the contact with its mirror image; a contact with a ghost
  /// is computed by both ranks.
  double share(const SurfacesCloseData& contact) const {
    return is_wall_ || contact.j >= atom->nlocal ? 0.5 : 1.0;
  }

  // yield() by itself, where elastic contacts need no registers for it, with copies, so that what
  // it is given stays in registers otherwise; see ShortPairLoop
  using Yield = Response (NormalModel::*)(const furrow::SnowBondParameters&, furrow::SnowContact,
                                          Trial, double*, double) const;
  [[gnu::noinline, gnu::flatten]] Response yield_baseline(
      const furrow::SnowBondParameters& parameters, furrow::SnowContact contact, Trial trial,
      double* values, double share) const {
    return yield(parameters, contact, trial, values, share);
  }
#ifdef FURROW_X86_KERNELS
  [[gnu::noinline, gnu::flatten, gnu::target("avx2")]] Response yield_avx2(
      const furrow::SnowBondParameters& parameters, furrow::SnowContact contact, Trial trial,
      double* values, double share) const {
    return yield(parameters, contact, trial, values, share);
  }
  Yield yield_ = furrow::chosen_instruction_set() == furrow::InstructionSet::baseline
                     ? &NormalModel::yield_baseline
                     : &NormalModel::yield_avx2;
#else
  Yield yield_ = &NormalModel::yield_baseline;
#endif

  bool is_wall_;
  int first_value_ = 0;                           // of the state in the history
  std::vector<furrow::SnowBondParameters> laws_;  // by types
  int stride_ = 0;                                // of laws_, from one type to the next
  furrow::coupling::FixSnowSinter* sinter_ = nullptr;
  furrow::coupling::FixSnowEnergy* energy_ = nullptr;
  furrow::coupling::SnowOverlapCheck overlaps_;
  std::string warned_;  // of the time step
};

using SnowBondModel = NormalModel<furrow::coupling::snow_bond_id>;

/// Values of the contact history; those marked "1" change their sign when i and j swap.
SnowBondModel::NormalModel(LAMMPS* lammps, IContactHistorySetup* history, ContactModelBase* model)
    : NormalModelBase(lammps, history, model), is_wall_(model->is_wall()), overlaps_(*lammps) {
  using Value = std::pair<const char*, const char*>;
  constexpr std::array<Value, State::size> values = {{{"plastic", "0"},
                                                      {"at_sintering", "0"},
                                                      {"at_break", "0"},
                                                      {"area", "0"},
                                                      {"bonded", "0"},
                                                      {"shear_x", "1"},
                                                      {"bending_x", "1"},
                                                      {"shear_y", "1"},
                                                      {"bending_y", "1"},
                                                      {"shear_z", "1"},
                                                      {"bending_z", "1"},
                                                      {"torsion", "0"},
                                                      {"hardening_soft", "0"},
                                                      {"hardening_dense", "0"},
                                                      {"hardening_bond", "0"}}};
  for (std::size_t n = 0; n < values.size(); ++n) {
    const int place =
        history->add_history_value(std::string("snow_") + values[n].first, values[n].second);
    if (n == 0) first_value_ = place;
  }
}

/// Before every run.
void SnowBondModel::connectToProperties(PropertyRegistry&) {
  using namespace furrow::coupling;
  stride_ = atom->ntypes + 1;
  with_collective_errors(*error, [&] {
    laws_.assign(static_cast<std::size_t>(stride_ * stride_), {});
    for (int i = 1; i < stride_; ++i)
      for (int j = 1; j < stride_; ++j)
        laws_[static_cast<std::size_t>(i * stride_ + j)] = read_parameters(*lmp, i, j);
  });
  const auto sinters = fixes_of<FixSnowSinter>(*modify);
  const auto energies = fixes_of<FixSnowEnergy>(*modify);
  sinter_ = sinters.empty() ? nullptr : sinters.front();
  energy_ = energies.empty() ? nullptr : energies.front();
  if (is_wall_) return;
  neighbor->register_contact_dist_factor(parting_distance);
  with_collective_errors(*error, [&] {
    const auto stiffest = [this](int type) {
      double most = 0.0;
      for (int other = 1; other <= atom->ntypes; ++other) most = std::max(most, law(type, other).E);
      return most;
    };
    const auto found = check_snow_time_step(*lmp, "model snow/bond", stiffest);
    if (!found) return;
    if (found->stops) throw furrow::InputError(found->text);
    if (found->text != warned_) warn(*lmp, found->text);
    warned_ = found->text;
  });
}

furrow::SnowContact SnowBondModel::contact_of(const SurfacesIntersectData& touching) const {
  using furrow::Vector3;
  using furrow::coupling::vector;
  const Vector3 omega_i = vector(touching.omega_i);
  furrow::SnowContact contact;
  contact.normal = vector(touching.en);
  contact.dt = update->dt;
  contact.sinters = !is_wall_;
  const Vector3 sliding(touching.vtr1, touching.vtr2, touching.vtr3);
  if (is_wall_) {
    // The mirror image of a grain behind a wall moves as the grain does, the other way.
    contact.d = 2.0 * touching.radi;
    contact.mass = 0.5 * touching.meff;
    contact.overlap = 2.0 * touching.deltan;
    contact.normal_velocity = 2.0 * touching.vn;
    contact.tangential_velocity = 2.0 * sliding;
    contact.rotation = 2.0 * omega_i;
    contact.spin = 0.5 * omega_i.dot(contact.normal);
    return contact;
  }
  const Vector3 omega_j = vector(touching.omega_j);
  contact.d = touching.radi + touching.radj;
  contact.mass = touching.meff;
  contact.overlap = touching.deltan;
  contact.normal_velocity = touching.vn;
  contact.tangential_velocity = sliding;
  contact.rotation = omega_i - omega_j;
  contact.spin = 0.5 * (omega_i + omega_j).dot(contact.normal);
  return contact;
}

/// A contact that is sintered in this step, or has not moved: before the first step of a run.
[[gnu::noinline]] SnowBondModel::Response SnowBondModel::stand(
    const SurfacesIntersectData touching) const {
  const furrow::SnowContact contact = contact_of(touching);
  const furrow::SnowBondParameters& parameters = law(touching.itype, touching.jtype);
  double* values = touching.contact_history + first_value_;
  State state = State::load(values);
  const bool sinters = is_sintered(touching);
  if (!moves(touching)) {
    // hardening by the parameters of this run; if they have not changed, its bits stay
    const double X = state.crushing(contact.d);
    if (!state.hardening.is_at(parameters, X))
      state.hardening = furrow::SnowHardening::at(parameters, X);
    state.store(values);
    return sinters ? Response() : Law::hold(parameters, contact, state);
  }
  furrow::SnowBondEnergy energy;
  const Response response = Law::sinter(parameters, contact, state, &energy);
  state.store(values);
  if (energy_) {
    energy_->add(energy, state.bonded, share(touching));
    energy_->count(response, share(touching));
  }
  return response;
}

SnowBondModel::Response SnowBondModel::yield(const furrow::SnowBondParameters& parameters,
                                             const furrow::SnowContact& contact, const Trial& trial,
                                             double* values, double share) const {
  State state = State::load(values);
  furrow::SnowBondEnergy energy;
  const Response response =
      Law::advance_yielding(parameters, contact, trial, state, energy_ ? &energy : nullptr);
  state.store(values);
  if (energy_) {
    energy_->add(energy, state.bonded, share);
    energy_->count(response, share);
  }
  return response;
}

void SnowBondModel::exert(const Response& response, const SurfacesIntersectData& touching,
                          ForceData& on_i, ForceData& on_j) const {
  const furrow::Vector3 couple = furrow::coupling::vector(touching.en).cross(response.force);
  for (int c = 0; c < 3; ++c) {
    on_i.delta_F[c] = response.force[c];
    on_i.delta_torque[c] = response.moment[c] - touching.cri * couple[c];
  }
  if (is_wall_) return;
  for (int c = 0; c < 3; ++c) {
    on_j.delta_F[c] = -response.force[c];
    on_j.delta_torque[c] = -(response.moment[c] + touching.crj * couple[c]);
  }
}

/// Each way exerts its forces itself: those of the elastic one then never leave the registers.
template <bool counts_energy>
void SnowBondModel::advance(const SurfacesIntersectData& touching, ForceData& on_i,
                            ForceData& on_j) {
  const furrow::SnowContact contact = contact_of(touching);
  const furrow::SnowBondParameters& parameters = law(touching.itype, touching.jtype);
  double* values = touching.contact_history + first_value_;
  State state = State::load(values);
  const Trial trial(parameters, contact, state);
  Response response;
  furrow::SnowBondEnergy energy;
  if (!Law::advance_elastic(parameters, contact, trial, state, response,
                            counts_energy ? &energy : nullptr)) {
    if (!is_wall_) overlaps_.contact(contact.overlap, contact.d, touching.i, touching.j);
    return exert((this->*yield_)(parameters, contact, trial, values, share(touching)), touching,
                 on_i, on_j);
  }
  state.store_elastic(values);
  if (counts_energy) energy_->add_elastic(energy, share(touching));
  exert(response, touching, on_i, on_j);
}

/// With all calls inlined, which saves an eighth of the instructions of a step.
[[gnu::flatten]] void SnowBondModel::surfacesIntersect(SurfacesIntersectData& touching,
                                                       ForceData& on_i, ForceData& on_j) {
  if (touching.contact_flags) *touching.contact_flags |= CONTACT_NORMAL_MODEL;
  if (!moves(touching) || is_sintered(touching))
    exert(stand(touching), touching, on_i, on_j);
  else if (energy_)
    advance<true>(touching, on_i, on_j);
  else
    advance<false>(touching, on_i, on_j);
}

void SnowBondModel::surfacesClose(SurfacesCloseData& parted, ForceData&, ForceData&) {
  if (parted.contact_flags) *parted.contact_flags &= ~CONTACT_NORMAL_MODEL;
  if (!parted.contact_history) return;
  double* values = parted.contact_history + first_value_;
  State state = State::load(values);
  const bool bonded = state.bonded;
  if (state.plastic == 0.0 && state.across.first().isZero(0.0)) return;
  const double d = is_wall_ ? 2.0 * parted.radi : parted.radi + parted.radj;
  const double energy = Law::part(law(parted.itype, parted.jtype), d, state);
  state.store(values);
  if (energy_) energy_->release(energy, bonded, share(parted));
}

}  // namespace LIGGGHTS::ContactModels

namespace furrow::coupling {

namespace exposed {

using SnowModel =
    LIGGGHTS::ContactModels::ContactModel<LIGGGHTS::ContactModels::GranStyle<snow_bond_id>>;
using SnowPairs = LIGGGHTS::PairStyles::Granular<SnowModel>;

FURROW_EXPOSE(ModelOfSnowPairs, SnowPairs, SnowModel, cmodel);

}  // namespace exposed

void ModelSnowBond::add() { add_normal_model<snow_bond_id, exposed::ModelOfSnowPairs>(name); }

}  // namespace furrow::coupling
