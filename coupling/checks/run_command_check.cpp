// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/run_command_check.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/liggghts/access.h"

namespace furrow::coupling {

namespace {

bool is_whole_number(const std::string& word) {
  const std::string digits = word.substr(!word.empty() && (word[0] == '-' || word[0] == '+'));
  return !digits.empty() && std::all_of(digits.begin(), digits.end(),
                                        [](unsigned char letter) { return std::isdigit(letter); });
}

}  // namespace

void check_run_command(const LAMMPS_NS::LAMMPS& lammps) {
  const std::vector<std::string> words = current_command(lammps);
  if (words.empty() || words[0] != "run") return;
  // Behind "every" and its number come commands.
  const auto last = std::find(words.begin(), words.end(), "every");
  for (auto word = words.begin(); word + 1 < last; ++word) {
    if (*word != "run" && *word != "start" && *word != "stop") continue;
    const std::string& number = *(word + 1);
    if (!is_whole_number(number))
      throw InputError("run", fmt::format("has '{}' for a number of steps", number),
                       "a whole number in digits", "write 100000, not 1e5 nor 1e5.0");
  }
}

}  // namespace furrow::coupling
