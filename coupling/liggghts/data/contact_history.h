// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Histories of the contacts between grains (fix contacthistory of LIGGGHTS, made by the pair
/// style).

#include <cstddef>

#include "lammps.h"
#include "fix_contact_history.h"

namespace furrow::coupling {

/// Finds the fix that keeps histories; null before the pair style was set up, and for one without
/// history.
LAMMPS_NS::FixContactHistory* find_contact_history(LAMMPS_NS::LAMMPS& lammps);

/// Brings what the grains carry of their contacts up to date, as LIGGGHTS itself does only when
/// neighbour lists are made: for restart files written in the middle of a run.
void update_contact_histories(LAMMPS_NS::LAMMPS& lammps);

/// Contacts of one grain as FixContactHistory::pack_exchange writes them: their number, then of
/// each the partner's tag and the values of the contact. Integers are stored bit by bit.
class PackedContacts {
 public:
  /// @param values of a contact: FixContactHistory::get_dnum()
  PackedContacts(double* first, std::size_t values) : first_(first), values_(values) {}

  std::size_t count() const;
  int partner(std::size_t contact) const;
  /// Values of a contact of this grain.
  const double* values(std::size_t contact) const { return entry(contact) + 1; }
  std::size_t size() const { return 1 + count() * (1 + values_); }  ///< in numbers

  void set_partner(std::size_t contact, int partner);
  /// Puts another contact into the place of one. @param values of the contact
  void replace(std::size_t contact, int partner, const double* values);
  /// Forgets the contacts from this number on.
  void set_count(std::size_t count);

 private:
  double* entry(std::size_t contact) const { return first_ + 1 + contact * (1 + values_); }

  double* first_;
  std::size_t values_;
};

}  // namespace furrow::coupling
