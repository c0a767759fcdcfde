// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace furrow {

/// What was printed is out. @throws Error when it is not, such as on a full disk
void end_output();

}  // namespace furrow
