// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files that are complete at every instant: written under another name, then renamed.

#include <functional>
#include <string>

namespace furrow {

/// Calls write(part) for a new file next to it, "a.part.vtp" for "a.vtp", in the place of a file or
/// link of that name, and then renames it to path in one step. A reader of path finds the old or
/// the new content, also after a kill. (Not after a power failure: nothing is forced to the disk.)
/// @throws Error when the rename fails; what write throws passes through, with the half-written
/// file removed
void replace_file(const std::string& path,
                  const std::function<void(const std::string& part)>& write);

/// A text file written that way. @throws Error naming the path
void write_text_file(const std::string& path, const std::string& text);
/// @throws Error naming the path
std::string read_text_file(const std::string& path);

}  // namespace furrow
