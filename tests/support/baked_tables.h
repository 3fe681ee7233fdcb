// Baked tables, made once and shared by the tests, and blocks that were tampered with.
#pragma once

#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "support/built_tables.h"
#include "vndf/baking/bake.h"

namespace vndf::test {

/// A sum of two distributions, whose slope y given slope x is not the same for all x.
inline constexpr const char* kMixture = "mixture:0.75*ggx+0.25*beckmann@0.3";

/// Of the tolerance with which the tables of the tests are baked.
inline constexpr double kBakedWithin = 1e-4;

/// Baked from small_tables().
inline const KernelTables& baked_tables(const std::string& distribution) {
  static std::map<std::string, KernelTables> cache;
  const auto found = cache.find(distribution);
  if (found != cache.end()) return found->second;
  const SlopeTables& pair = *small_tables(distribution).tables;
  return cache.emplace(distribution, bake(pair, {.tolerance = kBakedWithin})).first->second;
}

/// A block that begins where baked tables may, in memory of just its size.
class Block {
 public:
  explicit Block(std::span<const std::byte> bytes)
      : bytes_(static_cast<std::byte*>(::operator new(bytes.size(), kAlignment))),
        size_(bytes.size()) {
    if (size_ > 0) std::memcpy(data(), bytes.data(), size_);
  }

  std::byte* data() { return bytes_.get(); }
  std::size_t size() const { return size_; }
  std::span<std::byte> bytes() { return {data(), size_}; }
  std::span<std::byte> first(std::size_t length) { return {data(), length}; }

  KernelHeader& header() { return *reinterpret_cast<KernelHeader*>(data()); }
  /// After all other changes.
  void set_checksum() { header().checksum = kernel_checksum(bytes()); }

 private:
  static constexpr std::align_val_t kAlignment{kKernelAlignment};
  struct Delete {
    void operator()(std::byte* bytes) const { ::operator delete(bytes, kAlignment); }
  };

  std::unique_ptr<std::byte, Delete> bytes_;
  std::size_t size_;
};

}  // namespace vndf::test
