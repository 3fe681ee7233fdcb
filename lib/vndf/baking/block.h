// Puts the block of a kernel together, front to back: cubics, in the order in which the kernel
// loads them into lanes, and guides, which lead from the keys of an axis to cubics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "vndf/baking/cells.h"
#include "vndf/kernel_block.h"

namespace vndf::baking {

/// Where the coefficients of the cells of an axis lie: those of the first cell at `first`, and
/// those of each later one `distance` bytes after those before it.
struct PlacedCells {
  const Axis& axis;
  std::uint32_t first, distance;

  /// The entry of the guide for `key`. A key beyond the last cell is of that cell.
  kernel::Guide entry(std::uint32_t key) const {
    const auto above = std::ranges::upper_bound(axis.cells, key, {}, &AxisCell::first);
    const auto k = std::max<std::ptrdiff_t>(above - axis.cells.begin() - 1, 0);
    return {static_cast<float>(axis.cells[static_cast<std::size_t>(k)].begin),
            first + distance * static_cast<std::uint32_t>(k)};
  }
};

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

  /// The guide of one axis, or of several side by side, with an entry of each for every key. The
  /// keys are those of the first axis; the others have keys of as many bits.
  KernelAxis put_guide(std::initializer_list<PlacedCells> cells) {
    align(sizeof(kernel::Guide) * cells.size());
    const Axis& keys = cells.begin()->axis;
    const KernelAxis written{at(), keys.first_key(), keys.count(), keys.shift};
    for (std::uint32_t key = keys.first_key(); key < keys.first_key() + keys.count(); ++key)
      for (const PlacedCells& placed : cells) put(placed.entry(key));
    return written;
  }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace vndf::baking
