// The filters through which the values of a dataset went into an HDF5 file: shuffle, deflate and
// fletcher32. No other filter is known, so none can be loaded from elsewhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::io {

enum class Hdf5Filter : std::uint16_t { deflate = 1, shuffle = 2, fletcher32 = 3 };

/// The filters of a pipeline message, in the order in which they were applied. Throws FormatError
/// where one is there twice or of another kind.
std::vector<Hdf5Filter> hdf5_filters(std::string_view message);

/// Undoes `filters` but those whose bit is in `skipped`. Returns `size` bytes, which are values of
/// `value_bytes` each. Throws FormatError if it is another number of bytes, a checksum is wrong or
/// a filter fails. Allocates at most three times `size` and a few bytes.
std::string undo_filters(std::string_view stored, const std::vector<Hdf5Filter>& filters,
                         std::uint32_t skipped, std::size_t size, std::size_t value_bytes);

}  // namespace vndf::io
