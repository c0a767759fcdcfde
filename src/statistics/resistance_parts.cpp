// SPDX-License-Identifier: GPL-2.0-or-later
#include "statistics/resistance_parts.h"

#include <cmath>
#include <functional>

#include "core/error.h"

namespace furrow {

namespace {

// of the work on a continuum: two sums of the same work differ by rounding
constexpr double same_work = 1e-6;

using Channels = std::vector<std::string>;

/// A part and the channels [J] whose change over the window it is.
struct Part {
  const char* name;
  Channels channels;
};

/// What a continuum took, of all bodies that press on it.
const std::vector<Part>& parts_of_continuum() {
  static const std::vector<Part> list = {{"compaction", {"compaction_work"}},
                                         {"bulldozing", {"bulldozing_work"}},
                                         {"inertia of the ground", {"ground_kinetic_energy"}},
                                         {"radiation", {"radiated_work"}},
                                         {"grid", {"grid_loss"}}};
  return list;
}

/// What belongs to one wheel.
const std::vector<Part>& parts_of_wheel() {
  static const std::vector<Part> list = {
      {"grains, pressed down", {"grain_press_work"}},
      {"grains, pushed along", {"grain_push_work"}},
      {"friction of wheel and ground", {"friction_loss"}},
      {"contact springs and damping", {"contact_spring_loss", "contact_damping_loss"}},
      {"wheel or tyre", {"wheel_loss", "stored_energy"}},
      {"damping of the rig", {"damping_loss"}},
      {"inertia of the wheel", {"kinetic_energy"}},
  };
  return list;
}

const Part& continuum_of_wheel() {
  static const Part part{"continuum, shared with others", {"continuum_work"}};
  return part;
}

const Channels& put_in() {
  static const Channels channels{"drive_work", "load_work"};
  return channels;
}

bool has_all(const History& history) {
  const auto has = [&](const Channels& channels) {
    for (const std::string& channel : channels)
      if (!history.has(channel)) return false;
    return true;
  };
  for (const std::vector<Part>* list : {&parts_of_continuum(), &parts_of_wheel()})
    for (const Part& part : *list)
      if (!has(part.channels)) return false;
  return has(continuum_of_wheel().channels) && has(put_in());
}

/// [J] of a sum of channels over the window
double change(const History& history, const Window& window, const Channels& channels) {
  double sum = 0.0;
  for (const std::string& name : channels) {
    const std::vector<double> column = history.column(name);
    sum += column[window.last - 1] - column[window.first];
  }
  return sum;
}

/// [J] that a continuum took, of all bodies that press on it
double taken_by_continuum(const History& history, const Window& window) {
  double sum = 0.0;
  for (const Part& part : parts_of_continuum()) sum += change(history, window, part.channels);
  return sum;
}

}  // namespace

ResistanceParts resistance_parts(const History& history, const Window& window) {
  return resistance_parts(std::vector<History>{history}, {window});
}

ResistanceParts resistance_parts(const std::vector<History>& histories,
                                 const std::vector<Window>& windows) {
  if (histories.size() != windows.size()) throw Error("a window for each history is needed");
  ResistanceParts result;
  if (histories.empty()) return result;
  for (const History& history : histories)
    if (!has_all(history)) return result;
  const double travel = std::abs(windows.front().distance);
  if (!(travel > 0.0)) return result;

  // of all wheels
  const auto sum = [&](const std::function<double(const History&, const Window&)>& of_wheel) {
    double total = 0.0;
    for (std::size_t i = 0; i < histories.size(); ++i) total += of_wheel(histories[i], windows[i]);
    return total;
  };
  const auto sum_of = [&](const Channels& channels) {
    return sum([&](const History& history, const Window& window) {
      return change(history, window, channels);
    });
  };
  result.whole = result.unexplained = sum_of(put_in()) / travel;
  const auto add = [&](const char* name, double work) {
    if (work == 0.0) return;
    result.parts.push_back({name, work / travel});
    result.unexplained -= work / travel;
  };

  const double pressed = sum_of(continuum_of_wheel().channels);
  const auto is_all = [&](double taken) {
    return std::abs(taken - pressed) <= same_work * std::abs(pressed);
  };
  if (is_all(sum(taken_by_continuum))) {  // a continuum for each
    for (const Part& part : parts_of_continuum()) add(part.name, sum_of(part.channels));
  } else if (is_all(taken_by_continuum(histories.front(), windows.front()))) {  // one for all
    for (const Part& part : parts_of_continuum())
      add(part.name, change(histories.front(), windows.front(), part.channels));
  } else {
    add(continuum_of_wheel().name, pressed);
  }
  for (const Part& part : parts_of_wheel()) add(part.name, sum_of(part.channels));
  return result;
}

}  // namespace furrow
