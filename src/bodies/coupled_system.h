// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Every body and contact of a scene, advanced together.

#include <string>
#include <vector>

#include "furrow/bodies/body.h"
#include "furrow/bodies/contact.h"

namespace furrow {

class CoupledSystem {
 public:
  /// A larger number in one interval means that a body collapses or that the interval is too long.
  static constexpr double max_sub_steps = 1e4;

  /// Neither bodies nor contacts are owned: each must outlive the system or be removed.
  /// @param name for errors
  void add(Body& body, const std::string& name) { members_.push_back({&body, name}); }
  void remove(const Body& body);
  void add(Contact& contact, const std::string& name) { contacts_.push_back({&contact, name}); }
  void remove(const Contact& contact);

  /// Advances every body by an interval [s] in equal sub-steps no longer than the smallest stable
  /// step of any body now (theory: step, eqs. 3 to 5). Surface forces act as one impulse, force
  /// times interval, in the first sub-step: the kick is then centred on the time of the forces
  /// [Tuckerman1992]. Contacts are evaluated in every sub-step.
  /// @returns the number of sub-steps
  /// @throws StateError naming the body when its stable step vanishes, its state is not finite or
  /// its own advance() refuses
  int advance(double interval);

  struct StepLimit {
    double step;       ///< [s]; infinity without a body that has one
    std::string body;  ///< its name
  };
  /// The smallest stable step of any body now. Collective.
  StepLimit step_limit() const;

  void clear_forces();  ///< of all surfaces
  /// Adds the mean contact forces over the last interval to the surfaces, for output. The next
  /// advance() removes them.
  void publish_contact_forces();
  /// Published mean forces [N], three numbers for each node of each body; empty if none are
  /// published. For checkpoints.
  std::vector<double> published_contact_forces() const;
  /// @throws Error when their number does not fit
  void restore_published_contact_forces(const std::vector<double>& forces);

 private:
  struct Member {
    Body* body;
    std::string name;
    Matrix3X external_force = {};  // [N] on the surface by others than the system's contacts
    Matrix3X contact_force = {};   // [N] of the contacts, mean over the last interval
  };
  struct Named {
    Contact* contact;
    std::string name;
  };
  int sub_steps_of(double interval) const;
  void begin_interval(int sub_steps);
  void end_interval();
  void apply_contacts(double dt);
  void advance_bodies(double dt);

  std::vector<Member> members_;
  std::vector<Named> contacts_;
  bool published_ = false;
};

}  // namespace furrow
