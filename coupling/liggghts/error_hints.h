// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What to do about errors of LIGGGHTS whose texts do not say it.

#include <string>

namespace furrow::coupling {

/// A sentence for the message of an error; empty when there is none to add.
std::string hint_for(const std::string& message);

}  // namespace furrow::coupling
