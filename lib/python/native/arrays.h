// Arrays of NumPy, whatever their strides, as a sampler wants them: blocks of structures of arrays.
// Batches sample from those, and arrays of Python have the numbers of one sample side by side. A
// block is small enough for the first-level cache, so an array is read and written once, and
// nothing of its size is copied.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "interleave.h"
#include "vndf/support/parallel.h"

namespace vndf::python {

namespace py = pybind11;

/// Samples of a block, as many as batches work on at a time. A million normals from random
/// directions took 4.6 ms, and 5.2 to 5.7 ms in blocks of 128 to 1024.
inline constexpr std::size_t kBlock = 64;
/// Samples that a thread takes at a time, so that it is not started for less than some 0.1 ms.
inline constexpr std::size_t kPiece = 32768;

/// The numbers of a block, K for each sample.
template <class T, std::size_t K>
struct Block {
  alignas(64) std::array<std::array<T, kBlock>, K> columns;
};

/// An array of float32 or float64 as samples in the order of C, each of the numbers along the last
/// axis. Refers to the array, which must outlive it.
class Columns {
 public:
  /// `array` has at least one axis. Throws std::invalid_argument for another type of numbers.
  explicit Columns(const py::array& array);
  /// The same for an array that is written. Throws std::invalid_argument if it is read-only.
  static Columns written(py::array& array);

  /// How many samples, and how many numbers each of them has.
  std::size_t size() const { return size_; }
  std::size_t width() const { return width_; }
  bool in_double() const { return in_double_; }
  /// Whether all samples have the same numbers, as after numpy.broadcast_to.
  bool uniform() const { return uniform_; }

  /// Reads the numbers of the samples [begin, begin + count) into the first columns of `block`.
  template <class T, std::size_t K>
  void read(std::size_t begin, std::size_t count, Block<T, K>& block) const {
    if (in_double_)
      read_as<double>(begin, count, block);
    else
      read_as<float>(begin, count, block);
  }

  /// Writes the columns of `block` from `first` on, as many as samples have numbers.
  template <class T, std::size_t K>
  void write(std::size_t begin, std::size_t count, const Block<T, K>& block,
             std::size_t first) const {
    for_each_run(begin, count, [&](std::ptrdiff_t at, std::size_t from, std::size_t n) {
      if constexpr (std::is_same_v<T, float> && K >= 3)
        if (packed_ && width_ == 3)
          return join_triples(&block.columns[first][from], &block.columns[first + 1][from],
                              &block.columns[first + 2][from], n,
                              reinterpret_cast<float*>(data_ + at));
      for (std::size_t k = 0; k < width_; ++k) {
        char* target = data_ + at + static_cast<std::ptrdiff_t>(k) * width_stride_;
        const T* const column = &block.columns[first + k][from];
        for (std::size_t i = 0; i < n; ++i, target += step_)
          *reinterpret_cast<T*>(target) = column[i];
      }
    });
  }

 private:
  struct Axis {
    std::ptrdiff_t length, stride;
  };

  template <class S, class T, std::size_t K>
  void read_as(std::size_t begin, std::size_t count, Block<T, K>& block) const {
    for_each_run(begin, count, [&](std::ptrdiff_t at, std::size_t from, std::size_t n) {
      if constexpr (std::is_same_v<S, float> && std::is_same_v<T, float>)
        if (packed_ && split_packed(at, from, n, block)) return;
      for (std::size_t k = 0; k < std::min(width_, K); ++k) {
        const char* source = data_ + at + static_cast<std::ptrdiff_t>(k) * width_stride_;
        T* const column = &block.columns[k][from];
        for (std::size_t i = 0; i < n; ++i, source += step_)
          column[i] = static_cast<T>(*reinterpret_cast<const S*>(source));
      }
    });
  }

  /// Reads a run of pairs or triples by vectors; false for another number of them.
  template <std::size_t K>
  bool split_packed(std::ptrdiff_t at, std::size_t from, std::size_t n,
                    Block<float, K>& block) const {
    const auto* const source = reinterpret_cast<const float*>(data_ + at);
    auto& columns = block.columns;
    if (K >= 2 && width_ == 2) {
      split_pairs(source, n, &columns[0][from], &columns[1][from]);
      return true;
    }
    if constexpr (K >= 3)
      if (width_ == 3) {
        split_triples(source, n, &columns[0][from], &columns[1][from], &columns[2][from]);
        return true;
      }
    return false;
  }

  /// Calls run(bytes from the first number, samples before it, samples in it) for each piece of
  /// [begin, begin + count) that lies along the last of the axes.
  template <class Run>
  void for_each_run(std::size_t begin, std::size_t count, Run run) const {
    for (std::size_t done = 0; done < count;) {
      auto index = static_cast<std::ptrdiff_t>(begin + done);
      std::ptrdiff_t at = 0, left = 1;
      for (std::size_t a = axes_.size(); a-- > 0;) {
        const std::ptrdiff_t place = index % axes_[a].length;
        if (a + 1 == axes_.size()) left = axes_[a].length - place;
        at += place * axes_[a].stride;
        index /= axes_[a].length;
      }
      const std::size_t n = std::min(count - done, static_cast<std::size_t>(left));
      run(at, done, n);
      done += n;
    }
  }

  char* data_;
  std::vector<Axis> axes_;   ///< of samples, without those that are one with the next
  std::ptrdiff_t step_ = 0;  ///< along the last of them
  std::ptrdiff_t width_stride_;
  std::size_t size_ = 1, width_;
  bool in_double_, uniform_ = true;
  bool packed_ = false;  ///< the numbers of the samples of a run follow each other
};

/// An array that is written, and which of the results of a sample it takes first.
struct Output {
  const Columns& columns;
  std::size_t first = 0;
};

/// Calls piece(begin, end) for pieces of [0, size), on several threads (0 means one for each
/// processor) and without the lock of the interpreter.
template <class Piece>
void for_each_piece(std::size_t size, unsigned threads, Piece piece) {
  const py::gil_scoped_release release;
  support::parallel_for((size + kPiece - 1) / kPiece, {.threads = threads}, [&](std::size_t i) {
    piece(i * kPiece, std::min(size, (i + 1) * kPiece));
  });
}

/// Calls `result` for each sample with what each of `inputs` (inputs.h) has for it, and writes the
/// K numbers that it returns.
template <class T, std::size_t K, class Result, class... Inputs>
void for_each_sample(std::size_t size, unsigned threads, const std::vector<Output>& outputs,
                     Result result, const Inputs&... inputs) {
  for_each_piece(size, threads, [&](std::size_t begin, std::size_t end) {
    std::tuple<Block<T, Inputs::kWidth>...> blocks;
    Block<T, K> results;
    for (std::size_t at = begin; at < end; at += kBlock) {
      const std::size_t n = std::min(kBlock, end - at);
      std::apply([&](auto&... block) { (inputs.columns().read(at, n, block), ...); }, blocks);
      for (std::size_t i = 0; i < n; ++i) {
        const std::array<T, K> numbers = std::apply(
            [&](const auto&... block) { return result(inputs.at(block, i)...); }, blocks);
        for (std::size_t k = 0; k < K; ++k) results.columns[k][i] = numbers[k];
      }
      for (const Output& output : outputs) output.columns.write(at, n, results, output.first);
    }
  });
}

}  // namespace vndf::python
