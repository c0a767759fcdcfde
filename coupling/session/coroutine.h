// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A function that can pause in the middle and continue later: it has a separate stack.

#include <cstddef>
#include <exception>
#include <functional>

#include <ucontext.h>

namespace furrow::coupling {

class Coroutine {
 public:
  explicit Coroutine(std::function<void()> function);
  ~Coroutine();
  Coroutine(const Coroutine&) = delete;
  Coroutine& operator=(const Coroutine&) = delete;

  /// Runs the function until it pauses or ends. Passes its exception on, with which it has ended.
  void resume();
  /// Pauses the function, which calls this itself.
  void pause();
  bool ended() const { return ended_; }

 private:
  static void enter(unsigned high, unsigned low);

  std::function<void()> function_;
  std::byte* stack_;
  ucontext_t inside_{}, outside_{};
  std::exception_ptr failure_;
  bool ended_ = false;
};

}  // namespace furrow::coupling
