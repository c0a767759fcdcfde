// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/statistics/resistance_parts.h"

#include <cmath>
#include <functional>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// Rounding between two sums of the same work on a continuum, over the work
constexpr double same_work = 1e-6;
// Difference of the power at instants from works step by step, over the work on grains
constexpr double same_grain_work = 0.01;

using Channels = std::vector<std::string>;

/// A part and the channels [J] whose change over the window it is.
struct Part {
  const char* name;
  Channels channels;
};

/// Parts that a continuum takes from all bodies that press on it.
const std::vector<Part>& parts_of_continuum() {
  static const std::vector<Part> list = {{"compaction", {"compaction_work"}},
                                         {"bulldozing", {"bulldozing_work"}},
                                         {"inertia of the ground", {"ground_kinetic_energy"}},
                                         {"radiation", {"radiated_work"}},
                                         {"grid", {"grid_loss"}}};
  return list;
}

/// Parts that grains take, by the way in which a wheel gives them.
const std::vector<Part>& given_to_grains() {
  static const std::vector<Part> list = {{"grains, pressed down", {"grain_press_work"}},
                                         {"grains, pushed along", {"grain_push_work"}}};
  return list;
}

/// Parts that grains take from all bodies that press on them, by place: compaction, bulldozing with
/// lifting, and the rest.
const std::vector<Part>& places_of_grains() {
  static const std::vector<Part> list = {
      {"grains, below the track", {"grains_below_work"}},
      {"grains, ahead and aside", {"grains_ahead_work", "grains_aside_work", "grains_lifted_work"}},
      {"grains, walls of the bed", {"grains_walls_work"}},
      {"grains, their motion", {"grains_kinetic_energy"}}};
  return list;
}

/// Parts that belong to one wheel.
const std::vector<Part>& parts_of_wheel() {
  static const std::vector<Part> list = {
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

bool has(const History& history, const Channels& channels) {
  for (const std::string& channel : channels)
    if (!history.has(channel)) return false;
  return true;
}

bool has(const History& history, const std::vector<Part>& parts) {
  for (const Part& part : parts)
    if (!has(history, part.channels)) return false;
  return true;
}

bool has_all(const History& history) {
  return has(history, parts_of_continuum()) && has(history, given_to_grains()) &&
         has(history, parts_of_wheel()) && has(history, continuum_of_wheel().channels) &&
         has(history, put_in());
}

/// Histories of programs before these channels have none.
bool has_places(const std::vector<History>& histories) {
  for (const History& history : histories)
    if (!has(history, places_of_grains())) return false;
  return true;
}

/// Change of a sum of channels over the window [J].
double change(const History& history, const Window& window, const Channels& channels) {
  double sum = 0.0;
  for (const std::string& name : channels) {
    const std::vector<double> column = history.column(name);
    sum += column[window.last - 1] - column[window.first];
  }
  return sum;
}

/// Energy that a continuum took from all bodies that press on it [J].
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

  // sum over all wheels
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
  if (is_all(sum(taken_by_continuum))) {  // each wheel has a continuum
    for (const Part& part : parts_of_continuum()) add(part.name, sum_of(part.channels));
  } else if (is_all(taken_by_continuum(
                 histories.front(),
                 windows.front()))) {  // parts of the continuum that all wheels share
    for (const Part& part : parts_of_continuum())
      add(part.name, change(histories.front(), windows.front(), part.channels));
  } else {
    add(continuum_of_wheel().name, pressed);
  }
  const auto total = [&](const std::vector<Part>& parts) {
    double taken = 0.0;
    for (const Part& part : parts) taken += sum_of(part.channels);
    return taken;
  };
  const double given = total(given_to_grains());
  const bool by_place = has_places(histories) && std::abs(total(places_of_grains()) - given) <=
                                                     same_grain_work * std::abs(given);
  for (const Part& part : by_place ? places_of_grains() : given_to_grains())
    add(part.name, sum_of(part.channels));
  if (by_place)
    for (const Part& part : given_to_grains())
      if (const double work = sum_of(part.channels); work != 0.0)
        result.given_to_grains.push_back({part.name, work / travel});
  for (const Part& part : parts_of_wheel()) add(part.name, sum_of(part.channels));
  return result;
}

}  // namespace furrow
