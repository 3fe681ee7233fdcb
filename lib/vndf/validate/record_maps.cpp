// Whether the map behind records is the monotone inverse of the CDFs.
#include "vndf/validate/record_maps.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "vndf/precompute/marginal_distribution.h"
#include "vndf/support/text.h"
#include "vndf/validate/exact/exact_conditional.h"
#include "vndf/validate/exact/place_text.h"
#include "vndf/validate/record_groups.h"
#include "vndf/validate/statistics/density_distance.h"
#include "vndf/validate/statistics/rank_correlation.h"

namespace vndf::validate {
namespace {

constexpr const char* kCheck = "inverse";
constexpr std::size_t kMostBands = 32;
constexpr std::size_t kMostAlone = 256;      // configurations that are judged by themselves
constexpr std::size_t kConditionals = 4000;  // records whose slope y is checked, 0.1 ms each
constexpr std::size_t kChunk = 256;          // of records that one thread judges
constexpr std::size_t kMostNamed = 3;        // configurations that a line names

/// A random number of a record, from which end it counts.
struct Source {
  bool second = false;     // u2 and not u1
  bool decreases = false;  // the slope decreases with it

  double of(const Record& r) const {
    const double u = second ? r.u2 : r.u1;
    return decreases ? 1 - u : u;
  }
  std::string text() const {
    return std::string(decreases ? "decreases" : "increases") + " with " + (second ? "u2" : "u1");
  }
};

/// What is known of the slope y of one record.
struct SlopeY {
  std::size_t record;
  double cdf = kUnknown;  // unknown where ExactConditional leaves it out
};

/// Records of one configuration, or a band of many.
struct Group {
  Indices records = {};
  bool band = false;
  std::vector<SlopeY> some = {};  // spread over the records
  Source x = {}, y = {};
  double correlation_x = 0, correlation_y = 0;
  bool correlates = false, judged = false;
};

/// The distance of `u` from the interval [low, high].
double distance_from(double u, double low, double high) {
  return std::max({0.0, low - u, u - high});
}

class RecordMaps {
 public:
  RecordMaps(const Records& records, const ExactSlopes& exact, std::span<const Uniforms> uniforms,
             const RecordMapOptions& options)
      : records_(records), exact_(exact), uniforms_(uniforms), options_(options) {}

  RecordMapResults run() {
    make_groups();
    choose_some();
    support::parallel_for(groups_.size(), options_.workers,
                          [&](std::size_t g) { recognise(groups_[g]); });
    decide();
    RecordMapResults all;
    if (std::any_of(groups_.begin(), groups_.end(), [](const Group& g) { return g.judged; }))
      all.results = {judge_x(), judge_y()};
    all.skipped = skipped();
    return all;
  }

 private:
  const Record& record(std::size_t i) const { return records_.list[i]; }

  void make_groups() {
    auto alone = records_by_configuration(records_);
    const auto large = std::partition(alone.begin(), alone.end(), [](const Indices& indices) {
      return indices.size() >= kFewestForMap;
    });
    const bool few = large - alone.begin() <= static_cast<std::ptrdiff_t>(kMostAlone);
    Indices rest;
    for (auto g = alone.begin(); g != alone.end(); ++g) {
      if (g < large && few)
        groups_.push_back({.records = std::move(*g)});
      else
        rest.insert(rest.end(), g->begin(), g->end());
    }
    std::sort(groups_.begin(), groups_.end(),
              [](const Group& a, const Group& b) { return a.records.front() < b.records.front(); });
    make_bands(rest);
  }

  void make_bands(const Indices& rest) {
    std::vector<std::pair<double, std::size_t>> order;
    for (const std::size_t i : rest)
      order.emplace_back(StretchedFrame(exact_, record(i).configuration).cotangent().slope(), i);
    std::sort(order.begin(), order.end());
    std::size_t bands = std::min(kMostBands, rest.size() / kFewestForMap);
    if (bands == 0 && options_.monotone_inverse && !rest.empty()) bands = 1;
    if (bands == 0) too_few_ = rest;
    for (std::size_t b = 0; b < bands; ++b) {
      Group group{.band = true};
      const std::size_t end = (b + 1) * order.size() / bands;
      for (std::size_t k = b * order.size() / bands; k < end; ++k)
        group.records.push_back(order[k].second);
      groups_.push_back(std::move(group));
    }
  }

  /// Chooses the records of each group whose slope y is looked at.
  void choose_some() {
    if (groups_.empty()) return;
    const std::size_t share = std::max(kFewestForMap, kConditionals / groups_.size());
    for (Group& group : groups_) {
      const std::size_t n = group.records.size(), count = std::min(share, n);
      for (std::size_t k = 0; k < count; ++k) group.some.push_back({group.records[k * n / count]});
    }
  }

  /// Finds the random number with which each slope goes. Conditionals take time, so slope y is left
  /// alone where slope x follows neither number.
  void recognise(Group& group) const {
    std::vector<double> u1, u2, x;
    for (const std::size_t i : group.records) {
      u1.push_back(record(i).u1);
      u2.push_back(record(i).u2);
      x.push_back(uniforms_[i].x);
    }
    const double with_u1 = rank_correlation(u1, x), with_u2 = rank_correlation(u2, x);
    group.x.second = std::abs(with_u2) > std::abs(with_u1);
    group.y.second = !group.x.second;
    group.correlation_x = group.x.second ? with_u2 : with_u1;
    group.x.decreases = group.correlation_x < 0;
    if (!options_.monotone_inverse && std::abs(group.correlation_x) < kMapCorrelation) return;
    recognise_y(group);
    group.correlates = std::abs(group.correlation_y) >= kMapCorrelation;
  }

  void recognise_y(Group& group) const {
    std::vector<double> u, y;
    for (SlopeY& s : group.some) {
      s.cdf = conditional_cdf(record(s.record));
      if (std::isnan(s.cdf)) continue;
      u.push_back(group.y.of(record(s.record)));
      y.push_back(s.cdf);
    }
    group.correlation_y = rank_correlation(u, y);
    group.y.decreases = group.correlation_y < 0;
  }

  /// P(Y <= y | x), unknown where it is not checked.
  double conditional_cdf(const Record& r) const {
    const StretchedSlope s = StretchedFrame(exact_, r.configuration).slope_of(r.wm);
    if (!(r.wm.z >= kSmallestHeight) ||
        !ExactConditional::is_checked(exact_.unit_slopes(), s.x / s.w))
      return kUnknown;
    return ExactConditional(exact_.unit_slopes(), s.x / s.w).cdf(s.y / s.w).u;
  }

  void decide() {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const auto inverse_or_none = [&](std::size_t other) {
        return !groups_[other].band || groups_[other].correlates;
      };
      const bool inside = !groups_[g].band || ((g == 0 || inverse_or_none(g - 1)) &&
                                               (g + 1 == groups_.size() || inverse_or_none(g + 1)));
      groups_[g].judged = options_.monotone_inverse || (groups_[g].correlates && inside);
    }
  }

  /// The distance of `u` from the values that the CDF of slope x takes within the rounding of the
  /// normal. Rotations mix the two components of a slope, so each is rounded as the length is.
  double error_x(const Record& r, double u) const {
    const StretchedFrame frame(exact_, r.configuration);
    const precompute::MarginalDistribution visible(exact_.unit_slopes(), frame.cotangent());
    const StretchedSlope s = frame.slope_of(r.wm);
    const double x = s.x / s.w, rounding = kSlopeRounding * frame.rounding(s);
    const auto cdf = [&](double slope) {
      return visible.cdf(std::min(std::asinh(slope), visible.farthest())).u;
    };
    return distance_from(u, cdf(x - rounding), cdf(x + rounding));
  }

  double error_y(const Record& r, double u) const {
    const StretchedFrame frame(exact_, r.configuration);
    const StretchedSlope s = frame.slope_of(r.wm);
    const double x = s.x / s.w, y = s.y / s.w, rounding = kSlopeRounding * frame.rounding(s);
    double low = 1, high = 0;
    for (const double near : {x, x - rounding, x + rounding}) {
      if (!ExactConditional::is_checked(exact_.unit_slopes(), near)) continue;
      const ExactConditional conditional(exact_.unit_slopes(), near);
      low = std::min(low, conditional.cdf(y - rounding).u);
      high = std::max(high, conditional.cdf(y + rounding).u);
    }
    return distance_from(u, low, high);
  }

  /// One record whose slope is judged: `cdf` is what it should be without any rounding.
  struct Judged {
    std::size_t record;
    const Group* group;
    double cdf, u;
  };

  /// The worst of all `list`. Rounding makes an error smaller, so `error_of` is called only for
  /// those that may be the worst.
  template <class Error>
  CheckResult worst_of(const std::vector<Judged>& list, const std::string& slope,
                       Source Group::*with, Error error_of) const {
    std::vector<Worst> each((list.size() + kChunk - 1) / kChunk);
    std::vector<const Group*> groups(each.size(), nullptr);
    support::parallel_for(each.size(), options_.workers, [&](std::size_t chunk) {
      const std::size_t end = std::min(list.size(), (chunk + 1) * kChunk);
      for (std::size_t k = chunk * kChunk; k < end; ++k) {
        const Judged& j = list[k];
        if (std::abs(j.cdf - j.u) <= each[chunk].measured) continue;
        const Record& r = record(j.record);
        const double error = error_of(r, j.u);
        if (error <= each[chunk].measured) continue;
        each[chunk].see(error, place_of(r.configuration, r.u1, r.u2));
        groups[chunk] = j.group;
      }
    });
    Worst all;
    const Group* group = list.empty() ? nullptr : list.front().group;
    for (std::size_t chunk = 0; chunk < each.size(); ++chunk) {
      if (groups[chunk] != nullptr && !(each[chunk].measured <= all.measured))
        group = groups[chunk];
      all.see(each[chunk]);
    }
    CheckResult result = all.result(kCheck, "u-error of slope " + slope, options_.u_error);
    result.note = (group == nullptr ? "" : slope + " " + (group->*with).text() + "; ") +
                  std::to_string(list.size()) + " records";
    return result;
  }

  CheckResult judge_x() const {
    std::vector<Judged> list;
    for (const Group& group : groups_) {
      if (!group.judged) continue;
      for (const std::size_t i : group.records)
        if (record(i).wm.z >= kSmallestHeight)
          list.push_back({i, &group, uniforms_[i].x, group.x.of(record(i))});
    }
    return worst_of(list, "x", &Group::x, [&](const Record& r, double u) { return error_x(r, u); });
  }

  CheckResult judge_y() const {
    std::vector<Judged> list;
    for (const Group& group : groups_) {
      if (!group.judged) continue;
      for (const SlopeY& s : group.some)
        if (!std::isnan(s.cdf))
          list.push_back({s.record, &group, s.cdf, group.y.of(record(s.record))});
    }
    return worst_of(list, "y", &Group::y, [&](const Record& r, double u) { return error_y(r, u); });
  }

  Place place_of_group(const Group& group) const {
    return group.band ? middle_of(records_, group.records)
                      : place_of(record(group.records.front()).configuration);
  }

  /// "0.02 of slope x": the correlation by which there is no inverse.
  static std::string missing_correlation(const Group& group) {
    const bool by_x = std::abs(group.correlation_x) < kMapCorrelation;
    return support::rounded_text(std::abs(by_x ? group.correlation_x : group.correlation_y)) +
           " of slope " + (by_x ? "x" : "y");
  }

  std::string kinds() const {
    if (!groups_.back().band) return "configurations";
    return groups_.front().band ? "bands of incidence" : "configurations and bands of incidence";
  }

  /// Names some of `left_out` in the text, and all of them by their places.
  SkippedCheck line_of(const std::vector<const Group*>& left_out, const std::string& why) const {
    SkippedCheck line{kCheck, "",
                      "in " + std::to_string(left_out.size()) + " of " +
                          std::to_string(groups_.size()) + " " + kinds() + " " + why};
    for (const Group* group : left_out) {
      const std::size_t before = line.where.size();
      line.where.push_back(place_of_group(*group));
      if (before >= kMostNamed) continue;
      line.reason += (before == 0 ? ": " : "; ") + configuration_text(line.where.back());
      if (!group->correlates) line.reason += " (" + missing_correlation(*group) + ")";
    }
    if (left_out.size() > kMostNamed)
      line.reason += "; and " + std::to_string(left_out.size() - kMostNamed) + " more";
    return line;
  }

  std::vector<SkippedCheck> skipped() const {
    std::vector<SkippedCheck> lines;
    std::vector<const Group*> none, beside;
    for (const Group& group : groups_)
      if (!group.judged) (group.correlates ? beside : none).push_back(&group);
    if (!none.empty())
      lines.push_back(line_of(none,
                              "the map is no inverse of the CDFs, which has rank correlations "
                              "with u1 and u2 of " +
                                  support::rounded_text(kMapCorrelation) + " or more"));
    if (!beside.empty())
      lines.push_back(
          line_of(beside, "the map is the inverse, but that of a band next to it is none"));
    if (!too_few_.empty())
      lines.push_back({kCheck, "",
                       std::to_string(too_few_.size()) +
                           " records are in configurations of fewer "
                           "than " +
                           std::to_string(kFewestForMap) + ", too few to recognise a map"});
    return lines;
  }

  const Records& records_;
  const ExactSlopes& exact_;
  std::span<const Uniforms> uniforms_;
  const RecordMapOptions& options_;
  std::vector<Group> groups_;  // configurations first, then bands by incidence
  Indices too_few_;
};

}  // namespace

RecordMapResults check_record_maps(const Records& records, const ExactSlopes& exact,
                                   std::span<const Uniforms> uniforms,
                                   const RecordMapOptions& options) {
  return RecordMaps(records, exact, uniforms, options).run();
}

}  // namespace vndf::validate
