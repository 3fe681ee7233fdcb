// HDF5 files that libhdf5 writes and somebody wrote to do harm, and others that are unusual and
// right. The reader is our own, so libhdf5 is what it is tested against.
#include <hdf5.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "io/hostile_file.h"
#include "support/catch.h"
#include "vndf/io/format_error.h"
#include "vndf/io/hdf5_filters.h"
#include "vndf/io/hdf5_reader.h"
#include "vndf/io/hdf5_writer.h"
#include "vndf/io/stored_tables.h"

namespace {

using namespace vndf;
using namespace vndf::io;
using namespace vndf::test;

const StoredTables& honest() {
  static const StoredTables stored = to_stored(small_table_file());
  return stored;
}

/// Returns `id`, which must be one.
hid_t made(hid_t id) {
  REQUIRE(id >= 0);
  return id;
}

void done(herr_t result) {
  REQUIRE(result >= 0);
}

std::string image_of(hid_t file) {
  done(H5Fflush(file, H5F_SCOPE_GLOBAL));
  std::string image(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)), '\0');
  REQUIRE(H5Fget_file_image(file, image.data(), image.size()) >= 0);
  return image;
}

hid_t in_memory() {
  const hid_t access = made(H5Pcreate(H5P_FILE_ACCESS));
  done(H5Pset_fapl_core(access, 1 << 16, false));
  done(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
  return access;
}

/// An honest file after `change` to its root group by libhdf5.
std::string changed(const std::function<void(hid_t)>& change) {
  const std::string bytes = write_hdf5(honest());
  const hid_t access = in_memory();
  done(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()));
  const hid_t file = made(H5Fopen("hostile", H5F_ACC_RDWR, access));
  change(file);
  std::string image = image_of(file);
  H5Fclose(file);
  H5Pclose(access);
  return image;
}

std::string message_of(const std::string& bytes) {
  return test::message_of(bytes, read_hdf5);
}

void check_refused(const std::string& bytes, const std::string& part) {
  CHECK_THAT(message_of(bytes), Catch::Contains(part));
}

constexpr hsize_t kShape[] = {kSmallRows, kSmallColumns};

/// Puts a dataset in place of an array.
void put_dataset(hid_t root, const char* name, const hsize_t (&shape)[2], hid_t type,
                 hid_t creation, const void* values = nullptr) {
  done(H5Ldelete(root, name, H5P_DEFAULT));
  const hid_t space = made(H5Screate_simple(2, shape, nullptr));
  const hid_t dataset =
      made(H5Dcreate2(root, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  if (values != nullptr)
    done(H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  H5Dclose(dataset);
  H5Sclose(space);
}

/// Properties with chunks of that shape.
hid_t chunked(hsize_t rows, hsize_t columns) {
  const hid_t creation = made(H5Pcreate(H5P_DATASET_CREATE));
  const hsize_t chunk[] = {rows, columns};
  done(H5Pset_chunk(creation, 2, chunk));
  return creation;
}

/// An honest file with `marginal` written again with these properties.
std::string with_marginal(hid_t creation, hid_t type = H5T_IEEE_F32LE) {
  return changed([&](hid_t root) {
    const std::vector<float> values = small_rows();
    put_dataset(root, "marginal", kShape, type, creation, values.data());
  });
}

void put_attribute(hid_t root, const char* name, hid_t type, hid_t space, const void* value) {
  if (H5Aexists(root, name) > 0) done(H5Adelete(root, name));
  const hid_t attribute = made(H5Acreate2(root, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  if (value != nullptr) done(H5Awrite(attribute, type, value));
  H5Aclose(attribute);
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

void put_number(std::string& bytes, std::size_t at, std::uint64_t number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

/// A filter that does nothing, as a plug-in would be.
std::size_t pass_on(unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*,
                    void**) {
  return bytes;
}

}  // namespace

TEST_CASE("an HDF5 file is read whatever its chunks, filters, times and additions are") {
  CHECK(message_of(write_hdf5(honest())) == "the same");
  for (const auto& [rows, columns] : {std::pair{1, 1}, {5, 7}, {16, 1}, {15, 24}})
    CHECK(message_of(with_marginal(chunked(hsize_t(rows), hsize_t(columns)))) == "the same");

  const hid_t other_order = chunked(8, 9);
  done(H5Pset_fletcher32(other_order));
  done(H5Pset_deflate(other_order, 9));
  done(H5Pset_shuffle(other_order));
  CHECK(message_of(with_marginal(other_order)) == "the same");
  const hid_t deflated = chunked(3, 24);
  done(H5Pset_deflate(deflated, 1));
  done(H5Pset_obj_track_times(deflated, true));
  done(H5Pset_fill_time(deflated, H5D_FILL_TIME_NEVER));
  CHECK(message_of(with_marginal(deflated)) == "the same");

  CHECK(message_of(changed([](hid_t root) {
          H5Gclose(made(H5Gcreate2(root, "a group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)));
          done(H5Lcreate_soft("/nowhere", root, "a soft link", H5P_DEFAULT, H5P_DEFAULT));
          const hid_t space = made(H5Screate(H5S_SCALAR));
          const hid_t text = made(H5Tcopy(H5T_C_S1));
          done(H5Tset_size(text, H5T_VARIABLE));
          const char* value = "of any length";
          put_attribute(root, "an attribute", text, space, &value);
          for (int k = 0; k < 200; ++k)  // so many links that their tree has two levels
            done(H5Lcreate_hard(root, "conditional", root, ("link " + std::to_string(k)).c_str(),
                                H5P_DEFAULT, H5P_DEFAULT));
        })) == "the same");
}

TEST_CASE("a text of an HDF5 file may end with its first zero") {
  CHECK(message_of(changed([](hid_t root) {
          const hid_t text = made(H5Tcopy(H5T_C_S1));
          done(H5Tset_size(text, 20));
          put_attribute(root, "command", text, made(H5Screate(H5S_SCALAR)),
                        "command\0and what is not");
        })) == "the same");
}

TEST_CASE("values of an HDF5 file in other files are not read") {
  const hid_t external = made(H5Pcreate(H5P_DATASET_CREATE));
  done(H5Pset_external(external, "/etc/hostname", 0, H5F_UNLIMITED));
  check_refused(
      changed([&](hid_t root) { put_dataset(root, "marginal", kShape, H5T_IEEE_F32LE, external); }),
      "'marginal': it has an HDF5 message of type 7");

  const hid_t elsewhere = made(H5Pcreate(H5P_DATASET_CREATE));
  const hid_t space = made(H5Screate_simple(2, kShape, nullptr));
  done(H5Pset_virtual(elsewhere, space, "/etc/hostname", "/x", space));
  check_refused(changed([&](hid_t root) {
                  put_dataset(root, "marginal", kShape, H5T_IEEE_F32LE, elsewhere);
                }),
                "'marginal': its values are not in chunks of the oldest HDF5 layout");

  check_refused(
      changed([](hid_t root) {
        done(H5Ldelete(root, "marginal", H5P_DEFAULT));
        done(H5Lcreate_external("/etc/hostname", "/x", root, "marginal", H5P_DEFAULT, H5P_DEFAULT));
      }),
      "HDF5 message of type");
}

TEST_CASE("soft links, and two links to one array, are refused in an HDF5 file") {
  const auto replaced = [](const std::function<void(hid_t)>& link) {
    return changed([&](hid_t root) {
      done(H5Ldelete(root, "marginal", H5P_DEFAULT));
      link(root);
    });
  };
  check_refused(replaced([](hid_t root) {
                  done(H5Lcreate_soft("/conditional", root, "marginal", H5P_DEFAULT, H5P_DEFAULT));
                }),
                "'marginal' is a soft link");
  check_refused(replaced([](hid_t root) {
                  done(H5Lcreate_hard(root, "/", root, "marginal", H5P_DEFAULT, H5P_DEFAULT));
                }),
                "'marginal': an object has not one HDF5 message of type 1");
  // Most of the file, read for two names.
  constexpr hsize_t kLarge[] = {512, 512};
  const std::vector<float> zeros(kLarge[0] * kLarge[1]);
  check_refused(
      changed([&](hid_t root) {
        put_dataset(root, "marginal", kLarge, H5T_IEEE_F32LE, chunked(64, 512), zeros.data());
        done(H5Ldelete(root, "conditional", H5P_DEFAULT));
        done(H5Lcreate_hard(root, "marginal", root, "conditional", H5P_DEFAULT, H5P_DEFAULT));
      }),
      "'marginal': it points to some of its bytes more than once");
}

TEST_CASE("filters other than shuffle, deflate and fletcher32 are refused in an HDF5 file") {
  constexpr int kPrivate = 300;
  const H5Z_class2_t plug_in{H5Z_CLASS_T_VERS, kPrivate, 1,       1,
                             "plug-in",        nullptr,  nullptr, pass_on};
  done(H5Zregister(&plug_in));
  const hid_t filtered = chunked(4, 4);
  done(H5Pset_filter(filtered, kPrivate, H5Z_FLAG_MANDATORY, 0, nullptr));
  check_refused(with_marginal(filtered), "'marginal': its values went through the HDF5 filter 300");
  const hid_t twice = chunked(4, 4);
  done(H5Pset_deflate(twice, 1));
  done(H5Pset_deflate(twice, 1));
  check_refused(with_marginal(twice), "'marginal': its values went through an HDF5 filter twice");
}

TEST_CASE("an HDF5 dataset without values takes no memory") {
  constexpr hsize_t kLarge[] = {8192, 8192};
  check_refused(changed([&](hid_t root) {
                  put_dataset(root, "marginal", kLarge, H5T_IEEE_F64LE, chunked(8192, 8192));
                }),
                "'marginal': its arrays are larger than a file of its size can hold");
  check_refused(changed([&](hid_t root) {
                  put_dataset(root, "marginal", kShape, H5T_IEEE_F32LE, chunked(8, 8));
                }),
                "'marginal': it has no values for some of its places");
  // Forty links of other names are not followed.
  CHECK(message_of(changed([&](hid_t root) {
          put_dataset(root, "marginal", kShape, H5T_IEEE_F32LE, chunked(8, 8), small_rows().data());
          done(H5Lcreate_hard(root, "conditional", root, "kept", H5P_DEFAULT, H5P_DEFAULT));
          put_dataset(root, "kept", kLarge, H5T_IEEE_F64LE, chunked(8192, 8192));
          for (int k = 0; k < 40; ++k)
            done(H5Lcreate_hard(root, "kept", root, ("link " + std::to_string(k)).c_str(),
                                H5P_DEFAULT, H5P_DEFAULT));
        })) == "the same");
}

TEST_CASE("what deflates to very little takes no memory in an HDF5 file") {
  constexpr hsize_t kLarge[] = {8192, 8192};
  const hid_t deflated = chunked(1024, 8192);
  done(H5Pset_deflate(deflated, 9));
  const std::vector<float> zeros(kLarge[0] * kLarge[1]);
  check_refused(changed([&](hid_t root) {
                  put_dataset(root, "marginal", kLarge, H5T_IEEE_F32LE, deflated, zeros.data());
                }),
                "'marginal': its arrays are larger than a file of its size can hold");

  // Fifty megabytes in a chunk that should have 16 x 24 values.
  const hid_t small = chunked(kShape[0], kShape[1]);
  done(H5Pset_deflate(small, 9));
  const std::string bytes = changed([&](hid_t root) {
    constexpr hsize_t kLong[] = {1u << 19, 24};
    const hid_t whole = chunked(kLong[0], kLong[1]);
    done(H5Pset_deflate(whole, 9));
    put_dataset(root, "log_ndf", kLong, H5T_IEEE_F32LE, whole, zeros.data());
    const hid_t bomb = made(H5Dopen2(root, "log_ndf", H5P_DEFAULT));
    hsize_t size = 0;
    done(H5Dget_chunk_storage_size(bomb, std::vector<hsize_t>{0, 0}.data(), &size));
    std::vector<char> chunk(size);
    std::uint32_t mask = 0;
    const hsize_t first[] = {0, 0};
    done(H5Dread_chunk(bomb, H5P_DEFAULT, first, &mask, chunk.data()));
    H5Dclose(bomb);
    put_dataset(root, "marginal", kShape, H5T_IEEE_F32LE, small);
    const hid_t marginal = made(H5Dopen2(root, "marginal", H5P_DEFAULT));
    done(H5Dwrite_chunk(marginal, H5P_DEFAULT, 0, first, size, chunk.data()));
    H5Dclose(marginal);
  });
  check_refused(bytes, "'marginal': compressed values in it are damaged or too many");
}

TEST_CASE("datatypes that are kept elsewhere, and others than the format's, are refused") {
  const std::string committed = changed([](hid_t root) {
    const hid_t type = made(H5Tcopy(H5T_IEEE_F32LE));
    done(H5Tcommit2(root, "type", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    put_dataset(root, "marginal", kShape, type, chunked(4, 4), small_rows().data());
  });
  check_refused(committed, "'marginal': it has a committed datatype");
  const hid_t scalar = made(H5Screate(H5S_SCALAR));
  check_refused(changed([&](hid_t root) {
                  const hid_t type = made(H5Tcopy(H5T_IEEE_F64LE));
                  done(H5Tcommit2(root, "type", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
                  const double value = 1;
                  put_attribute(root, "support", type, scalar, &value);
                }),
                "committed datatype");
  check_refused(changed([&](hid_t root) {
                  const hid_t text = made(H5Tcopy(H5T_C_S1));
                  done(H5Tset_size(text, H5T_VARIABLE));
                  const char* value = "of any length";
                  put_attribute(root, "command", text, scalar, &value);
                }),
                "'command' is not a text of fixed length");
  check_refused(changed([&](hid_t root) {
                  const double value = 1;
                  put_attribute(root, "support", H5T_IEEE_F64BE, scalar, &value);
                }),
                "'support' is not a float64 number");
  check_refused(changed([&](hid_t root) {
                  const hsize_t two[] = {2};
                  const double values[] = {1, 2};
                  put_attribute(root, "support", H5T_IEEE_F64LE,
                                made(H5Screate_simple(1, two, nullptr)), values);
                }),
                "'support' is not a float64 number");
  check_refused(changed([&](hid_t root) {
                  put_attribute(root, "support", H5T_IEEE_F64LE, made(H5Screate(H5S_NULL)),
                                nullptr);
                }),
                "'support' is not a float64 number");
  check_refused(with_marginal(chunked(4, 4), H5T_IEEE_F32BE),
                "the values of the array 'marginal' are not float32");
}

TEST_CASE("other layouts of HDF5 are refused") {
  for (const H5D_layout_t layout : {H5D_CONTIGUOUS, H5D_COMPACT}) {
    const hid_t creation = made(H5Pcreate(H5P_DATASET_CREATE));
    done(H5Pset_layout(creation, layout));
    check_refused(with_marginal(creation), "'marginal': its values are not in chunks");
  }
  const hid_t access = in_memory();
  done(H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST));
  const hid_t newest = made(H5Fcreate("newest", H5F_ACC_TRUNC, H5P_DEFAULT, access));
  check_refused(image_of(newest), "its superblock is not of the oldest HDF5 layout");
}

TEST_CASE("an HDF5 file that points in circles is refused") {
  const std::string good = write_hdf5(honest());
  // The first node of a tree is that of the root group; the next, of chunks, is of `conditional`.
  const std::size_t group = good.find("TREE"), chunks = good.find("TREE", group + 4);
  constexpr std::size_t kLevel = 5, kFirstChunk = 24 + 32, kFirstGroup = 24 + 8;
  std::string bytes = good;
  bytes[group + kLevel] = 1;
  put_number(bytes, group + kFirstGroup, group);
  check_refused(bytes, "an HDF5 tree points upwards");
  bytes = good;
  bytes[chunks + kLevel] = 1;
  put_number(bytes, chunks + kFirstChunk, chunks);
  check_refused(bytes, "'conditional': an HDF5 tree points upwards");

  // The root's only message of the first block says where the next is.
  const std::size_t root = number_at(good, 64), place = root + 16 + 8;
  bytes = good;
  put_number(bytes, place, root + 16);
  put_number(bytes, place + 8, 24);
  check_refused(bytes, "it points to some of its bytes more than once");
}

TEST_CASE("a chunk of an HDF5 file that is not its own is refused") {
  const std::string good = with_marginal(chunked(8, kSmallColumns));
  const std::size_t node = good.find(std::string_view("TREE\1\0\2\0", 8));  // with two chunks
  REQUIRE(node != std::string::npos);
  constexpr std::size_t kEntry = 32 + 8, kFirst = 24, kRow = 8, kAddress = 32;
  const auto with_second = [&](std::size_t field, std::uint64_t number) {
    std::string bytes = good;
    put_number(bytes, node + kFirst + kEntry + field, number);
    return bytes;
  };
  CHECK(message_of(with_second(kRow, 8)) == "the same");
  check_refused(with_second(kRow, 0), "'marginal': one of its chunks is there twice");
  check_refused(with_second(kRow, 16), "'marginal': one of its chunks is at no place of a chunk");
  check_refused(with_second(kRow, 4), "'marginal': one of its chunks is at no place of a chunk");
  check_refused(with_second(kAddress, good.size() - 8), "'marginal': a part of it ends");
  check_refused(with_second(kAddress, ~std::uint64_t{0}),
                "'marginal': it points outside of itself");
}

TEST_CASE("a chunk of an HDF5 file may skip filters, as libhdf5 does where they save nothing") {
  const hid_t filtered = chunked(kSmallRows, kSmallColumns);
  done(H5Pset_shuffle(filtered));
  done(H5Pset_deflate(filtered, 9));
  constexpr std::uint32_t kBoth = 3;
  const std::vector<float> values = small_rows();
  CHECK(message_of(changed([&](hid_t root) {
          put_dataset(root, "marginal", kShape, H5T_IEEE_F32LE, filtered);
          const hid_t dataset = made(H5Dopen2(root, "marginal", H5P_DEFAULT));
          const hsize_t first[] = {0, 0};
          done(H5Dwrite_chunk(dataset, H5P_DEFAULT, kBoth, first, values.size() * sizeof(float),
                              values.data()));
          H5Dclose(dataset);
        })) == "the same");
}

TEST_CASE("chunks of an HDF5 file that are larger than the array, or too many, are refused") {
  std::string bytes = with_marginal(chunked(8, kSmallColumns));
  const std::uint32_t layout[] = {8, kSmallColumns, sizeof(float)};
  const std::string text(reinterpret_cast<const char*>(layout), sizeof layout);
  const std::size_t at = bytes.find(text);
  REQUIRE(at != std::string::npos);
  bytes[at] = kSmallRows + 1;
  check_refused(bytes, "'marginal': its chunks are empty or larger than the array");
  bytes[at] = 0;
  check_refused(bytes, "'marginal': its chunks are empty or larger than the array");

  constexpr hsize_t kLarge[] = {1024, 2048};
  check_refused(changed([&](hid_t root) {
                  put_dataset(root, "marginal", kLarge, H5T_IEEE_F32LE, chunked(1, 1));
                }),
                "'marginal': it has more chunks than fit into it");
}

TEST_CASE("an HDF5 file whose addresses begin elsewhere or that has a driver is refused") {
  constexpr std::size_t kBase = 24, kDriver = 48;
  for (const std::size_t field : {kBase, kDriver}) {
    std::string bytes = write_hdf5(honest());
    put_number(bytes, field, 8);
    check_refused(bytes, "its superblock is not of the oldest HDF5 layout");
  }
}

TEST_CASE("the fletcher32 of a long chunk does not overflow, and a short chunk is refused") {
  // Words of all ones add up to a multiple of 65535, so both sums are 0. In 64 bits the second
  // overflows after 24 million words.
  constexpr std::size_t kSize = 1u << 26;
  std::string chunk(kSize, '\xff');
  chunk.append(4, '\0');
  CHECK(undo_filters(chunk, {Hdf5Filter::fletcher32}, 0, kSize, 4).size() == kSize);
  CHECK_THROWS_AS(undo_filters("123", {}, 0, 4, 4), FormatError);
  CHECK_THROWS_AS(undo_filters("12345", {}, 0, 4, 4), FormatError);
}

TEST_CASE("values of an HDF5 file that do not match their fletcher32 are refused") {
  const hid_t checked = chunked(kSmallRows, kSmallColumns);
  done(H5Pset_fletcher32(checked));
  std::string bytes = with_marginal(checked);
  CHECK(message_of(bytes) == "the same");
  const float value = small_rows()[kSmallColumns + 3];
  const std::string text(reinterpret_cast<const char*>(&value), sizeof value);
  bytes[bytes.rfind(text)] ^= 1;
  check_refused(bytes, "'marginal': values in it do not match their checksum");
}
