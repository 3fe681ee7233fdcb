// Builds the pair of tables and the two curves of a slope distribution, and measures them. This is
// where the steps of the builder meet: unit_slopes, marginal_map, rows, fill_table and
// measure_certificate.
#pragma once

#include <functional>
#include <memory>

#include "vndf/certificate.h"
#include "vndf/distributions/slope_distribution.h"
#include "vndf/precompute/fill_table.h"
#include "vndf/slope_tables.h"

namespace vndf::precompute {

struct BuildOptions {
  /// Rows (incidence, slope x) and columns (u1, u2) of both tables, from 2 x 5 to 8192 x 8192. The
  /// marginal has as many rows again for incidence below the horizon.
  TableLayout layout = {};
  /// Threads to run; 0 means one for each processor. The tables do not depend on it.
  unsigned threads = 0;
  /// Called with the finished fraction now and then, from one thread at a time; may be empty.
  std::function<void(double fraction)> progress = {};
};

struct BuiltTables {
  std::shared_ptr<const SlopeTables> tables;
  Certificate certificate;
  /// Integral of p22 over the slope plane as given, by which p22 was divided.
  double mass;
  /// Largest relative error that the quadratures estimate for any integral behind the tables.
  double quadrature_error;
};

/// Builds the tables of `distribution`, with their certificate. Throws std::invalid_argument for
/// sizes outside their range, and std::domain_error, which names the distribution and the reason,
/// where p22 is negative or not a number, cannot be normalised or has an infinite mean slope.
BuiltTables build_tables(const distributions::SlopeDistribution& distribution,
                         const BuildOptions& options = {});

}  // namespace vndf::precompute
