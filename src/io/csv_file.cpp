// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/csv_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "io/input_text.h"

namespace furrow {

namespace {

constexpr std::uintmax_t largest_table = 64u << 20;  // [bytes]

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1) {
    comma = line.find(',', begin);
    cells.push_back(
        trimmed(line.substr(begin, comma == std::string::npos ? comma : comma - begin)));
  }
  return cells;
}

}  // namespace

CsvTable CsvTable::read(const std::string& path) {
  CsvTable table;
  table.path_ = path;
  std::istringstream text(
      read_input_text(path, "a table of comma-separated values", largest_table));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> cells = split(line);
    if (table.names_.empty()) {
      table.names_ = std::move(cells);
      continue;
    }
    if (cells.size() != table.names_.size())
      throw InputError(fmt::format("{}, line {}", path, number),
                       fmt::format("has {} values", cells.size()),
                       fmt::format("{}, as the line of names", table.names_.size()));
    table.cells_.push_back(std::move(cells));
    table.lines_.push_back(number);
  }
  if (table.cells_.empty())
    throw InputError(path, "has no rows", "a line of names and lines of values");
  return table;
}

std::vector<double> CsvTable::numbers(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end())
    throw InputError(path_, fmt::format("has no column '{}'", name),
                     fmt::format("{}", fmt::join(names_, ", ")));
  const auto column = static_cast<std::size_t>(found - names_.begin());
  std::vector<double> values;
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string& cell = cells_[row][column];
    double value = std::numeric_limits<double>::quiet_NaN();
    if (!cell.empty()) {
      const auto [stop, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (status != std::errc{} || stop != cell.data() + cell.size() || !std::isfinite(value))
        throw InputError(fmt::format("{}, line {}, column '{}'", path_, lines_[row], name),
                         fmt::format("is '{}'", cell), "a finite number");
    }
    values.push_back(value);
  }
  return values;
}

std::string csv_text(const std::vector<std::string>& comments,
                     const std::vector<std::string>& names,
                     const std::vector<std::vector<double>>& columns) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const std::string& comment : comments) fmt::format_to(out, "# {}\n", comment);
  fmt::format_to(out, "{}\n", fmt::join(names, ","));
  for (std::size_t row = 0; !columns.empty() && row < columns.front().size(); ++row)
    for (std::size_t c = 0; c < columns.size(); ++c)
      fmt::format_to(out, "{}{}", columns[c][row], c + 1 < columns.size() ? ',' : '\n');
  return fmt::to_string(text);
}

}  // namespace furrow
