// SPDX-License-Identifier: GPL-2.0-or-later
#include "number_option.h"

#include "furrow/core/error.h"

namespace furrow {

CLI::Validator within(const Range& range, const std::string& unit) {
  Schema schema("");
  schema.number("value", unit, range, "");
  const std::string allowed = schema.keys().front().allowed();
  return CLI::Validator(
      [schema, allowed](std::string& text) -> std::string {
        try {
          schema.read({Entry{"value", {text}}});
          return {};
        } catch (const InputError&) {
          return "is '" + text + "'; allowed: " + allowed;
        }
      },
      allowed);
}

}  // namespace furrow
