// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// States of parts of a run, for tests that compare them or hand them over.

#include <vector>

#include "core/checkpoint.h"

namespace furrow::test {

/// The state as a checkpoint file holds it; equal states have equal bytes.
template <class Part>
std::vector<char> state_of(Part& part) {
  Checkpoint state("test");
  part.checkpoint(state);
  return state.bytes();
}

/// @throws Error when the state belongs to another part
template <class Part>
void restore(Part& part, const std::vector<char>& bytes) {
  Checkpoint state("test", bytes.data(), bytes.size());
  part.checkpoint(state);
  state.finish();
}

template <class Part>
void hand_over(Part& from, Part& to) {
  restore(to, state_of(from));
}

}  // namespace furrow::test
