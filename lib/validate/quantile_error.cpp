// Stage: the map from random numbers to normals, without random numbers.
#include "validate/quantile_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "precompute/map_errors.h"
#include "precompute/visible_slopes.h"
#include "validate/conditional_law.h"
#include "validate/density_distance.h"

namespace vndf::validate {
namespace {

using precompute::from_tail;
using precompute::golden;
using precompute::u_error;
using precompute::VisibleSlopes;

constexpr const char* kStage = "map";
constexpr int kTailPlaces = 60;        // per tail, logarithmic
constexpr double kSmallestU = 1e-9;    // towards 0; towards 1 single precision ends at 2^-24
constexpr double kTailMass = 0x1p-20;  // of the tails whose ratio is judged
constexpr int kHalvings = 24;

/// Single-precision numbers in (0, 1), increasing.
std::vector<double> places(std::size_t count) {
  std::vector<double> list;
  for (std::size_t k = 0; k < count; ++k) list.push_back(to_single(golden(k)));
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

/// Errors of one slope, apart for the tails: there published samplers end.
struct SlopeErrors {
  Worst body, tails;

  void see(double error, double u, const Place& place) {
    (u < kTailMass || u > 1 - kTailMass ? tails : body).see(error, place);
  }
  void see(const SlopeErrors& other) {
    body.see(other.body);
    tails.see(other.tails);
  }
};

/// The laws of slope y at a slope x, where both have been rounded: near the rim of a compact
/// distribution they change within the rounding. What lies between is no error.
class RoundedConditional {
 public:
  static bool judged(const precompute::UnitSlopes& slopes, double x) {
    return ConditionalLaw::judged(slopes, x * (1 + kSlopeRounding));
  }
  RoundedConditional(const precompute::UnitSlopes& slopes, double x)
      : laws_{ConditionalLaw(slopes, x), ConditionalLaw(slopes, x * (1 - kSlopeRounding)),
              ConditionalLaw(slopes, x * (1 + kSlopeRounding))} {}

  /// |P(Y <= y) - u|.
  double error(double y, double u) const {
    return least(y, [u](const Probability<double>& cdf) { return u_error(cdf, from_tail(u)); });
  }
  /// |mass of the tail beyond y / `mass` - 1|, y on the side of `u`.
  double ratio_error(double y, double u, double mass) const {
    return least(y, [u, mass](const Probability<double>& cdf) {
      return (u < 0.5 ? cdf.u : cdf.complement) / mass - 1;
    });
  }

 private:
  /// Distance from 0 of the interval of errors that the CDFs at `y` give.
  template <class F>
  double least(double y, F error_of) const {
    double low = error_of(laws_[0].cdf(y)), high = low;
    for (const ConditionalLaw& law : laws_)
      for (const double s : {1 - kSlopeRounding, 1 + kSlopeRounding}) {
        const double e = error_of(law.cdf(y * s));
        if (std::isnan(e)) return kUnknown;
        low = std::min(low, e);
        high = std::max(high, e);
      }
    return std::max({0.0, low, -high});
  }

  std::array<ConditionalLaw, 3> laws_;
};

struct MapErrors {
  SlopeErrors x, y;
  Worst ratio_x, ratio_y, backward, jump;
};

/// One row of the map: all u1 at one incidence.
class Row {
 public:
  Row(const Subject& subject, const Configuration& configuration)
      : subject_(subject),
        configuration_(configuration),
        frame_(*subject.law, configuration),
        visible_(subject.law->slopes(), frame_.cotangent()) {}

  MapErrors judge(const QuantileOptions& options) {
    const auto list = places(options.places);
    for (const double u2 : {0.5, 0.1875, 0.875}) judge_marginal(list, u2);
    judge_marginal_tails();
    for (std::size_t k = 0; k < options.slopes; ++k) {
      // The first two are in the tails.
      const double u1 = k == 0 ? 1e-4 : k == 1 ? 0.9999 : golden(k);
      judge_conditional(to_single(u1), list);
    }
    return errors_;
  }

 private:
  StretchedSlope slope(double u1, double u2) const {
    return frame_.slope_of(subject_.sample_one(configuration_, u1, u2));
  }
  /// What is lower than kSmallestHeight lies somewhere beyond: there the map cannot be seen.
  static bool carried(const StretchedSlope& s) { return s.w >= kSmallestHeight; }

  double marginal_error(const StretchedSlope& s, double u1) const {
    const double a = s.x == 0 ? 0 : std::asinh(s.x / s.w);
    return u_error(visible_.cdf(std::min(a, visible_.farthest())), from_tail(u1));
  }
  Probability<double> marginal_cdf(double u1, double u2) const {
    const StretchedSlope s = slope(u1, u2);
    const double a = s.x == 0 ? 0 : std::asinh(s.x / std::max(s.w, kSmallestHeight));
    return visible_.cdf(std::min(a, visible_.farthest()));
  }

  void judge_marginal(const std::vector<double>& list, double u2) {
    double previous_error = 0, previous_u = 0, worst_change = 0, from = 0, to = 0;
    for (const double u1 : list) {
      const StretchedSlope s = slope(u1, u2);
      const Place place = place_of(configuration_, u1, u2);
      if (!carried(s)) continue;
      const double error = marginal_error(s, u1);
      errors_.x.see(std::abs(error), u1, place);
      const double change = error - previous_error;
      errors_.backward.see(-(change + (u1 - previous_u)), place);
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

  /// Halves the interval in which the CDF gains most on u until its ends are neighbours: a
  /// continuous map has gained nothing there.
  void follow_jump(double from, double to, double u2) {
    const auto gain = [&](double low, double high) {
      return u_error(marginal_cdf(high, u2), from_tail(high)) -
             u_error(marginal_cdf(low, u2), from_tail(low));
    };
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = to_single((from + to) / 2);
      if (middle == from || middle == to) break;
      (gain(from, middle) > gain(middle, to) ? to : from) = middle;
    }
    errors_.jump.see(gain(from, to), place_of(configuration_, from, u2));
  }

  void judge_marginal_tails() {
    constexpr double mass = kTailMass;
    const StretchedSlope low = slope(mass, 0.5), high = slope(1 - mass, 0.5);
    if (carried(low)) {
      const double u = marginal_error(low, mass) + mass;
      errors_.ratio_x.see(std::abs(u / mass - 1), place_of(configuration_, mass));
    }
    const double complement = mass - marginal_error(high, 1 - mass);
    errors_.ratio_x.see(std::abs(complement / mass - 1), place_of(configuration_, 1 - mass));
  }

  void judge_conditional(double u1, const std::vector<double>& list) {
    const auto& slopes = subject_.law->slopes();
    const StretchedSlope middle = slope(u1, 0.5);
    const double x = middle.x / middle.w;
    if (!carried(middle) || !RoundedConditional::judged(slopes, x)) return;
    const RoundedConditional conditional(slopes, x);
    for (const double u2 : list) {
      const StretchedSlope s = slope(u1, u2);
      if (!carried(s)) continue;
      errors_.y.see(conditional.error(s.y / s.w, u2), u2, place_of(configuration_, u1, u2));
    }
    judge_conditional_tails(conditional, u1);
  }

  void judge_conditional_tails(const RoundedConditional& conditional, double u1) {
    for (const double u2 : {kTailMass, 1 - kTailMass}) {
      const StretchedSlope s = slope(u1, u2);
      if (!carried(s)) continue;
      errors_.ratio_y.see(conditional.ratio_error(s.y / s.w, u2, kTailMass),
                          place_of(configuration_, u1, u2));
    }
  }

  const Subject& subject_;
  Configuration configuration_;
  StretchedFrame frame_;
  VisibleSlopes visible_;
  MapErrors errors_;
};

}  // namespace

std::vector<Configuration> map_configurations() {
  std::vector<Configuration> list;
  for (const double theta :
       {0.0,  1e-7, 1e-4, 1e-2, 0.05,  0.1,   0.2,    0.25,    0.3,       0.7,  2.0,  5.0,
        10.0, 17.0, 25.0, 34.0, 45.0,  52.0,  60.0,   68.0,    75.0,      80.0, 84.0, 87.0,
        88.5, 89.2, 89.7, 89.9, 89.97, 89.99, 89.999, 89.9999, 90 - 1e-7, 90.0})
    list.push_back(at_angles(theta, 0, 1, 1));
  for (const double theta : {20.0, 55.0, 82.0, 89.5}) {
    list.push_back(at_angles(theta, 90, 0.3, 0.9));
    list.push_back(at_angles(theta, 0, 0.002, 2));
    list.push_back(at_angles(theta, 33, 0.05, 0.4));
  }
  return list;
}

std::vector<Finding> measure_quantile_error(const Subject& subject,
                                            const QuantileOptions& options) {
  auto list = map_configurations();
  std::erase_if(list, [&](const Configuration& c) { return !subject.claims.map_at(c); });
  std::vector<MapErrors> rows((list.size() + options.stride - 1) / options.stride);
  precompute::parallel_for(rows.size(), options.workers, [&](std::size_t i) {
    rows[i] = Row(subject, list[i * options.stride]).judge(options);
  });
  MapErrors all;
  for (const MapErrors& row : rows) {
    all.x.see(row.x);
    all.y.see(row.y);
    all.ratio_x.see(row.ratio_x);
    all.ratio_y.see(row.ratio_y);
    all.backward.see(row.backward);
    all.jump.see(row.jump);
  }
  const Bounds& bounds = subject.bounds;
  return {all.x.body.finding(kStage, "u-error of slope x", bounds.u_error),
          all.x.tails.finding(kStage, "u-error of slope x, tails", bounds.u_error),
          all.y.body.finding(kStage, "u-error of slope y", bounds.u_error),
          all.y.tails.finding(kStage, "u-error of slope y, tails", bounds.u_error),
          all.ratio_x.finding(kStage, "tail mass / 2^-20 - 1, slope x", bounds.tail_error),
          all.ratio_y.finding(kStage, "tail mass / 2^-20 - 1, slope y", bounds.tail_error),
          all.backward.finding(kStage, "steps back (monotone)", kStep),
          all.jump.finding(kStage, "jumps (continuous)", kStep)};
}

}  // namespace vndf::validate
