// SPDX-License-Identifier: GPL-2.0-or-later
/// The numbers of src/material/snow.md, which compares three laws for snow: each is computed by the
/// file of inputs/points that its row names.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/core/error.h"
#include "furrow/io/inputs/point_file.h"
#include "furrow/material/point/point_driver.h"

namespace furrow::snow_page_test {
namespace {

const std::string root = FURROW_SOURCE_DIR;
const std::vector<std::string> presets = {"fresh_snow", "variants/fresh_snow_foam_oedometer",
                                          "fresh_snow_cam_clay"};

/// The cells of the page's table rows, by the first cell.
std::map<std::string, std::vector<std::string>> page_rows() {
  std::ifstream page(root + "/src/material/snow.md");
  std::map<std::string, std::vector<std::string>> rows;
  for (std::string line; std::getline(page, line);) {
    if (line.empty() || line.front() != '|') continue;
    std::vector<std::string> cells;
    std::istringstream text(line.substr(1));
    for (std::string cell; std::getline(text, cell, '|');) {
      cell.erase(0, cell.find_first_not_of(' '));
      cell.erase(cell.find_last_not_of(' ') + 1);
      cells.push_back(cell);
    }
    if (!cells.empty()) rows[cells.front()] = cells;
  }
  return rows;
}

/// The history of one test of inputs/points, by segments: the last record of each, and all.
struct Driven {
  std::unique_ptr<Material> material;
  PointHistory history;

  const PointRecord& end(int segment) const {
    return *std::find_if(history.records.rbegin(), history.records.rend(),
                         [&](const PointRecord& record) { return record.segment == segment; });
  }
  double density(int segment) const { return material->current_density(end(segment).state); }
};

Driven drive(const std::string& file, const std::string& preset,
             const std::function<void(PointPath&)>& change = nullptr) {
  PointPath path = read_point_run(root + "/inputs/points/" + file + ".yaml").path;
  if (change) change(path);
  auto material = load_material(root + "/inputs/materials/" + preset + ".yaml");
  PointHistory history = drive_point(*material, path);
  return {std::move(material), std::move(history)};
}

using Value = std::function<double(const Driven&)>;

/// q of the yield surface at p = 0 [Pa].
double shear_strength_without_pressure(const Driven& run, int segment) {
  const std::vector<Vector2> line = run.material->yield_surface(run.end(segment).state, 100000);
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i].x() >= 0.0)
      return line[i - 1].y() -
             line[i - 1].x() * (line[i].y() - line[i - 1].y()) / (line[i].x() - line[i - 1].x());
  return std::numeric_limits<double>::quiet_NaN();
}

struct Row {
  std::string label;
  int decimals;
  std::string file;
  Value value;
  std::function<void(PointPath&)> change = nullptr;  ///< of the file's path
};

std::vector<Row> rows() {
  std::vector<Row> list;
  const std::vector<double> stresses = {1e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6, 2e6, 2.8e6};
  const auto segment_of = [&](double stress) {
    return static_cast<int>(std::find(stresses.begin(), stresses.end(), stress) -
                            stresses.begin()) +
           1;
  };
  for (const double stress : {1e4, 5e4, 1e5, 2e5, 5e5, 1e6}) {
    const int segment = segment_of(stress);
    list.push_back({fmt::format("density under {:.0f} kPa", stress / 1e3), 0, "snow_oedometer",
                    [=](const Driven& run) {
                      EXPECT_NEAR(-run.end(segment).state[2], stress, 1e-6 * stress);
                      return run.density(segment);
                    }});
  }
  for (const double stress : {1e4, 1e5, 1e6}) {
    const int segment = segment_of(stress);
    list.push_back(
        {fmt::format("K0 under {:.0f} kPa", stress / 1e3), 2, "snow_oedometer",
         [=](const Driven& run) { return run.end(segment).state[0] / run.end(segment).state[2]; }});
  }
  for (const int segment : {2, 3}) {
    const std::string at = segment == 2 ? "0.1" : "0.4";
    list.push_back({"free sides, strain " + at + ": lateral over axial strain", 2,
                    "snow_free_sides", [=](const Driven& run) {
                      return -run.end(segment).strain[0] / run.end(segment).strain[2];
                    }});
    list.push_back({"free sides, strain " + at + ": density", 0, "snow_free_sides",
                    [=](const Driven& run) { return run.density(segment); }});
    list.push_back({"free sides, strain " + at + ": axial stress, kPa", 1, "snow_free_sides",
                    [=](const Driven& run) { return -run.end(segment).state[2] / 1e3; }});
  }
  list.push_back({"shear stress at shear 0.5 under 40 kPa, kPa", 0, "snow_rut",
                  [](const Driven& run) { return run.end(2).state[5] / 1e3; }});
  list.push_back(
      {"density there", 0, "snow_rut", [](const Driven& run) { return run.density(2); }});
  for (const double stress : {1e4, 5e4, 1e5, 5e5}) {
    const auto press = [=](PointPath& path) { path.segments.front().target[2] = -stress; };
    const std::string by = fmt::format("{:.0f} kPa", stress / 1e3);
    list.push_back({"pressed by " + by + ": tensile strength, kPa", 1, "snow_pressed_pulled",
                    [](const Driven& run) {
                      double largest = 0.0;
                      for (const PointRecord& record : run.history.records)
                        if (record.segment == 3) largest = std::max(largest, record.state[2]);
                      return largest / 1e3;
                    },
                    press});
    list.push_back({"pressed by " + by + ": q at p = 0, kPa", 1, "snow_pressed_pulled",
                    [](const Driven& run) { return shear_strength_without_pressure(run, 2) / 1e3; },
                    press});
  }
  return list;
}

/// A dash stands where the driver finds no state.
TEST(SnowPage, PageHasTheNumbersOfThePointRuns) {
  const auto page = page_rows();
  for (const Row& row : rows()) {
    std::string right = "| " + row.label + " | ...";
    bool same = page.count(row.label) == 1 && page.at(row.label).size() == 2 + presets.size();
    for (std::size_t law = 0; law < presets.size(); ++law) {
      std::string value = "-";
      double number = 0.0;
      try {
        number = row.value(drive(row.file, presets[law], row.change));
        value = fmt::format("{:.{}f}", number, row.decimals);
      } catch (const StateError&) {
      }
      right += " | " + value;
      if (!same) continue;
      const std::string& cell = page.at(row.label)[2 + law];
      if (value == "-" || cell == "-") {
        same = value == cell;
      } else {
        same = std::abs(std::stod(cell) - number) <= 0.501 * std::pow(10.0, -row.decimals);
      }
    }
    EXPECT_TRUE(same) << "the page must have, with what was measured in place of the dots:\n"
                      << right << " |";
  }
}

/// K0 over M for beta = 0.1, by the formula of the page, which
/// tests/verification/material/cohesive_cam_clay_test.cpp compares with the law.
TEST(SnowPage, TableOfK0FollowsTheFormula) {
  const auto page = page_rows();
  const std::vector<std::string>&slopes = page.at("M, beta = 0.1"), &ratios = page.at("K0");
  ASSERT_EQ(slopes.size(), ratios.size());
  for (std::size_t k = 1; k < slopes.size(); ++k) {
    const double M = std::stod(slopes[k]), B = M / std::sqrt(1.2), S = std::sqrt(9 + 4 * B * B);
    const double K0 = (0.9 * S + 1.1 * (3 - 2 * B * B / 3)) / (0.9 * S + 1.1 * (3 + 4 * B * B / 3));
    EXPECT_NEAR(std::stod(ratios[k]), K0, 0.00501) << "M " << M;
  }
}

}  // namespace
}  // namespace furrow::snow_page_test
