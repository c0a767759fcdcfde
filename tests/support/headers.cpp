// SPDX-License-Identifier: GPL-2.0-or-later
// Nothing but the precompiled headers of the tests (tests/CMakeLists.txt).
