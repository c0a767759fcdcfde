// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A thin layer over the HDF5 C library: handles that close themselves, and errors that name file
/// and object. Paths inside a file are absolute ("/history/time"); missing groups on the way are
/// made.

#include <cstdint>
#include <string>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

class Hdf5File {
 public:
  enum class Mode { create, edit, read };  ///< create replaces a file or link that is there

  /// @throws Error when the file is missing, is not HDF5, or may not be read or written
  Hdf5File(const std::string& path, Mode mode);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Closes now and says whether all was written. @throws Error for a full disk and the like
  void close();

  const std::string& path() const { return path_; }
  bool exists(const std::string& object) const;
  /// names in the order they were made
  std::vector<std::string> members(const std::string& group) const;
  void create_group(const std::string& group);
  void remove(const std::string& object);  ///< does nothing for a missing object

  // Attributes of a group or a dataset; set replaces.
  void set_attribute(const std::string& object, const std::string& name, const std::string& text);
  void set_attribute(const std::string& object, const std::string& name, double number);
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  /// names in alphabetical order
  std::vector<std::string> attributes(const std::string& object) const;

  // Whole datasets; write replaces. A 3 x n matrix is stored as n rows of 3, as HDF5 viewers and
  // numpy expect.
  void write(const std::string& dataset, const std::vector<double>& values);
  void write(const std::string& dataset, const std::vector<std::int64_t>& values);
  void write(const std::string& dataset, const Matrix3X& columns);
  void write(const std::string& dataset, const std::vector<Vector3i>& rows);
  /// Text of any length; an attribute holds 64 KiB.
  void write(const std::string& dataset, const std::string& text);
  std::string read_text(const std::string& dataset) const;
  std::vector<double> read_numbers(const std::string& dataset) const;         ///< 1-D
  std::vector<std::int64_t> read_integers(const std::string& dataset) const;  ///< 1-D
  Matrix3X read_columns(const std::string& dataset) const;                    ///< n x 3
  std::vector<Vector3i> read_triples(const std::string& dataset) const;       ///< n x 3

  // One-dimensional datasets of doubles that grow.
  void create_growing(const std::string& dataset, std::size_t chunk = 1024);
  void append(const std::string& dataset, const std::vector<double>& values);
  void truncate(const std::string& dataset, std::size_t length);
  std::size_t length(const std::string& dataset) const;

 private:
  std::string path_;
  std::int64_t file_;  // hid_t
};

}  // namespace furrow
