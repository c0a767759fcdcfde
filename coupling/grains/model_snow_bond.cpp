// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/grains/model_snow_bond.h"

#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "atom.h"
#include "core/error.h"
#include "coupling/base/fixes_of.h"
#include "coupling/contact/time_step_check.h"
#include "coupling/grains/fix_snow_energy.h"
#include "coupling/grains/fix_snow_sinter.h"
#include "coupling/liggghts/add_contact_model.h"
#include "coupling/liggghts/errors.h"
#include "coupling/liggghts/global_properties.h"
#include "coupling/liggghts/script.h"
#include "fix_property_global.h"
#include "force.h"
#include "grains/snow_bond.h"
#include "neighbor.h"
#include "pair_gran_proxy.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr int model_id = 20;  // LIGGGHTS's end at 12; below 64
// LIGGGHTS tells a model that two grains have parted only within this share of their radii
constexpr double parting_distance = 1.02;

Vector3 vector(const double* values) { return {values[0], values[1], values[2]}; }

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

Schema ModelSnowBond::schema() { return SnowBondParameters::schema(); }

void ModelSnowBond::add() { add_normal_model<model_id>(name); }

bool ModelSnowBond::is_pair_style(const LAMMPS_NS::LAMMPS& lammps) {
  auto* pair = dynamic_cast<LAMMPS_NS::PairGranProxy*>(lammps.force->pair);
  return pair && pair->hashcode() == LIGGGHTS::ContactModels::GranStyle<model_id>::HASHCODE;
}

void ModelSnowBond::require(const LAMMPS_NS::LAMMPS& lammps, const std::string& where,
                            const std::string& lacking) {
  if (!is_pair_style(lammps))
    throw InputError(where, "has no contacts " + lacking, "pair_style gran model snow/bond",
                     "write that pair style before the run");
}

}  // namespace furrow::coupling

namespace LIGGGHTS::ContactModels {

template <>
class NormalModel<furrow::coupling::model_id> : public NormalModelBase {
 public:
  NormalModel(LAMMPS* lammps, IContactHistorySetup* history, ContactModelBase* model);

  void registerSettings(Settings&) override {}
  void postSettings(IContactHistorySetup*, ContactModelBase*) override {}
  void connectToProperties(PropertyRegistry&) override;
  double stressStrainExponent() override { return 1.0; }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void surfacesIntersect(SurfacesIntersectData& touching, ForceData& on_i,
                         ForceData& on_j) override;
  void surfacesClose(SurfacesCloseData& parted, ForceData&, ForceData&) override;

 private:
  using Law = furrow::SnowBond;
  using State = furrow::SnowBondState;
  using Response = furrow::SnowBondResponse;

  const furrow::SnowBondParameters& law(int type, int other) const {
    return laws_[static_cast<std::size_t>(type * stride_ + other)];
  }
  furrow::SnowContact contact_of(const SurfacesIntersectData& touching) const;
  Response respond(const SurfacesIntersectData& touching) const;
  bool respond_elastically(const SurfacesIntersectData& touching, Response& response) const;
  /// Else the forces are those before the first step of a run.
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

  bool is_wall_;
  int first_value_ = 0;                           // of the state in the history
  std::vector<furrow::SnowBondParameters> laws_;  // by types
  int stride_ = 0;                                // of laws_, from one type to the next
  furrow::coupling::FixSnowSinter* sinter_ = nullptr;
  furrow::coupling::FixSnowEnergy* energy_ = nullptr;
  std::string warned_;  // of the time step
};

using SnowBondModel = NormalModel<furrow::coupling::model_id>;

/// "1": changes its sign when i and j swap.
SnowBondModel::NormalModel(LAMMPS* lammps, IContactHistorySetup* history, ContactModelBase* model)
    : NormalModelBase(lammps, history, model), is_wall_(model->is_wall()) {
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
    check_snow_time_step(*lmp, "model snow/bond", stiffest, [this](const std::string& text) {
      if (text != warned_) warn(*lmp, text);
      warned_ = text;
    });
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

/// Any other step, or none. It stands by itself, where elastic contacts need no registers for it.
[[gnu::noinline, gnu::flatten]] SnowBondModel::Response SnowBondModel::respond(
    const SurfacesIntersectData& touching) const {
  const furrow::SnowContact contact = contact_of(touching);
  const furrow::SnowBondParameters& parameters = law(touching.itype, touching.jtype);
  double* values = touching.contact_history + first_value_;
  State state = State::load(values);
  const bool sinters = is_sintered(touching);
  // Forces before the first step of a run: nothing has moved.
  if (!moves(touching)) {
    // of the parameters that this run has
    state.hardening = furrow::SnowHardening::at(parameters, state.crushing(contact.d));
    state.store(values);
    return sinters ? Response() : Law::hold(parameters, contact, state);
  }
  furrow::SnowBondEnergy energy;
  const Response response = sinters   ? Law::sinter(parameters, contact, state, &energy)
                            : energy_ ? Law::advance(parameters, contact, state, &energy)
                                      : Law::advance_yielding(parameters, contact, state, nullptr);
  state.store(values);
  if (energy_) {
    energy_->add(energy, state.bonded, share(touching));
    energy_->count(response, share(touching));
  }
  return response;
}

/// An elastic step whose energy nobody counts. @return false: it is another, and nothing is done
bool SnowBondModel::respond_elastically(const SurfacesIntersectData& touching,
                                        Response& response) const {
  if (energy_ || !moves(touching) || is_sintered(touching)) return false;
  double* values = touching.contact_history + first_value_;
  State state = State::load(values);
  if (!Law::advance_elastic(law(touching.itype, touching.jtype), contact_of(touching), state,
                            response, nullptr))
    return false;
  state.store_elastic(values);
  return true;
}

/// With all calls inlined, which saves an eighth of the instructions of a step.
[[gnu::flatten]] void SnowBondModel::surfacesIntersect(SurfacesIntersectData& touching,
                                                       ForceData& on_i, ForceData& on_j) {
  using furrow::Vector3;
  if (touching.contact_flags) *touching.contact_flags |= CONTACT_NORMAL_MODEL;
  Response response;
  if (!respond_elastically(touching, response)) response = respond(touching);

  const double cri = touching.cri, crj = touching.crj;
  const Vector3 pushed = response.force, moment = response.moment,
                couple = furrow::coupling::vector(touching.en).cross(pushed),
                on_i_about = moment - cri * couple, on_j_about = moment + crj * couple;
  for (int c = 0; c < 3; ++c) on_i.delta_F[c] += pushed[c];
  for (int c = 0; c < 3; ++c) on_i.delta_torque[c] += on_i_about[c];
  if (is_wall_) return;
  for (int c = 0; c < 3; ++c) on_j.delta_F[c] -= pushed[c];
  for (int c = 0; c < 3; ++c) on_j.delta_torque[c] -= on_j_about[c];
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
