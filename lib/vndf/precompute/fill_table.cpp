// Computes the rows of a table on several threads and joins them.
#include "vndf/precompute/fill_table.h"

#include <algorithm>
#include <numeric>

#include "vndf/precompute/place_rows.h"

namespace vndf::precompute {
namespace {

using Rows = std::vector<std::vector<double>>;

double coordinate(std::size_t i, std::size_t n) {
  return static_cast<double>(i) / static_cast<double>(n - 1);
}

/// Returns the probabilities of the columns of a table.
std::vector<Probability<double>> columns_of(const RowSource& source, std::size_t columns) {
  std::vector<Probability<double>> u;
  for (std::size_t j = 0; j < columns; ++j)
    u.push_back(source.column_inverse(coordinate(j, columns)));
  return u;
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
    // Root finding may swap two values that lie within its error, but a table must not decrease.
    std::partial_sum(values.begin() + begin, values.end(), values.begin() + begin,
                     [](V below, V v) { return std::max(below, v); });
  }
  return values;
}

QuantileTable table_of(const Rows& rows, const TableLayout& layout) {
  const auto& [count, columns, in_double] = layout;
  if (in_double)
    return QuantileTable::with_double_values(count, columns, joined<double>(rows, columns));
  return {count, columns, joined<float>(rows, columns)};
}

}  // namespace

PlacedTable fill_table(const RowSource& source, const TableLayout& layout,
                       const support::Workers& workers) {
  const auto knots = place_rows(source, layout.rows, {workers.threads});
  const RowAxis axis(knots);
  const auto u = columns_of(source, layout.columns);
  Rows rows(layout.rows);
  support::parallel_for(rows.size(), workers, [&](std::size_t i) {
    rows[i] = source.row(axis.base(coordinate(i, layout.rows)), u);
  });
  return {table_of(rows, layout), knots};
}

QuantileTable fill_with_one_row(const RowSource& source, const TableLayout& layout) {
  return table_of(Rows(layout.rows, source.row(0, columns_of(source, layout.columns))), layout);
}

}  // namespace vndf::precompute
