// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/history_file.h"

#include <gmock/gmock.h>
#include <malloc.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <filesystem>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/mpm/terrain_snapshot.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::history_file_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<Channel> channels = {
    {"time", "s", "simulated time"},
    {"hub_drop", "m", "bed level minus lowest point of the wheel"},
    {"force_x", "N", "force of the ground on the wheel along x"}};

std::vector<double> row(int i) { return {0.001 * i, 0.01 * std::sin(0.1 * i), -5.0 + 0.25 * i}; }

void append_rows(HistoryFile& file, int from, int to) {
  for (int i = from; i < to; ++i) file.append(row(i));
}

void expect_rows(const History& history, int count) {
  ASSERT_EQ(history.size(), std::size_t(count));
  for (int i = 0; i < count; ++i)
    for (std::size_t j = 0; j < channels.size(); ++j)
      EXPECT_EQ(history.at(std::size_t(i), j), row(i)[j]);
}

class HistoryFiles : public ::testing::Test {
  const Scratch scratch_;

 protected:
  const std::string path = scratch_.path("history.h5");

  void write_rows(int count) {
    HistoryFile file = HistoryFile::create(path, channels, {});
    append_rows(file, 0, count);
  }
};

TEST_F(HistoryFiles, RowsChannelsAndRunAreReadBack) {
  const Scratch scratch;
  RunInfo info;
  info.title = "rigid wheel on sand";
  info.script = "wheel.liggghts";
  info.effective_input = "fix wheel all wheel/rigid\n  mass 636\n";
  info.ranks = 2;
  const std::string path = scratch.path("history.h5");
  {
    HistoryFile file = HistoryFile::create(path, channels, info);
    append_rows(file, 0, 2500);  // more than two chunks
  }
  const History history = read_history(path);
  expect_rows(history, 2500);
  ASSERT_EQ(history.channels().size(), 3u);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(history.channels()[j].name, channels[j].name);
    EXPECT_EQ(history.channels()[j].unit, channels[j].unit);
    EXPECT_EQ(history.channels()[j].meaning, channels[j].meaning);
  }
  const RunInfo back = read_run_info(path);
  EXPECT_EQ(back.title, info.title);
  EXPECT_EQ(back.version, version());
  EXPECT_EQ(back.script, info.script);
  EXPECT_EQ(back.effective_input, info.effective_input);
  EXPECT_EQ(back.ranks, 2);
  EXPECT_THAT(back.started,
              ::testing::MatchesRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z"));
}

TEST_F(HistoryFiles, StylesAreKeptAsText) {
  RunInfo info;
  info.styles = {{"wheel", "all", "wheel/rigid", "wheel", {{"mass", {636.0}}}}};
  HistoryFile::create(path, channels, info);
  EXPECT_EQ(Hdf5File(path, Hdf5File::Mode::read).read_text("/run/styles"),
            styles_json(info.styles));
}

/// A file of an earlier version is still evaluated, but not continued.
TEST_F(HistoryFiles, FormerNamesOfChannelsAreRead) {
  const std::vector<Channel> now = {{"time", "s", ""}, {"stage", "", ""}, {"hub_drop", "m", ""}};
  const std::vector<Channel> former = {{"time", "s", ""}, {"phase", "", ""}, {"sinkage", "m", ""}};
  {
    HistoryFile file = HistoryFile::create(path, former, {});
    file.append({0.0, 0.0, 0.01});
    file.append({1.0, 2.0, 0.02});
  }
  const History history = read_history(path);
  EXPECT_EQ(history.column("stage"), (std::vector<double>{0.0, 2.0}));
  EXPECT_EQ(history.column("hub_drop"), (std::vector<double>{0.01, 0.02}));
  EXPECT_THROW(HistoryFile::resume(path, now, 1.0), Error);
}

TEST_F(HistoryFiles, ParticlesOfTheTerrainHaveUnitsAndMeanings) {
  TerrainSnapshot snapshot;
  snapshot.x = snapshot.initial_position = snapshot.v = snapshot.principal_stress =
      snapshot.tension_axis = snapshot.compression_axis = Matrix3X::Ones(3, 2);
  snapshot.id = {0, 1};
  snapshot.layer = snapshot.volume = snapshot.density = snapshot.pressure = snapshot.mises =
      snapshot.vertical_stress = snapshot.compaction = snapshot.plastic_strain = {3.0, 4.0};
  {
    HistoryFile file = HistoryFile::create(path, channels, {});
    file.write_terrain(snapshot, {{0.5, 0.0, -0.1, 400.0}});
  }
  const Hdf5File file(path, Hdf5File::Mode::read);
  EXPECT_EQ(file.members("/terrain").size(), 15u);
  for (const std::string& field : file.members("/terrain")) {
    const std::string dataset = "/terrain/" + field;
    EXPECT_TRUE(file.has_attribute(dataset, "unit")) << field;
    EXPECT_FALSE(file.text_attribute(dataset, "meaning").empty()) << field;
  }
  EXPECT_EQ(file.read_columns("/terrain/initial_position"), snapshot.initial_position);
  EXPECT_EQ(file.read_numbers("/terrain/compaction"), snapshot.compaction);
  EXPECT_EQ(file.text_attribute("/terrain/pressure", "unit"), "Pa");
  EXPECT_EQ(file.read_numbers("/rut/density"), std::vector<double>{400.0});
}

TEST_F(HistoryFiles, KilledRunLeavesItsLastFlush) {
  const pid_t child = fork();
  if (child == 0) {
    HistoryFile file = HistoryFile::create(path, channels, {});
    append_rows(file, 0, 300);
    file.flush();
    append_rows(file, 300, 400);  // gathered only: lost
    _exit(7);                     // no destructor runs
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(WEXITSTATUS(status), 7);
  expect_rows(read_history(path), 300);
}

TEST_F(HistoryFiles, FileIsCompleteAtAnyKillOrRead) {
  HistoryFile::create(path, channels, {});
  for (int trial = 0; trial < 5; ++trial) {
    const pid_t child = fork();
    if (child == 0) {
      HistoryFile file = HistoryFile::resume(path, channels, -1.0);
      for (int i = 0;; ++i) {
        file.append(row(i));
        file.flush();  // after every row: the kill falls into one
      }
    }
    std::size_t read = 0;
    for (int look = 0; look < 20; ++look) {
      usleep(2000);
      read = read_history(path).size();
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const History history = read_history(path);
    EXPECT_GT(history.size(), 0u);
    EXPECT_GE(history.size(), read);
    expect_rows(history, int(history.size()));
  }
}

TEST_F(HistoryFiles, RestartContinuesTheRows) {
  Grains grains;
  grains.resize(1);
  {
    HistoryFile file = HistoryFile::create(path, channels, {});
    file.write_reference(grains);
    append_rows(file, 0, 2000);
    file.flush();
    file.write_final(grains, Surface());
    file.write_closing({});
  }
  {
    HistoryFile file = HistoryFile::resume(path, channels, 1.2005);  // between rows 1200 and 1201
    EXPECT_EQ(file.size(), 1201u);
    expect_rows(read_history(path), 1201);
    EXPECT_FALSE(has_closing(path));
    EXPECT_EQ(read_reference_grains(path).size(), 1u);
    EXPECT_THAT(error_of([&] { read_final_grains(path); }), HasSubstr("has no /grains/final"));
    append_rows(file, 1201, 3000);
  }
  expect_rows(read_history(path), 3000);
}

TEST_F(HistoryFiles, RowAtTheTimeOfTheCheckpointIsKept) {
  write_rows(50);
  EXPECT_EQ(HistoryFile::resume(path, channels, row(30)[0] * (1.0 - 1e-15)).size(), 31u);
  EXPECT_EQ(HistoryFile::resume(path, channels, 0.0).size(), 1u);
  EXPECT_EQ(HistoryFile::resume(path, channels, -1.0).size(), 0u);
}

/// A long run must not fill the memory with rows that are in the file.
TEST_F(HistoryFiles, MemoryDoesNotGrowWithTheLengthOfTheRun) {
  std::vector<Channel> wide = {{"time", "s", ""}};
  for (int i = 1; i < 50; ++i) wide.push_back({fmt::format("channel_{}", i), "N", ""});
  HistoryFile file = HistoryFile::create(path, wide, {});
  constexpr int rows = 1000;  // between flushes
  std::vector<double> row(wide.size(), 1.0);
  const auto part = [&] {
    for (int i = 0; i < rows; ++i) {
      row[0] += 1e-3;
      file.append(row);
    }
    file.flush();
  };
  part();  // takes the memory of one part, and what HDF5 keeps
  const std::size_t before = mallinfo2().uordblks;
  constexpr int parts = 10;
  for (int i = 0; i < parts; ++i) part();
  EXPECT_EQ(file.size(), std::size_t{(parts + 1) * rows});
  EXPECT_LT(mallinfo2().uordblks, before + rows * wide.size() * sizeof(double));
}

TEST_F(HistoryFiles, RefusesToContinueWithAGapOrOtherChannels) {
  write_rows(11);
  EXPECT_EQ(error_of([&] { HistoryFile::resume(path, channels, 0.0109); }), "no error");
  EXPECT_THAT(error_of([&] { HistoryFile::resume(path, channels, 0.011); }),
              AllOf(HasSubstr("ends at t = 0.01 s but the run continues from t = 0.011 s: rows "
                              "between are missing"),
                    HasSubstr("continue from an earlier checkpoint")));
  std::vector<Channel> other = channels;
  other[2] = {"torque", "N m", "torque"};
  EXPECT_THAT(error_of([&] { HistoryFile::resume(path, other, 0.005); }),
              HasSubstr("has the channels time [s], hub_drop [m], force_x [N]; this run has time "
                        "[s], hub_drop [m], torque [N m]"));
  expect_rows(read_history(path), 11);  // a refusal leaves the file as it was
}

TEST_F(HistoryFiles, RefusesRowsThatAreNotFiniteOrNotLater) {
  HistoryFile file = HistoryFile::create(path, channels, {});
  append_rows(file, 0, 3);
  EXPECT_THAT(error_of([&] {
                file.append({0.003, std::nan(""), 1.0});
              }),
              HasSubstr("hub_drop is nan at t = 0.003 s"));
  EXPECT_THAT(error_of([&] {
                file.append({0.002, 0.0, 1.0});
              }),
              HasSubstr("a row of t = 0.002 s follows one of t = 0.002 s"));
  EXPECT_NE(error_of([&] { file.append({0.003, 0.0}); }), "no error");
  file.flush();
  expect_rows(read_history(file.path()), 3);
}

TEST_F(HistoryFiles, DecreasingTimeIsRefused) {
  for (const double time : {0.0015, 0.002, std::nan("")}) {
    write_rows(3);
    {
      Hdf5File file(path, Hdf5File::Mode::edit);
      file.append("/history/time", {time});
      file.append("/history/hub_drop", {0.0});
      file.append("/history/force_x", {0.0});
      file.close();
    }
    EXPECT_THAT(error_of([&] { read_history(path); }),
                HasSubstr(fmt::format("row 4 of the history is at {} s, after 0.002 s", time)));
  }
}

TEST_F(HistoryFiles, GrainsSurfaceAuditAndCostAreReadBack) {
  Grains grains;
  grains.resize(2);
  grains.id = {8, 2};
  grains.x << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
  grains.v << 1, 2, 3, 4, 5, 6;
  grains.radius << 0.004, 0.005;
  grains.period = Vector3(0, 0.5, 0);
  grains.bed_level = 0.2;
  grains.virial.resize(3, 2);
  grains.virial << -1, -2, -3, -4, -5, -6;
  Surface surface;
  surface.triangles = {{0, 1, 2}};
  surface.resize(3);
  surface.x << 0, 1, 0, 0, 0, 1, 2, 2, 2;
  RunClosing closing;
  closing.audit.energies = {{"contact work on the wheel", -12.5}, {"kinetic energy", 3.0}};
  closing.audit.energy_residual = 1e-9;
  closing.audit.moment_imbalance = 2e-12;
  closing.cost.wall_time = 20.0;
  closing.cost.simulated_time = 2.0;
  closing.cost.steps = 100000;
  closing.cost.grains = 30000;
  closing.cost.ranks = 2;
  closing.warnings = {"first warning.", "second warning."};
  {
    HistoryFile file = HistoryFile::create(path, channels, {});
    file.write_reference(grains);
    append_rows(file, 0, 5);
    EXPECT_FALSE(has_closing(path));
    EXPECT_THAT(error_of([&] { read_closing(path); }),
                HasSubstr("the run did not come to its end"));
    file.write_final(grains, surface);
    file.write_closing(closing);
  }
  EXPECT_EQ(read_reference_grains(path).x, grains.x);
  EXPECT_TRUE(read_reference_grains(path).v.isZero());
  const Grains back = read_final_grains(path);
  EXPECT_EQ(back.id, grains.id);
  EXPECT_EQ(back.v, grains.v);
  EXPECT_EQ(back.radius, grains.radius);
  EXPECT_EQ(back.virial, grains.virial);
  EXPECT_EQ(back.period, grains.period);
  EXPECT_EQ(back.bed_level, 0.2);
  const Hdf5File file(path, Hdf5File::Mode::read);
  EXPECT_EQ(file.read_columns("/surface/x"), surface.x);
  EXPECT_EQ(file.read_triples("/surface/triangles"), surface.triangles);
  const RunClosing read = read_closing(path);
  ASSERT_EQ(read.audit.energies.size(), 2u);
  EXPECT_EQ(read.audit.energies[0].name, "contact work on the wheel");
  EXPECT_EQ(read.audit.energies[0].value, -12.5);
  EXPECT_EQ(read.audit.energy_residual, 1e-9);
  EXPECT_EQ(read.audit.moment_imbalance, 2e-12);
  EXPECT_EQ(read.cost.steps, 100000);
  EXPECT_DOUBLE_EQ(read.cost.particle_steps_per_second(), 1.5e8);
  EXPECT_DOUBLE_EQ(read.cost.simulated_per_wall_second(), 0.1);
  EXPECT_THAT(read.warnings, ElementsAre("first warning.", "second warning."));
}

TEST_F(HistoryFiles, FinalVirialIsKeptByARunOfZeroSteps) {
  Grains grains;
  grains.resize(2);
  grains.id = {8, 2};
  grains.radius << 0.004, 0.005;
  grains.virial = Matrix3X::Constant(3, 2, -0.5);
  {
    HistoryFile file = HistoryFile::create(path, channels, {});
    append_rows(file, 0, 5);
    file.write_final(grains, {});
  }
  Grains without = grains;
  without.virial.resize(3, 0);
  HistoryFile same = HistoryFile::resume(path, channels, 0.004);
  EXPECT_THAT(error_of([&] { read_final_grains(path); }), HasSubstr("has no /grains/final"));
  same.write_final(without, {});
  EXPECT_EQ(read_final_grains(path).virial, grains.virial);
  without.x(0, 0) = 1e-9;
  HistoryFile moved = HistoryFile::resume(path, channels, 0.004);
  moved.write_final(without, {});
  EXPECT_EQ(read_final_grains(path).virial.cols(), 0);
}

TEST_F(HistoryFiles, MissingAndForeignFilesAreNamed) {
  EXPECT_THAT(error_of([&] { read_history(path); }),
              HasSubstr(path + ": cannot open as an HDF5 file"));
  Hdf5File(path, Hdf5File::Mode::create).close();
  EXPECT_THAT(error_of([&] { read_history(path); }),
              HasSubstr("has no /history; is it a results file of Furrow?"));
  EXPECT_THAT(error_of([&] { read_run_info(path); }), HasSubstr("has no /run"));
}

}  // namespace
}  // namespace furrow::history_file_test
