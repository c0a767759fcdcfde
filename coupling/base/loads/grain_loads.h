// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Loads of grains on the bodies of a scene: forces on nodes, their ledgers, audits and works.

#include <map>
#include <string>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"
#include "coupling/base/loads/contact_work.h"
#include "coupling/base/loads/momentum_audit.h"

namespace furrow::coupling {

/// Loads of grains on one body.
struct GrainLoad {
  Body* body;
  std::string name;  ///< of the body, for errors
  ContactLedger ledger = {};
  MomentumAudit audit = {};
  Vector3 reference = Vector3::Zero();      ///< middle of the body's nodes, for moments [m]
  bool touched = false;                     ///< any force on a node since the process started
  std::vector<GrainContact> contacts = {};  ///< of this step and rank
  ContactWork work_of_step = {};            ///< of this rank, not yet in `work`
  ContactWork work = {};                    ///< of all ranks, since the start of the scene
};

/// Each rank adds the forces of its grains to the nodes of replicated bodies. The forces are
/// partial until sum_over_ranks(), and complete afterwards.
class GrainLoads {
 public:
  explicit GrainLoads(const Communicator& ranks) : ranks_(ranks) {}

  /// The body must be removed before it is destroyed.
  void add(Body& body, const std::string& name);
  void remove(const Body& body);
  GrainLoad* find(const Body& body);  ///< null for a body that was not added
  const std::vector<GrainLoad>& all() const { return loads_; }

  /// Forgets the contacts of the last step. The forces on the nodes are cleared elsewhere.
  void begin_step();
  /// Sums the loads of all bodies over the ranks, in one message. Collective.
  void sum_over_ranks();
  /// Compares the forces on nodes with those on grains, and adds the works of the step before.
  /// @throws StateError when they do not cancel
  void audit(long step);
  void mark_touched_bodies();
  /// Works of this rank's contacts in the step that ends.
  void find_works(const LAMMPS_NS::Atom& atom, double dt);

  /// Works of the step from all ranks to the first, which writes the checkpoint. Collective.
  void gather_works_of_step();
  /// The bodies of a restored run may be added later.
  void checkpoint(Checkpoint& state);

 private:
  struct RestoredWork {
    ContactWork work_of_step, work;
  };

  const Communicator& ranks_;
  std::vector<GrainLoad> loads_;
  std::map<std::string, RestoredWork> restored_works_;  // by names of bodies
  std::vector<double> buffer_;
};

}  // namespace furrow::coupling
