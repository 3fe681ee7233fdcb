// Derivatives from equidistant values, by the polynomial through the nearest of them, and how steep
// a monotone cubic may be. The tangents of tables, maps and curves are made of both.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "vndf/cubic_piece.h"

namespace vndf {

/// Row i: weights of N values for the derivative, per spacing, at the i-th of them.
template <std::size_t N>
using Stencils = std::array<std::array<double, N>, N>;

/// Of the parabola: error (f''' / 3) h^2 inside.
inline constexpr Stencils<3> kThreePoints{
    {{-3.0 / 2, 2, -1.0 / 2}, {-1.0 / 2, 0, 1.0 / 2}, {1.0 / 2, -2, 3.0 / 2}}};
/// Of the quartic: error (f^(5) / 30) h^4 inside.
inline constexpr Stencils<5> kFivePoints{{{-25.0 / 12, 4, -3, 4.0 / 3, -1.0 / 4},
                                          {-1.0 / 4, -5.0 / 6, 3.0 / 2, -1.0 / 2, 1.0 / 12},
                                          {1.0 / 12, -2.0 / 3, 0, 2.0 / 3, -1.0 / 12},
                                          {-1.0 / 12, 1.0 / 2, -3.0 / 2, 5.0 / 6, 1.0 / 4},
                                          {1.0 / 4, -4.0 / 3, 3, -4, 25.0 / 12}}};

/// Derivative, per spacing, at place `i` of `count` >= N values `at(0)`, `at(1)`, ... by the N of
/// them nearest to it.
template <std::size_t N, class Values>
double derivative(const Stencils<N>& stencils, Values at, std::size_t count, std::size_t i) {
  const std::size_t first = std::min(i - std::min(i, N / 2), count - N);
  double sum = 0;
  for (std::size_t k = 0; k < N; ++k)
    sum += stencils[i - first][k] * static_cast<double>(at(first + k));
  return sum;
}

/// The largest tangent at place `i` of `count` >= 2 increasing values with which cubics between
/// them increase: kSteepest times the smaller rise to a neighbour.
template <class Values>
double steepest_tangent(Values at, std::size_t count, std::size_t i) {
  const auto rise = [&](std::size_t k) {
    return static_cast<double>(at(k + 1)) - static_cast<double>(at(k));
  };
  return kSteepest * std::min(rise(i > 0 ? i - 1 : 0), rise(std::min(i, count - 2)));
}

}  // namespace vndf
