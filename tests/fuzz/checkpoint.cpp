// SPDX-License-Identifier: GPL-2.0-or-later
// A checkpoint of made-up bytes, and one of values in a made-up order, with a byte of it altered.
#include <fuzzer/FuzzedDataProvider.h>

#include <vector>

#include "furrow/core/checkpoint.h"
#include "fuzz.h"

namespace {

/// A value of every kind, as a part of a run saves them.
struct Part {
  double mass = 1.0;
  std::int64_t count = 0;
  bool moving = false;
  std::string name = "wheel";
  std::vector<double> numbers;
  furrow::Vector3 place = furrow::Vector3::Zero();

  void checkpoint(furrow::Checkpoint& state) {
    state.match("mass", mass);
    state.value("count", count);
    state.value("moving", moving);
    state.match("name", name);
    state.values("numbers", numbers);
    state.values("place", place);
  }
};

void restore(const std::vector<char>& bytes) {
  furrow::fuzz::read_or_refuse<furrow::Error>([&] {
    furrow::Checkpoint state("part", bytes.data(), bytes.size());
    Part part;
    part.checkpoint(state);
    state.finish();
  });
}

std::vector<char> saved(FuzzedDataProvider& input) {
  const auto name = [&] {
    return std::string(
        input.PickValueInArray({"mass", "count", "moving", "name", "numbers", "place", "another"}));
  };
  furrow::Checkpoint state("part");
  for (int values = input.ConsumeIntegralInRange(0, 8); values > 0; --values) {
    if (input.ConsumeBool()) {
      auto number = input.ConsumeIntegral<std::int64_t>();
      state.value(name(), number);
    } else if (input.ConsumeBool()) {
      std::string text = input.ConsumeRandomLengthString(64);
      state.value(name(), text);
    } else {
      std::vector<double> numbers(input.ConsumeIntegralInRange<std::size_t>(0, 20));
      for (double& number : numbers) number = input.ConsumeFloatingPoint<double>();
      state.values(name(), numbers);
    }
  }
  return state.bytes();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* const raw = reinterpret_cast<const char*>(data);
  restore({raw, raw + size});
  FuzzedDataProvider input(data, size);
  std::vector<char> bytes;
  if (input.ConsumeBool()) {
    bytes = saved(input);
  } else {
    furrow::Checkpoint state("part");
    Part().checkpoint(state);
    bytes = state.bytes();
  }
  if (input.ConsumeBool())
    bytes[input.ConsumeIntegralInRange<std::size_t>(0, bytes.size() - 1)] =
        input.ConsumeIntegral<char>();
  if (input.ConsumeBool()) bytes.resize(input.ConsumeIntegralInRange<std::size_t>(0, bytes.size()));
  restore(bytes);
  return 0;
}
