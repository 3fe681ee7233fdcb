// What a reader says to a file that was made to do harm.
#pragma once

#include <string>
#include <string_view>

#include "io/small_table_file.h"
#include "support/memory_limit.h"
#include "vndf/io/format_error.h"
#include "vndf/io/stored_tables.h"

namespace vndf::test {

/// What `read` says to the bytes of a small file, within the memory that a refusal may take: "the
/// same" as the honest file, "another", or the message of the error.
inline std::string message_of(const std::string& bytes,
                              io::StoredTables (*read)(std::string_view)) {
  std::string message = "another";
  within_limits(kMostRefusalBytes, [&] {
    try {
      const io::StoredTables honest = io::to_stored(small_table_file());
      if (io::to_stored(io::from_stored(read(bytes))) == honest) message = "the same";
    } catch (const io::FormatError& error) {
      message = error.what();
    }
  });
  return message;
}

}  // namespace vndf::test
