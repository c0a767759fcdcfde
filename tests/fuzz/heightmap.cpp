// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include "fuzz.h"
#include "furrow/io/formats/heightmap_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const furrow::fuzz::InputFolder folder;
  const std::string path = folder.write("data/input.asc", data, size);
  furrow::fuzz::read_or_refuse<furrow::InputError>([&] {
    const furrow::Heightmap map = furrow::read_heightmap(path);
    const furrow::Vector2 last = map.lower + furrow::Vector2((map.columns - 1) * map.spacing.x(),
                                                             (map.rows - 1) * map.spacing.y());
    for (const furrow::Vector2& place :
         {map.lower, last, furrow::Vector2(0.5 * (map.lower + last))})
      if (!std::isfinite(map.height(place.x(), place.y()))) std::abort();
  });
  return 0;
}
