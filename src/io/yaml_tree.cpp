// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/yaml_tree.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"

namespace furrow {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

YamlTree tree_of(const YAML::Node& node, const std::string& path) {
  YamlTree tree;
  tree.origin = fmt::format("{}, line {}", path, node.Mark().line + 1);
  if (node.IsScalar()) {
    tree.text = node.Scalar();
  } else if (node.IsSequence()) {
    tree.kind = YamlTree::Kind::list;
    for (const YAML::Node& item : node) tree.items.push_back(tree_of(item, path));
  } else if (node.IsMap()) {
    tree.kind = YamlTree::Kind::map;
    for (const auto& pair : node) {
      const std::string origin = fmt::format("{}, line {}", path, pair.first.Mark().line + 1);
      if (!pair.first.IsScalar())
        throw InputError(origin, "has a key that is not a word", "key: value");
      const std::string key = pair.first.Scalar();
      if (tree.find(key))
        throw InputError(fmt::format("{}: keyword '{}'", origin, key), "is given twice",
                         "each keyword once", "remove one of them");
      if (pair.second.IsNull())
        throw InputError(fmt::format("{}: keyword '{}'", origin, key), "has no value", "key: value",
                         "write the value or remove the key");
      tree.keys.emplace_back(key, tree_of(pair.second, path));
      tree.keys.back().second.origin = origin;
    }
  } else {
    throw InputError(tree.origin, "has an empty value", "a value");
  }
  return tree;
}

}  // namespace

const YamlTree* YamlTree::find(const std::string& key) const {
  for (const auto& [name, value] : keys)
    if (name == key) return &value;
  return nullptr;
}

const YamlTree& YamlTree::map(const std::string& key, const std::string& meaning) const {
  const YamlTree* value = find(key);
  if (!value) throw InputError(origin, fmt::format("has no section '{}'", key), meaning);
  if (value->kind != Kind::map)
    throw InputError(fmt::format("{}: '{}'", value->origin, key), "is not a section of keys",
                     meaning);
  return *value;
}

const YamlTree& YamlTree::list(const std::string& key, const std::string& meaning) const {
  const YamlTree* value = find(key);
  if (!value) throw InputError(origin, fmt::format("has no list '{}'", key), meaning);
  if (value->kind != Kind::list || value->items.empty())
    throw InputError(fmt::format("{}: '{}'", value->origin, key),
                     value->kind == Kind::list ? "is empty" : "is not a list", meaning);
  return *value;
}

YamlTree read_yaml(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(path, "does not exist or is not a file", "a YAML file", "check the path");
  try {
    const YAML::Node node = YAML::LoadFile(path);
    if (!node || node.IsNull())
      throw InputError(path, "is empty", "a YAML file of keys and values");
    YamlTree tree = tree_of(node, path);
    if (tree.kind != YamlTree::Kind::map)
      throw InputError(tree.origin, "is not a map", "a YAML file of keys and values");
    tree.origin = path;
    return tree;
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}, line {}", path, error.mark.line + 1),
                     fmt::format("is not YAML: {}", error.msg), "a YAML file of keys and values",
                     "check indentation, colons and brackets");
  }
}

std::vector<Entry> entries_of(const YamlTree& map, const std::vector<std::string>& without) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : map.keys) {
    if (contains(without, key)) continue;
    Entry entry{key, {}, value.origin};
    if (value.kind == YamlTree::Kind::text) entry.values.push_back(value.text);
    for (const YamlTree& item : value.items) {
      if (item.kind != YamlTree::Kind::text)
        throw InputError(fmt::format("{}: keyword '{}'", item.origin, key),
                         "is not a list of plain values", "[1, 2, 3]");
      entry.values.push_back(item.text);
    }
    if (value.kind == YamlTree::Kind::map)
      throw InputError(fmt::format("{}: keyword '{}'", value.origin, key), "is a section",
                       "a value or a list of values");
    entries.push_back(std::move(entry));
  }
  return entries;
}

Options read_map(const Schema& schema, const YamlTree& map,
                 const std::vector<std::string>& without) {
  const std::vector<Entry> entries = entries_of(map, without);
  try {
    return schema.read(entries);
  } catch (const InputError& error) {
    const std::string text = error.what();
    const bool has_place = std::any_of(entries.begin(), entries.end(), [&](const Entry& e) {
      return text.rfind(e.origin + ":", 0) == 0;
    });
    if (has_place) throw;
    throw InputError(map.origin + ": " + text);
  }
}

void refuse_other_keys(const YamlTree& map, const std::vector<std::string>& known) {
  for (const auto& [key, value] : map.keys)
    if (!contains(known, key))
      throw InputError(value.origin, fmt::format("has the unknown key '{}'", key),
                       fmt::format("{}", fmt::join(known, ", ")));
}

}  // namespace furrow
