// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/base/checks/finding.h"

#include <utility>

#include "furrow/core/error.h"

namespace furrow::coupling {

Finding warning(std::string text) { return {std::move(text)}; }

Finding refusal(const std::string& where, const std::string& problem, const std::string& allowed,
                const std::string& remedy) {
  return {InputError(where, problem, allowed, remedy).what(), true};
}

}  // namespace furrow::coupling
