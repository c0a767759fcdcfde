// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The styles of a run with the values they took, for whoever evaluates it: /run/styles of a
/// results file.

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "furrow/core/options/options.h"

namespace furrow {

/// One line of the script as it took effect.
struct StyleRecord {
  using Value = std::variant<bool, std::int64_t, double, std::string>;

  std::string id;     ///< of the fix; empty for a command
  std::string group;  ///< of atoms; empty for a command
  std::string style;  ///< "wheel/rigid"
  std::string kind;   ///< "wheel"
  std::vector<std::pair<std::string, std::vector<Value>>> options;
};

/// Every key that has a value, defaults included, in the order of declaration: flags as bool,
/// integers and numbers as such, choices and texts as text.
std::vector<std::pair<std::string, std::vector<StyleRecord::Value>>> typed_values(
    const Options& options);
/// A number where the text reads as one, else the text.
StyleRecord::Value typed_value(const std::string& text);

/// Text of JSON, a line for each style: [{"id": ..., "group": ..., "style": ..., "kind": ...,
/// "options": {key: [values]}}, ...].
std::string styles_json(const std::vector<StyleRecord>& styles);

}  // namespace furrow
