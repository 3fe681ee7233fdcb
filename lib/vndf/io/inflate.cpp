// Inflating with zlib.
#include "vndf/io/inflate.h"

#include <zlib.h>

#include "vndf/io/byte_cursor.h"

namespace vndf::io {

std::string inflate(std::string_view deflated, std::size_t most) {
  std::string bytes(most, '\0');
  uLongf size = most;
  const int result = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                                reinterpret_cast<const Bytef*>(deflated.data()), deflated.size());
  if (result != Z_OK) throw broken_file("compressed values in it are damaged or too many");
  bytes.resize(size);
  return bytes;
}

}  // namespace vndf::io
