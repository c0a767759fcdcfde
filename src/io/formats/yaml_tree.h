// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A YAML file as plain values with the line of each, and its maps read by a Schema.

#include <string>
#include <utility>
#include <vector>

#include "furrow/core/options/options.h"

namespace furrow {

/// A value of a YAML file: a text, a list, or a map that keeps the order of the file.
struct YamlTree {
  enum class Kind { text, list, map };

  Kind kind = Kind::text;
  std::string origin;  ///< "sand.yaml, line 12"
  std::string text;
  std::vector<YamlTree> items;
  std::vector<std::pair<std::string, YamlTree>> keys;

  /// Finds an entry; null when it is not there, or this is no map.
  const YamlTree* find(const std::string& key) const;
  YamlTree* find(const std::string& key);
  /// Finds an entry that must be there and be a map (a list). @throws InputError saying what
  /// `meaning` is
  const YamlTree& map(const std::string& key, const std::string& meaning) const;
  const YamlTree& list(const std::string& key, const std::string& meaning) const;
};

/// @throws InputError naming file and line: what read_input_text() refuses, empty, not YAML, two
/// documents, no map at its top, a key given twice, an empty value, nested too deep, aliases that
/// stand for more values than memory is good for
YamlTree read_yaml(const std::string& path);

/// The entries of a map whose values are texts and lists of texts. @throws InputError for a deeper
/// value
std::vector<Entry> entries_of(const YamlTree& map, const std::vector<std::string>& without = {});
/// A map read by a schema; a missing key is reported with the map's line. @throws InputError
Options read_map(const Schema& schema, const YamlTree& map,
                 const std::vector<std::string>& without = {});
/// @throws InputError when a map has a key that is not in `known`
void refuse_other_keys(const YamlTree& map, const std::vector<std::string>& known);

/// A text as YAML has it in single quotes.
std::string quoted(const std::string& text);

}  // namespace furrow
