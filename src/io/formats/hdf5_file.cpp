// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// An HDF5 handle with the function that closes it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5 prints its error stack unless told not to; ours goes into the exception.
void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// The innermost cause HDF5 knows: "unable to open file: ... No such file or directory".
std::string hdf5_cause() {
  std::string cause;
  const auto keep_first = [](unsigned level, const H5E_error2_t* error, void* text) -> herr_t {
    if (level == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &cause);
  // A failed write gives "..., error message = 'No space left on device', buf = ...".
  const std::string mark = "error message = '";
  const std::size_t begin = cause.find(mark), end = cause.find('\'', begin + mark.size());
  if (begin == std::string::npos || end == std::string::npos) return cause;
  return cause.substr(begin + mark.size(), end - begin - mark.size());
}

[[noreturn]] void fail(const std::string& file, const std::string& action,
                       const std::string& object) {
  const std::string cause = hdf5_cause();
  throw Error(fmt::format("{}: cannot {}{}{}", file, action,
                          object.empty() ? "" : " '" + object + "'",
                          cause.empty() ? "" : " (" + cause + ")"));
}

template <class T>
T require(T result, const std::string& file, const std::string& action,
          const std::string& object = "") {
  if (result < 0) fail(file, action, object);
  return result;
}

/// Metadata in the format of HDF5 1.10, which has checksums: a damaged file is then refused by
/// HDF5, where that of the older formats makes it read or write past its memory.
hid_t access_properties() {
  const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(properties, H5F_LIBVER_V110, H5F_LIBVER_V110);
  return properties;
}

/// UTF-8, null-terminated, of fixed length.
hid_t text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, length);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

struct Shape {
  std::vector<hsize_t> extent;
};

/// Sets a creation property list to store numbers in chunks with checksums, so that a file that was
/// damaged later is refused when it is read.
void keep_in_checked_chunks(hid_t properties, const std::vector<hsize_t>& chunk) {
  H5Pset_chunk(properties, int(chunk.size()), chunk.data());
  H5Pset_fletcher32(properties);
}

template <class T>
hid_t memory_type();
template <>
hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t memory_type<int>() {
  return H5T_NATIVE_INT;
}

template <class T>
void write_dataset(Hdf5File& owner, hid_t file, const std::string& dataset, const T* values,
                   const Shape& shape) {
  owner.remove(dataset);
  const Handle parents(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(parents, 1);
  const Handle space(H5Screate_simple(int(shape.extent.size()), shape.extent.data(), nullptr),
                     H5Sclose);
  const bool empty = std::find(shape.extent.begin(), shape.extent.end(), 0u) != shape.extent.end();
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (!empty) {
    std::vector<hsize_t> chunk = shape.extent;
    chunk[0] = std::min<hsize_t>(chunk[0], 16384);
    keep_in_checked_chunks(layout, chunk);
  }
  const Handle data(require(H5Dcreate2(file, dataset.c_str(), memory_type<T>(), space, parents,
                                       layout, H5P_DEFAULT),
                            owner.path(), "create", dataset),
                    H5Dclose);
  if (empty) return;
  require(H5Dwrite(data, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), owner.path(),
          "write", dataset);
}

constexpr hsize_t best_packing = 1032;                // of deflate: bytes from one that is stored
constexpr std::size_t longest_attribute = 64u << 10;  // [bytes] HDF5's own limit

/// Refuses a dataset that declares more values than its bytes in the file can hold, before memory
/// is taken for them.
void check_stored(const std::string& path, hid_t file, const std::string& dataset, hid_t data,
                  hsize_t count) {
  const Handle layout(H5Dget_create_plist(data), H5Pclose);
  const Handle type(H5Dget_type(data), H5Tclose);
  const bool packed = H5Pget_filter_by_id2(layout, H5Z_FILTER_DEFLATE, nullptr, nullptr, nullptr, 0,
                                           nullptr, nullptr) >= 0;
  const hsize_t packing = packed ? best_packing : 1;
  const std::size_t size = std::max<std::size_t>(H5Tget_size(type), 1);
  hsize_t file_size = 0;
  H5Fget_filesize(file, &file_size);
  const hsize_t stored = std::min(H5Dget_storage_size(data), file_size);
  if (count / packing > stored / size)
    throw Error(
        fmt::format("{}: dataset '{}' has {} bytes for {} values of {}: the file is damaged", path,
                    dataset, stored, count, size));
}

/// Reads a dataset of the given rank; with rank 2 the second extent must be 3.
template <class T>
std::vector<T> read_dataset(const Hdf5File& owner, hid_t file, const std::string& dataset,
                            int rank) {
  const Handle data(
      require(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), owner.path(), "open dataset", dataset),
      H5Dclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  hsize_t extent[2] = {0, 3};
  if (H5Sget_simple_extent_ndims(space) != rank ||
      H5Sget_simple_extent_dims(space, extent, nullptr) != rank || extent[1] != 3)
    throw Error(fmt::format("{}: dataset '{}' must be {}", owner.path(), dataset,
                            rank == 1 ? "one-dimensional" : "n x 3"));
  const hsize_t columns = rank == 2 ? 3 : 1;
  if (extent[0] > std::numeric_limits<hsize_t>::max() / columns)
    throw Error(fmt::format("{}: dataset '{}' is too long", owner.path(), dataset));
  check_stored(owner.path(), file, dataset, data, extent[0] * columns);
  std::vector<T> values(extent[0] * columns);
  if (!values.empty())
    require(H5Dread(data, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
            owner.path(), "read", dataset);
  return values;
}

}  // namespace

Hdf5File::Hdf5File(const std::string& path, Mode mode) : path_(path), file_(-1) {
  silence_hdf5();
  const Handle access(access_properties(), H5Pclose);
  if (mode == Mode::create) {
    const Handle properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    unlink(path.c_str());  // H5F_ACC_EXCL opens with O_EXCL, which follows no link
    file_ =
        require(H5Fcreate(path.c_str(), H5F_ACC_EXCL, properties, access), path, "create the file");
  } else {
    file_ =
        require(H5Fopen(path.c_str(), mode == Mode::edit ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access),
                path, "open as an HDF5 file");
  }
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::close() {
  if (file_ < 0) return;
  const herr_t flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL);
  const std::string cause = flushed < 0 ? hdf5_cause() : "";
  const herr_t closed = H5Fclose(file_);
  file_ = -1;
  if (flushed < 0 || closed < 0)
    throw Error(fmt::format("{}: cannot write to the end ({})", path_, cause));
}

bool Hdf5File::exists(const std::string& object) const {
  // H5Lexists wants every link on the way to exist
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    if (H5Lexists(file_, object.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const Handle handle(
      require(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), path_, "open group", group), H5Gclose);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->push_back(name);
    return 0;
  };
  require(H5Literate(handle, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, collect, &names), path_,
          "list", group);
  return names;
}

void Hdf5File::create_group(const std::string& group) {
  if (exists(group)) return;
  const std::size_t slash = group.rfind('/');
  if (slash != 0 && slash != std::string::npos) create_group(group.substr(0, slash));
  const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  const Handle handle(
      require(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), path_,
              "create group", group),
      H5Gclose);
}

void Hdf5File::remove(const std::string& object) {
  if (exists(object))
    require(H5Ldelete(file_, object.c_str(), H5P_DEFAULT), path_, "replace", object);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::string& text) {
  const Handle owner(require(H5Oopen(file_, object.c_str(), H5P_DEFAULT), path_, "open", object),
                     H5Oclose);
  if (H5Aexists(owner, name.c_str()) > 0) H5Adelete(owner, name.c_str());
  const Handle type(text_type(text.size() + 1), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      require(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), path_,
              "create attribute " + name + " of", object),
      H5Aclose);
  require(H5Awrite(attribute, type, text.c_str()), path_, "write attribute " + name + " of",
          object);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double number) {
  const Handle owner(require(H5Oopen(file_, object.c_str(), H5P_DEFAULT), path_, "open", object),
                     H5Oclose);
  if (H5Aexists(owner, name.c_str()) > 0) H5Adelete(owner, name.c_str());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      require(H5Acreate2(owner, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT),
              path_, "create attribute " + name + " of", object),
      H5Aclose);
  require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &number), path_, "write attribute " + name + " of",
          object);
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  return exists(object) && H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  const std::string action = "read attribute " + name + " of";
  const Handle attribute(
      require(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), path_,
              action, object),
      H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw Error(fmt::format("{}: attribute '{}' of '{}' is not a text of fixed length", path_, name,
                            object));
  if (H5Tget_size(type) > longest_attribute)
    throw Error(
        fmt::format("{}: attribute '{}' of '{}' is longer than HDF5 allows: the file is "
                    "damaged",
                    path_, name, object));
  std::string text(H5Tget_size(type), '\0');
  require(H5Aread(attribute, type, text.data()), path_, action, object);
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

double Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
  const std::string action = "read attribute " + name + " of";
  const Handle attribute(
      require(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), path_,
              action, object),
      H5Aclose);
  double number = 0.0;
  require(H5Aread(attribute, H5T_NATIVE_DOUBLE, &number), path_, action, object);
  return number;
}

std::vector<std::string> Hdf5File::attributes(const std::string& object) const {
  const Handle owner(require(H5Oopen(file_, object.c_str(), H5P_DEFAULT), path_, "open", object),
                     H5Oclose);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->push_back(name);
    return 0;
  };
  require(H5Aiterate2(owner, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), path_,
          "list attributes of", object);
  return names;
}

void Hdf5File::write(const std::string& dataset, const std::vector<double>& values) {
  write_dataset(*this, file_, dataset, values.data(), {{values.size()}});
}
void Hdf5File::write(const std::string& dataset, const std::vector<std::int64_t>& values) {
  write_dataset(*this, file_, dataset, values.data(), {{values.size()}});
}
void Hdf5File::write(const std::string& dataset, const Matrix3X& columns) {
  write_dataset(*this, file_, dataset, columns.data(), {{hsize_t(columns.cols()), 3}});
}
void Hdf5File::write(const std::string& dataset, const std::vector<Vector3i>& rows) {
  static_assert(sizeof(Vector3i) == 3 * sizeof(int), "rows of three integers are contiguous");
  write_dataset(*this, file_, dataset, rows.empty() ? nullptr : rows.front().data(),
                {{rows.size(), 3}});
}

void Hdf5File::write(const std::string& dataset, const std::string& text) {
  remove(dataset);
  const Handle parents(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(parents, 1);
  const Handle type(text_type(text.size() + 1), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle data(
      require(H5Dcreate2(file_, dataset.c_str(), type, space, parents, H5P_DEFAULT, H5P_DEFAULT),
              path_, "create", dataset),
      H5Dclose);
  require(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), path_, "write",
          dataset);
}

std::string Hdf5File::read_text(const std::string& dataset) const {
  const Handle data(
      require(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), path_, "open dataset", dataset),
      H5Dclose);
  const Handle type(H5Dget_type(data), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw Error(fmt::format("{}: dataset '{}' is not a text of fixed length", path_, dataset));
  check_stored(path_, file_, dataset, data, 1);
  std::string text(H5Tget_size(type), '\0');
  require(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), path_, "read", dataset);
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

std::vector<double> Hdf5File::read_numbers(const std::string& dataset) const {
  return read_dataset<double>(*this, file_, dataset, 1);
}
std::vector<std::int64_t> Hdf5File::read_integers(const std::string& dataset) const {
  return read_dataset<std::int64_t>(*this, file_, dataset, 1);
}
Matrix3X Hdf5File::read_columns(const std::string& dataset) const {
  const std::vector<double> values = read_dataset<double>(*this, file_, dataset, 2);
  return Eigen::Map<const Matrix3X>(values.data(), 3, Eigen::Index(values.size() / 3));
}
std::vector<Vector3i> Hdf5File::read_triples(const std::string& dataset) const {
  const std::vector<int> values = read_dataset<int>(*this, file_, dataset, 2);
  std::vector<Vector3i> rows(values.size() / 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return rows;
}

void Hdf5File::create_growing(const std::string& dataset, std::size_t chunk) {
  const Handle parents(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(parents, 1);
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const hsize_t none = 0, any = H5S_UNLIMITED;
  keep_in_checked_chunks(layout, {hsize_t(chunk)});
  const Handle space(H5Screate_simple(1, &none, &any), H5Sclose);
  const Handle data(require(H5Dcreate2(file_, dataset.c_str(), H5T_NATIVE_DOUBLE, space, parents,
                                       layout, H5P_DEFAULT),
                            path_, "create", dataset),
                    H5Dclose);
}

void Hdf5File::append(const std::string& dataset, const std::vector<double>& values) {
  if (values.empty()) return;
  const Handle data(
      require(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), path_, "open dataset", dataset),
      H5Dclose);
  const hsize_t start = length(dataset), count = values.size(), end = start + count;
  require(H5Dset_extent(data, &end), path_, "extend", dataset);
  const Handle target(H5Dget_space(data), H5Sclose);
  const Handle source(H5Screate_simple(1, &count, nullptr), H5Sclose);
  H5Sselect_hyperslab(target, H5S_SELECT_SET, &start, nullptr, &count, nullptr);
  require(H5Dwrite(data, H5T_NATIVE_DOUBLE, source, target, H5P_DEFAULT, values.data()), path_,
          "append to", dataset);
}

void Hdf5File::truncate(const std::string& dataset, std::size_t length) {
  const Handle data(
      require(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), path_, "open dataset", dataset),
      H5Dclose);
  const hsize_t end = length;
  require(H5Dset_extent(data, &end), path_, "shorten", dataset);
}

std::size_t Hdf5File::length(const std::string& dataset) const {
  const Handle data(
      require(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), path_, "open dataset", dataset),
      H5Dclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  hsize_t extent = 0;
  if (H5Sget_simple_extent_ndims(space) != 1 ||
      H5Sget_simple_extent_dims(space, &extent, nullptr) != 1)
    throw Error(fmt::format("{}: dataset '{}' must be one-dimensional", path_, dataset));
  return extent;
}

}  // namespace furrow
