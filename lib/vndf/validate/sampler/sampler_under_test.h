// A sampler under test, whatever its type: its functions behind std::function, and what it claims.
// The functions take a batch of samples, so that the indirection costs nothing beside the sampling.
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
#include "vndf/on_surface.h"
#include "vndf/slope_tables.h"
#include "vndf/surface_slopes.h"
#include "vndf/validate/exact/exact_distribution.h"
#include "vndf/validate/statistics/uniformity.h"

namespace vndf::validate {

/// The errors that a sampler may have and still pass.
struct Bounds {
  /// |CDF(x(u)) - u|. A sampler without tables must be right to 1e-5: ten times the rounding of a
  /// single-precision normal, and less than 1e10 samples of it could show in an image.
  double u_error = 1e-5;
  /// |sampled / exact mass - 1| of a tail of 2^-20 (1e-6). At the end u = 1 random numbers of
  /// single precision are 2^-24 apart, so that their rounding alone moves this mass by up to 1/32.
  double tail_error = 0.05;
  /// The density of the map against pdf, relative, by finite differences in double precision.
  double density_error = 1e-3;
  /// pdf, D (relative), Lambda (of 1 + Lambda) and G1 (relative), and all integrals of them. The
  /// largest rounding is that of D of Beckmann at its rim, 4.1e-5.
  double function_error = 1e-4;
  /// By how much the distribution of the normals may differ from the exact one: not at all for a
  /// sampler without tables.
  DeclaredErrors declared = {};
};

/// What a sampler claims, which decides what is checked and against what.
struct Claims {
  /// Which normals it draws.
  SampledNormals normals = SampledNormals::visible_smith;
  /// Whether sample() is the monotone inverse of the CDFs in (u1, u2): slope x at u1, then slope y
  /// given x at u2, both increasing in the frame of the stretched incident direction.
  bool monotone_inverse = false;
  /// Whether its map is of a few smooth pieces, so that quasi-random numbers give quasi-random
  /// normals. False for one that takes the last digits of a random number for another.
  bool smooth = true;
  /// Angle of the stretched incident direction, in degrees, from which on it is the monotone
  /// inverse. Published samplers take polar coordinates instead near normal incidence.
  double inverse_from = 0;
  /// Whether it draws visible normals from below the surface too, wherever kLeastArea of it is
  /// visible.
  bool from_below = false;

  /// Whether it claims to be the monotone inverse at configuration `c`.
  bool inverse_at(const Configuration& c) const {
    return monotone_inverse && c.surface().stretched_angle(c.wi) / kDegree >= inverse_from;
  }
};

/// Refractive index of glass over that of air.
inline constexpr double kGlassIndex = 1.5;

/// A sampler under test. Directions and random numbers are passed in double precision but are
/// numbers of single precision, except to sample_double. The spans of one call are of equal size.
/// Functions are called by several threads at a time.
struct SamplerUnderTest {
  /// What reports call it.
  std::string name;
  /// The slopes that it claims to have.
  std::shared_ptr<const ExactSlopes> exact;
  Claims claims;
  Bounds bounds;
  /// The bounds from below the surface.
  Bounds bounds_below = {};
  /// The surface that it is checked on where a check asks for a roughness; a flat one if empty.
  std::function<SurfaceSlopes(const Alpha<double>&)> surface = {};

  /// The unit normals of a batch of random pairs.
  std::function<void(const Configuration&, std::span<const RandomPair> u,
                     std::span<Vec3<double>> wm)>
      sample;
  /// The same map in double precision; may be empty.
  std::function<void(const Configuration&, std::span<const RandomPair> u,
                     std::span<Vec3<double>> wm)>
      sample_double;
  /// The density of the map at the normal that is sampled at `u`, where the sampler gives it with
  /// the normal and there is no map in double precision to differentiate; may be empty.
  std::function<double(const Configuration&, const RandomPair& u)> sampled_density;
  /// The density per solid angle at each of `wm`, as a renderer would divide by it.
  std::function<void(const Configuration&, std::span<const Vec3<double>> wm, std::span<double> pdf)>
      pdf;
  /// D at each of `wm`.
  std::function<void(const ExactSurface&, std::span<const Vec3<double>> wm, std::span<double> d)> d;
  /// Lambda(wi) and G1(wi).
  std::function<double(const Configuration&)> lambda, g1;
  /// Masking and shadowing of the facet `wm` (bsdf/masking.h), with wi and wo on any side.
  std::function<double(const ExactSurface&, const Vec3<double>& wi, const Vec3<double>& wo,
                       const Vec3<double>& wm)>
      g2;
  /// f(wi, wo) |wo.z| of a rough surface of facets that reflect everything, and of one of facets of
  /// glass.
  std::function<void(const Configuration&, std::span<const Vec3<double>> wo, std::span<double> f)>
      mirror, glass;

  /// Draws one normal.
  Vec3<double> sample_one(const Configuration& c, double u1, double u2) const {
    const RandomPair u{u1, u2};
    Vec3<double> wm{};
    sample(c, {&u, 1}, {&wm, 1});
    return wm;
  }

  /// Whether it claims to draw what is seen at `c`. At the limit of visibility the area is that of
  /// bounded_cotangent(), so nothing is claimed of the last thousandth.
  bool claims_to_see(const Configuration& c) const {
    if (c.height() >= 0) return true;
    return claims.from_below && exact->unit_visible_area(c.wi, c.surface()) > 1.001 * kLeastArea;
  }
  /// The bounds at `c`.
  const Bounds& bounds_at(const Configuration& c) const {
    return c.height() >= 0 ? bounds : bounds_below;
  }
};

/// `v` in precision T.
template <class T, class U>
Vec3<T> vector_of(const Vec3<U>& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}
/// `a` in precision T.
template <class T>
Alpha<T> alpha_of(const Alpha<double>& a) {
  return {static_cast<T>(a.x), static_cast<T>(a.y)};
}

/// The surface in precision T, as a renderer makes it of the same numbers.
template <class T>
RoughSurface<T> rough_surface(const ExactSurface& s) {
  return SurfaceSlopes{s.alpha, s.correlation, s.mean}.surface<T>();
}

/// A function that calls `sampler`, of precision T, for a batch.
template <class T, NormalSampler<T> S>
auto batch_of(const S& sampler) {
  return
      [sampler](const Configuration& c, std::span<const RandomPair> u, std::span<Vec3<double>> wm) {
        const Vec3<T> wi = vector_of<T>(c.wi);
        const OnSurface on(sampler, rough_surface<T>(c.surface()));
        for (std::size_t k = 0; k < u.size(); ++k)
          wm[k] = vector_of<double>(on.sample(wi, static_cast<T>(u[k].x), static_cast<T>(u[k].y)));
      };
}

/// Evaluates `bsdf`, of precision T, for a batch: its first channel where it has several.
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
  s.g2 = [sampler](const ExactSurface& surface, const Vec3<double>& wi, const Vec3<double>& wo,
                   const Vec3<double>& wm) {
    const OnSurface on(sampler, rough_surface<T>(surface));
    return static_cast<double>(vndf::g2<M>(sampler, on.direction(vector_of<T>(wi)),
                                           on.direction(vector_of<T>(wo)),
                                           on.normal(vector_of<T>(wm)).unit, on.surface().alpha()));
  };
  s.mirror = [sampler](const Configuration& c, std::span<const Vec3<double>> wo,
                       std::span<double> f) {
    const ConductorBrdf brdf(sampler, rough_surface<T>(c.surface()), PerfectMirror<T>{}, M{});
    evaluate_batch<T>(brdf, c, wo, f);
  };
  s.glass = [sampler](const Configuration& c, std::span<const Vec3<double>> wo,
                      std::span<double> f) {
    const DielectricBsdf bsdf(sampler, rough_surface<T>(c.surface()), static_cast<T>(kGlassIndex),
                              M{});
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

/// Makes a sampler under test of `sampler`, of precision T: any class with the functions of
/// NormalSampler. `exact` are the slopes that it claims to have; the pointer must not be null.
/// Where it draws all normals, or has the G1 of another surface, `claims` must say so.
template <class T, NormalSampler<T> S>
SamplerUnderTest under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                            const S& sampler, const Claims& claims, const Bounds& bounds = {}) {
  SamplerUnderTest s;
  s.name = std::move(name);
  s.exact = std::move(exact);
  s.claims = claims;
  s.bounds = s.bounds_below = bounds;
  s.sample = batch_of<T>(sampler);
  s.pdf = [sampler](const Configuration& c, std::span<const Vec3<double>> wm,
                    std::span<double> pdf) {
    const OnSurface on(sampler, rough_surface<T>(c.surface()));
    for (std::size_t k = 0; k < wm.size(); ++k)
      pdf[k] = static_cast<double>(on.pdf(vector_of<T>(c.wi), vector_of<T>(wm[k])));
  };
  s.d = [sampler](const ExactSurface& surface, std::span<const Vec3<double>> wm,
                  std::span<double> d) {
    const OnSurface on(sampler, rough_surface<T>(surface));
    for (std::size_t k = 0; k < wm.size(); ++k)
      d[k] = static_cast<double>(on.d(vector_of<T>(wm[k])));
  };
  s.lambda = [sampler](const Configuration& c) {
    const OnSurface on(sampler, rough_surface<T>(c.surface()));
    return static_cast<double>(on.lambda(vector_of<T>(c.wi)));
  };
  s.g1 = [sampler](const Configuration& c) {
    const OnSurface on(sampler, rough_surface<T>(c.surface()));
    return static_cast<double>(on.g1(vector_of<T>(c.wi)));
  };
  set_bsdfs<T>(s, sampler);
  return s;
}

/// The same with the sampler in double precision too. Its map there has derivatives, which tell the
/// density of the map, and its BSDFs are taken, because the half vector of two opposite directions
/// is lost in the rounding of single precision.
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

/// The bounds of tables with `columns` in the larger one: the errors of their own certificate,
/// taken 1.25 times because it was measured at other places, and the rounding of a single-precision
/// normal.
Bounds bounds_of(const Certificate& certificate, std::size_t columns);
/// The same from below the surface, where the marginal has other rows.
Bounds bounds_below_of(const Certificate& certificate, std::size_t columns);

/// Tables as a renderer runs them, in single precision, with the bounds of `certificate`. `exact`
/// are the slopes that they were made from, as
/// std::make_shared<ExactSlopes>(parse_distribution("ggx")), and may be shared. The pointers must
/// not be null.
SamplerUnderTest tables_under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                                   std::shared_ptr<const SlopeTables> tables,
                                   const Certificate& certificate);

/// Baked tables with the bounds of their own certificate, like tables_under_test(). The data of
/// `tables` are shared, so it need not outlive the sampler.
SamplerUnderTest baked_tables_under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                                         const KernelTables& tables);

}  // namespace vndf::validate
