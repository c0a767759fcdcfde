// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/contact_history.h"

#include <algorithm>
#include <string>

#include "coupling/liggghts/data/packed_integer.h"
#include "modify.h"

namespace furrow::coupling {

namespace {

constexpr char history_style[] = "contacthistory";

}  // namespace

LAMMPS_NS::FixContactHistory* find_contact_history(LAMMPS_NS::LAMMPS& lammps) {
  return dynamic_cast<LAMMPS_NS::FixContactHistory*>(
      lammps.modify->find_fix_style_strict(history_style, 0));
}

void update_contact_histories(LAMMPS_NS::LAMMPS& lammps) {
  for (int i = 0; i < lammps.modify->nfix; ++i)
    if (lammps.modify->fix[i]->style == std::string(history_style))
      lammps.modify->fix[i]->setup_pre_exchange();
}

std::size_t PackedContacts::count() const {
  return static_cast<std::size_t>(unpack_integer(*first_));
}

int PackedContacts::partner(std::size_t contact) const { return unpack_integer(*entry(contact)); }

void PackedContacts::replace(std::size_t contact, int partner, const double* values) {
  set_partner(contact, partner);
  std::copy_n(values, values_, entry(contact) + 1);
}

void PackedContacts::set_count(std::size_t count) {
  *first_ = pack_integer(static_cast<int>(count));
}

void PackedContacts::set_partner(std::size_t contact, int partner) {
  *entry(contact) = pack_integer(partner);
}

}  // namespace furrow::coupling
