// Chooses where the rows of a table lie.
#include "vndf/precompute/place_rows.h"

#include <algorithm>
#include <cmath>

namespace vndf::precompute {
namespace {

constexpr std::size_t kIntervals = 200;
constexpr std::size_t kColumns = 64;
constexpr int kHalvings = 24;       // of the intervals towards a break, on either side
constexpr int kHalvingsAtEnd = 10;  // where little mass is left, and rounding errs more
constexpr double kWidestAtBreak = 1.0 / 64;
constexpr double kTail = 1e-6;
constexpr double kNoise = 1e-7;      // an interval that errs by less needs no rows of its own
constexpr double kEvenShare = 0.25;  // of the rows that are equidistant in any case
constexpr double kWorthwhile = 3;    // gain below which rows stay equidistant ...
constexpr double kEnough = 1.3;      // ... or this, where their error would exceed
constexpr double kSmallError = 3e-6;
constexpr double kRowsPerKnot = 2;  // at least

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

/// Error in u of the middle row, taken as the mean of its neighbours. In the tails a smaller error
/// counts as much: at 1e-6, a hundredth, which is 5 % of the tail where the bulk errs by 5e-6.
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

/// The error of an interval may vanish at its middle by chance, where a curvature changes sign:
/// each is raised to what the curvature of its neighbours makes of its width.
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

/// Largest error when each interval gets its share of the rows.
template <class Share>
double largest_error(const std::vector<Interval>& intervals, Share share) {
  double largest = 0;
  for (const Interval& i : intervals) largest = std::max(largest, i.error / (share(i) * share(i)));
  return largest;
}

bool is_break(const RowSource& source, double base) {
  return std::find(source.breaks.begin(), source.breaks.end(), base) != source.breaks.end();
}

std::vector<RowKnot> evenly(double end) {
  if (end == 1) return {};
  return {{0, 0}, {end, 1}};
}

}  // namespace

std::vector<RowKnot> place_rows(const RowSource& source, std::size_t rows,
                                const support::Workers& workers) {
  const auto intervals = smoothed(measure(source, {workers.threads}));
  double total = 0;
  for (const Interval& i : intervals) total += std::sqrt(i.error);
  const auto even = [&](const Interval& i) { return (i.high - i.low) / source.end; };
  const auto adapted = [&](const Interval& i) {
    const double wanted = total > 0 ? std::sqrt(i.error) / total : even(i);
    return kEvenShare * even(i) + (1 - kEvenShare) * wanted;
  };
  const double even_error = largest_error(intervals, even);
  const double gain = even_error / largest_error(intervals, adapted);
  const double per_row = static_cast<double>(rows) * static_cast<double>(rows);
  const bool worthwhile = gain > (even_error > kSmallError * per_row ? kEnough : kWorthwhile);
  if (!worthwhile && source.breaks.empty()) return evenly(source.end);

  // Knots belong on rows: the axis has a kink there, which a cell must not straddle. Intervals of
  // less than two rows are joined, for shares are rounded to rows, but not across a break of the
  // table. Where nothing is gained by crowding, rows are equidistant between the breaks.
  std::vector<RowKnot> knots{{0, 0}};
  const double last = static_cast<double>(rows - 1);
  double share = 0, row = 0;
  for (const Interval& i : intervals) {
    share += worthwhile ? adapted(i) : even(i);
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
