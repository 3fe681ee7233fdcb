// One case of the benchmark: a sampler, how to run it, and what is known about it without timing.
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

/// Errors of the distribution that a sampler draws from. A figure that has no meaning or is unknown
/// is empty.
struct Errors {
  std::optional<double> u;           ///< largest |CDF(x(u)) - u| of both slopes
  std::optional<double> density;     ///< largest |sampled / exact - 1|, u in [1e-6, 1 - 1e-6]
  std::optional<double> tail_ratio;  ///< sampled / exact mass at 1e-6, farthest from 1
};

/// The largest errors of both tables.
Errors errors_of(const Certificate& certificate);

/// How a sampler is made, in the order in which a report lists them. `baseline` is the unit of all
/// ratios.
enum class Kind { baseline, reference, literal, table, kernel };

/// "baseline", "reference", ...
const char* name_of(Kind kind);

/// A sampler that is ready to run. Every run writes a normal for each sample of the block.
struct Runner {
  /// Samples for one direction and roughness instead of those of the block, and for those of the
  /// block. A sampler for batches sets only these two; scalar_runs() sets all four.
  std::function<void(const Vec3<float>& wi, const Alpha<float>& alpha, const SampleBlock&)>
      coherent = {};
  std::function<void(const SampleBlock&)> incoherent = {};
  /// As `incoherent`, but each sample waits for the previous normal, which is what a sample costs a
  /// path that has nothing else to do. Empty for batches.
  std::function<void(const SampleBlock&)> chained = {};
  /// As `chained`, with the caches polluted between samples. Empty for batches.
  std::function<void(const SampleBlock&, Pollution&)> polluted = {};
  /// Everything from opening a file to the first sample; empty for samplers without files.
  std::function<void()> setup = {};
  /// The size of all that sampling may read.
  std::size_t bytes = 0;
  /// Wall-clock time to build the tables and to measure them.
  double build_seconds = 0;
  Errors errors = {};
};

/// A sampler that is made only when it is run, because tables take long to build. Tables that cases
/// share come from SharedBuilds.
struct Case {
  std::string name;          ///< unique; begins with the name of the distribution
  std::string distribution;  ///< its specification
  Kind kind;
  std::function<Runner()> make;
};

/// These read and write sample `k` of a block in precision T.
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

/// A local copy of a sampler that is a few numbers, and a reference to any other. A renderer would
/// have such a copy on the stack too, and the compiler knows that storing a normal does not change
/// it.
template <class Sampler>
using Local =
    std::conditional_t<std::is_trivially_copyable_v<Sampler>, const Sampler, const Sampler&>;

/// All runs of `sampler`, which draws one normal at a time in precision T.
template <class T, class Sampler>
Runner scalar_runs(Sampler sampler) {
  Runner r;
  r.coherent = [sampler](const Vec3<float>& wi, const Alpha<float>& alpha, const SampleBlock& b) {
    Local<Sampler> local = sampler;
    const Vec3<T> w{wi.x, wi.y, wi.z};
    const Alpha<T> a{alpha.x, alpha.y};
    for (std::size_t k = 0; k < b.size(); ++k)
      write_normal(b, k, local.sample(w, a, T{b.u1[k]}, T{b.u2[k]}));
  };
  r.incoherent = [sampler](const SampleBlock& b) {
    Local<Sampler> local = sampler;
    for (std::size_t k = 0; k < b.size(); ++k)
      write_normal(b, k,
                   local.sample(direction_at<T>(b, k), alpha_at<T>(b, k), T{b.u1[k]}, T{b.u2[k]}));
  };
  r.chained = [sampler](const SampleBlock& b) {
    Local<Sampler> local = sampler;
    Vec3<T> last{0, 0, 1};
    for (std::size_t k = 0; k < b.size(); ++k) {
      const Vec3<T> wi = direction_at<T>(b, k);
      const Vec3<T> w{wi.x + kTiny * last.x, wi.y + kTiny * last.y, wi.z + kTiny * last.z};
      last = local.sample(w, alpha_at<T>(b, k), T{b.u1[k]}, T{b.u2[k]});
      write_normal(b, k, last);
    }
  };
  r.polluted = [sampler](const SampleBlock& b, Pollution& pollution) {
    Local<Sampler> local = sampler;
    Vec3<T> last{0, 0, 1};
    for (std::size_t k = 0; k < b.size(); ++k) {
      const T zero{pollution.read(static_cast<float>(last.x + last.y + last.z))};
      const Vec3<T> wi = direction_at<T>(b, k);
      const Vec3<T> w{wi.x + zero, wi.y + zero, wi.z + zero};
      last = local.sample(w, alpha_at<T>(b, k), T{b.u1[k]}, T{b.u2[k]});
      write_normal(b, k, last);
    }
  };
  return r;
}

}  // namespace vndf::bench
