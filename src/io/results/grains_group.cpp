// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/grains_group.h"

#include <fmt/format.h>

#include <vector>

#include "furrow/core/error.h"
#include "furrow/io/formats/hdf5_file.h"

namespace furrow {

void write_grains(Hdf5File& file, const std::string& group, const Grains& grains,
                  bool with_velocity) {
  file.remove(group);
  file.create_group(group);
  file.write(group + "/id", grains.id);
  file.write(group + "/x", grains.x);
  file.write(group + "/radius", std::vector<double>(grains.radius.data(),
                                                    grains.radius.data() + grains.radius.size()));
  if (with_velocity) file.write(group + "/v", grains.v);
  if (grains.virial.cols() > 0) {
    file.write(group + "/virial", grains.virial);
    file.set_attribute(group + "/virial", "unit", "J");
    file.set_attribute(group + "/virial", "meaning",
                       "xx, yy, zz of stress times volume by contacts between grains, tension "
                       "positive");
  }
  file.write(group + "/period",
             std::vector<double>{grains.period.x(), grains.period.y(), grains.period.z()});
  file.set_attribute(group, "bed_level", grains.bed_level);
  for (const char* length : {"x", "radius", "period"})
    file.set_attribute(group + "/" + length, "unit", "m");
  if (with_velocity) file.set_attribute(group + "/v", "unit", "m/s");
}

Grains read_grains(const Hdf5File& file, const std::string& group) {
  if (!file.exists(group))
    throw Error(fmt::format("{}: has no {}; the run kept no grains there", file.path(), group));
  Grains grains;
  grains.id = file.read_integers(group + "/id");
  grains.x = file.read_columns(group + "/x");
  const std::vector<double> radius = file.read_numbers(group + "/radius");
  grains.radius = Eigen::Map<const VectorX>(radius.data(), Eigen::Index(radius.size()));
  grains.v = file.exists(group + "/v") ? file.read_columns(group + "/v")
                                       : Matrix3X(Matrix3X::Zero(3, grains.x.cols()));
  if (file.exists(group + "/virial")) grains.virial = file.read_columns(group + "/virial");
  const std::vector<double> period = file.read_numbers(group + "/period");
  if (period.size() != 3)
    throw Error(fmt::format("{}: {}/period must be 3 numbers", file.path(), group));
  grains.period = Vector3(period[0], period[1], period[2]);
  grains.bed_level = file.number_attribute(group, "bed_level");
  grains.check();
  return grains;
}

}  // namespace furrow
