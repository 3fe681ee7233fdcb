// A sampler under test, whatever its type: its functions behind std::function, called per
// batch of samples so that the indirection costs nothing, and what it claims.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/bsdf/dielectric_bsdf.h"
#include "vndf/bsdf/masking.h"
#include "vndf/bsdf/normal_sampler.h"
#include "vndf/certificate.h"
#include "vndf/kernel_tables.h"
#include "vndf/slope_tables.h"
#include "vndf/validate/exact/exact_distribution.h"
#include "vndf/validate/statistics/uniformity.h"

namespace vndf::validate {

/// What a sampler must keep to pass.
struct Bounds {
  /// |CDF(x(u)) - u|. A sampler without tables is to be right to 1e-5: ten times the rounding of a
  /// single-precision normal, and below what 1e10 samples of it could show in an image.
  double u_error = 1e-5;
  /// |sampled / exact mass - 1| of a tail of 2^-20 (1e-6): four of whose single-precision random
  /// numbers in a hundred are off by one rounding at the end u = 1.
  double tail_error = 0.05;
  /// Density of the map against the pdf, relative, by finite differences in double precision.
  double density_error = 1e-3;
  /// pdf, D (relative), Lambda (of 1 + Lambda) and G1 (relative), and all integrals of them. The
  /// largest rounding is that of D of Beckmann at its rim, 4.1e-5.
  double function_error = 1e-4;
  /// What the distribution of the normals may differ from the exact one: nothing, for a sampler
  /// without tables.
  DeclaredErrors declared = {};
};

/// What a sampler claims to be.
struct Claims {
  SampledNormals normals = SampledNormals::visible_smith;
  /// Whether sample() is the monotone inverse of the distribution in (u1, u2): slope x at u1, then
  /// slope y given x at u2, both increasing in the frame of the stretched incident direction.
  bool monotone_inverse = false;
  /// Whether its map is of a few smooth pieces, so that even random numbers give an even
  /// distribution. False for one that takes the last digits of a random number for another.
  bool smooth = true;
  /// Angle of the stretched incident direction, in degrees, from which it is that: published
  /// samplers take polar coordinates instead near normal incidence.
  double inverse_from = 0;

  bool inverse_at(const Configuration& c) const {
    const double horizontal = std::hypot(c.alpha.x * c.wi.x, c.alpha.y * c.wi.y);
    return monotone_inverse && std::atan2(horizontal, c.wi.z) / kDegree >= inverse_from;
  }
};

/// Refractive index of glass over that of air.
inline constexpr double kGlassIndex = 1.5;

/// Directions and random numbers are given in double precision but are whole single-precision
/// numbers, except to sample_double.
struct SamplerUnderTest {
  std::string name;
  std::shared_ptr<const ExactSlopes> exact;
  Claims claims;
  Bounds bounds;

  std::function<void(const Configuration&, std::span<const RandomPair> u,
                     std::span<Vec3<double>> wm)>
      sample;
  /// The same map in double precision; may be empty.
  std::function<void(const Configuration&, std::span<const RandomPair> u,
                     std::span<Vec3<double>> wm)>
      sample_double;
  /// The density of the map at a normal that is sampled, as the sampler gives it with the normal,
  /// where there is no map in double precision to differentiate; may be empty.
  std::function<double(const Configuration&, const RandomPair& u)> map_density;
  std::function<void(const Configuration&, std::span<const Vec3<double>> wm, std::span<double> pdf)>
      pdf;
  std::function<void(const Alpha<double>&, std::span<const Vec3<double>> wm, std::span<double> d)>
      d;
  std::function<double(const Configuration&)> lambda, g1;
  /// Masking and shadowing of a facet (masking.h), wi and wo on any side.
  std::function<double(const Alpha<double>&, const Vec3<double>& wi, const Vec3<double>& wo,
                       const Vec3<double>& wm)>
      g2;
  /// f(wi, wo) |wo.z| of a rough surface of facets that reflect everything, and of one of facets of
  /// glass.
  std::function<void(const Configuration&, std::span<const Vec3<double>> wo, std::span<double> f)>
      mirror, glass;

  /// One normal.
  Vec3<double> sample_one(const Configuration& c, double u1, double u2) const {
    const RandomPair u{u1, u2};
    Vec3<double> wm{};
    sample(c, {&u, 1}, {&wm, 1});
    return wm;
  }
};

template <class T, class U>
Vec3<T> vector_of(const Vec3<U>& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}
template <class T>
Alpha<T> alpha_of(const Alpha<double>& a) {
  return {static_cast<T>(a.x), static_cast<T>(a.y)};
}

/// Calls `sampler`, of precision T, for a batch.
template <class T, NormalSampler<T> S>
auto batch_of(const S& sampler) {
  return
      [sampler](const Configuration& c, std::span<const RandomPair> u, std::span<Vec3<double>> wm) {
        const Vec3<T> wi = vector_of<T>(c.wi);
        const Alpha<T> alpha = alpha_of<T>(c.alpha);
        for (std::size_t k = 0; k < u.size(); ++k)
          wm[k] = vector_of<double>(
              sampler.sample(wi, alpha, static_cast<T>(u[k].x), static_cast<T>(u[k].y)));
      };
}

/// Evaluates `bsdf`, of precision T, for a batch.
template <class T, class Bsdf>
void evaluate_batch(const Bsdf& bsdf, const Configuration& c, std::span<const Vec3<double>> wo,
                    std::span<double> f) {
  for (std::size_t k = 0; k < wo.size(); ++k) {
    const auto value = bsdf.evaluate(vector_of<T>(c.wi), vector_of<T>(wo[k]));
    if constexpr (std::is_same_v<decltype(value), const T>)
      f[k] = static_cast<double>(value);
    else
      f[k] = static_cast<double>(value[0]);
  }
}

/// Gives `s` the BSDFs of the surface that `sampler` and the masking model M make.
template <class T, class M, class S>
void set_bsdfs_of(SamplerUnderTest& s, const S& sampler) {
  s.g2 = [sampler](const Alpha<double>& alpha, const Vec3<double>& wi, const Vec3<double>& wo,
                   const Vec3<double>& wm) {
    return static_cast<double>(vndf::g2<M>(sampler, vector_of<T>(wi), vector_of<T>(wo),
                                           vector_of<T>(wm), alpha_of<T>(alpha)));
  };
  s.mirror = [sampler](const Configuration& c, std::span<const Vec3<double>> wo,
                       std::span<double> f) {
    const ConductorBrdf brdf(sampler, alpha_of<T>(c.alpha), PerfectMirror<T>{}, M{});
    evaluate_batch<T>(brdf, c, wo, f);
  };
  s.glass = [sampler](const Configuration& c, std::span<const Vec3<double>> wo,
                      std::span<double> f) {
    const DielectricBsdf bsdf(sampler, alpha_of<T>(c.alpha), static_cast<T>(kGlassIndex), M{});
    evaluate_batch<T>(bsdf, c, wo, f);
  };
}

template <class T, class S>
void set_bsdfs(SamplerUnderTest& s, const S& sampler) {
  if (s.claims.normals == SampledNormals::visible_v_cavity)
    set_bsdfs_of<T, VCavityMasking>(s, sampler);
  else
    set_bsdfs_of<T, SmithCorrelated>(s, sampler);
}

/// A sampler made of `sampler`, of precision T. Where its pdf is 0 for a distribution of all
/// normals, or its g1 is that of another surface, `claims` says so.
template <class T, NormalSampler<T> S>
SamplerUnderTest under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                            const S& sampler, const Claims& claims, const Bounds& bounds = {}) {
  SamplerUnderTest s;
  s.name = std::move(name);
  s.exact = std::move(exact);
  s.claims = claims;
  s.bounds = bounds;
  s.sample = batch_of<T>(sampler);
  s.pdf = [sampler](const Configuration& c, std::span<const Vec3<double>> wm,
                    std::span<double> pdf) {
    for (std::size_t k = 0; k < wm.size(); ++k)
      pdf[k] = static_cast<double>(
          sampler.pdf(vector_of<T>(c.wi), vector_of<T>(wm[k]), alpha_of<T>(c.alpha)));
  };
  s.d = [sampler](const Alpha<double>& alpha, std::span<const Vec3<double>> wm,
                  std::span<double> d) {
    for (std::size_t k = 0; k < wm.size(); ++k)
      d[k] = static_cast<double>(sampler.d(vector_of<T>(wm[k]), alpha_of<T>(alpha)));
  };
  s.lambda = [sampler](const Configuration& c) {
    return static_cast<double>(sampler.lambda(vector_of<T>(c.wi), alpha_of<T>(c.alpha)));
  };
  s.g1 = [sampler](const Configuration& c) {
    return static_cast<double>(sampler.g1(vector_of<T>(c.wi), alpha_of<T>(c.alpha)));
  };
  set_bsdfs<T>(s, sampler);
  return s;
}

/// The same with its map in double precision too, for the derivatives, and its BSDFs, for the half
/// vector of two opposite directions is lost in their rounding.
template <NormalSampler<float> S, NormalSampler<double> D>
SamplerUnderTest under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                            const S& sampler, const D& in_double, const Claims& claims,
                            const Bounds& bounds = {}) {
  SamplerUnderTest s =
      under_test<float>(std::move(name), std::move(exact), sampler, claims, bounds);
  s.sample_double = batch_of<double>(in_double);
  set_bsdfs<double>(s, in_double);
  return s;
}

/// The bounds of tables: their own certificate, measured at other places and so taken 1.25 times,
/// and the rounding of a single-precision normal. `columns` of the larger table.
Bounds bounds_of(const Certificate& certificate, std::size_t columns);

/// Tables as a renderer runs them, in single precision.
SamplerUnderTest tables_under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                                   std::shared_ptr<const SlopeTables> tables,
                                   const Certificate& certificate);

/// Baked tables, which are shared, with the bounds of their own certificate.
SamplerUnderTest baked_tables_under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                                         const KernelTables& tables);

}  // namespace vndf::validate
