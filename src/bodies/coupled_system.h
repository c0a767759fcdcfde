// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Every body of a scene, advanced together.

#include <string>
#include <vector>

#include "bodies/body.h"
#include "bodies/contact.h"

namespace furrow {

class World {
 public:
  /// The body is not owned; it must outlive the world or be removed.
  void add(Body& body, const std::string& name) { members_.push_back({&body, name}); }
  void remove(const Body& body);
  void add(Interaction& interaction, const std::string& name) {
    interactions_.push_back({&interaction, name});
  }
  void remove(const Interaction& interaction);

  /// Advances every body by an interval [s] in equal sub-steps no longer than the smallest stable
  /// step of any body now. Surface forces act as one impulse, force times interval, in the first
  /// sub-step: their kick is centred on the time they belong to (r-RESPA: M. Tuckerman, B. J.
  /// Berne, G. J. Martyna, J. Chem. Phys. 97, 1990 (1992)). Held over n sub-steps they would lag,
  /// and a spring k on a mass m gain energy at the rate k interval/(2 m) (1 - 1/n). Interactions
  /// are found anew in every sub-step. Returns their number.
  /// @throws StateError naming the body when its stable step vanishes, its state is not finite or
  /// its own advance() refuses
  int advance(double interval);

  void clear_forces();  ///< of all surfaces
  /// Adds the interactions' forces, their mean over the last interval, to the surfaces for whoever
  /// reads them; the next advance() takes them away again.
  void show_interaction_forces();
  /// Those mean forces of all bodies one after the other, three numbers a node, if they are shown
  /// now; for restart files.
  std::vector<double> shown_forces() const;
  /// @throws Error when their number does not fit
  void restore_shown_forces(const std::vector<double>& forces);

 private:
  struct Member {
    Body* body;
    std::string name;
    // [N] of others; mean of the interactions over the last interval
    Matrix3X given = {}, interaction = {};
  };
  struct Named {
    Interaction* interaction;
    std::string name;
  };
  void apply_interactions(double dt);
  void advance_bodies(double dt);

  std::vector<Member> members_;
  std::vector<Named> interactions_;
  bool shown_ = false;
};

}  // namespace furrow
