// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/version.h"

namespace furrow {

std::string version() { return FURROW_VERSION; }  // defined by src/CMakeLists.txt

}  // namespace furrow
