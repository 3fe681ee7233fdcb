// The rules that tables must keep before anything samples from them.
#include "vndf/slope_tables.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace vndf {
namespace {

using Broken = std::optional<std::string>;

/// The rule that value j of a row breaks, or nothing.
const char* broken_rule(const float* w, std::size_t j) {
  if (!std::isfinite(w[j])) return " is not a finite number";
  if (w[j] < 0 || w[j] > 1) return " is outside [0, 1]";
  if (j == 0 && w[j] != 0) return " is not 0, the value of u = 0";
  if (j > 0 && w[j] < w[j - 1]) return " is below the column before it";
  return nullptr;
}

Broken check_row(const float* w, std::size_t columns) {
  for (std::size_t j = 0; j < columns; ++j)
    if (const char* rule = broken_rule(w, j)) return "column " + std::to_string(j) + rule;
  return {};
}

Broken check_table(const QuantileTable& table, const std::string& name) {
  if (table.rows() < 2 || table.columns() < 3) return name + " table: empty";
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (const Broken b = check_row(table.row(i), table.columns()))
      return name + " table, row " + std::to_string(i) + ": " + *b;
  return {};
}

Broken check_curve(const LogCurve<double>& curve, const std::string& name) {
  if (!(curve.step() > 0) || !std::isfinite(curve.step())) return name + " curve: step is not > 0";
  if (curve.nodes().size() < 2) return name + " curve: fewer than two nodes";
  for (std::size_t i = 0; i < curve.nodes().size(); ++i)
    if (!std::isfinite(curve.nodes()[i].value) || !std::isfinite(curve.nodes()[i].tangent))
      return name + " curve, node " + std::to_string(i) + ": not a finite number";
  return {};
}

}  // namespace

std::optional<std::string> check(const SlopeTables& tables) {
  if (!(tables.mean_slope > 0) || !std::isfinite(tables.mean_slope))
    return "mean slope is not a finite number > 0";
  if (const Broken b = check_table(tables.marginal, "marginal")) return b;
  if (const Broken b = check_table(tables.conditional, "conditional")) return b;
  if (const Broken b = check_curve(tables.log_ndf, "log_ndf")) return b;
  return check_curve(tables.log_backfacing, "log_backfacing");
}

std::shared_ptr<const SlopeTables> share(SlopeTables tables) {
  if (const Broken b = check(tables)) throw std::invalid_argument("slope tables: " + *b);
  return std::make_shared<const SlopeTables>(std::move(tables));
}

}  // namespace vndf
