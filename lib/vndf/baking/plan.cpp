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

// Where in a cell a cubic is compared with the pair, as parts of the width of the cell.
// Hermite cubics have no error at the edges. Three places in a column or nine change the bytes by 2
// % at most.
constexpr std::array<double, 5> kPlacesInColumn{0.12, 0.3, 0.5, 0.7, 0.88};
constexpr std::array<double, 3> kPlacesInRow{0.1, 0.45, 0.9};

/// Whether one cubic follows a row of the surface from p = `begin` to `end`.
bool follows_column(const Surface& surface, const Columns& columns, const Criterion& criterion,
                    double row, double begin, double end) {
  const Node low = node_at(surface, columns, row, begin),
             high = node_at(surface, columns, row, end);
  // Next to the pointed middle of a density the derivative may be infinite. No cell is short enough
  // for it there, so that it is limited where too few samples land to see it.
  const double mass = std::abs(columns.probability(end) - columns.probability(begin));
  const bool rises =
      std::abs(high.value - low.value) >= criterion.least_rise * std::abs(high.value);
  if (rises && mass > criterion.tolerance / 4 && !is_monotone(low, high, end - begin)) return false;
  const Cubic cubic = monotone_hermite(low, high, end - begin);
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
        std::iter_swap(row, rows.begin());  // the next cell will probably fail at the same row
        return false;
      }
    return true;
  });
}

/// Probabilities at which rows are compared while no columns are laid. They crowd at both ends,
/// where quantile functions bend most.
std::vector<double> usual_probabilities() {
  constexpr double kRatio = 1.6, kNearHalf = 0x1p-9;
  std::vector<double> qs;
  for (double q = 0.25; q > 0x1p-24; q /= kRatio) qs.push_back(q);
  for (double p = 0.2; p > kNearHalf; p /= kRatio) qs.push_back(0.5 - p);
  return qs;
}

/// Probabilities at the edges of columns and between them, or usual ones if no columns are laid.
std::vector<double> probabilities_of(const Columns& columns, const Axis& axis) {
  if (axis.cells.empty()) return usual_probabilities();
  std::vector<double> qs;
  for (const AxisCell& cell : axis.cells)
    for (const double f : {0.0, 0.25, 0.5, 0.75})
      qs.push_back(columns.probability(cell.begin + f * cell.width()));
  return qs;
}

/// The same of both halves of the columns of y.
std::vector<double> probabilities_of_y(const Columns& columns, const Axis& conditional,
                                       const Axis& mirrored) {
  auto qs = probabilities_of(columns.halved(false), conditional);
  const auto more = probabilities_of(columns.halved(true), mirrored);
  qs.insert(qs.end(), more.begin(), more.end());
  return qs;
}

/// Whether the cubic through four rows follows the surface between them at each of `qs`, which are
/// put into another order.
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
        std::iter_swap(q, qs.begin());  // the next cell will probably fail at the same q
        return false;
      }
  }
  return true;
}

/// Calls `lay(bits)`, which lays axes with keys of so many bits and says whether all are fine
/// enough, with one number of bits after the other until they are. The fewest make the smallest
/// guides.
template <class Lay>
void lay_with_enough_bits(std::initializer_list<int> candidates, Lay lay) {
  for (const int bits : candidates)
    if (lay(bits)) return;
}

bool fine_enough(std::initializer_list<const Axis*> axes) {
  return std::ranges::none_of(axes, &Axis::too_coarse);
}

// The rows at which columns are compared, as parts of a cell of rows: its edges first, where
// patches meet.
constexpr std::array<double, 6> kRowsInCell{0, 0.5, 0.15, 0.85, 0.35, 0.65};

/// Rows of a surface at so many places in each cell of an axis, whose places are `offset` higher.
std::vector<double> rows_in(const Surface& surface, const Axis& axis, double offset,
                            std::size_t places) {
  std::vector<double> rows;
  for (const AxisCell& cell : axis.cells)
    for (const double f : std::span(kRowsInCell).first(places))
      rows.push_back(surface.row(cell.begin + f * cell.width() - offset));
  rows.push_back(surface.row(axis.cells.back().end - offset));
  return rows;
}

/// Whether the conditional is the same at two slopes x, given by their roots of sigma. It must be,
/// because the kernel looks up rows of y by s, while x is what its map makes of s.
bool same_conditional(const PairSlopes& slopes, const Criterion& criterion, double root,
                      double other) {
  const auto slope = [](double r) { return std::abs(r * r - 0.5) / (r * r * (1 - r * r)); };
  const auto near = [&](double q) {
    return criterion.accepts(slopes.conditional(slope(other), q).value,
                             slopes.conditional(slope(root), q), q);
  };
  return near(0.45) && near(0.25) && near(0.1) && near(0.02);
}

/// Whether one cubic follows the map between two places of a half. Its errors are measured in u of
/// the map's base distribution.
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

/// Lays the cells over s, which share a guide and so have keys of as many bits.
void lay_slopes(Plan& plan, const Criterion& criterion) {
  const PairSlopes& slopes = plan.pair;
  const double offset = plan.slope_offset;
  auto qs = probabilities_of_y(plan.columns, plan.conditional, plan.mirrored);
  lay_with_enough_bits({5, 6, 7}, [&](int bits) {
    bool fine = true;
    for (const bool upper : {false, true}) {
      const double most =
          upper ? slopes.most_s() - slopes.middle_s() : slopes.middle_s() - slopes.least_s();
      const Surface conditional = conditional_surface(slopes, upper);
      SlopeHalf& half = plan.slopes[upper ? 1 : 0];
      // The error in u1 may be a few times larger, as a visible density is larger than that of the
      // map's base distribution. With the whole tolerance here, distributions with rows of y keep
      // it only with the smaller shares, which take 18 to 28 % more bytes.
      half.map = cells_between(offset, most + offset, bits, [&](double begin, double end) {
        return follows_map(slopes, {criterion.tolerance / 4}, upper, begin - offset, end - offset);
      });
      half.rows = cells_between(offset, most + offset, bits, [&](double begin, double end) {
        return follows_rows(conditional, criterion, qs, begin - offset, end - offset);
      });
      fine = fine && fine_enough({&half.map, &half.rows});
    }
    return fine;
  });
}

/// Rows of slope x from the direction of place `first` up or, where `below`, down to the horizon,
/// by the columns if those are laid.
Axis direction_rows(const Plan& plan, const Criterion& criterion, bool below, double first,
                    const Axis& lower, const Axis& upper) {
  const Surface low = marginal_surface(plan.pair, false, below),
                high = marginal_surface(plan.pair, true, below);
  auto low_qs = probabilities_of(plan.columns, lower),
       high_qs = probabilities_of(plan.columns, upper);
  const double offset = plan.direction_offset;
  Axis rows;
  lay_with_enough_bits({4, 6, 8}, [&](int bits) {
    rows = cells_between(first + offset, 1 + offset, bits, [&](double begin, double end) {
      return follows_rows(low, criterion, low_qs, begin - offset, end - offset) &&
             follows_rows(high, criterion, high_qs, begin - offset, end - offset);
    });
    return !rows.too_coarse;
  });
  return rows;
}

/// Lays the rows of both tables, by the columns if those are laid.
void lay_rows(Plan& plan, const Criterion& criterion) {
  plan.directions = direction_rows(plan, criterion, false, 0, plan.lower, plan.upper);
  if (!plan.pair.separable()) lay_slopes(plan, criterion);
}

/// Lays the columns of both tables, compared on so many rows in each cell of rows.
void lay_columns(Plan& plan, const Criterion& criterion, std::size_t places) {
  const PairSlopes& slopes = plan.pair;
  const Surface lower = marginal_surface(slopes, false, false),
                upper = marginal_surface(slopes, true, false),
                conditional = conditional_surface(slopes, false);
  const auto directions = rows_in(lower, plan.directions, plan.direction_offset, places);
  std::vector<double> xs;
  if (slopes.separable()) xs = {0};
  for (std::size_t half = 0; half < 2 && !slopes.separable(); ++half) {
    const auto more = rows_in(conditional_surface(slopes, half == 1), plan.slopes[half].rows,
                              plan.slope_offset, places);
    xs.insert(xs.end(), more.begin(), more.end());
  }
  // The kernel shifts the places of both tables by one number, so that keys have as many bits.
  lay_with_enough_bits({4, 6}, [&](int bits) {
    const auto cells = [&](const Surface& surface, const Columns& columns,
                           const std::vector<double>& rows) {
      return column_cells(surface, columns, criterion, rows, bits);
    };
    plan.lower = cells(lower, plan.columns, directions);
    plan.upper = cells(upper, plan.columns, directions);
    plan.conditional =
        cells(conditional, slopes.separable() ? plan.columns : plan.columns.halved(false), xs);
    if (!slopes.separable()) plan.mirrored = cells(conditional, plan.columns.halved(true), xs);
    return fine_enough({&plan.lower, &plan.upper, &plan.conditional, &plan.mirrored});
  });
}

/// The candidate in whose unit the tables need the fewest rows.
const PairSlopes& best_of(const std::vector<PairSlopes>& candidates, const Columns& columns,
                          const Criterion& criterion) {
  if (candidates.size() == 1) return candidates.front();
  return *std::ranges::min_element(candidates, {}, [&](const PairSlopes& pair) {
    Plan plan{.pair = pair, .columns = columns};
    lay_rows(plan, criterion);
    return plan.directions.cells.size() + plan.slope_rows();
  });
}

/// Lays the rows of what directions below the horizon have, by the columns if those are laid.
void lay_rows_below(Plan& plan, const Criterion& criterion) {
  const PairSlopes& slopes = plan.pair;
  PlanBelow& below = plan.below;
  below.directions =
      direction_rows(plan, criterion, true, slopes.lowest_g(), below.lower, below.upper);
  if (slopes.separable()) return;
  const Surface steep = steep_surface(slopes);
  auto qs = probabilities_of_y(plan.columns, below.conditional, below.mirrored);
  const double offset = plan.slope_offset, most = kMiddleRoot - slopes.least_root();
  lay_with_enough_bits({4, 6, 8}, [&](int bits) {
    below.rows = cells_between(offset, most + offset, bits, [&](double begin, double end) {
      return follows_rows(steep, criterion, qs, begin - offset, end - offset);
    });
    return !below.rows.too_coarse;
  });
}

/// Lays the columns of the same, whose keys have as many bits as those above the horizon.
void lay_columns_below(Plan& plan, const Criterion& criterion, std::size_t places) {
  const PairSlopes& slopes = plan.pair;
  PlanBelow& below = plan.below;
  const int bits = 23 - static_cast<int>(plan.lower.shift);
  const auto cells = [&](const Surface& surface, const Columns& columns, const Axis& rows,
                         double offset) {
    return column_cells(surface, columns, criterion, rows_in(surface, rows, offset, places), bits);
  };
  for (const bool upper : {false, true})
    (upper ? below.upper : below.lower) = cells(marginal_surface(slopes, upper, true), plan.columns,
                                                below.directions, plan.direction_offset);
  if (slopes.separable()) return;
  const Surface steep = steep_surface(slopes);
  below.conditional = cells(steep, plan.columns.halved(false), below.rows, plan.slope_offset);
  below.mirrored = cells(steep, plan.columns.halved(true), below.rows, plan.slope_offset);
}

}  // namespace

void plan_below(Plan& plan, const Criterion& criterion) {
  plan.below = {};
  for (const std::size_t places : {2u, 6u}) {
    lay_rows_below(plan, criterion);
    lay_columns_below(plan, criterion, places);
  }
}

Plan plan_for(const std::vector<PairSlopes>& candidates, const Columns& columns,
              const Criterion& criterion) {
  Plan plan{.pair = best_of(candidates, columns, criterion), .columns = columns};
  // Both are laid twice, because rows are compared where columns end, and columns where rows do.
  // Laid once, rows miss the tolerance of exponential power 0.5, which then takes a quarter more
  // bytes.
  for (const std::size_t places : {2u, 6u}) {
    lay_rows(plan, criterion);
    lay_columns(plan, criterion, places);
  }
  return plan;
}

}  // namespace vndf::baking
