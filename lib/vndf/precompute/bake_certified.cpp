// Bakes a pair of tables and certifies the baked tables.
#include "vndf/precompute/bake_certified.h"

#include <limits>

#include "vndf/precompute/measure_kernel_certificate.h"
#include "vndf/precompute/row_errors.h"

namespace vndf::precompute {
namespace {

/// Bounds the errors of a table that differs by `difference` in u from one with `errors`. Of its
/// density and its tails nothing is known.
TableErrors joined(TableErrors errors, double difference) {
  errors.max_u_error += difference;
  errors.mean_u_error += difference;
  errors.max_density_error = std::numeric_limits<double>::infinity();
  errors.lower = errors.upper = {kFarthestRatio, kFarthestRatio, kFarthestRatio};
  return errors;
}

/// The curves of baked tables follow those of the pair to the tolerance, so it is added to the
/// errors of functions.
Certificate joined(Certificate c, const KernelHeader& header) {
  c.marginal = joined(c.marginal, header.difference_x);
  c.below = header.below_bytes != 0 ? joined(c.below, header.difference_x) : TableErrors{};
  c.conditional = joined(c.conditional, header.difference_y);
  c.max_d_error += header.tolerance;
  c.max_lambda_error += header.tolerance;
  c.max_pdf_error += 2 * header.tolerance;  // D and Lambda
  return c;
}

}  // namespace

KernelTables bake_certified(const UnitSlopes& slopes, const SlopeTables& pair,
                            const BakeOptions& options, const KernelText& text,
                            const support::Workers& workers) {
  const KernelTables baked = bake(pair, options);
  return baked.with_certificate(measure_certificate(slopes, baked.kernel(), workers), true)
      .with_text(text);
}

KernelTables bake_certified(const distributions::SlopeDistribution& distribution,
                            const SlopeTables& pair, const BakeOptions& options) {
  KernelText text;
  text.distribution = distribution.name();
  return bake_certified(UnitSlopes(distribution, {}), pair, options, text, {});
}

KernelTables bake_uncertified(const SlopeTables& pair, const Certificate& certificate,
                              const BakeOptions& options, const KernelText& text) {
  const KernelTables baked = bake(pair, options);
  return baked.with_certificate(joined(certificate, baked.header()), false).with_text(text);
}

}  // namespace vndf::precompute
