// SPDX-License-Identifier: GPL-2.0-or-later
#include "statistics/history.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

History::History(std::vector<Channel> channels) : channels_(std::move(channels)) {}

void History::append(const std::vector<double>& row) {
  if (row.size() != channels_.size())
    throw Error(fmt::format("a history of {} channels cannot take a row of {} numbers",
                            channels_.size(), row.size()));
  values_.insert(values_.end(), row.begin(), row.end());
}

double History::at(std::size_t row, std::size_t channel) const {
  if (row >= size() || channel >= channels_.size())
    throw Error(fmt::format("the history has {} rows and {} channels, none at row {}, channel {}",
                            size(), channels_.size(), row, channel));
  return values_[row * channels_.size() + channel];
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

std::vector<double> History::column(const std::string& name) const {
  const std::size_t channel = index(name);
  std::vector<double> values(size());
  for (std::size_t row = 0; row < values.size(); ++row)
    values[row] = values_[row * channels_.size() + channel];
  return values;
}

History History::renamed(std::vector<Channel> channels) const {
  if (channels.size() != channels_.size())
    throw Error(fmt::format("{} channels cannot be the names of {} columns", channels.size(),
                            channels_.size()));
  History history(std::move(channels));
  history.values_ = values_;
  return history;
}

void History::truncate_after(double time) {
  std::size_t rows = size();
  while (rows > 0 && values_[(rows - 1) * channels_.size()] > time) --rows;
  values_.resize(rows * channels_.size());
}

}  // namespace furrow
