// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/history_file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>

#include "furrow/core/error.h"
#include "furrow/io/results/closing_group.h"
#include "furrow/io/results/grains_group.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/results/history_rows.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/formats/terrain_fields.h"
#include "furrow/statistics/rig_stage.h"

namespace furrow {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double flush_interval = 5.0;  // [s] between flushes that come by themselves
constexpr double minimum_flush_ratio =
    100.0;  // least ratio of the flush interval to the duration of a flush
// former and present name of a channel
constexpr std::pair<const char*, const char*> former_channels[] = {{"phase", stage_channel},
                                                                   {"sinkage", hub_drop_channel}};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
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

/// Drops the rows after a time, and refuses a file that ends before it.
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

HistoryFile::HistoryFile(std::string path, const std::vector<Channel>& channels)
    : path_(std::move(path)), rows_(channels), last_flush_(Clock::now()) {}

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
  return HistoryFile(path, channels);
}

HistoryFile HistoryFile::resume(const std::string& path, const std::vector<Channel>& channels,
                                double time) {
  if (!std::filesystem::exists(path))
    throw InputError(
        path, "is not there, and the run is to be continued from a checkpoint",
        "the results of the first run, to which rows are added",
        "start where that run was started, bring its folder here, or name a new folder");
  const Hdf5File before(path, Hdf5File::Mode::read);
  History history = read_rows(before);
  check_channels(path, history.channels(), channels);
  cut_at(path, history, time);

  HistoryFile file(path, channels);
  if (before.exists("/grains/final") && before.exists("/grains/final/virial"))
    file.final_ = read_grains(before, "/grains/final");
  file.flushed_rows_ = history.size();
  if (history.size() > 0) file.last_time_ = history.at(history.size() - 1, 0);
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
  if (rows_.size() == 0) return;
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
    if (failed) {
      // On a full disk the library reports an error of input and output.
      std::error_code unknown;
      const auto room = fs::space(fs::path(path_).parent_path(), unknown).available;
      const bool full = !unknown && room < fs::file_size(path_, unknown);
      throw Error(fmt::format("{}: cannot be copied to {} ({})", path_, part,
                              full ? "No space left on device" : failed.message()));
    }
    Hdf5File file(part, Hdf5File::Mode::edit);
    change(file);
    file.close();
  });
}

void HistoryFile::append(const std::vector<double>& row) {
  const std::vector<Channel>& channels = rows_.channels();
  for (std::size_t i = 0; i < std::min(row.size(), channels.size()); ++i)
    if (!std::isfinite(row[i]))
      throw StateError(
          fmt::format("{}: {} is {} at t = {:.9g} s", path_, channels[i].name, row[i], row[0]));
  if (!row.empty() && last_time_ && row[0] <= *last_time_)
    throw StateError(fmt::format("{}: a row of t = {:.9g} s follows one of t = {:.9g} s", path_,
                                 row[0], *last_time_));
  rows_.append(row);
  last_time_ = row[0];
  if (seconds_since(last_flush_) >= std::max(flush_interval, minimum_flush_ratio * flush_duration_))
    flush();
}

void HistoryFile::flush() {
  const Clock::time_point start = Clock::now();
  if (rows_.size() > 0) {
    replace_with([&](Hdf5File& file) {
      for (const Channel& channel : rows_.channels())
        file.append(dataset_of(channel), rows_.column(channel.name));
    });
    flushed_rows_ += rows_.size();
    rows_.clear();
    flush_duration_ = seconds_since(start);
  }
  last_flush_ = Clock::now();
}

void HistoryFile::write_reference(const Grains& grains) {
  grains.check();
  replace_with([&](Hdf5File& file) { write_grains(file, "/grains/reference", grains, false); });
}

void HistoryFile::write_final(Grains grains, const Surface& surface) {
  grains.check();
  if (grains.virial.cols() == 0 && grains.id == final_.id && grains.x == final_.x &&
      grains.v == final_.v)
    grains.virial = final_.virial;
  replace_with([&](Hdf5File& file) {
    if (grains.size() > 0) write_grains(file, "/grains/final", grains, true);
    if (surface.triangle_count() > 0) {
      file.create_group("/surface");
      file.write("/surface/triangles", surface.triangles);
      file.write("/surface/x", surface.x);
      file.set_attribute("/surface/x", "unit", "m");
    }
  });
  if (grains.virial.cols() > 0) final_ = std::move(grains);
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
  replace_with([&](Hdf5File& file) { furrow::write_closing(file, closing); });
}

History read_history(const std::string& path) {
  History history = read_rows(Hdf5File(path, Hdf5File::Mode::read));
  for (const auto& [former, name] : former_channels) history.rename(former, name);
  return history;
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
  return read_grains(Hdf5File(path, Hdf5File::Mode::read), "/grains/reference");
}
Grains read_final_grains(const std::string& path) {
  return read_grains(Hdf5File(path, Hdf5File::Mode::read), "/grains/final");
}

bool has_closing(const std::string& path) {
  return Hdf5File(path, Hdf5File::Mode::read).exists("/cost");
}

RunClosing read_closing(const std::string& path) {
  return read_closing(Hdf5File(path, Hdf5File::Mode::read));
}

}  // namespace furrow
