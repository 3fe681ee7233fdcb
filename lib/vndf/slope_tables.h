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
  /// Order n of the values of the marginal table: 1, or 2, 4, 8, 16 for very heavy tails.
  int tail_order = 1;
  /// Constant and quadratic part of the scale of the conditional; without meaning where `support`
  /// is finite.
  double conditional_constant = 1, conditional_quadratic = 1;
  /// Unit L of the base coordinate of the conditional. Finite, > 0.
  double conditional_unit = 1;
  /// sigma_n(x) / sigma(c) over (theta, u1) and 2 sigma(y / scale) - 1 over (|x|, u2); the
  /// coordinates are in table_coordinates.h.
  QuantileTable marginal = {}, conditional = {};
  /// Knots of the row axes, from row 0 to row 1; none where rows are equidistant.
  std::vector<RowKnot> marginal_rows = {}, conditional_rows = {};
  /// Nodes of the map from the values of the marginal table to sigma_n(x); none where they are
  /// sigma_n(x) / sigma(c) themselves.
  std::vector<CubicNode<double>> marginal_map = {};
  /// Distribution of normals at alpha = 1 / mu, D = p22 (1 + r^2)^2, over asinh(r).
  LogCurve<double> log_ndf;
  /// E[(X - c)+] = c Lambda(c): area of back-facing facets seen per unit of sin(theta), over
  /// asinh(c).
  LogCurve<double> log_backfacing;
};

/// How the conditional takes its tangents where the marginal takes them by `marginal`: its values
/// are even in the column coordinate, for |y| grows with p ~ t^2.
constexpr Tangents conditional_tangents(Tangents marginal) {
  return marginal == Tangents::three_points ? marginal : Tangents::five_points_even;
}

/// Bytes of tables, knots and map that sampling in single precision reads.
std::size_t sampling_bytes(const SlopeTables& tables);

/// The first rule that `tables` breaks, with the place, or nothing: sizes, finite values, rows that
/// increase within [0, 1] from 0, knots and maps that increase, curves whose segments do.
std::optional<std::string> check(const SlopeTables& tables);

/// Tables ready to share. Throws std::invalid_argument with the message of check().
std::shared_ptr<const SlopeTables> share(SlopeTables tables);

}  // namespace vndf
