// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/history_rows.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "furrow/core/error.h"
#include "furrow/io/formats/hdf5_file.h"

namespace furrow {

namespace {

/// @throws Error where a row is not later [s] than the row above
void check_time(const std::string& path, const std::vector<double>& time) {
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1]))
      throw Error(
          fmt::format("{}: time does not run forwards: row {} of the history is at {} s, after {} "
                      "s; two runs wrote into one folder, or the file is damaged: repeat the run, "
                      "into a separate folder",
                      path, i + 1, time[i], time[i - 1]));
}

}  // namespace

std::string dataset_of(const Channel& channel) { return "/history/" + channel.name; }

History read_rows(const Hdf5File& file) {
  if (!file.exists("/history"))
    throw Error(fmt::format("{}: has no /history; is it a results file of Furrow?", file.path()));
  std::vector<Channel> channels;
  std::vector<std::vector<double>> columns;
  for (const std::string& name : file.members("/history")) {
    const std::string dataset = "/history/" + name;
    channels.push_back(
        {name, file.text_attribute(dataset, "unit"), file.text_attribute(dataset, "meaning")});
    columns.push_back(file.read_numbers(dataset));
    if (columns.back().size() != columns.front().size())
      throw Error(fmt::format("{}: {} has {} rows, {} has {}", file.path(), dataset,
                              columns.back().size(), dataset_of(channels.front()),
                              columns.front().size()));
  }
  if (!columns.empty()) check_time(file.path(), columns.front());
  return History(std::move(channels), std::move(columns));
}

}  // namespace furrow
