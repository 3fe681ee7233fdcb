// The validator: all checks of one sampler.
#include "vndf/validate/validate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "vndf/support/text.h"
#include "vndf/validate/checks/configurations.h"
#include "vndf/validate/checks/cross_check.h"
#include "vndf/validate/checks/density_check.h"
#include "vndf/validate/checks/distribution_check.h"
#include "vndf/validate/checks/furnace_check.h"
#include "vndf/validate/checks/hard_cases.h"
#include "vndf/validate/checks/quasi_random_check.h"
#include "vndf/validate/checks/u_error_check.h"

namespace vndf::validate {
namespace {

/// How much each check does.
struct Effort {
  UErrorOptions map;
  std::size_t cross_check_points, quasi_random_points;
  std::uint64_t samples;  // of each configuration
};

Effort effort(const ValidationOptions& o) {
  switch (o.thoroughness) {
    case Thoroughness::quick:
      return {{.places = 150, .slopes = 3, .stride = 2, .workers = o.workers}, 20, 50000, 100000};
    case Thoroughness::standard:
      return {{.workers = o.workers}, 200, 1000000, 4000000};
    default:
      return {{.places = 4000, .slopes = 24, .workers = o.workers}, 2000, 8000000, 62500000};
  }
}

/// A check, or why the sampler is not given it.
struct Check {
  std::string name;
  std::function<std::vector<CheckResult>()> make;
  std::string reason = {};
};

constexpr const char* kNoInverse = "the sampler does not claim to be the inverse of the CDFs";

/// The statistics that the checks leave out because of what `sampler` is.
std::vector<SkippedCheck> skipped_statistics(const SamplerUnderTest& sampler) {
  const Claims& claims = sampler.claims;
  std::vector<SkippedCheck> skipped;
  if (claims.normals == SampledNormals::all)
    skipped.push_back({"hard cases", "facing away / (1 + alpha mu)",
                       "samplers of all normals may return normals that face away"});
  if (claims.normals == SampledNormals::visible_v_cavity)
    for (const auto& [check, statistic] :
         {std::pair{"density", "G1"}, std::pair{"furnace", "weak white furnace - 1"}})
      skipped.push_back({check, statistic, "V-cavities have another G1 than Smith's surface"});
  if (!claims.monotone_inverse)
    skipped.push_back({"density", "pdf times |Jacobian| - 1", kNoInverse});
  else if (!tells_density(sampler))
    skipped.push_back({"density", "pdf times |Jacobian| - 1",
                       "the map is known in single precision only, which has no derivative"});
  if (auto places = left_out(sampler); !places.empty()) {
    std::string reason = "single precision does not carry their slopes:";
    for (const Place& p : places)
      reason += (&p == &places.front() ? " alpha " : "; ") + support::rounded_text(p.alpha_x) +
                " x " + support::rounded_text(p.alpha_y);
    skipped.push_back({"distribution", "smooth surfaces", reason, std::move(places)});
  }
  return skipped;
}

/// What the counts of one configuration can show.
Resolution resolution_of(std::uint64_t samples, double p) {
  const auto count = static_cast<double>(samples);
  return {"one configuration", samples, visible_u_error(count, p), visible_bin_error(count, kBins)};
}

}  // namespace

bool Verdict::passed() const {
  return all_passed(results);
}

const CheckResult* Verdict::first_failure() const {
  const auto f = std::find_if(results.begin(), results.end(),
                              [](const CheckResult& result) { return !result.passed(); });
  return f == results.end() ? nullptr : &*f;
}

std::vector<CheckResult> Verdict::failures() const {
  std::vector<CheckResult> failed;
  for (const CheckResult& result : results)
    if (!result.passed()) failed.push_back(result);
  const auto farther = [](const CheckResult& a, const CheckResult& b) {
    const auto excess = [](const CheckResult& f) {
      if (std::isnan(f.measured)) return std::numeric_limits<double>::infinity();
      return f.kind == Kind::error ? f.measured / f.bound : f.bound / f.measured;
    };
    return excess(a) < excess(b);
  };
  const auto other = std::find_if(failed.begin(), failed.end(), [&](const CheckResult& f) {
    return f.check != failed.front().check;
  });
  if (failed.empty()) return failed;
  std::iter_swap(failed.begin(), std::max_element(failed.begin(), other, farther));
  return failed;
}

Verdict validate_sampler(const SamplerUnderTest& sampler, const ValidationOptions& options) {
  const std::size_t configurations = check_configurations(sampler).size();
  if (configurations == 0)
    throw std::invalid_argument(sampler.name +
                                ": single precision does not carry the slopes of this surface at "
                                "any roughness of the checks; give a correlation nearer to 0 or a "
                                "smaller mean slope");
  const Effort effort = validate::effort(options);
  const double significance = sidak(kRunSignificance, options.samplers);
  Verdict verdict{.sampler = sampler.name, .results = {}};

  const auto only_if = [](bool claimed, const char* why) { return claimed ? "" : why; };
  const bool inverse = sampler.claims.monotone_inverse;
  const std::vector<Check> checks{
      {"hard cases", [&] { return check_hard_cases(sampler); }},
      {"inverse", [&] { return check_u_error(sampler, effort.map); }, only_if(inverse, kNoInverse)},
      {"density", [&] { return check_density(sampler, options.workers); }},
      {"furnace", [&] { return check_furnace(sampler, options.workers); }},
      {"quasi-random",
       [&] { return check_quasi_random(sampler, effort.quasi_random_points, options.workers); },
       only_if(sampler.claims.smooth, "the sampler does not claim to be smooth in u1 and u2")},
      {"cross-check",
       [&] { return cross_check(sampler, effort.cross_check_points, options.workers); },
       only_if(inverse, kNoInverse)},
      {"distribution", [&] {
         auto results =
             check_distribution(sampler, {.samples = effort.samples,
                                          .seed = options.seed,
                                          .significance = significance,
                                          .stop_at_first_failure = options.stop_at_first_failure,
                                          .workers = options.workers});
         verdict.samples = effort.samples * configurations;
         verdict.resolutions = {resolution_of(effort.samples, results.front().bound)};
         return results;
       }}};

  bool stopped = false;
  for (const Check& check : checks) {
    const std::string reason =
        stopped && check.reason.empty() ? "a check before it failed" : check.reason;
    if (!reason.empty()) {
      verdict.skipped.push_back({check.name, "", reason});
      continue;
    }
    if (options.begin) options.begin(check.name);
    const auto results = check.make();
    verdict.results.insert(verdict.results.end(), results.begin(), results.end());
    stopped = options.stop_at_first_failure && !all_passed(results);
  }
  const auto statistics = skipped_statistics(sampler);
  verdict.skipped.insert(verdict.skipped.end(), statistics.begin(), statistics.end());
  return verdict;
}

}  // namespace vndf::validate
