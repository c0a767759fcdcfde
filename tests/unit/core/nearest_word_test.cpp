// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/options/nearest_word.h"

#include <gtest/gtest.h>

namespace furrow::nearest_word_test {
namespace {

TEST(NearestWord, SuggestionDiffersByTwoLettersAtMost) {
  const std::vector<std::string> words = {"density", "beta", "R"};
  EXPECT_EQ(did_you_mean(words, "betta"), "did you mean 'beta'?");
  EXPECT_EQ(did_you_mean(words, "dnesity"), "did you mean 'density'?");
  EXPECT_EQ(did_you_mean(words, "gamma"), "");
  EXPECT_EQ(did_you_mean({}, "beta"), "");
  EXPECT_EQ(did_you_mean(words, std::string(1000000, 'b')), "");
}

}  // namespace
}  // namespace furrow::nearest_word_test
