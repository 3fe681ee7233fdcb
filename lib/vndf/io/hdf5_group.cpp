// Reading symbol tables (sections III.B and III.C) and local heaps (section III.D), in which the
// names are.
#include "vndf/io/hdf5_group.h"

#include <algorithm>

#include "vndf/io/hdf5_tree.h"

namespace vndf::io {
namespace {

constexpr std::size_t kKeyBytes = 8, kHeadBytes = 8, kEntryBytes = 40, kHeapBytes = 32;
constexpr std::uint32_t kSoftLink = 2;

/// The texts of the heap at `address`.
std::string_view heap_at(UntrustedFile& file, std::uint64_t address) {
  ByteCursor heap(file.block(address, kHeapBytes));
  if (heap.take(8) != std::string_view("HEAP\0\0\0\0", 8))
    throw broken_file("the names of an HDF5 group are no local heap");
  const auto size = heap.number<std::uint64_t>();
  heap.take(8);  // free space
  return file.block(heap.number<std::uint64_t>(), size);
}

/// The one of `names` that begins at `offset` of a heap, or nullptr. It looks no further than that
/// name is long, so that a long text costs no time, however many links have it.
const std::string* name_at(std::string_view heap, std::uint64_t offset,
                           const std::vector<std::string>& names) {
  if (offset > heap.size()) throw broken_file("the name of a link is outside of its HDF5 group");
  const std::string_view text = heap.substr(static_cast<std::size_t>(offset));
  const auto found = std::ranges::find_if(names, [text](const std::string& name) {
    return text.starts_with(name) && text.size() > name.size() && text[name.size()] == '\0';
  });
  return found == names.end() ? nullptr : &*found;
}

/// The entries of the symbol table node at `address`.
ByteCursor entries_at(UntrustedFile& file, std::uint64_t address) {
  ByteCursor head(file.block(address, kHeadBytes));
  if (head.take(6) != std::string_view("SNOD\1\0", 6))
    throw broken_file("a node of an HDF5 symbol table is none");
  return ByteCursor(file.block(address + kHeadBytes, head.number<std::uint16_t>() * kEntryBytes));
}

}  // namespace

std::map<std::string, std::uint64_t> hdf5_links(UntrustedFile& file, const Hdf5Object& group,
                                                const std::vector<std::string>& names) {
  ByteCursor table(only_message(group, Hdf5Kind::symbol_table));
  const auto tree = table.number<std::uint64_t>();
  const std::string_view heap = heap_at(file, table.number<std::uint64_t>());
  std::map<std::string, std::uint64_t> links;
  for_each_leaf(file, Hdf5Tree::group, tree, kKeyBytes, [&](std::string_view, auto address) {
    ByteCursor entries = entries_at(file, address);
    while (entries.left() > 0) {
      ByteCursor entry(entries.take(kEntryBytes));
      const std::string* name = name_at(heap, entry.number<std::uint64_t>(), names);
      const auto object = entry.number<std::uint64_t>();
      if (name == nullptr) continue;
      if (entry.number<std::uint32_t>() == kSoftLink)
        throw broken_file("the array '" + *name + "' is a soft link, not a dataset");
      if (!links.emplace(*name, object).second)
        throw broken_file("the array '" + *name + "' is there twice");
    }
  });
  return links;
}

}  // namespace vndf::io
