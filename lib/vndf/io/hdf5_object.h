// The objects of an HDF5 file as lists of messages, and where the first of them is. Numbers of
// sections are those of the HDF5 File Format Specification, version 3.0 (The HDF Group). This reads
// superblocks and object headers of the oldest layout, which libhdf5 writes by default.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "vndf/io/untrusted_file.h"

namespace vndf::io {

/// The kinds of messages that an object may have (section IV.A.2). Any other is refused: it could
/// change the meaning of those that are read, as external storage does.
enum class Hdf5Kind : std::uint16_t {
  nothing = 0x0,
  dataspace = 0x1,
  datatype = 0x3,
  old_fill_value = 0x4,
  fill_value = 0x5,
  layout = 0x8,
  filters = 0xB,
  attribute = 0xC,
  comment = 0xD,
  old_time = 0xE,
  continuation = 0x10,
  symbol_table = 0x11,
  time = 0x12
};

struct Hdf5Message {
  Hdf5Kind kind;
  std::string_view body;
};

/// Stands for the address of what is not there.
inline constexpr std::uint64_t kNoAddress = ~std::uint64_t{0};

using Hdf5Object = std::vector<Hdf5Message>;

/// The address of the root group. Throws FormatError unless the superblock is of version 0, its
/// addresses begin at the first byte, and it has no driver.
std::uint64_t hdf5_root(UntrustedFile& file);

/// The messages of the object at `address`. Throws FormatError where one of them is of no kind
/// above or is kept elsewhere ("shared").
Hdf5Object hdf5_object(UntrustedFile& file, std::uint64_t address);

/// The body of the one message of a kind. Throws FormatError if there is none or another.
std::string_view only_message(const Hdf5Object& object, Hdf5Kind kind);

}  // namespace vndf::io
