// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/particles/particles.h"

#include <malloc.h>

#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "terrain_scene.h"

namespace furrow::particles_test {
namespace {

using testing_terrain::elastic;
using testing_terrain::material_of;
using testing_terrain::snow;

/// Every number of every particle tells column, component and particle.
void number(Particles& particles) {
  std::vector<double> record;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    particles.data(column::x)[p] = 100.0 * double(p);
    particles.data(column::initial_z)[p] = 100.0 * double(p) + 1.0;
    for (std::size_t c = 0; c < 4; ++c)
      particles.data(column::velocity)[4 * p + c] = 100.0 * double(p) + 2.0 + double(c);
    for (std::size_t c = 0; c < 12; ++c)
      particles.data(column::affine)[12 * p + c] = 100.0 * double(p) + 10.0 + double(c);
  }
}

TEST(Particles, NewParticlesAreZeroWithTheStateOfTheLaw) {
  const auto material = material_of(snow());
  Particles particles(*material);
  EXPECT_EQ(particles.append(3), 0u);
  EXPECT_EQ(particles.append(2), 3u);
  EXPECT_EQ(particles.size(), 5u);
  particles.set_state(4, material->initial_state());
  EXPECT_EQ(particles.state(4), material->initial_state());
  EXPECT_EQ(particles.state(3),
            VectorX::Zero(static_cast<Eigen::Index>(material->state_fields().size())));
  EXPECT_EQ(particles.position(4), Vector3::Zero());
}

TEST(Particles, AffineVelocityIsStoredByColumns) {
  const auto material = material_of(elastic(1e6, 0.3, 1000));
  Particles particles(*material);
  particles.append(2);
  number(particles);
  Matrix3 expected;
  expected << 110, 114, 118, 111, 115, 119, 112, 116, 120;
  EXPECT_EQ(particles.affine(1), expected);
  EXPECT_EQ(particles.velocity(1), Vector3(102, 103, 104));
}

TEST(Particles, ReorderingMovesAllColumnsAndDropsTheRest) {
  const auto material = material_of(elastic(1e6, 0.3, 1000));
  Particles particles(*material);
  particles.append(4);
  const ParticleColumn memory = particles.add_column("one", 2);
  number(particles);
  for (std::size_t p = 0; p < 4; ++p) memory.data()[2 * p + 1] = double(p);
  particles.reorder({3, 0, 2});
  ASSERT_EQ(particles.size(), 3u);
  EXPECT_EQ(particles.position(0).x(), 300.0);
  EXPECT_EQ(particles.position(1).x(), 0.0);
  EXPECT_EQ(particles.data(column::initial_z)[2], 201.0);
  EXPECT_EQ(particles.affine(0)(0, 0), 310.0);
  EXPECT_EQ(memory.data()[1], 3.0);
  EXPECT_EQ(memory.data()[5], 2.0);
  particles.reorder({});
  EXPECT_EQ(particles.size(), 0u);
}

/// Columns with one component once took the memory of those with twelve, one by one.
TEST(Particles, ReorderingDoesNotGrowMemory) {
  constexpr std::size_t count = 20000;
  const auto material = material_of(elastic(1e6, 0.3, 1000));
  Particles particles(*material);
  particles.append(count);
  const ParticleColumn memory = particles.add_column("one", 13);
  std::vector<std::size_t> order(count);
  std::iota(order.rbegin(), order.rend(), std::size_t(0));
  const auto allocated = [] {
    const struct mallinfo2 memory_of_heap = mallinfo2();
    return memory_of_heap.uordblks + memory_of_heap.hblkhd;
  };
  for (int n = 0; n < 2; ++n) particles.reorder(order);
  const std::size_t before = allocated();
  for (int n = 0; n < 60; ++n) particles.reorder(order);
  EXPECT_LT(allocated(), before + count * sizeof(double));
}

TEST(Particles, AddedColumnIsZeroAndFollowsItsParticle) {
  const auto material = material_of(elastic(1e6, 0.3, 1000));
  Particles particles(*material);
  particles.append(3);
  const std::size_t before = particles.record_length();
  const ParticleColumn memory = particles.add_column("one", 4);
  EXPECT_EQ(particles.record_length(), before + 4);
  for (std::size_t n = 0; n < 12; ++n) EXPECT_EQ(memory.data()[n], 0.0);
  memory.data()[9] = 7.0;
  particles.append(1);
  EXPECT_EQ(memory.data()[9], 7.0);
  EXPECT_EQ(memory.data()[15], 0.0);
}

TEST(Particles, EveryOwnerHasOneColumn) {
  Particles particles(*material_of(elastic(1e6, 0.3, 1000)));
  const ParticleColumn first = particles.add_column("one", 4),
                       second = particles.add_column("two", 4);
  EXPECT_THROW(particles.add_column("one", 4), Error);
}

/// The owner may return, as a contact that a script removes and defines once more; a record of the
/// particles then has the new values alone.
TEST(Particles, ColumnIsReleasedWithItsHandle) {
  Particles particles(*material_of(elastic(1e6, 0.3, 1000)));
  particles.append(2);
  const std::size_t before = particles.record_length();
  {
    ParticleColumn first = particles.add_column("one", 4);
    first.data()[7] = 5.0;
    const ParticleColumn moved = std::move(first);
    EXPECT_EQ(moved.data()[7], 5.0);
    EXPECT_THROW(particles.add_column("one", 4), Error);
  }
  const ParticleColumn again = particles.add_column("one", 3);
  EXPECT_EQ(particles.record_length(), before + 3);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(again.data()[n], 0.0);
  { const ParticleColumn other = particles.add_column("two", 1); }
  particles.remove_released_columns();
  EXPECT_EQ(particles.record_length(), before + 3);
}

/// LIGGGHTS removes the fixes in the order of their lines: the terrain before its contacts.
TEST(Particles, HandleOutlivesTheParticles) {
  auto particles = std::make_unique<Particles>(*material_of(elastic(1e6, 0.3, 1000)));
  particles->append(1);
  const ParticleColumn column = particles->add_column("one", 1);
  column.data()[0] = 3.0;
  particles.reset();
  EXPECT_EQ(column.data()[0], 3.0);
}

TEST(Particles, PackAndUnpackAreInverse) {
  const auto material = material_of(snow());
  Particles from(*material), to(*material);
  from.append(3);
  number(from);
  from.set_state(1, material->initial_state());
  std::vector<double> buffer;
  from.pack(1, buffer);
  from.pack(2, buffer);
  ASSERT_EQ(buffer.size(), 2 * from.record_length());
  to.unpack(buffer.data());
  to.unpack(buffer.data() + from.record_length());
  ASSERT_EQ(to.size(), 2u);
  std::vector<double> again;
  to.pack(0, again);
  to.pack(1, again);
  EXPECT_EQ(again, buffer);
  EXPECT_EQ(to.state(0), material->initial_state());
}

}  // namespace
}  // namespace furrow::particles_test
