// Computes the rows of a table on several threads and joins them.
#include "vndf/precompute/fill_table.h"

#include <algorithm>
#include <numeric>
#include <utility>

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
  const std::size_t columns = layout.columns;
  if (layout.in_double)
    return QuantileTable::with_double_values(rows.size(), columns, joined<double>(rows, columns));
  return {rows.size(), columns, joined<float>(rows, columns)};
}

/// Rows of a source, as many as there are, and the knots of their axis.
struct PlacedRows {
  Rows rows;
  std::vector<RowKnot> knots;
};

PlacedRows placed_rows(const RowSource& source, std::size_t count, std::size_t columns,
                       const support::Workers& workers) {
  PlacedRows placed{Rows(count), place_rows(source, count, {workers.threads})};
  const RowAxis axis(placed.knots);
  const auto u = columns_of(source, columns);
  support::parallel_for(count, workers, [&](std::size_t i) {
    placed.rows[i] = source.row(axis.base(coordinate(i, count)), u);
  });
  return placed;
}

/// The knots of an axis of which the first half of the rows has the knots `first`, and the other
/// half `second`, at base coordinates 1 larger.
std::vector<RowKnot> joined_knots(std::vector<RowKnot> first, std::vector<RowKnot> second) {
  for (auto* knots : {&first, &second})
    if (knots->empty()) *knots = {{0, 0}, {1, 1}};
  std::vector<RowKnot> joined;
  for (const RowKnot& k : first) joined.push_back({k.base, k.row / 2});
  for (std::size_t i = 1; i < second.size(); ++i)
    joined.push_back({1 + second[i].base, (1 + second[i].row) / 2});
  return joined;
}

}  // namespace

PlacedTable fill_table(const RowSource& source, const TableLayout& layout,
                       const support::Workers& workers) {
  PlacedRows placed = placed_rows(source, layout.rows, layout.columns, workers);
  return {table_of(placed.rows, layout), std::move(placed.knots)};
}

PlacedTable fill_table(const RowSource& source, const RowSource& beyond, const TableLayout& layout,
                       const support::Workers& workers) {
  PlacedRows first = placed_rows(source, layout.rows, layout.columns, part_of(workers, 0, 2));
  PlacedRows second = placed_rows(beyond, layout.rows, layout.columns, part_of(workers, 1, 2));
  first.rows.insert(first.rows.end(), second.rows.begin() + 1, second.rows.end());
  return {table_of(first.rows, layout),
          joined_knots(std::move(first.knots), std::move(second.knots))};
}

QuantileTable fill_with_one_row(const RowSource& source, const TableLayout& layout) {
  return table_of(Rows(layout.rows, source.row(0, columns_of(source, layout.columns))), layout);
}

}  // namespace vndf::precompute
