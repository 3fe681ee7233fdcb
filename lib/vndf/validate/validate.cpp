// The validator: all checks of one sampler.
#include "vndf/validate/validate.h"

#include <algorithm>
#include <functional>

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

using Check = std::function<std::vector<CheckResult>()>;

}  // namespace

bool Verdict::passed() const {
  return all_passed(results);
}

const CheckResult* Verdict::first_failure() const {
  const auto f = std::find_if(results.begin(), results.end(),
                              [](const CheckResult& result) { return !result.passed(); });
  return f == results.end() ? nullptr : &*f;
}

Verdict validate_sampler(const SamplerUnderTest& sampler, const ValidationOptions& options) {
  const Effort effort = validate::effort(options);
  const double significance = sidak(kRunSignificance, options.samplers);
  Verdict verdict{.sampler = sampler.name, .results = {}};

  std::vector<Check> checks{[&] { return check_hard_cases(sampler); }};
  if (sampler.claims.monotone_inverse)
    checks.push_back([&] { return check_u_error(sampler, effort.map); });
  checks.push_back([&] { return check_density(sampler, options.workers); });
  checks.push_back([&] { return check_furnace(sampler, options.workers); });
  if (sampler.claims.smooth)
    checks.push_back(
        [&] { return check_quasi_random(sampler, effort.quasi_random_points, options.workers); });
  if (sampler.claims.monotone_inverse)
    checks.push_back(
        [&] { return cross_check(sampler, effort.cross_check_points, options.workers); });
  checks.push_back([&] {
    auto results =
        check_distribution(sampler, {.samples = effort.samples,
                                     .seed = options.seed,
                                     .significance = significance,
                                     .stop_at_first_failure = options.stop_at_first_failure,
                                     .workers = options.workers});
    verdict.samples = effort.samples * check_configurations().size();
    const double count = static_cast<double>(effort.samples);
    verdict.visible_u_error = visible_u_error(count, results.front().bound);
    verdict.visible_bin_error = visible_bin_error(count, kBins);
    return results;
  });

  for (const Check& check : checks) {
    const auto results = check();
    verdict.results.insert(verdict.results.end(), results.begin(), results.end());
    if (options.stop_at_first_failure && !all_passed(results)) break;
  }
  return verdict;
}

}  // namespace vndf::validate
