// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Suggestions for misspelled words.

#include <string>
#include <vector>

namespace furrow {

/// Hint "did you mean 'beta'?" for a word that is at most two letters from the given one, else "".
std::string did_you_mean(const std::vector<std::string>& words, const std::string& given);

}  // namespace furrow
