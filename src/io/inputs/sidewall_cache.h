// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Sidewalls by the name a script or a file gives them; tables are kept from run to run.

#include <memory>
#include <string>

#include "furrow/tyre/sidewall/sidewall_table.h"

namespace furrow {

/// The words of the keyword `sidewall`: table, direct.
const std::vector<std::string>& sidewall_kinds();

/// A sidewall of a kind. A table comes from the cache folder (io/files/cache.h) if it is there, and
/// is put there if not: its name follows from the parameters, the pressure, the grid and Furrow's
/// version. Each rank of a run may call this. Without a folder to write to, or with a damaged file,
/// the table is made and nothing is kept.
/// @throws InputError for bad parameters or another kind, StateError as SidewallTable
std::unique_ptr<Sidewall> open_sidewall(const std::string& kind,
                                        const SidewallParameters& parameters, double pressure,
                                        const SidewallTableGrid& grid = {});
std::unique_ptr<SidewallTable> open_sidewall_table(const SidewallParameters& parameters,
                                                   double pressure,
                                                   const SidewallTableGrid& grid = {});

}  // namespace furrow
