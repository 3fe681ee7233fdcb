// A sampler of normals whose type is known when the program runs. Every function calls that of the
// library's class, so the results are those of C++ bit for bit. One call for each sample costs
// nothing beside the sampling; where it would, the vectors of vndf/batch/sample_batch.h are taken.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "vndf/bsdf/normal_sampler.h"
#include "vndf/kernel.h"
#include "vndf/on_surface.h"

namespace vndf::python {

/// The functions of a sampler in the precision T.
template <class T>
class Normals {
 public:
  virtual ~Normals() = default;
  virtual Vec3<T> sample(const Vec3<T>& wi, const RoughSurface<T>& surface, T u1, T u2) const = 0;
  virtual T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const = 0;
  virtual T d(const Vec3<T>& wm, const Alpha<T>& alpha) const = 0;
  virtual T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const = 0;
  virtual T g1(const Vec3<T>& w, const Alpha<T>& alpha) const = 0;
  /// Those of tables alone; of other samplers they do nothing.
  virtual SampledNormal<T> sample_with_density(const Vec3<T>& wi, const Alpha<T>& alpha, T u1,
                                               T u2) const = 0;
  virtual std::optional<Vec2<T>> invert(const Vec3<T>& wi, const Vec3<T>& wm,
                                        const Alpha<T>& alpha) const = 0;
};

/// The functions of `S`, a class of the library.
template <NormalSampler S>
class NormalsOf final : public Normals<typename S::Scalar> {
  using T = typename S::Scalar;

 public:
  explicit NormalsOf(S sampler) : sampler_(std::move(sampler)) {}

  Vec3<T> sample(const Vec3<T>& wi, const RoughSurface<T>& surface, T u1, T u2) const override {
    return OnSurface<S>(sampler_, surface).sample(wi, u1, u2);
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const override {
    return sampler_.pdf(wi, wm, alpha);
  }
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const override { return sampler_.d(wm, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const override {
    return sampler_.lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const override { return sampler_.g1(w, alpha); }

  SampledNormal<T> sample_with_density(const Vec3<T>& wi, const Alpha<T>& alpha, T u1,
                                       T u2) const override {
    if constexpr (requires { sampler_.sample_with_density(wi, alpha, u1, u2); })
      return sampler_.sample_with_density(wi, alpha, u1, u2);
    return {};
  }
  std::optional<Vec2<T>> invert(const Vec3<T>& wi, const Vec3<T>& wm,
                                const Alpha<T>& alpha) const override {
    if constexpr (requires { sampler_.invert(wi, wm, alpha); })
      return sampler_.invert(wi, wm, alpha);
    return {};
  }

 private:
  S sampler_;
};

/// Which normals a sampler draws, and thus what masks them.
enum class Model { visible_smith, visible_v_cavity, all };

/// `Normals` as a class that the templates of the library take. Refers to them.
template <class T, Model M>
class AnyNormals {
 public:
  using Scalar = T;
  static constexpr bool kVisible = M != Model::all;

  explicit AnyNormals(const Normals<T>& normals) : normals_(&normals) {}

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return normals_->sample(wi, alpha, u1, u2);
  }
  Vec3<T> sample(const Vec3<T>& wi, const RoughSurface<T>& surface, T u1, T u2) const noexcept {
    return normals_->sample(wi, surface, u1, u2);
  }
  SampledNormal<T> sample_with_density(const Vec3<T>& wi, const Alpha<T>& alpha, T u1,
                                       T u2) const noexcept {
    return normals_->sample_with_density(wi, alpha, u1, u2);
  }
  std::optional<Vec2<T>> invert(const Vec3<T>& wi, const Vec3<T>& wm,
                                const Alpha<T>& alpha) const noexcept {
    return normals_->invert(wi, wm, alpha);
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return normals_->pdf(wi, wm, alpha);
  }
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept { return normals_->d(wm, alpha); }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return normals_->lambda(w, alpha);
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept { return normals_->g1(w, alpha); }

 private:
  const Normals<T>* normals_;
};

/// A sampler in one precision or both. Copies share it.
class Sampler {
 public:
  Model model = Model::visible_smith;
  std::shared_ptr<const Normals<float>> in_single;
  std::shared_ptr<const Normals<double>> in_double;  ///< null for baked tables alone
  /// The kernel behind `in_single`, if it is one, from which batches are drawn.
  std::optional<Kernel> kernel;
  /// What `kernel` refers to.
  std::shared_ptr<const void> owner;

  /// The sampler in the precision T. Throws std::logic_error where it has none.
  template <class T>
  const Normals<T>& in() const {
    if constexpr (std::is_same_v<T, float>)
      return *in_single;
    else if (in_double)
      return *in_double;
    throw std::logic_error("baked tables have no double precision");
  }
};

}  // namespace vndf::python
