// SPDX-License-Identifier: GPL-2.0-or-later
// The pages beside the code say what the code declares: every keyword of a style has its row, with
// unit and default, and no row describes a keyword that is gone.

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "coupling/contact/fix_contact_plane.h"
#include "coupling/contact/fix_contact_continuum.h"
#include "coupling/terrain/fix_bed_window.h"
#include "coupling/laboratory/fix_cell_servo.h"
#include "coupling/laboratory/fix_layer_shear.h"
#include "coupling/bodies/fix_mesh_body.h"
#include "coupling/bodies/fix_plate_rigid.h"
#include "coupling/output/fix_progress.h"
#include "coupling/terrain/fix_terrain_continuum.h"
#include "coupling/output/fix_terrain_history.h"
#include "coupling/bodies/fix_tyre_darnell.h"
#include "coupling/output/fix_wheel_history.h"
#include "coupling/drive/fix_wheel_rig.h"
#include "coupling/bodies/fix_wheel_rigid.h"

namespace furrow::test {
namespace {

struct Row {
  std::string unit, default_value, meaning;
};

std::string trimmed(const std::string& text, const std::string& blank = " ") {
  const std::size_t first = text.find_first_not_of(blank), last = text.find_last_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Cells of "| a | b |"; an escaped bar is text.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '|' && line[i - 1] != '\\') {
      result.emplace_back();
    } else {
      result.back() += line[i];
    }
  }
  for (std::string& cell : result) cell = trimmed(cell);
  return result;
}

/// A page of coupling/, in whichever folder it lies.
std::string path_of(const std::string& page) {
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(FURROW_SOURCE_DIR "/coupling"))
    if (entry.path().filename() == page) return entry.path().string();
  return page;
}

/// The table that begins with "| keyword |".
std::map<std::string, Row> keyword_table(const std::string& page) {
  std::ifstream file(path_of(page));
  EXPECT_TRUE(file.is_open()) << page;
  std::map<std::string, Row> rows;
  std::string line;
  while (std::getline(file, line) && line.rfind("| keyword |", 0) != 0) {
  }
  std::getline(file, line);  // the rule below the head
  while (std::getline(file, line) && !line.empty() && line[0] == '|') {
    const std::vector<std::string> row = cells(line);
    EXPECT_GE(row.size(), 4u) << page << ": " << line;
    if (row.size() >= 4) rows[trimmed(row[0], "`")] = {row[1], trimmed(row[2], "`"), row[3]};
  }
  return rows;
}

void expect_page_of(const std::string& page, const Schema& schema) {
  std::map<std::string, Row> rows = keyword_table(page);
  for (const Key& key : schema.keys()) {
    ASSERT_TRUE(rows.count(key.name)) << page << " has no row for " << key.name;
    const Row& row = rows[key.name];
    EXPECT_EQ(row.unit, key.unit) << page << ", " << key.name;
    EXPECT_EQ(row.default_value, fmt::format("{}", fmt::join(key.default_values, " ")))
        << page << ", " << key.name;
    EXPECT_FALSE(row.meaning.empty()) << page << ", " << key.name;
    for (const std::string& word : key.choices)
      EXPECT_NE(row.meaning.find('`' + word + '`'), std::string::npos) << page << ", " << word;
    rows.erase(key.name);
  }
  for (const auto& [name, row] : rows)
    ADD_FAILURE() << page << " describes " << name << ", which " << schema.subject()
                  << " does not have";
}

using namespace coupling;

TEST(Pages, WheelRigid) { expect_page_of("fix_wheel_rigid.md", FixWheelRigid::schema()); }
TEST(Pages, TyreDarnell) { expect_page_of("fix_tyre_darnell.md", FixTyreDarnell::schema()); }
TEST(Pages, ContactPlane) { expect_page_of("fix_contact_plane.md", FixContactPlane::schema()); }
TEST(Pages, WheelRig) { expect_page_of("fix_wheel_rig.md", FixWheelRig::schema()); }
TEST(Pages, WheelHistory) { expect_page_of("fix_wheel_history.md", FixWheelHistory::schema()); }
TEST(Pages, PlateRigid) { expect_page_of("fix_plate_rigid.md", FixPlateRigid::schema()); }
TEST(Pages, MeshBody) { expect_page_of("fix_mesh_body.md", FixMeshBody::schema()); }
TEST(Pages, TerrainContinuum) {
  expect_page_of("fix_terrain_continuum.md", FixTerrainContinuum::schema());
}
TEST(Pages, TerrainHistory) {
  expect_page_of("fix_terrain_history.md", FixTerrainHistory::schema());
}
TEST(Pages, ContactBodies) {
  expect_page_of("fix_contact_continuum.md", FixContactBodies::schema());
}
TEST(Pages, CellServo) { expect_page_of("fix_cell_servo.md", FixCellServo::schema()); }
TEST(Pages, LayerShear) { expect_page_of("fix_layer_shear.md", FixLayerShear::schema()); }
TEST(Pages, BedWindow) { expect_page_of("fix_bed_window.md", FixBedWindow::schema()); }
TEST(Pages, Progress) { expect_page_of("fix_progress.md", FixProgress::schema()); }

TEST(Pages, HistoryNamesEveryChannel) {
  std::ifstream file(path_of("fix_wheel_history.md"));
  std::stringstream text;
  text << file.rdbuf();
  for (const Channel& channel : WheelRig::channels())
    EXPECT_NE(text.str().find(channel.name), std::string::npos) << "no channel " << channel.name;
}

}  // namespace
}  // namespace furrow::test
