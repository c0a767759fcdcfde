// SPDX-License-Identifier: GPL-2.0-or-later
// For the leak sanitizer: HDF5 1.10 does not free what it has read of a damaged file before it
// refuses it.

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }
