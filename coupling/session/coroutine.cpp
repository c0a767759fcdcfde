// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/session/coroutine.h"

#include <cstdint>
#include <new>
#include <utility>

#include <sys/mman.h>
#include <unistd.h>

namespace furrow::coupling {

namespace {

constexpr std::size_t stack_size = std::size_t{16} << 20;  // [bytes], 2 times that of a process

std::size_t page_size() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

}  // namespace

Coroutine::Coroutine(std::function<void()> function) : function_(std::move(function)) {
  void* memory = mmap(nullptr, stack_size, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  stack_ = static_cast<std::byte*>(memory);
  mprotect(stack_, page_size(), PROT_NONE);  // an overflow stops the process
  getcontext(&inside_);
  inside_.uc_stack.ss_sp = stack_;
  inside_.uc_stack.ss_size = stack_size;
  inside_.uc_link = &outside_;
  const auto self = reinterpret_cast<std::uintptr_t>(this);
  makecontext(&inside_, reinterpret_cast<void (*)()>(enter), 2, static_cast<unsigned>(self >> 32),
              static_cast<unsigned>(self));
}

Coroutine::~Coroutine() { munmap(stack_, stack_size); }

void Coroutine::enter(unsigned high, unsigned low) {
  auto* self = reinterpret_cast<Coroutine*>((std::uintptr_t{high} << 32) | low);
  try {
    self->function_();
  } catch (...) {
    self->failure_ = std::current_exception();
  }
  self->ended_ = true;
}

void Coroutine::resume() {
  swapcontext(&outside_, &inside_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Coroutine::pause() { swapcontext(&inside_, &outside_); }

}  // namespace furrow::coupling
