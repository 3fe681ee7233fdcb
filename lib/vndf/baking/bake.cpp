// From the pair of tables to those of a kernel. The cells of a plan are written as a block, and the
// block is measured against the pair, because the errors of rows, of columns and of single
// precision add up in ways that a plan does not see.
#include "vndf/baking/bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "vndf/baking/block.h"
#include "vndf/baking/curve.h"
#include "vndf/baking/pair_slopes.h"
#include "vndf/baking/plan.h"
#include "vndf/support/low_discrepancy.h"

namespace vndf {
namespace {

using namespace baking;

// Which part of the tolerance a plan gives to rows and to columns each, for their errors add up. A
// smaller part is tried where the tables as made differ by more than the tolerance. Of 0.55, 0.65,
// 0.75 and 0.85 none is best for all of the six distributions below, whose bytes differ by 13 % at
// most; with 0.65 those whose slope y has one variable keep the tolerance at the first try.
//
// Constants of baking were chosen at a tolerance of 1e-5 from the bytes of GGX, Beckmann, Student-T
// 1.6, exponential power 0.5, K 1 and a mixture of GGX and Beckmann at 1:3.
constexpr double kShare = 0.65;
constexpr std::array<double, 3> kShares{kShare, 0.7 * kShare, 0.45 * kShare};

/// The same cells with places times a power of two, which adds to their keys.
Axis shifted(const Axis& axis, int octaves) {
  Axis result = axis;
  const auto keys = static_cast<std::uint32_t>(octaves) << (23 - axis.shift);
  for (AxisCell& cell : result.cells)
    cell = {cell.first + keys, cell.last + keys, std::ldexp(cell.begin, octaves),
            std::ldexp(cell.end, octaves)};
  return result;
}

/// One axis of both halves, of which the upper one has places larger by `octaves` powers of two.
Axis both_halves(const Axis& lower, const Axis& upper, int octaves) {
  Axis axis = lower;
  const Axis above = shifted(upper, octaves);
  axis.cells.back().last = above.cells.front().first;  // with the keys between, which no place has
  axis.cells.insert(axis.cells.end(), above.cells.begin(), above.cells.end());
  return axis;
}

/// Puts the patches of one column, row after row. In the block places of the column are larger by
/// `column_octaves` powers of two than they are here, and those of rows by `row_octaves`.
void put_column(KernelBlock& block, const Surface& surface, const Columns& columns,
                const AxisCell& column, const Axis& rows, double row_offset, int column_octaves,
                int row_octaves) {
  for (const AxisCell& row : rows.cells) {
    std::array<Cubic, 4> along;
    for (std::size_t i = 0; i < 4; ++i) {
      const double at = surface.row(row.begin + kRowPlaces[i] * row.width() - row_offset);
      along[i] = monotone_hermite(node_at(surface, columns, at, column.begin),
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

/// Puts the patches of slope x over the rows `directions` and the columns of both halves of u1, and
/// returns the axis of the columns.
KernelAxis put_slopes_x(KernelBlock& block, const Plan& plan, const Axis& directions,
                        const Axis& lower, const Axis& upper, bool below) {
  block.align(kKernelAlignment);
  const std::uint32_t first = block.at();
  for (const bool above_half : {false, true})
    for (const AxisCell& column : (above_half ? upper : lower).cells)
      put_column(block, marginal_surface(plan.pair, above_half, below), plan.columns, column,
                 directions, plan.direction_offset, above_half ? plan.columns.octaves : 0, 0);
  const auto row = static_cast<std::uint32_t>(64 * directions.cells.size());
  return block.put_guide({{both_halves(lower, upper, plan.columns.octaves), first, row}});
}

void put_marginal(KernelBlock& block, KernelHeader& h, const Plan& plan) {
  h.marginal = put_slopes_x(block, plan, plan.directions, plan.lower, plan.upper, false);
  h.direction = block.put_guide({{plan.directions, 0, 64}});
}

/// Puts the cubics of the map over one half.
void put_map(KernelBlock& block, const PairSlopes& slopes, const SlopeHalf& half, double offset,
             bool upper) {
  const int octaves = upper ? kSlopeOctaves : 0;
  for (const AxisCell& cell : half.map.cells) {
    Cubic cubic = hermite(map_node(slopes, cell.begin - offset, upper),
                          map_node(slopes, cell.end - offset, upper), cell.width());
    for (std::size_t k = 0; k < 4; ++k)
      cubic[k] = std::ldexp(cubic[k], -octaves * static_cast<int>(k));
    block.put_cubic(cubic);
  }
}

void put_slopes(KernelBlock& block, KernelHeader& h, const Plan& plan) {
  SlopeHalf lower = plan.slopes[0], upper = plan.slopes[1];
  // The kernel knows one end for both halves. The shorter half goes on with its last cell.
  const double most = std::max(lower.map.cells.back().end, upper.map.cells.back().end);
  for (Axis* axis : {&lower.map, &lower.rows, &upper.map, &upper.rows})
    axis->cells.back().last = key_of(most, axis->shift) + 1;
  block.align(16);
  const std::uint32_t first = block.at();
  put_map(block, plan.pair, lower, plan.slope_offset, false);
  put_map(block, plan.pair, upper, plan.slope_offset, true);
  const Axis map = both_halves(lower.map, upper.map, kSlopeOctaves),
             rows = both_halves(lower.rows, upper.rows, kSlopeOctaves);
  h.slope = block.put_guide({{map, first, 16}, {rows, 0, 64}});
  h.slope_middle = static_cast<float>(plan.pair.middle_s());
  h.slope_offset = static_cast<float>(plan.slope_offset);
  h.slope_most = static_cast<float>(most);
  h.slope_upper = static_cast<std::uint32_t>(kSlopeOctaves) << 23;
}

/// Rows of y over one range of slopes x, whose places are larger by `octaves` powers of two in the
/// block.
struct RowsOfY {
  Surface surface;
  const Axis& rows;
  int octaves;
};

/// Puts the patches of slope y over the rows of all `ranges` and the columns of both halves of u2,
/// and returns the axis of the columns.
KernelAxis put_slopes_y(KernelBlock& block, const Plan& plan, std::span<const RowsOfY> ranges,
                        const Axis& conditional, const Axis& mirror) {
  block.align(kKernelAlignment);
  const std::uint32_t first = block.at();
  const int octaves = plan.columns.octaves;
  for (const bool mirrored : {false, true})
    for (const AxisCell& column : (mirrored ? mirror : conditional).cells)
      for (const RowsOfY& range : ranges)
        put_column(block, range.surface, plan.columns.halved(mirrored), column, range.rows,
                   plan.slope_offset, mirrored ? octaves : 0, range.octaves);
  std::size_t rows = 0;
  for (const RowsOfY& range : ranges) rows += range.rows.cells.size();
  return block.put_guide(
      {{both_halves(conditional, mirror, octaves), first, static_cast<std::uint32_t>(64 * rows)}});
}

/// Puts the cubics of slope y over its scale, which has one row for all slopes x.
KernelAxis put_separable_y(KernelBlock& block, const Plan& plan) {
  block.align(kKernelAlignment);
  const std::uint32_t first = block.at();
  const Surface surface = conditional_surface(plan.pair, false);
  for (const AxisCell& cell : plan.conditional.cells)
    block.put_cubic(monotone_hermite(node_at(surface, plan.columns, 0, cell.begin),
                                     node_at(surface, plan.columns, 0, cell.end), cell.width()));
  return block.put_guide({{plan.conditional, first, 16}});
}

void put_conditional(KernelBlock& block, KernelHeader& h, const Plan& plan) {
  if (plan.pair.separable()) {
    h.conditional = put_separable_y(block, plan);
    return;
  }
  const std::array ranges{
      RowsOfY{conditional_surface(plan.pair, false), plan.slopes[0].rows, 0},
      RowsOfY{conditional_surface(plan.pair, true), plan.slopes[1].rows, kSlopeOctaves}};
  h.conditional = put_slopes_y(block, plan, ranges, plan.conditional, plan.mirrored);
  put_slopes(block, h, plan);
}

/// Puts what directions below the horizon have of their own.
void put_below(KernelBlock& block, KernelHeader& h, const Plan& plan) {
  const PlanBelow& below = plan.below;
  h.below_marginal = put_slopes_x(block, plan, below.directions, below.lower, below.upper, true);
  h.below_direction = block.put_guide({{below.directions, 0, 64}});
  h.below_most_cotangent = static_cast<float>(
      std::min(plan.pair.most_cotangent(), double{std::numeric_limits<float>::max()}));
  h.below_least_place = static_cast<float>(below.directions.cells.front().begin);
  if (plan.pair.separable()) return;
  const std::array ranges{RowsOfY{steep_surface(plan.pair), below.rows, 0}};
  h.below_conditional = put_slopes_y(block, plan, ranges, below.conditional, below.mirrored);
  h.below_slope = block.put_guide({{below.rows, 0, 64}});
  h.below_slope_most = static_cast<float>(below.rows.cells.back().end);
}

KernelHeader header_of(const Plan& plan) {
  // Slopes from -5e31 to 4e6 times U: the normal of the first is not horizontal yet, and nearer to
  // 1 single precision has no root.
  constexpr float kLeastRoot = 1e-16f, kMostRoot = 1 - 0x1p-23f;
  const PairSlopes& pair = plan.pair;
  KernelHeader h{};
  std::memcpy(h.magic, kKernelMagic, sizeof h.magic);
  h.version = kKernelVersion;
  h.header_bytes = sizeof h;
  h.unit = static_cast<float>(pair.unit() * pair.tables().mean_slope);
  h.scale_root = static_cast<float>(pair.scale().root);
  h.scale_constant = static_cast<float>(pair.scale().constant);
  h.rim = static_cast<float>(pair.scale().rim);
  h.least_root = kLeastRoot;
  h.most_root = kMostRoot;
  h.direction_offset = static_cast<float>(plan.direction_offset);
  h.column_offset = static_cast<float>(plan.columns.offset);
  h.column_span = static_cast<float>(plan.columns.span());
  h.column_mirror = static_cast<std::uint32_t>(plan.columns.octaves) << 23;
  h.column_upper = kernel::kVndfSign + (static_cast<std::uint32_t>(plan.columns.octaves) << 23);
  h.column_roots = plan.columns.roots ? 1 : 0;
  h.separable = plan.pair.separable() ? 1 : 0;
  return h;
}

KernelTables tables_of(const Plan& plan, double tolerance) {
  const SlopeTables& pair = plan.pair.tables();
  KernelBlock block;
  KernelHeader h = header_of(plan);
  h.tolerance = tolerance;
  put_marginal(block, h, plan);
  put_conditional(block, h, plan);
  h.sampling_bytes = block.at() - sizeof h;
  if (!plan.below.directions.cells.empty()) put_below(block, h, plan);
  h.below_bytes = block.at() - sizeof h - h.sampling_bytes;
  const auto ndf = [&](double x) { return plan.pair.log2_ndf(x); };
  const auto backfacing = [&](double c) { return plan.pair.log2_backfacing(c); };
  const double unit = plan.pair.unit();
  h.ndf = put_curve(block, spans_of(pair.log_ndf, unit, ndf), ndf, tolerance);
  h.backfacing =
      put_curve(block, spans_of(pair.log_backfacing, unit, backfacing), backfacing, tolerance);
  h.bytes = h.samples = h.text = block.at();
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

/// The k-th u of a sequence whose roots are golden from both ends, so that it reaches into tails.
float golden_u(std::size_t k) {
  const double v = support::golden(k + 1, 0), q = v * v / 2;
  return static_cast<float>(k % 2 == 0 ? q : 1 - q);
}

/// Whether `value`, the root of sigma over that of g, is what the pair has for a direction below
/// the horizon but for rounding, which is twice that of a cubic because it is a product.
bool equal_but_for_rounding(const PairSlopes& slopes, double row, double q, bool upper,
                            double value) {
  const double exact = slopes.marginal_below(row, q, upper).value;
  return std::abs(value - exact) <= 2 * kRounding * exact;
}

/// Those for directions above the horizon, or for those below it that have rows of their own.
Differences differences(const KernelTables& tables, const PairSlopes& slopes, bool below) {
  constexpr std::size_t kDirections = 128, kDraws = 160;
  const Kernel kernel = tables.kernel();
  const kernel::VndfTables& t = kernel.tables();
  Differences worst;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double place = support::golden(i + 1, 0), wanted = i % 4 == 0 ? place * place : place;
    const auto z = static_cast<float>(1 - wanted);
    const Vec3<float> wi{static_cast<float>(wanted), 0, below ? -z : z};
    const kernel::VndfDirection at = kernel::vndf_at(t, wi, 1 / t.unit, 1);
    const double g = double{wi.x} / (double{wi.x} + double{z});
    if (below && g < slopes.lowest_g()) continue;
    const double row = slopes.direction_row(g, below);
    for (std::size_t k = 0; k < kDraws; ++k) {
      const float u1 = golden_u(k + i), u2 = golden_u(7 * k + 3 * i);
      const kernel::VndfDraw draw = kernel::vndf_draw(t, at, u1, u2);
      const bool upper = u1 > 0.5f;
      const double q = upper ? 1 - double{u1} : double{u1};
      const double found = slopes.marginal_inverse(row, draw.root, upper);
      if (!below || !equal_but_for_rounding(slopes, row, q, upper, draw.root / std::sqrt(g)))
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

/// The tables of a plan that keep the tolerance, and their differences from the pair.
struct Baked {
  Plan plan;
  KernelTables tables;
  Differences found;
};

/// What was reached where the tolerance could not be kept, for a message.
class Reached {
 public:
  void add(const std::string& what) { text_ += (text_.empty() ? "" : "; ") + what; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The first tables that keep the tolerance, above the horizon or `below` it, of the plans that
/// `plan_with` makes for ever smaller shares of it. Returns nothing where none does, or as soon as
/// there is no plan.
template <class PlanWith>
std::optional<Baked> first_within(double tolerance, bool below, Reached& reached,
                                  PlanWith plan_with) {
  for (const double share : kShares) {
    const std::optional<Plan> plan = plan_with(share * tolerance);
    if (!plan) return {};
    const KernelTables tables = tables_of(*plan, tolerance);
    const Differences found = differences(tables, plan->pair, below);
    if (found.larger() <= tolerance) return Baked{*plan, tables, found};
    const auto bytes = below ? tables.header().below_bytes : plan->bytes();
    reached.add(number(found.larger()) + " was reached with " + number(static_cast<double>(bytes)) +
                " bytes");
  }
  return {};
}

/// Tables with what directions below the horizon need.
Baked with_below(const Baked& above, double tolerance) {
  Reached reached;
  const auto baked = first_within(tolerance, true, reached, [&](double share) {
    std::optional<Plan> plan = above.plan;
    plan_below(*plan, criterion_below(share));
    return plan;
  });
  if (!baked)
    throw BakeError("no kernel of " + above.plan.pair.tables().distribution + " keeps " +
                    number(tolerance) + " below the horizon: " + reached.text() +
                    "; give a larger tolerance, or leave directions below the horizon out");
  const Differences larger{std::max(above.found.x, baked->found.x),
                           std::max(above.found.y, baked->found.y)};
  return {baked->plan, baked->tables, larger};
}

/// Tables for directions above the horizon, with columns by probabilities or else by their roots.
Baked above_only(const std::vector<PairSlopes>& candidates, const BakeOptions& options) {
  Reached reached;
  for (const Columns& columns : {kByProbability, kByRoot}) {
    const auto plan_with = [&](double share) -> std::optional<Plan> {
      const Plan plan = plan_for(candidates, columns, {share});
      if (plan.bytes() <= options.max_bytes) return plan;
      reached.add(number(static_cast<double>(plan.bytes())) + " bytes would be needed" +
                  (columns.roots ? " with columns by roots" : ""));
      return {};
    };
    if (const auto baked = first_within(options.tolerance, false, reached, plan_with))
      return *baked;
  }
  throw BakeError("no kernel of " + candidates.front().tables().distribution + " keeps " +
                  number(options.tolerance) + " in " + std::to_string(options.max_bytes) +
                  " bytes: " + reached.text() + "; give a larger tolerance or more bytes");
}

}  // namespace

KernelTables bake(const SlopeTables& pair, const BakeOptions& options) {
  require_options(options);
  if (const auto broken = check(pair)) throw std::invalid_argument("slope tables: " + *broken);
  const std::vector<PairSlopes> candidates = pair_in_units(pair);
  const Baked above = above_only(candidates, options);
  const bool goes_below = options.below_horizon && above.plan.pair.reaches_below();
  const Baked baked = goes_below ? with_below(above, options.tolerance) : above;
  return baked.tables.with_differences(baked.found.x, baked.found.y);
}

}  // namespace vndf
