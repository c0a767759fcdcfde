// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// States of parts of a run, for tests that compare them or hand them over.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/rank_numbers.h"

namespace furrow::test {

/// In memory, of each rank.
class NumbersInMemory : public RankNumbers {
 public:
  explicit NumbersInMemory(int rank = 0) : of_rank(static_cast<std::size_t>(rank) + 1) {}
  void append(const double* numbers, std::size_t count) override {
    of_rank.back().insert(of_rank.back().end(), numbers, numbers + count);
  }
  void check(int) override {}
  void read(int rank, std::uint64_t first, double* numbers, std::size_t count) override {
    const auto begin = of_rank.at(static_cast<std::size_t>(rank)).begin();
    std::copy_n(begin + static_cast<std::ptrdiff_t>(first), count, numbers);
  }
  std::vector<std::vector<double>> of_rank;
};

/// Parts that keep numbers of each rank outside of the checkpoint's bytes: terrain.
template <class Part, class = void>
struct KeepsValues : std::false_type {};
template <class Part>
struct KeepsValues<Part, std::void_t<decltype(&Part::keep_values_in)>> : std::true_type {};

template <class Part>
void checkpoint_with(Part& part, Checkpoint& state, RankNumbers& numbers) {
  if constexpr (KeepsValues<Part>::value) part.keep_values_in(numbers);
  part.checkpoint(state);
}

/// Content of a checkpoint; equal states are equal in every bit.
struct SavedState {
  std::vector<char> bytes;
  NumbersInMemory numbers;
  bool operator==(const SavedState& other) const {
    return bytes == other.bytes && numbers.of_rank == other.numbers.of_rank;
  }
};

template <class Part>
SavedState state_of(Part& part, int rank = 0) {
  SavedState saved{{}, NumbersInMemory(rank)};
  Checkpoint state("test");
  checkpoint_with(part, state, saved.numbers);
  saved.bytes = state.bytes();
  return saved;
}

/// @throws Error when the state belongs to another part
template <class Part>
void restore(Part& part, SavedState saved) {
  Checkpoint state("test", saved.bytes.data(), saved.bytes.size());
  checkpoint_with(part, state, saved.numbers);
  state.finish();
}

template <class Part>
void hand_over(Part& from, Part& to) {
  restore(to, state_of(from));
}

}  // namespace furrow::test
