// Measures the interpolation error of a table in many intervals and gives each its share of rows.
#include "vndf/precompute/place_rows.h"

#include <algorithm>
#include <cmath>

namespace vndf::precompute {
namespace {

// These constants were tuned by hand. Each was then halved and doubled for 256 x 256 tables of ggx,
// student-t 1.6, exponential-power 0.5, a ring of inner radius 0.5 and a mixture of ggx and
// beckmann at 1:100. What happened to the largest u-errors stands beside it; "no change" is below 5
// %.

// Intervals at which errors are looked at. Half as many: a conditional of the mixture with 1.8
// times the error, otherwise 0.8 to 1.1 times. Twice as many: 0.8 to 1.2 times, for twice the time.
constexpr std::size_t kIntervals = 200;
// Columns at which they are looked at. Half as many: up to 1.7 times the error (mixture, slope y).
// Twice as many: 0.95 to 1.2 times.
constexpr std::size_t kColumns = 64;
// Halvings of an interval towards a break, on either side. 12: 8 times the error of the ring in
// slope y, whose quantile is a square root there. 48: no change but 0.94 times for the ring.
constexpr int kHalvings = 24;
// Halvings towards the end, where little mass is left and rounding counts more than interpolation.
// 5 or 20: no change but 1.08 times for exponential-power at 20.
constexpr int kHalvingsAtEnd = 10;
// The widest of these intervals. Half or twice: 1.0 to 1.3 times the error, least for this one.
constexpr double kWidestAtBreak = 1.0 / 64;
// Errors in tails are weighed by the cube root of their probability, down to this one. Half or
// twice: no change but 1.09 times for the ring at twice.
constexpr double kTail = 1e-6;
// An interval that errs by less, as single precision does, needs no rows of its own. Half or twice:
// 0.88 to 1.09 times the error.
constexpr double kNoise = 1e-7;
// The share of rows that are equidistant in any case, so that no interval that was measured too
// well goes without. Half: 0.8 to 1.2 times the error. Twice: up to 3.2 times (ring, slope y).
constexpr double kEquidistantShare = 0.25;
// The gain below which rows stay equidistant, which are faster to find, is 3, or 1.3 if the error
// of equidistant rows were above 3e-6. Half or twice kWorthwhile: no change. Twice kEnough or twice
// kSmallError: the rows of ggx become equidistant and its error 0.73 times, because the gain that
// is predicted for it is not reached at 256 rows. Half: no change.
constexpr double kWorthwhile = 3;
constexpr double kEnough = 1.3;
constexpr double kSmallError = 3e-6;
// Rows between two knots, at least. 1: up to 1.75 times the error, as shares are rounded to rows.
// 4: about 0.75 times in smooth tables, but 2.2 times for the ring in slope y.
constexpr double kRowsPerKnot = 2;

struct Interval {
  double low, high, error;
};

std::vector<double> interval_ends(const RowSource& source) {
  std::vector<double> ends;
  for (std::size_t k = 0; k <= kIntervals; ++k)
    ends.push_back(source.end * static_cast<double>(k) / kIntervals);
  // A compact distribution ends at `end` like at a break.
  std::vector<double> breaks = source.breaks;
  if (source.end < 1) breaks.push_back(source.end);
  breaks.push_back(0);
  for (const double b : breaks)
    for (int k = 0; k <= (b == source.end ? kHalvingsAtEnd : kHalvings); ++k)
      for (const double side : {-1.0, 1.0}) {
        const double place = b + side * std::ldexp(kWidestAtBreak, -k);
        if (place > 0 && place < source.end) ends.push_back(place);
      }
  ends.insert(ends.end(), source.breaks.begin(), source.breaks.end());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

/// Returns the error in u of the middle row if it is taken as the mean of its neighbours. In the
/// tails a smaller error counts as much: at 1e-6 a hundredth, which is 5 % of the tail where the
/// bulk errs by 5e-6.
double middle_error(const std::vector<double>& low, const std::vector<double>& middle,
                    const std::vector<double>& high, const std::vector<Probability<double>>& u) {
  if (low.empty() || middle.empty() || high.empty()) return 0;
  double worst = 0;
  for (std::size_t j = 1; j + 1 < u.size(); ++j) {
    const double rise = middle[j + 1] - middle[j - 1];
    if (!(rise > 0)) continue;
    const double off = std::abs(middle[j] - (low[j] + high[j]) / 2);
    const double error = off * (u[j + 1].u - u[j - 1].u) / rise;
    worst = std::max(worst, error / std::cbrt(std::max(kTail, std::min(u[j].u, u[j].complement))));
  }
  return std::max(0.0, worst - kNoise);
}

std::vector<Interval> measure(const RowSource& source, const support::Workers& workers) {
  std::vector<Probability<double>> u;
  for (std::size_t j = 0; j < kColumns; ++j)
    u.push_back(source.column_inverse(static_cast<double>(j) / (kColumns - 1)));
  const auto ends = interval_ends(source);
  const std::size_t count = ends.size() - 1;
  std::vector<std::vector<double>> rows(2 * count + 1);
  const auto base = [&](std::size_t k) {
    return k % 2 == 0 ? ends[k / 2] : (ends[k / 2] + ends[k / 2 + 1]) / 2;
  };
  support::parallel_for(rows.size(), workers,
                        [&](std::size_t k) { rows[k] = source.row(base(k), u); });
  std::vector<Interval> intervals;
  for (std::size_t i = 0; i < count; ++i)
    intervals.push_back(
        {ends[i], ends[i + 1], middle_error(rows[2 * i], rows[2 * i + 1], rows[2 * i + 2], u)});
  return intervals;
}

/// Raises each error to what the curvature of the neighbours makes of the width of the interval,
/// because an error may vanish at the middle by chance, where a curvature changes sign.
std::vector<Interval> smoothed(const std::vector<Interval>& intervals) {
  std::vector<Interval> raised = intervals;
  const auto width = [&](std::size_t i) { return intervals[i].high - intervals[i].low; };
  for (std::size_t i = 0; i < intervals.size(); ++i)
    for (std::size_t j = i < 2 ? 0 : i - 2; j < std::min(i + 3, intervals.size()); ++j) {
      const double ratio = width(i) / width(j);
      raised[i].error =
          std::max(raised[i].error, intervals[j].error * std::min(1.0, ratio * ratio));
    }
  return raised;
}

/// Returns the largest error if each interval gets its share of the rows.
template <class Share>
double largest_error(const std::vector<Interval>& intervals, Share share) {
  double largest = 0;
  for (const Interval& i : intervals) largest = std::max(largest, i.error / (share(i) * share(i)));
  return largest;
}

bool is_break(const RowSource& source, double base) {
  return std::find(source.breaks.begin(), source.breaks.end(), base) != source.breaks.end();
}

std::vector<RowKnot> equidistant_rows(double end) {
  if (end == 1) return {};
  return {{0, 0}, {end, 1}};
}

}  // namespace

std::vector<RowKnot> place_rows(const RowSource& source, std::size_t rows,
                                const support::Workers& workers) {
  const auto intervals = smoothed(measure(source, {workers.threads}));
  double total = 0;
  for (const Interval& i : intervals) total += std::sqrt(i.error);
  const auto equidistant = [&](const Interval& i) { return (i.high - i.low) / source.end; };
  const auto adapted = [&](const Interval& i) {
    const double wanted = total > 0 ? std::sqrt(i.error) / total : equidistant(i);
    return kEquidistantShare * equidistant(i) + (1 - kEquidistantShare) * wanted;
  };
  const double equidistant_error = largest_error(intervals, equidistant);
  const double gain = equidistant_error / largest_error(intervals, adapted);
  const double per_row = static_cast<double>(rows) * static_cast<double>(rows);
  const bool worthwhile =
      gain > (equidistant_error > kSmallError * per_row ? kEnough : kWorthwhile);
  if (!worthwhile && source.breaks.empty()) return equidistant_rows(source.end);

  // The axis has a kink at a knot, which a cell must not straddle, so knots lie on rows. Shares are
  // rounded to rows, so intervals of less than two rows are joined, but not across a break of the
  // table. Where nothing is gained by crowding, rows are equidistant between the breaks.
  std::vector<RowKnot> knots{{0, 0}};
  const double last = static_cast<double>(rows - 1);
  double share = 0, row = 0;
  for (const Interval& i : intervals) {
    share += worthwhile ? adapted(i) : equidistant(i);
    const bool at_break = is_break(source, i.high);
    const double rounded = std::min(std::round(share * last), last - 1);
    if (!at_break && (!worthwhile || rounded < row + kRowsPerKnot)) continue;
    row = std::max(rounded, row + 1);
    knots.push_back({i.high, row / last});
  }
  while (knots.back().row >= 1 || knots.back().base >= source.end) knots.pop_back();
  knots.push_back({source.end, 1});
  return knots;
}

}  // namespace vndf::precompute
