// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/options/nearest_word.h"

#include <algorithm>

#include <fmt/format.h>

namespace furrow {

namespace {

constexpr std::size_t largest_distance = 2;  // further away is no help

/// Letters to insert, delete or replace (Levenshtein).
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

std::string did_you_mean(const std::vector<std::string>& words, const std::string& given) {
  const std::string* best = nullptr;
  std::size_t best_distance = largest_distance + 1;
  for (const std::string& word : words) {
    if (word.size() > given.size() + largest_distance ||
        given.size() > word.size() + largest_distance)
      continue;
    const std::size_t distance = edit_distance(word, given);
    if (distance < best_distance) {
      best_distance = distance;
      best = &word;
    }
  }
  return best ? fmt::format("did you mean '{}'?", *best) : "";
}

}  // namespace furrow
