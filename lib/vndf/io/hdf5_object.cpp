// Reading superblocks (section II.A) and version-1 object headers (section IV.A.1.a).
#include "vndf/io/hdf5_object.h"

#include <algorithm>
#include <string>

namespace vndf::io {
namespace {

constexpr std::size_t kSuperblockBytes = 96, kPrefixBytes = 16;
constexpr std::uint8_t kShared = 2;  // flag of a message

FormatError not_oldest(const std::string& part) {
  return broken_file(part + " is not of the oldest HDF5 layout, which tables/FORMAT.md describes");
}

bool is_known(Hdf5Kind kind) {
  using enum Hdf5Kind;
  constexpr Hdf5Kind kKnown[] = {nothing,      dataspace,    datatype,  old_fill_value, fill_value,
                                 layout,       filters,      attribute, comment,        old_time,
                                 continuation, symbol_table, time};
  return std::ranges::find(kKnown, kind) != std::end(kKnown);
}

Hdf5Message next_message(ByteCursor& block) {
  const auto kind = block.number<std::uint16_t>();
  const auto size = block.number<std::uint16_t>();
  const auto flags = block.number<std::uint8_t>();
  block.take(3);
  const Hdf5Message message{Hdf5Kind{kind}, block.take(size)};
  if (!is_known(message.kind))
    throw broken_file("it has an HDF5 message of type " + std::to_string(kind) +
                      ", which no table file has");
  if ((flags & kShared) != 0)
    throw broken_file("it has a committed datatype or another shared HDF5 message");
  return message;
}

}  // namespace

std::uint64_t hdf5_root(UntrustedFile& file) {
  ByteCursor superblock(file.block(0, kSuperblockBytes));
  superblock.take(8);  // the signature, by which the format was recognised
  // Versions of the superblock, of free space and of the root, zero; of shared messages, zero;
  // bytes of an address and of a length.
  if (superblock.take(8) != std::string_view("\0\0\0\0\0\x8\x8\0", 8))
    throw not_oldest("its superblock");
  superblock.take(8);  // sizes of nodes, which each node says again
  const auto base = superblock.number<std::uint64_t>();
  superblock.take(8);  // free space
  const auto end = superblock.number<std::uint64_t>();
  const auto driver = superblock.number<std::uint64_t>();
  if (base != 0 || driver != kNoAddress) throw not_oldest("its superblock");
  if (end > file.size()) throw broken_file("it is shorter than its superblock says");
  superblock.take(8);  // the root has no name
  return superblock.number<std::uint64_t>();
}

Hdf5Object hdf5_object(UntrustedFile& file, std::uint64_t address) {
  ByteCursor prefix(file.block(address, kPrefixBytes));
  if (prefix.number<std::uint8_t>() != 1) throw not_oldest("an object");
  prefix.take(7);  // how many messages and links there are
  std::vector<std::string_view> blocks{
      file.block(address + kPrefixBytes, prefix.number<std::uint32_t>())};
  Hdf5Object object;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    ByteCursor block(blocks[k]);
    while (block.left() >= 8) {
      object.push_back(next_message(block));
      if (object.back().kind != Hdf5Kind::continuation) continue;
      ByteCursor place(object.back().body);
      const auto begin = place.number<std::uint64_t>();
      blocks.push_back(file.block(begin, place.number<std::uint64_t>()));
    }
  }
  return object;
}

std::string_view only_message(const Hdf5Object& object, Hdf5Kind kind) {
  const auto is_it = [kind](const Hdf5Message& message) { return message.kind == kind; };
  if (std::ranges::count_if(object, is_it) != 1)
    throw broken_file("an object has not one HDF5 message of type " +
                      std::to_string(static_cast<int>(kind)));
  return std::ranges::find_if(object, is_it)->body;
}

}  // namespace vndf::io
