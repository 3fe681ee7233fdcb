// Nodes of the version-1 B-trees of HDF5 (section III.A.1): those of groups and those of chunks.
#pragma once

#include <cstdint>

#include "vndf/io/untrusted_file.h"

namespace vndf::io {

/// A node, its level above the leaves of the tree, and its entries: `count` times a key and the
/// address of a child.
struct Hdf5Node {
  unsigned level;
  std::size_t count;
  ByteCursor entries;
};

enum class Hdf5Tree : std::uint8_t { group = 0, chunks = 1 };

/// The node at `address`, whose keys have `key_bytes`.
inline Hdf5Node hdf5_node(UntrustedFile& file, Hdf5Tree tree, std::uint64_t address,
                          std::size_t key_bytes) {
  constexpr std::size_t kHeadBytes = 24, kAddressBytes = 8;
  ByteCursor head(file.block(address, kHeadBytes));
  if (head.take(4) != "TREE" || head.number<std::uint8_t>() != static_cast<std::uint8_t>(tree))
    throw broken_file("a node of an HDF5 tree is none");
  const auto level = head.number<std::uint8_t>();
  const std::size_t count = head.number<std::uint16_t>();
  return {level, count,
          ByteCursor(file.block(address + kHeadBytes, count * (key_bytes + kAddressBytes)))};
}

/// Calls leaf(key, address) for each entry of the leaves below the node at `address`, in order. The
/// levels fall by one from node to child, so that no node is above itself.
template <class Leaf>
void for_each_leaf(UntrustedFile& file, Hdf5Tree tree, std::uint64_t address, std::size_t key_bytes,
                   const Leaf& leaf, unsigned levels = 256) {
  Hdf5Node node = hdf5_node(file, tree, address, key_bytes);
  if (node.level >= levels) throw broken_file("an HDF5 tree points upwards");
  for (std::size_t k = 0; k < node.count; ++k) {
    const std::string_view key = node.entries.take(key_bytes);
    const auto child = node.entries.number<std::uint64_t>();
    if (node.level == 0)
      leaf(key, child);
    else
      for_each_leaf(file, tree, child, key_bytes, leaf, node.level);
  }
}

}  // namespace vndf::io
