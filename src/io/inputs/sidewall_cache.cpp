// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/sidewall_cache.h"

#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "furrow/core/error.h"
#include "furrow/io/files/cache.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/files/version.h"
#include "furrow/tyre/sidewall/sidewall_direct.h"

namespace furrow {

namespace fs = std::filesystem;

namespace {

const char* const dataset = "/coefficients";

/// Everything that a table depends on, numbers with all digits.
std::string identity_of(const SidewallParameters& sidewall, double pressure,
                        const SidewallTableGrid& grid) {
  std::string text = fmt::format(
      "sidewall table 1 of furrow {}\nlength {}\nbending {}\ncurvature {}\nangles {} {}\nend "
      "springs {} {}\nstrip {} "
      "{}\npressure {}\n",
      version(), sidewall.length, fmt::join(sidewall.bending, " "),
      fmt::join(sidewall.curvature, " "), sidewall.rim_angle, sidewall.tread_angle,
      sidewall.rim_stiffness, sidewall.tread_stiffness, sidewall.bead_width, sidewall.taper,
      pressure);
  for (const GridAxis& axis : grid.axes())
    text += fmt::format("axis {} {} {}\n", axis.lower, axis.upper, axis.nodes);
  return text;
}

/// The coefficients kept under a name, or none.
std::vector<double> kept(const fs::path& path, const std::string& identity) {
  if (!fs::is_regular_file(path) || !distrust(path).empty()) return {};
  try {
    const Hdf5File file(path.string(), Hdf5File::Mode::read);
    if (file.read_text("/identity") == identity) return file.read_numbers(dataset);
  } catch (const Error&) {
    // A file of something else, or cut short: the table is made again and replaces it.
  }
  return {};
}

/// Writes a table under a name of this process alone, then renames it: other processes find a whole
/// file or none.
void keep(const fs::path& path, const std::string& identity,
          const std::vector<double>& coefficients) {
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  if (failed) return;
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const fs::path part = fmt::format("{}.{}.{}.part", path.string(), host, getpid());
  try {
    Hdf5File file(part.string(), Hdf5File::Mode::create);
    file.write("/identity", identity);
    file.write(dataset, coefficients);
    file.close();
    fs::rename(part, path, failed);
  } catch (const Error&) {
    // A folder that may not be written to: the table is used all the same.
  }
  fs::remove(part, failed);
}

}  // namespace

const std::vector<std::string>& sidewall_kinds() {
  static const std::vector<std::string> kinds = {"table", "direct"};
  return kinds;
}

std::unique_ptr<SidewallTable> open_sidewall_table(const SidewallParameters& parameters,
                                                   double pressure, const SidewallTableGrid& grid) {
  const std::string identity = identity_of(parameters, pressure, grid);
  const fs::path path = cache_folder() / fmt::format("sidewall-{}.h5", content_hash(identity));
  if (std::vector<double> coefficients = kept(path, identity); !coefficients.empty())
    return std::make_unique<SidewallTable>(parameters, pressure, grid, std::move(coefficients));
  auto table = std::make_unique<SidewallTable>(parameters, pressure, grid);
  keep(path, identity, table->coefficients());
  return table;
}

std::unique_ptr<Sidewall> open_sidewall(const std::string& kind,
                                        const SidewallParameters& parameters, double pressure,
                                        const SidewallTableGrid& grid) {
  if (kind == "table") return open_sidewall_table(parameters, pressure, grid);
  if (kind == "direct") return std::make_unique<SidewallDirect>(parameters, pressure);
  throw InputError("sidewall", fmt::format("is '{}'", kind),
                   fmt::format("one of: {}", fmt::join(sidewall_kinds(), ", ")));
}

}  // namespace furrow
