// Bytes as an HDF5 file of a pair of tables, behind both checksums, which anybody can make.
#include "fuzz/use_tables.h"
#include "vndf/io/format_error.h"
#include "vndf/io/hdf5_reader.h"
#include "vndf/io/stored_tables.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vndf;
  fuzz::accept_or_throw<io::FormatError>([&] {
    io::StoredTables stored = io::read_hdf5(fuzz::text_of(data, size));
    stored.attributes["content_checksum"] = io::stored_checksum(stored);
    const io::TableFile file = io::from_stored(stored);
    fuzz::use_sampler(TabulatedSampler<float>(file.tables));
  });
  return 0;
}
