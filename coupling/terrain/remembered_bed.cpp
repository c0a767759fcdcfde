// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/remembered_bed.h"

#include <algorithm>

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "coupling/liggghts/contact_history.h"
#include "coupling/liggghts/exchange_buffer.h"

namespace furrow::coupling {

namespace {

constexpr std::size_t header = 2;  // before each packed grain: its length, where its contacts are

/// The same numbers of all ranks, in rank order.
std::vector<double> gather_all(const std::vector<double>& own, MPI_Comm ranks, int rank_count) {
  int count = static_cast<int>(own.size());
  std::vector<int> counts(static_cast<std::size_t>(rank_count));
  std::vector<int> starts(counts.size() + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, ranks);
  for (std::size_t r = 0; r < counts.size(); ++r) starts[r + 1] = starts[r] + counts[r];
  std::vector<double> all(static_cast<std::size_t>(starts.back()));
  MPI_Allgatherv(own.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                 MPI_DOUBLE, ranks);
  return all;
}

}  // namespace

RememberedBed::RememberedBed(LAMMPS_NS::LAMMPS& lammps) {
  LAMMPS_NS::FixContactHistory* history = find_contact_history(lammps);
  has_contacts_ = history != nullptr;
  if (history) contact_values_ = static_cast<std::size_t>(history->get_dnum());
  gather(lammps);
  if (has_contacts_) refer_partners_by_index();
}

void RememberedBed::gather(LAMMPS_NS::LAMMPS& lammps) {
  std::vector<double> own;
  for (int i = 0; i < lammps.atom->nlocal; ++i) {
    const PackedGrain grain = pack_grain(lammps, i);
    own.push_back(static_cast<double>(grain.numbers.size()));
    own.push_back(static_cast<double>(grain.contacts_at));
    own.insert(own.end(), grain.numbers.begin(), grain.numbers.end());
  }
  const std::vector<double> all = gather_all(own, lammps.world, lammps.comm->nprocs);

  std::vector<const double*> grains;  // each at its header
  for (std::size_t p = 0; p < all.size(); p += header + static_cast<std::size_t>(all[p]))
    grains.push_back(&all[p]);
  std::sort(grains.begin(), grains.end(), [](const double* a, const double* b) {
    return packed_tag(a + header) < packed_tag(b + header);
  });
  for (const double* grain : grains) {
    offset_.push_back(packed_.size());
    contacts_at_.push_back(static_cast<std::size_t>(grain[1]));
    latest_tag_.push_back(packed_tag(grain + header));
    packed_.insert(packed_.end(), grain + header,
                   grain + header + static_cast<std::size_t>(grain[0]));
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
    PackedContacts contacts(packed(g) + contacts_at_[g], contact_values_);
    for (std::size_t n = 0; n < contacts.count(); ++n) {
      const auto found =
          std::lower_bound(latest_tag_.begin(), latest_tag_.end(), contacts.partner(n));
      contacts.set_partner(n, static_cast<int>(found - latest_tag_.begin()));
    }
  }
}

const double* RememberedBed::position(std::size_t grain) const {
  return packed_position(packed(grain));
}
double RememberedBed::radius(std::size_t grain) const { return packed_radius(packed(grain)); }

std::size_t RememberedBed::packed_size(std::size_t grain) const {
  return (grain + 1 < size() ? offset_[grain + 1] : packed_.size()) - offset_[grain];
}

void RememberedBed::renumber(const std::vector<std::size_t>& grains) {
  for (const std::size_t g : grains) latest_tag_[g] = ++largest_tag_;
}

void RememberedBed::put_in(LAMMPS_NS::LAMMPS& lammps, std::size_t grain,
                           const std::function<bool(std::size_t)>& is_gone) const {
  const double* first = packed(grain);
  std::vector<double> copy(first, first + packed_size(grain));
  set_packed_tag(copy.data(), latest_tag_[grain]);
  if (has_contacts_) {
    // Partners that are gone are left out; what follows the contacts moves up.
    const std::size_t begin = contacts_at_[grain];
    std::vector<double> kept(copy.begin() + static_cast<std::ptrdiff_t>(begin), copy.end());
    PackedContacts contacts(kept.data(), contact_values_);
    PackedContacts copied(copy.data() + begin, contact_values_);
    std::size_t count = 0;
    for (std::size_t n = 0; n < contacts.count(); ++n) {
      const auto partner = static_cast<std::size_t>(contacts.partner(n));
      if (partner >= size() || is_gone(partner)) continue;
      copied.replace(count++, latest_tag_[partner], contacts.values(n));
    }
    const std::size_t whole = contacts.size();
    copied.set_count(count);
    copy.erase(copy.begin() + static_cast<std::ptrdiff_t>(begin + copied.size()),
               copy.begin() + static_cast<std::ptrdiff_t>(begin + whole));
  }
  add_grain(lammps, copy);
}

}  // namespace furrow::coupling
