// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Materials from one line of text, for tests.

#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "furrow/material/registry.h"

namespace furrow {

/// Entries of a text "key value value key value ...": numbers follow the key they belong to, a word
/// that follows a key is its value.
inline std::vector<Entry> entries_of_text(const std::string& text) {
  std::istringstream words(text);
  std::vector<Entry> entries;
  std::string word;
  const auto is_number = [](const std::string& w) {
    return std::string("0123456789+-.").find(w[0]) != std::string::npos;
  };
  while (words >> word) {
    if (!entries.empty() && (is_number(word) || entries.back().values.empty())) {
      entries.back().values.push_back(word);
    } else {
      entries.push_back({word, {}});
    }
  }
  return entries;
}

/// Material of a text "law key value value key value ...". @throws InputError
inline std::unique_ptr<Material> material_of_text(
    const std::string& text, const MaterialModels& models = material_models()) {
  const std::size_t end = text.find(' ');
  const std::string keys = end == std::string::npos ? "" : text.substr(end);
  return make_material(text.substr(0, end), entries_of_text(keys), models);
}

}  // namespace furrow
