// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Tables as text: a line of names, and lines of as many cells.

#include <string>
#include <vector>

namespace furrow {

/// A column of measurements.
struct MeasuredColumn {
  std::string heading;         ///< heading in the file
  std::string name;            ///< without the unit
  std::string unit;            ///< in the heading; empty without
  std::string si;              ///< unit of the values: "Pa", "" for a ratio
  double factor = 1.0;         ///< from the unit of the heading to SI
  std::vector<double> values;  ///< SI if the heading has a unit
};

/// A table read from a file. Cells are separated by commas, semicolons or tabulators, as the line
/// of names has them; with the latter two a number may have a decimal comma. An empty cell, NaN and
/// NA are no number. A second line of names may hold the units. '#' begins a comment.
class CsvTable {
 public:
  /// @throws InputError naming file and line: missing, empty, a line of another length
  static CsvTable read(const std::string& path);

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return cells_.size(); }
  /// A column of numbers; an empty cell is NaN. @throws InputError for an unknown name, or a cell
  /// that is no finite number
  std::vector<double> numbers(const std::string& name) const;
  /// A column in an SI unit. The heading may name another unit of the kind: "q_kPa", "q [kPa]",
  /// "strain (%)". A name without heading may end with the unit of its column: "q [kPa]".
  /// @param si  "Pa", "m", "N", "kg/m3", "degree", "s" or "" for a ratio
  /// @throws InputError for a unit of another kind, and for a column without a unit whose values
  /// fit another unit better
  MeasuredColumn measured(const std::string& name, const std::string& si) const;
  /// All columns of numbers, each in the SI unit of its heading.
  std::vector<MeasuredColumn> all_measured() const;

 private:
  bool has_numbers(std::size_t column) const;

  std::string path_;
  bool decimal_comma_ = false;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<int> lines_;
};

/// Columns of equal length to text with all digits. `comments` are lines without '#'.
std::string csv_text(const std::vector<std::string>& comments,
                     const std::vector<std::string>& names,
                     const std::vector<std::vector<double>>& columns);

}  // namespace furrow
