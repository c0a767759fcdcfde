// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/later_lines.h"

#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::coupling {

namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line.substr(0, line.find('#')));
  return {std::istream_iterator<std::string>(text), {}};
}

void check_fix(const LAMMPS_NS::LAMMPS& lammps, const std::vector<std::string>& words) {
  const std::string& name = words[3];
  const Style* style = find_style(name);
  if (!style && !has_fix_style(lammps, name))
    throw InputError(fmt::format("fix style '{}'", name), "does not exist",
                     "a style of LIGGGHTS or "
                     "of Furrow",
                     "check its spelling");
  // LIGGGHTS parses the arguments of walls and averages, which Furrow extends.
  static const std::set<std::string> of_liggghts = {"wall", "internal"};
  if (style && !of_liggghts.count(style->kind))
    style->schema().check({words.begin() + 4, words.end()});
}

}  // namespace

void check_later_lines(const LAMMPS_NS::LAMMPS& lammps) {
  on_first_rank(lammps.world, [&] {
    static const std::set<std::string> jumps = {"jump", "label", "next", "quit", "clear"};
    const std::vector<ScriptLine> lines = later_lines(lammps);
    for (const ScriptLine& line : lines)
      for (const std::string& word : words_of(line.text))
        if (jumps.count(word)) return;
    for (const ScriptLine& line : lines) {
      const std::vector<std::string> words = words_of(line.text);
      const bool plain = line.text.find_first_of("\"'") == std::string::npos;
      if (words.size() < 4 || words[0] != "fix" || !plain ||
          words[3].find('$') != std::string::npos)
        continue;
      try {
        check_fix(lammps, words);
      } catch (const InputError& fault) {
        throw InputError(fmt::format("line {} of this script, before the bed is made: {}",
                                     line.number, fault.what()));
      }
    }
  });
}

}  // namespace furrow::coupling
