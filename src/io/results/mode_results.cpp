// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/mode_results.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/io/formats/csv_file.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/formats/vtk_file.h"
#include "furrow/tyre/mode_kind.h"

namespace furrow {

namespace {

/// The triangles of the tread, whose nodes are the first of a tyre's surface.
Surface tread_of(const Tyre& tyre) {
  const Surface& whole = tyre.surface();
  const int nodes = tyre.tread_grid().count();
  Surface tread;
  tread.resize(static_cast<std::size_t>(nodes));
  tread.x = whole.x.leftCols(nodes);
  std::copy_if(whole.triangles.begin(), whole.triangles.end(), std::back_inserter(tread.triangles),
               [&](const Vector3i& triangle) { return triangle.maxCoeff() < nodes; });
  return tread;
}

}  // namespace

void write_modes(const std::string& name, const Tyre& tyre, const NaturalModes& modes,
                 const std::string& title, double load) {
  const std::size_t count = modes.shape.size();
  std::vector<ModeKind> kinds;
  for (const Matrix3X& shape : modes.shape) kinds.push_back(kind_of(tyre, shape));

  std::vector<std::vector<double>> columns(6);
  for (std::size_t i = 0; i < count; ++i) {
    const ModeKind& kind = kinds[i];
    const double row[] = {static_cast<double>(i + 1),
                          modes.frequency[static_cast<Eigen::Index>(i)],
                          static_cast<double>(kind.waves),
                          kind.radial,
                          kind.circumferential,
                          kind.axial};
    for (std::size_t column = 0; column < columns.size(); ++column)
      columns[column].push_back(row[column]);
  }
  write_text_file(
      name + "_modes.csv",
      csv_text({fmt::format("{}, {:g} Pa, {:g} N; natural modes, rim fixed", title, tyre.pressure(),
                            load),
                "radial, circumferential, axial: shares of the tread's motion"},
               {"mode", "frequency_Hz", "waves", "radial", "circumferential", "axial"}, columns));

  const Surface tread = tread_of(tyre);
  std::vector<NodeField> fields;
  for (std::size_t i = 0; i < count; ++i)
    fields.push_back({fmt::format("mode {:02d}, {:.1f} Hz", i + 1, columns[1][i]), modes.shape[i]});
  write_vtp(name + "_modes.vtp", tread, fields);

  replace_file(name + "_modes.h5", [&](const std::string& part) {
    Hdf5File file(part, Hdf5File::Mode::create);
    file.set_attribute("/", "title", title);
    file.set_attribute("/", "pressure", tyre.pressure());
    file.set_attribute("/", "load", load);
    file.write("/x", tread.x);
    file.write("/triangles", tread.triangles);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string mode = fmt::format("/mode_{:02d}", i + 1);
      file.write(mode, modes.shape[i]);
      file.set_attribute(mode, "frequency", columns[1][i]);
      file.set_attribute(mode, "waves", kinds[i].waves);
      file.set_attribute(mode, "radial", kinds[i].radial);
      file.set_attribute(mode, "circumferential", kinds[i].circumferential);
      file.set_attribute(mode, "axial", kinds[i].axial);
    }
    file.close();
  });
}

}  // namespace furrow
