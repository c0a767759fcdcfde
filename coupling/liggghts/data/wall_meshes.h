// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The list of meshes that a wall/gran works on, changed for the length of a scope.

#include <utility>
#include <vector>

#include "fix_mesh_surface.h"

namespace furrow::coupling {

/// FixWallGran loops over FixMesh_list_ and n_FixMesh_, both protected: a derived wall hands them
/// in to have its base class see some of its meshes only. They are back at the end of the scope,
/// also when an exception leaves it.
class WallMeshes {
 public:
  using List = LAMMPS_NS::FixMeshSurface**;
  WallMeshes(List& list, int& count, std::vector<LAMMPS_NS::FixMeshSurface*>& seen)
      : list_(list),
        count_(count),
        whole_list_(std::exchange(list, seen.data())),
        whole_count_(std::exchange(count, static_cast<int>(seen.size()))) {}
  ~WallMeshes() {
    list_ = whole_list_;
    count_ = whole_count_;
  }
  WallMeshes(const WallMeshes&) = delete;
  WallMeshes& operator=(const WallMeshes&) = delete;

 private:
  List& list_;
  int& count_;
  List whole_list_;
  int whole_count_;
};

}  // namespace furrow::coupling
