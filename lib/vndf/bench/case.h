// One case of the benchmark: a sampler, how it is run, and all that is known of it before.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "vndf/bench/pollution.h"
#include "vndf/bench/sample_inputs.h"
#include "vndf/certificate.h"
#include "vndf/vec.h"

namespace vndf::bench {

/// Errors of the law that a sampler draws from; none where a figure has no meaning or is not known.
struct Errors {
  std::optional<double> u;           ///< largest |CDF(x(u)) - u| of both slopes
  std::optional<double> density;     ///< largest |sampled / exact - 1|, u in [1e-6, 1 - 1e-6]
  std::optional<double> tail_ratio;  ///< sampled / exact mass at 1e-6, farthest from 1
};

/// The worst figures of both tables.
Errors errors_of(const Certificate& certificate);

/// How a sampler came about, in the order in which a report lists them; `baseline` is the unit of
/// all ratios.
enum class Kind { baseline, reference, literal, table, kernel };

/// "baseline", "reference", ...
const char* name_of(Kind kind);

/// A sampler that is ready to run. Every run writes a normal for each sample of the block.
struct Runner {
  /// For one direction and roughness, that of the block being ignored; and for those of the block.
  /// A sampler for batches sets these two directly, a scalar one all four by scalar_runs().
  std::function<void(const Vec3<float>& wi, const Alpha<float>& alpha, const SampleBlock&)>
      coherent = {};
  std::function<void(const SampleBlock&)> incoherent = {};
  /// As `incoherent`, but each sample waits for the normal before: what a sample costs a path that
  /// has nothing else to do. Empty for batches.
  std::function<void(const SampleBlock&)> chained = {};
  /// As `chained`, with the caches polluted between samples. Empty for batches.
  std::function<void(const SampleBlock&, Pollution&)> polluted = {};
  /// From a file to the first sample; empty for samplers without files.
  std::function<void()> setup = {};
  /// What sampling may read.
  std::size_t bytes = 0;
  /// Wall-clock time to build the tables and to measure them.
  double build_seconds = 0;
  Errors errors = {};
};

/// A sampler that is made only if it is to run. What its tables share with other cases comes from
/// SharedBuilds.
struct Case {
  std::string name;          ///< begins with that of the distribution; unique
  std::string distribution;  ///< its specification
  Kind kind;
  std::function<Runner()> make;
};

/// Reading and writing sample `k` of a block in precision T.
template <class T>
Vec3<T> direction_at(const SampleBlock& b, std::size_t k) {
  return {T{b.wi_x[k]}, T{b.wi_y[k]}, T{b.wi_z[k]}};
}
template <class T>
Alpha<T> alpha_at(const SampleBlock& b, std::size_t k) {
  return {T{b.alpha_x[k]}, T{b.alpha_y[k]}};
}
template <class T>
void write_normal(const SampleBlock& b, std::size_t k, const Vec3<T>& m) {
  b.wm_x[k] = static_cast<float>(m.x);
  b.wm_y[k] = static_cast<float>(m.y);
  b.wm_z[k] = static_cast<float>(m.z);
}

/// What a run holds of a sampler: itself where it is a few numbers, as a renderer would have it on
/// the stack, so that a store of a normal is known not to change it; else a reference.
template <class Sampler>
using Held =
    std::conditional_t<std::is_trivially_copyable_v<Sampler>, const Sampler, const Sampler&>;

/// Runs of `sampler`, which draws one normal at a time in precision T.
template <class T, class Sampler>
Runner scalar_runs(Sampler sampler) {
  Runner r;
  r.coherent = [sampler](const Vec3<float>& wi, const Alpha<float>& alpha, const SampleBlock& b) {
    Held<Sampler> held = sampler;
    const Vec3<T> w{wi.x, wi.y, wi.z};
    const Alpha<T> a{alpha.x, alpha.y};
    for (std::size_t k = 0; k < b.size(); ++k)
      write_normal(b, k, held.sample(w, a, T{b.u1[k]}, T{b.u2[k]}));
  };
  r.incoherent = [sampler](const SampleBlock& b) {
    Held<Sampler> held = sampler;
    for (std::size_t k = 0; k < b.size(); ++k)
      write_normal(b, k,
                   held.sample(direction_at<T>(b, k), alpha_at<T>(b, k), T{b.u1[k]}, T{b.u2[k]}));
  };
  r.chained = [sampler](const SampleBlock& b) {
    Held<Sampler> held = sampler;
    Vec3<T> last{0, 0, 1};
    for (std::size_t k = 0; k < b.size(); ++k) {
      const Vec3<T> wi = direction_at<T>(b, k);
      const Vec3<T> w{wi.x + kTiny * last.x, wi.y + kTiny * last.y, wi.z + kTiny * last.z};
      last = held.sample(w, alpha_at<T>(b, k), T{b.u1[k]}, T{b.u2[k]});
      write_normal(b, k, last);
    }
  };
  r.polluted = [sampler](const SampleBlock& b, Pollution& pollution) {
    Held<Sampler> held = sampler;
    Vec3<T> last{0, 0, 1};
    for (std::size_t k = 0; k < b.size(); ++k) {
      const T zero{pollution.read(static_cast<float>(last.x + last.y + last.z))};
      const Vec3<T> wi = direction_at<T>(b, k);
      const Vec3<T> w{wi.x + zero, wi.y + zero, wi.z + zero};
      last = held.sample(w, alpha_at<T>(b, k), T{b.u1[k]}, T{b.u2[k]});
      write_normal(b, k, last);
    }
  };
  return r;
}

}  // namespace vndf::bench
