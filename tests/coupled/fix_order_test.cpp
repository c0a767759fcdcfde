// SPDX-License-Identifier: GPL-2.0-or-later
// The order in which LIGGGHTS calls the fixes, where the coupling relies on it.

#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "coupling/base/roles/fix_order.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"
#include "tests/support/error_of.h"

namespace furrow::test::fix_order_test {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

void make_scene(Scene& scene) {
  scene.granular_box(Vector3(-0.5, -0.5, -0.5), Vector3(0.5, 0.5, 0.5), 0.01);
  scene.commands(
      "fix wheel all wheel/rigid diameter 0.2 width 0.08 mass 1 inertia 0.005 segments 24\n"
      "fix skin all mesh/body body wheel type 2");
}

/// Two fixes change places in LIGGGHTS's list, which no line of a script can do.
void exchange(Scene& scene, const char* first, const char* second) {
  LAMMPS_NS::Modify& modify = *scene.lammps().modify;
  const int a = modify.find_fix(first), b = modify.find_fix(second);
  ASSERT_GE(a, 0);
  ASSERT_GE(b, 0);
  std::swap(modify.fix[a], modify.fix[b]);
  std::swap(modify.fmask[a], modify.fmask[b]);
}

std::string message_of(Scene& scene) {
  return error_of<StateError>(
      [&] { coupling::check_fix_order(*scene.lammps().modify, scene.system()); });
}

TEST(FixOrder, FirstBodyCreatesTheSystemAheadOfLaterFixes) {
  Scene scene;
  make_scene(scene);
  EXPECT_EQ(message_of(scene), "no error");
}

TEST(FixOrder, MeshBeforeTheSystemIsRefused) {
  Scene scene;
  make_scene(scene);
  exchange(scene, "furrow_system", "skin");
  EXPECT_THAT(message_of(scene),
              AllOf(HasSubstr("fix mesh/body 'skin' comes before fix furrow/system"),
                    HasSubstr("its triangles take the positions"),
                    HasSubstr("write 'unfix skin' and its line once more")));
  exchange(scene, "furrow_system", "skin");  // as it was: the scene can be taken down
}

TEST(FixOrder, HistoryBeforeTheSystemIsRefused) {
  Scene scene;
  make_scene(scene);
  scene.commands(
      "fix rig all wheel/rig wheel wheel load_force 20 speed 0.2 mode towed settle_time 0.1 "
      "accelerate_time 0.1 ground_level 0\n"
      "fix out all wheel/history rig rig folder fix_order_test every 10");
  EXPECT_EQ(message_of(scene), "no error");
  exchange(scene, "furrow_system", "out");
  EXPECT_THAT(message_of(scene), HasSubstr("fix wheel/history 'out' comes before"));
  exchange(scene, "furrow_system", "out");
}

/// A body made later stands after the system and its meshes too, and that is right: the system
/// calls it.
TEST(FixOrder, BodyAfterAMeshIsAccepted) {
  Scene scene;
  make_scene(scene);
  scene.commands(
      "fix other all wheel/rigid diameter 0.1 width 0.08 mass 1 inertia 0.001 segments 24 "
      "axle 0.3 0 0\n"
      "fix other_skin all mesh/body body other type 2\nunfix skin\n"
      "fix skin all mesh/body body wheel type 2");
  EXPECT_EQ(message_of(scene), "no error");
}

}  // namespace
}  // namespace furrow::test::fix_order_test
