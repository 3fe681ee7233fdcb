// The distribution of sampled normals: each is transformed to the two numbers, uniform if the
// sampler is right, that the exact CDFs of its stretched slopes give (the probability integral
// transform).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "support/closed_forms.h"
#include "support/directions.h"
#include "vndf/vec.h"

namespace vndf::test {

/// Normals to uniform pairs (V(x), P(Y <= y | x)) by the closed forms of `Forms`.
template <class Forms>
class VisibleDistribution {
 public:
  template <class T>
  VisibleDistribution(const Vec3<T>& wi, const Alpha<T>& alpha)
      : alpha_{double{alpha.x}, double{alpha.y}}, z_(wi.z) {
    const double x = alpha_.x * double{wi.x}, y = alpha_.y * double{wi.y};
    s_ = std::hypot(x, y);
    cos_ = s_ > 0 ? x / s_ : 1;
    sin_ = s_ > 0 ? y / s_ : 0;
  }

  /// The stretched slope in the frame of wi.
  template <class T>
  Vec2<double> slope(const Vec3<T>& m) const {
    const double sx = -double{m.x} / double{m.z} / alpha_.x;
    const double sy = -double{m.y} / double{m.z} / alpha_.y;
    return {cos_ * sx + sin_ * sy, cos_ * sy - sin_ * sx};
  }

  template <class T>
  Vec2<double> operator()(const Vec3<T>& m) const {
    const Vec2<double> at = slope(m);
    return {visible_cdf<Forms>(z_, s_, at.x), Forms::conditional(at.x, at.y)};
  }

 private:
  Alpha<double> alpha_;
  double z_, s_, cos_, sin_;
};

/// Largest |CDF - u| of both slopes.
struct DistributionErrors {
  double x = 0, y = 0;
};

/// Kolmogorov distance of `numbers` from the uniform distribution.
inline double distance_from_uniform(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const double n = static_cast<double>(numbers.size());
  double worst = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double at = static_cast<double>(k) / n;
    worst = std::max({worst, std::abs(numbers[k] - at), std::abs(numbers[k] - at - 1 / n)});
  }
  return worst;
}

/// Two numbers of [0, 1) for k = 0 ... 2^bits - 1, evenly spread (Hammersley): the fraction of them
/// in a region is its area but for a few times 2^-bits times its border.
inline Vec2<double> quasi_random_pair(std::uint32_t k, int bits) {
  std::uint32_t reversed = 0;
  for (int b = 0; b < bits; ++b) reversed |= (k >> b & 1u) << (bits - 1 - b);
  return {std::ldexp(k + 0.5, -bits), std::ldexp(reversed + 0.5, -bits)};
}

/// Kolmogorov distances of the distribution of `sampler` from the exact one, by 2^bits quasi-random
/// pairs: for any map of (u1, u2), monotone or not.
template <class Forms, class T, class Sampler>
DistributionErrors distribution_errors(const Sampler& sampler, const Vec3<T>& wi,
                                       const Alpha<T>& alpha, int bits = 18) {
  const VisibleDistribution<Forms> distribution(wi, alpha);
  std::vector<double> first, second;
  for (std::uint32_t k = 0; k < 1u << bits; ++k) {
    const Vec2<double> u = quasi_random_pair(k, bits);
    const auto v =
        distribution(sampler.sample(wi, alpha, static_cast<T>(u.x), static_cast<T>(u.y)));
    first.push_back(v.x);
    second.push_back(v.y);
  }
  return {distance_from_uniform(first), distance_from_uniform(second)};
}

/// u in [1e-9, 1 - 1e-9], evenly and logarithmically at both ends.
inline std::vector<double> probe_numbers() {
  std::vector<double> list;
  for (int k = 1; k < 200; ++k) list.push_back(k / 200.0);
  for (double e = 1e-9; e < 5e-3; e *= 1.5) {
    list.push_back(e);
    list.push_back(1 - e);
  }
  return list;
}

/// Those of them that are neither 0 nor 1 in T.
template <class T>
std::vector<T> probes() {
  std::vector<T> list;
  for (const double u : probe_numbers())
    if (static_cast<T>(u) > 0 && static_cast<T>(u) < 1) list.push_back(static_cast<T>(u));
  return list;
}

/// Calls `visit(u1, u2)` for each probe u1 with each `stride`-th of the probes u2, another set for
/// the next u1.
template <class T, class Visit>
void for_each_probe(Visit visit, std::size_t stride = 5) {
  const std::vector<T> list = probes<T>();
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t j = i % stride; j < list.size(); j += stride) visit(list[i], list[j]);
}

inline void take_larger(DistributionErrors& worst, double x, double y) {
  // A number that is none counts as the worst of errors.
  worst.x = std::isnan(x) ? 1 : std::max(worst.x, x);
  worst.y = std::isnan(y) ? 1 : std::max(worst.y, y);
}

/// Largest |V(x) - u1| and |P(Y <= y | x) - u2| of a sampler whose slopes are the quantiles of u1
/// and u2.
template <class Forms, class T, class Sampler>
DistributionErrors map_errors(const Sampler& sampler, const Vec3<T>& wi, const Alpha<T>& alpha) {
  const VisibleDistribution<Forms> distribution(wi, alpha);
  DistributionErrors worst;
  for_each_probe<T>([&](T u1, T u2) {
    const auto v = distribution(sampler.sample(wi, alpha, u1, u2));
    take_larger(worst, std::abs(v.x - double{u1}), std::abs(v.y - double{u2}));
  });
  return worst;
}

/// The least e such that no more than a fraction e of quasi-random pairs (u1, u2) gives slopes
/// whose CDFs differ from those of `exact` by more than e. The Kolmogorov distance of the two
/// distributions is at most 2 e. A maximum would be about single pairs: near the horizon a map is
/// not continuous.
template <class Forms, class T, class Sampler, class Exact>
double rounding_error(const Sampler& sampler, const Exact& exact, const Vec3<T>& wi,
                      const Alpha<T>& alpha) {
  constexpr int kBits = 16;
  const VisibleDistribution<Forms> distribution(wi, alpha);
  const Vec3<double> w{double{wi.x}, double{wi.y}, double{wi.z}};
  const Alpha<double> a{double{alpha.x}, double{alpha.y}};
  std::vector<double> off;
  for (std::uint32_t k = 0; k < 1u << kBits; ++k) {
    const Vec2<double> u = quasi_random_pair(k, kBits);
    const T u1 = static_cast<T>(u.x), u2 = static_cast<T>(u.y);
    const auto v = distribution(sampler.sample(wi, alpha, u1, u2));
    const auto e = distribution(exact.sample(w, a, double{u1}, double{u2}));
    DistributionErrors here;
    take_larger(here, std::abs(v.x - e.x), std::abs(v.y - e.y));
    off.push_back(std::max(here.x, here.y));
  }
  std::sort(off.begin(), off.end(), std::greater<>());
  for (std::size_t k = 0; k < off.size(); ++k) {
    const double fraction = std::ldexp(static_cast<double>(k), -kBits);
    if (off[k] <= fraction) return fraction;
  }
  return 1;
}

/// |J pdf - 1| with the Jacobian J = |dm/du1 x dm/du2| of the map by central differences: 0 for the
/// density of the samples, where the map is one-to-one.
template <class Sampler>
double jacobian_error(const Sampler& sampler, const Vec3<double>& wi, const Alpha<double>& alpha,
                      double u1, double u2) {
  constexpr double kStep = 1e-6;
  const auto at = [&](double d1, double d2) { return sampler.sample(wi, alpha, u1 + d1, u2 + d2); };
  const auto difference = [](const Vec3<double>& a, const Vec3<double>& b) {
    return Vec3<double>{(a.x - b.x) / (2 * kStep), (a.y - b.y) / (2 * kStep),
                        (a.z - b.z) / (2 * kStep)};
  };
  const Vec3<double> p = difference(at(kStep, 0), at(-kStep, 0));
  const Vec3<double> q = difference(at(0, kStep), at(0, -kStep));
  const Vec3<double> cross{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  return std::abs(std::sqrt(dot(cross, cross)) * sampler.pdf(wi, at(0, 0), alpha) - 1);
}

/// The largest over u1 and u2 in [0.05, 0.95].
template <class Sampler>
double worst_jacobian_error(const Sampler& sampler, const Vec3<double>& wi,
                            const Alpha<double>& alpha) {
  double worst = 0;
  for (int i = 0; i < 19; ++i)
    for (int j = 0; j < 19; ++j)
      worst = std::max(worst, jacobian_error(sampler, wi, alpha, (i + 1) / 20.0, (j + 1) / 20.0));
  return worst;
}

}  // namespace vndf::test
