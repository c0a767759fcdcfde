// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/history_file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>

#include "core/error.h"
#include "io/hdf5_file.h"
#include "io/replace_file.h"
#include "io/terrain_fields.h"
#include "statistics/rig_stage.h"

namespace furrow {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using NumberMember = std::pair<const char*, double Audit::*>;

constexpr double flush_interval = 5.0;            // [s] between flushes that come by themselves
constexpr double least_flush_ratio = 100.0;       // of that interval to the duration of a flush
constexpr char former_stage_channel[] = "phase";  // in older files

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string dataset_of(const Channel& channel) { return "/history/" + channel.name; }

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::string join_lines(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return lines;
}

// The numbers of /audit, by attribute
const NumberMember audit_numbers[] = {
    {"energy_residual", &Audit::energy_residual},   {"energy_scale", &Audit::energy_scale},
    {"force_imbalance", &Audit::force_imbalance},   {"force_scale", &Audit::force_scale},
    {"moment_imbalance", &Audit::moment_imbalance}, {"moment_scale", &Audit::moment_scale}};

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

Grains read_grains(const std::string& path, const std::string& group) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  if (!file.exists(group))
    throw Error(fmt::format("{}: has no {}; the run kept no grains there", path, group));
  Grains grains;
  grains.id = file.read_integers(group + "/id");
  grains.x = file.read_columns(group + "/x");
  const std::vector<double> radius = file.read_numbers(group + "/radius");
  grains.radius = Eigen::Map<const VectorX>(radius.data(), Eigen::Index(radius.size()));
  grains.v = file.exists(group + "/v") ? file.read_columns(group + "/v")
                                       : Matrix3X(Matrix3X::Zero(3, grains.x.cols()));
  if (file.exists(group + "/virial")) grains.virial = file.read_columns(group + "/virial");
  const std::vector<double> period = file.read_numbers(group + "/period");
  if (period.size() != 3) throw Error(fmt::format("{}: {}/period must be 3 numbers", path, group));
  grains.period = Vector3(period[0], period[1], period[2]);
  grains.bed_level = file.number_attribute(group, "bed_level");
  grains.check();
  return grains;
}

/// @throws Error where a row is not later [s] than the row above
void check_time(const std::string& path, const std::vector<double>& time) {
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1]))
      throw Error(
          fmt::format("{}: time does not run forwards: row {} of the history is at {} s, after {} "
                      "s; two runs wrote into one folder, or the file is damaged: repeat the run, "
                      "into a folder of its own",
                      path, i + 1, time[i], time[i - 1]));
}

History read_rows(const Hdf5File& file) {
  if (!file.exists("/history"))
    throw Error(fmt::format("{}: has no /history; is it a results file of Furrow?", file.path()));
  std::vector<Channel> channels;
  std::vector<std::vector<double>> columns;
  for (const std::string& name : file.members("/history")) {
    const std::string dataset = "/history/" + name;
    channels.push_back(
        {name, file.text_attribute(dataset, "unit"), file.text_attribute(dataset, "meaning")});
    columns.push_back(file.read_numbers(dataset));
    if (columns.back().size() != columns.front().size())
      throw Error(fmt::format("{}: {} has {} rows, {} has {}", file.path(), dataset,
                              columns.back().size(), dataset_of(channels.front()),
                              columns.front().size()));
  }
  if (!columns.empty()) check_time(file.path(), columns.front());
  History history(channels);
  std::vector<double> row(channels.size());
  for (std::size_t i = 0; !columns.empty() && i < columns.front().size(); ++i) {
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = columns[j][i];
    history.append(row);
  }
  return history;
}

void check_channels(const std::string& path, const std::vector<Channel>& found,
                    const std::vector<Channel>& expected) {
  const auto same = [](const Channel& a, const Channel& b) {
    return a.name == b.name && a.unit == b.unit;
  };
  if (std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same)) return;
  const auto list = [](const std::vector<Channel>& channels) {
    std::vector<std::string> texts;
    for (const Channel& channel : channels)
      texts.push_back(fmt::format("{} [{}]", channel.name, channel.unit));
    return fmt::format("{}", fmt::join(texts, ", "));
  };
  throw Error(
      fmt::format("{}: cannot be continued: it has the channels {}; this run has {}; continue with "
                  "the rig and the "
                  "wheel it was started with, or name another file",
                  path, list(found), list(expected)));
}

/// Drops what is later than time, and refuses a file that ends before it.
void cut_at(const std::string& path, History& history, double time) {
  const std::vector<double> times = history.column(history.channels().front().name);
  if (times.size() < 2) {
    history.truncate_after(time);
    return;
  }
  const auto later = std::upper_bound(times.begin(), times.end(), time);
  const std::size_t last =
      std::clamp<std::size_t>(std::size_t(later - times.begin()), 2, times.size()) - 1;
  const double spacing = times[last] - times[last - 1];
  history.truncate_after(time + 1e-9 * spacing);
  if (history.size() == times.size() && time - times.back() > (1.0 - 1e-6) * spacing)
    throw Error(
        fmt::format("{}: ends at t = {:.9g} s but the run continues from t = {:.9g} s: rows "
                    "between are missing; "
                    "continue from an earlier checkpoint, or name another file",
                    path, times.back(), time));
}

}  // namespace

HistoryFile::HistoryFile(std::string path, History history)
    : path_(std::move(path)), history_(std::move(history)), last_flush_(Clock::now()) {}

HistoryFile HistoryFile::create(const std::string& path, const std::vector<Channel>& channels,
                                const RunInfo& info) {
  if (channels.empty()) throw Error(fmt::format("{}: a history needs channels", path));
  replace_file(path, [&](const std::string& part) {
    Hdf5File file(part, Hdf5File::Mode::create);
    file.create_group("/run");
    file.set_attribute("/run", "title", info.title);
    file.set_attribute("/run", "version", info.version);
    file.set_attribute("/run", "script", info.script);
    file.set_attribute("/run", "started", info.started.empty() ? utc_now() : info.started);
    file.set_attribute("/run", "ranks", info.ranks);
    file.write("/run/effective_input", info.effective_input);
    file.write("/run/styles", styles_json(info.styles));
    file.create_group("/history");
    for (const Channel& channel : channels) {
      file.create_growing(dataset_of(channel));
      file.set_attribute(dataset_of(channel), "unit", channel.unit);
      file.set_attribute(dataset_of(channel), "meaning", channel.meaning);
    }
    file.close();
  });
  return HistoryFile(path, History(channels));
}

HistoryFile HistoryFile::resume(const std::string& path, const std::vector<Channel>& channels,
                                double time) {
  if (!std::filesystem::exists(path))
    throw InputError(
        path, "is not there, and the run is to be continued from a checkpoint",
        "the results of the first run, to which rows are added",
        "start where that run was started, bring its folder here, or name a new folder");
  History history = read_rows(Hdf5File(path, Hdf5File::Mode::read));
  check_channels(path, history.channels(), channels);
  cut_at(path, history, time);

  HistoryFile file(path, std::move(history));
  file.flushed_rows_ = file.history_.size();
  file.replace_with([&](Hdf5File& content) {
    for (const Channel& channel : channels)
      content.truncate(dataset_of(channel), file.flushed_rows_);
    for (const char* ending :
         {"/grains/final", "/surface", "/terrain", "/rut", "/audit", "/cost", "/warnings"})
      content.remove(ending);
  });
  return file;
}

HistoryFile::~HistoryFile() {
  if (flushed_rows_ >= history_.size()) return;
  try {
    flush();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "the last rows of the history are lost: %s\n", error.what());
  }
}

template <class Change>
void HistoryFile::replace_with(Change change) {
  replace_file(path_, [&](const std::string& part) {
    std::error_code failed;
    fs::copy_file(path_, part, fs::copy_options::overwrite_existing, failed);
    if (failed)
      throw Error(fmt::format("{}: cannot be copied to {} ({})", path_, part, failed.message()));
    Hdf5File file(part, Hdf5File::Mode::edit);
    change(file);
    file.close();
  });
}

void HistoryFile::append(const std::vector<double>& row) {
  const std::vector<Channel>& channels = history_.channels();
  for (std::size_t i = 0; i < std::min(row.size(), channels.size()); ++i)
    if (!std::isfinite(row[i]))
      throw StateError(
          fmt::format("{}: {} is {} at t = {:.9g} s", path_, channels[i].name, row[i], row[0]));
  if (!row.empty() && history_.size() > 0 && row[0] <= history_.at(history_.size() - 1, 0))
    throw StateError(fmt::format("{}: a row of t = {:.9g} s follows one of t = {:.9g} s", path_,
                                 row[0], history_.at(history_.size() - 1, 0)));
  history_.append(row);
  if (seconds_since(last_flush_) >= std::max(flush_interval, least_flush_ratio * flush_duration_))
    flush();
}

void HistoryFile::flush() {
  const Clock::time_point start = Clock::now();
  if (flushed_rows_ < history_.size()) {
    replace_with([&](Hdf5File& file) {
      std::vector<double> column(history_.size() - flushed_rows_);
      for (std::size_t j = 0; j < history_.channels().size(); ++j) {
        for (std::size_t i = 0; i < column.size(); ++i)
          column[i] = history_.at(flushed_rows_ + i, j);
        file.append(dataset_of(history_.channels()[j]), column);
      }
    });
    flushed_rows_ = history_.size();
    flush_duration_ = seconds_since(start);
  }
  last_flush_ = Clock::now();
}

void HistoryFile::write_reference(const Grains& grains) {
  grains.check();
  replace_with([&](Hdf5File& file) { write_grains(file, "/grains/reference", grains, false); });
}

void HistoryFile::write_final(const Grains& grains, const Surface& surface) {
  grains.check();
  replace_with([&](Hdf5File& file) {
    if (grains.size() > 0) write_grains(file, "/grains/final", grains, true);
    if (surface.triangle_count() > 0) {
      file.create_group("/surface");
      file.write("/surface/triangles", surface.triangles);
      file.write("/surface/x", surface.x);
      file.set_attribute("/surface/x", "unit", "m");
    }
  });
}

void HistoryFile::write_terrain(const TerrainSnapshot& terrain, const std::vector<RutPoint>& rut) {
  replace_with([&](Hdf5File& file) {
    for (const char* group : {"/terrain", "/rut"}) {
      file.remove(group);
      file.create_group(group);
    }
    const auto write = [&](const std::string& dataset, const auto& values, const char* unit,
                           const char* meaning) {
      file.write(dataset, values);
      file.set_attribute(dataset, "unit", unit);
      file.set_attribute(dataset, "meaning", meaning);
    };
    for (const auto& field : vector_terrain_fields)
      write(fmt::format("/terrain/{}", field.name), terrain.*field.values, field.unit,
            field.meaning);
    for (const auto& field : scalar_terrain_fields)
      write(fmt::format("/terrain/{}", field.name), terrain.*field.values, field.unit,
            field.meaning);
    Matrix3X x(3, Eigen::Index(rut.size()));
    std::vector<double> density;
    for (const RutPoint& point : rut) {
      x.col(Eigen::Index(density.size())) << point.x, point.y, point.z;
      density.push_back(point.density);
    }
    write("/rut/x", x, "m", "surface of the terrain where it was dropped behind");
    write("/rut/density", density, "kg/m^3", "mean over the depth there");
  });
}

void HistoryFile::write_closing(const RunClosing& closing) {
  replace_with([&](Hdf5File& file) {
    file.remove("/audit");
    file.create_group("/audit");
    for (const auto& [name, member] : audit_numbers)
      file.set_attribute("/audit", name, closing.audit.*member);
    std::vector<double> energies;
    std::vector<std::string> terms;
    for (const EnergyTerm& term : closing.audit.energies) {
      energies.push_back(term.value);
      terms.push_back(term.name);
    }
    file.write("/audit/energies", energies);
    file.set_attribute("/audit/energies", "terms", join_lines(terms));
    file.set_attribute("/audit/energies", "unit", "J");

    file.remove("/cost");
    file.create_group("/cost");
    file.set_attribute("/cost", "wall_time", closing.cost.wall_time);
    file.set_attribute("/cost", "simulated_time", closing.cost.simulated_time);
    file.set_attribute("/cost", "steps", double(closing.cost.steps));
    file.set_attribute("/cost", "grains", double(closing.cost.grains));
    file.set_attribute("/cost", "ranks", closing.cost.ranks);
    file.set_attribute("/cost", "memory", closing.cost.memory);
    file.write("/warnings", join_lines(closing.warnings));
  });
}

History read_history(const std::string& path) {
  const History read = read_rows(Hdf5File(path, Hdf5File::Mode::read));
  std::vector<Channel> channels = read.channels();
  for (Channel& channel : channels)
    if (channel.name == former_stage_channel) channel.name = stage_channel;
  return read.renamed(channels);
}

RunInfo read_run_info(const std::string& path) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  if (!file.exists("/run"))
    throw Error(fmt::format("{}: has no /run; is it a results file of Furrow?", path));
  RunInfo info;
  info.title = file.text_attribute("/run", "title");
  info.version = file.text_attribute("/run", "version");
  info.script = file.text_attribute("/run", "script");
  info.started = file.text_attribute("/run", "started");
  info.ranks = int(file.number_attribute("/run", "ranks"));
  info.effective_input = file.read_text("/run/effective_input");
  return info;
}

Grains read_reference_grains(const std::string& path) {
  return read_grains(path, "/grains/reference");
}
Grains read_final_grains(const std::string& path) { return read_grains(path, "/grains/final"); }

bool has_closing(const std::string& path) {
  return Hdf5File(path, Hdf5File::Mode::read).exists("/cost");
}

RunClosing read_closing(const std::string& path) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  if (!file.exists("/cost"))
    throw Error(fmt::format("{}: has no /cost; the run did not come to its end", path));
  RunClosing closing;
  for (const auto& [name, member] : audit_numbers)
    closing.audit.*member = file.number_attribute("/audit", name);
  const std::vector<double> energies = file.read_numbers("/audit/energies");
  const std::vector<std::string> terms =
      split_lines(file.text_attribute("/audit/energies", "terms"));
  if (energies.size() != terms.size())
    throw Error(fmt::format("{}: /audit/energies and its names differ in number", path));
  for (std::size_t i = 0; i < terms.size(); ++i)
    closing.audit.energies.push_back({terms[i], energies[i]});
  closing.cost.wall_time = file.number_attribute("/cost", "wall_time");
  closing.cost.simulated_time = file.number_attribute("/cost", "simulated_time");
  closing.cost.steps = std::lround(file.number_attribute("/cost", "steps"));
  closing.cost.grains = std::lround(file.number_attribute("/cost", "grains"));
  closing.cost.ranks = int(file.number_attribute("/cost", "ranks"));
  closing.cost.memory = file.number_attribute("/cost", "memory");
  closing.warnings = split_lines(file.read_text("/warnings"));
  return closing;
}

}  // namespace furrow
