// The validator on records.
#include "vndf/validate/validate_records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>

#include "vndf/validate/exact/exact_conditional.h"
#include "vndf/validate/statistics/density_distance.h"

namespace vndf::validate {
namespace {

constexpr std::size_t kWorthTables =
    300;  // records of one configuration, to tabulate its distribution
constexpr std::size_t kMostConfigurations = 64;  // that are checked one by one, not in bands
constexpr std::size_t kFewestInGroup = 100;
constexpr std::size_t kConditionals = 4000;  // records whose slope y is checked, 0.1 ms each
constexpr std::size_t kDetected = 1000;      // records that a map is detected from
constexpr double kNearMap = 1e-2;
constexpr double kFacing = 1e-5;  // text has fewer digits than a float

using Indices = std::vector<std::size_t>;
using Key = std::array<double, 5>;

Key key_of(const Configuration& c) {
  return {c.wi.x, c.wi.y, c.wi.z, c.alpha.x, c.alpha.y};
}

/// The band of incidence and roughness that a configuration is in.
Key band_of(const Configuration& c) {
  static constexpr std::array kEnds{0.3, 10.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.9};
  const double theta =
      static_cast<double>(std::lower_bound(kEnds.begin(), kEnds.end(), c.theta()) - kEnds.begin());
  return {theta, std::floor(std::log10(c.alpha.x)), std::floor(std::log10(c.alpha.y)), 0, 0};
}

template <class KeyOf>
std::map<Key, Indices> grouped(const Records& records, KeyOf key) {
  std::map<Key, Indices> groups;
  for (std::size_t i = 0; i < records.list.size(); ++i)
    groups[key(records.list[i].configuration)].push_back(i);
  return groups;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The middle of a group: medians of incidence and roughness.
Place place_of_group(const Records& records, const Indices& group) {
  const auto of = [&](auto number) {
    std::vector<double> values;
    for (const std::size_t i : group) values.push_back(number(records.list[i].configuration));
    return median(std::move(values));
  };
  return {of([](const Configuration& c) { return c.theta(); }),
          of([](const Configuration& c) { return c.alpha.x; }),
          of([](const Configuration& c) { return c.alpha.y; })};
}

class RecordValidation {
 public:
  RecordValidation(const Records& records, const ExactSlopes& exact, const RecordOptions& options)
      : records_(records), exact_(exact), options_(options), uniforms_(records.list.size()) {}

  Verdict run() {
    transform();
    Verdict verdict{.sampler = "records", .results = check_each()};
    const auto add = [&](const std::vector<CheckResult>& more) {
      verdict.results.insert(verdict.results.end(), more.begin(), more.end());
    };
    if (is_monotone_inverse()) add(check_inverse());
    auto counted = check_distribution();
    bound_probabilities(counted, kRunSignificance, number_of_tests(counted));
    add(counted);
    const auto count = static_cast<double>(records_.list.size());
    verdict.samples = records_.list.size();
    verdict.visible_u_error = visible_u_error(count, counted.front().bound);
    verdict.visible_bin_error = visible_bin_error(count, bins_for(verdict.samples).line);
    return verdict;
  }

 private:
  /// Finds the uniform numbers of all records; those of one configuration share its distribution.
  void transform() {
    const auto groups = grouped(records_, key_of);
    configurations_ = groups.size();
    std::vector<const Indices*> pieces;
    for (const auto& [key, group] : groups) pieces.push_back(&group);
    support::parallel_for(pieces.size(), options_.workers, [&](std::size_t p) {
      const Indices& group = *pieces[p];
      const ExactDistribution distribution(exact_, options_.normals,
                                           records_.list[group.front()].configuration,
                                           group.size() >= kWorthTables ? Use::many : Use::few);
      for (const std::size_t i : group) {
        std::mt19937_64 random(options_.seed + i);
        const double v = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
        uniforms_[i] = distribution.uniforms(upright(records_.list[i].wm), v);
      }
    });
  }

  /// A normal below the horizon is a result of its own; the distribution takes it as horizontal.
  static Vec3<double> upright(const Vec3<double>& wm) { return {wm.x, wm.y, std::max(0.0, wm.z)}; }

  std::vector<CheckResult> check_each() const {
    Worst horizon, facing, pdf;
    for (const Record& r : records_.list) {
      const Configuration& c = r.configuration;
      const Place place = place_of(c, r.u1, r.u2);
      const double stretch = 1 + std::max(c.alpha.x, c.alpha.y) * exact_.unit_slopes().mean_slope();
      horizon.see(std::max(0.0, -r.wm.z), place);
      facing.see(std::max(0.0, -dot(c.wi, r.wm)) / stretch, place);
      if (records_.has_pdf) pdf.see(density_error(r), place);
    }
    std::vector<CheckResult> results{horizon.result("normals", "below the horizon", kFacing)};
    if (options_.normals != SampledNormals::all)
      results.push_back(facing.result("normals", "facing away / (1 + alpha mu)", kFacing));
    if (records_.has_pdf) results.push_back(pdf.result("density", "pdf", kRecordDensityError));
    return results;
  }

  double density_error(const Record& r) const {
    if (r.wm.z < kSmallestHeight) return 0;
    const ExactDistribution distribution(exact_, options_.normals, r.configuration, Use::few);
    const auto exact = [&](const Vec3<double>& m) { return distribution.pdf(m); };
    const auto facing = [&](const Vec3<double>& m) { return distribution.facing_pdf(m); };
    return density_distance(r.pdf, r.wm, exact, facing);
  }

  bool is_monotone_inverse() const {
    if (!records_.has_u || options_.normals != SampledNormals::visible_smith) return false;
    if (options_.monotone_inverse) return *options_.monotone_inverse;
    std::size_t seen = 0, near = 0;
    for_some(kDetected, [&](std::size_t i) {
      ++seen;
      near += std::abs(uniforms_[i].x - records_.list[i].u1) < kNearMap;
    });
    return near * 100 >= seen * 99;
  }

  /// Calls `f` with some `count` indices spread over the records.
  template <class F>
  void for_some(std::size_t count, F f) const {
    const std::size_t n = records_.list.size(), stride = std::max<std::size_t>(1, n / count);
    for (std::size_t i = 0; i < n; i += stride) f(i);
  }

  std::vector<CheckResult> check_inverse() const {
    Worst marginal;
    for (std::size_t i = 0; i < records_.list.size(); ++i) {
      const Record& r = records_.list[i];
      if (r.wm.z >= kSmallestHeight)
        marginal.see(std::abs(uniforms_[i].x - r.u1), place_of(r.configuration, r.u1, r.u2));
    }
    Indices some;
    for_some(kConditionals, [&](std::size_t i) { some.push_back(i); });
    std::vector<Worst> each(some.size());
    support::parallel_for(some.size(), options_.workers, [&](std::size_t k) {
      const Record& r = records_.list[some[k]];
      each[k].see(conditional_error(r), place_of(r.configuration, r.u1, r.u2));
    });
    Worst conditional;
    for (const Worst& w : each) conditional.see(w);
    return {marginal.result("inverse", "u-error of slope x", options_.u_error),
            conditional.result("inverse", "u-error of slope y", options_.u_error)};
  }

  double conditional_error(const Record& r) const {
    const StretchedSlope s = StretchedFrame(exact_, r.configuration).slope_of(r.wm);
    const double x = s.x / s.w;
    if (!(r.wm.z >= kSmallestHeight) || !ExactConditional::is_checked(exact_.unit_slopes(), x))
      return 0;
    return std::abs(ExactConditional(exact_.unit_slopes(), x).cdf(s.y / s.w).u - r.u2);
  }

  std::vector<CheckResult> check_distribution() const {
    const auto groups = configurations_ <= kMostConfigurations ? grouped(records_, key_of)
                                                               : grouped(records_, band_of);
    std::vector<CheckResult> parts;
    for (const auto& [key, group] : groups) {
      if (group.size() < kFewestInGroup) continue;
      merge_results(parts, check_group(group, "worst group", place_of_group(records_, group)));
    }
    if (groups.size() == 1) {
      for (CheckResult& f : parts) f.check = "distribution";
      return parts;
    }
    Indices all(records_.list.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    auto results = check_group(all, "distribution", {});
    results.insert(results.begin(), parts.begin(), parts.end());
    return results;
  }

  std::vector<CheckResult> check_group(const Indices& group, const std::string& check,
                                       const Place& where) const {
    UniformCounts counts(bins_for(group.size()));
    for (const std::size_t i : group) counts.add(uniforms_[i]);
    auto results = counts.results(options_.declared, check, where);
    const auto radius = [](const Uniforms& w) { return w.r; };
    const auto azimuth = [](const Uniforms& w) { return w.phi; };
    const auto add = [&](const std::string& name, auto variable, auto given) {
      if (auto f = check_dependence(group, variable, given)) {
        f->check = check;
        f->statistic = name;
        f->where = where;
        results.push_back(*f);
      }
    };
    const auto theta = [](const Configuration& c) { return c.theta(); };
    const auto phi = [](const Configuration& c) { return std::atan2(c.wi.y, c.wi.x); };
    const auto stretch = [](const Configuration& c) { return std::log(c.alpha.x / c.alpha.y); };
    add("radius given theta", radius, theta);
    add("radius given phi of wi", radius, phi);
    add("radius given ax / ay", radius, stretch);
    add("azimuth given theta", azimuth, theta);
    add("azimuth given phi of wi", azimuth, phi);
    add("azimuth given ax / ay", azimuth, stretch);
    return results;
  }

  /// Whether a uniform number depends on the configuration, which it must not. A mistake in a fixed
  /// frame, such as an azimuth that stops short, is hidden again when wi is at all azimuths. So the
  /// records are put in rows of equal size by a property of theirs, and each row is counted by
  /// itself. Nothing where the records are too few, or all alike.
  template <class Variable, class Given>
  std::optional<CheckResult> check_dependence(const Indices& group, Variable variable,
                                              Given given) const {
    constexpr std::size_t kRows = 8, kFewestColumns = 5;
    const std::size_t columns = std::min(kSideR, bins_for(group.size() / kRows).line);
    if (group.size() < kRows * kFewestInGroup || columns < kFewestColumns) return {};
    std::vector<std::pair<double, double>> pairs;  // the property and the uniform number
    for (const std::size_t i : group)
      pairs.emplace_back(given(records_.list[i].configuration), variable(uniforms_[i]));
    std::sort(pairs.begin(), pairs.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    if (pairs.front().first == pairs.back().first) return {};
    double statistic = 0;
    for (std::size_t row = 0; row < kRows; ++row) {
      LineCounts counts(columns);
      const std::size_t end = (row + 1) * pairs.size() / kRows;
      for (std::size_t k = row * pairs.size() / kRows; k < end; ++k) counts.add(pairs[k].second);
      statistic += counts.pearson();
    }
    const double p = chi_square_p(statistic, kRows * (columns - 1) + 1,
                                  static_cast<double>(group.size()), options_.declared.density);
    return CheckResult{.kind = Kind::probability, .measured = p, .tests = 1};
  }

  const Records& records_;
  const ExactSlopes& exact_;
  const RecordOptions& options_;
  std::vector<Uniforms> uniforms_;
  std::size_t configurations_ = 0;
};

}  // namespace

Verdict validate_records(const Records& records, const ExactSlopes& exact,
                         const RecordOptions& options) {
  if (records.list.size() < kFewestRecords)
    throw std::invalid_argument("there are " + std::to_string(records.list.size()) +
                                " records; give " + std::to_string(kFewestRecords) +
                                " or more, better a million");
  return RecordValidation(records, exact, options).run();
}

}  // namespace vndf::validate
