// The judge: all stages on one subject.
#include "vndf/validate/validate.h"

#include <algorithm>
#include <functional>

#include "vndf/validate/checks/cross_validation.h"
#include "vndf/validate/checks/density_check.h"
#include "vndf/validate/checks/distribution_check.h"
#include "vndf/validate/checks/furnace_check.h"
#include "vndf/validate/checks/hard_cases.h"
#include "vndf/validate/checks/quasi_random_check.h"
#include "vndf/validate/checks/u_error_check.h"

namespace vndf::validate {
namespace {

/// How much each stage does.
struct Effort {
  QuantileOptions map;
  std::size_t cross_points, even_points;
  std::uint64_t samples;  // of each configuration
};

Effort effort(const JudgeOptions& o) {
  switch (o.thoroughness) {
    case Thoroughness::quick:
      return {{.places = 150, .slopes = 3, .stride = 2, .workers = o.workers}, 20, 50000, 100000};
    case Thoroughness::standard:
      return {{.workers = o.workers}, 200, 1000000, 4000000};
    default:
      return {{.places = 4000, .slopes = 24, .workers = o.workers}, 2000, 8000000, 62500000};
  }
}

using Stage = std::function<std::vector<Finding>()>;

}  // namespace

bool Verdict::passed() const {
  return all_passed(findings);
}

const Finding* Verdict::first_failure() const {
  const auto f = std::find_if(findings.begin(), findings.end(),
                              [](const Finding& finding) { return !finding.passed(); });
  return f == findings.end() ? nullptr : &*f;
}

Verdict judge(const Subject& subject, const JudgeOptions& options) {
  const Effort effort = validate::effort(options);
  const double significance = sidak(kRunSignificance, options.subjects);
  Verdict verdict{.subject = subject.name, .findings = {}};

  std::vector<Stage> stages{[&] { return test_hard_cases(subject); }};
  if (subject.claims.inverse_map)
    stages.push_back([&] { return measure_quantile_error(subject, effort.map); });
  stages.push_back([&] { return test_density(subject, options.workers); });
  stages.push_back([&] { return test_furnace(subject, options.workers); });
  if (subject.claims.smooth_map)
    stages.push_back(
        [&] { return measure_even_law(subject, effort.even_points, options.workers); });
  if (subject.claims.inverse_map)
    stages.push_back([&] { return cross_validate(subject, effort.cross_points, options.workers); });
  stages.push_back([&] {
    auto findings = test_law(subject, {.samples = effort.samples,
                                       .seed = options.seed,
                                       .significance = significance,
                                       .stop_at_first_failure = options.stop_at_first_failure,
                                       .workers = options.workers});
    verdict.samples = effort.samples * law_configurations().size();
    const double count = static_cast<double>(effort.samples);
    verdict.visible_u_error = visible_u_error(count, findings.front().bound);
    verdict.visible_bin_error = visible_bin_error(count, kBins);
    return findings;
  });

  for (const Stage& stage : stages) {
    const auto findings = stage();
    verdict.findings.insert(verdict.findings.end(), findings.begin(), findings.end());
    if (options.stop_at_first_failure && !all_passed(findings)) break;
  }
  return verdict;
}

}  // namespace vndf::validate
