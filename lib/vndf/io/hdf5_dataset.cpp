// Reading the layout of a dataset (section IV.A.2.i), the tree of its chunks and the chunks.
#include "vndf/io/hdf5_dataset.h"

#include <algorithm>
#include <array>

#include "vndf/io/hdf5_filters.h"
#include "vndf/io/hdf5_tree.h"
#include "vndf/io/hdf5_values.h"

namespace vndf::io {
namespace {

using Pair = std::array<std::size_t, 2>;  // rows and columns

/// Layout messages give the value as a third axis, of its bytes; keys of chunks an offset in it.
constexpr int kLayoutAxes = 3;
constexpr std::size_t kKeyBytes = 8 + 8 * kLayoutAxes;

/// How the values of a dataset lie in its chunks.
struct Layout {
  Pair shape, chunk;
  std::size_t value_bytes;
  std::uint64_t tree;
  std::vector<Hdf5Filter> filters;
};

std::vector<Hdf5Filter> filters_of(const Hdf5Object& dataset) {
  const bool none = std::ranges::none_of(
      dataset, [](const Hdf5Message& m) { return m.kind == Hdf5Kind::filters; });
  return none ? std::vector<Hdf5Filter>{} : hdf5_filters(only_message(dataset, Hdf5Kind::filters));
}

Layout layout_of(const Hdf5Object& dataset, const Pair& shape, std::size_t value_bytes) {
  ByteCursor cursor(only_message(dataset, Hdf5Kind::layout));
  constexpr std::uint8_t kVersion = 3, kChunked = 2;
  if (cursor.number<std::uint8_t>() != kVersion || cursor.number<std::uint8_t>() != kChunked ||
      cursor.number<std::uint8_t>() != kLayoutAxes)
    throw broken_file("its values are not in chunks of the oldest HDF5 layout");
  const auto tree = cursor.number<std::uint64_t>();
  const Pair chunk{cursor.number<std::uint32_t>(), cursor.number<std::uint32_t>()};
  for (std::size_t axis = 0; axis < chunk.size(); ++axis)
    if (chunk[axis] < 1 || chunk[axis] > shape[axis])
      throw broken_file("its chunks are empty or larger than the array");
  if (cursor.number<std::uint32_t>() != value_bytes)
    throw broken_file("its chunks are of values of another size");
  return {shape, chunk, value_bytes, tree, filters_of(dataset)};
}

/// Collects chunks into the bytes of an array, each chunk once.
class Collector {
 public:
  Collector(UntrustedFile& file, const Layout& layout) : file_(file), layout_(layout) {
    for (std::size_t axis = 0; axis < chunks_.size(); ++axis)
      chunks_[axis] = (layout.shape[axis] + layout.chunk[axis] - 1) / layout.chunk[axis];
    // Every chunk has its key in the file, so there is no need to allocate for more.
    const std::size_t count = chunks_[0] * chunks_[1];
    if (count > file.size() / kKeyBytes) throw broken_file("it has more chunks than fit into it");
    missing_ = count;
    seen_.resize(count);
    const std::uint64_t bytes =
        std::uint64_t{layout.shape[0]} * layout.shape[1] * layout.value_bytes;
    file.claim(bytes);
    values_.resize(bytes);
  }

  void add(std::string_view key, std::uint64_t address) {
    ByteCursor cursor(key);
    const auto stored_bytes = cursor.number<std::uint32_t>();
    const auto skipped = cursor.number<std::uint32_t>();
    const Pair begin = marked({cursor.number<std::uint64_t>(), cursor.number<std::uint64_t>()});
    const std::size_t bytes = layout_.chunk[0] * layout_.chunk[1] * layout_.value_bytes;
    put(begin, undo_filters(file_.block(address, stored_bytes), layout_.filters, skipped, bytes,
                            layout_.value_bytes));
  }

  std::string take() {
    if (missing_ > 0) throw broken_file("it has no values for some of its places");
    return std::move(values_);
  }

 private:
  /// Marks the chunk that begins there as seen.
  Pair marked(const Pair& begin) {
    const auto& [rows, columns] = layout_.chunk;
    const bool inside = begin[0] < layout_.shape[0] && begin[1] < layout_.shape[1];
    if (!inside || begin[0] % rows != 0 || begin[1] % columns != 0)
      throw broken_file("one of its chunks is at no place of a chunk");
    const std::size_t number = begin[0] / rows * chunks_[1] + begin[1] / columns;
    if (seen_[number]) throw broken_file("one of its chunks is there twice");
    seen_[number] = true;
    --missing_;
    return begin;
  }

  /// Copies the part of a chunk that is inside the array; chunks at the ends may go beyond.
  void put(const Pair& begin, const std::string& chunk) {
    const std::size_t rows = std::min(layout_.chunk[0], layout_.shape[0] - begin[0]);
    const std::size_t columns = std::min(layout_.chunk[1], layout_.shape[1] - begin[1]);
    const std::size_t size = layout_.value_bytes;
    for (std::size_t i = 0; i < rows; ++i)
      std::copy_n(chunk.data() + i * layout_.chunk[1] * size, columns * size,
                  values_.data() + ((begin[0] + i) * layout_.shape[1] + begin[1]) * size);
  }

  UntrustedFile& file_;
  const Layout& layout_;
  Pair chunks_{};
  std::size_t missing_ = 0;
  std::vector<bool> seen_;
  std::string values_;
};

}  // namespace

Array hdf5_array(UntrustedFile& file, const Hdf5Object& dataset) {
  const auto shape = hdf5_shape(only_message(dataset, Hdf5Kind::dataspace));
  const std::string_view datatype = only_message(dataset, Hdf5Kind::datatype);
  const Hdf5Type type = hdf5_type(datatype);
  if (!shape) return {{}, NotUsed{}};
  if (!may_read(*shape) || (type != Hdf5Type::float32 && type != Hdf5Type::float64))
    return {*shape, NotUsed{}};
  const Layout layout = layout_of(dataset, {(*shape)[0], (*shape)[1]}, hdf5_value_bytes(datatype));
  Collector collector(file, layout);
  const auto add = [&](std::string_view key, std::uint64_t place) { collector.add(key, place); };
  if (layout.tree != kNoAddress) for_each_leaf(file, Hdf5Tree::chunks, layout.tree, kKeyBytes, add);
  const std::string bytes = collector.take();
  if (type == Hdf5Type::float32) return {*shape, numbers_in<float>(bytes)};
  return {*shape, numbers_in<double>(bytes)};
}

}  // namespace vndf::io
