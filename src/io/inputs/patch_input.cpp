// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/patch_input.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

void declare_patches(Schema& schema, const std::string& soil) {
  schema
      .text("patches", fmt::format("soils beside that of the line, `along:x:{0};...` or "
                                   "`across:y:{0};...`: each from that x or y on, in metres",
                                   soil))
      .optional()
      .may_change();  // of files; checkpoints compare places and soils
}

PatchesInput read_patches(const Options& options) {
  PatchesInput patches;
  if (!options.given("patches")) return patches;
  const std::string where = options.where("patches");
  std::istringstream text(options.text("patches"));
  for (std::string part; std::getline(text, part, ';');) {
    const std::size_t first = part.find(':'), second = part.find(':', first + 1);
    const std::string direction = part.substr(0, first);
    double begin = 0.0;
    bool good = second != std::string::npos && second + 1 < part.size() &&
                (direction == "along" || direction == "across");
    if (good) {
      const auto [end, failed] =
          std::from_chars(part.data() + first + 1, part.data() + second, begin);
      good = failed == std::errc() && end == part.data() + second && std::isfinite(begin);
    }
    if (!good)
      throw InputError(where, fmt::format("has the patch '{}'", part),
                       "along:x:file or across:y:file, with x or y in metres",
                       "separate patches by ';'");
    const int axis = direction == "along" ? 0 : 1;
    if (!patches.list.empty() && axis != patches.axis)
      throw InputError(where, "has patches along and across", "patches in one direction");
    if (!patches.list.empty() && begin <= patches.list.back().begin)
      throw InputError(
          where,
          fmt::format("has the place {:g} m behind {:g} m", begin, patches.list.back().begin),
          "places in ascending order");
    patches.axis = axis;
    patches.list.push_back({begin, part.substr(second + 1)});
  }
  return patches;
}

}  // namespace furrow
