// The distribution of the sampled normals: each is transformed to two uniform numbers by the closed
// CDFs and counted in 10007 bins (a prime, so that no bin is aligned with the cells of a table).
// The slow test draws 1e8 normals in each of 12 cases: it sees relative errors of 2e-3 in a bin.
// There the rounding of a single-precision normal, 1e-7 against bins of 1e-4, itself adds about 0.7
// standard deviations to the statistic.
#include <atomic>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "support/built_tables.h"
#include "support/catch.h"
#include "support/tolerances.h"
#include "support/visible_normals.h"
#include "vndf/tabulated_sampler.h"

using namespace vndf;
using namespace vndf::test;

namespace {

constexpr std::size_t kBins = 10007;
using Counts = std::vector<std::uint64_t>;

struct Case {
  double degrees, azimuth, ax, ay;
};

const std::vector<Case> kCases{{0, 0, 0.5, 0.5},    {10, 20, 0.1, 0.1},  {30, 45, 2, 1},
                               {60, 45, 2, 1},      {75, 100, 0.3, 0.9}, {85, 0, 1, 1},
                               {89, 200, 0.2, 0.2}, {89.9, 10, 1, 0.01}, {45, 300, 0.001, 0.001},
                               {80, 0, 10, 10},     {1e-3, 70, 1, 1},    {50, 160, 0.01, 5}};

/// p-value of counts that should be equal.
double p_value(const Counts& counts, double total) {
  const double expected = total / static_cast<double>(counts.size());
  double statistic = 0;
  for (const auto count : counts) {
    const double excess = static_cast<double>(count) - expected;
    statistic += excess * excess / expected;
  }
  const boost::math::chi_squared distribution(static_cast<double>(counts.size() - 1));
  return cdf(complement(distribution, statistic));
}

std::size_t bin(double v) {
  return std::min(static_cast<std::size_t>(v * kBins), kBins - 1);
}

struct Verdict {
  double p1, p2;
};

/// Draws `total` normals with `sample(wi, alpha, u1, u2)` and counts both uniform numbers.
template <class Forms, class Sample>
Verdict counted(const Case& c, std::uint64_t total, std::uint64_t seed, Sample sample) {
  const auto wi = direction_at<float>(c.degrees, c.azimuth);
  const Alpha<float> alpha{static_cast<float>(c.ax), static_cast<float>(c.ay)};
  const VisibleDistribution<Forms> distribution(wi, alpha);
  Counts first(kBins), second(kBins);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return std::ldexp(static_cast<float>(random() >> 40), -24); };
  for (std::uint64_t k = 0; k < total; ++k) {
    const float u1 = uniform();
    const auto v = distribution(sample(wi, alpha, u1, uniform()));
    ++first[bin(v.x)];
    ++second[bin(v.y)];
  }
  return {p_value(first, static_cast<double>(total)), p_value(second, static_cast<double>(total))};
}

template <class Forms>
Verdict judge_tables(const Case& c, std::uint64_t total, std::uint64_t seed) {
  const TabulatedSampler<float> sampler(large_tables(Forms::name).tables);
  return counted<Forms>(c, total, seed, [&](const auto& wi, const auto& alpha, float u1, float u2) {
    return sampler.sample(wi, alpha, u1, u2);
  });
}

}  // namespace

TEST_CASE("1e6 sampled normals of each distribution pass a chi-square test with 10007 bins") {
  for (std::size_t k = 0; k < kCases.size(); ++k) {
    const Verdict v = k % 2 == 0 ? judge_tables<GgxForms>(kCases[k], 1000000, k)
                                 : judge_tables<BeckmannForms>(kCases[k], 1000000, k);
    CAPTURE(k);
    CHECK(v.p1 > kSignificance);
    CHECK(v.p2 > kSignificance);
  }
}

TEST_CASE("the chi-square test rejects a sampler that takes alpha_x for alpha_y") {
  const TabulatedSampler<float> sampler(large_tables("ggx").tables);
  const auto v = counted<GgxForms>(kCases[4], 1000000, 1,
                                   [&](const auto& wi, const auto& alpha, float u1, float u2) {
                                     return sampler.sample(wi, {alpha.x, alpha.x}, u1, u2);
                                   });
  CHECK(std::min(v.p1, v.p2) < kSignificance);
}

TEST_CASE("the chi-square test rejects a sampler that samples the normals, visible or not") {
  const TabulatedSampler<float> sampler(large_tables("beckmann").tables);
  const auto v = counted<BeckmannForms>(kCases[5], 1000000, 1,
                                        [&](const auto&, const auto& alpha, float u1, float u2) {
                                          return sampler.sample({0, 0, 1}, alpha, u1, u2);
                                        });
  CHECK(std::min(v.p1, v.p2) < kSignificance);
}

TEST_CASE("1e8 sampled normals in each of 12 cases pass a chi-square test with 10007 bins",
          "[.slow]") {
  constexpr std::uint64_t kTotal = 100000000;
  const std::uint64_t seed = std::random_device{}();
  large_tables("ggx");  // built before the threads share them
  large_tables("beckmann");
  std::vector<Verdict> verdicts(2 * kCases.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < verdicts.size();) {
      const Case& c = kCases[i / 2];
      verdicts[i] = i % 2 == 0 ? judge_tables<GgxForms>(c, kTotal, seed + i)
                               : judge_tables<BeckmannForms>(c, kTotal, seed + i);
    }
  };
  {
    std::jthread other(work);
    work();
  }
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Case& c = kCases[i / 2];
    WARN((i % 2 == 0 ? "ggx" : "beckmann")
         << " theta " << c.degrees << " alpha " << c.ax << " " << c.ay << ": p = " << verdicts[i].p1
         << ", " << verdicts[i].p2 << " (seed " << seed + i << ")");
    CHECK(verdicts[i].p1 > kSignificance);
    CHECK(verdicts[i].p2 > kSignificance);
  }
}
