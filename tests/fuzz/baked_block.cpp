// Bytes as a block of baked tables. Its checksum is made right, because anybody can make it.
#include <cstring>
#include <span>
#include <vector>

#include "fuzz/use_tables.h"
#include "vndf/kernel_tables.h"

namespace {

using namespace vndf;

/// The bytes with the checksum that belongs to them.
std::vector<std::byte> with_checksum(const std::uint8_t* data, std::size_t size) {
  const std::span bytes = std::as_bytes(std::span(data, size));
  std::vector<std::byte> block(bytes.begin(), bytes.end());
  if (size < sizeof(KernelHeader)) return block;
  const std::uint64_t sum = kernel_checksum(block);
  std::memcpy(block.data() + offsetof(KernelHeader, checksum), &sum, sizeof(sum));
  return block;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::accept_or_throw<KernelTablesError>([&] {
    const KernelTables tables = KernelTables::copy(with_checksum(data, size));
    (void)tables.text();
    (void)tables.certificate();
    fuzz::use_sampler(tables.kernel());
  });
  return 0;
}
