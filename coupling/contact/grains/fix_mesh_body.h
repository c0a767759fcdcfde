// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix mesh/body: a LIGGGHTS mesh whose triangles follow the nodes of a body. See fix_mesh_body.md.

#include <string>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/core/options/options.h"
#include "coupling/base/roles/fix_order.h"
#include "coupling/base/roles/checkpointed_fix.h"
#include "coupling/liggghts/styles/configured_style.h"
#include "coupling/base/roles/fix_user.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "fix_mesh_surface.h"
#include "tri_mesh.h"

namespace furrow::coupling {

class FixBody;

/// Triangles of a body's surface, distributed over ranks as LIGGGHTS likes; node data come from the
/// replicated surface.
class BodyMesh : public LAMMPS_NS::TriMesh {
 public:
  /// @param nodes_as_made  of the surface before anything has deformed it: those in one place there
  /// are one node, a period apart too
  BodyMesh(LAMMPS_NS::LAMMPS* lammps, const char* id, const Surface& surface,
           const Matrix3X& nodes_as_made);

  bool isDeforming() override { return true; }
  bool isMoving() override { return true; }
  bool decideRebuild() override;

  /// Positions and velocities of the nodes, and what is made of them for each triangle, owned and
  /// ghost ones, but for its edges.
  void follow_surface();
  /// Edges and normals of the triangles: LIGGGHTS takes them for its neighbour lists alone.
  void derive_edges();
  /// Call when neighbour lists are about to be made: later motion is measured from here, and only
  /// where grains can be reached.
  void remember_rebuild();

  const Surface& body_surface() const { return surface_; }
  /// Nodes of a triangle by the numbers that tell whether two triangles meet: equal across a seam
  /// or a periodic boundary.
  Vector3i welded(const Vector3i& nodes) const {
    return {weld_[static_cast<std::size_t>(nodes[0])], weld_[static_cast<std::size_t>(nodes[1])],
            weld_[static_cast<std::size_t>(nodes[2])]};
  }
  /// Periodic image of a local triangle: its nodes are the surface's nodes plus this.
  const Vector3& image_shift(int local_triangle) const {
    return image_shift_[static_cast<std::size_t>(local_triangle)];
  }

 private:
  Vector3 shift_into_box(const Vector3& centre) const;
  void follow(int local_triangle);
  void derive_edges(int local_triangle);

  const Surface& surface_;
  LAMMPS_NS::MultiVectorContainer<double, 3, 3>* velocity_;
  std::vector<Vector3> image_shift_;
  std::vector<int> weld_;
  Matrix3X x_at_rebuild_;
  // box around all grains at the last rebuild, with a margin
  Vector3 reach_lower_;
  Vector3 reach_upper_;
};

/// The class is a FixMeshSurface, so not a FurrowFix.
class FixMeshBody : public LAMMPS_NS::FixMeshSurface,
                    public ConfiguredStyle,
                    public FixUser,
                    public CheckpointedFix,
                    public SystemFollower {
 public:
  FixMeshBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema();
  static OutputTable outputs() { return {}; }

  Body& body() const { return body_; }
  BodyMesh& body_mesh() { return *body_mesh_; }
  const Options& options() const override { return options_; }

  bool uses(const LAMMPS_NS::Fix& other) const override;
  // LIGGGHTS keeps the contact histories of the mesh by its id.
  bool must_be_restored() const override { return true; }
  bool restored() const override { return true; }
  std::string reason_to_follow() const override {
    return "its triangles take the positions that the nodes of the body have come to";
  }
  void pre_delete(bool unfixing) override;
  int setmask() override;
  void setup_pre_force(int vflag) override;
  void initial_integrate(int vflag) override;
  void pre_exchange() override;
  void pre_force(int vflag) override;

 private:
  /// The words with which FixMeshSurface is willing to be constructed.
  struct Arguments {
    Arguments(LAMMPS_NS::LAMMPS& lammps, int narg, char** arg);
    Options options;
    FixBody& body_fix;
    std::vector<std::string> words;
    std::vector<char*> pointers;
  };
  FixMeshBody(LAMMPS_NS::LAMMPS* lammps, Arguments arguments);
  void check_inside_box() const;

  Options options_;
  const FixBody& body_fix_;
  Body& body_;
  BodyMesh* body_mesh_;  // owned by FixMesh
  bool exchanged_ = false;
};

}  // namespace furrow::coupling
