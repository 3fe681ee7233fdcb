// Reading the chunks of a part.
#include "vndf/io/exr_lines.h"

#include <algorithm>

#include "vndf/io/inflate.h"

namespace vndf::io {
namespace {

constexpr std::size_t kChunkLines = 16, kHeadBytes = 12, kPlaceBytes = 8;

/// Undoes what OpenEXR does to bytes before it deflates them: each is the difference from the one
/// before, plus 128, and those at even places came first.
std::string unpredicted(std::string bytes) {
  unsigned char last = 128;
  for (char& byte : bytes) {
    last = static_cast<unsigned char>(last + static_cast<unsigned char>(byte) - 128);
    byte = static_cast<char>(last);
  }
  std::string result(bytes.size(), '\0');
  const std::size_t half = (bytes.size() + 1) / 2;
  for (std::size_t k = 0; k < half; ++k) result[2 * k] = bytes[k];
  for (std::size_t k = half; k < bytes.size(); ++k) result[2 * (k - half) + 1] = bytes[k];
  return result;
}

/// The `size` bytes of the lines from `top`. Lines that deflate to no less are stored as they are.
std::string chunk_at(UntrustedFile& file, std::uint64_t place, std::uint32_t part_number,
                     std::size_t top, std::size_t size) {
  ByteCursor head(file.block(place, kHeadBytes));
  if (head.number<std::uint32_t>() != part_number || head.number<std::uint32_t>() != top)
    throw broken_file("lines of the EXR file are not where its table says");
  const auto stored_bytes = head.number<std::uint32_t>();
  const std::string_view stored = file.block(place + kHeadBytes, stored_bytes);
  if (stored.size() == size) return std::string(stored);
  std::string bytes = inflate(stored, size);
  if (bytes.size() != size) throw broken_file("lines of the EXR file are shorter than its part");
  return unpredicted(std::move(bytes));
}

}  // namespace

std::string exr_lines(UntrustedFile& file, const ExrPart& part, std::uint32_t part_number,
                      std::size_t lines, std::size_t line_bytes) {
  if (part.chunks.size() != (lines + kChunkLines - 1) / kChunkLines * kPlaceBytes)
    throw broken_file("a part of the EXR file has not one chunk for each 16 lines");
  ByteCursor places(part.chunks);
  std::string bytes;
  bytes.reserve(lines * line_bytes);
  for (std::size_t top = 0; top < lines; top += kChunkLines)
    bytes += chunk_at(file, places.number<std::uint64_t>(), part_number, top,
                      std::min(kChunkLines, lines - top) * line_bytes);
  return bytes;
}

}  // namespace vndf::io
