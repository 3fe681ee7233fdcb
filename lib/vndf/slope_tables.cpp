// The rules that tables must keep before anything samples from them.
#include "vndf/slope_tables.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace vndf {
namespace {

using Broken = std::optional<std::string>;

/// The rule that value j of a row breaks, or nothing.
const char* broken_rule(const CubicNode<double>* row, std::size_t j) {
  const double w = row[j].value;
  if (!std::isfinite(w)) return " is not a finite number";
  if (w < 0 || w > 1) return " is outside [0, 1]";
  if (j == 0 && w != 0) return " is not 0, the value at the end of a row";
  if (j > 0 && w < row[j - 1].value) return " is below the column before it";
  return nullptr;
}

Broken check_row(const CubicNode<double>* row, std::size_t columns) {
  for (std::size_t j = 0; j < columns; ++j)
    if (const char* rule = broken_rule(row, j)) return "column " + std::to_string(j) + rule;
  return {};
}

Broken check_table(const QuantileTable& table, const std::string& name) {
  if (table.rows() == 0) return name + " table: empty";
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (const Broken b = check_row(table.row(i), table.columns()))
      return name + " table, row " + std::to_string(i) + ": " + *b;
  return {};
}

/// `last` is the largest base coordinate.
Broken check_axis(const std::vector<RowKnot>& knots, const std::string& name, int last) {
  if (knots.empty()) return {};
  if (knots.size() < 2 || knots.front().row != 0 || knots.back().row != 1)
    return name + " rows: the knots do not run from row 0 to row 1";
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const RowKnot& at = knots[k];
    const bool inside = at.base >= 0 && at.base <= last && at.row >= 0 && at.row <= 1;
    if (!inside || (k > 0 && !(at.base > knots[k - 1].base && at.row > knots[k - 1].row)))
      return name + " rows, knot " + std::to_string(k) + ": not above the knot before it in [0, " +
             std::to_string(last) + "]";
  }
  return {};
}

Broken check_map(const std::vector<CubicNode<double>>& nodes, const std::string& name) {
  if (nodes.size() < 2 || nodes.front().value != 0)
    return name + " map: fewer than two nodes, or the first value is not 0";
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const CubicNode<double>& n = nodes[k];
    const bool inside = n.value >= 0 && n.value <= 1 && n.tangent >= 0;
    if (!inside || (k > 0 && n.value < nodes[k - 1].value))
      return name + " map, node " + std::to_string(k) +
             ": not at or above the node before it in [0, 1], with a tangent >= 0";
    const bool gentle = k == 0 || std::max(nodes[k - 1].tangent, n.tangent) <=
                                      kSteepest * (n.value - nodes[k - 1].value);
    if (!gentle)
      return name + " map, node " + std::to_string(k) +
             ": a tangent is more than 3 times the rise from the node before it";
  }
  return {};
}

Broken check_segment(const LogCurveSegment<double>& segment, double least) {
  if (!(segment.begin >= least) || !(segment.end > segment.begin) || !std::isfinite(segment.end))
    return "ends are not increasing numbers";
  if (segment.grading < Grading::none || segment.grading > Grading::both) return "unknown grading";
  if (segment.nodes.size() < 2) return "fewer than two nodes";
  for (const auto& node : segment.nodes)
    if (!std::isfinite(node.value) || !std::isfinite(node.tangent))
      return "a node is not a finite number";
  return {};
}

Broken check_curve(const LogCurve<double>& curve, const std::string& name) {
  if (curve.segments().empty()) return name + " curve: no segments";
  double end = 0;
  for (std::size_t i = 0; i < curve.segments().size(); ++i) {
    if (const Broken b = check_segment(curve.segments()[i], end))
      return name + " curve, segment " + std::to_string(i) + ": " + *b;
    end = curve.segments()[i].end;
  }
  return {};
}

}  // namespace

bool conditional_factorises(const SlopeTables& tables) {
  const QuantileTable& table = tables.conditional;
  const std::vector<double> first = table.row_values(0);
  for (std::size_t i = 1; i < table.rows(); ++i)
    if (table.row_values(i) != first) return false;
  return true;
}

std::size_t sampling_bytes(const SlopeTables& tables) {
  const auto nodes = [](const QuantileTable& t) { return 2 * t.rows() * t.columns(); };
  const std::size_t knots = tables.marginal_rows.size() + tables.conditional_rows.size();
  const std::size_t pieces = tables.marginal_map.size() - 1;
  return sizeof(double) *
         (nodes(tables.marginal) + nodes(tables.conditional) + 2 * knots + 4 * pieces);
}

std::optional<std::string> check(const SlopeTables& tables) {
  if (!(tables.mean_slope > 0) || !std::isfinite(tables.mean_slope))
    return "mean slope is not a finite number > 0";
  if (!(tables.support > 0)) return "support is not a number > 0";
  if (!(tables.conditional_constant > 0) || !std::isfinite(tables.conditional_constant) ||
      !std::isfinite(tables.conditional_quadratic))
    return "scale of the conditional is not of a finite number > 0 and a finite one";
  if (const Broken b = check_table(tables.marginal, "marginal")) return b;
  if (const Broken b = check_table(tables.conditional, "conditional")) return b;
  if (const Broken b = check_axis(tables.marginal_rows, "marginal", 2)) return b;
  if (const Broken b = check_axis(tables.conditional_rows, "conditional", 1)) return b;
  if (const Broken b = check_map(tables.marginal_map, "marginal")) return b;
  if (const Broken b = check_curve(tables.log_ndf, "log_ndf")) return b;
  return check_curve(tables.log_backfacing, "log_backfacing");
}

std::shared_ptr<const SlopeTables> share(SlopeTables tables) {
  if (const Broken b = check(tables)) throw std::invalid_argument("slope tables: " + *b);
  return std::make_shared<const SlopeTables>(std::move(tables));
}

}  // namespace vndf
