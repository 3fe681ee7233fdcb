// Tables as a subject.
#include "validate/subject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vndf/tabulated_sampler.h"

namespace vndf::validate {
namespace {

constexpr double kOtherPlaces = 1.25;
/// Rounding of a single-precision normal in u, and of the functions (Bounds::function_error).
constexpr double kRoundingUError = 1e-6;

/// Certificates give tail mass ratios up to this, either way: it stands for any larger one too.
constexpr double kLargestRatio = 8;

/// Largest |sampled / exact mass - 1|, of the ratio either way; infinite where it is not known.
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

/// Root mean square of the density error that errors of `u_error` in u make: interpolation errors
/// swing once in a cell. Rows differ, by less than the factor 3.
double density_of(double u_error, std::size_t columns) {
  constexpr double kRows = 3;
  return kRows * 2 * std::numbers::pi * static_cast<double>(columns) * u_error;
}

}  // namespace

Bounds bounds_of(const Certificate& c, std::size_t columns) {
  const Bounds plain;
  const double u = kOtherPlaces * std::max(c.marginal.max_u_error, c.conditional.max_u_error);
  const double density =
      kOtherPlaces * (c.marginal.max_density_error + c.conditional.max_density_error);
  const double tail = kOtherPlaces * farthest_ratio(c);
  const double functions =
      kOtherPlaces * std::max({c.max_d_error, c.max_lambda_error, c.max_pdf_error});
  const double typical = density_of(c.marginal.mean_u_error + c.conditional.mean_u_error, columns);
  // The law of normals combines the errors of both tables.
  return {.u_error = u + kRoundingUError,
          .tail_error = tail + plain.tail_error,
          .density_error = density + plain.density_error,
          .function_error = std::max(functions, plain.function_error),
          .declared = {2 * u, std::min(density, typical), 2 * tail}};
}

Subject tabulated_subject(std::string name, std::shared_ptr<const SlopeLaw> law,
                          std::shared_ptr<const SlopeTables> tables,
                          const Certificate& certificate) {
  const std::size_t columns = std::max(tables->marginal.columns(), tables->conditional.columns());
  return make_subject(std::move(name), std::move(law), TabulatedSampler<float>(tables),
                      TabulatedSampler<double>(tables),
                      {.law = NormalLaw::visible_smith, .inverse_map = true},
                      bounds_of(certificate, columns));
}

}  // namespace vndf::validate
