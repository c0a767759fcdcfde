// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The version of Furrow that wrote a file.

#include <string>

namespace furrow {

std::string version();  ///< "0.1.0", as the build declares it

}  // namespace furrow
