// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What every fix that makes a body has in common: a place in the system, its state in restart
/// files, its triangles for mesh/body.

#include <memory>
#include <optional>

#include "coupling/bodies/fix_coupled_system.h"

namespace furrow::coupling {

class FixBody : public LAMMPS_NS::Fix, public BodyFix {
 public:
  /// @param body made by the derived fix from its options
  FixBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, std::unique_ptr<Body> body);
  ~FixBody() override;

  Body& body() override { return *body_; }
  /// The body as its fix line made it, before a checkpoint moved it on; nothing without one.
  const std::optional<Checkpoint>& state_as_made() const { return state_as_made_; }

  int setmask() override { return 0; }
  void post_create() override;
  void pre_delete(bool unfixflag) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  int getCreateMeshTriCount() override;
  double* getCreateMeshTriNode(const int i) override;

 private:
  std::string owner() const;  ///< for errors about checkpoints

  std::unique_ptr<Body> body_;
  std::optional<Checkpoint> state_as_made_;
};

}  // namespace furrow::coupling
