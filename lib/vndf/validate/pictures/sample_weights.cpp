// Weights of sampled reflections over the unit square of random numbers.
#include "vndf/validate/pictures/sample_weights.h"

#include <algorithm>

#include "vndf/bsdf/scatter.h"
#include "vndf/validate/statistics/block_random.h"

namespace vndf::validate {
namespace {

constexpr std::uint64_t kSeed = 1;  // a picture is the same in every run

/// G2 D dot(wi, wm)+ / (wi.z pdf(wm)): the weight of a normal that is drawn with density `pdf`.
double weight_of(const SamplerUnderTest& sampler, const Configuration& c, const Vec3<double>& wm,
                 double d, double pdf) {
  const double cosine = dot(c.wi, wm);
  const Vec3<double> wo = reflect(c.wi, wm);
  if (!(cosine > 0) || !(wo.z > 0) || !(pdf > 0)) return 0;
  return sampler.g2(c.alpha, c.wi, wo, wm) * cosine / c.wi.z * (d / pdf);
}

/// A random point of each cell of row `j`. The last digits of the middles of cells are all alike,
/// and some samplers take them for a third random number.
std::vector<RandomPair> places_in_row(std::size_t j, std::size_t cells) {
  BlockRandom random(kSeed, 0, j);
  const double side = static_cast<double>(cells);
  std::vector<RandomPair> u(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    u[i].x = to_single((static_cast<double>(i) + random.uniform()) / side);
    u[i].y = to_single((static_cast<double>(j) + random.uniform()) / side);
  }
  return u;
}

/// The weights at `c` of normals that are drawn for `drawn_for`, whose density is `pdf_of(wm, d)`.
template <class Pdf>
SampleWeights weights(const SamplerUnderTest& sampler, const Configuration& c,
                      const Configuration& drawn_for, std::size_t cells, Pdf pdf_of) {
  SampleWeights result;
  result.weight = Grid(cells, cells);
  const double side = static_cast<double>(cells);
  std::vector<Vec3<double>> wm(cells);
  std::vector<double> d(cells);
  for (std::size_t j = 0; j < cells; ++j) {
    const std::vector<RandomPair> u = places_in_row(j, cells);
    sampler.sample(drawn_for, u, wm);
    sampler.d(c.alpha, wm, d);
    const std::vector<double> pdf = pdf_of(wm, d);
    for (std::size_t i = 0; i < cells; ++i) {
      const double weight = weight_of(sampler, c, wm[i], d[i], pdf[i]);
      result.weight.at(i, j) = weight;
      result.largest = std::max(result.largest, weight);
      result.mean += weight / (side * side);
      if (weight == 0) result.lost += 1 / (side * side);
    }
  }
  return result;
}

}  // namespace

SampleWeights sample_weights(const SamplerUnderTest& sampler, const Configuration& c,
                             std::size_t cells) {
  return weights(sampler, c, c, cells, [&](const auto& wm, const auto&) {
    std::vector<double> pdf(wm.size());
    sampler.pdf(c, wm, pdf);
    return pdf;
  });
}

SampleWeights previous_weights(const SamplerUnderTest& sampler, const Configuration& c,
                               std::size_t cells) {
  const Configuration from_above{{0, 0, 1}, c.alpha};
  return weights(sampler, c, from_above, cells, [](const auto& wm, const auto& d) {
    std::vector<double> pdf(wm.size());
    for (std::size_t k = 0; k < wm.size(); ++k) pdf[k] = d[k] * wm[k].z;
    return pdf;
  });
}

}  // namespace vndf::validate
