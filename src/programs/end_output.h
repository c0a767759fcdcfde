// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace furrow {

/// Flushes the output. @throws Error when it cannot be written, such as on a full disk
void end_output();

}  // namespace furrow
