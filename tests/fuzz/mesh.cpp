// SPDX-License-Identifier: GPL-2.0-or-later
#include "fuzz.h"
#include "furrow/io/formats/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const furrow::fuzz::InputFolder folder;
  for (const char* name : {"data/input.stl", "data/input.obj"}) {
    const std::string path = folder.write(name, data, size);
    furrow::fuzz::read_or_refuse<furrow::InputError>(
        [&] { furrow::check_solid(furrow::read_mesh_file(path)); });
  }
  return 0;
}
