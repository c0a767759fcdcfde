// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Every refusal of the library is one of these exceptions; only coupling/ turns them into LIGGGHTS
/// errors.

#include <stdexcept>
#include <string>

namespace furrow {

/// Base of all errors thrown by Furrow.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Something the user wrote is wrong. The message says where, what, what is allowed and what to do.
class InputError : public Error {
 public:
  /// @param where    the thing being read: "fix wheel/rigid, keyword 'mass'"
  /// @param problem  what is wrong: "is -5 kg"
  /// @param allowed  what would be accepted: "a number > 0"
  /// @param remedy   what to do, or empty
  InputError(const std::string& where, const std::string& problem, const std::string& allowed,
             const std::string& remedy = "")
      : Error(where + " " + problem + "; allowed: " + allowed +
              (remedy.empty() ? "" : "; " + remedy)) {}
  /// A whole message, for a reader that adds the place to an error it caught.
  explicit InputError(const std::string& message) : Error(message) {}
};

/// The computation reached a state that must not be continued: not a number, a folded element, an
/// unstable step.
class StateError : public Error {
 public:
  using Error::Error;
};

}  // namespace furrow
