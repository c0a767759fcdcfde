// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that makes a body: a place in the coupled system, its state in restart
/// files, its triangles for mesh/body.

#include <functional>
#include <memory>
#include <optional>

#include "coupling/base/furrow_fix.h"

namespace furrow::coupling {

class FixBody : public FurrowFix {
 public:
  Body& body() const { return *body_; }
  /// The body as its fix line made it, before a checkpoint moved it on; nothing without one.
  const std::optional<Checkpoint>& state_as_made() const { return state_as_made_; }
  /// Places of the surface's nodes when the script made the body [m].
  const Matrix3X& nodes_as_made() const { return nodes_as_made_; }

  void restart(char* buffer) override;
  int getCreateMeshTriCount() override;
  double* getCreateMeshTriNode(const int i) override;

 protected:
  /// Makes the body from the options of the line. @throws InputError
  using MakeBody = std::function<std::unique_ptr<Body>(const Options&)>;
  FixBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema,
          const MakeBody& make_body);

  void checkpoint(Checkpoint& state) override { body_->checkpoint(state); }

 private:
  std::unique_ptr<Body> body_;
  Matrix3X nodes_as_made_;
  std::optional<Checkpoint> state_as_made_;
};

}  // namespace furrow::coupling
