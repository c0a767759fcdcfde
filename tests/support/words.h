// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace furrow::test {

/// Keywords and values of a line of a script, followed by those keywords of others, each with one
/// value, that the line does not have.
inline std::vector<std::string> words(const std::string& line, const std::string& others = "") {
  std::vector<std::string> found;
  std::istringstream given(line), rest(others);
  for (std::string word; given >> word;) found.push_back(word);
  for (std::string key, value; rest >> key >> value;)
    if (std::find(found.begin(), found.end(), key) == found.end())
      found.insert(found.end(), {key, value});
  return found;
}

}  // namespace furrow::test
