// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/coupled_system.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "tests/support/max_error.h"
#include "tests/support/error_of.h"

namespace furrow::coupled_system_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

/// Counts its steps; its stable step, its refusal and its position are for the test to choose.
class Probe : public Body {
 public:
  Probe() { surface_.resize(1); }
  double stable_time_step() const override { return stable; }
  void advance(double dt) override {
    if (refuse) throw StateError("an element folded");
    time += dt;
    ++steps;
    surface_.x(0, 0) = position;
  }
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override { return {}; }
  void checkpoint(Checkpoint&) override {}

  double stable = std::numeric_limits<double>::infinity(), time = 0.0, position = 0.0;
  int steps = 0;
  bool refuse = false;

 private:
  Surface surface_;
};

std::string refusal_of(CoupledSystem& system, double interval) {
  return error_of<StateError>([&] { system.advance(interval); });
}

/// A mass on its own spring, by leapfrog.
class Oscillator : public Probe {
 public:
  Oscillator(double mass, double stiffness, double steps_in_one)
      : mass_(mass), stiffness_(stiffness) {
    surface().x(2, 0) = 1.0;
    stable = 1.0 / steps_in_one;
  }
  void advance(double dt) override {
    surface().v(2, 0) += dt * (surface().f(2, 0) - stiffness_ * surface().x(2, 0)) / mass_;
    surface().x(2, 0) += dt * surface().v(2, 0);
  }

 private:
  double mass_, stiffness_;
};

/// A contact whose force is found once an interval, on a mass that takes sub-steps: the amplitude
/// stays. Forces that are held over the sub-steps let it grow as exp(k T (1 - 1/n)/(4 m) t): here
/// by e^10 and more.
TEST(CoupledSystem, ExternalForcesAddNoEnergyThroughSubSteps) {
  constexpr double mass = 1.0, own = 0.3, contact = 0.1;
  constexpr int intervals = 500;
  for (const int sub_steps : {1, 2, 7, 40}) {
    Oscillator body(mass, own, sub_steps);
    CoupledSystem system;
    system.add(body, "tread");
    test::MaxError amplitude;
    for (int i = 0; i < intervals; ++i) {
      body.surface().f(2, 0) = -contact * body.surface().x(2, 0);
      EXPECT_EQ(system.advance(1.0), sub_steps);
      if (i > intervals / 2) amplitude.add(body.surface().x(2, 0));
    }
    EXPECT_NEAR(amplitude.max(), 1.0, 0.1) << sub_steps << " sub-steps";
    EXPECT_NE(body.surface().f(2, 0), 0.0);  // still there for whoever reads it
  }
}

TEST(CoupledSystem, SubStepsAreEqualAndFollowTheSmallestStableStep) {
  Probe rigid, soft;
  soft.stable = 0.3;
  CoupledSystem system;
  system.add(rigid, "rigid");
  EXPECT_EQ(system.advance(1.0), 1);
  system.add(soft, "soft");
  EXPECT_EQ(system.advance(1.0), 4);  // 0.25 s each
  EXPECT_EQ(soft.steps, 4);
  EXPECT_EQ(rigid.steps, 5);
  EXPECT_DOUBLE_EQ(soft.time, 1.0);
  EXPECT_DOUBLE_EQ(rigid.time, 2.0);
  soft.stable = 0.25;
  EXPECT_EQ(system.advance(1.0), 4);  // exactly the stable step is allowed
  system.remove(soft);
  EXPECT_EQ(system.advance(1.0), 1);
  EXPECT_EQ(soft.steps, 8);
}

TEST(CoupledSystem, ErrorNamesTheBodyThatFails) {
  Probe good, bad;
  CoupledSystem system;
  system.add(good, "soil");
  system.add(bad, "tyre");
  EXPECT_THAT(refusal_of(system, 0.0), HasSubstr("cannot advance by 0 s"));
  EXPECT_THAT(refusal_of(system, std::nan("")), HasSubstr("cannot advance by nan s"));
  bad.stable = 1e-9;
  EXPECT_THAT(refusal_of(system, 1.0), HasSubstr("body 'tyre': its stable time step is 1e-09 s"));
  bad.stable = std::nan("");
  EXPECT_THAT(refusal_of(system, 1.0), HasSubstr("body 'tyre': its stable time step is nan s"));
  bad.stable = 1.0;
  bad.refuse = true;
  EXPECT_THAT(refusal_of(system, 1.0), HasSubstr("body 'tyre': an element folded"));
  bad.refuse = false;
  bad.position = std::nan("");
  EXPECT_THAT(refusal_of(system, 1.0),
              HasSubstr("body 'tyre': the position of node 0 is not finite"));
}

/// Pushes two bodies apart with a force that the test chooses step by step; remembers what it saw.
class Spring : public Contact {
 public:
  Spring(Body& one, Body& two) : one_(one), two_(two) {}
  void apply(double dt) override {
    if (refuse) throw StateError("the spring broke");
    seen.push_back(one_.surface().f(0, 0));
    steps.push_back(dt);
    const double force = forces[steps.size() - 1];
    one_.surface().f(0, 0) += force;
    two_.surface().f(0, 0) -= force;
  }
  std::vector<double> forces, seen, steps;
  bool refuse = false;

 private:
  Body &one_, &two_;
};

/// Adds up the impulse of its surface force.
class Mass : public Probe {
 public:
  void advance(double dt) override {
    impulse += surface().f(0, 0) * dt;
    Probe::advance(dt);
  }
  double impulse = 0.0;
};

TEST(CoupledSystem, ContactsActInEverySubStepAndExternalForcesInTheFirst) {
  Mass wheel, ground;
  wheel.stable = 0.25;
  Spring contact(wheel, ground);
  contact.forces = {1.0, 2.0, 4.0, 8.0};
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(ground, "ground");
  system.add(contact, "contact");
  wheel.surface().f(0, 0) = 100.0;  // of others
  ASSERT_EQ(system.advance(1.0), 4);
  EXPECT_EQ(contact.seen, (std::vector<double>{400.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(contact.steps, std::vector<double>(4, 0.25));
  EXPECT_DOUBLE_EQ(wheel.impulse, 100.0 + 0.25 * 15.0);
  EXPECT_DOUBLE_EQ(ground.impulse, -0.25 * 15.0);
  EXPECT_DOUBLE_EQ(wheel.surface().f(0, 0), 100.0);
}

TEST(CoupledSystem, PublishedContactForceIsTheMeanOfTheSubSteps) {
  Mass wheel, ground;
  wheel.stable = 0.5;
  Spring contact(wheel, ground);
  contact.forces = {1.0, 3.0, 5.0, 5.0};
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(ground, "ground");
  system.add(contact, "contact");
  wheel.surface().f(0, 0) = 10.0;
  system.advance(1.0);
  EXPECT_TRUE(system.published_contact_forces().empty());
  system.publish_contact_forces();
  system.publish_contact_forces();  // once is enough
  EXPECT_DOUBLE_EQ(wheel.surface().f(0, 0), 12.0);
  EXPECT_DOUBLE_EQ(ground.surface().f(0, 0), -2.0);
  EXPECT_EQ(system.published_contact_forces(),
            (std::vector<double>{2.0, 0.0, 0.0, -2.0, 0.0, 0.0}));
  system.advance(1.0);  // takes them away again
  EXPECT_EQ(contact.seen[2], 20.0);
  EXPECT_EQ(contact.seen[3], 0.0);
  EXPECT_DOUBLE_EQ(wheel.impulse, 10.0 + 2.0 + 10.0 + 5.0);
  system.publish_contact_forces();
  system.clear_forces();
  EXPECT_TRUE(system.published_contact_forces().empty());
  EXPECT_DOUBLE_EQ(wheel.surface().f(0, 0), 0.0);
}

TEST(CoupledSystem, PublishedContactForcesAreRestored) {
  const auto second_impulse = [](bool restart) {
    Mass wheel, ground;
    Spring contact(wheel, ground);
    contact.forces = {3.0, 4.0};
    CoupledSystem first, second;
    for (CoupledSystem* system : {&first, &second}) {
      system->add(wheel, "wheel");
      system->add(ground, "ground");
      system->add(contact, "contact");
    }
    first.advance(1.0);
    first.publish_contact_forces();
    CoupledSystem& next = restart ? second : first;
    if (restart) next.restore_published_contact_forces(first.published_contact_forces());
    next.advance(1.0);
    return wheel.impulse;
  };
  EXPECT_DOUBLE_EQ(second_impulse(true), second_impulse(false));
  Mass wheel;
  CoupledSystem system;
  system.add(wheel, "wheel");
  EXPECT_THROW(system.restore_published_contact_forces({1.0, 2.0}), Error);
  EXPECT_NO_THROW(system.restore_published_contact_forces({}));
}

TEST(CoupledSystem, ErrorNamesTheContactThatFails) {
  Mass wheel, ground;
  Spring contact(wheel, ground);
  CoupledSystem system;
  system.add(wheel, "wheel");
  system.add(ground, "ground");
  system.add(contact, "touch");
  contact.refuse = true;
  EXPECT_THAT(refusal_of(system, 1.0), HasSubstr("contact 'touch': the spring broke"));
  system.remove(contact);
  EXPECT_EQ(system.advance(1.0), 1);
}

}  // namespace
}  // namespace furrow::coupled_system_test
