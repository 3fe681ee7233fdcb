// From the pair of tables to those of a kernel.
#include "vndf/bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "vndf/bake_cells.h"
#include "vndf/table_coordinates.h"
#include "vndf/tabulated_sampler.h"

namespace vndf {
namespace {

using namespace baking;

// The tails are followed to 2^-22 in u, relative to this.
constexpr double kTailError = 0.1, kLeastTail = 0x1p-22;
// Where the errors of a cell are looked at, as parts of its width.
constexpr std::array<double, 5> kPlacesInColumn{0.12, 0.3, 0.5, 0.7, 0.88};
constexpr std::array<double, 3> kPlacesInRow{0.1, 0.45, 0.9};

constexpr float kLeastRoot = 1e-9f, kMostRoot = 1 - 0x1p-23f;

/// The column axis: places p of probabilities q = min(u, 1 - u).
struct Columns {
  bool roots;
  double offset;  ///< of roots
  int octaves;    ///< by which places above one half are shifted, as a power of two

  double least() const { return roots ? offset : 0x1p-25; }
  double most() const { return roots ? 1 + offset : 0.5; }
  double probability(double p) const {
    if (!roots) return p;
    const double root = std::max(p - offset, std::ldexp(1, -13));
    return root * root / 2;
  }
  /// dq / dp.
  double rate(double p) const { return roots ? p - offset : 1; }
};
// The least place above one half, 2^-25 of p, is to have another key than 1/2 below it.
constexpr Columns kByProbability{false, 0, 25}, kByRoot{true, 0x1p-8, 9};

/// What is followed: values over q, with derivatives, and the error in u of other values.
struct Judge {
  double tolerance;
  double tail_error = kTailError;

  /// Whether `value` in place of `exact`, which changes by `exact.derivative` for each 1 of q, is
  /// near enough at q.
  bool accepts(double value, const Node& exact, double q) const {
    const double error = std::abs((value - exact.value) / exact.derivative);
    return error <= tolerance && (error <= tail_error * q || q < kLeastTail);
  }
};

/// The slopes of a pair in units of `unit`, in the kernel's terms.
class PairSlopes {
 public:
  PairSlopes(const SlopeTables& pair, double unit)
      : pair_(pair),
        sampler_(std::shared_ptr<const SlopeTables>(std::shared_ptr<void>(), &pair)),
        unit_(unit) {
    const bool separable = pair.conditional.rows() == 1;
    separable_ = separable;
    if (std::isfinite(pair.support))
      rim_ = pair.support / unit;
    else if (separable && pair.conditional_quadratic == 0)
      scale_constant_ = 1;
    else
      scale_root_ = 1;
  }

  bool separable() const { return separable_; }
  double rim() const { return rim_; }
  double scale_root() const { return scale_root_; }
  double scale_constant() const { return scale_constant_; }
  double unit() const { return unit_; }

  /// The cotangent at g = 1 / (1 + c).
  BoundedSlope<double> cotangent(double g) const { return bounded_cotangent(unit_ * (1 - g), g); }

  /// The root of sigma of slope x for u1 = q, or 1 - q above one half, with its derivative by q.
  Node marginal(const BoundedSlope<double>& c, double q, bool upper) const {
    return with_derivative(q, [&](double p) { return root(c, p, upper); });
  }
  double root(const BoundedSlope<double>& c, double q, bool upper) const {
    const Probability<double> u =
        upper ? Probability<double>{1 - q, q} : Probability<double>{q, 1 - q};
    return std::sqrt(bounded_from_slope(sampler_.sample_marginal(c, u).slope() / unit_).sigma);
  }

  /// -|y| over its scale for q = min(u2, 1 - u2), with its derivative by q.
  Node conditional(double x, double q) const {
    return with_derivative(q, [&](double p) { return value(x, p); });
  }
  double value(double x, double q) const {
    const auto bounded = bounded_from_slope(x * unit_);
    const auto y =
        conditional_value_inverse(sampler_.sample_conditional(bounded, {1 - 2 * q, 2 * q}));
    const SlopeFraction<double> fraction{bounded.numerator(), bounded.denominator()};
    const ConditionalScale<double> pair_scale{pair_.conditional_constant,
                                              pair_.conditional_quadratic};
    const double scale = pair_scale.at(fraction) / fraction.denominator;
    return -y.slope() * scale / (unit_ * scale_at(x));
  }

  /// |x| of a place on the axis of slopes.
  static double slope_at(double m) {
    const double inside = std::clamp(m, 0.0, 0.5 * (1 - 1e-9));
    return inside / ((0.5 - inside) * (0.5 + inside));
  }
  /// The place of the farthest slope that more than one in 1e9 samples exceeds at grazing
  /// incidence.
  double farthest_place() const {
    const double far = root(cotangent(1), 1e-9, false);
    return 0.5 - far * far;
  }

  double log2_ndf(double x) const {
    const double r = x * unit_;
    return (pair_.log_ndf.log_at(std::asinh(r)) - 2 * std::log1p(r * r) + 2 * std::log(unit_) +
            2 * std::log1p(x * x)) /
           std::log(2.0);
  }
  double log2_backfacing(double c) const {
    return (pair_.log_backfacing.log_at(std::asinh(c * unit_)) - std::log(unit_)) / std::log(2.0);
  }

 private:
  double scale_at(double x) const {
    if (rim_ > 0) return std::sqrt(std::max((rim_ - x) * (rim_ + x), 1e-300));
    return scale_root_ * std::hypot(1, x) + scale_constant_;
  }

  template <class F>
  static Node with_derivative(double q, F f) {
    const double step = 1e-4 * q, low = q - step, high = std::min(q + step, 0.5);
    return {f(q), (f(high) - f(low)) / (high - low)};
  }

  const SlopeTables& pair_;
  TabulatedSampler<double> sampler_;
  double unit_;
  bool separable_;
  double rim_ = 0, scale_root_ = 0, scale_constant_ = 0;
};

/// A function of rows and of columns: of (g, u1) or of (slope x, q).
struct Surface {
  /// Value and derivative by q at a row's place and at q.
  std::function<Node(double row, double q)> at;
};

double lagrange(const std::array<double, 4>& values, double f) {
  return baking::at(through(values, 1), f);
}

Node at_place(const Surface& surface, const Columns& columns, double row, double p) {
  const Node node = surface.at(row, columns.probability(p));
  return {node.value, node.derivative * columns.rate(p)};
}

/// Whether a cell of columns follows the surface at these rows.
bool follows_columns(const Surface& surface, const Columns& columns, const Judge& judge,
                     const std::vector<double>& rows, double begin, double end) {
  for (const double row : rows) {
    const Cubic cubic = hermite(at_place(surface, columns, row, begin),
                                at_place(surface, columns, row, end), end - begin);
    for (const double f : kPlacesInColumn) {
      const double p = begin + f * (end - begin), q = columns.probability(p);
      if (!judge.accepts(baking::at(cubic, p - begin), surface.at(row, q), q)) return false;
    }
  }
  return true;
}

/// Whether a cell of rows follows the surface at these q.
bool follows_rows(const Surface& surface, const Judge& judge, const std::vector<double>& qs,
                  double begin, double end) {
  const auto row = [&](double f) { return begin + f * (end - begin); };
  for (const double q : qs) {
    std::array<double, 4> values;
    for (std::size_t i = 0; i < 4; ++i) values[i] = surface.at(row(kRowPlaces[i]), q).value;
    for (const double f : kPlacesInRow)
      if (!judge.accepts(lagrange(values, f), surface.at(row(f), q), q)) return false;
  }
  return true;
}

/// Probabilities to look at when rows are laid, before columns are.
std::vector<double> usual_probabilities() {
  std::vector<double> qs;
  for (double q = 0x1p-24; q < 0.45; q *= 1.6) qs.push_back(q);
  return qs;
}

/// Rows and columns of a table; the halves of the columns lie side by side.
struct Layout {
  Axis rows, lower, upper;

  std::size_t columns() const { return lower.cells.size() + upper.cells.size(); }
  std::size_t patches() const { return rows.cells.size() * columns(); }
  bool too_coarse() const { return rows.too_coarse || lower.too_coarse || upper.too_coarse; }
};

std::vector<double> places_in(const Axis& rows, double offset) {
  std::vector<double> places;
  for (const AxisCell& cell : rows.cells)
    for (const double f : {0.0, 0.25, 0.5, 0.75})
      places.push_back(cell.begin + f * cell.width() - offset);
  return places;
}

/// The finest of the least numbers of bits on which no cell of one key is too coarse.
template <class Make>
Axis with_enough_bits(std::initializer_list<int> candidates, Make make) {
  Axis axis;
  for (const int bits : candidates) {
    axis = make(bits);
    if (!axis.too_coarse) break;
  }
  return axis;
}

struct Plan {
  PairSlopes slopes;
  Columns columns;
  Layout marginal, conditional;
  double direction_offset = 0x1p-8, slope_offset = 0x1p-9;

  std::size_t guide_bytes() const {
    const std::size_t column_octaves = columns.roots ? 18 : 48;
    const std::size_t per_octave = std::size_t{1} << (23 - marginal.lower.shift);
    const std::size_t rows =
        marginal.rows.count() + (slopes.separable() ? 0 : conditional.rows.count());
    return 8 * (column_octaves * per_octave * 3 / 2 + rows);
  }
  std::size_t bytes() const {
    const std::size_t cell = slopes.separable() ? 16 : 64;
    return 64 * marginal.patches() + cell * conditional.patches() + guide_bytes();
  }
};

Plan plan_of(const SlopeTables& pair, double unit, const Columns& columns, const Judge& judge) {
  Plan plan{PairSlopes(pair, unit), columns, {}, {}};
  const PairSlopes& slopes = plan.slopes;
  const auto marginal = [&slopes](bool upper) {
    return Surface{[&slopes, upper](double g, double q) {
      return slopes.marginal(slopes.cotangent(g), q, upper);
    }};
  };
  const Surface lower = marginal(false), upper = marginal(true);
  const auto qs = usual_probabilities();
  const double offset = plan.direction_offset;
  plan.marginal.rows = with_enough_bits({4, 6, 8}, [&](int bits) {
    return cells_between(offset, 1 + offset, bits, [&](double begin, double end) {
      return follows_rows(lower, judge, qs, begin - offset, end - offset) &&
             follows_rows(upper, judge, qs, begin - offset, end - offset);
    });
  });
  const Surface conditional{
      [&slopes](double m, double q) { return slopes.conditional(PairSlopes::slope_at(m), q); }};
  const double slope_offset = plan.slope_offset;
  const double farthest = slopes.farthest_place();
  if (slopes.separable()) {
    plan.conditional.rows.cells = {{0, 1, 0, 1}};
  } else {
    plan.conditional.rows = with_enough_bits({5, 7, 9}, [&](int bits) {
      return cells_between(slope_offset, 0.5 + slope_offset, bits, [&](double begin, double end) {
        // No sample lands beyond the farthest slope.
        return begin - slope_offset >= farthest ||
               follows_rows(conditional, judge, qs, begin - slope_offset,
                            std::min(end - slope_offset, farthest));
      });
    });
  }
  const auto directions = places_in(plan.marginal.rows, offset);
  std::vector<double> xs{0};
  if (!slopes.separable()) xs = places_in(plan.conditional.rows, slope_offset);
  std::erase_if(xs, [&](double m) { return m > farthest; });
  // The columns of both tables have keys of as many bits.
  for (const int bits : {4, 6}) {
    const auto columns_of = [&](const Surface& surface, const std::vector<double>& rows) {
      return cells_between(columns.least(), columns.most(), bits, [&](double begin, double end) {
        return follows_columns(surface, columns, judge, rows, begin, end);
      });
    };
    plan.marginal.lower = columns_of(lower, directions);
    plan.marginal.upper = columns_of(upper, directions);
    plan.conditional.lower = columns_of(conditional, xs);
    if (!plan.marginal.too_coarse() && !plan.conditional.lower.too_coarse) break;
  }
  return plan;
}

/// The bytes of a block as they are put together.
class BlockWriter {
 public:
  BlockWriter() : bytes_(sizeof(KernelHeader)) {}

  std::uint32_t at() const { return static_cast<std::uint32_t>(bytes_.size()); }

  void align(std::size_t to) { bytes_.resize((bytes_.size() + to - 1) / to * to); }

  template <class V>
  void put(const V& value) {
    const auto* p = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), p, p + sizeof value);
  }

  /// The coefficients of a cubic in the order of the kernel's lanes.
  void put_cubic(const Cubic& c) {
    for (const std::size_t k : {0u, 2u, 1u, 3u}) put(static_cast<float>(c[k]));
  }

  /// A guide of an axis, whose cell k is `distance` bytes after the one before it.
  KernelAxis put_guide(const Axis& axis, std::uint32_t first, std::uint32_t distance) {
    align(8);
    const KernelAxis written{at(), axis.first_key(), axis.count(), axis.shift};
    for (std::size_t k = 0; k < axis.cells.size(); ++k)
      for (std::uint32_t key = axis.cells[k].first; key < axis.cells[k].last; ++key)
        put(kernel::Guide{static_cast<float>(axis.cells[k].begin),
                          first + distance * static_cast<std::uint32_t>(k)});
    return written;
  }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// The same cells with places times a power of two, which moves their keys.
Axis shifted(const Axis& axis, int octaves) {
  Axis result = axis;
  const auto keys = static_cast<std::uint32_t>(octaves) << (23 - axis.shift);
  for (AxisCell& cell : result.cells)
    cell = {cell.first + keys, cell.last + keys, std::ldexp(cell.begin, octaves),
            std::ldexp(cell.end, octaves)};
  return result;
}

/// The halves one after the other.
Axis joined(const Axis& lower, const Axis& upper) {
  Axis axis = lower;
  axis.cells.back().last = upper.cells.front().first;  // a key that no place has, if any
  axis.cells.insert(axis.cells.end(), upper.cells.begin(), upper.cells.end());
  return axis;
}

/// The patches of one half of the columns, each column's rows together.
void put_patches(BlockWriter& block, const Surface& surface, const Columns& columns,
                 const Axis& cells, const Axis& rows, double row_offset, int octaves) {
  for (const AxisCell& column : cells.cells)
    for (const AxisCell& row : rows.cells) {
      std::array<Cubic, 4> along;
      for (std::size_t i = 0; i < 4; ++i) {
        const double at = row.begin + kRowPlaces[i] * row.width() - row_offset;
        along[i] = hermite(at_place(surface, columns, at, column.begin),
                           at_place(surface, columns, at, column.end), column.width());
      }
      std::array<Cubic, 4> patch;  // by the power of the place in the row
      for (std::size_t k = 0; k < 4; ++k) {
        const Cubic across =
            through({along[0][k], along[1][k], along[2][k], along[3][k]}, row.width());
        for (std::size_t power = 0; power < 4; ++power)
          patch[power][k] = std::ldexp(across[power], -octaves * static_cast<int>(k));
      }
      for (const Cubic& cubic : patch) block.put_cubic(cubic);
    }
}

/// A curve of the logarithm to base 2 over places from `begin` to `end` of one segment.
struct CurveSegment {
  double begin, end;
  Axis axis;
  double offset;
};

// Curves end here or where a light tail has fallen below what single precision holds.
constexpr double kFarthest = 0x1p60, kNothing = -150;

template <class F>
CurveSegment curve_segment(const F& log2, double begin, double end, double tolerance) {
  const auto node = [&](double x) {
    const double low = std::max(x * (1 - 1e-5), begin),
                 high = std::min(x * (1 + 1e-5) + 1e-12, end);
    return Node{std::max(log2(std::clamp(x, low, high)), -1e6),
                (log2(high) - log2(low)) / (high - low)};
  };
  const auto follows = [&](double offset, double from, double to) {
    const double a = begin + (from - offset), b = begin + (to - offset);
    const Node left = node(a), right = node(b);
    if (left.value < kNothing && right.value < kNothing) return true;
    const Cubic cubic = hermite(left, right, b - a);
    return std::ranges::all_of(kPlacesInColumn, [&](double f) {
      const double exact = log2(a + f * (b - a)), value = baking::at(cubic, f * (b - a));
      return std::abs(value - exact) <= tolerance * 1.44 || (exact < kNothing && value < kNothing);
    });
  };
  CurveSegment segment{begin, end, {}, 0};
  for (const auto& [offset, bits] :
       {std::pair{0x1p-4, 2}, {0x1p-6, 3}, {0x1p-12, 4}, {0x1p-24, 5}}) {
    segment.offset = offset;
    const double to = (end - begin) + offset;
    segment.axis = cells_between(
        offset, to, bits, [&, place = offset](double a, double b) { return follows(place, a, b); });
    if (!segment.axis.too_coarse) break;
  }
  return segment;
}

template <class F>
kernel::VndfCurve put_curve(BlockWriter& block, const LogCurve<double>& curve, double unit,
                            const F& log2, double tolerance) {
  std::vector<KernelSegment> segments;
  for (std::size_t k = 0; k < curve.segments().size(); ++k) {
    const auto& from = curve.segments()[k];
    const bool last = k + 1 == curve.segments().size();
    double begin = std::sinh(from.begin) / unit, end = std::sinh(from.end) / unit;
    if (last && curve.open()) end = kFarthest;
    begin = static_cast<float>(begin);
    end = static_cast<float>(end);
    const CurveSegment segment = curve_segment(log2, begin, end, tolerance);
    block.align(16);
    const std::uint32_t first = block.at();
    for (const AxisCell& cell : segment.axis.cells) {
      const auto node = [&](double place) {
        const double x = std::clamp(begin + (place - segment.offset), begin, end);
        const double low = std::max(x * (1 - 1e-5), begin),
                     high = std::min(x * (1 + 1e-5) + 1e-12, end);
        return Node{std::max(log2(std::clamp(x, low, high)), -1e6),
                    (log2(high) - log2(low)) / (high - low)};
      };
      const Node left = node(cell.begin), right = node(cell.end);
      if (!(cell.width() > 0) || (left.value < kNothing && right.value < kNothing))
        block.put_cubic({std::max(left.value, 2 * kNothing), 0, 0, 0});
      else
        block.put_cubic(hermite(left, right, cell.width()));
    }
    const KernelAxis axis = block.put_guide(segment.axis, first, 16);
    segments.push_back({static_cast<float>(begin), axis.guide - (axis.first_key << 3),
                        static_cast<float>(end), axis.shift, static_cast<float>(segment.offset),
                        axis.first_key, axis.count, 0});
  }
  block.align(16);
  const kernel::VndfCurve written{block.at(), static_cast<std::uint32_t>(segments.size())};
  for (const KernelSegment& segment : segments) block.put(segment);
  return written;
}

std::vector<std::byte> block_of(const Plan& plan, const SlopeTables& pair, double tolerance) {
  const PairSlopes& slopes = plan.slopes;
  BlockWriter block;
  KernelHeader h{};
  std::memcpy(h.magic, kKernelMagic, sizeof h.magic);
  h.version = kKernelVersion;
  h.header_bytes = sizeof h;
  h.unit = static_cast<float>(slopes.unit() * pair.mean_slope);
  h.scale_root = static_cast<float>(slopes.scale_root());
  h.scale_constant = static_cast<float>(slopes.scale_constant());
  h.rim = static_cast<float>(slopes.rim());
  h.least_root = kLeastRoot;
  h.most_root = kMostRoot;
  h.direction_offset = static_cast<float>(plan.direction_offset);
  h.slope_offset = static_cast<float>(plan.slope_offset);
  h.column_offset = static_cast<float>(plan.columns.offset);
  h.column_upper = kernel::kVndfSign + (static_cast<std::uint32_t>(plan.columns.octaves) << 23);
  h.column_roots = plan.columns.roots ? 1 : 0;
  h.separable = slopes.separable() ? 1 : 0;
  h.tolerance = tolerance;

  block.align(kKernelAlignment);
  const std::uint32_t patches = block.at();
  const int octaves = plan.columns.octaves;
  for (const bool upper : {false, true})
    put_patches(
        block, {[&](double g, double q) { return slopes.marginal(slopes.cotangent(g), q, upper); }},
        plan.columns, upper ? plan.marginal.upper : plan.marginal.lower, plan.marginal.rows,
        plan.direction_offset, upper ? octaves : 0);
  const auto row_bytes = static_cast<std::uint32_t>(64 * plan.marginal.rows.cells.size());
  const Axis columns = joined(plan.marginal.lower, shifted(plan.marginal.upper, octaves));
  h.marginal = block.put_guide(columns, patches, row_bytes);
  h.direction = block.put_guide(plan.marginal.rows, 0, 64);

  block.align(kKernelAlignment);
  const std::uint32_t conditional = block.at();
  const Surface surface{
      [&](double m, double q) { return slopes.conditional(PairSlopes::slope_at(m), q); }};
  if (slopes.separable()) {
    for (const AxisCell& cell : plan.conditional.lower.cells)
      block.put_cubic(hermite(at_place(surface, plan.columns, 0, cell.begin),
                              at_place(surface, plan.columns, 0, cell.end), cell.width()));
    h.conditional = block.put_guide(plan.conditional.lower, conditional, 16);
    h.slope = {h.conditional.guide, 0, 0, 0};
  } else {
    put_patches(block, surface, plan.columns, plan.conditional.lower, plan.conditional.rows,
                plan.slope_offset, 0);
    h.conditional =
        block.put_guide(plan.conditional.lower, conditional,
                        static_cast<std::uint32_t>(64 * plan.conditional.rows.cells.size()));
    h.slope = block.put_guide(plan.conditional.rows, 0, 64);
  }
  h.sampling_bytes = block.at() - patches;

  h.ndf = put_curve(
      block, pair.log_ndf, slopes.unit(), [&](double x) { return slopes.log2_ndf(x); }, tolerance);
  h.backfacing = put_curve(
      block, pair.log_backfacing, slopes.unit(),
      [&](double c) { return slopes.log2_backfacing(c); }, tolerance);
  h.text = block.at();
  const std::string texts = pair.distribution + std::string(5, '\0');
  for (const char c : texts) block.put(c);
  h.text_bytes = static_cast<std::uint32_t>(texts.size());
  h.bytes = block.bytes().size();
  std::memcpy(block.bytes().data(), &h, sizeof h);
  return block.bytes();
}

}  // namespace

KernelTables bake(const SlopeTables& pair, const BakeOptions& options) {
  if (!(options.tolerance >= 1e-6 && options.tolerance <= 1e-2))
    throw std::invalid_argument("tolerance of a kernel: give a number from 1e-6 to 1e-2");
  std::vector<double> units;
  const bool separable = pair.conditional.rows() == 1;
  if (separable && !std::isfinite(pair.support) && pair.conditional_quadratic > 0)
    units = {std::sqrt(pair.conditional_constant / pair.conditional_quadratic)};
  else
    units = {1, 2, 4, 8};
  const Judge judge{options.tolerance / 2};
  std::optional<Plan> best;
  for (const Columns& columns : {kByProbability, kByRoot}) {
    for (const double unit : units) {
      Plan plan = plan_of(pair, unit, columns, judge);
      if (!best || plan.bytes() < best->bytes()) best.emplace(std::move(plan));
    }
    if (best->bytes() <= options.max_bytes) break;
  }
  auto bytes = block_of(*best, pair, options.tolerance);
  auto* h = reinterpret_cast<KernelHeader*>(bytes.data());
  h->checksum = kernel_checksum(bytes);
  return KernelTables::copy(bytes);
}

}  // namespace vndf
