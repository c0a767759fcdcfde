// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <utility>

#include "furrow/core/error.h"

namespace furrow::test {

/// Text of the error that an action throws as `Expected`, or "no error". Any other exception goes
/// on, and fails the test.
template <class Expected = Error, class Action>
std::string error_of(Action&& action) {
  try {
    std::forward<Action>(action)();
  } catch (const Expected& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace furrow::test
