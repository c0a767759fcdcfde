// SPDX-License-Identifier: GPL-2.0-or-later
#include "fuzz.h"
#include "furrow/io/inputs/brick_tyre_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const furrow::fuzz::InputFolder folder;
  const std::string path = folder.write("materials/input.yaml", data, size);
  furrow::fuzz::read_or_refuse<furrow::InputError>([&] { furrow::read_brick_tyre_file(path); });
  return 0;
}
