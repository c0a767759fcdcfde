// SPDX-License-Identifier: GPL-2.0-or-later
#include "fuzz.h"
#include "furrow/io/formats/csv_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const furrow::fuzz::InputFolder folder;
  const std::string path = folder.write("data/input.csv", data, size);
  furrow::fuzz::read_or_refuse<furrow::InputError>([&] {
    const furrow::CsvTable table = furrow::CsvTable::read(path);
    for (const std::string& name : table.names()) table.numbers(name);
  });
  return 0;
}
