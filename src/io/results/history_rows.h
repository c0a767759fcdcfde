// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The rows of a results file, /history of history_file.h, as they lie on the disk.

#include <string>

#include "furrow/statistics/history.h"

namespace furrow {

class Hdf5File;

/// Name of the dataset of a channel: "/history/<name>".
std::string dataset_of(const Channel& channel);
/// @throws Error where there are none, columns differ in length, or time does not run forwards
History read_rows(const Hdf5File& file);

}  // namespace furrow
