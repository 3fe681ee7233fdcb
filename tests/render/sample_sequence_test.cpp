// The numbers of a path: even, scrambled and independent.
#include "render/sample_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::render;

namespace {

constexpr std::uint32_t kPaths = 256;

/// The points of the first kPaths paths of a pixel in the pair of dimensions `pair`.
std::vector<Vec2<float>> points(std::uint64_t seed, std::uint64_t pixel, int pair) {
  std::vector<Vec2<float>> list;
  for (std::uint32_t path = 0; path < kPaths; ++path) {
    SampleSequence numbers(seed, pixel, path);
    for (int i = 0; i < pair; ++i) numbers.next_pair();
    list.push_back(numbers.next_pair());
  }
  return list;
}

/// The boxes of a grid of 2^k columns and kPaths / 2^k rows that have a point.
std::size_t boxes_with_points(const std::vector<Vec2<float>>& list, int k) {
  const float columns = std::ldexp(1.0f, k), rows = static_cast<float>(kPaths) / columns;
  std::set<int> boxes;
  for (const auto& u : list)
    boxes.insert(static_cast<int>(u.x * columns) * 1000 + static_cast<int>(u.y * rows));
  return boxes.size();
}

double correlation(const std::vector<Vec2<float>>& a, const std::vector<Vec2<float>>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (static_cast<double>(a[i].x) - 0.5) * (static_cast<double>(b[i].x) - 0.5);
  return 12 * sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("every box of a size that halving makes has one point of a pixel", "[render]") {
  for (const int pair : {0, 1, 7})
    for (int k = 0; k <= 8; ++k) {
      CAPTURE(pair, k);
      CHECK(boxes_with_points(points(3, 17, pair), k) == kPaths);
    }
}

TEST_CASE("numbers are in [0, 1) and fill it evenly over many pixels", "[render]") {
  constexpr std::size_t kBins = 64, kPixels = 40000;
  std::vector<double> counts(kBins);
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    const float u = SampleSequence(1, pixel, 0).next();
    REQUIRE(u >= 0);
    REQUIRE(u < 1);
    counts[static_cast<std::size_t>(u * kBins)] += 1;
  }
  double chi_square = 0;
  for (const double n : counts)
    chi_square += (n - kPixels / kBins) * (n - kPixels / kBins) / (kPixels / kBins);
  CHECK(chi_square < 130);  // 63 degrees of freedom: exceeded with probability 2e-6
}

TEST_CASE("pairs, pixels and seeds have nothing to do with each other", "[render]") {
  const auto first = points(1, 1, 0);
  // A sum of 256 products of independent numbers has the standard error 1/16.
  constexpr double kBound = 5.0 / 16;
  CHECK(std::abs(correlation(first, points(1, 1, 1))) < kBound);
  CHECK(std::abs(correlation(first, points(1, 2, 0))) < kBound);
  CHECK(std::abs(correlation(first, points(2, 1, 0))) < kBound);
  CHECK(correlation(first, points(1, 1, 0)) == Approx(1).margin(0.01));
}
