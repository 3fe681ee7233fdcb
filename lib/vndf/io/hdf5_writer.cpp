// Writing HDF5 in memory with the C API of the library.
#include "vndf/io/hdf5_writer.h"

#include <algorithm>
#include <mutex>

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

}  // namespace vndf::io
