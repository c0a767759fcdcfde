// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A table of recorded quantities against time: rows of the rig, as files store them.

#include <cstddef>
#include <string>
#include <vector>

#include "core/outputs.h"

namespace furrow {

/// Rows of equal length, one column for each channel; the first channel is the time [s].
class History {
 public:
  History() = default;
  explicit History(std::vector<Channel> channels);

  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t size() const { return channels_.empty() ? 0 : values_.size() / channels_.size(); }
  /// @throws Error when the length differs from channels()
  void append(const std::vector<double>& row);
  double at(std::size_t row, std::size_t channel) const;
  /// @throws Error for an unknown channel
  std::vector<double> column(const std::string& name) const;
  bool has(const std::string& name) const;
  /// @throws Error for an unknown channel
  std::size_t index(const std::string& name) const;
  /// The same rows under other channels. @throws Error when their number differs
  History renamed(std::vector<Channel> channels) const;
  /// Drops every row later than time (a restart continues from there).
  void truncate_after(double time);

 private:
  std::vector<Channel> channels_;
  std::vector<double> values_;  // row after row
};

}  // namespace furrow
