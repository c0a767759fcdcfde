// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix wall/gran/body: LIGGGHTS's granular wall with Furrow's own contact detection. See
/// fix_wall_gran_body.md.

#include <map>
#include <vector>

#include "coupling/base/roles/fix_user.h"
#include "coupling/contact/grains/grain_bed_check.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "fix_wall_gran.h"
#include "furrow/geometry/closest_feature.h"

namespace furrow::coupling {

class BodyMesh;
class FixMeshBody;
struct ContactLedger;
struct GrainContact;

/// The class is a FixWallGran, so not a FurrowFix; its keywords are LIGGGHTS's.
class FixWallGranBody : public LAMMPS_NS::FixWallGran, public FixUser {
 public:
  FixWallGranBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Schema("fix wall/gran/body"); }
  static OutputTable outputs() { return {}; }

  bool uses(const LAMMPS_NS::Fix& other) const override;
  /// Bodies of the meshes in this wall.
  std::vector<const Body*> bodies() const;
  void setup(int vflag) override;

 protected:
  void post_force_mesh(int vflag) override;

 private:
  /// The mesh of a body while its contacts are computed.
  struct MeshAtWork {
    FixMeshBody& fix;
    int number;                       ///< in the list of the wall's meshes
    const Vector3& moment_reference;  ///< [m]
    ContactLedger& ledger;
    std::vector<GrainContact>& contacts;
    GrainBedCheck* check;  ///< null before the first set-up
  };
  static int checked(const LAMMPS_NS::LAMMPS& lammps, int narg, char** arg);
  static void check_single(const std::string& where, const LAMMPS_NS::LAMMPS& lammps, char** arg,
                           int first, int last);
  void post_force_stock_meshes(int vflag);
  void post_force_body(FixMeshBody& mesh_fix, int mesh_number);
  void collect_candidates(FixMeshBody& mesh_fix);
  void apply(const MeshAtWork& mesh, int grain, const ContactCandidate& contact);
  double* history_of(LAMMPS_NS::FixContactHistoryMesh& history, const BodyMesh& mesh, int grain,
                     const ContactCandidate& contact, bool touching) const;
  GrainBedCheck* check_of(int mesh_number);
  void refuse_deep_start() const;
  void refuse_grains_inside() const;
  const Body* carrying_terrain() const;

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
  double deepest_ = 0.0;                           // overlap over radius in the last call
  std::map<int, GrainBedCheck> grain_bed_checks_;  // of each mesh of a body, by its number
};

}  // namespace furrow::coupling
