// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// fix furrow/system: couples the bodies of a scene to LIGGGHTS's steps. Made by the first fix that
/// contributes to it; users never write it.
///
/// One step of LIGGGHTS, for a body and the grains it touches:
///   initial_integrate  the controllers set loads and motions; the bodies advance by the step under
///                      the grains' forces of the step before; their surfaces' forces are cleared
///   (LIGGGHTS)         meshes follow the nodes, neighbour lists, forces between grains;
///                      wall/gran/body adds to the surfaces' forces and to the ledgers
///   final_integrate    one sum over the ranks; forces on bodies and on grains must cancel
///   end_of_step        histories write their rows

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bodies/body.h"
#include "bodies/coupled_system.h"
#include "core/checkpoint.h"
#include "core/communicator.h"
#include "coupling/base/grain_forces.h"
#include "coupling/base/momentum_audit.h"
#include "coupling/base/motion_controller.h"
#include "coupling/base/scene_watch.h"
#include "coupling/liggghts/saved_histories.h"
#include "coupling/liggghts/style_registry.h"
#include "fix.h"

namespace furrow::coupling {

class FixCoupledSystem : public LAMMPS_NS::Fix {
 public:
  FixCoupledSystem(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
  static Schema schema() { return Schema("fix furrow/system"); }
  static OutputTable outputs() { return {}; }

  /// The system of a LIGGGHTS instance; made on first use.
  static FixCoupledSystem& of(LAMMPS_NS::LAMMPS& lammps);
  /// The same, or null.
  static FixCoupledSystem* find(LAMMPS_NS::LAMMPS& lammps);

  // None is owned; each must outlive the system or be removed. @param name for errors
  void add(Body& body, const std::string& name);
  void remove(const Body& body);
  void add(Contact& contact, const std::string& name) { system_.add(contact, name); }
  void remove(const Contact& contact) { system_.remove(contact); }
  void add(MotionController& controller, const std::string& name);
  void remove(const MotionController& controller);

  // Of a body that was added.
  ContactLedger& ledger(const Body& body) { return member(body).ledger; }
  /// Where moments of this step are taken about: the middle of the body's nodes.
  const Vector3& moment_reference(const Body& body) { return member(body).reference; }
  const MomentumAudit& audit(const Body& body) { return member(body).audit; }
  /// For the wall: contacts with grains in this step, of this rank.
  std::vector<GrainContact>& contacts(const Body& body) { return member(body).contacts; }
  /// With grains since the start, of all ranks; up to the step before that of the forces, as works
  /// of the body itself.
  const ContactWork& contact_work(const Body& body) { return member(body).work; }

  double time() const { return time_; }            ///< of the scene [s], also after a restart
  bool has_run() const { return has_run_; }        ///< also no steps, in this process
  bool restored() const { return restored_; }      ///< from a checkpoint
  double sub_steps() const { return sub_steps_; }  ///< of the bodies, in this process
  /// Of the body whose stable step is the smallest now. Collective.
  CoupledSystem::StepLimit step_limit() const { return system_.step_limit(); }
  /// Whether anything has pressed on a body in this process.
  bool touched(const Body& body) { return member(body).touched; }
  const Communicator& communicator() const { return communicator_; }

  void post_create() override { grain_forces_.make_storage(); }
  void pre_delete(bool unfixing) override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override {}
  void setup_pre_force(int) override;
  void pre_initial_integrate() override;
  void initial_integrate(int) override;
  void post_run() override;
  void final_integrate() override;
  void end_of_step() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  /// What the forces on the bodies' surfaces are.
  ///
  ///            final_integrate (or initial_integrate, of the set-up's forces)
  ///     partial ------------------------------------------------------------> complete
  ///        ^                                                                    |   ^
  ///        +--------------------------------------------------------------------+   |
  ///           clear_forces: set-up, and initial_integrate after the advance         |
  ///                                                                                 |
  ///     restored -------------------------------------------------------------------+
  ///        pre_initial_integrate: in place of the set-up's. LIGGGHTS computes contact forces with
  ///        velocities at mid-step, but knows those of the full step only when a run continues
  enum class ForceState {
    partial,   ///< of this rank's grains, so far
    complete,  ///< of all grains; with the mean of the contacts' forces, for histories
    restored,  ///< a checkpoint written in a run has brought those of its last step
  };

  struct Member {
    Body* body;
    std::string name;
    ContactLedger ledger = {};
    MomentumAudit audit = {};
    Vector3 reference = Vector3::Zero();
    Matrix3X restored_forces = {};  // nodal
    bool touched = false;
    std::vector<GrainContact> contacts = {};  // of this step and rank
    ContactWork work_of_step = {};            // of this rank, not yet in work
    ContactWork work = {};                    // of all ranks, since the start
  };
  /// Of a member that the script has yet to make.
  struct RestoredWork {
    ContactWork work_of_step, work;
  };
  Member& member(const Body& body);
  void checkpoint(Checkpoint& state, bool in_run, std::vector<double> contact_forces);
  void checkpoint_works(Checkpoint& state);
  void gather_works_of_step();
  void check_restored_fixes();
  void warn_of_changed_properties();
  std::string lines_of_controllers() const;
  void warn_of_changed_controllers();
  int advance_bodies();
  void clear_forces();
  void sum_over_ranks();
  void sum_forces();

  Communicator communicator_;
  CoupledSystem system_;
  std::vector<Member> members_;
  struct NamedController {
    MotionController* controller;
    std::string name;
  };
  std::vector<NamedController> controllers_;
  std::vector<double> buffer_;
  GrainForces grain_forces_;
  SavedHistories saved_histories_;
  std::unique_ptr<SceneWatch> scene_watch_;
  bool has_run_ = false;
  double time_ = 0.0, sub_steps_ = 0.0;
  bool restored_ = false;
  ForceState forces_ = ForceState::partial;
  int sort_interval_ = 0;       // [steps], while the set-up of a continued run must not sort
  std::int64_t next_sort_ = 0;  // step, of the checkpoint
  std::vector<double> restored_contact_forces_;
  std::map<std::string, RestoredWork> restored_works_;  // by names of members
  std::string checkpointed_fixes_;        // names, a line each; empty unless the run is continued
  std::string checkpointed_properties_;   // the same, with their values
  std::string checkpointed_controllers_;  // a keyword each
};

}  // namespace furrow::coupling
