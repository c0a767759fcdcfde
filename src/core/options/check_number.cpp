// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/options/check_number.h"

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

void check_number(double value, const Range& range, const std::string& where,
                  const std::string& unit) {
  if (range.contains(value)) return;
  Key key;
  key.kind = Key::Kind::number;
  key.unit = unit;
  key.range = range;
  throw InputError(where, fmt::format("is {}", value), key.allowed());
}

void check_integer(long value, const Range& range, const std::string& where) {
  if (range.contains(static_cast<double>(value))) return;
  Key key;
  key.kind = Key::Kind::integer;
  key.range = range;
  throw InputError(where, fmt::format("is {}", value), key.allowed());
}

void need(bool fulfilled, const std::string& where, const std::string& problem,
          const std::string& allowed, const std::string& remedy) {
  if (!fulfilled) throw InputError(where, problem, allowed, remedy);
}

}  // namespace furrow
