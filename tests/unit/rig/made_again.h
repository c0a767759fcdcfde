// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A rig that is made again from its line, its wheel from a checkpoint, goes on bit for bit.

#include <gtest/gtest.h>

#include "tests/support/checkpoints.h"
#include "wheel_on_floor.h"

namespace furrow {

/// @param line of the rig
/// @param from, to steps of 1e-4 s: of the checkpoint, of the comparison
inline void expect_continues_bitwise(const std::string& line, const Floor& floor, long from,
                                     long to) {
  constexpr double dt = 1e-4;
  RigidWheel one = make_wheel(0.2003), other = make_wheel(0.2003);
  WheelRig first = rig_of(one, line);
  const auto step = [&](WheelRig& rig, RigidWheel& wheel, long i) {
    rig.apply(static_cast<double>(i) * dt, dt);
    wheel.advance(dt);
    floor.press_on(wheel.surface());
  };
  for (long i = 0; i < from; ++i) step(first, one, i);
  WheelRig second = rig_of(other, line);
  test::hand_over(one, other);
  test::hand_over(first, second);
  for (long i = from; i < to; ++i) {
    step(first, one, i);
    step(second, other, i);
  }
  const double end = static_cast<double>(to) * dt;
  EXPECT_EQ(first.measure(end), second.measure(end)) << from;
  EXPECT_EQ(test::state_of(one), test::state_of(other)) << from;
}

}  // namespace furrow
