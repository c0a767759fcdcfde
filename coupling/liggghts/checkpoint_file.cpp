// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/checkpoint_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "comm.h"
#include "furrow/core/communicator.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "furrow/io/files/file_lock.h"
#include "furrow/io/files/sealed_file.h"

namespace furrow::coupling {

namespace {

namespace fs = std::filesystem;

/// A file in memory, under a name that fopen() takes.
class MemoryFile {
 public:
  MemoryFile() : handle_(memfd_create("checkpoint", MFD_CLOEXEC)) {
    if (handle_ < 0)
      throw Error(fmt::format("a checkpoint cannot be gathered: {}", std::strerror(errno)));
  }
  ~MemoryFile() { close(handle_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return fmt::format("/proc/self/fd/{}", handle_); }
  void copy_to(SealedFile& file) const {
    std::vector<char> block(1 << 20);
    off_t position = 0;
    for (ssize_t count; (count = pread(handle_, block.data(), block.size(), position)) != 0;
         position += count) {
      if (count < 0) throw Error(fmt::format("a checkpoint is lost: {}", std::strerror(errno)));
      file.write(block.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  int handle_;
};

/// Every restart file of LIGGGHTS begins with the flag of its version, 0, the length of that text,
/// and the text.
bool begins_as_restart_file(const std::string& path) {
  struct {
    int flag = -1, length = 0;
    char text[7] = {};
  } head;
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(&head.flag), sizeof head.flag);
  file.read(reinterpret_cast<char*>(&head.length), sizeof head.length);
  file.read(head.text, sizeof head.text);
  return file && head.flag == 0 && head.length > 7 && std::memcmp(head.text, "Version", 7) == 0;
}

std::string path_being_written, path_read, set_name;

fs::path particle_folder(const std::string& checkpoint) { return checkpoint + ".particles"; }

/// Locks of the restart files that this process replaces again and again.
std::map<std::string, FileLock>& own_locks() {
  static std::map<std::string, FileLock> locks;
  return locks;
}

void keep_lock(const LAMMPS_NS::LAMMPS& lammps, const std::string& path, FileLock lock) {
  const std::vector<std::string> names = checkpoint_names(lammps);
  if (std::count(names.begin(), names.end(), path)) own_locks()[path] = std::move(lock);
}

constexpr std::size_t digits_of_set = 16;

std::string new_set() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

bool is_of_a_set(const std::string& name) {
  return name.size() > digits_of_set && name[digits_of_set] == '.' &&
         name.find_first_not_of("0123456789abcdef") == digits_of_set;
}

/// Removes the files of one set, or those of all others: of former checkpoints of this name, and of
/// one that a kill has cut short.
void remove_sets(const std::string& checkpoint, const std::string& set, bool others) {
  std::error_code ignored;
  const fs::path folder = particle_folder(checkpoint);
  std::vector<fs::path> unwanted;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (is_of_a_set(name) && (name.compare(0, digits_of_set, set) != 0) == others)
      unwanted.push_back(entry->path());
  }
  for (const fs::path& file : unwanted) fs::remove(file, ignored);
  if (!unwanted.empty()) fs::remove(folder, ignored);  // removes an empty folder only
}

/// Marks a file while LIGGGHTS writes it.
class BeingWritten {
 public:
  BeingWritten(const std::string& path, const std::string& set) {
    path_being_written = path;
    set_name = set;
  }
  ~BeingWritten() {
    path_being_written.clear();
    set_name.clear();
  }
  BeingWritten(const BeingWritten&) = delete;
  BeingWritten& operator=(const BeingWritten&) = delete;
};

[[noreturn]] void refuse(const std::string& path, const std::string& problem,
                         const std::string& remedy) {
  throw InputError(fmt::format("checkpoint '{}'", path), problem,
                   "a whole restart file that furrow wrote", remedy);
}

constexpr char remedy_of_path[] =
    "give the path of a checkpoint, from the folder in which furrow is started";
constexpr char remedy_of_damage[] = "continue from another one, or start from the beginning";

/// The number in a name that a pattern "ck.*" means; nothing for another name.
std::optional<long> step_in(const std::string& name, const std::string& before,
                            const std::string& after) {
  if (name.size() <= before.size() + after.size() || name.compare(0, before.size(), before) != 0 ||
      name.compare(name.size() - after.size(), after.size(), after) != 0)
    return std::nullopt;
  const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
  if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 18)
    return std::nullopt;
  return std::atol(digits.c_str());
}

std::string latest(const std::string& pattern) {
  const std::size_t star = pattern.find('*'), slash = pattern.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  if (star < name) refuse(pattern, "has a '*' in its folder", "write '*' in the file's own name");
  const std::string before = pattern.substr(name, star - name), after = pattern.substr(star + 1);
  const fs::path folder = name == 0 ? "." : pattern.substr(0, name);
  std::error_code failed;
  std::optional<long> last;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed))
    if (const auto step = step_in(entry->path().filename().string(), before, after))
      last = std::max(last.value_or(*step), *step);
  if (failed) refuse(pattern, "cannot be searched: " + failed.message(), remedy_of_path);
  if (!last) refuse(pattern, "matches no file", remedy_of_path);
  return fmt::format("{}{}{}", pattern.substr(0, star), *last, after);
}

}  // namespace

void write_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path,
                      const std::function<void(char* name)>& write) {
  if (path.find('%') != std::string::npos)
    throw InputError(fmt::format("restart file '{}'", path),
                     "has '%', which means one file per rank", "a name without %",
                     "one file holds the grains of all ranks");
  std::optional<MemoryFile> memory;  // on rank 0
  on_first_rank(lammps.world, [&] {
    std::error_code absent;
    if (const fs::file_status there = fs::status(path, absent);
        fs::exists(there) && !fs::is_regular_file(there))
      throw InputError(fmt::format("restart file '{}'", path),
                       fs::is_directory(there) ? "is a folder" : "is a device or a pipe",
                       "a file, which a checkpoint may replace", "choose another name");
    if (fs::is_regular_file(path, absent) && fs::file_size(path, absent) > 0 &&
        !begins_as_restart_file(path))
      throw InputError(fmt::format("restart file '{}'", path),
                       "would replace a file of another kind",
                       "a name that is free, or that of a checkpoint", "choose another name");
    own_locks().erase(path);
    const SealedFile can_be_written(path);  // before the work, in which an error may end the run
    memory.emplace();
  });
  std::string name = memory ? memory->name() : "";
  const std::string set = broadcast(memory ? new_set() : "", lammps.world);
  {
    const BeingWritten files(path, set);
    write(name.data());
  }
  on_first_rank(lammps.world, [&] {
    try {
      SealedFile file(path);
      memory->copy_to(file);
      keep_lock(lammps, path, file.close());
    } catch (const Error&) {
      remove_sets(path, set, false);
      throw;
    }
    remove_sets(path, set, true);
  });
}

const std::string& set_being_written() { return set_name; }

std::unique_ptr<RankFiles> rank_files(const LAMMPS_NS::LAMMPS& lammps, const std::string& set,
                                      const std::string& fix) {
  const std::string& checkpoint = path_being_written.empty() ? path_read : path_being_written;
  return std::make_unique<RankFiles>(
      (particle_folder(checkpoint) / fmt::format("{}.{}", set, fix)).string(), lammps.comm->me);
}

void close_rank_files(const LAMMPS_NS::LAMMPS& lammps, RankFiles& files) {
  const std::string failure = files.close();
  const Communicator ranks(&lammps.world);
  const auto failed = static_cast<int>(ranks.max(failure.empty() ? -1.0 : ranks.rank()));
  if (failed < 0) return;
  if (ranks.rank() == 0) remove_sets(path_being_written, set_name, false);
  throw Error(broadcast(failure, lammps.world, failed));
}

std::uintmax_t bytes_of_checkpoint(const std::string& path) {
  std::error_code absent;
  std::vector<fs::path> files = {path};
  for (fs::directory_iterator entry(particle_folder(path), absent), end; !absent && entry != end;
       entry.increment(absent))
    files.push_back(entry->path());
  std::uintmax_t bytes = 0;
  for (const fs::path& file : files)
    if (const std::uintmax_t size = fs::file_size(file, absent); !absent) bytes += size;
  return bytes;
}

bool belongs_to_another_run(const std::string& path) {
  return own_locks().count(path) == 0 && is_locked(path);
}

void note_checkpoint_read(const std::string& path) { path_read = path; }
const std::string& checkpoint_read() { return path_read; }

std::string find_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path) {
  if (path.find('*') == std::string::npos) return path;
  std::string found;
  on_first_rank(lammps.world, [&] { found = latest(path); });
  return broadcast(found, lammps.world);
}

void check_checkpoint(LAMMPS_NS::LAMMPS& lammps, const std::string& path) {
  on_first_rank(lammps.world, [&] {
    const SealCheck check = check_seal(path);
    switch (check.state) {
      case SealCheck::State::whole:
        if (!begins_as_restart_file(path)) refuse(path, "is no restart file", remedy_of_path);
        return;
      case SealCheck::State::unreadable:
        refuse(path, check.problem, remedy_of_path);
      case SealCheck::State::damaged:
        refuse(path, check.problem, remedy_of_damage);
      case SealCheck::State::unsealed:
        if (!begins_as_restart_file(path))
          refuse(path, check.problem + " and is no restart file", remedy_of_path);
        refuse(path,
               check.problem + ": it is cut short, or stock LIGGGHTS or an older Furrow wrote it",
               fmt::format("continue from another one, or, if it is known to be whole, write "
                           "'read_restart {} unchecked'",
                           path));
    }
  });
}

void check_restart_file(LAMMPS_NS::LAMMPS& lammps, const std::string& path) {
  on_first_rank(lammps.world, [&] {
    std::string file = path;
    if (const std::size_t percent = file.find('%'); percent != std::string::npos)
      file.replace(percent, 1, "base");
    const SealCheck check = check_seal(file);
    if (check.state == SealCheck::State::unreadable) refuse(file, check.problem, remedy_of_path);
    if (!begins_as_restart_file(file)) refuse(file, "is no restart file", remedy_of_path);
  });
}

}  // namespace furrow::coupling
