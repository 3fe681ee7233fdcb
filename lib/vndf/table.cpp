// The nodes of a table, made from its values.
#include "vndf/table.h"

#include <algorithm>
#include <stdexcept>

#include "vndf/differences.h"

namespace vndf {

template <class T>
std::vector<CubicNode<T>> nodes_of_row(const T* values, std::size_t count) {
  const auto at = [values](std::size_t k) { return values[k]; };
  const auto tangent = [&](std::size_t i) {
    const double most = steepest_tangent(at, count, i);
    const double quartic = derivative(kFivePoints, at, count, i);
    if (quartic >= 0 && quartic <= most) return quartic;
    // A quartic across a jump turns back; the parabola does not.
    return std::max(0.0, std::min(derivative(kThreePoints, at, count, i), most));
  };
  std::vector<CubicNode<T>> nodes;
  nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) nodes.push_back({values[i], static_cast<T>(tangent(i))});
  return nodes;
}

template std::vector<CubicNode<float>> nodes_of_row(const float*, std::size_t);
template std::vector<CubicNode<double>> nodes_of_row(const double*, std::size_t);

QuantileTable::QuantileTable(std::size_t rows, std::size_t columns,
                             const std::vector<float>& values)
    : rows_(rows), columns_(columns), single_(nodes_of(values)) {}

QuantileTable QuantileTable::with_double_values(std::size_t rows, std::size_t columns,
                                                const std::vector<double>& values) {
  QuantileTable table(rows, columns, std::vector<float>(values.begin(), values.end()));
  table.double_ = table.nodes_of(values);
  return table;
}

template <class V>
std::vector<CubicNode<V>> QuantileTable::nodes_of(const std::vector<V>& values) const {
  if (rows_ < 2 || columns_ < kFewestColumns || values.size() / columns_ != rows_ ||
      values.size() % columns_ != 0)
    throw std::invalid_argument("a quantile table needs 2 rows or more of 5 values or more");
  std::vector<CubicNode<V>> result;
  result.reserve(values.size());
  for (std::size_t i = 0; i < rows_; ++i) {
    const auto row = nodes_of_row(values.data() + i * columns_, columns_);
    result.insert(result.end(), row.begin(), row.end());
  }
  return result;
}

}  // namespace vndf
