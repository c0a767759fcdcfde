#include "body/world.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "core/error.h"

namespace furrow {
namespace {

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
  Balance balance() const override { return {}; }
  std::vector<double> state() const override { return {}; }
  void restore(const std::vector<double>&) override {}

  double stable = std::numeric_limits<double>::infinity(), time = 0.0, position = 0.0;
  int steps = 0;
  bool refuse = false;

 private:
  Surface surface_;
};

std::string refusal_of(World& world, double interval) {
  try {
    world.advance(interval);
  } catch (const StateError& error) {
    return error.what();
  }
  return "no error";
}

TEST(World, SubStepsAreEqualAndFollowTheSmallestStableStep) {
  Probe rigid, soft;
  soft.stable = 0.3;
  World world;
  world.add(rigid, "rigid");
  EXPECT_EQ(world.advance(1.0), 1);
  world.add(soft, "soft");
  EXPECT_EQ(world.advance(1.0), 4);  // 0.25 s each
  EXPECT_EQ(soft.steps, 4);
  EXPECT_EQ(rigid.steps, 5);
  EXPECT_DOUBLE_EQ(soft.time, 1.0);
  EXPECT_DOUBLE_EQ(rigid.time, 2.0);
  soft.stable = 0.25;
  EXPECT_EQ(world.advance(1.0), 4);  // exactly the stable step is allowed
  world.remove(soft);
  EXPECT_EQ(world.advance(1.0), 1);
  EXPECT_EQ(soft.steps, 8);
}

TEST(World, RefusesAndNamesTheBody) {
  Probe good, bad;
  World world;
  world.add(good, "soil");
  world.add(bad, "tyre");
  EXPECT_THAT(refusal_of(world, 0.0), HasSubstr("cannot advance by 0 s"));
  EXPECT_THAT(refusal_of(world, std::nan("")), HasSubstr("cannot advance by nan s"));
  bad.stable = 1e-9;
  EXPECT_THAT(refusal_of(world, 1.0), HasSubstr("body 'tyre': its stable time step is 1e-09 s"));
  bad.stable = std::nan("");
  EXPECT_THAT(refusal_of(world, 1.0), HasSubstr("body 'tyre': its stable time step is nan s"));
  bad.stable = 1.0;
  bad.refuse = true;
  EXPECT_THAT(refusal_of(world, 1.0), HasSubstr("body 'tyre': an element folded"));
  bad.refuse = false;
  bad.position = std::nan("");
  EXPECT_THAT(refusal_of(world, 1.0), HasSubstr("body 'tyre': the position of node 0 is not finite"));
}

}  // namespace
}  // namespace furrow
