// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Remedies for errors of LIGGGHTS whose texts give none.

#include <string>

namespace furrow::coupling {

/// A sentence for the message of an error; empty when there is none to add.
std::string hint_for(const std::string& message);

}  // namespace furrow::coupling
