// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/machine.h"

#include <sys/resource.h>

#include <gtest/gtest.h>

// g++ and clang tell it in ways of their own.
#if defined(__SANITIZE_ADDRESS__)
#define FURROW_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#define FURROW_ADDRESS_SANITIZER __has_feature(address_sanitizer)
#else
#define FURROW_ADDRESS_SANITIZER 0
#endif

namespace furrow::machine_test {
namespace {

TEST(Machine, UsableMemoryRespectsTheLimitOfTheShell) {
#if FURROW_ADDRESS_SANITIZER
  GTEST_SKIP() << "the address sanitizer reserves terabytes of addresses, and ends under a limit";
#endif
  const double all = usable_memory(1);
  EXPECT_GT(all, 0.0);
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit limited = before;
  limited.rlim_cur = static_cast<rlim_t>(0.25 * all);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limited), 0);
  const double one = usable_memory(1), three = usable_memory(3), many = usable_memory(1000);
  setrlimit(RLIMIT_AS, &before);
  EXPECT_DOUBLE_EQ(one, static_cast<double>(limited.rlim_cur));
  EXPECT_DOUBLE_EQ(three, 3.0 * one);
  EXPECT_GE(many, all);  // no more than the machine has
}

}  // namespace
}  // namespace furrow::machine_test
