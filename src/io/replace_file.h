// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files that are complete at every instant: written beside, then renamed.

#include <functional>
#include <string>

namespace furrow {

/// Calls write(part) for a file beside, "a.part.vtp" for "a.vtp", and then gives that file the name
/// path in one step, so that whoever reads path, at any moment and after any kill, finds the old
/// content or the new one. (Not against a power failure: nothing is forced to the disk.)
/// @throws Error when the rename fails; what write throws passes through, with the half-written
/// file removed
void replace_file(const std::string& path,
                  const std::function<void(const std::string& part)>& write);

/// A text file written that way. @throws Error naming the path
void write_text_file(const std::string& path, const std::string& text);
/// @throws Error naming the path
std::string read_text_file(const std::string& path);

}  // namespace furrow
