// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wall/gran/body: LIGGGHTS's granular wall with Furrow's own contact detection. See
/// fix_wall_gran_body.md.

#include <map>
#include <vector>

#include "geometry/closest_feature.h"
#include "coupling/terrain/grain_bed_check.h"
#include "fix_wall_gran.h"

namespace furrow::coupling {

class BodyMesh;
class FixMeshBody;
struct ContactLedger;

class FixWallGranBody : public LAMMPS_NS::FixWallGran {
 public:
  FixWallGranBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);

  void init() override;
  void setup(int vflag) override;

 protected:
  void post_force_mesh(int vflag) override;

 private:
  void post_force_stock_meshes(int vflag);
  void post_force_body(FixMeshBody& mesh_fix, int mesh_number);
  void collect_candidates(FixMeshBody& mesh_fix);
  void apply(FixMeshBody& mesh_fix, int mesh_number, int grain, const ContactCandidate& contact,
             const Vector3& moment_reference, ContactLedger& ledger);
  double* history_of(LAMMPS_NS::FixContactHistoryMesh& history, const BodyMesh& mesh, int grain,
                     const ContactCandidate& contact, bool touching) const;
  void refuse_deep_start();

  ContactSelection selection_;
  std::vector<LAMMPS_NS::FixMeshSurface*> stock_meshes_;

  // Work space, kept between steps. Candidates of one grain form a chain through next_.
  std::vector<ContactCandidate> candidates_;
  std::vector<int> next_;
  std::vector<int> first_;    // of each local grain; -1: none
  std::vector<int> touched_;  // grains with candidates, in the order found
  std::vector<ContactCandidate> of_grain_;
  // in the set-up of the first run: deep contacts are counted, not computed
  bool starting_ = false;
  double deepest_ = 0.0;  // largest overlap over radius in the last call
  std::map<int, GrainBedCheck>
      grain_bed_checks_;            // of each mesh of a body, by its place in the list
  GrainBedCheck* check_ = nullptr;  // of the mesh at work
};

}  // namespace furrow::coupling
