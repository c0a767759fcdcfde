// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/csv_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/io/formats/input_text.h"
#include "furrow/io/formats/units.h"

namespace furrow {

namespace {

constexpr std::uintmax_t largest_table = 64u << 20;  // [bytes]

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// A cell in quotes may hold the separator.
std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// Separator of the cells, from the line of names.
char separator_of(const std::string& line) {
  for (const char separator : {';', '\t'})
    if (line.find(separator) != std::string::npos) return separator;
  return ',';
}

bool is_blank(const std::vector<std::string>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const std::string& c) { return c.empty(); });
}

/// True for the texts that programs write in place of a missing number.
bool is_missing(const std::string& cell) {
  const std::string word = lower_case(cell);
  return word.empty() || word == "nan" || word == "na" || word == "n/a" || word == "#n/a" ||
         word == "-";
}

bool parse_number(std::string cell, bool decimal_comma, double& value) {
  if (decimal_comma && cell.find('.') == std::string::npos)
    if (const std::size_t comma = cell.find(','); comma != std::string::npos) cell[comma] = '.';
  const char* first = cell.data() + (cell.front() == '+' ? 1 : 0);
  const auto [stop, status] = std::from_chars(first, cell.data() + cell.size(), value);
  return status == std::errc{} && stop == cell.data() + cell.size() && std::isfinite(value);
}

/// Name and unit of a heading. Brackets always hold a unit. Text behind the last underscore, blank,
/// comma or slash may be part of the name.
struct Heading {
  std::string name, unit;
  bool in_brackets = false;
};

Heading heading_of(const std::string& text) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, {'(', ')'}}) {
    const std::size_t begin = text.rfind(open);
    if (text.empty() || text.back() != close || begin == std::string::npos) continue;
    const std::string unit = trimmed(text.substr(begin + 1, text.size() - begin - 2));
    std::string name = trimmed(text.substr(0, begin));
    while (!name.empty() && name.back() == '_') name.pop_back();
    if (unit.empty() || unit == "-") return {name, "ratio", true};
    if (open == '[' || find_unit(unit)) return {name, unit, true};
  }
  for (const char* separator : {" / ", ", ", "_", " ", "/"})
    if (const std::size_t at = text.rfind(separator); at != std::string::npos && at > 0)
      if (const std::string unit = trimmed(text.substr(at + std::string(separator).size()));
          find_unit(unit))
        return {trimmed(text.substr(0, at)), unit, false};
  return {text, "", false};
}

/// Units that values without a unit may have, distinguished by the largest value.
struct Reading {
  const char* si;
  const char* other;   // unit
  double least, most;  // of the largest value that fits the other unit better
};
constexpr Reading readings[] = {{"Pa", "kPa", 0.1, 5e3},
                                {"", "%", 1.0, 100.0},
                                {"kg/m3", "g/cm3", 0.05, 20.0},
                                {"m", "mm", 5.0, 1e6}};

bool is_strain(const std::string& name) {
  const std::string word = lower_case(name);
  return word.find("strain") != std::string::npos || word.rfind("eps", 0) == 0;
}

}  // namespace

CsvTable CsvTable::read(const std::string& path) {
  CsvTable table;
  table.path_ = path;
  std::istringstream text(
      read_input_text(path, "a table of comma-separated values", largest_table));
  std::string line;
  char separator = ',';
  for (int number = 1; std::getline(text, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (trimmed(line).empty() || line.front() == '#') continue;
    if (table.names_.empty()) separator = separator_of(line);
    std::vector<std::string> cells = split(line, separator);
    if (table.names_.empty()) {
      table.names_ = std::move(cells);
      continue;
    }
    if (is_blank(cells)) continue;
    if (cells.size() != table.names_.size())
      throw InputError(fmt::format("{}, line {}", path, number),
                       fmt::format("has {} values", cells.size()),
                       fmt::format("{}, as the line of names", table.names_.size()));
    // a second line of names holds units
    const auto is_unit = [](const std::string& cell) {
      const Heading heading = heading_of(cell);
      return cell.empty() || cell == "-" || (find_unit(cell) && cell != "1") ||
             (heading.name.empty() && heading.in_brackets);
    };
    const bool is_units = table.cells_.empty() &&
                          std::all_of(cells.begin(), cells.end(), is_unit) &&
                          std::any_of(cells.begin(), cells.end(), [](const std::string& cell) {
                            return find_unit(cell) || heading_of(cell).in_brackets;
                          });
    if (is_units) {
      for (std::size_t c = 0; c < cells.size(); ++c)
        if (!cells[c].empty())
          table.names_[c] += fmt::format(" [{}]", find_unit(cells[c]) || cells[c] == "-"
                                                      ? cells[c]
                                                      : heading_of(cells[c]).unit);
      continue;
    }
    table.cells_.push_back(std::move(cells));
    table.lines_.push_back(number);
  }
  if (table.cells_.empty())
    throw InputError(path, "has no rows", "a line of names and lines of values");
  table.decimal_comma_ = separator != ',';
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
    if (!is_missing(cell) && !parse_number(cell, decimal_comma_, value))
      throw InputError(fmt::format("{}, line {}, column '{}'", path_, lines_[row], name),
                       fmt::format("is '{}'", cell), "a finite number",
                       cell.find(',') != std::string::npos && !decimal_comma_
                           ? "separate cells by ';' where numbers have a decimal comma"
                           : "");
    values.push_back(value);
  }
  return values;
}

MeasuredColumn CsvTable::measured(const std::string& name, const std::string& si) const {
  MeasuredColumn column;
  column.heading = name;
  Heading heading = heading_of(name);
  // "q [kPa]" is a heading, or the column q with its unit
  if (std::find(names_.begin(), names_.end(), name) == names_.end() && heading.in_brackets)
    column.heading = heading.name;
  column.values = numbers(column.heading);
  const Unit* unit = heading.unit.empty() ? nullptr : find_unit(heading.unit);
  const std::string where = fmt::format("{}, column '{}'", path_, name);
  // a name such as "p_s" has no unit for a pressure
  if (!heading.in_brackets && unit && unit->si != si) unit = nullptr;
  if (heading.in_brackets && (!unit || unit->si != si)) {
    throw InputError(where, fmt::format("has the unit '{}'", heading.unit), units_of(si));
  }
  column.name = unit ? heading.name : name;
  column.si = si;
  if (unit) {
    column.unit = heading.unit;
    column.factor = unit->factor;
    for (double& value : column.values) value *= unit->factor;
    return column;
  }
  double largest = 0.0;
  for (const double value : column.values)
    if (!std::isnan(value)) largest = std::max(largest, std::abs(value));
  for (const Reading& reading : readings)
    if (si == reading.si && (!si.empty() || is_strain(name)) && largest > reading.least &&
        largest <= reading.most) {
      const double factor = find_unit(reading.other)->factor;
      const std::string own = si.empty() ? "ratio" : si;
      throw InputError(
          where,
          fmt::format("has no unit, and values up to {0:.4g}: in {1} up to {0:.4g} {1}, in {2} up "
                      "to {3:.4g} {1}",
                      largest, own, reading.other, factor * largest),
          fmt::format("a heading with its unit: '{0} [{1}]' or '{0} [{2}]'", name, own,
                      reading.other),
          "write the unit behind the heading, or behind the name of the column");
    }
  return column;
}

bool CsvTable::has_numbers(std::size_t column) const {
  return std::all_of(cells_.begin(), cells_.end(), [&](const std::vector<std::string>& row) {
    double value = 0.0;
    return is_missing(row[column]) || parse_number(row[column], decimal_comma_, value);
  });
}

std::vector<MeasuredColumn> CsvTable::all_measured() const {
  std::vector<MeasuredColumn> columns;
  for (std::size_t c = 0; c < names_.size(); ++c) {
    if (names_[c].empty() || !has_numbers(c)) continue;
    const Heading heading = heading_of(names_[c]);
    MeasuredColumn column{names_[c], names_[c], "", "", 1.0, numbers(names_[c])};
    if (const Unit* unit = heading.unit.empty() ? nullptr : find_unit(heading.unit)) {
      column = {names_[c], heading.name, heading.unit, unit->si, unit->factor, column.values};
      for (double& value : column.values) value *= unit->factor;
    }
    columns.push_back(std::move(column));
  }
  return columns;
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
