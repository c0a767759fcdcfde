// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/history.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

History::History(std::vector<Channel> channels)
    : channels_(std::move(channels)), columns_(channels_.size()) {}

History::History(std::vector<Channel> channels, std::vector<std::vector<double>> columns)
    : channels_(std::move(channels)), columns_(std::move(columns)) {
  if (columns_.size() != channels_.size())
    throw Error(fmt::format("a history of {} channels cannot have {} columns", channels_.size(),
                            columns_.size()));
  for (const std::vector<double>& column : columns_)
    if (column.size() != size())
      throw Error(
          fmt::format("a history cannot have columns of {} and {} rows", size(), column.size()));
}

void History::append(const std::vector<double>& row) {
  if (row.size() != channels_.size())
    throw Error(fmt::format("a history of {} channels cannot take a row of {} numbers",
                            channels_.size(), row.size()));
  for (std::size_t channel = 0; channel < row.size(); ++channel)
    columns_[channel].push_back(row[channel]);
}

double History::at(std::size_t row, std::size_t channel) const {
  if (row >= size() || channel >= channels_.size())
    throw Error(fmt::format("the history has {} rows and {} channels, none at row {}, channel {}",
                            size(), channels_.size(), row, channel));
  return columns_[channel][row];
}

bool History::has(const std::string& name) const {
  return std::any_of(channels_.begin(), channels_.end(),
                     [&](const Channel& channel) { return channel.name == name; });
}

std::size_t History::index(const std::string& name) const {
  std::string names;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].name == name) return i;
    names += (i ? ", " : "") + channels_[i].name;
  }
  throw Error(fmt::format("the history has no channel '{}'; it has {}", name,
                          names.empty() ? "none" : names));
}

const std::vector<double>& History::column(const std::string& name) const {
  return columns_[index(name)];
}

void History::rename(const std::string& old_name, const std::string& new_name) {
  for (Channel& channel : channels_)
    if (channel.name == old_name) channel.name = new_name;
}

void History::clear() {
  for (std::vector<double>& column : columns_) column.clear();
}

void History::truncate_after(double time) {
  std::size_t rows = size();
  while (rows > 0 && columns_.front()[rows - 1] > time) --rows;
  for (std::vector<double>& column : columns_) column.resize(rows);
}

}  // namespace furrow
