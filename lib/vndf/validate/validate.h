// The validator: all checks of one sampler, from any program. Of tables that were built for GGX,
//
//   const auto exact = std::make_shared<ExactSlopes>(distributions::parse_distribution("ggx"));
//   const auto sampler = tables_under_test("my tables", exact, built.tables, built.certificate);
//   const Verdict verdict = validate_sampler(sampler, {.thoroughness = Thoroughness::quick});
//   if (!verdict.passed()) std::cerr << verdict.first_failure()->statistic << '\n';
//
// A sampler of another kind becomes a SamplerUnderTest by under_test() (sampler_under_test.h). The
// checks without random numbers are made first: they see errors of 1e-5, where counting a million
// samples sees those of 1e-2.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"
#include "vndf/validate/statistics/significance.h"

namespace vndf::validate {

/// How many places and samples the checks use.
enum class Thoroughness {
  quick,     ///< seconds
  standard,  ///< a minute on two cores
  thorough   ///< 1e9 samples
};

/// What a run does, beyond the sampler itself.
struct ValidationOptions {
  /// More of it sees smaller errors and takes longer.
  Thoroughness thoroughness = Thoroughness::standard;
  /// All random numbers of the distribution check follow from it.
  std::uint64_t seed = 1;
  /// Whether the checks after one that fails are left out.
  bool stop_at_first_failure = false;
  /// Number of samplers that are validated in the whole run: they share its significance.
  std::size_t samplers = 1;
  /// Results do not depend on the number of threads.
  support::Workers workers = {};
  /// Called with the name of each check before it is made; may be empty.
  std::function<void(const std::string& check)> begin = {};
};

/// The errors that samples which were counted together can show.
struct Resolution {
  std::string counted;        ///< what was counted together, as "one configuration"
  std::uint64_t samples = 0;  ///< how many they are
  double u_error = 0;         ///< visible_u_error(), in u
  double bin_error = 0;       ///< visible_bin_error(), relative, of the mass of a bin
};

/// All results of one sampler.
struct Verdict {
  /// The name of the sampler.
  std::string sampler;
  /// In the order in which the checks were made.
  std::vector<CheckResult> results;
  /// What was not checked, so that nothing is left out in silence.
  std::vector<SkippedCheck> skipped = {};
  std::uint64_t samples = 0;  ///< how many were counted in all
  /// What the counts can show; empty where nothing was counted.
  std::vector<Resolution> resolutions = {};

  /// Whether every result passed.
  bool passed() const;
  /// The first result that did not pass, or null. It lives as long as this verdict.
  const CheckResult* first_failure() const;
  /// All that did not pass, the worst of the first check that failed at the front: the one that is
  /// farthest beyond its bound.
  std::vector<CheckResult> failures() const;
};

/// Makes every check that `sampler` claims to pass: hard cases, u-error and cross-check where it
/// claims to be the monotone inverse, density, furnace, quasi-random where its map is smooth, and
/// distribution. They are made on sampler.surface, and below it where that is claimed. A correct
/// sampler fails a run of options.samplers samplers with a probability of kRunSignificance. Throws
/// std::invalid_argument for a surface that kMostRounding leaves out at every roughness.
Verdict validate_sampler(const SamplerUnderTest& sampler, const ValidationOptions& options = {});

}  // namespace vndf::validate
