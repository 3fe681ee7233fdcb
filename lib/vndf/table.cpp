// The nodes of a table, made from its values.
#include "vndf/table.h"

#include <algorithm>
#include <stdexcept>

#include "vndf/differences.h"

namespace vndf {
namespace {

/// Derivative at value `i` < count - 2 of a row that goes on evenly before its first value.
template <class T>
double even_derivative(const T* values, std::size_t i) {
  const auto difference = [&](std::size_t k) {
    return static_cast<double>(values[i + k]) - static_cast<double>(values[i < k ? k - i : i - k]);
  };
  return (8 * difference(1) - difference(2)) / 12;
}

}  // namespace

template <class T>
std::vector<CubicNode<T>> nodes_of_row(const T* values, std::size_t count, Tangents rule) {
  const bool three = rule == Tangents::three_points || count < 5;
  // Values like t^2 begin with differences of 1 to 3. A larger first one is a jump, as of a ring,
  // whose slopes y begin beyond its hole.
  const bool even =
      rule == Tangents::five_points_even && values[1] - values[0] <= values[2] - values[1];
  const auto at = [values](std::size_t k) { return values[k]; };
  const auto tangent = [&](std::size_t i) {
    const double most = steepest_tangent(at, count, i);
    const auto allowed = [most](double t) { return t >= 0 && t <= most; };
    if (!three) {
      const double t =
          even && i < 2 ? even_derivative(values, i) : derivative(kFivePoints, at, count, i);
      if (allowed(t)) return t;  // a quartic across a jump turns back; the parabola does not
    }
    return std::max(0.0, std::min(derivative(kThreePoints, at, count, i), most));
  };
  std::vector<CubicNode<T>> nodes;
  nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) nodes.push_back({values[i], static_cast<T>(tangent(i))});
  return nodes;
}

template std::vector<CubicNode<float>> nodes_of_row(const float*, std::size_t, Tangents);
template std::vector<CubicNode<double>> nodes_of_row(const double*, std::size_t, Tangents);

QuantileTable::QuantileTable(std::size_t rows, std::size_t columns,
                             const std::vector<float>& values, RowBlend blend, Tangents tangents)
    : rows_(rows),
      columns_(columns),
      blend_(blend),
      tangents_(tangents),
      single_(nodes_of(values)) {}

QuantileTable QuantileTable::with_double_values(std::size_t rows, std::size_t columns,
                                                const std::vector<double>& values, RowBlend blend,
                                                Tangents tangents) {
  QuantileTable table(rows, columns, std::vector<float>(values.begin(), values.end()), blend,
                      tangents);
  table.double_ = table.nodes_of(values);
  return table;
}

template <class V>
std::vector<CubicNode<V>> QuantileTable::nodes_of(const std::vector<V>& values) const {
  const bool too_few = rows_ == 0 || (blend_ == RowBlend::cubic && rows_ > 1 && rows_ < 4);
  if (too_few || columns_ < 3 || values.size() / columns_ != rows_ || values.size() % columns_ != 0)
    throw std::invalid_argument(
        "a quantile table needs 1 row, or 2 and 4 for a cubic blend, or more, of 3 values or more");
  std::vector<CubicNode<V>> result;
  result.reserve(values.size());
  for (std::size_t i = 0; i < rows_; ++i) {
    const auto row = nodes_of_row(values.data() + i * columns_, columns_, tangents_);
    result.insert(result.end(), row.begin(), row.end());
  }
  return result;
}

}  // namespace vndf
