// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A table of recorded quantities against time: rows of the rig, as files store them.

#include <cstddef>
#include <string>
#include <vector>

#include "furrow/core/options/outputs.h"

namespace furrow {

/// Rows of equal length, one column for each channel; the first channel is the time [s].
class History {
 public:
  History() = default;
  explicit History(std::vector<Channel> channels);
  /// @param columns  of equal length, one for each channel
  History(std::vector<Channel> channels, std::vector<std::vector<double>> columns);

  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t size() const { return columns_.empty() ? 0 : columns_.front().size(); }
  /// @throws Error when the length differs from channels()
  void append(const std::vector<double>& row);
  double at(std::size_t row, std::size_t channel) const;
  /// @throws Error for an unknown channel
  const std::vector<double>& column(const std::string& name) const;
  bool has(const std::string& name) const;
  /// @throws Error for an unknown channel
  std::size_t index(const std::string& name) const;
  /// A channel of the old name gets the new one.
  void rename(const std::string& old_name, const std::string& new_name);
  /// Drops every row.
  void clear();
  /// Drops every row later than time (a restart continues from there).
  void truncate_after(double time);

 private:
  std::vector<Channel> channels_;
  std::vector<std::vector<double>> columns_;  // one for each channel
};

}  // namespace furrow
