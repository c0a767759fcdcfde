// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Folder for results that can be computed again, under names that follow from their input of.

#include <filesystem>
#include <string>

namespace furrow {

/// FURROW_CACHE if set, else the user's cache folder ($XDG_CACHE_HOME/furrow or ~/.cache/furrow).
/// It need not exist.
std::filesystem::path cache_folder();

/// 16 hexadecimal digits for a text: FNV-1a (Fowler, Noll, Vo), 64 bits. A name, not a safeguard.
std::string content_hash(const std::string& text);

}  // namespace furrow
