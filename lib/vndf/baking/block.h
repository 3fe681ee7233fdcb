// Puts the block of a kernel together: cubics in the order of the kernel's lanes and guides.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vndf/baking/cells.h"
#include "vndf/kernel_tables.h"

namespace vndf::baking {

class KernelBlock {
 public:
  KernelBlock() : bytes_(sizeof(KernelHeader)) {}

  /// Where the next byte goes.
  std::uint32_t at() const { return static_cast<std::uint32_t>(bytes_.size()); }

  void align(std::size_t to) { bytes_.resize((bytes_.size() + to - 1) / to * to); }

  template <class V>
  void put(const V& value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
  }

  void put_cubic(const Cubic& c) {
    for (const std::size_t k : {0u, 2u, 1u, 3u}) put(static_cast<float>(c[k]));
  }

  /// The guide of an axis whose cells have their coefficients at `first` and `distance` bytes after
  /// one another.
  KernelAxis put_guide(const Axis& axis, std::uint32_t first, std::uint32_t distance) {
    align(8);
    const KernelAxis written{at(), axis.first_key(), axis.count(), axis.shift};
    std::uint32_t offset = first;
    for (const AxisCell& cell : axis.cells) {
      for (std::uint32_t key = cell.first; key < cell.last; ++key)
        put(kernel::Guide{static_cast<float>(cell.begin), offset});
      offset += distance;
    }
    return written;
  }

  /// Two guides of axes of the same keys as one, an entry of each for every key; keys beyond the
  /// last cell of one of them are of that cell.
  KernelAxis put_guides(const Axis& a, std::uint32_t first_a, std::uint32_t distance_a,
                        const Axis& b, std::uint32_t first_b, std::uint32_t distance_b) {
    align(16);
    const KernelAxis written{at(), a.first_key(), a.count(), a.shift};
    const auto entry = [](const Axis& axis, std::size_t k, std::uint32_t first,
                          std::uint32_t distance) {
      return kernel::Guide{static_cast<float>(axis.cells[k].begin),
                           first + distance * static_cast<std::uint32_t>(k)};
    };
    std::size_t i = 0, j = 0;
    for (std::uint32_t key = a.first_key(); key < a.first_key() + a.count(); ++key) {
      while (key >= a.cells[i].last && i + 1 < a.cells.size()) ++i;
      while (key >= b.cells[j].last && j + 1 < b.cells.size()) ++j;
      put(entry(a, i, first_a, distance_a));
      put(entry(b, j, first_b, distance_b));
    }
    return written;
  }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace vndf::baking
