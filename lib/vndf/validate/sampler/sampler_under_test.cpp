// Tables as a sampler under test.
#include "vndf/validate/sampler/sampler_under_test.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

#include "vndf/pair_coordinates.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::validate {
namespace {

/// Certificates are measured at other places than those that are checked here.
constexpr double kOtherPlaces = 1.25;
/// Rounding of a single-precision normal in u, and of the functions (Bounds::function_error).
constexpr double kRoundingUError = 1e-6;

/// The largest tail mass ratio of a certificate, either way. It stands for any larger one too.
constexpr double kLargestRatio = 8;

/// The largest |sampled / exact mass - 1|, of the ratio either way; infinite where it is not known.
double farthest_ratio(const Certificate& c) {
  double farthest = 1;
  for (const TableErrors* table : {&c.marginal, &c.conditional})
    for (const TailRatios* r : {&table->lower, &table->upper})
      for (const double ratio : {r->e4, r->e5, r->e6})
        farthest = std::max({farthest, ratio, 1 / ratio});
  constexpr double kAtTheEnd = 0.999;
  return farthest < kAtTheEnd * kLargestRatio ? farthest - 1
                                              : std::numeric_limits<double>::infinity();
}

/// The root mean square of the density error that errors of `u_error` in u make. Errors of
/// interpolation swing once in a cell, which gives the factor 2 pi times the number of cells. Rows
/// differ from the mean by less than the factor 3.
double density_of(double u_error, std::size_t columns) {
  constexpr double kRows = 3;
  return kRows * 2 * std::numbers::pi * static_cast<double>(columns) * u_error;
}

/// Columns as wide as those of baked tables where u1 and u2 are from 1/4 to 3/4, in which half of
/// the samples are: the keys of one octave of q divide 1/4 of u.
std::size_t columns_of(const KernelHeader& header) {
  return std::size_t{4} << (23 - header.marginal.shift);
}

/// Baked tables in the shape of a sampler of either precision, with a share of their data. All is
/// computed in single precision; only what a BSDF makes of it is in double.
template <class T>
class SharedKernel {
 public:
  using Scalar = T;
  static constexpr bool kVisible = true;

  explicit SharedKernel(const KernelTables& tables) : tables_(tables), kernel_(tables.kernel()) {}

  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    return vector_of<T>(kernel_.sample(vector_of<float>(wi), narrow(alpha), static_cast<float>(u1),
                                       static_cast<float>(u2)));
  }
  T d(const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return T{kernel_.d(vector_of<float>(wm), narrow(alpha))};
  }
  T lambda(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return T{kernel_.lambda(vector_of<float>(w), narrow(alpha))};
  }
  T g1(const Vec3<T>& w, const Alpha<T>& alpha) const noexcept {
    return T{kernel_.g1(vector_of<float>(w), narrow(alpha))};
  }
  T pdf(const Vec3<T>& wi, const Vec3<T>& wm, const Alpha<T>& alpha) const noexcept {
    return T{kernel_.pdf(vector_of<float>(wi), vector_of<float>(wm), narrow(alpha))};
  }
  /// On a surface renderers call the kernel's own function, so that is what is judged.
  Vec3<T> sample(const Vec3<T>& wi, const RoughSurface<T>& surface, T u1,
                 T u2) const noexcept requires std::same_as<T, float> {
    return kernel_.sample(wi, surface, u1, u2);
  }

  const Kernel& kernel() const { return kernel_; }

 private:
  static Alpha<float> narrow(const Alpha<T>& alpha) {
    return {static_cast<float>(alpha.x), static_cast<float>(alpha.y)};
  }

  KernelTables tables_;
  Kernel kernel_;
};

}  // namespace

Bounds bounds_below_of(const Certificate& c, std::size_t columns) {
  Certificate below = c;
  below.marginal = c.below;
  return bounds_of(below, columns);
}

Bounds bounds_of(const Certificate& c, std::size_t columns) {
  const Bounds plain;
  const double u = kOtherPlaces * std::max(c.marginal.max_u_error, c.conditional.max_u_error);
  const double density =
      kOtherPlaces * (c.marginal.max_density_error + c.conditional.max_density_error);
  const double tail = kOtherPlaces * farthest_ratio(c);
  const double functions =
      kOtherPlaces * std::max({c.max_d_error, c.max_lambda_error, c.max_pdf_error});
  const double typical = density_of(c.marginal.mean_u_error + c.conditional.mean_u_error, columns);
  // The distribution of normals combines the errors of both tables.
  return {.u_error = u + kRoundingUError,
          .tail_error = tail + plain.tail_error,
          .density_error = density + plain.density_error,
          .function_error = std::max(functions, plain.function_error),
          .declared = {2 * u, std::min(density, typical), 2 * tail}};
}

SamplerUnderTest tables_under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                                   std::shared_ptr<const SlopeTables> tables,
                                   const Certificate& certificate) {
  const std::size_t columns = std::max(tables->marginal.columns(), tables->conditional.columns());
  SamplerUnderTest s = under_test(std::move(name), std::move(exact),
                                  TabulatedSampler<float>(tables), TabulatedSampler<double>(tables),
                                  {.normals = SampledNormals::visible_smith,
                                   .monotone_inverse = true,
                                   .from_below = PairCoordinates(*tables).reaches_below()},
                                  bounds_of(certificate, columns));
  s.bounds_below = bounds_below_of(certificate, columns);
  return s;
}

SamplerUnderTest baked_tables_under_test(std::string name, std::shared_ptr<const ExactSlopes> exact,
                                         const KernelTables& tables) {
  const SharedKernel<float> kernel(tables);
  const std::size_t columns = columns_of(tables.header());
  SamplerUnderTest s =
      under_test(std::move(name), std::move(exact), kernel, SharedKernel<double>(tables),
                 {.normals = SampledNormals::visible_smith,
                  .monotone_inverse = true,
                  .from_below = tables.header().below_bytes != 0},
                 bounds_of(tables.certificate(), columns));
  s.bounds_below = bounds_below_of(tables.certificate(), columns);
  s.sample_double = {};  // no more exact than the other
  s.sampled_density = [kernel](const Configuration& c, const RandomPair& u) {
    const OnSurface on(kernel.kernel(), rough_surface<float>(c.surface()));
    const auto drawn = on.sample_with_density(vector_of<float>(c.wi), static_cast<float>(u.x),
                                              static_cast<float>(u.y));
    return double{drawn.pdf};
  };
  return s;
}

}  // namespace vndf::validate
