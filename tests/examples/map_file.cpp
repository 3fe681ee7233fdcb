// Samples from tables that are mapped from a file, and sees that they are those that load() reads:
// a million normals have the same bits.
#include <fcntl.h>
#include <sys/mman.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>

#include "vndf/kernel_tables.h"

namespace {

using Bits = std::array<std::uint32_t, 3>;

Bits bits_of(const vndf::Vec3<float>& v) {
  return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
          std::bit_cast<std::uint32_t>(v.z)};
}

}  // namespace

int main(int, char** argv) {
  const std::size_t size = std::filesystem::file_size(argv[1]);
  const void* file = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, open(argv[1], O_RDONLY), 0);
  const auto tables = vndf::KernelTables::view({static_cast<const std::byte*>(file), size});

  const vndf::KernelTables loaded = vndf::load(argv[1]);
  const vndf::KernelDirection mapped_direction = tables.kernel().at({0.6f, 0, 0.8f}, {0.3f, 0.1f});
  const vndf::KernelDirection direction = loaded.kernel().at({0.6f, 0, 0.8f}, {0.3f, 0.1f});
  constexpr int kEach = 1000;
  int same = 0;
  for (int i = 0; i < kEach; ++i)
    for (int j = 0; j < kEach; ++j) {
      const float u1 = (static_cast<float>(i) + 0.5f) / kEach;
      const float u2 = (static_cast<float>(j) + 0.5f) / kEach;
      same += bits_of(mapped_direction.sample(u1, u2)) == bits_of(direction.sample(u1, u2));
    }
  std::cout << same << " of " << kEach * kEach << " normals have the same bits\n";
  return same == kEach * kEach ? 0 : 1;
}
