// SPDX-License-Identifier: GPL-2.0-or-later
// The words of a script line, read by keys of every kind: numbers, lists, choices, flags, former
// names; and as flat keys of a material.
#include <sstream>
#include <vector>

#include "furrow/core/options/options.h"
#include "fuzz.h"
#include "furrow/io/inputs/terrain_input.h"
#include "furrow/material/registry.h"

namespace {

furrow::Schema schema_of_every_kind() {
  furrow::Schema schema = furrow::terrain_schema("fix terrain/continuum");
  schema.numbers("list", 0, "m", furrow::Range::any(), "any number of numbers").optional();
  schema.alias("bed", "surface");
  schema.alias("whole", "symmetry", furrow::inverted_flag);
  return schema;
}

/// Every value that passed is asked for as what it was declared.
void use(const furrow::Options& options) {
  for (const furrow::Key& key : options.keys()) {
    if (!options.has(key.name)) continue;
    if (key.kind == furrow::Key::Kind::integer) options.integer(key.name);
    if (key.kind == furrow::Key::Kind::number) options.number(key.name);
    if (key.kind == furrow::Key::Kind::numbers) options.numbers(key.name);
    if (key.kind == furrow::Key::Kind::flag) options.flag(key.name);
  }
}

}  // namespace

/// First inputs, which libFuzzer then finds in its folder: a line with every key, and the laws'
/// examples.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  std::ofstream line(FURROW_FUZZ_CORPUS "/terrain");
  const furrow::Schema schema = schema_of_every_kind();
  for (const furrow::Key& key : schema.keys())
    line << key.name << ' ' << (key.choices.empty() ? "1" : key.choices.front()) << ' ';
  for (const furrow::MaterialModel& model : furrow::material_models())
    for (const std::string& example : model.examples)
      std::ofstream(std::string(FURROW_FUZZ_CORPUS "/") + model.name) << example;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const furrow::Schema schema = schema_of_every_kind();
  std::istringstream line(std::string(reinterpret_cast<const char*>(data), size));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  furrow::fuzz::read_or_refuse<furrow::InputError>([&] { use(schema.read(words)); });

  std::vector<furrow::Entry> entries;  // a word that begins with a digit or a sign is a value
  for (const std::string& word : words) {
    if (!entries.empty() &&
        (entries.back().values.empty() || word.find_first_of("-.0123456789") == 0))
      entries.back().values.push_back(word);
    else
      entries.push_back({word, {}});
  }
  for (const furrow::MaterialModel& model : furrow::material_models())
    furrow::fuzz::read_or_refuse<furrow::InputError>([&] { make_material(model, entries); });
  return 0;
}
