// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/data/saved_histories.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/data/contact_history.h"
#include "fix_contact_history_mesh.h"
#include "fix_property_atom.h"
#include "force.h"
#include "neigh_list.h"
#include "pair_gran.h"

namespace furrow::coupling {

namespace {

/// Calls visit(values, how many) for the neighbours of each grain, in the order of the lists.
template <class Visit>
void for_each_grain_of_pairs(LAMMPS_NS::LAMMPS& lammps, Visit&& visit) {
  const LAMMPS_NS::FixContactHistory* fix = find_contact_history(lammps);
  const LAMMPS_NS::Pair* pair = lammps.force->pair_match("gran", 1);
  if (!fix || !pair || !pair->list || !pair->list->listgranhistory) return;
  const LAMMPS_NS::NeighList& list = *pair->list;
  for (int n = 0; n < list.inum; ++n) {
    const int i = list.ilist[n];
    visit(list.listgranhistory->firstdouble[i],
          static_cast<std::size_t>(list.numneigh[i]) *
              static_cast<std::size_t>(list.listgranhistory->dnum));
  }
}

/// Contact histories of stock walls without a mesh: FixWallGran names them "history_<id>".
std::vector<LAMMPS_NS::FixPropertyAtom*> histories_of_walls(const LAMMPS_NS::LAMMPS& lammps) {
  auto found = fixes_of<LAMMPS_NS::FixPropertyAtom>(*lammps.modify);
  found.erase(std::remove_if(found.begin(), found.end(),
                             [](const LAMMPS_NS::FixPropertyAtom* fix) {
                               return std::string(fix->id).rfind("history_", 0) != 0 ||
                                      !fix->array_atom;
                             }),
              found.end());
  return found;
}

/// Calls visit(triangle, values) for the contacts of a grain; slots between them may be empty.
template <class Visit>
void for_each_contact(LAMMPS_NS::FixContactHistoryMesh& fix, int grain, Visit&& visit) {
  int left = fix.n_partner(grain);
  for (int slot = 0; left > 0; ++slot) {
    const int triangle = fix.get_partner_idTri(grain, slot);
    if (triangle < 0) continue;
    visit(triangle, fix.contacthistory(grain, slot));
    --left;
  }
}

}  // namespace

void SavedHistories::save(LAMMPS_NS::LAMMPS& lammps) {
  const int grains = lammps.atom->nlocal;
  pairs_.clear();
  walls_.clear();
  meshes_.clear();
  for_each_grain_of_pairs(lammps, [this](const double* values, std::size_t count) {
    pairs_.insert(pairs_.end(), values, values + count);
  });
  for (auto* fix : histories_of_walls(lammps)) {
    Values& wall = walls_.emplace_back();
    for (int i = 0; i < grains; ++i)
      wall.insert(wall.end(), fix->array_atom[i], fix->array_atom[i] + fix->get_nvalues());
  }
  for (auto* fix : fixes_of<LAMMPS_NS::FixContactHistoryMesh>(*lammps.modify)) {
    auto& mesh = meshes_.emplace_back(static_cast<std::size_t>(grains));
    for (int i = 0; i < grains; ++i)
      for_each_contact(*fix, i, [&](int triangle, const double* values) {
        mesh[static_cast<std::size_t>(i)][triangle].assign(values, values + fix->get_dnum());
      });
  }
}

void SavedHistories::put_back(LAMMPS_NS::LAMMPS& lammps) {
  const int grains = lammps.atom->nlocal;
  const double* next = pairs_.data();
  for_each_grain_of_pairs(lammps, [&](double* values, std::size_t count) {
    std::copy_n(next, count, values);
    next += count;
  });
  auto wall = walls_.begin();
  for (auto* fix : histories_of_walls(lammps)) {
    const double* of_grain = (wall++)->data();
    for (int i = 0; i < grains; ++i, of_grain += fix->get_nvalues())
      std::copy_n(of_grain, fix->get_nvalues(), fix->array_atom[i]);
  }
  auto mesh = meshes_.begin();
  for (auto* fix : fixes_of<LAMMPS_NS::FixContactHistoryMesh>(*lammps.modify)) {
    for (int i = 0; i < grains; ++i)
      for_each_contact(*fix, i, [&](int triangle, double* values) {
        const OfGrain& saved = (*mesh)[static_cast<std::size_t>(i)];
        if (const auto found = saved.find(triangle); found != saved.end())
          std::copy(found->second.begin(), found->second.end(), values);
      });
    ++mesh;
  }
}

}  // namespace furrow::coupling
