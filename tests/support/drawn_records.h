// Records as the author of a sampler would write them, for tests of the validator.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "vndf/validate/records.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/validate.h"

namespace vndf::test {

/// `count` records of a sampler of precision T at each of `list`, in turn, with single-precision
/// random numbers.
template <class Sampler>
validate::Records draw_records(const Sampler& sampler,
                               std::span<const validate::Configuration> list, std::size_t count,
                               std::uint64_t seed) {
  using T = typename Sampler::Scalar;
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<float>(random() >> 40) * 0x1p-24f; };
  validate::Records records{
      .list = {}, .has_u = true, .has_pdf = true, .read = count * list.size()};
  for (std::size_t k = 0; k < records.read; ++k) {
    const validate::Configuration& c = list[k % list.size()];
    const T u1 = T(uniform()), u2 = T(uniform());
    const auto wi = validate::vector_of<T>(c.wi);
    const auto alpha = validate::alpha_of<T>(c.alpha);
    const Vec3<T> wm = sampler.sample(wi, alpha, u1, u2);
    records.list.push_back({c, validate::vector_of<double>(wm), double{u1}, double{u2},
                            double{sampler.pdf(wi, wm, alpha)}});
  }
  return records;
}

/// `count` configurations of all incidences and azimuths and of roughness from 0.1 to 1.1.
inline std::vector<validate::Configuration> random_configurations(std::size_t count,
                                                                  std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<validate::Configuration> list;
  for (std::size_t k = 0; k < count; ++k) {
    const double theta = 90 * uniform(random), phi = 360 * uniform(random);
    const double ax = 0.1 + uniform(random);
    list.push_back(validate::at_angles(theta, phi, ax, 0.1 + uniform(random)));
  }
  return list;
}

/// The random numbers of one form of a map: in the other role, or counted from the other end.
inline validate::Records in_form(validate::Records records, bool swapped, bool mirrored_1,
                                 bool mirrored_2) {
  for (validate::Record& r : records.list) {
    if (swapped) std::swap(r.u1, r.u2);
    if (mirrored_1) r.u1 = 1 - r.u1;
    if (mirrored_2) r.u2 = 1 - r.u2;
  }
  return records;
}

/// The result of a statistic, which must be there; its check is `check`.
inline const validate::CheckResult& result_of(const validate::Verdict& verdict,
                                              const std::string& check,
                                              const std::string& statistic) {
  const auto& list = verdict.results;
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& f) {
    return f.check == check && f.statistic == statistic;
  });
  if (found == list.end())
    throw std::runtime_error("there is no result " + check + ", " + statistic);
  return *found;
}

}  // namespace vndf::test
