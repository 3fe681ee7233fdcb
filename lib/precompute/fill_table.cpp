// Fills one table.
#include "precompute/fill_table.h"

#include <algorithm>
#include <numeric>

#include "precompute/place_rows.h"

namespace vndf::precompute {
namespace {

using Rows = std::vector<std::vector<double>>;

double coordinate(std::size_t i, std::size_t n) {
  return n == 1 ? 0 : static_cast<double>(i) / static_cast<double>(n - 1);
}

template <class V>
std::vector<V> joined(const Rows& rows, std::size_t columns) {
  std::vector<V> values;
  values.reserve(rows.size() * columns);
  const std::vector<double>* last = &rows.front();
  for (const auto& row : rows) {
    if (!row.empty()) last = &row;
    const auto begin = static_cast<std::ptrdiff_t>(values.size());
    std::transform(last->begin(), last->end(), std::back_inserter(values),
                   [](double v) { return static_cast<V>(v); });
    // Neighbours may lie closer than root finding tells apart.
    std::partial_sum(values.begin() + begin, values.end(), values.begin() + begin,
                     [](V below, V v) { return std::max(below, v); });
  }
  return values;
}

}  // namespace

PlacedTable fill_table(const RowSource& source, const TableLayout& layout, const Workers& workers) {
  PlacedTable placed;
  if (layout.rows > 1 && layout.blend == RowBlend::linear)
    placed.knots = place_rows(source, layout.rows, {workers.threads});
  else if (layout.rows > 1 && source.end_of_even_rows < 1)
    placed.knots = {{0, 0}, {source.end_of_even_rows, 1}};
  const RowAxis<double> axis(placed.knots);
  std::vector<Probability<double>> u;
  for (std::size_t j = 0; j < layout.columns; ++j)
    u.push_back(source.column_inverse(coordinate(j, layout.columns)));
  Rows rows(layout.rows);
  parallel_for(rows.size(), workers, [&](std::size_t i) {
    rows[i] = source.row(axis.base(coordinate(i, layout.rows)), u);
  });
  const auto& [count, columns, blend, in_double] = layout;
  const Tangents tangents = source.even ? Tangents::five_points_even : Tangents::five_points;
  placed.table = in_double
                     ? QuantileTable::with_double_values(
                           count, columns, joined<double>(rows, columns), blend, tangents)
                     : QuantileTable(count, columns, joined<float>(rows, columns), blend, tangents);
  return placed;
}

}  // namespace vndf::precompute
