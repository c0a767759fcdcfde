// SPDX-License-Identifier: GPL-2.0-or-later
// Rows in the memory of rank 0, saved by another thread while the main thread waits in MPI.

#include "coupling/liggghts/errors/rescue.h"

#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "furrow/io/results/history_file.h"
#include "tests/coupled/support/scene.h"

namespace furrow::test::rescue_test {
namespace {

using namespace std::chrono_literals;

const std::string folder = "rescue_results";

std::size_t rows_on_disk() { return read_history(folder + "/history.h5").size(); }

/// @return whether another thread could save the rows
bool flush_from_another_thread(Scene& scene) {
  bool saved = false;
  std::thread([&] { saved = coupling::flush_unused_results(scene.lammps(), 10ms); }).join();
  return saved;
}

TEST(Rescue, RowsAreSavedUnlessTheMainThreadUsesThem) {
  std::filesystem::remove_all(folder);
  Scene scene;
  scene.commands(
      "units si\natom_style granular\natom_modify sort 0 0\nnewton off\n"
      "communicate single vel yes\nregion box block -0.5 0.5 -0.5 0.5 -0.5 0.5 units box\n"
      "create_box 1 box\nneighbor 0.01 bin\ntimestep 1e-4\n"
      "fix wheel all wheel/rigid diameter 0.2 width 0.08 mass 1 inertia 0.005 segments 24\n"
      "fix rig all wheel/rig wheel wheel load_force 20 speed 0.2 mode towed settle_time 0.1 "
      "accelerate_time 0.1 ground_level -0.2\n"
      "fix out all wheel/history rig rig folder rescue_results every 1");
  int step = 0;
  scene.at_end_of_step([&] {
    if (++step != 10) return;
    const std::size_t before = rows_on_disk();
    ASSERT_LT(before, 10u) << "rows are saved by themselves";
    {
      const coupling::ResultsInUse in_use;
      EXPECT_FALSE(flush_from_another_thread(scene));
      EXPECT_EQ(rows_on_disk(), before);
    }
    EXPECT_TRUE(flush_from_another_thread(scene));
    EXPECT_GE(rows_on_disk(), 10u);
  });
  scene.command("run 20");
  EXPECT_EQ(step, 20);
  EXPECT_EQ(rows_on_disk(), 21u);
}

}  // namespace
}  // namespace furrow::test::rescue_test
