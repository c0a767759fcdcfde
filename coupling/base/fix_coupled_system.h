// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix furrow/system: couples the bodies of a scene to LIGGGHTS's steps. The first Furrow fix that
/// needs it creates it; it is no part of the user interface.
///
/// One step of LIGGGHTS, for a body and the grains it touches:
///   initial_integrate  the controllers set loads and motions; the bodies advance by the step under
///                      the grains' forces of the step before; the forces on their nodes are
///                      cleared
///   (LIGGGHTS)         meshes follow the nodes, neighbour lists, forces between grains;
///                      wall/gran/body adds to the forces on nodes and to the ledgers
///   final_integrate    one sum over the ranks; forces on bodies and on grains must cancel
///   end_of_step        works of the contacts with grains; histories write their rows

#include <memory>
#include <string>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/bodies/coupled_system.h"
#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"
#include "coupling/base/continued_lines.h"
#include "coupling/base/loads/grain_loads.h"
#include "coupling/base/roles/motion_controller.h"
#include "coupling/base/loads/restored_forces.h"
#include "coupling/base/roles/scene_watch.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "fix.h"

namespace furrow::coupling {

class FixCoupledSystem : public LAMMPS_NS::Fix {
 public:
  FixCoupledSystem(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Schema("fix furrow/system"); }
  static OutputTable outputs() { return {}; }

  /// The system of a LIGGGHTS instance; made on first use.
  static FixCoupledSystem& of(LAMMPS_NS::LAMMPS& lammps);
  /// The coupled system of the scene, or null without one.
  static FixCoupledSystem* find(LAMMPS_NS::LAMMPS& lammps);

  // Parts are not owned: each must outlive the system or be removed. @param name for errors
  void add(Body& body, const std::string& name);
  void remove(const Body& body);
  void add(Contact& contact, const std::string& name) { system_.add(contact, name); }
  void remove(const Contact& contact) { system_.remove(contact); }
  void add(MotionController& controller, const std::string& name);
  void remove(const MotionController& controller);

  // Results for a body that was added.
  ContactLedger& ledger(const Body& body) { return load(body).ledger; }
  /// Point about which moments of this step are taken: the middle of the body's nodes.
  const Vector3& moment_reference(const Body& body) { return load(body).reference; }
  const MomentumAudit& audit(const Body& body) { return load(body).audit; }
  /// Contacts with grains in this step, of this rank, for the wall to add.
  std::vector<GrainContact>& contacts(const Body& body) { return load(body).contacts; }
  /// Work of contacts with grains since the start, of all ranks; up to the step before that of the
  /// forces, like the works of the body itself.
  const ContactWork& contact_work(const Body& body) { return load(body).work; }
  /// True if any force has acted on a body since the process started.
  bool touched(const Body& body) { return load(body).touched; }

  double time() const { return time_; }        ///< of the scene [s], also after a restart
  bool has_run() const { return has_run_; }    ///< true also after a run of 0 steps in this process
  bool restored() const { return restored_; }  ///< from a checkpoint
  double sub_steps() const { return sub_steps_; }  ///< of the bodies, since the process started
  /// Warns of targets of a rig as a run does that begins with them. @throws InputError for those
  /// that it would refuse. Collective.
  void check_targets() { scene_watch_->after_change_of_targets(); }
  /// Limit by the body with the smallest present stable step. Collective.
  CoupledSystem::StepLimit step_limit() const { return system_.step_limit(); }
  const Communicator& communicator() const { return communicator_; }

  void post_create() override { restored_forces_.make_storage(); }
  void pre_delete(bool unfixing) override;
  int setmask() override;

  // Phases of a run. Pre-exchange and pre-force belong to the set-up.
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override {}
  void setup_pre_force(int) override;
  void pre_initial_integrate() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  struct NamedController {
    MotionController* controller;
    std::string name;
  };
  GrainLoad& load(const Body& body);
  std::vector<std::string> names_of_controllers() const;
  void set_loads_and_motions();
  void advance_bodies();
  void clear_forces();
  void sum_and_audit_forces();
  void checkpoint(Checkpoint& state, bool in_run);

  Communicator communicator_;
  CoupledSystem system_;
  GrainLoads grain_loads_;
  std::vector<NamedController> controllers_;
  RestoredForces restored_forces_;
  ContinuedLines continued_lines_;
  std::unique_ptr<SceneWatch> scene_watch_;
  bool has_run_ = false;
  double time_ = 0.0, sub_steps_ = 0.0;
  bool restored_ = false;
  // Forces on nodes are those of all ranks. clear_forces() and the grains of a step leave them
  // partial.
  bool forces_complete_ = false;
};

}  // namespace furrow::coupling
