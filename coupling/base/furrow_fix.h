// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Base class of Furrow's fixes: what a fix does for LIGGGHTS in addition to its task.
///
/// A fix derives from it, or from FixBody, FixContact or FixHistory. It declares five things.
///   - Keywords: static Schema schema(), which its constructor hands over.
///   - Outputs f_ID[n]: static const Outputs<Class>& outputs(), and provide(outputs()).
///   - Fixes it needs: use<Class>(key, kinds) in the constructor. They cannot be removed before it.
///   - What the coupled system calls: contribute(body | contact | controller).
///   - Its state: checkpoint(), and keep_state().
/// Its source file adds a row to the table of styles (style_registry.h). Its page lies next to it.

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/bodies/contact.h"
#include "furrow/core/checkpoint.h"
#include "furrow/core/options/outputs.h"
#include "coupling/liggghts/styles/find_fix.h"
#include "coupling/liggghts/styles/configured_style.h"
#include "coupling/base/roles/checkpointed_fix.h"
#include "coupling/base/roles/motion_controller.h"
#include "coupling/base/roles/fix_user.h"
#include "coupling/liggghts/errors/errors.h"
#include "fix.h"

namespace furrow::coupling {

class FurrowFix : public LAMMPS_NS::Fix,
                  public ConfiguredStyle,
                  public FixUser,
                  public CheckpointedFix {
 public:
  /// Outputs of the fix: none, unless the derived class has some.
  static const Outputs<FurrowFix>& outputs();

  const Options& options() const final { return options_; }
  /// True for the fixes of use(), and for furrow/system if this fix contributes to it.
  bool uses(const LAMMPS_NS::Fix& other) const override;
  /// Name for errors and warnings: "fix wheel/rigid 'wheel'".
  std::string name() const { return name_of(*this); }
  bool must_be_restored() const override { return restart_global && state_needs_options(); }
  std::vector<std::pair<std::string, std::string>> settings() const override;
  bool restored() const override { return restored_; }

  int setmask() override { return 0; }
  /// Contributions join the coupled system. Not in the constructor: LIGGGHTS cannot make one fix
  /// while it makes another.
  void post_create() override;
  /// Takes the contributions out in reverse order. If another fix uses this one, the line is
  /// refused.
  void pre_delete(bool unfixing) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  double compute_vector(int n) override;

 protected:
  /// @throws InputError for words that the schema does not allow
  FurrowFix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema);

  // ---- for the constructor of the derived class
  // --------------------------------------------------
  /// The fix, of a class or a role, named by a keyword. @throws InputError
  template <class Wanted>
  Wanted& use(const std::string& key, const std::vector<std::string>& kinds) {
    Wanted& fix = find_fix<Wanted>(*lmp, options_, key, kinds);
    used_.push_back(&as_fix(fix));
    return fix;
  }
  /// Adds a part, which is not owned, to the system; it holds parts in the order of these calls.
  template <class Part>
  void contribute(Part& part) {
    parts_.emplace_back(&part);
  }
  /// The outputs as f_ID[1], f_ID[2], ... of scripts; the list must live as long as the fix.
  template <class FixStyle>
  void provide(const Outputs<FixStyle>& outputs) {
    compute_ = [this, &outputs](std::size_t n) {
      return outputs.value(n, static_cast<FixStyle&>(*this));
    };
    announce_vector(outputs.size());
  }
  /// Provides outputs of another source, which make_source() gives for each value.
  template <class Source, class MakeSource>
  void provide(const Outputs<Source>& outputs, MakeSource make_source) {
    compute_ = [&outputs, make_source](std::size_t n) {
      Source source = make_source();
      return outputs.value(n, source);
    };
    announce_vector(outputs.size());
  }
  void keep_state() { restart_global = 1; }
  void change_options(Options options) { options_ = std::move(options); }
  static std::vector<std::pair<std::string, std::string>> settings_of(const Options& options);

  // ---- for the derived class at any time
  // ---------------------------------------------------------
  /// A coupled system must be there, also without a part of this fix in it.
  virtual bool needs_system() const { return !parts_.empty(); }
  /// Saves or restores the state. Called on all ranks; the bytes of rank 0 are written, and all
  /// ranks read them back.
  virtual void checkpoint(Checkpoint&) {}
  /// True if the state depends on these options. A run is then continued with the same ones, except
  /// for those that may_change().
  virtual bool state_needs_options() const { return true; }
  /// Runs an action that all ranks run alike; an exception becomes the error of all.
  template <class Action>
  void collectively(Action&& action) const {
    with_collective_errors(*error, action);
  }
  /// Runs an action that may fail on this rank alone; an exception stops all ranks.
  template <class Action>
  void on_this_rank(Action&& action) const {
    with_local_errors(*error, action);
  }

 private:
  using Part = std::variant<Body*, Contact*, MotionController*>;
  void announce_vector(std::size_t size);
  void match_options(Checkpoint& state) const;

  Options options_;
  std::vector<const LAMMPS_NS::Fix*> used_;
  std::vector<Part> parts_;
  std::function<double(std::size_t)> compute_;
  bool restored_ = false;
};

}  // namespace furrow::coupling
