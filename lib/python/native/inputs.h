// What a function of a sampler takes for each sample: directions, random numbers, surfaces.
#pragma once

#include <cstddef>

#include "arrays.h"
#include "vndf/rough_surface.h"
#include "vndf/vec.h"

namespace vndf::python {

/// An array of vectors.
class Vectors {
 public:
  static constexpr std::size_t kWidth = 3;

  explicit Vectors(const py::array& array) : columns_(array) {}
  const Columns& columns() const { return columns_; }

  template <class T>
  Vec3<T> at(const Block<T, kWidth>& block, std::size_t i) const {
    return {block.columns[0][i], block.columns[1][i], block.columns[2][i]};
  }

 private:
  Columns columns_;
};

/// An array of K random numbers for each sample.
template <std::size_t K>
class RandomNumbers {
 public:
  static constexpr std::size_t kWidth = K;

  explicit RandomNumbers(const py::array& array) : columns_(array) {}
  const Columns& columns() const { return columns_; }

  template <class T>
  std::array<T, K> at(const Block<T, K>& block, std::size_t i) const {
    std::array<T, K> u;
    for (std::size_t k = 0; k < K; ++k) u[k] = block.columns[k][i];
    return u;
  }

 private:
  Columns columns_;
};

/// An array of surfaces: of two numbers each, roughness along x and y, or of the five that store a
/// RoughSurface in double precision.
class Surfaces {
 public:
  static constexpr std::size_t kWidth = 5;

  explicit Surfaces(const py::array& array) : columns_(array) {}
  const Columns& columns() const { return columns_; }
  /// Whether they have no correlation and no mean slope.
  bool flat() const { return columns_.width() < kWidth; }

  template <class T>
  RoughSurface<T> at(const Block<T, kWidth>& block, std::size_t i) const {
    const auto& c = block.columns;
    if (flat()) return Alpha<T>{c[0][i], c[1][i]};
    return {{c[0][i], c[1][i]}, c[2][i], {c[3][i], c[4][i]}};
  }

 private:
  Columns columns_;
};

}  // namespace vndf::python
