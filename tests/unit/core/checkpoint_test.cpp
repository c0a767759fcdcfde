// SPDX-License-Identifier: GPL-2.0-or-later
// A checkpoint returns what was saved, bit for bit; a damaged, foreign or unsuitable one is
// refused.
#include "furrow/core/checkpoint.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "tests/support/error_of.h"

namespace furrow::checkpoint_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

enum class Colour { red, green };

struct Part {
  double mass = 1.0;
  double length = 0.5;
  std::int64_t count = 0;
  bool moving = false;
  Colour colour = Colour::red;
  std::string name;
  std::vector<double> numbers;
  Vector3 place = Vector3::Zero();

  void checkpoint(Checkpoint& state) {
    state.match("mass", mass);
    state.value("length", length);
    state.value("count", count);
    state.value("moving", moving);
    state.value("colour", colour);
    state.value("name", name);
    state.values("numbers", numbers);
    state.values("place", place);
  }
};

Part some_part() {
  Part part;
  part.length = std::numeric_limits<double>::denorm_min();
  part.count = std::int64_t{1} << 60;
  part.moving = true;
  part.colour = Colour::green;
  part.name = "a name\nof two lines";
  part.numbers = {-0.0, 1.0 / 3.0, std::numeric_limits<double>::infinity()};
  part.place = {1, 2, 3};
  return part;
}

std::vector<char> saved(Part part = some_part()) {
  Checkpoint state("part");
  part.checkpoint(state);
  return state.bytes();
}

void restore(Part& part, const std::vector<char>& bytes) {
  Checkpoint state("part", bytes.data(), bytes.size());
  part.checkpoint(state);
  state.finish();
}

TEST(Checkpoint, RestoredValuesHaveEveryBit) {
  Part part;
  restore(part, saved());
  EXPECT_EQ(saved(part), saved());
  EXPECT_TRUE(std::signbit(part.numbers.at(0)));
  EXPECT_EQ(part.name, "a name\nof two lines");
  EXPECT_EQ(part.colour, Colour::green);
}

TEST(Checkpoint, ChangedParameterIsNamed) {
  Part heavier;
  heavier.mass = 2.0;
  EXPECT_THAT(test::error_of([&] { restore(heavier, saved()); }),
              AllOf(HasSubstr("part: mass is 2, and was 1 when the checkpoint was written"),
                    HasSubstr("continue with the input and the program of the first run")));
}

TEST(Checkpoint, RefusesAnyAlteredByte) {
  const std::vector<char> whole = saved();
  for (std::size_t n = 0; n < whole.size(); ++n) {
    std::vector<char> altered = whole;
    altered[n] = static_cast<char>(altered[n] ^ 4);
    Part part;
    EXPECT_NE(test::error_of([&] { restore(part, altered); }), "no error") << "byte " << n;
  }
}

TEST(Checkpoint, RefusesEveryShorterLength) {
  const std::vector<char> whole = saved();
  for (std::size_t n = 0; n < whole.size(); ++n) {
    Part part;
    EXPECT_NE(test::error_of([&] {
                restore(part, {whole.begin(), whole.begin() + static_cast<long>(n)});
              }),
              "no error")
        << "length " << n;
  }
}

TEST(Checkpoint, OtherLayoutIsRefusedByName) {
  Checkpoint other("part");
  double mass = 1.0, width = 2.0;
  other.value("mass", mass);
  other.value("width", width);
  const std::vector<char> bytes = other.bytes();
  Part part;
  EXPECT_THAT(test::error_of([&] { restore(part, bytes); }),
              HasSubstr("part: its part of the checkpoint has 'width' where 'length' is expected"));
  Checkpoint read("part", bytes.data(), bytes.size());
  read.value("mass", mass);
  EXPECT_THAT(test::error_of([&] { read.finish(); }),
              HasSubstr("contains more than this program reads"));
  Checkpoint again("part", bytes.data(), bytes.size());
  Vector3 three;
  EXPECT_THAT(test::error_of([&] { again.values("mass", three); }),
              HasSubstr("has 1 numbers of 'mass' instead of 3"));
}

}  // namespace
}  // namespace furrow::checkpoint_test
