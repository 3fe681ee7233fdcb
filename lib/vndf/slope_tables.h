// Everything that sampling and evaluating one slope distribution needs, in units of its mean slope
// mu = E|X|: the tables T_x[theta, u1] and T_y[x, u2] of Heitz and d'Eon 2014 (sections 5.3, 5.4)
// and two functions of one variable. Immutable once made, so threads share it freely.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vndf/log_curve.h"
#include "vndf/monotone_map.h"
#include "vndf/row_axis.h"
#include "vndf/table.h"

namespace vndf {

struct SlopeTables {
  /// Name of the distribution, for people.
  std::string distribution;
  /// mu = E|X| at unit roughness; alpha times mu is the mean slope of the surface. Finite, > 0.
  double mean_slope = 0;
  /// Largest slope of the distribution in units of mu, infinite where there is none. > 0.
  double support = std::numeric_limits<double>::infinity();
  /// A and B of the scale of the conditional. Finite, A > 0.
  double conditional_constant = 1, conditional_quadratic = 1;
  /// s with map(s) = sigma(x) over (theta, u1) and 2 sigma(y / scale) - 1 over (|x|, u2); the
  /// coordinates are in table_coordinates.h.
  QuantileTable marginal = {}, conditional = {};
  /// Knots of the row axes, from row 0 to row 1; none where rows are equidistant from base
  /// coordinate 0 to 1. Those of the marginal go on below the horizon, beyond 1.
  std::vector<RowKnot> marginal_rows = {}, conditional_rows = {};
  /// Nodes of the map from the values of the marginal table to sigma(x).
  std::vector<CubicNode<double>> marginal_map = {};
  /// Distribution of normals at alpha = 1 / mu, D = p22 (1 + r^2)^2, over asinh(r).
  LogCurve<double> log_ndf;
  /// E[(X - c)+] = c Lambda(c): area of back-facing facets seen per unit of sin(theta), over
  /// asinh(c).
  LogCurve<double> log_backfacing;
};

/// Whether the slopes y given x are one distribution times the scale, whatever x: all rows of the
/// conditional are equal.
bool conditional_factorises(const SlopeTables& tables);

/// Bytes of tables, knots and map that sampling reads.
std::size_t sampling_bytes(const SlopeTables& tables);

/// The first rule that `tables` breaks, with the place, or nothing: sizes, finite values, rows that
/// increase within [0, 1] from 0, knots and maps that increase, curves whose segments do.
std::optional<std::string> check(const SlopeTables& tables);

/// Tables ready to share. Throws std::invalid_argument with the message of check().
std::shared_ptr<const SlopeTables> share(SlopeTables tables);

}  // namespace vndf
