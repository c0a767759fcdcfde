// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Tables as text: commas, one line of names, '#' comments before it.

#include <string>
#include <vector>

namespace furrow {

/// A table read from a file.
class CsvTable {
 public:
  /// @throws InputError naming file and line: missing, empty, a line of another length
  static CsvTable read(const std::string& path);

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return cells_.size(); }
  /// A column of numbers; an empty cell is NaN. @throws InputError for an unknown name, or a cell
  /// that is no finite number
  std::vector<double> numbers(const std::string& name) const;

 private:
  std::string path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<int> lines_;
};

/// Columns of equal length to text with all digits. `comments` are lines without '#'.
std::string csv_text(const std::vector<std::string>& comments,
                     const std::vector<std::string>& names,
                     const std::vector<std::vector<double>>& columns);

}  // namespace furrow
