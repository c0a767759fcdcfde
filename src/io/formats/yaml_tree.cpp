// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/yaml_tree.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdint>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/core/options/nearest_word.h"
#include "furrow/io/formats/input_text.h"
#include "furrow/io/formats/yaml_documents.h"

namespace furrow {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

[[noreturn]] void refuse_key(const std::string& where, const std::string& key,
                             const std::vector<std::string>& known) {
  throw InputError(where, fmt::format("has no keyword '{}'", key),
                   fmt::format("{}", fmt::join(known, ", ")), did_you_mean(known, key));
}

// Far above what any file needs, so that no file takes all memory or time
constexpr std::uintmax_t largest_yaml_file = 4u << 20;  // [bytes]
constexpr int largest_depth = 16;                       // of sections and lists in each other
constexpr std::size_t longest_text = 4096;              // of a key or value [bytes]
constexpr std::size_t most_repeated = 100'000;          // values that aliases (*name) stand for

constexpr char yaml_file[] = "a YAML file of keys and values";

/// Copies the nodes of yaml-cpp, in which an alias is a reference to the node of its anchor: a few
/// of them may stand for any number of values, and one may be inside its own anchor.
class TreeBuilder {
 public:
  /// @param size of the file [bytes]; without aliases it holds no more values than that
  TreeBuilder(const std::string& path, std::size_t size)
      : path_(path), values_left_(size + most_repeated) {}

  YamlTree tree(const YAML::Node& node, int depth = 0) {
    YamlTree tree;
    tree.origin = place(path_, node.Mark().line);
    if (depth > largest_depth)
      throw InputError(tree.origin, "is nested too deep",
                       fmt::format("{} sections and lists in each other", largest_depth),
                       "an alias (*name) must not be inside its own anchor (&name)");
    if (values_left_-- == 0)
      throw InputError(path_,
                       fmt::format("has aliases that stand for more than {} values", most_repeated),
                       "fewer aliases (*name)", "write out what is meant");
    if (node.IsScalar()) {
      tree.text = checked_text(node, tree.origin);
    } else if (node.IsSequence()) {
      tree.kind = YamlTree::Kind::list;
      for (const YAML::Node& item : node) tree.items.push_back(this->tree(item, depth + 1));
    } else if (node.IsMap()) {
      tree.kind = YamlTree::Kind::map;
      add_keys(tree, node, depth);
    } else {
      throw InputError(tree.origin, "has an empty value", "a value");
    }
    return tree;
  }

 private:
  std::string checked_text(const YAML::Node& node, const std::string& origin) const {
    const std::string& text = node.Scalar();
    if (text.size() > longest_text)
      throw InputError(origin, fmt::format("has a text of {} bytes", text.size()),
                       fmt::format("at most {} bytes", longest_text),
                       "is a quotation mark missing?");
    if (has_control_character(text))
      throw InputError(origin, "has a control character in a text", "text",
                       "mind that \\ begins an escape sequence between double quotation marks");
    return text;
  }

  void add_keys(YamlTree& tree, const YAML::Node& map, int depth) {
    std::unordered_set<std::string> names;
    for (const auto& pair : map) {
      const std::string origin = place(path_, pair.first.Mark().line);
      if (!pair.first.IsScalar())
        throw InputError(origin, "has a key that is not a word", "key: value");
      const std::string key = checked_text(pair.first, origin);
      if (!names.insert(key).second)
        throw InputError(fmt::format("{}: keyword '{}'", origin, key), "is given twice",
                         "each keyword once", "remove one of them");
      if (!pair.second.IsDefined() || pair.second.IsNull())
        throw InputError(fmt::format("{}: keyword '{}'", origin, key), "has no value", "key: value",
                         "write the value or remove the key");
      tree.keys.emplace_back(key, this->tree(pair.second, depth + 1));
      tree.keys.back().second.origin = origin;
    }
  }

  const std::string& path_;
  std::size_t values_left_;
};

/// The one document of a file.
YAML::Node document_of(const std::string& path, const std::string& text) {
  require_one_document(path, text);
  YAML::Node document = YAML::Load(text);
  if (!document.IsDefined() || document.IsNull()) throw InputError(path, "is empty", yaml_file);
  return document;
}

}  // namespace

const YamlTree* YamlTree::find(const std::string& key) const {
  for (const auto& [name, value] : keys)
    if (name == key) return &value;
  return nullptr;
}

YamlTree* YamlTree::find(const std::string& key) {
  return const_cast<YamlTree*>(static_cast<const YamlTree*>(this)->find(key));
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
  const std::string text = read_input_text(path, yaml_file, largest_yaml_file);
  try {
    YamlTree tree = TreeBuilder(path, text.size()).tree(document_of(path, text));
    if (tree.kind != YamlTree::Kind::map) throw InputError(tree.origin, "is not a map", yaml_file);
    tree.origin = path;
    return tree;
  } catch (const YAML::Exception& error) {
    throw InputError(place(path, error.mark.line), fmt::format("is not YAML: {}", error.msg),
                     yaml_file, "check indentation (by spaces), colons and brackets");
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
  std::vector<std::string> known;
  for (const Key& key : schema.keys()) known.push_back(key.name);
  known.insert(known.end(), without.begin(), without.end());
  for (const auto& [key, value] : map.keys) {
    const auto is_former = [&name = key](const Alias& alias) { return alias.former == name; };
    if (!contains(known, key) &&
        std::none_of(schema.aliases().begin(), schema.aliases().end(), is_former))
      refuse_key(fmt::format("{}: {}", value.origin, schema.subject()), key, known);
  }
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
    if (!contains(known, key)) refuse_key(value.origin, key, known);
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

}  // namespace furrow
