// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/bed_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "atom.h"
#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "coupling/terrain/bed/bed_limits.h"
#include "domain.h"
#include "group.h"
#include "input.h"
#include "furrow/io/formats/heightmap_file.h"

namespace furrow::coupling {

namespace {

constexpr char surplus[] = "furrow_surplus";
constexpr int per_diameter = 16;  // samples that resolve heights finer than a grain
constexpr int maximum_rows = 16;  // largest number of rows of these samples
constexpr double maximum_fine =
    0.1;  // largest rms of heights finer than a grain, over that of the relief
constexpr double minimum_height = 1;  // of a relief, in diameters

double length_of(const Options& options, const char* name) {
  const auto& keys = options.keys();
  const auto key =
      std::find_if(keys.begin(), keys.end(), [&](const Key& each) { return each.name == name; });
  if (key == keys.end() || key->kind != Key::Kind::number || key->unit != "m")
    throw InputError(fmt::format("command bed: script '{}'", options.text("script")),
                     fmt::format("declares no '{}' in m, and the line has a relief", name),
                     "length, width and diameter in its section '#: parameters'",
                     "remove the keywords of the relief, or declare it");
  return options.number(name);
}

/// The squares of heights and of what an average over one diameter takes from them.
struct Squares {
  double fine = 0.0, all = 0.0, sum = 0.0, count = 0.0;

  void add(const std::vector<double>& row) {
    const int half = per_diameter / 2, last = static_cast<int>(row.size()) - half;
    for (int n = half; n < last; ++n) {
      const auto at = [&](int k) { return row[static_cast<std::size_t>(n + k)]; };
      double around = 0.5 * (at(-half) + at(half));
      for (int k = 1 - half; k < half; ++k) around += at(k);
      fine += std::pow(at(0) - around / per_diameter, 2);
      all += std::pow(at(0), 2);
      sum += at(0);
      count += 1.0;
    }
  }
  double mean_fine() const { return fine / std::max(count, 1.0); }
  double variance() const {
    return (all - sum * sum / std::max(count, 1.0)) / std::max(count, 1.0);
  }
};

}  // namespace

BedSurface::BedSurface(const Options& options, const std::string& folder)
    : relief_(read_relief(options, folder)), depth_(options.number("depth")) {
  lowest_ = highest_ = mean_ = depth_;
  if (flat()) return;
  half_ = {0.5 * length_of(options, "length"), 0.5 * length_of(options, "width")};
  diameter_ = length_of(options, "diameter");
  measure(options.where("depth"));
}

double BedSurface::height(double x, double y) const {
  if (flat()) return depth_;
  return depth_ +
         relief_.height(std::clamp(x, -half_.x(), half_.x()), std::clamp(y, -half_.y(), half_.y()));
}

/// Measures heights on a grid of quarter grains that has the ends of the bed.
void BedSurface::measure(const std::string& where) {
  const auto count = [&](double half) {
    return static_cast<int>(std::ceil(8.0 * half / diameter_));
  };
  const int columns = count(half_.x()), rows = count(half_.y());
  lowest_ = std::numeric_limits<double>::infinity();
  highest_ = -lowest_;
  double sum = 0.0;
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) {
      const double z =
          height(half_.x() * (2.0 * i / columns - 1.0), half_.y() * (2.0 * j / rows - 1.0));
      lowest_ = std::min(lowest_, z);
      highest_ = std::max(highest_, z);
      sum += z;
    }
  mean_ = sum / ((columns + 1.0) * (rows + 1.0));
  const double least = minimum_size * diameter_;
  need(lowest_ >= least, where,
       fmt::format("is {:.4g} m, and the relief goes down {:.4g} m from it", depth_,
                   depth_ - lowest_),
       fmt::format("at least {:g} grains of diameter {:.4g} m below the relief: {:.4g} m",
                   minimum_size, diameter_, depth_ - lowest_ + least),
       "make the bed deeper or the relief lower");
}

/// Share of the rms height that an average over one grain takes away.
double BedSurface::fine_share() const {
  const double step = diameter_ / per_diameter;
  const auto count = [&](double half) { return static_cast<int>(2.0 * half / step) + 1; };
  Squares of_axis[2];
  for (int axis = 0; axis < 2; ++axis) {
    const double along = half_[axis], across = half_[1 - axis];
    for (int r = 0; r < maximum_rows; ++r) {
      const double other = across * ((2.0 * r + 1.0) / maximum_rows - 1.0);
      std::vector<double> row;
      for (int n = 0; n < count(along); ++n) {
        const double place = n * step - along;
        row.push_back((axis == 0 ? height(place, other) : height(other, place)) - depth_);
      }
      of_axis[axis].add(row);
    }
  }
  const double variance = of_axis[0].variance();
  return variance > 0.0 ? std::sqrt((of_axis[0].mean_fine() + of_axis[1].mean_fine()) / variance)
                        : 0.0;
}

std::vector<std::string> BedSurface::warnings() const {
  std::vector<std::string> found;
  if (flat()) return found;
  if (const double height = highest_ - lowest_; height < minimum_height * diameter_)
    found.push_back(fmt::format(
        "command bed: the relief is {:.4g} m high, {:.2g} grains (recommended: at least {:g}); "
        "use smaller grains",
        height, height / diameter_, minimum_height));
  if (const double share = fine_share(); share > maximum_fine)
    found.push_back(fmt::format(
        "command bed: {:.0f} % of the relief's rms height is finer than a grain of {:.4g} m "
        "(recommended: at most {:.0f} %); use smaller grains or a smoother relief",
        100.0 * share, diameter_, 100.0 * maximum_fine));
  return found;
}

void BedSurface::check_period(const LAMMPS_NS::LAMMPS& lammps) const {
  if (flat()) return;
  const int periodic[2] = {lammps.domain->xperiodic, lammps.domain->yperiodic};
  for (int axis = 0; axis < 2; ++axis) {
    if (!periodic[axis]) continue;
    double step = 0.0;
    for (int r = 0; r <= maximum_rows; ++r) {
      const double other = half_[1 - axis] * (2.0 * r / maximum_rows - 1.0), end = half_[axis];
      step = std::max(step, std::abs(axis == 0 ? height(end, other) - height(-end, other)
                                               : height(other, end) - height(other, -end)));
    }
    need(step <= diameter_, "command bed",
         fmt::format("closes on itself along {}, where its relief has a step of {:.4g} m",
                     axis == 0 ? 'x' : 'y', step),
         fmt::format("the same height at both ends, within a grain of {:.4g} m", diameter_),
         "take a length of whole waves, or a bed with walls");
  }
}

std::string BedSurface::settled_warning(double rms) const {
  if (flat() || rms <= diameter_) return "";
  return fmt::format(
      "command bed: the tops of the grains differ from the relief by {:.4g} m rms, {:.2g} grains "
      "(recommended: at most 1); steep parts have slumped, or the bed was poured too low",
      rms, rms / diameter_);
}

/// Removes grains by LIGGGHTS's command, which numbers the other grains again.
void remove_surplus(LAMMPS_NS::LAMMPS& lammps, const BedSurface& surface) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  std::vector<int> above;
  for (int i = 0; i < atom.nlocal; ++i)
    above.push_back(atom.x[i][2] >= surface.height(atom.x[i][0], atom.x[i][1]));
  lammps.group->create(surplus, above.data());
  lammps.input->one(fmt::format("delete_atoms group {}", surplus).c_str());
  lammps.input->one(fmt::format("group {} delete", surplus).c_str());
}

}  // namespace furrow::coupling
