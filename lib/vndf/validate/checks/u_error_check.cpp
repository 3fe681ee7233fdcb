// U-error check: the map from random numbers to normals.
#include "vndf/validate/checks/u_error_check.h"

#include <algorithm>
#include <cmath>

#include "vndf/precompute/map_errors.h"
#include "vndf/support/low_discrepancy.h"
#include "vndf/validate/checks/configurations.h"
#include "vndf/validate/checks/map_row.h"
#include "vndf/validate/checks/worst_over.h"

namespace vndf::validate {
namespace {

using precompute::from_tail;
using precompute::u_error;

constexpr const char* kCheck = "inverse";
constexpr int kTailPlaces = 60;        // per tail, logarithmic
constexpr double kSmallestU = 1e-9;    // towards 0; towards 1 single precision ends at 2^-24
constexpr double kTailMass = 0x1p-20;  // of the tails whose ratio is checked
constexpr int kHalvings = 24;

/// Single-precision numbers in (0, 1), in increasing order.
std::vector<double> places(std::size_t count) {
  std::vector<double> list;
  for (std::size_t k = 0; k < count; ++k) list.push_back(to_single(support::golden(k)));
  for (int k = 0; k <= kTailPlaces; ++k) {
    const double e = kSmallestU * std::pow(0.1 / kSmallestU, static_cast<double>(k) / kTailPlaces);
    list.push_back(to_single(e));
    list.push_back(to_single(1 - e));
  }
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  if (list.back() == 1) list.pop_back();
  return list;
}

/// Errors of one slope, apart for the tails, where published samplers end.
struct SlopeErrors {
  Worst body, tails;

  void see(double error, double u, const Place& place) {
    (u < kTailMass || u > 1 - kTailMass ? tails : body).see(error, place);
  }
  void see(const SlopeErrors& o) { see_each(std::tie(body, tails), std::tie(o.body, o.tails)); }
};

struct MapErrors {
  SlopeErrors x, y;
  Worst ratio_x, ratio_y, backward, jump;

  void see(const MapErrors& o) {
    see_each(std::tie(x, y, ratio_x, ratio_y, backward, jump),
             std::tie(o.x, o.y, o.ratio_x, o.ratio_y, o.backward, o.jump));
  }
};

/// Measures one row of the map: all u1 at one incidence.
class Row {
 public:
  Row(const SamplerUnderTest& sampler, const Configuration& configuration)
      : map_(sampler, configuration) {}

  MapErrors measure(const UErrorOptions& options) {
    const auto list = places(options.places);
    for (const double u2 : {0.5, 0.1875, 0.875}) measure_marginal(list, u2);
    measure_marginal_tails();
    for (std::size_t k = 0; k < options.slopes; ++k) {
      // The first two are in the tails.
      const double u1 = k == 0 ? 1e-4 : k == 1 ? 0.9999 : support::golden(k);
      measure_conditional(to_single(u1), list);
    }
    return errors_;
  }

 private:
  StretchedSlope slope(double u1, double u2) const { return map_.slope(u1, u2); }
  Place place(double u1, double u2 = kUnknown) const {
    return place_of(map_.configuration(), u1, u2);
  }
  double marginal_error(const StretchedSlope& s, double u1) const {
    return u_error(map_.marginal_cdf(s), from_tail(u1));
  }

  void measure_marginal(const std::vector<double>& list, double u2) {
    double previous_error = 0, previous_u = 0, worst_change = 0, from = 0, to = 0;
    for (const double u1 : list) {
      const StretchedSlope s = slope(u1, u2);
      if (!MapRow::carried(s)) continue;
      const double error = marginal_error(s, u1);
      errors_.x.see(std::abs(error), u1, place(u1, u2));
      const double change = error - previous_error;
      errors_.backward.see(-(change + (u1 - previous_u)), place(u1, u2));
      if (change > worst_change && previous_u > 0) {
        worst_change = change;
        from = previous_u;
        to = u1;
      }
      previous_error = error;
      previous_u = u1;
    }
    if (worst_change > 0) follow_jump(from, to, u2);
  }

  /// Halves the interval in which the CDF gains most on u until its ends are neighbours. A
  /// continuous map has gained nothing there.
  void follow_jump(double from, double to, double u2) {
    const auto gain = [&](double low, double high) {
      return marginal_error(slope(high, u2), high) - marginal_error(slope(low, u2), low);
    };
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = to_single((from + to) / 2);
      if (middle == from || middle == to) break;
      (gain(from, middle) > gain(middle, to) ? to : from) = middle;
    }
    errors_.jump.see(gain(from, to), place(from, u2));
  }

  void measure_marginal_tails() {
    constexpr double mass = kTailMass;
    const StretchedSlope low = slope(mass, 0.5), high = slope(1 - mass, 0.5);
    if (MapRow::carried(low)) {
      const double u = marginal_error(low, mass) + mass;
      errors_.ratio_x.see(std::abs(u / mass - 1), place(mass));
    }
    const double complement = mass - marginal_error(high, 1 - mass);
    errors_.ratio_x.see(std::abs(complement / mass - 1), place(1 - mass));
  }

  void measure_conditional(double u1, const std::vector<double>& list) {
    const auto conditional = map_.conditional(u1);
    if (!conditional) return;
    for (const double u2 : list) {
      const StretchedSlope s = slope(u1, u2);
      if (!MapRow::carried(s)) continue;
      errors_.y.see(conditional->error(s.y / s.w, u2), u2, place(u1, u2));
    }
    measure_conditional_tails(*conditional, u1);
  }

  void measure_conditional_tails(const RoundedConditional& conditional, double u1) {
    for (const double u2 : {kTailMass, 1 - kTailMass}) {
      const StretchedSlope s = slope(u1, u2);
      if (!MapRow::carried(s)) continue;
      errors_.ratio_y.see(conditional.ratio_error(s.y / s.w, u2, kTailMass), place(u1, u2));
    }
  }

  MapRow map_;
  MapErrors errors_;
};

}  // namespace

std::vector<CheckResult> check_u_error(const SamplerUnderTest& sampler,
                                       const UErrorOptions& options) {
  const auto list = inverse_configurations(sampler);
  std::vector<Configuration> chosen;
  for (std::size_t i = 0; i < list.size(); i += options.stride) chosen.push_back(list[i]);
  return on_both_sides(sampler, chosen, [&](const Side& side) {
    const MapErrors all = worst_over(side.list, options.workers, [&](const Configuration& c) {
      return Row(sampler, c).measure(options);
    });
    const Bounds& bounds = side.bounds;
    const double step = kStep + side.rounding;
    return std::vector{
        all.x.body.result(kCheck, "u-error of slope x", bounds.u_error),
        all.x.tails.result(kCheck, "u-error of slope x, tails", bounds.u_error),
        all.y.body.result(kCheck, "u-error of slope y", bounds.u_error),
        all.y.tails.result(kCheck, "u-error of slope y, tails", bounds.u_error),
        all.ratio_x.result(kCheck, "tail mass / 2^-20 - 1, slope x", bounds.tail_error),
        all.ratio_y.result(kCheck, "tail mass / 2^-20 - 1, slope y", bounds.tail_error),
        all.backward.result(kCheck, "steps back (monotone)", step),
        all.jump.result(kCheck, "jumps (continuous)", step)};
  });
}

}  // namespace vndf::validate
