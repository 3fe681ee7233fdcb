// Bakes the pair of tables and measures what came of it.
#include "precompute/bake_certified.h"

#include <cstring>
#include <limits>
#include <vector>

#include "precompute/measure_certificate.h"
#include "precompute/row_errors.h"

namespace vndf::precompute {
namespace {

/// Errors of the table of the pair and of `difference` from it, in u.
TableErrors joined(TableErrors errors, double difference) {
  errors.max_u_error += difference;
  errors.mean_u_error += difference;
  errors.max_density_error = std::numeric_limits<double>::infinity();
  errors.lower = errors.upper = {kFarthestRatio, kFarthestRatio, kFarthestRatio};
  return errors;
}

/// Of functions the curves of baked tables follow those of the pair to the tolerance.
Certificate joined(Certificate c, const KernelHeader& header) {
  c.marginal = joined(c.marginal, header.difference_x);
  c.conditional = joined(c.conditional, header.difference_y);
  c.max_d_error += header.tolerance;
  c.max_lambda_error += header.tolerance;
  c.max_pdf_error += 2 * header.tolerance;  // D and Lambda
  return c;
}

/// The same tables, of which the header says that nothing was measured.
KernelTables marked_as_not_measured(const KernelTables& tables) {
  std::vector<std::byte> bytes(tables.bytes().begin(), tables.bytes().end());
  KernelHeader header = tables.header();
  header.certified = 0;
  std::memcpy(bytes.data(), &header, sizeof header);
  header.checksum = kernel_checksum(bytes);
  std::memcpy(bytes.data(), &header, sizeof header);
  return KernelTables::copy(bytes);
}

}  // namespace

KernelTables bake_certified(const UnitSlopes& slopes, const SlopeTables& pair,
                            const BakeOptions& options, const KernelText& text,
                            const Workers& workers) {
  const KernelTables baked = bake(pair, options);
  return baked.with(measure_certificate(slopes, baked.kernel(), workers), text);
}

KernelTables bake_uncertified(const SlopeTables& pair, const Certificate& certificate,
                              const BakeOptions& options, const KernelText& text) {
  const KernelTables baked = bake(pair, options);
  return marked_as_not_measured(baked.with(joined(certificate, baked.header()), text));
}

}  // namespace vndf::precompute
