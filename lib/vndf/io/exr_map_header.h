// What the headers of an EXR file declare, looked at before OpenEXR opens the file. The library
// allocates what headers declare: tables of places for billions of tiles, and buffers for a
// thousand channels.
#pragma once

#include <cstdint>
#include <string_view>

namespace vndf::io {

/// Throws FormatError unless OpenEXR can open the file with little memory: at most 64 parts of at
/// most 64 channels, data windows within kMaxMapSide, tiles of at most 64 MiB, and no more tiles
/// than the file has room to point to. `head` is the beginning of a file of `file_bytes`, and must
/// hold all headers.
void check_exr_headers(std::string_view head, std::uint64_t file_bytes);

}  // namespace vndf::io
