// A sampler with all that is known of it before it is timed.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "bench/sample_inputs.h"
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

/// How a sampler came about; `baseline` is the unit of all ratios.
enum class Kind { baseline, reference, literal, table, compact };

/// "baseline", "reference", ...
const char* name_of(Kind kind);

struct Contestant {
  /// Normals for one direction and roughness, that of a block being ignored; and for those of the
  /// block. A sampler for batches sets them directly, a scalar one by scalar_runs().
  std::function<void(const Vec3<float>& wi, const Alpha<float>& alpha, const SampleBlock&)>
      coherent = {};
  std::function<void(const SampleBlock&)> incoherent = {};
  /// From a file to the first sample; empty for samplers without files.
  std::function<void()> setup = {};
  /// What sampling may read.
  std::size_t bytes = 0;
  /// Wall-clock time to build the tables and to measure them.
  double build_seconds = 0;
  Errors errors = {};
};

/// A contestant that is made only if it is to run.
struct Entrant {
  std::string name;          ///< begins with that of the distribution; unique
  std::string distribution;  ///< its specification
  Kind kind;
  std::size_t side = 0;  ///< rows and columns of a table whose size was asked for
  std::function<Contestant()> make;
};

/// Runs of `sampler`, which draws one normal at a time in precision T.
template <class T, class Sampler>
Contestant scalar_runs(Sampler sampler) {
  Contestant c;
  const auto write = [](const SampleBlock& b, std::size_t k, const Vec3<T>& m) {
    b.wm_x[k] = static_cast<float>(m.x);
    b.wm_y[k] = static_cast<float>(m.y);
    b.wm_z[k] = static_cast<float>(m.z);
  };
  c.coherent = [sampler, write](const Vec3<float>& wi, const Alpha<float>& alpha,
                                const SampleBlock& b) {
    const Vec3<T> w{wi.x, wi.y, wi.z};
    const Alpha<T> a{alpha.x, alpha.y};
    for (std::size_t k = 0; k < b.size(); ++k)
      write(b, k, sampler.sample(w, a, T{b.u1[k]}, T{b.u2[k]}));
  };
  c.incoherent = [sampler = std::move(sampler), write](const SampleBlock& b) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      const Vec3<T> w{b.wi_x[k], b.wi_y[k], b.wi_z[k]};
      const Alpha<T> a{b.alpha_x[k], b.alpha_y[k]};
      write(b, k, sampler.sample(w, a, T{b.u1[k]}, T{b.u2[k]}));
    }
  };
  return c;
}

}  // namespace vndf::bench
