// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/nearest_name.h"

#include <algorithm>
#include <cstddef>

namespace furrow {

namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_name(const std::vector<std::string>& names, const std::string& written) {
  std::string best;
  std::size_t best_distance = 3;  // further away is no help
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(name, written);
    if (distance < best_distance) {
      best_distance = distance;
      best = name;
    }
  }
  return best;
}

}  // namespace furrow
