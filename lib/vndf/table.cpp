// A table, made from its values, and its lookup.
#include "vndf/table.h"

#include <algorithm>
#include <stdexcept>

#include "vndf/differences.h"

namespace vndf {

std::vector<CubicNode<double>> nodes_of_row(const double* values, std::size_t count) {
  const auto at = [values](std::size_t k) { return values[k]; };
  // A row that begins like t^2, as |y| does, has first differences of 1 to 3 and no slope at its
  // first value. The quartic gives 0 there only to rounding, and the density would be made of that
  // rounding.
  const bool begins_flat = at(1) - at(0) <= (at(2) - at(1)) / 2;
  const auto tangent = [&](std::size_t i) {
    if (i == 0 && begins_flat) return 0.0;
    const double most = steepest_tangent(at, count, i);
    const double quartic = derivative(kFivePoints, at, count, i);
    if (quartic >= 0 && quartic <= most) return quartic;
    // A quartic across a jump turns back; the parabola does not.
    return std::max(0.0, std::min(derivative(kThreePoints, at, count, i), most));
  };
  std::vector<CubicNode<double>> nodes;
  nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) nodes.push_back({values[i], tangent(i)});
  return nodes;
}

QuantileTable::QuantileTable(std::size_t rows, std::size_t columns,
                             const std::vector<float>& values)
    : QuantileTable(rows, columns, std::vector<double>(values.begin(), values.end()), false) {}

QuantileTable QuantileTable::with_double_values(std::size_t rows, std::size_t columns,
                                                const std::vector<double>& values) {
  return {rows, columns, values, true};
}

QuantileTable::QuantileTable(std::size_t rows, std::size_t columns,
                             const std::vector<double>& values, bool in_double)
    : rows_(rows), columns_(columns), in_double_(in_double) {
  if (rows < 2 || columns < kFewestColumns || values.size() / columns != rows ||
      values.size() % columns != 0)
    throw std::invalid_argument("a quantile table needs 2 rows or more of 5 values or more");
  nodes_.reserve(values.size());
  for (std::size_t i = 0; i < rows; ++i) {
    const auto nodes = nodes_of_row(values.data() + i * columns, columns);
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
  }
}

std::vector<double> QuantileTable::row_values(std::size_t i) const {
  std::vector<double> values;
  values.reserve(columns_);
  for (std::size_t j = 0; j < columns_; ++j) values.push_back(row(i)[j].value);
  return values;
}

WithDerivative<double> QuantileTable::lookup_with_derivative(double row, double column) const {
  const Cell<double> c = cell_of(column, columns_);
  const CubicPiece<double> cubic = piece(cell_of(row, rows_), c.index);
  const double w = cubic.at(c.fraction), clamped = std::clamp(w, 0.0, 1.0);
  const double slope = static_cast<double>(columns_ - 1) * cubic.derivative(c.fraction);
  return {clamped, w == clamped ? slope : 0.0};
}

double QuantileTable::inverse(double row, double value) const {
  const Cell<double> r = cell_of(row, rows_);
  std::size_t low = 0, high = columns_ - 1;  // `value` lies between these two nodes
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (piece(r, middle).c0 > value ? high : low) = middle;
  }
  return (static_cast<double>(low) + piece(r, low).inverse(value)) /
         static_cast<double>(columns_ - 1);
}

/// Nodes are blended between two rows, and not the cubics through them, which takes one cubic
/// instead of two and gives the same.
CubicPiece<double> QuantileTable::piece(const Cell<double>& r, std::size_t index) const {
  const CubicNode<double>*low = row(r.index) + index, *high = row(r.index + 1) + index;
  const auto blended = [&](std::size_t k) {
    return CubicNode<double>{low[k].value + r.fraction * (high[k].value - low[k].value),
                             low[k].tangent + r.fraction * (high[k].tangent - low[k].tangent)};
  };
  return hermite_piece(blended(0), blended(1));
}

}  // namespace vndf
