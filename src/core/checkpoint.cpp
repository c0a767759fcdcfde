// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/checkpoint.h"

#include <cstring>

#include <fmt/format.h>

#include "furrow/core/checksum.h"
#include "furrow/core/error.h"

namespace furrow {

namespace {

struct Header {
  char magic[8] = {'F', 'u', 'r', 'r', 'o', 'w', 'C', 'P'};
  std::uint64_t version = 1;
  std::uint64_t length = 0;    // of what follows [bytes]
  std::uint64_t checksum = 0;  // of what follows
};

std::uint64_t checksum(const std::vector<char>& bytes) {
  Checksum sum;
  sum.add(bytes.data(), bytes.size());
  return sum.value();
}

constexpr char remedy[] = "continue with the input and the program of the first run";

[[noreturn]] void refuse(const std::string& owner, const std::string& problem) {
  throw Error(fmt::format("{}: its part of the checkpoint {}; {}", owner, problem, remedy));
}

Header read_header(const std::string& owner, const char* bytes) {
  const Header expected;
  Header header;
  std::memcpy(&header, bytes, sizeof header);
  if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0)
    refuse(owner, "was not written by this version of Furrow, or is damaged");
  if (header.version != expected.version)
    refuse(owner, fmt::format("has format {}, and this program reads format {}", header.version,
                              expected.version));
  return header;
}

}  // namespace

Checkpoint::Checkpoint(std::string owner, const char* bytes, std::size_t size)
    : owner_(std::move(owner)), saving_(false) {
  if (size < sizeof(Header)) refuse("is cut short");
  const Header header = read_header(owner_, bytes);
  if (header.length != size - sizeof header)
    refuse(fmt::format("has {} bytes of {}", size - sizeof header, header.length));
  data_.assign(bytes + sizeof header, bytes + size);
  if (checksum(data_) != header.checksum) refuse("is damaged");
}

std::size_t Checkpoint::size(const std::string& owner, const char* bytes) {
  return sizeof(Header) + static_cast<std::size_t>(read_header(owner, bytes).length);
}

void Checkpoint::refuse(const std::string& problem) const { furrow::refuse(owner_, problem); }

void Checkpoint::put(const std::string& name, Kind kind, const void* data, std::uint64_t count,
                     std::size_t size) {
  const auto add = [&](const void* from, std::size_t length) {
    const auto* first = static_cast<const char*>(from);
    data_.insert(data_.end(), first, first + length);
  };
  const std::uint64_t length = name.size();
  add(&length, sizeof length);
  add(name.data(), name.size());
  add(&kind, sizeof kind);
  add(&count, sizeof count);
  add(data, static_cast<std::size_t>(count) * size);
}

const char* Checkpoint::read(std::size_t size) {
  if (size > data_.size() - next_) refuse("ends too early");
  const char* at = data_.data() + next_;
  next_ += size;
  return at;
}

const char* Checkpoint::take(const std::string& name, Kind kind, std::uint64_t& count,
                             std::size_t size) {
  std::uint64_t length = 0;
  std::memcpy(&length, read(sizeof length), sizeof length);
  if (length > data_.size()) refuse("is damaged");
  const std::string found(read(static_cast<std::size_t>(length)), static_cast<std::size_t>(length));
  Kind found_kind = kind;
  std::memcpy(&found_kind, read(sizeof found_kind), sizeof found_kind);
  std::memcpy(&count, read(sizeof count), sizeof count);
  if (found != name || found_kind != kind)
    refuse(fmt::format("has '{}' where '{}' is expected", found, name));
  if (count > data_.size() / size) refuse("is damaged");
  return read(static_cast<std::size_t>(count) * size);
}

void Checkpoint::values(const std::string& name, double* first, std::size_t count) {
  if (saving_) return put(name, Kind::numbers, first, count, sizeof *first);
  std::uint64_t found = 0;
  const char* data = take(name, Kind::numbers, found, sizeof *first);
  if (found != count)
    refuse(fmt::format("has {} numbers of '{}' instead of {}", found, name, count));
  if (count > 0) std::memcpy(first, data, count * sizeof *first);
}

void Checkpoint::values(const std::string& name, std::vector<double>& numbers) {
  if (saving_) return put(name, Kind::numbers, numbers.data(), numbers.size(), sizeof(double));
  std::uint64_t found = 0;
  const char* data = take(name, Kind::numbers, found, sizeof(double));
  numbers.resize(static_cast<std::size_t>(found));
  if (found > 0) std::memcpy(numbers.data(), data, numbers.size() * sizeof(double));
}

void Checkpoint::value(const std::string& name, std::int64_t& number) {
  if (saving_) return put(name, Kind::integer, &number, 1, sizeof number);
  std::uint64_t found = 0;
  const char* data = take(name, Kind::integer, found, sizeof number);
  if (found != 1) refuse(fmt::format("has {} numbers of '{}' instead of one", found, name));
  std::memcpy(&number, data, sizeof number);
}

void Checkpoint::value(const std::string& name, int& number) {
  std::int64_t wide = number;
  value(name, wide);
  number = static_cast<int>(wide);
}

void Checkpoint::value(const std::string& name, bool& flag) {
  std::int64_t number = flag ? 1 : 0;
  value(name, number);
  flag = number != 0;
}

void Checkpoint::value(const std::string& name, std::string& text) {
  if (saving_) return put(name, Kind::text, text.data(), text.size(), 1);
  std::uint64_t found = 0;
  const char* data = take(name, Kind::text, found, 1);
  text.assign(data, static_cast<std::size_t>(found));
}

void Checkpoint::match(const std::string& name, double number) {
  double saved = number;
  value(name, saved);
  if (saved != number)
    throw Error(fmt::format("{}: {} is {:.6g}, and was {:.6g} when the checkpoint was written; {}",
                            owner_, name, number, saved, remedy));
}

void Checkpoint::match(const std::string& name, const std::string& text) {
  std::string saved = text;
  value(name, saved);
  if (saved != text)
    throw Error(fmt::format("{}: {} is '{}', and was '{}' when the checkpoint was written; {}",
                            owner_, name, text, saved, remedy));
}

std::vector<char> Checkpoint::bytes() const {
  Header header;
  header.length = data_.size();
  header.checksum = checksum(data_);
  std::vector<char> all(sizeof header + data_.size());
  std::memcpy(all.data(), &header, sizeof header);
  if (!data_.empty()) std::memcpy(all.data() + sizeof header, data_.data(), data_.size());
  return all;
}

Checkpoint Checkpoint::reread() const {
  Checkpoint copy = *this;
  copy.saving_ = false;
  copy.next_ = 0;
  return copy;
}

void Checkpoint::finish() const {
  if (next_ != data_.size()) refuse("contains more than this program reads");
}

}  // namespace furrow
