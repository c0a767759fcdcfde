// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Folder for results that can be computed again, under names that follow from their input.

#include <filesystem>
#include <string>

namespace furrow {

/// FURROW_CACHE if set, else the user's cache folder ($XDG_CACHE_HOME/furrow or ~/.cache/furrow).
/// It need not exist.
std::filesystem::path cache_folder();

/// Reason why a file or folder of the cache must not be used: a link, another user's, or one that
/// all users may write. Empty for one that may, or is not there. Root's files may be used.
std::string distrust(const std::filesystem::path& path);

/// Name of 16 hexadecimal digits for a text: FNV-1a (Fowler, Noll, Vo), 64 bits. No safeguard.
std::string content_hash(const std::string& text);

}  // namespace furrow
