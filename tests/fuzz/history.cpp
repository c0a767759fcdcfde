// SPDX-License-Identifier: GPL-2.0-or-later
// The results file of a run: made-up bytes, beginning from those of a whole file, and sound HDF5
// files that hold other things than they should.
#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <vector>

#include "fuzz.h"
#include "furrow/io/formats/hdf5_file.h"
#include "furrow/io/results/history_file.h"

namespace {

using namespace furrow;

void write_whole_file(const std::string& path) {
  const std::vector<Channel> channels = {{"time", "s", "simulated"},
                                         {"force_x", "N", "of the ground"}};
  HistoryFile file = HistoryFile::create(path, channels, RunInfo());
  for (int i = 0; i < 20; ++i) file.append({0.1 * i, 1.0 / (1 + i)});
  Grains grains;
  grains.id = {1, 2};
  grains.x = Matrix3X::Random(3, 2);
  grains.v = Matrix3X::Zero(3, 2);
  grains.radius = VectorX::Constant(2, 0.01);
  file.write_reference(grains);
  file.flush();
  file.write_closing(RunClosing());
}

void read_all(const std::string& path) {
  fuzz::read_or_refuse<Error>([&] { read_history(path); });
  fuzz::read_or_refuse<Error>([&] { read_run_info(path); });
  fuzz::read_or_refuse<Error>([&] { read_reference_grains(path); });
  fuzz::read_or_refuse<Error>([&] { read_final_grains(path); });
  fuzz::read_or_refuse<Error>([&] {
    if (has_closing(path)) read_closing(path);
  });
}

/// Replaces an object of a whole file by something else, or takes it away.
void alter(FuzzedDataProvider& input, Hdf5File& file) {
  const std::string object = input.PickValueInArray(
      {"/history", "/history/time", "/history/force_x", "/history/more", "/run",
       "/run/effective_input", "/run/styles", "/grains", "/grains/reference",
       "/grains/reference/id", "/grains/reference/x", "/grains/reference/radius",
       "/grains/reference/period", "/audit", "/audit/energies", "/cost", "/warnings"});
  const std::string attribute = input.PickValueInArray(
      {"unit", "meaning", "title", "ranks", "started", "bed_level", "terms", "wall_time", "steps"});
  const auto length = [&] { return input.ConsumeIntegralInRange<std::size_t>(0, 30); };
  const auto present = [&] { return file.exists(object); };
  switch (input.ConsumeIntegralInRange(0, 6)) {
    case 0:
      return file.remove(object);
    case 1:
      return file.write(object,
                        std::vector<double>(length(), input.ConsumeFloatingPoint<double>()));
    case 2:
      return file.write(object, std::vector<std::int64_t>(length(), input.ConsumeIntegral<long>()));
    case 3:
      return file.write(object, Matrix3X(Matrix3X::Constant(3, Eigen::Index(length()),
                                                            input.ConsumeFloatingPoint<double>())));
    case 4:
      return file.write(object, input.ConsumeRandomLengthString(100));
    case 5:
      return present() ? file.set_attribute(object, attribute, input.ConsumeFloatingPoint<double>())
                       : file.create_group(object);
    default:
      if (present()) file.set_attribute(object, attribute, input.ConsumeRandomLengthString(100));
  }
}

}  // namespace

/// A first input, which libFuzzer then finds in its folder.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  write_whole_file(FURROW_FUZZ_CORPUS "/whole.h5");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  read_all(folder.write("bytes.h5", data, size));

  static const std::string whole = [] {
    write_whole_file(folder.path("whole.h5"));
    return folder.path("whole.h5");
  }();
  const std::string path = folder.path("altered.h5");
  std::filesystem::copy_file(whole, path, std::filesystem::copy_options::overwrite_existing);
  FuzzedDataProvider input(data, size);
  fuzz::read_or_refuse<Error>([&] {
    Hdf5File file(path, Hdf5File::Mode::edit);
    for (int changes = input.ConsumeIntegralInRange(1, 5); changes > 0; --changes)
      alter(input, file);
    file.close();
  });
  read_all(path);
  return 0;
}
