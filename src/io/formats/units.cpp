// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/units.h"

#include <utility>

#include "furrow/io/formats/input_text.h"

namespace furrow {

namespace {

constexpr Unit units[] = {{"pa", "Pa", 1.0},
                          {"kpa", "Pa", 1e3},
                          {"mpa", "Pa", 1e6},
                          {"gpa", "Pa", 1e9},
                          {"hpa", "Pa", 100.0},
                          {"bar", "Pa", 1e5},
                          {"psi", "Pa", 6894.757},
                          {"n/m2", "Pa", 1.0},
                          {"kn/m2", "Pa", 1e3},
                          {"mn/m2", "Pa", 1e6},
                          {"n/mm2", "Pa", 1e6},
                          {"kg/cm2", "Pa", 98066.5},
                          {"kgf/cm2", "Pa", 98066.5},
                          {"ksf", "Pa", 47880.26},
                          {"psf", "Pa", 47.88026},
                          {"%", "", 0.01},
                          {"percent", "", 0.01},
                          {"pct", "", 0.01},
                          {"1", "", 1.0},
                          {"ratio", "", 1.0},
                          {"m/m", "", 1.0},
                          {"mm/mm", "", 1.0},
                          {"m", "m", 1.0},
                          {"cm", "m", 1e-2},
                          {"mm", "m", 1e-3},
                          {"um", "m", 1e-6},
                          {"in", "m", 0.0254},
                          {"inch", "m", 0.0254},
                          {"ft", "m", 0.3048},
                          {"n", "N", 1.0},
                          {"kn", "N", 1e3},
                          {"lbf", "N", 4.448222},
                          {"kg/m3", "kg/m3", 1.0},
                          {"kgm3", "kg/m3", 1.0},
                          {"kgm-3", "kg/m3", 1.0},
                          {"g/cm3", "kg/m3", 1e3},
                          {"g/cc", "kg/m3", 1e3},
                          {"mg/m3", "kg/m3", 1e3},
                          {"t/m3", "kg/m3", 1e3},
                          {"pcf", "kg/m3", 16.018463},
                          {"deg", "degree", 1.0},
                          {"degree", "degree", 1.0},
                          {"degrees", "degree", 1.0},
                          {"rad", "degree", 57.29578},
                          {"s", "s", 1.0},
                          {"min", "s", 60.0},
                          {"nm", "N m", 1.0},
                          {"knm", "N m", 1e3},
                          {"n/m(n+1)", "N/m^(n+1)", 1.0},
                          {"kn/m(n+1)", "N/m^(n+1)", 1e3},
                          {"mn/m(n+1)", "N/m^(n+1)", 1e6},
                          {"n/m(n+2)", "N/m^(n+2)", 1.0},
                          {"kn/m(n+2)", "N/m^(n+2)", 1e3},
                          {"mn/m(n+2)", "N/m^(n+2)", 1e6},
                          {"pa/m", "Pa/m", 1.0},
                          {"kpa/m", "Pa/m", 1e3},
                          {"mpa/m", "Pa/m", 1e6},
                          {"m/s2", "m/s^2", 1.0}};

}  // namespace

const Unit* find_unit(const std::string& text) {
  std::string name = lower_case(text);
  for (const auto& [from, to] : {std::pair<const char*, const char*>{"\xC2\xB2", "2"},
                                 {"\xC2\xB3", "3"},
                                 {"\xC2\xB5", "u"},
                                 {"\xC2\xB0", "deg"},
                                 {" per ", "/"},
                                 {"^", ""},
                                 {" ", ""},
                                 {"*", ""},
                                 {"\xC2\xB7", ""}})
    for (std::size_t at; (at = name.find(from)) != std::string::npos;)
      name.replace(at, std::string(from).size(), to);
  for (const Unit& unit : units)
    if (name == unit.name) return &unit;
  return nullptr;
}

std::string units_of(const std::string& si) {
  std::string text;
  for (const Unit& unit : units)
    if (unit.si == si) text += (text.empty() ? "" : ", ") + std::string(unit.name);
  return text.empty() ? "no unit" : text;
}

}  // namespace furrow
