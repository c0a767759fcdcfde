// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/particles/particle_group.h"

#include <vector>

namespace furrow {

double ParticleGroup::largest_wave_speed(std::size_t from, std::size_t to) const {
  if (from == to) return 0.0;
  std::vector<double*> pointers;
  const_cast<Particles&>(particles).state_pointers(from, pointers);
  PointBlock block;
  block.size = to - from;
  block.state = pointers.data();
  return material->largest_wave_speed(block);
}

}  // namespace furrow
