// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The clock of all bodies of a scene. Made by the first fix that declares a body; users never
/// write it.

#include <string>
#include <vector>

#include "bodies/body.h"
#include "bodies/coupled_system.h"
#include "core/communicator.h"
#include "coupling/contact/grain_forces.h"
#include "fix.h"

namespace furrow::coupling {

/// A fix that owns a body. Name and body are found by the id of the fix.
class BodyFix {
 public:
  virtual ~BodyFix() = default;
  virtual Body& body() = 0;
};

/// Something that sets loads and prescribed motions before every step: a rig.
class MotionController {
 public:
  virtual ~MotionController() = default;
  virtual void apply(double time, double dt) = 0;
};

/// What the grains did to one body in one step, summed over ranks: the other side of the momentum
/// audit.
struct ContactLedger {
  Vector3 grain_force = Vector3::Zero();  ///< sum of contact forces on grains [N]
  /// sum of (contact point - reference) x force on grain [N m]
  Vector3 grain_moment = Vector3::Zero();
  Vector3 lever_gap = Vector3::Zero();  ///< moment that LIGGGHTS's shorter torque arm leaves out of
                                        ///< the grains' balance [N m]
  double force_scale = 0.0;             ///< sum of |force| [N]
  double moment_scale = 0.0;            ///< sum of |contact point - reference| |force| [N m]
  double contacts = 0.0;
};

/// Largest defects since the start of the run, each with its scale; a scale of zero means that
/// nothing has touched yet.
struct MomentumAudit {
  /// |nodal forces + grain forces|, sum of |contact force| [N]
  double force_imbalance = 0.0, force_scale = 0.0;
  /// the same for moments about the middle of the body's nodes [N m]
  double moment_imbalance = 0.0, moment_scale = 0.0;
  /// largest ratio of imbalance to scale in one step
  double force = 0.0;
  double moment = 0.0;  ///< the same for moments
  /// |lever gap| / moment scale: not an error of the wall, see fix_wall_gran_body.md
  double lever_gap = 0.0;
};

class FixCoupledSystem : public LAMMPS_NS::Fix {
 public:
  FixCoupledSystem(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);

  /// The system of a LIGGGHTS instance; made on first use.
  static FixCoupledSystem& of(LAMMPS_NS::LAMMPS& lammps);
  /// The body of a fix. @throws InputError when there is none of that id
  static BodyFix& find_body(LAMMPS_NS::LAMMPS& lammps, const std::string& where,
                            const std::string& fix_id);

  void add(Body& body, const std::string& name);
  void remove(Body& body);
  void add(MotionController& controller) { controllers_.push_back(&controller); }
  void remove(MotionController& controller);
  void add(Contact& contact, const std::string& name) { system_.add(contact, name); }
  void remove(Contact& contact) { system_.remove(contact); }

  ContactLedger& ledger(const Body& body);
  /// Where moments of this step are taken about: the middle of the body's nodes.
  const Vector3& moment_reference(const Body& body);
  const MomentumAudit& audit(const Body& body);
  double contact_count(const Body& body);  ///< of the last step, all ranks

  double time() const { return time_; }
  const Communicator& communicator() const { return communicator_; }

  void post_create() override { grain_forces_.make_storage(); }
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void pre_initial_integrate() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void end_of_step() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  struct Member {
    Body* body;
    std::string name;
    ContactLedger ledger;
    MomentumAudit audit;
    Vector3 reference = Vector3::Zero();
    double contacts = 0.0;
    Matrix3X resumed_forces = {};  // nodal, as the restart file brought them
  };
  Member& member(const Body& body);
  void checkpoint(Checkpoint& state, bool in_run, std::vector<double> contact_forces);
  void clear_forces();
  void sum_forces();
  void check_momentum(Member& member) const;

  Communicator communicator_;
  CoupledSystem system_;
  std::vector<Member> members_;
  std::vector<MotionController*> controllers_;
  std::vector<double> buffer_;
  GrainForces grain_forces_;
  double time_ = 0.0;
  std::vector<double>
      resumed_contact_forces_;  // forces of contacts, as the restart file brought them
  bool summed_ = false;
  // continues a checkpoint written in the middle of a run, and has not made a step yet
  bool resumed_ = false;
};

}  // namespace furrow::coupling
