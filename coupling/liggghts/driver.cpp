// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/driver.h"

namespace furrow::coupling {

namespace {

Driver* current_driver = nullptr;

}  // namespace

Driver* driver() { return current_driver; }
void set_driver(Driver* driver) { current_driver = driver; }

}  // namespace furrow::coupling
