// SPDX-License-Identifier: GPL-2.0-or-later
#include "fuzz.h"
#include "furrow/io/inputs/point_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const furrow::fuzz::InputFolder folder;
  const std::string path = folder.write("points/input.yaml", data, size);
  furrow::fuzz::read_or_refuse<furrow::InputError>([&] { furrow::read_point_run(path); });
  furrow::fuzz::read_or_refuse<furrow::InputError>([&] { furrow::read_point_fit(path); });
  return 0;
}
