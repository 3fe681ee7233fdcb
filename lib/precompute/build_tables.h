// Fills the two tables and the two curves for a slope distribution, and measures them.
#pragma once

#include <functional>
#include <memory>

#include "precompute/conditional_shape.h"
#include "precompute/fill_table.h"
#include "precompute/slope_distribution.h"
#include "vndf/certificate.h"
#include "vndf/slope_tables.h"

namespace vndf::precompute {

struct BuildOptions {
  /// Rows (incidence, slope x) and columns (u1, u2) of both tables; from 2 x 3, or 4 x 3 for a
  /// cubic blend, to 8192 x 8192. A conditional that factorises has one row.
  TableLayout layout = {};
  /// 0: one thread for each processor. The tables do not depend on it.
  unsigned threads = 0;
  /// Told the finished fraction now and then, from one thread at a time; may be empty.
  std::function<void(double fraction)> progress = {};
};

struct BuiltTables {
  std::shared_ptr<const SlopeTables> tables;
  Certificate certificate;
  /// Integral of p22 as given, by which it was divided.
  double mass;
  /// Largest relative error estimate of any integral behind the tables.
  double quadrature_error;
};

/// Tables of `distribution`, with their certificate. Throws std::invalid_argument for sizes outside
/// their range, std::domain_error (naming the distribution and the reason) where p22 is negative or
/// not a number, cannot be normalised or has an infinite mean slope.
BuiltTables build_tables(const SlopeDistribution& distribution, const BuildOptions& options = {});

// The parts of which tables are made.

/// One figure for how bad a table is: its largest error in u or, where it is worse, its tails.
double fault(const TableErrors& errors);

/// All but the tables themselves.
SlopeTables tables_without_rows(const UnitSlopes& slopes, const Workers& workers);

/// The marginal with values sigma_n(x) / sigma(c), or through a map of `nodes` nodes.
void set_plain_marginal(SlopeTables& tables, const UnitSlopes& slopes, const TableLayout& layout,
                        const Workers& workers);
void set_mapped_marginal(SlopeTables& tables, const UnitSlopes& slopes, const TableLayout& layout,
                         std::size_t nodes, const Workers& workers);

/// The conditional, with `unit` L of its base coordinate; of one row if it factorises.
void set_conditional(SlopeTables& tables, const UnitSlopes& slopes, const ConditionalShape& shape,
                     double unit, TableLayout layout, const Workers& workers);

}  // namespace vndf::precompute
