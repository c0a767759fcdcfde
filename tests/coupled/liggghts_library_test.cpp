// SPDX-License-Identifier: GPL-2.0-or-later
// Facts about LIGGGHTS beyond its public interface that Furrow relies on, compared with the headers
// and the installed library. When one of these fails, Debian's package has changed: read
// coupling/liggghts again with its new source before anything else.

#include <algorithm>
#include <utility>

#include <malloc.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "atom.h"
#include "furrow/core/error.h"
#include "coupling/contact/grains/fix_mesh_body.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/data/box_motion.h"
#include "coupling/liggghts/data/contact_history.h"
#include "coupling/liggghts/data/exchange_buffer.h"
#include "coupling/liggghts/library_check.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/data/wall_meshes.h"
#include "domain.h"
#include "fix_contact_history_mesh.h"
#include "fix_wall_gran.h"
#include "input.h"
#include "modify.h"
#include "neighbor.h"
#include "tests/coupled/support/scene.h"
#include "universe.h"
#include "tests/support/error_of.h"

namespace furrow::test::liggghts_library_test {
namespace {

using namespace coupling;
using ::testing::HasSubstr;

TEST(LiggghtsLibrary, VersionIsThatOfDebian12) {
  Scene scene;
  EXPECT_THAT(scene.lammps().universe->version, HasSubstr(liggghts_version));
  EXPECT_NO_THROW(check_library(scene.lammps()));
  for (const char* name :
       {symbol::create, symbol::write_restart, symbol::read_int, symbol::nread_double,
        symbol::restart_requested, symbol::decide, symbol::write_output, symbol::open_dump})
    EXPECT_NE(next_definition(name), nullptr) << name;
  EXPECT_EQ(next_definition("_ZN9LAMMPS_NS6LAMMPS7destroyyEv"), nullptr);
}

TEST(LiggghtsLibrary, OtherVersionIsRefusedWithTheOneToInstall) {
  Scene scene;
  std::string other = "Version 3.9.1";
  char* version = std::exchange(scene.lammps().universe->version, other.data());
  const std::string message = test::error_of([&] { check_library(scene.lammps()); });
  scene.lammps().universe->version = version;
  EXPECT_THAT(message, HasSubstr("it calls itself 'Version 3.9.1'"));
  EXPECT_THAT(message, HasSubstr("install liggghts 3.8.0 of Debian 12 or 13"));
}

/// Sizes in libliggghts-dev 3.8.0+repack1-9 on amd64: a subclass must agree with the library's
/// objects.
TEST(LiggghtsLibrary, ClassesHaveTheSizesOfThePackage) {
  EXPECT_EQ(sizeof(LAMMPS_NS::Fix), 544u);
  EXPECT_EQ(sizeof(LAMMPS_NS::FixWallGran), 928u);
  EXPECT_EQ(sizeof(LAMMPS_NS::FixMeshSurface), 1104u);
  EXPECT_EQ(sizeof(LAMMPS_NS::TriMesh), 1352u);
  EXPECT_EQ(sizeof(LAMMPS_NS::FixContactHistoryMesh), 768u);
  EXPECT_EQ(sizeof(LAMMPS_NS::Modify), 592u);
  EXPECT_EQ(sizeof(LAMMPS_NS::Input), 320u);
  EXPECT_EQ(sizeof(LAMMPS_NS::Domain), 1144u);
  EXPECT_EQ(sizeof(LAMMPS_NS::Atom), 1480u);
}

/// The library allocates these itself: the room they have is that of the headers' classes, up to
/// the rounding of the allocator.
TEST(LiggghtsLibrary, HeadersAndLibraryAgreeOnSizes) {
  Scene scene;
  scene.granular_box(Vector3(-1, -1, -1), Vector3(1, 1, 1), 0.1);
  const auto expect_room = [](auto* object, const char* name) {
    const std::size_t size = sizeof *object;
    EXPECT_GE(malloc_usable_size(object), size) << name;
    EXPECT_LT(malloc_usable_size(object), size + 32) << name;
  };
  LAMMPS_NS::LAMMPS& lammps = scene.lammps();
  expect_room(lammps.modify, "Modify");
  expect_room(lammps.input, "Input");
  expect_room(lammps.domain, "Domain");
  expect_room(lammps.atom, "Atom");
  expect_room(lammps.neighbor, "Neighbor");
}

TEST(LiggghtsLibrary, StylesAndCommandsAreFoundInItsTables) {
  Scene scene;
  for (const char* style : {"wall/gran", "mesh/surface", "nve/sphere", "property/atom"})
    EXPECT_TRUE(has_fix_style(scene.lammps(), style)) << style;
  EXPECT_TRUE(has_fix_style(scene.lammps(), "wheel/rigid"));
  EXPECT_TRUE(has_command(scene.lammps(), "bed"));
  EXPECT_FALSE(has_fix_style(scene.lammps(), "no/such/style"));
  scene.command("clear");
  EXPECT_TRUE(has_fix_style(scene.lammps(), "wheel/rigid"));
  EXPECT_TRUE(has_command(scene.lammps(), "bed"));
}

/// Grains in a row that touch their neighbours, on a sheet.
void make_grains(Scene& scene) {
  scene.granular_box(Vector3(-0.1, -0.1, -0.02), Vector3(0.1, 0.1, 0.1), 0.004);
  scene.contact_properties(5e6, 0.3, 0.5, 0.5);
  scene.commands(
      "pair_style gran model hertz tangential history\npair_coeff * *\ntimestep 1e-5\n"
      "fix weight all gravity 9.81 vector 0 0 -1");
  for (int i = 0; i < 5; ++i)
    scene.command(fmt::format("create_atoms 1 single {} 0 0.0049", -0.0396 + 0.0198 * i));
  scene.commands("set group all density 2500 diameter 0.02\nfix move all nve/sphere");
  scene.add_body("sheet", std::make_unique<PrescribedBody>(make_sheet(4, 0.18, -0.005),
                                                           [](double, Surface&) {}));
  scene.commands(
      "fix skin all mesh/body body sheet type 2\n"
      "fix wall all wall/gran/body model hertz tangential history mesh n_meshes 1 meshes skin");
  scene.command("run 20");
}

TEST(LiggghtsLibrary, PackedGrainHasTheExpectedLayout) {
  Scene scene;
  make_grains(scene);
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  LAMMPS_NS::FixContactHistory* history = find_contact_history(scene.lammps());
  ASSERT_NE(history, nullptr);
  update_contact_histories(scene.lammps());
  const std::vector<std::string> ids = riders(scene.lammps());
  double neighbours = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) {
    atom.omega[i][1] = 0.5 + i;
    PackedGrain grain = pack_grain(scene.lammps(), i);
    double* numbers = grain.numbers.data();
    EXPECT_EQ(packed_tag(numbers), atom.tag[i]);
    EXPECT_EQ(packed_radius(numbers), atom.radius[i]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(packed_position(numbers)[k], atom.x[i][k]);
      EXPECT_EQ(packed_velocity(numbers)[k], atom.v[i][k]);
      EXPECT_EQ(packed_angular_velocity(numbers)[k], atom.omega[i][k]);
    }
    const auto rider = std::find(ids.begin(), ids.end(), history->id) - ids.begin();
    const PackedContacts contacts(numbers + grain.parts_at.at(static_cast<std::size_t>(rider)),
                                  static_cast<std::size_t>(history->get_dnum()));
    EXPECT_EQ(static_cast<int>(contacts.count()), history->n_partner(i));
    for (std::size_t n = 0; n < contacts.count(); ++n)
      EXPECT_EQ(std::abs(contacts.partner(n) - atom.tag[i]), 1);  // of the row
    neighbours += static_cast<double>(contacts.count());
  }
  EXPECT_EQ(scene.sum(neighbours), 8.0);
}

TEST(LiggghtsLibrary, RemovedAndReinsertedGrainIsUnchanged) {
  Scene scene;
  make_grains(scene);
  LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  const int before = atom.nlocal;
  if (before > 0) {
    PackedGrain grain = pack_grain(scene.lammps(), 0);
    const int tag = atom.tag[0];
    const Vector3 x = Eigen::Map<const Vector3>(atom.x[0]);
    remove_grain(scene.lammps(), 0);
    EXPECT_EQ(atom.nlocal, before - 1);
    add_grain(scene.lammps(), grain.numbers);
    ASSERT_EQ(atom.nlocal, before);
    EXPECT_EQ(atom.tag[before - 1], tag);
    EXPECT_EQ(Vector3(Eigen::Map<const Vector3>(atom.x[before - 1])), x);
  }
  finish_exchange(scene.lammps());
  EXPECT_EQ(atom.natoms, 5);
  scene.command("run 20");
  EXPECT_EQ(scene.sum(scene.lammps().atom->nlocal), 5.0);
}

TEST(LiggghtsLibrary, MeshFixUsesTheBodyMesh) {
  Scene scene;
  make_grains(scene);
  auto& fix = dynamic_cast<FixMeshBody&>(*scene.lammps().modify->find_fix_id("skin"));
  EXPECT_EQ(fix.mesh(), &fix.body_mesh());
  double triangles = fix.body_mesh().sizeLocal();
  EXPECT_EQ(scene.sum(triangles), 32.0);
}

TEST(LiggghtsLibrary, ContinuingMeshContactsAreMarked) {
  Scene scene;
  make_grains(scene);
  auto& fix = dynamic_cast<FixMeshBody&>(*scene.lammps().modify->find_fix_id("skin"));
  LAMMPS_NS::FixContactHistoryMesh& history = *fix.contactHistory();
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  const auto contacts_seen = [&] {
    double seen = 0.0;
    for (int i = 0; i < atom.nlocal; ++i)
      for (int j = 0; j < history.nneighs(i); ++j)
        seen += history.partner(i, j) >= 0 && contact_seen(history, i, j);
    return scene.sum(seen);
  };
  EXPECT_GT(contacts_seen(), 0.0);
  history.markAllContacts();  // as not seen
  EXPECT_EQ(contacts_seen(), 0.0);
}

TEST(LiggghtsLibrary, MeshListIsRestoredAfterAnException) {
  std::vector<LAMMPS_NS::FixMeshSurface*> all(3, nullptr), some(1, nullptr);
  LAMMPS_NS::FixMeshSurface** list = all.data();
  int count = 3;
  try {
    const WallMeshes seen(list, count, some);
    EXPECT_EQ(list, some.data());
    EXPECT_EQ(count, 1);
    throw Error("a contact model refuses");
  } catch (const Error&) {
  }
  EXPECT_EQ(list, all.data());
  EXPECT_EQ(count, 3);
}

TEST(LiggghtsLibrary, MovingBoxStretchesAboutItsMiddleAndStops) {
  Scene scene;
  scene.granular_box(Vector3(0, 0, 0), Vector3(0.2, 0.2, 0.4), 0.01, "p p p");
  LAMMPS_NS::Domain& domain = *scene.lammps().domain;
  {
    BoxMotion box(scene.lammps(), 1);
    box.announce({0.0, 0.0, 0.5});
    EXPECT_EQ(domain.deform_vremap, 1);
    EXPECT_DOUBLE_EQ(box_velocity_z(scene.lammps(), 0.4), -0.1);
    box.advance({0.0, 0.0, 0.5}, 0.01);
    EXPECT_DOUBLE_EQ(domain.prd[2], 0.4 * std::exp(-0.005));
    EXPECT_DOUBLE_EQ(domain.boxlo[2] + domain.boxhi[2], 0.4);
  }
  EXPECT_EQ(domain.deform_vremap, 0);
}

TEST(LiggghtsLibrary, FixesComputesAndVariablesAreCreatedAsByAScript) {
  Scene scene;
  scene.granular_box(Vector3(-1, -1, -1), Vector3(1, 1, 1), 0.1);
  LAMMPS_NS::Fix& fix = add_fix(scene.lammps(), {"move", "all", "nve/sphere"});
  EXPECT_STREQ(fix.id, "move");
  add_compute(scene.lammps(), {"warmth", "all", "temp"});
  add_compute(scene.lammps(), {"warmth", "all", "temp"});  // once is enough
  EXPECT_GE(scene.lammps().modify->find_compute("warmth"), 0);
  set_variable(scene.lammps(), "words", "two words");
  EXPECT_EQ(variable(scene.lammps(), "words"), "two words");
  EXPECT_EQ(variable(scene.lammps(), "no_such_variable"), std::nullopt);
}

}  // namespace
}  // namespace furrow::test::liggghts_library_test
