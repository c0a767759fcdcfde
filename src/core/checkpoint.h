// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// State of a part of a run as named, sized values, as a checkpoint file stores it.
///
/// One function of a class declares its state; it both saves and restores:
///   void RigidWheel::checkpoint(Checkpoint& state) {
///     state.match("mass", parameters_.mass);     // must be the same when the run continues
///     state.values("centre", centre_);           // is brought back
///   }
/// Names, kinds and lengths are stored with the values and checked when they are read. A checkpoint
/// of another program version or scene is an error that names the value. Lengths are 64-bit
/// integers; values have the byte order of the processor.

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

class Checkpoint {
 public:
  /// Begins a checkpoint for saving. @param owner names the part in errors: "fix wheel"
  explicit Checkpoint(std::string owner) : owner_(std::move(owner)) {}
  /// Begins to restore a checkpoint. @param bytes result of bytes(); copied
  /// @throws Error for bytes that no Checkpoint wrote, that are cut short or were altered
  Checkpoint(std::string owner, const char* bytes, std::size_t size);

  /// Number of bytes by the header, header included.
  /// @throws Error for bytes that no Checkpoint wrote
  static std::size_t size(const std::string& owner, const char* bytes);

  bool saving() const { return saving_; }
  const std::string& owner() const { return owner_; }

  // Each saves the value, or replaces it by the saved one.
  // @throws Error where the saved name, kind or length is another

  void value(const std::string& name, double& number) { values(name, &number, 1); }
  void value(const std::string& name, std::int64_t& number);
  void value(const std::string& name, int& number);
  void value(const std::string& name, bool& flag);
  void value(const std::string& name, std::string& text);
  template <class Enum, class = std::enable_if_t<std::is_enum_v<Enum>>>
  void value(const std::string& name, Enum& choice) {
    std::int64_t number = static_cast<std::int64_t>(choice);
    value(name, number);
    choice = static_cast<Enum>(number);
  }
  void values(const std::string& name, double* first, std::size_t count);
  void values(const std::string& name, std::vector<double>& numbers);  ///< of any length
  /// Saves or restores integers of any number, as doubles.
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
  void values(const std::string& name, std::vector<Integer>& integers) {
    std::vector<double> numbers(integers.begin(), integers.end());
    values(name, numbers);
    integers.clear();
    for (const double number : numbers) integers.push_back(static_cast<Integer>(number));
  }
  /// A vector or matrix of Eigen; the saved one must have as many numbers.
  template <class Derived>
  void values(const std::string& name, Eigen::PlainObjectBase<Derived>& matrix) {
    values(name, matrix.data(), static_cast<std::size_t>(matrix.size()));
  }
  template <std::size_t size>
  void values(const std::string& name, std::array<double, size>& numbers) {
    values(name, numbers.data(), size);
  }

  // Values that must not have changed: saved, or compared with the saved ones.
  // @throws Error naming the value, what it was and what it is

  void match(const std::string& name, double number);
  void match(const std::string& name, const std::string& text);
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
  void match(const std::string& name, Integer count) {
    match(name, static_cast<double>(count));
  }

  /// Everything saved, with a header that holds its length and a checksum.
  std::vector<char> bytes() const;
  /// Copy of this checkpoint for reading.
  Checkpoint reread() const;
  /// Call it at the end of reading. @throws Error when something was not read
  void finish() const;

 private:
  enum class Kind : std::uint8_t { numbers, integer, text };
  void put(const std::string& name, Kind kind, const void* data, std::uint64_t count,
           std::size_t size);
  /// The place of the data of the next value, which must have this name and kind.
  const char* take(const std::string& name, Kind kind, std::uint64_t& count, std::size_t size);
  const char* read(std::size_t size);
  [[noreturn]] void refuse(const std::string& problem) const;

  std::string owner_;
  bool saving_ = true;
  std::vector<char> data_;  // without the header
  std::size_t next_ = 0;
};

}  // namespace furrow
