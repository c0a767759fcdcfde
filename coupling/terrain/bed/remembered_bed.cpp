// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/remembered_bed.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/data/contact_history.h"
#include "coupling/liggghts/data/exchange_buffer.h"

namespace furrow::coupling {

namespace {

std::optional<std::size_t> place_of(const std::string& rider,
                                    const std::vector<std::string>& riders) {
  const auto found = std::find(riders.begin(), riders.end(), rider);
  if (found == riders.end()) return std::nullopt;
  return static_cast<std::size_t>(found - riders.begin());
}

}  // namespace

void RememberedBed::remember(LAMMPS_NS::LAMMPS& lammps) {
  riders_ = riders(lammps);
  if (LAMMPS_NS::FixContactHistory* history = find_contact_history(lammps)) {
    contacts_ = place_of(history->id, riders_);
    contact_values_ = static_cast<std::size_t>(history->get_dnum());
  }
  gather(lammps);
  if (contacts_) refer_partners_by_index();
}

/// Gathers the grains of all ranks. Each comes after its size and the places of its riders' parts.
void RememberedBed::gather(LAMMPS_NS::LAMMPS& lammps) {
  const std::size_t header = 1 + riders_.size();
  std::vector<double> own;
  for (int i = 0; i < lammps.atom->nlocal; ++i) {
    const PackedGrain grain = pack_grain(lammps, i);
    own.push_back(static_cast<double>(grain.numbers.size()));
    own.insert(own.end(), grain.parts_at.begin(), grain.parts_at.end());
    own.insert(own.end(), grain.numbers.begin(), grain.numbers.end());
  }
  const std::vector<double> all = Communicator(&lammps.world).gather(own);

  std::vector<const double*> grains;  // grains, each at its header
  for (std::size_t p = 0; p < all.size(); p += header + static_cast<std::size_t>(all[p]))
    grains.push_back(&all[p]);
  std::sort(grains.begin(), grains.end(), [&](const double* a, const double* b) {
    return packed_tag(a + header) < packed_tag(b + header);
  });
  for (const double* grain : grains) {
    const std::size_t first = packed_.size();
    const auto size = static_cast<std::size_t>(grain[0]);
    for (std::size_t r = 0; r < riders_.size(); ++r)
      bounds_.push_back(first + static_cast<std::size_t>(grain[1 + r]));
    bounds_.push_back(first + size);
    latest_tag_.push_back(packed_tag(grain + header));
    packed_.insert(packed_.end(), grain + header, grain + header + size);
  }
  for (std::size_t g = 0; g < size(); ++g) {
    std::fill_n(packed_velocity(packed(g)), 3, 0.0);
    std::fill_n(packed_angular_velocity(packed(g)), 3, 0.0);
  }
  largest_tag_ = latest_tag_.empty() ? 0 : latest_tag_.back();
}

/// Tags change with every copy. A partner that is no grain of the bed gets the index size().
void RememberedBed::refer_partners_by_index() {
  for (std::size_t g = 0; g < size(); ++g) {
    PackedContacts contacts(&packed_[begin(g, *contacts_)], contact_values_);
    for (std::size_t n = 0; n < contacts.count(); ++n) {
      const auto found =
          std::lower_bound(latest_tag_.begin(), latest_tag_.end(), contacts.partner(n));
      contacts.set_partner(n, static_cast<int>(found - latest_tag_.begin()));
    }
  }
}

void RememberedBed::follow_riders(const LAMMPS_NS::LAMMPS& lammps) {
  const std::vector<std::string> wanted = riders(lammps);
  if (wanted == riders_) return;
  std::vector<std::size_t> places;  // in riders_
  for (const std::string& rider : wanted) {
    const auto place = place_of(rider, riders_);
    if (!place)
      throw StateError(
          fmt::format("the grains of the bed have no numbers of fix '{}', which was not there when "
                      "the bed was remembered; leave out its line, or start the run from its "
                      "beginning with it",
                      rider));
    places.push_back(*place);
  }
  RememberedBed other;
  for (std::size_t g = 0; g < size(); ++g) {
    const auto append = [&](std::size_t first, std::size_t last) {
      other.packed_.insert(other.packed_.end(),
                           packed_.begin() + static_cast<std::ptrdiff_t>(first),
                           packed_.begin() + static_cast<std::ptrdiff_t>(last));
    };
    append(begin(g), begin(g, 0));
    for (const std::size_t place : places) {
      other.bounds_.push_back(other.packed_.size());
      append(begin(g, place), begin(g, place + 1));
    }
    other.bounds_.push_back(other.packed_.size());
  }
  if (contacts_) contacts_ = place_of(riders_[*contacts_], wanted);
  packed_ = std::move(other.packed_);
  bounds_ = std::move(other.bounds_);
  riders_ = wanted;
}

void RememberedBed::checkpoint(Checkpoint& state) {
  std::string names;
  for (const std::string& rider : riders_) names += rider + '\n';
  state.value("riders", names);
  riders_.clear();
  std::istringstream lines(names);
  for (std::string rider; std::getline(lines, rider);) riders_.push_back(rider);
  std::int64_t contacts = contacts_ ? static_cast<std::int64_t>(*contacts_) : -1;
  state.value("rider with the contacts", contacts);
  contacts_.reset();
  if (contacts >= 0) contacts_ = static_cast<std::size_t>(contacts);
  auto values = static_cast<std::int64_t>(contact_values_);
  state.value("values of a contact", values);
  contact_values_ = static_cast<std::size_t>(values);
  state.values("grains", packed_);
  state.values("bounds", bounds_);
  state.values("tags", latest_tag_);
  state.value("largest tag", largest_tag_);
}

const double* RememberedBed::position(std::size_t grain) const {
  return packed_position(packed(grain));
}
double RememberedBed::radius(std::size_t grain) const { return packed_radius(packed(grain)); }

void RememberedBed::renumber(const std::vector<std::size_t>& grains) {
  for (const std::size_t g : grains) latest_tag_[g] = ++largest_tag_;
}

void RememberedBed::put_in(LAMMPS_NS::LAMMPS& lammps, std::size_t grain,
                           const std::function<bool(std::size_t)>& is_gone) const {
  std::vector<double> copy(packed(grain), packed_.data() + begin(grain + 1));
  set_packed_tag(copy.data(), latest_tag_[grain]);
  if (contacts_) {
    // Partners that are gone are left out; what follows the contacts moves up.
    const std::size_t contacts_at = begin(grain, *contacts_) - begin(grain);
    std::vector<double> kept(copy.begin() + static_cast<std::ptrdiff_t>(contacts_at), copy.end());
    PackedContacts contacts(kept.data(), contact_values_);
    PackedContacts copied(copy.data() + contacts_at, contact_values_);
    std::size_t count = 0;
    for (std::size_t n = 0; n < contacts.count(); ++n) {
      const auto partner = static_cast<std::size_t>(contacts.partner(n));
      if (partner >= size() || is_gone(partner)) continue;
      copied.replace(count++, latest_tag_[partner], contacts.values(n));
    }
    const std::size_t whole = contacts.size();
    copied.set_count(count);
    copy.erase(copy.begin() + static_cast<std::ptrdiff_t>(contacts_at + copied.size()),
               copy.begin() + static_cast<std::ptrdiff_t>(contacts_at + whole));
  }
  add_grain(lammps, copy);
}

}  // namespace furrow::coupling
