// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/sidewall_results.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "furrow/io/formats/csv_file.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/files/make_folder.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/inputs/tyre_file.h"
#include "furrow/io/files/version.h"

namespace furrow {

namespace {

struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
};

Columns columns_of(const SidewallCurve& curve) {
  Columns columns;
  const auto add = [&](const std::string& name, auto value) {
    columns.names.push_back(name);
    columns.values.emplace_back();
    for (std::size_t i = 0; i < curve.moved.size(); ++i) columns.values.back().push_back(value(i));
  };
  add("moved", [&](std::size_t i) { return curve.moved[i]; });
  add("a", [&](std::size_t i) { return curve.ends[i].a; });
  add("r", [&](std::size_t i) { return curve.ends[i].r; });
  add("phi", [&](std::size_t i) { return curve.ends[i].phi; });
  add("half_width", [&](std::size_t i) { return curve.half_width[i]; });
  for (const auto& [suffix, responses] :
       {std::pair("", &curve.solved), std::pair("_table", &curve.looked_up)}) {
    const std::string end = suffix;
    add("F_a" + end, [&, r = responses](std::size_t i) { return (*r)[i].on_tread[0]; });
    add("F_r" + end, [&, r = responses](std::size_t i) { return (*r)[i].on_tread[1]; });
    add("M" + end, [&, r = responses](std::size_t i) { return (*r)[i].on_tread[2]; });
    add("K_aa" + end, [&, r = responses](std::size_t i) { return (*r)[i].stiffness(0, 0); });
    add("K_rr" + end, [&, r = responses](std::size_t i) { return (*r)[i].stiffness(1, 1); });
    add("K_ar" + end, [&, r = responses](std::size_t i) { return (*r)[i].stiffness(0, 1); });
    add("K_MM" + end, [&, r = responses](std::size_t i) { return (*r)[i].stiffness(2, 2); });
    add("W" + end, [&, r = responses](std::size_t i) { return (*r)[i].potential; });
  }
  return columns;
}

}  // namespace

void write_sidewall_survey(const std::string& folder, const SidewallSurvey& survey) {
  make_folder(folder);
  write_text_file(folder + "/tyre.yaml", tyre_file_text(survey.tyre));
  replace_file(folder + "/sidewall.h5", [&](const std::string& part) {
    Hdf5File file(part, Hdf5File::Mode::create);
    file.set_attribute("/", "title", survey.tyre.title);
    file.set_attribute("/", "version", version());
    file.set_attribute("/", "pressure", survey.pressure);
    file.set_attribute("/", "half_width", survey.tyre.tread.half_width);
    file.set_attribute("/", "bead_spacing", survey.tyre.bead_spacing);
    for (const SidewallCurve& curve : survey.curves) {
      const Columns columns = columns_of(curve);
      file.create_group("/" + curve.name);
      file.set_attribute("/" + curve.name, "meaning", curve.meaning);
      for (std::size_t i = 0; i < columns.names.size(); ++i)
        file.write(fmt::format("/{}/{}", curve.name, columns.names[i]), columns.values[i]);
    }
    for (std::size_t i = 0; i < survey.profiles.size(); ++i) {
      const std::string group = fmt::format("/profiles/{}", i);
      const Eigen::Matrix2Xd& nodes = survey.profiles[i];
      std::vector<double> A(static_cast<std::size_t>(nodes.cols())), R(A.size());
      for (std::size_t k = 0; k < A.size(); ++k) {
        A[k] = nodes(0, static_cast<Eigen::Index>(k));
        R[k] = nodes(1, static_cast<Eigen::Index>(k));
      }
      file.write(group + "/A", A);
      file.write(group + "/R", R);
      file.set_attribute(group, "deflection", survey.deflections[i]);
    }
    file.close();
  });
  for (const SidewallCurve& curve : survey.curves) {
    const Columns columns = columns_of(curve);
    write_text_file(
        folder + "/" + curve.name + ".csv",
        csv_text(
            {fmt::format("{}, {:g} Pa; SI units, per unit circumference of the tread; moved: {}",
                         survey.tyre.title, survey.pressure, curve.meaning),
             "F_a, F_r, M on the tread; K = -dF; W potential; _table: looked up, else the chain's "
             "solution"},
            columns.names, columns.values));
  }
}

std::string sidewall_report(const SidewallSurvey& survey) {
  const TyreParameters& tyre = survey.tyre;
  const SidewallParameters& sidewall = tyre.sidewall;
  const SidewallResponse& here = survey.response;
  const VectorX& angles = survey.shape.angles;
  const double chord = std::hypot(survey.made.a, survey.made.r);
  const double width = tyre.bead_spacing + 2.0 * survey.shape.nodes.row(0).maxCoeff();
  const double first = angles[0], last = angles[angles.size() - 1];
  const double tension = -(here.on_tread[0] * std::cos(last) +
                           here.on_tread[1] * std::sin(last));  // of the last segment
  std::string text = fmt::format("{} at {:.4g} kPa\n", tyre.title, survey.pressure / 1e3);
  const auto line = [&](const std::string& name, const std::string& value) {
    text += fmt::format("  {:<13} {}\n", name, value);
  };
  line("sidewall", fmt::format("{} segments, {:.4g} mm; chord {:.4g} mm, {:.3f} of the length",
                               sidewall.segments(), 1e3 * sidewall.length, 1e3 * chord,
                               chord / sidewall.length));
  line("section", fmt::format("{:.4g} mm wide; the sidewall turns by {:.1f} degrees, from {:.1f} "
                              "at the rim to {:.1f} at the tread",
                              1e3 * width, degrees(last - first), degrees(first), degrees(last)));
  line("tension", fmt::format("{:.5g} N/m at the tread", tension) +
                      (survey.pressure > 0.0 ? fmt::format(", p rho with rho = {:.4g} mm",
                                                           1e3 * tension / survey.pressure)
                                             : ""));
  line("on the tread", fmt::format("axial {:.5g} N/m, radial {:.5g} N/m, moment {:.4g} N m/m",
                                   here.on_tread[0], here.on_tread[1], here.on_tread[2]));
  const Vector3& on_rim = survey.shape.on_rim;
  line("on the rim", fmt::format("axial {:.5g} N/m, radial {:.5g} N/m, moment {:.4g} N m/m",
                                 on_rim[0], on_rim[1], on_rim[2]));
  const Matrix3& K = here.stiffness;
  line("stiffness", fmt::format("axial {:.5g}, radial {:.5g}, coupled {:.5g} and {:.5g} N/m per m; "
                                "rotation {:.4g} N m/rad per m",
                                K(0, 0), K(1, 1), K(0, 1), K(1, 0), K(2, 2)));
  const SidewallTable::Accuracy& accuracy = survey.accuracy;
  line("table",
       fmt::format("{} x {} x {} nodes; force differs by {:.2g} N/m rms, {:.2g} N/m at most, of "
                   "{:.4g} N/m rms "
                   "({} points, chords to 0.97)",
                   survey.grid.chord_nodes, survey.grid.direction_nodes, survey.grid.rotation_nodes,
                   accuracy.force_rms, accuracy.force_max, accuracy.force_scale, accuracy.points));
  const SidewallCurve& curve = survey.curves.front();
  text += fmt::format("\n  {:>14} {:>14} {:>14} {:>14} {:>14} {:>14}\n", "deflection, mm",
                      "F_r, N/m", "table", "F_a, N/m", "table", "width, mm");
  for (std::size_t i = 0; i < curve.moved.size();
       i += std::max<std::size_t>(1, curve.moved.size() / 10))
    text += fmt::format("  {:14.2f} {:14.3f} {:14.3f} {:14.3f} {:14.3f} {:14.2f}\n",
                        1e3 * curve.moved[i], curve.solved[i].on_tread[1],
                        curve.looked_up[i].on_tread[1], curve.solved[i].on_tread[0],
                        curve.looked_up[i].on_tread[0], 2e3 * curve.half_width[i]);
  return text + "\n";
}

}  // namespace furrow
