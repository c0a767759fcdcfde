// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The words of a text file, line by line.

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace furrow {

/// The whole word as a number, which may be infinite or NaN. @return whether it is one
template <class Number>
bool parse(std::string_view word, Number& value) {
  const auto [stop, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  return status == std::errc() && stop == word.data() + word.size();
}

/// A word as a message has it.
std::string short_word(std::string_view word);

class TextLines {
 public:
  /// @param blanks   which separate words
  /// @param comment  begins a comment up to the end of the line; 0: there are none
  TextLines(const std::string& path, std::string_view text, std::string_view blanks = " \t\r",
            char comment = 0)
      : path_(path), rest_(text), blanks_(blanks), comment_(comment) {}

  /// Goes to the next line that has words. @return whether there is one
  bool next();
  const std::vector<std::string_view>& words() const { return words_; }
  int line() const { return number_; }
  /// @throws InputError @param line  0: of the whole file
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& allowed,
                           const std::string& remedy = "") const;

 private:
  void split(std::string_view line);

  std::string path_;
  std::string_view rest_, blanks_;
  char comment_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

}  // namespace furrow
