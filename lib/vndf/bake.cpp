// From the pair of tables to those of a kernel: rows and columns are laid, patches filled, and what
// was made is measured against the pair.
#include "vndf/bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "vndf/bake_cells.h"
#include "vndf/bake_curve.h"
#include "vndf/kernel_block.h"
#include "vndf/pair_slopes.h"
#include "vndf/table_coordinates.h"

namespace vndf {
namespace {

using namespace baking;

// Tails are followed to the first part of their mass down to this probability, and to the second
// below it, where they are seldom seen but values must not run away.
constexpr double kTailError = 0.04, kLeastTail = 0x1p-21, kLeastTailError = 0.5;
// Differences below these roundings of a value count as none.
constexpr double kRounding = 0x1p-22;
// Where the errors of a cell are looked at, as parts of its width.
constexpr std::array<double, 5> kPlacesInColumn{0.12, 0.3, 0.5, 0.7, 0.88};
constexpr std::array<double, 3> kPlacesInRow{0.1, 0.45, 0.9};
// What remains of a tolerance for rows and for columns: their errors add up, and single precision
// and the pair's own errors need the rest.
constexpr double kShare = 0.65;
// Shares that are tried after it where the tables as made differ by more than the tolerance.
constexpr std::array<double, 3> kShares{kShare, 0.7 * kShare, 0.45 * kShare};

/// The column axis: places p of probabilities q = min(u, 1 - u), or their mirrors in the middle.
struct Columns {
  bool roots;
  double offset;  ///< of roots
  int octaves;    ///< places above one half are this power of two larger, and so are mirrors
  bool half = false, mirrored = false;

  double least() const { return roots ? offset + 0x1p-12 : 0x1p-25; }
  double most() const { return half ? span() / 2 : roots ? 1 + offset : 0.5; }
  /// What a place and its mirror add up to; not less than the least place and the most do.
  double span() const { return roots ? 1 + 2 * offset + 0x1p-12 : 0.5 + 0x1p-24; }
  double probability(double place) const {
    const double p = mirrored ? span() - place : place;
    if (!roots) return std::min(p, 0.5);
    return std::min((p - offset) * (p - offset) / 2, 0.5);
  }
  /// dq / dp.
  double rate(double place) const {
    if (!roots) return mirrored ? -1 : 1;
    return mirrored ? -(span() - place - offset) : place - offset;
  }
  /// The half of it below the middle, or above.
  Columns halved(bool above) const { return {roots, offset, octaves, true, above}; }
};
// The least place above one half, 2^-25 of p, is to have another key than 1/2 below it.
constexpr Columns kByProbability{false, 0, 25}, kByRoot{true, 0x1p-8, 9};

/// Whether values are near enough to those of a quantile function.
struct Criterion {
  double tolerance;  ///< in u

  bool accepts(double value, const Node& exact, double q) const {
    const double difference = std::abs(value - exact.value);
    const double error = difference / std::abs(exact.derivative);
    const double tail = (q < kLeastTail ? kLeastTailError : kTailError) * q;
    return error <= std::min(tolerance, tail) || difference <= kRounding * std::abs(exact.value);
  }
};

/// A quantile function over rows and q: of (g, u1) or of (place of slope x, q).
struct Surface {
  /// What stands for a row: it is made once for many q.
  std::function<double(double place)> row;
  std::function<Node(double row, double q)> at;
};

/// s of a place |s - s0|.
double s_at(const PairSlopes& slopes, double place, bool upper) {
  return upper ? slopes.middle_s() + place : slopes.middle_s() - place;
}

Surface marginal_surface(const PairSlopes& slopes, bool upper) {
  return {[&slopes](double g) { return slopes.direction_row(g); },
          [&slopes, upper](double row, double q) { return slopes.marginal(row, q, upper); }};
}
/// Over the places |s - s0| of one half.
Surface conditional_surface(const PairSlopes& slopes, bool upper) {
  return {[&slopes, upper](double place) { return slopes.slope_at(s_at(slopes, place, upper)); },
          // The same row is asked for many q in a row.
          [&slopes, last = -1.0, row = PairSlopes::ConditionalRow{}](double x, double q) mutable {
            if (x != last) {
              row = slopes.conditional_row(x);
              last = x;
            }
            return slopes.conditional(row, q);
          }};
}

Node node_at(const Surface& surface, const Columns& columns, double row, double p) {
  const Node node = surface.at(row, columns.probability(p));
  return {node.value, node.derivative * columns.rate(p)};
}

/// Whether the cubic between two nodes turns back nowhere (Fritsch and Carlson 1980).
bool increases(const Node& low, const Node& high, double width) {
  const double rise = kSteepest * (high.value - low.value) / width;
  const auto along = [rise](const Node& node) {
    return std::abs(node.derivative) <= std::abs(rise) && node.derivative * rise >= 0;
  };
  return along(low) && along(high);
}

/// The cubic between two nodes, with derivatives that keep it from turning back.
Cubic limited_hermite(const Node& low, const Node& high, double width) {
  const double most = kSteepest * (high.value - low.value) / width;
  const auto limited = [most](double derivative) {
    return std::clamp(derivative, std::min(most, 0.0), std::max(most, 0.0));
  };
  return hermite({low.value, limited(low.derivative)}, {high.value, limited(high.derivative)},
                 width);
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

/// Cells of the map and rows of the conditional over |s - s0| of one half of s.
struct SlopeHalf {
  Axis map = {}, rows = {};
};

/// The power of two by which places above s0 are larger: more than the octaves of one half.
constexpr int kSlopeOctaves = 8;

/// Where the cells of a kernel lie.
struct Plan {
  double unit;
  Columns columns;
  Axis directions = {}, lower = {}, upper = {};  // of the marginal: rows, columns around 1/2
  Axis conditional = {}, mirrored = {};          // columns of the conditional
  std::array<SlopeHalf, 2> slopes = {};          // below and above s0, unless separable
  double direction_offset = 0x1p-8, slope_offset = 0x1p-8;
  bool separable = false;

  std::size_t slope_rows() const {
    return slopes[0].rows.cells.size() + slopes[1].rows.cells.size();
  }

  /// Bytes of patches and guides.
  std::size_t bytes() const {
    const std::size_t row = 64 * directions.cells.size();
    const std::size_t cell = separable ? 16 : 64 * slope_rows();
    const std::size_t keys =
        2 * lower.count() + (separable ? 1 : 2) * conditional.count() + directions.count();
    std::size_t sum = row * (lower.cells.size() + upper.cells.size()) +
                      cell * (conditional.cells.size() + mirrored.cells.size()) +
                      sizeof(kernel::Guide) * keys;
    if (separable) return sum;
    for (const SlopeHalf& half : slopes)
      sum += 16 * half.map.cells.size() + 2 * sizeof(kernel::Guide) * half.map.count();
    return sum;
  }
};

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
  const auto node = [&](double place) {
    const Node root = slopes.map(s_at(slopes, place, upper));
    return Node{root.value, upper ? root.derivative : -root.derivative};
  };
  const Cubic cubic = hermite(node(begin), node(end), end - begin);
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

/// The same cells with places times a power of two, which moves their keys.
Axis shifted(const Axis& axis, int octaves) {
  Axis result = axis;
  const auto keys = static_cast<std::uint32_t>(octaves) << (23 - axis.shift);
  for (AxisCell& cell : result.cells)
    cell = {cell.first + keys, cell.last + keys, std::ldexp(cell.begin, octaves),
            std::ldexp(cell.end, octaves)};
  return result;
}

/// An axis of both halves, of which the second has larger places.
Axis both_halves(const Axis& lower, const Axis& upper, int octaves) {
  Axis axis = lower;
  const Axis above = shifted(upper, octaves);
  axis.cells.back().last = above.cells.front().first;  // and the keys that no place has, if any
  axis.cells.insert(axis.cells.end(), above.cells.begin(), above.cells.end());
  return axis;
}

/// The patches of one column, row after row. Places are written by powers of two larger than they
/// are here: those of the column by `column_octaves`, those of rows by `row_octaves`.
void put_column(KernelBlock& block, const Surface& surface, const Columns& columns,
                const AxisCell& column, const Axis& rows, double row_offset, int column_octaves,
                int row_octaves) {
  for (const AxisCell& row : rows.cells) {
    std::array<Cubic, 4> along;
    for (std::size_t i = 0; i < 4; ++i) {
      const double at = surface.row(row.begin + kRowPlaces[i] * row.width() - row_offset);
      along[i] = limited_hermite(node_at(surface, columns, at, column.begin),
                                 node_at(surface, columns, at, column.end), column.width());
    }
    std::array<Cubic, 4> patch;  // by the power of the place in the row
    for (std::size_t k = 0; k < 4; ++k) {
      const Cubic across =
          through({along[0][k], along[1][k], along[2][k], along[3][k]}, row.width());
      for (std::size_t power = 0; power < 4; ++power)
        patch[power][k] = std::ldexp(across[power], -column_octaves * static_cast<int>(k) -
                                                        row_octaves * static_cast<int>(power));
    }
    for (const Cubic& cubic : patch) block.put_cubic(cubic);
  }
}

void put_marginal(KernelBlock& block, KernelHeader& h, const Plan& plan, const PairSlopes& slopes) {
  block.align(kKernelAlignment);
  const std::uint32_t first = block.at();
  for (const bool upper : {false, true})
    for (const AxisCell& column : (upper ? plan.upper : plan.lower).cells)
      put_column(block, marginal_surface(slopes, upper), plan.columns, column, plan.directions,
                 plan.direction_offset, upper ? plan.columns.octaves : 0, 0);
  const auto row = static_cast<std::uint32_t>(64 * plan.directions.cells.size());
  h.marginal =
      block.put_guide(both_halves(plan.lower, plan.upper, plan.columns.octaves), first, row);
  h.direction = block.put_guide(plan.directions, 0, 64);
}

/// The cubics of the map over one half, and the guide of both its cells and the rows of patches.
void put_map(KernelBlock& block, const PairSlopes& slopes, const SlopeHalf& half, double offset,
             bool upper) {
  const int octaves = upper ? kSlopeOctaves : 0;
  const auto node = [&](double place) {
    const Node root = slopes.map(s_at(slopes, place - offset, upper));
    return Node{root.value, upper ? root.derivative : -root.derivative};
  };
  for (const AxisCell& cell : half.map.cells) {
    Cubic cubic = hermite(node(cell.begin), node(cell.end), cell.width());
    for (std::size_t k = 0; k < 4; ++k)
      cubic[k] = std::ldexp(cubic[k], -octaves * static_cast<int>(k));
    block.put_cubic(cubic);
  }
}

void put_slopes(KernelBlock& block, KernelHeader& h, const Plan& plan, const PairSlopes& slopes) {
  SlopeHalf lower = plan.slopes[0], upper = plan.slopes[1];
  // The kernel knows one end for both halves: the shorter goes on with its last cell.
  const double most = std::max(lower.map.cells.back().end, upper.map.cells.back().end);
  for (Axis* axis : {&lower.map, &lower.rows, &upper.map, &upper.rows})
    axis->cells.back().last = key_of(most, axis->shift) + 1;
  block.align(16);
  const std::uint32_t first = block.at();
  put_map(block, slopes, lower, plan.slope_offset, false);
  put_map(block, slopes, upper, plan.slope_offset, true);
  // Every key has an entry: one of the map, 16 bytes a cell, and one of a row, 64 bytes a cell.
  const Axis map = both_halves(lower.map, upper.map, kSlopeOctaves),
             rows = both_halves(lower.rows, upper.rows, kSlopeOctaves);
  h.slope = block.put_guides(map, first, 16, rows, 0, 64);
  h.slope_middle = static_cast<float>(slopes.middle_s());
  h.slope_offset = static_cast<float>(plan.slope_offset);
  h.slope_most = static_cast<float>(most);
  h.slope_upper = static_cast<std::uint32_t>(kSlopeOctaves) << 23;
}

void put_conditional(KernelBlock& block, KernelHeader& h, const Plan& plan,
                     const PairSlopes& slopes) {
  block.align(kKernelAlignment);
  const std::uint32_t first = block.at();
  if (plan.separable) {
    const Surface surface = conditional_surface(slopes, false);
    for (const AxisCell& cell : plan.conditional.cells)
      block.put_cubic(limited_hermite(node_at(surface, plan.columns, 0, cell.begin),
                                      node_at(surface, plan.columns, 0, cell.end), cell.width()));
    h.conditional = block.put_guide(plan.conditional, first, 16);
    return;
  }
  const int octaves = plan.columns.octaves;
  for (const bool mirrored : {false, true})
    for (const AxisCell& column : (mirrored ? plan.mirrored : plan.conditional).cells)
      for (const bool upper : {false, true})
        put_column(block, conditional_surface(slopes, upper), plan.columns.halved(mirrored), column,
                   plan.slopes[upper ? 1 : 0].rows, plan.slope_offset, mirrored ? octaves : 0,
                   upper ? kSlopeOctaves : 0);
  h.conditional = block.put_guide(both_halves(plan.conditional, plan.mirrored, octaves), first,
                                  static_cast<std::uint32_t>(64 * plan.slope_rows()));
  put_slopes(block, h, plan, slopes);
}

KernelHeader header_of(const Plan& plan, const PairSlopes& slopes, const SlopeTables& pair) {
  // Slopes are followed to -5e31 and to 4e6 times U; the normal of the first is not horizontal yet.
  constexpr float kLeastRoot = 1e-16f, kMostRoot = 1 - 0x1p-23f;
  KernelHeader h{};
  std::memcpy(h.magic, kKernelMagic, sizeof h.magic);
  h.version = kKernelVersion;
  h.header_bytes = sizeof h;
  h.unit = static_cast<float>(slopes.unit() * pair.mean_slope);
  h.scale_root = static_cast<float>(slopes.scale().root);
  h.scale_constant = static_cast<float>(slopes.scale().constant);
  h.rim = static_cast<float>(slopes.scale().rim);
  h.least_root = kLeastRoot;
  h.most_root = kMostRoot;
  h.direction_offset = static_cast<float>(plan.direction_offset);
  h.column_offset = static_cast<float>(plan.columns.offset);
  h.column_span = static_cast<float>(plan.columns.span());
  h.column_mirror = static_cast<std::uint32_t>(plan.columns.octaves) << 23;
  h.column_upper = kernel::kVndfSign + (static_cast<std::uint32_t>(plan.columns.octaves) << 23);
  h.column_roots = plan.columns.roots ? 1 : 0;
  h.separable = plan.separable ? 1 : 0;
  return h;
}

KernelTables tables_of(const Plan& plan, const SlopeTables& pair, double tolerance) {
  const PairSlopes slopes(pair, plan.unit);
  KernelBlock block;
  KernelHeader h = header_of(plan, slopes, pair);
  h.tolerance = tolerance;
  put_marginal(block, h, plan, slopes);
  put_conditional(block, h, plan, slopes);
  h.sampling_bytes = block.at() - sizeof h;
  const auto ndf = [&](double x) { return slopes.log2_ndf(x); };
  const auto backfacing = [&](double c) { return slopes.log2_backfacing(c); };
  h.ndf = put_curve(block, spans_of(pair.log_ndf, plan.unit, ndf), ndf, tolerance);
  h.backfacing =
      put_curve(block, spans_of(pair.log_backfacing, plan.unit, backfacing), backfacing, tolerance);
  h.bytes = h.text = block.at();
  std::memcpy(block.bytes().data(), &h, sizeof h);
  h.checksum = kernel_checksum(block.bytes());
  std::memcpy(block.bytes().data(), &h, sizeof h);
  KernelText text;
  text.distribution = pair.distribution;
  return KernelTables::copy(block.bytes()).with_text(text);
}

/// The largest differences of a kernel from the pair, in u.
struct Differences {
  double x = 0, y = 0;

  double larger() const { return std::max(x, y); }
};

/// Places in (0, 1) that are commensurate with no grid.
double golden(std::size_t k) {
  constexpr double kRatio = 0.6180339887498949;
  const double x = kRatio * static_cast<double>(k + 1);
  return x - std::floor(x);
}

/// u in single precision: golden in its root from both ends, so that tails are looked at too.
float golden_u(std::size_t k) {
  const double v = golden(k), q = v * v / 2;
  return static_cast<float>(k % 2 == 0 ? q : 1 - q);
}

Differences differences(const KernelTables& tables, const PairSlopes& slopes) {
  constexpr std::size_t kDirections = 128, kDraws = 160;
  const Kernel kernel = tables.kernel();
  const kernel::VndfTables& t = kernel.tables();
  Differences worst;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double wanted = golden(i) * (i % 4 == 0 ? golden(i) : 1);
    const Vec3<float> wi{static_cast<float>(wanted), 0, static_cast<float>(1 - wanted)};
    const kernel::VndfDirection at = kernel::vndf_at(t, wi, 1 / t.unit, 1);
    const double row = slopes.direction_row(double{wi.x} / (double{wi.x} + double{wi.z}));
    for (std::size_t k = 0; k < kDraws; ++k) {
      const float u1 = golden_u(k + i), u2 = golden_u(7 * k + 3 * i);
      const kernel::VndfDraw draw = kernel::vndf_draw(t, at, u1, u2);
      const bool upper = u1 > 0.5f;
      const double q = upper ? 1 - double{u1} : double{u1};
      const double found = slopes.marginal_inverse(row, draw.root, upper);
      worst.x = std::max(worst.x, std::abs(found - q));
      const double q2 = std::min(double{u2}, 1 - double{u2});
      const double sigma = double{draw.root} * draw.root;
      const Node y = slopes.conditional(std::abs(sigma - 0.5) / (sigma * (1 - sigma)), q2);
      const double difference = std::abs(std::abs(double{draw.v}) + y.value);
      if (difference > kRounding * std::abs(y.value))
        worst.y = std::max(worst.y, difference / std::abs(y.derivative));
    }
  }
  return worst;
}

void require_options(const BakeOptions& options) {
  if (!(options.tolerance >= kLeastTolerance && options.tolerance <= kMostTolerance))
    throw std::invalid_argument("tolerance of a kernel: give a number from 1e-6 to 1e-2");
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

}  // namespace

KernelTables bake(const SlopeTables& pair, const BakeOptions& options) {
  require_options(options);
  if (const auto broken = check(pair)) throw std::invalid_argument("slope tables: " + *broken);
  std::string reached;
  for (const Columns& columns : {kByProbability, kByRoot}) {
    for (const double share : kShares) {
      const Plan plan = plan_for(pair, columns, {share * options.tolerance});
      if (plan.bytes() > options.max_bytes) {
        reached += (reached.empty() ? "" : "; ") + number(static_cast<double>(plan.bytes())) +
                   " bytes would be needed " + (columns.roots ? "with columns by roots" : "");
        break;
      }
      const KernelTables tables = tables_of(plan, pair, options.tolerance);
      const Differences found = differences(tables, PairSlopes(pair, plan.unit));
      if (found.larger() <= options.tolerance) return tables.with_differences(found.x, found.y);
      reached += (reached.empty() ? "" : "; ") + number(found.larger()) + " was reached with " +
                 number(static_cast<double>(plan.bytes())) + " bytes";
    }
  }
  throw BakeError("no kernel of " + pair.distribution + " keeps " + number(options.tolerance) +
                  " in " + std::to_string(options.max_bytes) + " bytes: " + reached +
                  "; give a larger tolerance or more bytes");
}

}  // namespace vndf
