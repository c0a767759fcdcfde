// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/text_lines.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

std::string short_word(std::string_view word) { return std::string(word.substr(0, 20)); }

bool TextLines::next() {
  words_.clear();
  while (!rest_.empty() && words_.empty()) {
    ++number_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    split(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
  }
  return !words_.empty();
}

void TextLines::split(std::string_view line) {
  if (comment_ != 0) line = line.substr(0, line.find(comment_));
  for (std::size_t from = line.find_first_not_of(blanks_); from != std::string_view::npos;) {
    const std::size_t to = std::min(line.find_first_of(blanks_, from), line.size());
    words_.push_back(line.substr(from, to - from));
    from = line.find_first_not_of(blanks_, to);
  }
}

void TextLines::refuse(int line, const std::string& problem, const std::string& allowed,
                       const std::string& remedy) const {
  throw InputError(line > 0 ? fmt::format("{}, line {}", path_, line) : path_, problem, allowed,
                   remedy);
}

}  // namespace furrow
