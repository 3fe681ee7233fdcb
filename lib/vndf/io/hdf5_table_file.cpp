// Writing and reading HDF5 in memory with the C API of the library.
#include "vndf/io/hdf5_table_file.h"

#include <algorithm>
#include <mutex>
#include <type_traits>

#include "vndf/io/hdf5_handle.h"
#include "vndf/provenance.h"

namespace vndf::io {
namespace {

// HDF5 takes files in memory that have the same name for the same file, and it need not be built
// thread-safe: one at a time.
constexpr char kName[] = "vndf slope tables in memory";
std::mutex& mutex() {
  static std::mutex instance;
  return instance;
}

constexpr std::size_t kGrowth = 1u << 20;         // bytes
constexpr std::size_t kChunkElements = 1u << 16;  // a quarter of HDF5's default chunk cache
constexpr unsigned kDeflateLevel = 4;             // the highest makes files 1 % smaller

Hdf5Handle properties(hid_t type) {
  return {H5Pcreate(type), H5Pclose, "create a property list"};
}

/// Access to a file that is only in memory. Its layout is the oldest, the default of HDF5: newer
/// ones check their metadata, which the checksum trailer does too, but HDF5 1.10.8 gets the check
/// of a file's first block wrong in H5Fget_file_image.
Hdf5Handle memory_access() {
  Hdf5Handle access = properties(H5P_FILE_ACCESS);
  hdf5_checked(H5Pset_fapl_core(access, kGrowth, false), "work in memory");
  return access;
}

Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
  hdf5_checked(H5Tset_size(type, std::max<std::size_t>(length, 1)), "describe a text");
  hdf5_checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "describe a text");
  hdf5_checked(H5Tset_cset(type, H5T_CSET_UTF8), "describe a text");
  return type;
}

// Writing.

void write_attribute(hid_t root, const std::string& name, hid_t file_type, hid_t memory_type,
                     const void* value) {
  const std::string action = "write the attribute '" + name + "'";
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, action);
  const Hdf5Handle attribute(
      H5Acreate2(root, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, action);
  hdf5_checked(H5Awrite(attribute, memory_type, value), action);
}

void write_value(hid_t root, const std::string& name, int value) {
  write_attribute(root, name, H5T_STD_I32LE, H5T_NATIVE_INT, &value);
}
void write_value(hid_t root, const std::string& name, double value) {
  write_attribute(root, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}
void write_value(hid_t root, const std::string& name, const std::string& value) {
  const Hdf5Handle type = text_type(value.size());
  write_attribute(root, name, type, type, value.c_str());
}
void write_value(hid_t, const std::string& name, NotUsed) {
  throw FormatError("the attribute '" + name + "' has no value", "give it one");
}

/// Whole rows in chunks, shuffled, deflated and checksummed; no times of writing.
Hdf5Handle dataset_properties(const std::vector<hsize_t>& shape) {
  std::vector<hsize_t> chunk = shape;
  hsize_t row = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
  chunk[0] = std::clamp<hsize_t>(kChunkElements / row, 1, shape[0]);
  Hdf5Handle p = properties(H5P_DATASET_CREATE);
  hdf5_checked(H5Pset_chunk(p, static_cast<int>(chunk.size()), chunk.data()), "set chunks");
  hdf5_checked(H5Pset_shuffle(p), "set the shuffle filter");
  hdf5_checked(H5Pset_deflate(p, kDeflateLevel), "set the deflate filter");
  hdf5_checked(H5Pset_fletcher32(p), "set the checksum filter");
  hdf5_checked(H5Pset_obj_track_times(p, false), "leave out times");
  return p;
}

void write_dataset(hid_t root, const std::string& name, const std::vector<std::size_t>& shape,
                   hid_t file_type, hid_t memory_type, const void* values) {
  const std::string action = "write the array '" + name + "'";
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                         H5Sclose, action);
  const Hdf5Handle dataset(H5Dcreate2(root, name.c_str(), file_type, space, H5P_DEFAULT,
                                      dataset_properties(dims), H5P_DEFAULT),
                           H5Dclose, action);
  hdf5_checked(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), action);
}

void write_array(hid_t root, const std::string& name, const Array& array) {
  if (const auto* f = std::get_if<std::vector<float>>(&array.values))
    write_dataset(root, name, array.shape, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, f->data());
  if (const auto* d = std::get_if<std::vector<double>>(&array.values))
    write_dataset(root, name, array.shape, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, d->data());
}

Hdf5Handle create_file() {
  const Hdf5Handle creation = properties(H5P_FILE_CREATE);
  hdf5_checked(H5Pset_obj_track_times(creation, false), "leave out times");
  return {H5Fcreate(kName, H5F_ACC_TRUNC, creation, memory_access()), H5Fclose, "create a file"};
}

std::string image_of(hid_t file) {
  hdf5_checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "finish the file");
  const ssize_t size = hdf5_checked(H5Fget_file_image(file, nullptr, 0), "finish the file");
  std::string image(static_cast<std::size_t>(size), '\0');
  hdf5_checked(H5Fget_file_image(file, image.data(), image.size()), "finish the file");
  return image;
}

// Reading.

template <class T>
T read_number(hid_t attribute, hid_t memory_type, const std::string& action) {
  T value{};
  hdf5_checked(H5Aread(attribute, memory_type, &value), action);
  return value;
}

std::string read_text(hid_t attribute, hid_t type, const std::string& action) {
  std::string text(H5Tget_size(type), '\0');
  hdf5_checked(H5Aread(attribute, type, text.data()), action);
  return text.substr(0, text.find('\0'));
}

Attribute read_attribute(hid_t root, const std::string& name) {
  const std::string action = "read the attribute '" + name + "'";
  const Hdf5Handle attribute(H5Aopen(root, name.c_str(), H5P_DEFAULT), H5Aclose, action);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, action);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, action);
  const H5T_class_t kind = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  if (H5Sget_simple_extent_npoints(space) != 1) return NotUsed{};
  if (kind == H5T_INTEGER && size == sizeof(int))
    return read_number<int>(attribute, H5T_NATIVE_INT, action);
  if (kind == H5T_FLOAT && size == sizeof(double))
    return read_number<double>(attribute, H5T_NATIVE_DOUBLE, action);
  if (kind == H5T_STRING && H5Tis_variable_str(type) == 0 && size <= kMaxTextBytes)
    return read_text(attribute, type, action);
  return NotUsed{};
}

std::vector<std::size_t> shape_of(hid_t dataset, const std::string& action) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, action);
  const int axes = hdf5_checked(H5Sget_simple_extent_ndims(space), action);
  std::vector<hsize_t> shape(static_cast<std::size_t>(axes));
  hdf5_checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr), action);
  return {shape.begin(), shape.end()};
}

template <class T>
std::vector<T> read_values(hid_t dataset, const std::vector<std::size_t>& shape,
                           const std::string& action) {
  const hid_t type = std::is_same_v<T, float> ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
  std::vector<T> values(shape[0] * shape[1]);
  hdf5_checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), action);
  return values;
}

Array read_array(hid_t dataset, const std::string& name) {
  const std::string action = "read the array '" + name + "'";
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, action);
  const std::vector<std::size_t> shape = shape_of(dataset, action);
  if (!may_read(shape) || H5Tget_class(type) != H5T_FLOAT) return {shape, NotUsed{}};
  if (H5Tget_size(type) == sizeof(float))
    return {shape, read_values<float>(dataset, shape, action)};
  if (H5Tget_size(type) == sizeof(double))
    return {shape, read_values<double>(dataset, shape, action)};
  return {shape, NotUsed{}};
}

herr_t collect_name(hid_t, const char* name, const H5A_info_t*, void* names) noexcept {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::string> attribute_names(hid_t root) {
  std::vector<std::string> names;
  hdf5_checked(H5Aiterate2(root, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names),
               "list the attributes");
  return names;
}

std::string link_name(hid_t root, hsize_t i) {
  const auto name_into = [&](char* text, std::size_t size) {
    return static_cast<std::size_t>(hdf5_checked(
        H5Lget_name_by_idx(root, ".", H5_INDEX_NAME, H5_ITER_INC, i, text, size, H5P_DEFAULT),
        "list the arrays"));
  };
  std::string name(name_into(nullptr, 0), '\0');
  name_into(name.data(), name.size() + 1);
  return name;
}

/// Anything but a dataset is passed over.
void read_link(hid_t root, const std::string& name, StoredTables& stored) {
  const hid_t id = H5Dopen2(root, name.c_str(), H5P_DEFAULT);
  if (id < 0) return;
  const Hdf5Handle dataset(id, H5Dclose, "read the array");
  stored.arrays[name] = read_array(dataset, name);
}

Hdf5Handle open_file(std::string_view bytes) {
  const Hdf5Handle access = memory_access();
  // The library copies the bytes; its interface only lacks the const.
  hdf5_checked(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()),
               "work in memory");
  return {H5Fopen(kName, H5F_ACC_RDONLY, access), H5Fclose, "open the file"};
}

}  // namespace

std::string write_hdf5(const StoredTables& stored) {
  const std::lock_guard lock(mutex());
  const Hdf5Quiet quiet;
  const Hdf5Handle file = create_file();
  for (const auto& [name, attribute] : stored.attributes)
    std::visit([&, &n = name](const auto& value) { write_value(file, n, value); }, attribute);
  for (const auto& [name, array] : stored.arrays) write_array(file, name, array);
  return image_of(file);
}

StoredTables read_hdf5(std::string_view bytes) {
  const std::lock_guard lock(mutex());
  const Hdf5Quiet quiet;
  const Hdf5Handle file = open_file(bytes);
  const Hdf5Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose, "open the root");
  H5G_info_t info;
  hdf5_checked(H5Gget_info(root, &info), "list the arrays");
  StoredTables stored;
  for (const std::string& name : attribute_names(root))
    stored.attributes[name] = read_attribute(root, name);
  for (hsize_t i = 0; i < info.nlinks; ++i) read_link(root, link_name(root, i), stored);
  return stored;
}

}  // namespace vndf::io
