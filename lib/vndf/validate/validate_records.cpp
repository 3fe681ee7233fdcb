// The validator on records.
#include "vndf/validate/validate_records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "vndf/certificate.h"
#include "vndf/support/text.h"
#include "vndf/validate/record_groups.h"
#include "vndf/validate/record_maps.h"
#include "vndf/validate/statistics/density_distance.h"

namespace vndf::validate {
namespace {

constexpr std::size_t kWorthTables =
    300;  // records of one configuration, to tabulate its distribution
constexpr std::size_t kMostConfigurations = 64;  // that are counted one by one, not in bands
constexpr std::size_t kFewestInGroup = 100;
constexpr std::size_t kRows = 8;  // of records, by a property that uniform numbers must not follow
constexpr double kFacing = 1e-5;  // text has fewer digits than a float

/// A property of configurations that no uniform number may depend on.
struct Property {
  const char* name;
  double (*of)(const Configuration&);
};
constexpr std::array kProperties{
    Property{"theta", [](const Configuration& c) { return c.incidence(); }},
    Property{"phi of wi", [](const Configuration& c) { return std::atan2(c.wi.y, c.wi.x); }},
    Property{"ax / ay", [](const Configuration& c) { return std::log(c.alpha.x / c.alpha.y); }}};

/// A uniform number whose dependence on properties is tested.
struct Variable {
  const char* name;
  double Uniforms::*of;
};
constexpr std::array kVariables{Variable{"radius", &Uniforms::r},
                                Variable{"azimuth", &Uniforms::phi}};

std::string dependence_name(const Variable& variable, const Property& property) {
  return std::string(variable.name) + " given " + property.name;
}

bool has_result(const std::vector<CheckResult>& results, const std::string& check,
                const std::string& statistic) {
  return std::any_of(results.begin(), results.end(), [&](const CheckResult& f) {
    return f.check == check && f.statistic == statistic;
  });
}

/// Whether there is a distribution of the normals that are claimed at `c`.
bool is_seen(const Configuration& c, const ExactSlopes& exact, const RecordOptions& options) {
  if (options.normals == SampledNormals::all || c.height() >= 0) return true;
  return options.normals == SampledNormals::visible_smith &&
         exact.unit_visible_area(c.wi, c.surface()) > kLeastArea;
}

std::string why_unseen(const RecordOptions& options) {
  return options.normals == SampledNormals::visible_v_cavity
             ? "V-cavities are seen from above only"
             : "less than " + support::rounded_text(kLeastArea) +
                   " of the surface is visible from their wi";
}

class RecordValidation {
 public:
  RecordValidation(const Records& records, const ExactSlopes& exact, const RecordOptions& options)
      : records_(records), exact_(exact), options_(options), uniforms_(records.list.size()) {}

  Verdict run() {
    transform();
    Verdict verdict{.sampler = "records", .results = check_each(), .skipped = skipped_of_each()};
    add_map(verdict);
    add_distribution(verdict);
    return verdict;
  }

 private:
  /// Finds the uniform numbers of all records; those of one configuration share its distribution.
  void transform() {
    const auto groups = records_by_configuration(records_);
    configurations_ = groups.size();
    support::parallel_for(groups.size(), options_.workers, [&](std::size_t g) {
      const Indices& group = groups[g];
      const ExactDistribution distribution(exact_, options_.normals,
                                           records_.list[group.front()].configuration,
                                           group.size() >= kWorthTables ? Use::many : Use::few);
      for (const std::size_t i : group) {
        std::mt19937_64 random(options_.seed + i);
        const double v = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
        uniforms_[i] = numbers(distribution.uniforms(upright(records_.list[i].wm), v));
      }
    });
  }

  /// `w` with 0 for what is not a number, which a direction at the limits of the format may give,
  /// so that it is counted, and orders stay orders.
  static Uniforms numbers(const Uniforms& w) {
    const auto number = [](double v) { return std::isnan(v) ? 0 : v; };
    return {number(w.r), number(w.phi), number(w.x)};
  }

  /// A normal below the horizon is a result of its own; the distribution takes it as horizontal.
  static Vec3<double> upright(const Vec3<double>& wm) { return {wm.x, wm.y, std::max(0.0, wm.z)}; }

  std::vector<CheckResult> check_each() const {
    Worst horizon, facing, pdf;
    for (const Record& r : records_.list) {
      const Configuration& c = r.configuration;
      const Place place = place_of(c, r.u1, r.u2);
      horizon.see(std::max(0.0, -r.wm.z), place);
      facing.see(std::max(0.0, -dot(c.wi, r.wm)) / facing_stretch(exact_, c), place);
      if (records_.has_pdf) pdf.see(density_error(r), place);
    }
    std::vector<CheckResult> results{horizon.result("normals", "below the horizon", kFacing)};
    if (options_.normals != SampledNormals::all)
      results.push_back(facing.result("normals", "facing away / (1 + alpha mu)", kFacing));
    if (records_.has_pdf) results.push_back(pdf.result("density", "pdf", kRecordDensityError));
    return results;
  }

  std::vector<SkippedCheck> skipped_of_each() const {
    std::vector<SkippedCheck> skipped;
    if (options_.normals == SampledNormals::all)
      skipped.push_back({"normals", "facing away / (1 + alpha mu)",
                         "samplers of all normals may return normals that face away"});
    if (records_.read > records_.list.size())
      skipped.push_back({"normals", "",
                         std::to_string(records_.read - records_.list.size()) + " of the " +
                             std::to_string(records_.read) +
                             " records are in no check; the others are a random part of them"});
    if (!records_.has_pdf) skipped.push_back({"density", "pdf", "the records have no column pdf"});
    return skipped;
  }

  double density_error(const Record& r) const {
    if (r.wm.z < kSmallestHeight) return 0;
    const ExactDistribution distribution(exact_, options_.normals, r.configuration, Use::few);
    const auto exact = [&](const Vec3<double>& m) { return distribution.pdf(m); };
    const auto facing = [&](const Vec3<double>& m) { return distribution.facing_pdf(m); };
    return density_distance(r.pdf, r.wm, r.configuration.surface(), exact, facing);
  }

  /// Why the map is not looked at; empty where it is.
  std::string no_map() const {
    if (!records_.has_u) return "the records have no random numbers u1,u2";
    if (options_.normals != SampledNormals::visible_smith)
      return "only maps to visible normals of Smith's surface are compared with the exact inverse";
    if (options_.monotone_inverse == false) return "the map is said to be no inverse of the CDFs";
    return "";
  }

  void add_map(Verdict& verdict) const {
    if (const std::string why = no_map(); !why.empty()) {
      verdict.skipped.push_back({"inverse", "", why});
      return;
    }
    const auto map = check_record_maps(records_, exact_, uniforms_,
                                       {.monotone_inverse = options_.monotone_inverse,
                                        .u_error = options_.u_error,
                                        .workers = options_.workers});
    verdict.results.insert(verdict.results.end(), map.results.begin(), map.results.end());
    verdict.skipped.insert(verdict.skipped.end(), map.skipped.begin(), map.skipped.end());
  }

  /// The configurations, or bands of them where they are many, that are counted by themselves.
  std::vector<Indices> groups() const {
    return configurations_ <= kMostConfigurations ? records_by_configuration(records_)
                                                  : records_by_band(records_);
  }

  void add_distribution(Verdict& verdict) const {
    Indices all(records_.list.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const bool one = configurations_ == 1;
    std::vector<CheckResult> counted;
    std::vector<std::size_t> sizes;
    std::size_t few = 0, in_few = 0;
    for (const Indices& group : one ? std::vector<Indices>{} : groups()) {
      if (group.size() < kFewestInGroup) {
        ++few;
        in_few += group.size();
        continue;
      }
      sizes.push_back(group.size());
      merge_results(counted, check_group(group, "worst group", middle_of(records_, group)));
    }
    const auto together = check_group(
        all, "distribution", one ? place_of(records_.list.front().configuration) : Place{});
    counted.insert(counted.end(), together.begin(), together.end());
    bound_probabilities(counted, kRunSignificance, number_of_tests(counted));
    verdict.results.insert(verdict.results.end(), counted.begin(), counted.end());

    const std::string kind = configurations_ <= kMostConfigurations ? "configuration" : "band";
    if (one)
      verdict.skipped.push_back({"worst group", "", "all records have one configuration"});
    else if (few > 0)
      verdict.skipped.push_back({"worst group", "",
                                 std::to_string(in_few) + " records are in " + std::to_string(few) +
                                     " " + kind + (few == 1 ? "" : "s") + " of fewer than " +
                                     std::to_string(kFewestInGroup) +
                                     ", and are counted with all others only"});
    if (!sizes.empty()) add_skipped_counts(verdict, "worst group");
    add_skipped_counts(verdict, "distribution");
    verdict.samples = all.size();
    add_resolution(verdict, one ? "one configuration" : "all configurations", all.size());
    if (sizes.empty()) return;
    const auto [fewest, most] = std::minmax_element(sizes.begin(), sizes.end());
    add_resolution(verdict, "the largest " + kind, *most);
    if (*fewest != *most) add_resolution(verdict, "the smallest " + kind, *fewest);
  }

  /// What the counts of one group can show, at the bound that all counts have.
  static void add_resolution(Verdict& verdict, const std::string& counted, std::size_t samples) {
    const double p = verdict.results.back().bound, count = static_cast<double>(samples);
    verdict.resolutions.push_back({counted, samples, visible_u_error(count, p),
                                   visible_bin_error(count, bins_for(samples).line)});
  }

  /// Tells which statistics of counts there are too few records for.
  void add_skipped_counts(Verdict& verdict, const std::string& check) const {
    const auto skip = [&](const std::string& statistic, const std::string& why) {
      if (!has_result(verdict.results, check, statistic))
        verdict.skipped.push_back({check, statistic, why});
    };
    for (const char* name : {"radius tails", "azimuth tails", "slope x tails"})
      skip(name, "it takes " + std::to_string(LineCounts::kFewestForTails) + " records");
    const std::size_t needed = kRows * kFewestInGroup;
    for (const Property& property : kProperties)
      for (const Variable& variable : kVariables)
        skip(dependence_name(variable, property),
             "it takes " + std::to_string(needed) + " records of different " + property.name);
  }

  std::vector<CheckResult> check_group(const Indices& group, const std::string& check,
                                       const Place& where) const {
    UniformCounts counts(bins_for(group.size()));
    for (const std::size_t i : group) counts.add(uniforms_[i]);
    auto results = counts.results(options_.declared, check, where);
    for (const Variable& variable : kVariables)
      for (const Property& property : kProperties)
        if (const auto p = dependence(group, variable, property))
          results.push_back({.check = check,
                             .statistic = dependence_name(variable, property),
                             .kind = Kind::probability,
                             .measured = *p,
                             .where = where,
                             .tests = 1});
    return results;
  }

  /// The p-value of a uniform number that does not depend on the configuration, which it must not.
  /// A mistake in a fixed frame, such as an azimuth that stops short, is hidden again when wi is at
  /// all azimuths. So the records are put in rows of equal size by a property of theirs, and each
  /// row is counted by itself. Nothing where the records are too few, or all alike.
  std::optional<double> dependence(const Indices& group, const Variable& variable,
                                   const Property& property) const {
    constexpr std::size_t kFewestColumns = 5;
    const std::size_t columns = std::min(kSideR, bins_for(group.size() / kRows).line);
    if (group.size() < kRows * kFewestInGroup || columns < kFewestColumns) return {};
    std::vector<std::pair<double, double>> pairs;  // the property and the uniform number
    for (const std::size_t i : group)
      pairs.emplace_back(property.of(records_.list[i].configuration), uniforms_[i].*variable.of);
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
    return chi_square_p(statistic, kRows * (columns - 1) + 1, static_cast<double>(group.size()),
                        options_.declared.density);
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
  const auto unseen = [&](const Record& r) { return !is_seen(r.configuration, exact, options); };
  const auto left_out =
      static_cast<std::size_t>(std::count_if(records.list.begin(), records.list.end(), unseen));
  Records rest;
  if (left_out > 0) {
    rest = records;
    std::erase_if(rest.list, unseen);
    rest.read -= left_out;
  }
  const Records& seen = left_out > 0 ? rest : records;
  if (seen.list.size() < kFewestRecords)
    throw std::invalid_argument("there are " + std::to_string(seen.list.size()) + " records" +
                                (left_out > 0 ? " of which normals are visible" : "") + "; give " +
                                std::to_string(kFewestRecords) + " or more, better a million");
  Verdict verdict = RecordValidation(seen, exact, options).run();
  if (left_out > 0)
    verdict.skipped.push_back(
        {"normals", "",
         std::to_string(left_out) + " records are in no check: " + why_unseen(options)});
  return verdict;
}

}  // namespace vndf::validate
