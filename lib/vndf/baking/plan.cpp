// Laying rows and columns.
#include "vndf/baking/plan.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>
#include <vector>

#include "vndf/table_coordinates.h"

namespace vndf::baking {
namespace {

// Where the errors of a cell are looked at, as parts of its width.
constexpr std::array<double, 5> kPlacesInColumn{0.12, 0.3, 0.5, 0.7, 0.88};
constexpr std::array<double, 3> kPlacesInRow{0.1, 0.45, 0.9};
/// Whether the cubic between two nodes turns back nowhere (Fritsch and Carlson 1980).
bool increases(const Node& low, const Node& high, double width) {
  const double rise = kSteepest * (high.value - low.value) / width;
  const auto along = [rise](const Node& node) {
    return std::abs(node.derivative) <= std::abs(rise) && node.derivative * rise >= 0;
  };
  return along(low) && along(high);
}

/// Whether one cubic follows a row of the surface from p = `begin` to `end`.
bool follows_column(const Surface& surface, const Columns& columns, const Criterion& criterion,
                    double row, double begin, double end) {
  const Node low = node_at(surface, columns, row, begin),
             high = node_at(surface, columns, row, end);
  // Next to the pointed middle of a law a derivative may be infinite; where too few samples land to
  // see it, it is limited.
  const double mass = std::abs(columns.probability(end) - columns.probability(begin));
  if (mass > criterion.tolerance / 4 && !increases(low, high, end - begin)) return false;
  const Cubic cubic = limited_hermite(low, high, end - begin);
  return std::ranges::all_of(kPlacesInColumn, [&](double f) {
    const double p = begin + f * (end - begin), q = columns.probability(p);
    return criterion.accepts(baking::at(cubic, p - begin), surface.at(row, q), q);
  });
}

/// The cells of columns in which one cubic follows each of `rows`.
Axis column_cells(const Surface& surface, const Columns& columns, const Criterion& criterion,
                  std::vector<double> rows, int bits) {
  return cells_between(columns.least(), columns.most(), bits, [&](double begin, double end) {
    for (auto row = rows.begin(); row != rows.end(); ++row)
      if (!follows_column(surface, columns, criterion, *row, begin, end)) {
        std::iter_swap(row, rows.begin());  // what failed is asked first the next time
        return false;
      }
    return true;
  });
}

/// Probabilities at which rows are looked at before there are columns, crowded at both ends.
std::vector<double> usual_probabilities() {
  constexpr double kRatio = 1.6, kNearHalf = 0x1p-9;
  std::vector<double> qs;
  for (double q = 0.25; q > 0x1p-24; q /= kRatio) qs.push_back(q);
  for (double p = 0.2; p > kNearHalf; p /= kRatio) qs.push_back(0.5 - p);
  return qs;
}

/// Those at the edges of columns and between them.
std::vector<double> probabilities_of(const Columns& columns, const Axis& axis) {
  std::vector<double> qs;
  for (const AxisCell& cell : axis.cells)
    for (const double f : {0.0, 0.25, 0.5, 0.75})
      qs.push_back(columns.probability(cell.begin + f * cell.width()));
  return qs;
}

/// Whether the cubic through four rows follows the surface between them.
bool follows_rows(const Surface& surface, const Criterion& criterion, std::vector<double>& qs,
                  double begin, double end) {
  std::array<double, 4> nodes;
  std::array<double, 3> between;
  const auto row = [&](double f) { return surface.row(begin + f * (end - begin)); };
  std::ranges::transform(kRowPlaces, nodes.begin(), row);
  std::ranges::transform(kPlacesInRow, between.begin(), row);
  for (auto q = qs.begin(); q != qs.end(); ++q) {
    std::array<double, 4> values;
    for (std::size_t i = 0; i < 4; ++i) values[i] = surface.at(nodes[i], *q).value;
    const Cubic cubic = through(values, 1);
    for (std::size_t i = 0; i < 3; ++i)
      if (!criterion.accepts(baking::at(cubic, kPlacesInRow[i]), surface.at(between[i], *q), *q)) {
        std::iter_swap(q, qs.begin());  // what failed is asked first the next time
        return false;
      }
  }
  return true;
}

/// The cells with the fewest bits of those with which none of one key is too coarse.
template <class Make>
Axis with_enough_bits(std::initializer_list<int> candidates, Make make) {
  Axis axis;
  for (const int bits : candidates) {
    axis = make(bits);
    if (!axis.too_coarse) break;
  }
  return axis;
}

// Rows at which columns are looked at, as parts of a cell of rows.
constexpr std::array<double, 6> kRowsInCell{0, 0.5, 0.15, 0.85, 0.35, 0.65};

/// Rows of a surface at places in the cells of an axis whose places are `offset` higher.
std::vector<double> rows_in(const Surface& surface, const Axis& axis, double offset,
                            std::size_t places) {
  std::vector<double> rows;
  for (const AxisCell& cell : axis.cells)
    for (const double f : std::span(kRowsInCell).first(places))
      rows.push_back(surface.row(cell.begin + f * cell.width() - offset));
  rows.push_back(surface.row(axis.cells.back().end - offset));
  return rows;
}

/// Whether the conditional is the same at two slopes x: rows of y are looked up by s, and x is what
/// the map makes of it.
bool same_conditional(const PairSlopes& slopes, const Criterion& criterion, double root,
                      double other) {
  const auto slope = [](double r) { return std::abs(r * r - 0.5) / (r * r * (1 - r * r)); };
  const auto near = [&](double q) {
    return criterion.accepts(slopes.conditional(slope(other), q).value,
                             slopes.conditional(slope(root), q), q);
  };
  return near(0.45) && near(0.25) && near(0.1) && near(0.02);
}

/// Whether one cubic follows the map between two places of a half. Errors are those of u of its
/// base distribution.
bool follows_map(const PairSlopes& slopes, const Criterion& criterion, bool upper, double begin,
                 double end) {
  const Cubic cubic =
      hermite(map_node(slopes, begin, upper), map_node(slopes, end, upper), end - begin);
  return std::ranges::all_of(kPlacesInColumn, [&](double f) {
    const double place = begin + f * (end - begin), s = s_at(slopes, place, upper);
    const auto u = marginal_column_inverse(s);
    const Node root = slopes.map(s);
    const double value = baking::at(cubic, place - begin);
    return criterion.accepts(value, {root.value, root.derivative / marginal_column_rate(s)},
                             std::min(u.u, u.complement)) &&
           same_conditional(slopes, criterion, root.value, value);
  });
}

/// The cells over s, which share a guide and so have keys of as many bits.
void lay_slopes(Plan& plan, const PairSlopes& slopes, const Criterion& criterion) {
  const double offset = plan.slope_offset;
  auto qs = usual_probabilities();
  if (!plan.conditional.cells.empty()) {
    qs = probabilities_of(plan.columns.halved(false), plan.conditional);
    const auto more = probabilities_of(plan.columns.halved(true), plan.mirrored);
    qs.insert(qs.end(), more.begin(), more.end());
  }
  for (const int bits : {5, 6, 7}) {
    bool too_coarse = false;
    for (const bool upper : {false, true}) {
      const double most =
          upper ? slopes.most_s() - slopes.middle_s() : slopes.middle_s() - slopes.least_s();
      const Surface conditional = conditional_surface(slopes, upper);
      SlopeHalf& half = plan.slopes[upper ? 1 : 0];
      // A visible density is a few times that of the map's base distribution at most.
      half.map = cells_between(offset, most + offset, bits, [&](double begin, double end) {
        return follows_map(slopes, {criterion.tolerance / 4}, upper, begin - offset, end - offset);
      });
      half.rows = cells_between(offset, most + offset, bits, [&](double begin, double end) {
        return follows_rows(conditional, criterion, qs, begin - offset, end - offset);
      });
      too_coarse = too_coarse || half.map.too_coarse || half.rows.too_coarse;
    }
    if (!too_coarse) return;
  }
}

/// The rows of both tables, by the columns as they are laid, if they are.
void lay_rows(Plan& plan, const PairSlopes& slopes, const Criterion& criterion) {
  const Surface lower = marginal_surface(slopes, false), upper = marginal_surface(slopes, true);
  const auto probabilities = [&](const Axis& axis) {
    return axis.cells.empty() ? usual_probabilities() : probabilities_of(plan.columns, axis);
  };
  auto low = probabilities(plan.lower), high = probabilities(plan.upper);
  plan.directions = with_enough_bits({4, 6, 8}, [&](int bits) {
    const double offset = plan.direction_offset;
    return cells_between(offset, 1 + offset, bits, [&](double begin, double end) {
      return follows_rows(lower, criterion, low, begin - offset, end - offset) &&
             follows_rows(upper, criterion, high, begin - offset, end - offset);
    });
  });
  if (!slopes.separable()) lay_slopes(plan, slopes, criterion);
}

/// The columns of both tables, looked at on so many rows in each cell of rows.
void lay_columns(Plan& plan, const PairSlopes& slopes, const Criterion& criterion,
                 std::size_t places) {
  const Surface lower = marginal_surface(slopes, false), upper = marginal_surface(slopes, true),
                conditional = conditional_surface(slopes, false);
  const auto directions = rows_in(lower, plan.directions, plan.direction_offset, places);
  std::vector<double> xs;
  if (slopes.separable()) xs = {0};
  for (std::size_t half = 0; half < 2 && !slopes.separable(); ++half) {
    const auto more = rows_in(conditional_surface(slopes, half == 1), plan.slopes[half].rows,
                              plan.slope_offset, places);
    xs.insert(xs.end(), more.begin(), more.end());
  }
  // The columns of both tables have keys of as many bits.
  for (const int bits : {4, 6}) {
    plan.lower = column_cells(lower, plan.columns, criterion, directions, bits);
    plan.upper = column_cells(upper, plan.columns, criterion, directions, bits);
    if (plan.separable) {
      plan.conditional = column_cells(conditional, plan.columns, criterion, xs, bits);
    } else {
      plan.conditional = column_cells(conditional, plan.columns.halved(false), criterion, xs, bits);
      plan.mirrored = column_cells(conditional, plan.columns.halved(true), criterion, xs, bits);
    }
    if (!plan.lower.too_coarse && !plan.upper.too_coarse && !plan.conditional.too_coarse &&
        !plan.mirrored.too_coarse)
      return;
  }
}

Plan plan_in(const PairSlopes& slopes, const Columns& columns) {
  return {.unit = slopes.unit(), .columns = columns, .separable = slopes.separable()};
}

/// The unit in which the tables need the fewest rows.
double best_unit(const SlopeTables& pair, const Columns& columns, const Criterion& criterion) {
  const auto units = units_to_try(pair);
  const auto rows = [&](double unit) {
    if (units.size() == 1) return std::size_t{0};
    const PairSlopes slopes(pair, unit);
    Plan plan = plan_in(slopes, columns);
    lay_rows(plan, slopes, criterion);
    return plan.directions.cells.size() + plan.slope_rows();
  };
  return *std::ranges::min_element(units, {}, rows);
}

}  // namespace

Plan plan_for(const SlopeTables& pair, const Columns& columns, const Criterion& criterion) {
  const PairSlopes slopes(pair, best_unit(pair, columns, criterion));
  Plan plan = plan_in(slopes, columns);
  // Each is laid twice: rows are looked at where columns end, and columns where rows do.
  for (const std::size_t places : {2u, 6u}) {
    lay_rows(plan, slopes, criterion);
    lay_columns(plan, slopes, criterion, places);
  }
  return plan;
}

}  // namespace vndf::baking
